#pragma once
// The signals of one side by their names: aliases are merged, and a vector that was split into bits is joined.
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/waves/wave_reader.hpp"

namespace dsdpv1::tb::compare {

struct Net {
  std::string scope;  ///< without the prefix of the side
  std::string leaf;
  WaveKind kind = WaveKind::kBits;
  std::uint32_t width = 1;             ///< of bits
  std::vector<std::uint32_t> signals;  ///< of the file: one for most, or the pieces, the leftmost first
  std::string name() const { return scope.empty() ? leaf : scope + "." + leaf; }
};

/// In small letters.
std::string lower(std::string text);

class Nets {
 public:
  /// The nets in the scope `prefix` and below it; empty: all. `file` is for messages. Throws InputError for an unknown
  /// scope.
  Nets(const WaveDeclarations& declarations, const std::string& prefix, std::string file);

  const std::vector<Net>& all() const { return nets_; }
  /// The net with this name; nullptr when none has it.
  const Net* at(const std::string& name) const;
  /// The net with this last part of its name, ignoring case; nullptr when none or several have it.
  const Net* with_leaf(const std::string& leaf) const;
  /// True when the last part of a name is this one, ignoring case.
  bool has_leaf(const std::string& leaf) const { return by_leaf_.count(lower(leaf)) != 0; }
  /// True when the name selects one signal or several.
  bool knows(const std::string& name) const;
  /// By its whole name or by the end of it ("dut.irq"); throws InputError for none or several.
  const Net& find(const std::string& name) const;
  const std::string& file() const { return file_; }

 private:
  void add_pieces(std::vector<const WaveVariable*>& pieces, const std::string& scope);
  void index();

  const WaveDeclarations& declarations_;
  std::string file_;
  std::vector<Net> nets_;
  std::unordered_map<std::string, std::size_t> by_name_;
  std::unordered_map<std::string, std::vector<std::size_t>> by_leaf_;  ///< in small letters
};

}  // namespace dsdpv1::tb::compare
