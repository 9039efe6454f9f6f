#pragma once
// The only interface between the model and RTL of a chip. Levels are by the numbers of the kind's PinTable.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::cosim {

using bus::Tick;
using tb::Level;
using tb::PinNumber;

using tb::kMostPins;
constexpr PinNumber kNoPin = kMostPins;
/// One more than the last number.
inline PinNumber end_of(const tb::PinTable& pins) { return static_cast<PinNumber>(pins.size()); }

/// A design in RTL. It has no time except CLK.
class Rtl {
 public:
  virtual ~Rtl() = default;
  /// Lets it settle with CLK and the inputs of `levels`, edges included, and stores its outputs there: kLevelZ for a
  /// released one, kLevelX for an unknown one.
  virtual void eval(bool clk, Level* levels) = 0;
  /// The memory shared with its user, including pending writes, ChipKind::cells() bytes. Returns false if it cannot be
  /// read.
  virtual bool memory(std::uint8_t* /*image*/) const { return false; }
  /// Announces that the next evaluation is at `at`, which never decreases; for a trace of internal signals. None is
  /// before tick 0.
  virtual void moment(Tick /*at*/) {}
};

/// Maps ticks of inputs to evaluations.
struct RtlTiming {
  tb::PinMask at_once = 0;     ///< inputs that act at their own tick; others are sampled by an edge of CLK or of these
  PinNumber clock = kNoPin;    ///< a second clock: simultaneous edges of both are evaluated together, see RtlChip
  PinNumber data = kNoPin;     ///< the input that `clock` samples at its previous level
  PinNumber delayed = kNoPin;  ///< an output whose changes between 0 and 1 come `delay` ticks later
  Tick delay = 0;
};

/// RtlTiming::delayed. Releasing or driving it acts at once and drops pending changes.
class DelayedOutput {
 public:
  explicit DelayedOutput(Tick delay) : delay_(delay) {}

  /// The register changes. Returns true if the pin does, too, at once.
  bool change(Tick at, Level then, Level now) {
    if (now != tb::kLevelZ && then != tb::kLevelZ) {
      coming_.push_back({at + delay_, now});
      return false;
    }
    coming_.clear();
    level_ = now;
    return true;
  }
  /// The pin's next pending change; its level after that.
  Tick next() const { return coming_.empty() ? bus::kNever : coming_.front().at; }
  Level take() {
    level_ = coming_.front().level;
    coming_.pop_front();
    return level_;
  }
  Level level() const { return level_; }

 private:
  struct Change {
    Tick at;
    Level level;
  };
  const Tick delay_;
  Level level_ = tb::kLevelZ;
  std::deque<Change> coming_;
};

/// Derives from the pins when the memory shared by chip and user may be compared with the RTL's, and its last accesses.
class MemoryWatch {
 public:
  virtual ~MemoryWatch() = default;
  /// An input, or an output of the model, has a new level; in order of time.
  virtual void change(Tick at, PinNumber pin, Level level) = 0;
  /// The tick of the end of an access, once, after the change that ended it: the memories may be compared as they are
  /// then.
  virtual std::optional<Tick> take_end() = 0;
  /// True if that access can have changed it, or enough accesses have passed without comparison.
  virtual bool worth_a_look(Tick end) = 0;
  /// The memories were compared.
  virtual void compared(Tick end) = 0;
  /// The last access of the user, and of the chip, as text.
  virtual std::string last_of_user() const = 0;
  virtual std::string last_of_chip() const = 0;
};

/// A parameter of the chip that its RTL needs as well.
struct RtlParameter {
  const char* key;                   ///< of ChipKind::chip_keys()
  std::vector<std::uint32_t> words;  ///< its value, the lowest bits first
  int width;                         ///< bits
  bool usual;                        ///< it is the default
};

/// Co-simulation's interface to a kind of chip, ChipKind::rtl().
class RtlOf {
 public:
  virtual ~RtlOf() = default;
  /// Without those that only the harness needs, and without pins.
  virtual std::vector<RtlParameter> parameters(const tb::OwnSettings& chip) const = 0;
  virtual RtlTiming timing(const tb::OwnSettings& chip) const = 0;
  virtual std::unique_ptr<MemoryWatch> watch_memory() const = 0;
  /// The reference RTL with the parameters of `chip` and, if `fault` is not 0, a single fault of its list. Registers
  /// without reset begin with values that depend on `seed`. Throws tb::InputError if it was not built. Only with
  /// ChipKind::has_reference_rtl().
  virtual std::unique_ptr<Rtl> make_reference(const tb::OwnSettings& /*chip*/, unsigned /*fault*/,
                                              std::uint32_t /*seed*/) const {
    return nullptr;
  }
};

/// Makes the RTL of the chip with this name and these parameters; may throw tb::InputError.
using MakeRtl =
    std::function<std::unique_ptr<Rtl>(const std::string& name, const tb::ChipKind& kind, const tb::OwnSettings& chip)>;

constexpr std::uint32_t kUsualSeed = 1;

/// That of rtl_ref/: ChipKind::rtl() of each chip's kind.
MakeRtl reference_rtl(unsigned fault = 0, std::uint32_t seed = kUsualSeed);

}  // namespace dsdpv1::cosim
