#pragma once
// Converts statements to a Gsd: blocks, their contents and the keywords outside blocks. Internal to the GSD reader.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bus/gsd/gsd.hpp"
#include "bus/gsd/keywords.hpp"
#include "bus/gsd/statement.hpp"
#include "bus/gsd/text.hpp"

namespace dsdpv1::bus::gsd {

/// Values of the keywords outside blocks, by their names in lower case.
struct Settings {
  std::map<std::string, std::int64_t> numbers;
  std::map<std::string, std::string> texts;
  std::optional<GsdPrmConst> user_prm_data;  ///< User_Prm_Data of revision 0
  std::set<std::string> seen;                ///< including those whose value was rejected
};

enum class Scope : std::uint8_t { kTop, kModule, kPrmText, kParameter, kSlots, kKept };
struct BlockKind;

class Parser {
 public:
  explicit Parser(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}
  void read(const Line& line);
  /// Reports open blocks and a missing header.
  void finish();

  Gsd gsd;
  Settings settings;

 private:
  struct Open {
    const BlockKind* kind;
    int line;
    bool skipped;  ///< its head was wrong: its contents are ignored, so that one fault causes one message
  };

  void read_header(const Statement& statement);
  void open(const BlockKind& kind, const Statement& statement);
  bool begin(Scope kind, const Statement& statement);
  void close(const BlockKind& kind, const Statement& statement);
  void leave();
  bool begin_module(const Statement& statement);
  bool begin_prm_text(const Statement& statement);
  bool begin_parameter(const Statement& statement);
  void end_module();
  void end_parameter();

  void in_top(const Statement& statement);
  void in_module(const Statement& statement);
  void in_prm_text(const Statement& statement);
  void in_parameter(const Statement& statement);
  void in_slots(const Statement& statement);
  void read_content(const Statement& statement);

  void read_keyword(const Keyword& keyword, const Statement& statement);
  bool read_prm_block(GsdPrmBlock& block, const Statement& statement, std::string_view key);
  void read_prm_const(GsdPrmBlock& block, const Statement& statement);
  void read_prm_ref(GsdPrmBlock& block, const Statement& statement);
  void read_length(GsdPrmBlock& block, const Statement& statement);
  void read_type(GsdType type, const Statement& statement);
  bool read_bits(const Statement& statement);
  void read_preset(const Statement& statement);
  void keep(std::vector<GsdKeyword>& list, const Statement& statement);

  std::optional<std::int64_t> number(const Statement& statement, std::int64_t low, std::int64_t high);
  std::optional<int> offset(const Statement& statement);
  Scope scope() const;

  Diagnostics& diagnostics_;
  std::vector<Open> open_;
  bool header_ = false, started_ = false;
  GsdModule module_;
  GsdParameter parameter_;
  bool typed_ = false;  ///< parameter_ has its data type
  int prm_text_ = 0;
};

/// Second pass, when all blocks are known: fills members of the Gsd from the settings, resolves references between
/// blocks, checks limits.
void complete(Gsd& gsd, const Settings& settings, Diagnostics& diagnostics);

}  // namespace dsdpv1::bus::gsd
