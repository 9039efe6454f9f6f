#pragma once
// RTL behind the interface of dsdpv1::Chip: pins in, pin changes out, at the same ticks.
//
// A change at tick t is seen by the first rising edge strictly after t (P9), because at a tick with an edge the edge is
// evaluated first; the strobes of the host port and RESET are evaluated at their own tick.
#include <memory>

#include "model/dsdpv1/pins.hpp"
#include "tb/dsdpv1/cosim/rtl_trace.hpp"

namespace dsdpv1::cosim {

class RtlChip {
 public:
  /// RESET is low, the other inputs are as dsdpv1::Chip has them before the first call.
  explicit RtlChip(std::unique_ptr<RtlTop> top);

  /// Changes an input pin at `at` (>= every earlier call's), after everything up to and including `at` was evaluated.
  void set(Tick at, Pin pin, Level level);
  /// Evaluates every edge of CLK up to and including tick `to`.
  void advance(Tick to);
  /// The next edge of CLK, rising or falling.
  Tick next_event() const { return next_edge_; }
  Tick now() const { return now_; }
  /// A pin's level; kLevelX only when the design tells what it does not know.
  Level level(Pin pin) const;
  /// Reports changes of the output pins in `pins`. One sink; a second call replaces it.
  void watch(const dsdpv1::PinSink& sink, std::uint32_t pins);
  const RtlTop& top() const { return *top_; }

 private:
  void power_up();
  void apply(Pin pin, Level level);
  void eval(Tick at);
  void report(Tick at, const RtlOutputs& before);

  std::unique_ptr<RtlTop> top_;
  TimedTop* timed_;  ///< null: the design does not want to know the time
  dsdpv1::PinSink sink_;
  std::uint32_t watched_ = 0;
  RtlOutputs last_;
  Level d_in_ = dsdpv1::kLevelZ;
  Tick next_edge_ = 0, now_ = 0;
};

}  // namespace dsdpv1::cosim
