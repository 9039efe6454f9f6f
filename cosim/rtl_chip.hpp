#pragma once
// RTL as a chip: pins in, pin changes out, at the same ticks as the model's.
//
// A change at tick t is seen by the first rising edge strictly after t (P9), because at a tick with an edge the edge is
// evaluated first; inputs that act at once (RtlTiming) are evaluated at their own tick, as are the edges of a second
// clock. An output may follow its register later.
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

/// When a tick is evaluated. A second clock acts on registers as they were before an edge of CLK at the same tick; to
/// be exact to the tick, both are evaluated together, after the end of the tick. It only matters if a byte is loaded at
/// the very edge with which it falls, at a clock that SP2 does not allow.
enum class TickEnds : std::uint8_t {
  kAtOnce,  ///< CLK, then each input as it is set; RtlTiming::data, which the second clock sees at its previous level,
            ///< after the end of the tick
  kLater,   ///< CLK and the second clock together, then the other inputs, when time advances beyond the tick
};

class RtlChip {
 public:
  /// The inputs have the levels of `fresh`, a device before its first call, which is in reset. Without a second clock
  /// ticks are evaluated at once.
  RtlChip(std::unique_ptr<Rtl> rtl, const tb::ChipKind& kind, const tb::OwnSettings& chip, const tb::PinDevice& fresh,
          TickEnds ends = TickEnds::kAtOnce);

  /// Changes an input pin at `at` (>= every earlier call's), after evaluating everything up to and including `at`.
  void set(Tick at, PinNumber pin, Level level);
  /// Evaluates every edge of CLK up to and including tick `to`; with TickEnds::kLater those before `to`.
  void advance(Tick to);
  /// The next edge of CLK, rising or falling, or the delayed output's next change.
  Tick next_event() const { return std::min(next_edge_, delayed_.next()); }
  Tick now() const { return now_; }
  /// A pin's level; kLevelX only if the design reports unknown levels.
  Level level(PinNumber pin) const;
  /// Reports changes of the output pins in `pins`. One sink; a second call replaces it.
  void watch(const tb::PinSink& sink, tb::PinMask pins);
  const Rtl& rtl() const { return *rtl_; }
  TickEnds ends() const { return ends_; }

 private:
  struct Change {
    Tick at;
    PinNumber pin;
    Level level;
  };
  using Levels = std::array<Level, kMostPins>;
  void power_up(PinNumber reset);
  /// An input has this level from the next evaluation on.
  void apply(PinNumber pin, Level level) { levels_.at(pin) = last_.at(pin) = level; }
  bool acts_at_once(PinNumber pin) const { return (timing_.at_once & tb::mask_of(pin)) != 0; }
  void end_tick();
  void apply_held();
  void clock_edge();
  void eval(Tick at);
  void move_delayed(Tick to);
  void tell(Tick at, PinNumber pin, Level level);

  std::unique_ptr<Rtl> rtl_;
  const RtlTiming timing_;
  const TickEnds ends_;
  std::vector<PinNumber> outputs_;
  Levels levels_{}, last_{};  ///< outputs of the last evaluation; during one, of the one before it: equal otherwise
  bool clk_ = false;
  tb::PinSink sink_;
  tb::PinMask watched_ = 0;
  Tick next_edge_ = 0, now_ = 0;
  std::vector<Change> held_;  ///< inputs at tick `now_`, which has not ended
  DelayedOutput delayed_;
};

}  // namespace dsdpv1::cosim
