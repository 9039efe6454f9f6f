#pragma once
// Shared by the modules with the pins of a chip: CLK, bound or not, and the order of inputs, core and outputs.
#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <utility>

#include "model/systemc/bound_clock.hpp"
#include "model/systemc/core_module.hpp"
#include "model/systemc/optional_port.hpp"

namespace dsdpv1::systemc {

/// CLK unbound: the rising edge of cycle n is at simulation tick n * 250 + phase, and only changes of pins cost events.
/// CLK bound: cycle n is its n-th rising edge, counted from 0; `phase` is not used.
///
/// An input that changes at the time of a rising edge is seen by the next one (ruling P9). The levels at the end of
/// time 0 are the initial ones: delta cycles at time 0 are not edges. `Base` is the chip's CoreModule.
template <class Base>
class PinsOf : public Base {
 public:
  template <class T>
  using In = sc_core::sc_in<T>;
  using Out = OptionalOut;  ///< all of one wire may stay unbound

  /// 48 MHz, optional.
  OptionalIn CLK{"CLK"};

 protected:
  /// `options`: those of Base, and clock_tolerance_ppm.
  template <class Options>
  PinsOf(const sc_core::sc_module_name& name, const Options& options)
      : Base(name, options), clock_tolerance_ppm_(options.clock_tolerance_ppm) {}

  void end_of_elaboration() override {
    if (CLK.size() > 0) clock_ = std::make_unique<BoundClock>(clock_tolerance_ppm_);
  }

  /// The module's only process: SystemC would count a second one as a second driver of a data bus.
  void evaluate() {
    if (this->fired_as_scheduled()) return evaluate_core();
    if (clock_) clock_edge();
    if (sc_core::sc_time_stamp() == sc_core::SC_ZERO_TIME) {
      begin();
      return;
    }
    const Tick now = this->now();
    this->advance(now);
    apply_inputs(now, !std::exchange(applied_, true));
    drive_pins(this->take_changed());
    if (!clock_) return this->schedule(now, this->chip().next_event());
    if (this->due_.triggered()) check_clock();
    plan_between_edges(now);
  }

  /// Reads the levels at time 0 that apply_inputs() does not.
  virtual void begin_inputs() = 0;
  /// Applies inputs that have changed; all of them the `first` time.
  virtual void apply_inputs(Tick at, bool first) = 0;
  virtual void drive_pins(std::uint32_t pins) = 0;

  // For save() and restore(). The pins have all that the core needs, so it may be in the middle of an access.
  void settle() override { this->advance(now()); }
  void store_module(profibus::StateWriter& archive) override {
    if (clock_) clock_->store(archive, sc_core::sc_time_stamp());
  }
  void store_module(profibus::StateReader& archive) override {
    if (clock_) clock_->store(archive, sc_core::sc_time_stamp());
    begin_inputs();
    applied_ = false;
  }
  bool has_clock() const { return clock_ != nullptr; }

 private:
  Tick now() const { return clock_ ? clock_->chip_tick(sc_core::sc_time_stamp()) : this->chip_now(); }

  /// CLK is bound, the chip is at `now`: plans events between two edges of CLK.
  virtual void plan_between_edges(Tick /*now*/) {}

  /// Neither an input nor the driver of a data bus has changed: the chip drives and releases it at the user's own
  /// edges.
  void evaluate_core() {
    const Tick now = this->scheduled();
    this->advance(now);
    drive_pins(this->take_changed());
    this->schedule(now, this->chip().next_event());
  }
  void begin() {
    begin_inputs();
    drive_pins(this->take_changed());
    this->due_.notify(sc_core::sc_time::from_value(1));  // when the delta cycles of time 0 are over
  }
  void clock_edge() {
    if (!CLK->event()) return;
    if (CLK->read())
      clock_->rising(sc_core::sc_time_stamp());
    else
      clock_->falling(sc_core::sc_time_stamp());
    if (const auto mhz = clock_->take_wrong_frequency())
      warn("CLK is " + std::to_string(*mhz) + " MHz, expected 48 MHz +/- " + std::to_string(clock_tolerance_ppm_) +
           " ppm");
  }
  /// A bound CLK must have made its first window of edges by then; otherwise it is reported as dead.
  void check_clock() {
    const sc_core::sc_time start = to_time(2 * BoundClock::kWindow * profibus::kTicksPerCycle);
    if (sc_core::sc_time_stamp() < start) {
      this->due_.notify(start - sc_core::sc_time_stamp());
    } else if (clock_->edges() < BoundClock::kWindow) {
      warn("CLK made " + std::to_string(clock_->edges()) +
           " rising edges in the first 20 us, 48 MHz makes 960; leave it unbound to do without");
    }
  }
  void warn(const std::string& what) const {
    SC_REPORT_WARNING("/dsdpv1/clock", (std::string(this->name()) + ": " + what).c_str());
  }

  double clock_tolerance_ppm_;
  std::unique_ptr<BoundClock> clock_;  ///< only while CLK is bound
  bool applied_ = false;               ///< the initial levels
};

/// Options of a module with pins, beside those of its chip.
struct ClockOptions {
  /// (p) A bound CLK whose mean over BoundClock::kWindow edges deviates more from 48 MHz is reported once as
  /// /dsdpv1/clock. The default is the 0.3 % that EN 50170 allows for a station's bit rate.
  double clock_tolerance_ppm = 3000;
};

}  // namespace dsdpv1::systemc
