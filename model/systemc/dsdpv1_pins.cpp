#include "model/systemc/dsdpv1_pins.hpp"

#include <string>
#include <utility>

#include "model/systemc/data_wires.hpp"

namespace dsdpv1::systemc {
namespace {

/// A bound CLK must have made its first window of edges by then; otherwise it is reported as dead.
const Tick kClockStart = 2 * BoundClock::kWindow * profibus::kTicksPerCycle;

}  // namespace

PinModule::PinModule(const sc_core::sc_module_name& name, const PinOptions& options)
    : ChipModule(name, options), clock_tolerance_ppm_(options.clock_tolerance_ppm) {
  watch(outputs_of(part()), 0);
  SC_HAS_PROCESS(PinModule);
  SC_METHOD(evaluate);  // the only process: SystemC would count a second one as a second driver of D
  sensitive << due_ << CLK << RESET << R_REQ << R_STA << CSR << RD << WR << A << D << PBRXD;
}

void PinModule::end_of_elaboration() {
  const struct {
    Pin pin;
    Out& port;
  } wires[] = {{Pin::kLReq, L_REQ},  {Pin::kLSta, L_STA}, {Pin::kPbtxd, PBTXD}, {Pin::kIntr0, INTR0},
               {Pin::kPbrts, PBRTS}, {Pin::kPbf, PBF},    {Pin::kBr, BR},       {Pin::kReady, READY}};
  for (const auto& wire : wires) connect(mask(wire.pin), wire.port);
  if (CLK.size() > 0) clock_ = std::make_unique<BoundClock>(clock_tolerance_ppm_);
}

void PinModule::evaluate() {
  if (fired_as_scheduled()) return evaluate_core();
  if (clock_) clock_edge();
  if (sc_core::sc_time_stamp() == sc_core::SC_ZERO_TIME) {
    begin();
    return;
  }
  const Tick now = present();
  advance(now);
  apply_inputs(now, !std::exchange(applied_, true));
  drive_pins(take_changed());
  if (!clock_) return schedule(now, chip().next_event());
  if (due_.triggered()) check_clock();
  plan_between_edges(now);
}

/// Neither an input nor the driver of D has changed: the chip drives and releases D at the user's own edges.
void PinModule::evaluate_core() {
  const Tick now = scheduled();
  advance(now);
  drive_pins(take_changed());
  schedule(now, chip().next_event());
}

void PinModule::begin() {
  user_d_ = level_of(D.read());
  drive_pins(take_changed());
  due_.notify(sc_core::sc_time::from_value(1));  // when the delta cycles of time 0 are over
}

void PinModule::clock_edge() {
  if (!CLK->event()) return;
  if (CLK->read())
    clock_->rising(sc_core::sc_time_stamp());
  else
    clock_->falling(sc_core::sc_time_stamp());
  if (const auto mhz = clock_->take_wrong_frequency()) {
    const std::string text = std::string(name()) + ": CLK is " + std::to_string(*mhz) + " MHz, expected 48 MHz +/- " +
                             std::to_string(clock_tolerance_ppm_) + " ppm";
    SC_REPORT_WARNING("/dsdpv1/clock", text.c_str());
  }
}

void PinModule::check_clock() {
  if (sc_core::sc_time_stamp() < to_time(kClockStart)) {
    due_.notify(to_time(kClockStart) - sc_core::sc_time_stamp());
  } else if (clock_->edges() < BoundClock::kWindow) {
    const std::string text = std::string(name()) + ": CLK made " + std::to_string(clock_->edges()) +
                             " rising edges in the first 20 us, 48 MHz makes 960; leave it unbound to do without";
    SC_REPORT_WARNING("/dsdpv1/clock", text.c_str());
  }
}

Tick PinModule::present() const { return clock_ ? clock_->chip_tick(sc_core::sc_time_stamp()) : chip_now(); }

/// Applies each changed pin, those of the host together, because their order matters.
void PinModule::apply_inputs(Tick at, bool first) {
  const bool user_drives_d = chip().level(Pin::kDOut) == kLevelZ;
  const bool access = CSR.event() || RD.event() || WR.event() || A.event() || D.event();
  const bool releases_d = std::exchange(user_drives_d_, user_drives_d) != user_drives_d;
  if (first || access || releases_d || R_REQ.event() || R_STA.event()) apply_host(at);
  if (first || PBRXD.event()) set(at, Pin::kPbrxd, PBRXD.read());
  if (first || RESET.event()) set(at, Pin::kReset, RESET.read());
}

void PinModule::apply_host(Tick at) {
  if (R_REQ.read()) set(at, Pin::kRReq, 1);
  if (R_STA.read()) set(at, Pin::kRSta, 1);
  set(at, Pin::kA, static_cast<Level>(A.read().to_uint()));
  if (D.event()) user_d_ = level_of(D.read());  // costly: four-valued
  set(at, Pin::kDIn, user_drives_d_ ? user_d_ : kLevelZ);
  if (!CSR.read()) set(at, Pin::kCsr, 0);
  set(at, Pin::kRd, RD.read());
  set(at, Pin::kWr, WR.read());
  set(at, Pin::kCsr, CSR.read());
  set(at, Pin::kRSta, R_STA.read());
  set(at, Pin::kRReq, R_REQ.read());
}

void PinModule::drive_pins(std::uint32_t pins) {
  drive(pins);
  if ((pins & mask(Pin::kDOut)) != 0) D.write(wires(chip().level(Pin::kDOut)));
}

}  // namespace dsdpv1::systemc
