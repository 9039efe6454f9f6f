#pragma once
// Reading of waves: the declarations, then the changes in order of time, one at a time. VCD and FST of any
// simulator; memory is needed for the declarations, not for the changes.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dsdpv1::tb {

enum class WaveKind : std::uint8_t {
  kBits,
  kReal,
  kText,
  kEvent,  ///< of Verilog: has no value, only moments
};

/// A net with a value, under any number of names.
struct WaveSignal {
  WaveKind kind = WaveKind::kBits;
  std::uint32_t width = 1;  ///< number of bits; 0 for other values
};

/// A name of a signal.
struct WaveVariable {
  std::uint32_t scope = 0;                   ///< its place in WaveDeclarations::scopes
  std::string name;                          ///< without range, and without the backslash of an escaped identifier
  std::optional<std::pair<int, int>> range;  ///< as declared: the leftmost bit's index and the rightmost's
  std::uint32_t signal = 0;                  ///< its place in WaveDeclarations::signals
};

struct WaveDeclarations {
  int exponent = 0;                 ///< times count 10^exponent seconds: -15 (1 fs) to 2 (100 s)
  std::vector<std::string> scopes;  ///< "top.dut"; the first is the empty one above all others
  std::vector<WaveVariable> variables;
  std::vector<WaveSignal> signals;
};

/// Limits: a larger file is refused, not half read.
constexpr std::size_t kMostWaveVariables = 4'000'000;
constexpr std::uint32_t kMostWaveWidth = 1U << 20U;
constexpr std::size_t kMostWaveNames = std::size_t{1} << 30U;  ///< bytes of names of all scopes and variables

struct WaveEvent {
  enum class Kind : std::uint8_t {
    kChange,
    kOff,  ///< the simulator stops recording ($dumpoff)
    kOn,
    kTrigger,  ///< a moment of an event
  };
  Kind kind = Kind::kChange;
  std::uint64_t time = 0;  ///< never decreases
  std::uint32_t signal = 0;
  /// Valid until the next event is read. Bits: one of 0, 1, x, z for each bit, the leftmost first. A real: the file's
  /// text, for strtod. A text: its characters, without escapes.
  std::string_view value;
};

class WaveReader {
 public:
  virtual ~WaveReader() = default;

  virtual const WaveDeclarations& declarations() const = 0;
  /// Call before the first event: restricts the reported changes to these signals. The default is all.
  virtual void select(const std::vector<bool>& signals) = 0;
  /// The next event; false at the end of the file. Throws InputError when the file is damaged.
  virtual bool next(WaveEvent& event) = 0;
  /// The first time in the file, known once there was an event or the end.
  virtual std::uint64_t begin() const = 0;
  /// The last time read so far.
  virtual std::uint64_t end() const = 0;
  /// How much of the file has been read, 0 to 1.
  virtual double share() const = 0;
};

/// A reader chosen by the file's content, not its name. `path` may be a FIFO when it is VCD, which may be packed as gz.
/// Throws InputError if the file is not a wave, is damaged or cut, or exceeds the limits above.
std::unique_ptr<WaveReader> read_wave(const std::string& path);

}  // namespace dsdpv1::tb
