#pragma once
// RTL behind the interface of dsdpv1::Chip: pins in, pin changes out, at the same ticks.
//
// A change at tick t is seen by the first rising edge strictly after t (P9), because at a tick with an edge the edge is
// evaluated first; the strobes of the host port, RESET and XSS are evaluated at their own tick.
//
// Of the DSDPV1-RSU, SCK's edges are evaluated at their own tick, too; the pin MISO follows its register after
// `spi_miso_delay` (docs/microarchitecture_rsu.md, 5.1).
#include <algorithm>
#include <deque>
#include <memory>
#include <vector>

#include "cosim/rtl_trace.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::cosim {

/// When a tick is evaluated. The DSDPV1-RSU's SCK acts on registers as they were before an edge of CLK at the same
/// tick, so who wants that to the tick evaluates both at once: when the tick is over. Only where a byte is loaded at
/// the very edge that SCK falls with does it matter, at a clock of SCK that SP2 does not allow.
enum class TickEnds : std::uint8_t {
  kAtOnce,  ///< CLK, then each input as it is set; MOSI, of which SCK sees what it was before, when the tick is over
  kLater,   ///< CLK and SCK together, then the other inputs, when somebody goes on beyond the tick
};

class RtlChip {
 public:
  /// RESET is low, the other inputs are as dsdpv1::Chip has them before the first call.
  explicit RtlChip(std::unique_ptr<RtlTop> top, const dsdpv1::Config& config = {}, TickEnds ends = TickEnds::kAtOnce);

  /// Changes an input pin at `at` (>= every earlier call's), after everything up to and including `at` was evaluated.
  void set(Tick at, Pin pin, Level level);
  /// Evaluates every edge of CLK up to and including tick `to`; with TickEnds::kLater those before it.
  void advance(Tick to);
  /// The next edge of CLK, rising or falling, or MISO's next change.
  Tick next_event() const { return coming_.empty() ? next_edge_ : std::min(next_edge_, coming_.front().at); }
  Tick now() const { return now_; }
  /// A pin's level; kLevelX only when the design tells what it does not know.
  Level level(Pin pin) const;
  /// Reports changes of the output pins in `pins`. One sink; a second call replaces it.
  void watch(const dsdpv1::PinSink& sink, std::uint32_t pins);
  const RtlTop& top() const { return *top_; }

 private:
  struct Change {
    Tick at;
    Pin pin;
    Level level;
  };
  void power_up();
  void apply(Pin pin, Level level);
  void apply_serial(Pin pin, Level level);
  void end_tick();
  void take_mosi();
  Level mosi() const;
  void clock_edge();
  void eval(Tick at);
  void report(Tick at, const RtlOutputs& before);
  void miso_register(Tick at, const RtlOutputs& before);
  void move_miso(Tick to);
  void tell(Tick at, Pin pin, Level level);

  std::unique_ptr<RtlTop> top_;
  TimedTop* timed_;  ///< null: the design does not want to know the time
  dsdpv1::PinSink sink_;
  std::uint32_t watched_ = 0;
  RtlOutputs last_;
  Level d_in_ = dsdpv1::kLevelZ;
  Tick next_edge_ = 0, now_ = 0;
  const bool rsu_;
  const TickEnds ends_;
  const Tick miso_delay_;
  std::vector<Change> held_;   ///< inputs at tick `now_`, which is not over
  std::deque<Change> coming_;  ///< of MISO
  Level miso_ = dsdpv1::kLevelZ;
};

}  // namespace dsdpv1::cosim
