#pragma once
// A chip driven by its pins, the core or RTL, as a station of the segment.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "kinds/dsdpv1/chip/dsdpv1_view.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/pins/inside_watch.hpp"
#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"
#include "tb/chip/line_driver.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::tb {

/// Wired as on a board with an RS-485 driver: PBRTS enables it, PBTXD is what it drives, PBRXD hears the line at all
/// times.
class PinChip : public Dsdpv1View, public bus::Agent, private bus::Listener, private user_cpu::HostBus {
 public:
  /// The core itself.
  PinChip(const std::string& name, const dsdpv1::Config& config, std::uint32_t watched, bus::Segment& segment);
  PinChip(const std::string& name, std::unique_ptr<PinDevice> device, std::uint32_t watched, bus::Segment& segment);

  /// Holds the straps of a DSDPV1-RSU, before anything else.
  void strap(const Straps& levels);
  void set_reset(Tick at, bool level) override;
  void reset_host(Tick at) override;
  user_cpu::HostBus& host_bus() override { return *this; }
  bus::StationId station() const override { return station_; }
  const dsdpv1::Chip& core() const override { return device_->core(); }
  void sync(Tick now) override { run(now); }
  bool tells_runs() const override { return true; }
  void pause_access() override { pauses_ = true; }

  // --- For somebody at the user's pins who is no user CPU of the bench. The bench has come to `at`.
  void set_pin(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  dsdpv1::Level sample(Tick at) { return device().sample(at); }
  /// From now on changes of these pins are told.
  void watch(Tick now, PinMask pins) override;

  /// From now on inner signals are told: of a core with Engine::kStep.
  void watch_inside() { inside_.emplace(); }

  Tick next() const override;
  void run(Tick now) override;

 private:
  /// Whoever moves the chip takes it from here: what it was not told of the line comes first.
  PinDevice& device() {
    announce();
    hear_line();
    return chip_;
  }
  void hear_line() {
    catching_up_ = true;
    segment_.hear(station_);
    catching_up_ = false;
  }
  void hear_runs() const override { segment_.hear_runs(station_); }
  void catch_up_access(Tick at);
  user_cpu::PinHostBus& pins() {
    device();
    return *pins_;
  }
  void begin_watch(PinMask pins);
  void line_changed(Tick at, bool level) override;
  bool run_begins(const bus::CharacterRun& run) override;
  void runs_passed(std::uint64_t for_stations) override;
  void run_cut(Tick at, bool level) override;
  void update_hearing();
  void send_run();
  void run_edges_singly(user_cpu::PinHostBus& host, Tick until);
  void pin_changed(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  void report_access(Tick at);
  /// Those of the inputs from `first` to `last` that have changed; of all but PBRXD, if they are wanted.
  void report_host(Tick at, dsdpv1::Pin first, dsdpv1::Pin last);
  void report_inputs(Tick at, dsdpv1::Pin first, dsdpv1::Pin last);

  // The host bus is that of the pins; what it does to the input pins is reported.
  void set_serial(Tick at, dsdpv1::Pin pin, bool level) override;
  bool miso(Tick at) override;
  void set_r_req(Tick at, bool level) override;
  void set_r_sta(Tick at, bool level) override;
  bool l_req(Tick at) override { return pins().l_req(at); }
  bool l_sta(Tick at) override { return pins().l_sta(at); }
  bool intr0(Tick at) override { return pins().intr0(at); }
  unsigned lamps(Tick at) override { return pins().lamps(at); }
  void begin(Tick at, const user_cpu::Access& access, const AccessTiming& timing) override;
  Tick next_edge() const override { return pins_->next_edge(); }
  bool put_off() override;
  void run_edges(Tick until) override;
  Tick end() const override { return pins_->end(); }
  std::uint8_t read_value() const override { return pins_->read_value(); }
  bool last_read_was_bad() const override { return pins_->last_read_was_bad(); }

  std::unique_ptr<PinDevice> device_;
  PinDevice& chip_;
  std::optional<user_cpu::PinHostBus> pins_;
  bus::Segment& segment_;
  bus::StationId station_;
  LineDriver line_;
  std::optional<InsideWatch> inside_;
  bool reports_host_ = false, reports_rxd_ = false, reports_txd_ = false, catching_up_ = false;
  bool own_run_ = false, hides_txd_ = false;
  bool put_off_ = false;  ///< an access is under way whose edges are set when the chip goes beyond them
  bool pauses_ = false;   ///< since an edge of an access, somebody was told something on which they may act
  std::array<dsdpv1::Level, dsdpv1::kRsuPinCount> inputs_{};  ///< of the inputs, as told last
};

}  // namespace dsdpv1::tb
