#pragma once
// Names of waves: "D [7:0]", "mem[3][7:0]", "\escaped.name[3] [1:0]".
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/waves/wave_reader.hpp"

namespace dsdpv1::tb {

struct WaveName {
  std::string name;
  std::optional<std::pair<int, int>> range;
};

/// The parts of a name in a file, for a signal that is `width` wide. A single index is a range if the signal is one bit
/// wide; otherwise it belongs to the name (a word of an array).
WaveName parse_wave_name(std::string_view text, std::uint32_t width);

/// The scopes of a file while it is read: simulators open the same one again and again.
class WaveScopes {
 public:
  explicit WaveScopes(WaveDeclarations& to) : to_(to) { enter(""); }
  void open(std::string_view name);
  /// False when none is open.
  bool close();
  std::uint32_t current() const { return open_.back(); }

 private:
  void enter(const std::string& path);

  WaveDeclarations& to_;
  std::vector<std::uint32_t> open_;
  std::unordered_map<std::string, std::uint32_t> known_;
};

}  // namespace dsdpv1::tb
