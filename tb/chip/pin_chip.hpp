#pragma once
// Any chip driven by its pins as a station of the segment. Kinds derive the connection between pins and user CPU.
#include <memory>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/line_driver.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::tb {

/// The wiring of a chip's pins on its board.
struct BoardPins {
  PinNumber reset = 0, rxd = 0, txd = 0, rts = 0, interrupt = 0;
  PinMask told = 0;  ///< outputs whose changes are reported to PinChip::host_pin_changed
};

/// Wired as on a board with an RS-485 driver: the pin `rts` enables it, `txd` is its input, `rxd` always receives the
/// line.
class PinChip : public ChipView, public bus::Agent, private bus::Listener {
 public:
  /// `watched`: pins whose changes are reported, `late`: as in ChipRequest.
  PinChip(const std::string& name, std::unique_ptr<PinDevice> device, const PinTable& pins, const BoardPins& places,
          PinMask watched, bus::Segment& segment, bool late = false);

  void set_reset(Tick at, bool level) override;
  void reset_host(Tick /*at*/) override {}
  bus::StationId station() const override { return station_; }
  ChipStatus status() const override;
  std::uint8_t address() const override { return device_->address(); }
  Level level(PinNumber pin) const override { return device_->level(pin); }
  std::uint8_t peek(std::uint16_t address) const override { return device_->peek(address); }
  void sync(Tick now) override { run(now); }
  bool tells_runs() const override { return true; }
  void pause_access() override { pauses_ = true; }
  void watch(Tick now, PinMask pins) override;

  // --- For drivers of the user's pins outside the bench. The bench has advanced to `at`.
  void set_pin(Tick at, PinNumber pin, Level level);
  Level sample(Tick at) { return device().sample(at); }
  void poke(Tick now, std::uint16_t address, std::uint8_t value);
  // Accesses by the device's RegisterPort, if it has one.
  bool has_registers() { return device_->registers() != nullptr; }
  std::uint8_t load(Tick at, std::uint16_t address);
  void store(Tick at, std::uint16_t address, std::uint8_t value);

  Tick next() const override;
  void run(Tick now) override;

 protected:
  bool acts_on_events() const { return listener_ == nullptr || listener_->acts_on_events(); }
  /// Access for all calls that advance the chip: first passes pending changes of the line to the device.
  PinDevice& device() {
    announce();
    hear_line();
    return *device_;
  }
  void hear_line() {
    catching_up_ = true;
    segment_.hear(station_);
    catching_up_ = false;
  }
  /// Call after each operation on the device.
  void plan_again() {
    announce(next());
    update_hearing();
  }
  /// The chip is about to act at `at`, or to receive a change: apply edges that were put off (`put_off_`) first.
  virtual void catch_up_host(Tick /*at*/) {}
  /// One of BoardPins::told has changed.
  virtual void host_pin_changed(Tick /*at*/, PinNumber /*pin*/, Level /*level*/) {}
  /// True if changes of the user's pins are reported; true if those of a whole access may be so at its end.
  bool reports_host() const { return reports_host_; }
  bool reports_late() const { return reports_late_; }
  /// Reports changes, in order of time, of which inputs may be to the present level.
  void report_edges(PinEdge* first, PinEdge* last);
  /// Reports the inputs from `first` to `last` that have changed since their last report, in the order of their
  /// numbers; all except `rxd`, if they are wanted.
  void report_host(Tick at, PinNumber first, PinNumber last) {
    if (reports_host_) report_inputs(at, first, last);
  }
  void report_inputs(Tick at, PinNumber first, PinNumber last);
  /// Sets an input to this level without a report.
  void begin_input(PinNumber pin, Level level) { inputs_.at(pin) = level; }

  const std::unique_ptr<PinDevice> device_;
  bool put_off_ = false;  ///< an access is in progress whose edges are set when the chip advances beyond them
  bool pauses_ = false;   ///< since an edge of an access, something was reported that may cause an action

 private:
  void catch_up(Tick at) {
    if (put_off_) catch_up_host(at);
  }
  void begin_watch(PinMask pins, bool late);
  void line_changed(Tick at, bool level) override;
  bool run_begins(const bus::CharacterRun& run) override;
  void runs_passed(std::uint64_t for_stations) override;
  void run_cut(Tick at, bool level) override;
  void update_hearing();
  void send_run();
  void pin_changed(Tick at, PinNumber pin, Level level);
  void tell(Tick at, PinNumber pin, Level level);

  const PinTable& pins_;
  const BoardPins places_;
  const PinMask data_;  ///< pins of a bus, whose changes cause no action
  bus::Segment& segment_;
  bus::StationId station_;
  LineDriver line_;
  bool reports_host_ = false, reports_late_ = false, reports_rxd_ = false, reports_txd_ = false, catching_up_ = false;
  bool own_run_ = false, hides_txd_ = false;
  std::vector<Level> inputs_;  ///< by pin, as last reported
};

}  // namespace dsdpv1::tb
