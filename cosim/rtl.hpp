#pragma once
// RTL of a chip beside the model: the one face between them. Levels are by the numbers of the kind's PinTable.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::cosim {

using bus::Tick;
using tb::Level;
using tb::PinNumber;

using tb::kMostPins;
constexpr PinNumber kNoPin = kMostPins;
/// The number behind the last one.
inline PinNumber end_of(const tb::PinTable& pins) { return static_cast<PinNumber>(pins.size()); }

/// A design in RTL. Nobody tells it the time: it has CLK.
class Rtl {
 public:
  virtual ~Rtl() = default;
  /// Lets it settle with CLK and the inputs of `levels`, edges included, and leaves its outputs there: kLevelZ of one
  /// that is released, kLevelX of one that it does not know.
  virtual void eval(bool clk, Level* levels) = 0;
  /// The memory that it shares with its user, writes on their way included, ChipKind::cells() bytes. False: it cannot
  /// be seen.
  virtual bool memory(std::uint8_t* /*image*/) const { return false; }
  /// The next evaluation is that of `at`, which never decreases; for a trace of its inside. None is before tick 0.
  virtual void moment(Tick /*at*/) {}
};

/// How the ticks of inputs become evaluations.
struct RtlTiming {
  tb::PinMask at_once = 0;   ///< inputs that act at their own tick; others are looked at by an edge of CLK or of these
  PinNumber clock = kNoPin;  ///< a second clock: where both have an edge they are evaluated together, see RtlChip
  PinNumber data = kNoPin;   ///< the input that `clock` takes as it was before
  PinNumber delayed = kNoPin;  ///< an output whose changes between 0 and 1 come `delay` ticks later
  Tick delay = 0;
};

/// RtlTiming::delayed. What releases it or drives it again acts at once, and what is on its way is dropped.
class DelayedOutput {
 public:
  explicit DelayedOutput(Tick delay) : delay_(delay) {}

  /// The register changes. True: so does the pin, now.
  bool change(Tick at, Level then, Level now) {
    if (now != tb::kLevelZ && then != tb::kLevelZ) {
      coming_.push_back({at + delay_, now});
      return false;
    }
    coming_.clear();
    level_ = now;
    return true;
  }
  /// When the pin changes by itself; the level that it has from then on.
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

/// What the pins say of the memory that a chip shares with its user: when it may be compared with the RTL's, and who
/// had it last.
class MemoryWatch {
 public:
  virtual ~MemoryWatch() = default;
  /// An input, or an output of the model, has a new level; in order of time.
  virtual void change(Tick at, PinNumber pin, Level level) = 0;
  /// The tick of the end of an access, once after the change that has ended it: the memories may be compared as they
  /// are then.
  virtual std::optional<Tick> take_end() = 0;
  /// Whether that access can have changed it, or enough of them have gone by unseen.
  virtual bool worth_a_look(Tick end) = 0;
  /// They were compared.
  virtual void compared(Tick end) = 0;
  /// The last access of the user, and of the chip, in words.
  virtual std::string last_of_user() const = 0;
  virtual std::string last_of_chip() const = 0;
};

/// What co-simulation needs of a kind of chip, ChipKind::rtl().
class RtlOf {
 public:
  virtual ~RtlOf() = default;
  virtual RtlTiming timing(const tb::OwnSettings& chip) const = 0;
  virtual std::unique_ptr<MemoryWatch> watch_memory() const = 0;
  /// The reference RTL with the parameters of `chip` and, unless it is 0, a single fault of its list. What is not reset
  /// begins with values that depend on `seed`. Throws tb::InputError when it was not built.
  virtual std::unique_ptr<Rtl> make_reference(const tb::OwnSettings& chip, unsigned fault,
                                              std::uint32_t seed) const = 0;
};

/// Makes the RTL of the chip with this name and these parameters; may throw tb::InputError.
using MakeRtl =
    std::function<std::unique_ptr<Rtl>(const std::string& name, const tb::ChipKind& kind, const tb::OwnSettings& chip)>;

constexpr std::uint32_t kUsualSeed = 1;

/// That of rtl_ref/: ChipKind::rtl() of each chip's kind.
MakeRtl reference_rtl(unsigned fault = 0, std::uint32_t seed = kUsualSeed);

}  // namespace dsdpv1::cosim
