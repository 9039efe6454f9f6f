#pragma once
// Telegrams byte by byte as `dsdpv1-sim decode` prints them.
#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "bus/telegram/explain.hpp"

namespace dsdpv1::bus {

class TelegramPrinter {
 public:
  /// `out` must outlive it.
  explicit TelegramPrinter(std::ostream& out) : out_(out) {}

  // `where` as in "line 5, 1361750.000 ns".
  /// A right one. Remembers what a Set_Prm says about DPV1, so that later diagnoses are read as they are meant.
  void right(const std::string& where, const Decoded& decoded);
  /// `all`: the bytes from the telegram's first to where the next one may begin; those that it does not have are said
  /// to be not decoded.
  void wrong(const std::string& where, const std::string& why, const Decoded& decoded, const Bytes& all);
  void garbage(const std::string& where, const Bytes& bytes);

  /// There was something, and all of it was right.
  bool all_right() const { return right_ && count_ > 0; }

 private:
  void print(const std::string& what, const std::string& where, const std::string& line,
             const std::vector<ExplainedByte>& bytes);

  std::ostream& out_;
  std::array<std::optional<bool>, 128> dpv1_ = {};  ///< by slave
  int count_ = 0;
  bool right_ = true;
};

}  // namespace dsdpv1::bus
