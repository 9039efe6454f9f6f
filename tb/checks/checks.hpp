#pragma once
// The rules of the user's side, judged from outside: the pins of ONE chip and the telegrams on the line, nothing of
// what is behind the pins. So they hold the same way for every user CPU, every engine and foreign RTL.
//
//   checks::Checks checks(limits);
//   checks.on_violation = ...;
//   checks.pin(at, pin, level);    // every change of the pins in kPins and of all inputs, in order of time
//   checks.telegram(telegram);     // from bus::Monitor
//   checks.finish(end);
//   checks.record(Check::kTs).worst_margin
//
// docs/checks.md has the table of the checks.
#include <functional>

#include "tb/checks/cell_rules.hpp"
#include "tb/checks/ownership.hpp"
#include "tb/checks/port_timing.hpp"
#include "tb/checks/recorder.hpp"
#include "tb/checks/service.hpp"

namespace checks {

class Checks : private AccessSink {
 public:
  /// The output pins that must be watched; the inputs are all needed.
  static constexpr std::uint32_t kPins = dsdpv1::mask(dsdpv1::Pin::kLReq) | dsdpv1::mask(dsdpv1::Pin::kLSta) |
                                         dsdpv1::mask(dsdpv1::Pin::kDOut) | dsdpv1::mask(dsdpv1::Pin::kIntr0) |
                                         dsdpv1::mask(dsdpv1::Pin::kPbrts);

  explicit Checks(const Limits& limits = {})
      : recorder_(limits, history_),
        ownership_(recorder_),
        port_(recorder_, *this),
        cells_(recorder_),
        service_(recorder_) {}
  Checks(const Checks&) = delete;
  Checks& operator=(const Checks&) = delete;

  /// A change of a pin. The first changes are those from the levels of a chip fresh from construction
  /// (dsdpv1::Chip::set). Ticks never go back; pins that change at the same tick may come in any order.
  void pin(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  /// The user begins a read, told before its first edge, and samples D at `sample`. Only for a user CPU that tells: at
  /// the pins nobody sees it.
  void read(Tick sample) { port_.read(sample); }
  /// A telegram that has ended, of any station, heard at `now`.
  void telegram(Tick now, const bus::WireTelegram& telegram);
  /// Once, at the end of the run.
  void finish(Tick end);

  const Record& record(Check check) const { return recorder_.record(check); }
  const Limit& limit(Check check) const { return recorder_.limit(check); }
  void on_violation(std::function<void(const Violation&)> sink) { recorder_.on_violation = std::move(sink); }

 private:
  void reset_pin(Tick at, bool level);
  void end_hold_before(Tick at);
  void handshake(Tick at, dsdpv1::Pin pin, bool level);
  void access_began(Tick at) override;
  void access_ended(Tick at) override;
  void accessed(const Access& access) override;

  PinHistory history_;
  Recorder recorder_;
  Ownership ownership_;
  PortTiming port_;
  CellRules cells_;
  Service service_;
  bool in_reset_ = true;
  bool holding_ = false;          ///< a hold runs from R_STA's rise to the time that R_REQ and R_STA are both low again
  std::optional<Tick> hold_end_;  ///< judged when time goes on: a RESET at the same tick makes it void
};

}  // namespace checks
