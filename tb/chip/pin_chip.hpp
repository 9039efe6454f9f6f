#pragma once
// Any chip driven by its pins as a station of the segment. What its kind has between pins and user CPU is derived.
#include <memory>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/line_driver.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::tb {

/// Which of a chip's pins are wired to what on its board.
struct BoardPins {
  PinNumber reset = 0, rxd = 0, txd = 0, rts = 0, interrupt = 0;
  PinMask told = 0;  ///< outputs whose changes PinChip::host_pin_changed is told of
};

/// Wired as on a board with an RS-485 driver: the pin `rts` enables it, `txd` is what it drives, `rxd` hears the line
/// at all times.
class PinChip : public ChipView, public bus::Agent, private bus::Listener {
 public:
  /// `watched`: pins whose changes are told (ChipRequest::watched).
  PinChip(const std::string& name, std::unique_ptr<PinDevice> device, const PinTable& pins, const BoardPins& places,
          PinMask watched, bus::Segment& segment);

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

  // --- For somebody at the user's pins who is no user CPU of the bench. The bench has come to `at`.
  void set_pin(Tick at, PinNumber pin, Level level);
  Level sample(Tick at) { return device().sample(at); }
  void poke(Tick now, std::uint16_t address, std::uint8_t value);

  Tick next() const override;
  void run(Tick now) override;

 protected:
  /// Whoever moves the chip takes it from here: the device is first told what it was not told of the line.
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
  /// What was done to the device is over.
  void plan_again() {
    announce(next());
    update_hearing();
  }
  /// The chip is about to act at `at`, or to hear something: edges that were put off, `put_off_`, come first.
  virtual void catch_up_host(Tick /*at*/) {}
  /// One of BoardPins::told has changed.
  virtual void host_pin_changed(Tick /*at*/, PinNumber /*pin*/, Level /*level*/) {}
  /// Whether changes of the user's pins are told.
  bool reports_host() const { return reports_host_; }
  /// Tells those inputs from `first` to `last` that have changed since they were told last, in the order of their
  /// numbers; all but `rxd`: if they are wanted.
  void report_host(Tick at, PinNumber first, PinNumber last) {
    if (reports_host_) report_inputs(at, first, last);
  }
  void report_inputs(Tick at, PinNumber first, PinNumber last);
  /// An input has this level without a report.
  void begin_input(PinNumber pin, Level level) { inputs_.at(pin) = level; }

  const std::unique_ptr<PinDevice> device_;
  bool put_off_ = false;  ///< an access is under way whose edges are set when the chip goes beyond them
  bool pauses_ = false;   ///< since an edge of an access, somebody was told something on which they may act

 private:
  void catch_up(Tick at) {
    if (put_off_) catch_up_host(at);
  }
  void begin_watch(PinMask pins);
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
  const PinMask data_;  ///< pins of a bus, whose changes nobody acts on
  bus::Segment& segment_;
  bus::StationId station_;
  LineDriver line_;
  bool reports_host_ = false, reports_rxd_ = false, reports_txd_ = false, catching_up_ = false;
  bool own_run_ = false, hides_txd_ = false;
  std::vector<Level> inputs_;  ///< by pin, as told last
};

}  // namespace dsdpv1::tb
