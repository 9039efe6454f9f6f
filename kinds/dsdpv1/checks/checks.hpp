#pragma once
// The rules of the DSDPV1's user side: handshake, host port, cells of the DPRAM, service.
//
//   checks::Checks checks(limits);
//   checks.on_violation = ...;
//   checks.pin(at, pin, level);    // every change of the pins in kPins, in order of time
//   checks.telegram(telegram);     // from bus::Monitor
//   checks.finish(end);
//   checks.record(Check::kTs).worst_margin
//
// docs/checks.md has the table of the checks.
#include <functional>
#include <optional>
#include <utility>

#include "kinds/dsdpv1/checks/cell_rules.hpp"
#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/ownership.hpp"
#include "kinds/dsdpv1/checks/port_timing.hpp"
#include "kinds/dsdpv1/checks/serial_settings.hpp"
#include "kinds/dsdpv1/checks/service.hpp"
#include "kinds/dsdpv1/checks/spi_frames.hpp"
#include "kinds/dsdpv1/checks/spi_timing.hpp"
#include "kinds/dsdpv1/checks/uart_frames.hpp"
#include "kinds/dsdpv1/checks/user_duties.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"
#include "tb/chip/checks/chip_checks.hpp"
#include "tb/chip/checks/own_station.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class Checks : public ChipChecks, private AccessSink {
 public:
  /// All pins of table 1 except the line, which the monitor receives, and PBF, BR, READY; PBRTS shows who sends.
  static constexpr std::uint32_t kPins =
      dsdpv1::kCommonPins &
      ~(dsdpv1::mask(dsdpv1::Pin::kPbrxd) | dsdpv1::mask(dsdpv1::Pin::kPbtxd) | dsdpv1::mask(dsdpv1::Pin::kPbf) |
        dsdpv1::mask(dsdpv1::Pin::kBr) | dsdpv1::mask(dsdpv1::Pin::kReady));

  /// The pins of a part that the checks need.
  static constexpr std::uint32_t pins(Part part) {
    return has_serial_ports(part) ? kPins | dsdpv1::kSerialPins : kPins;
  }

  /// `serial`: straps and parameters; later changes of a strap are followed.
  explicit Checks(const Limits& limits = Limits(rules()), Part part = {}, const SerialSettings& serial = {})
      : pins_(pins(part)),
        settings_(serial),
        history_(tb::pins_of(part)),
        recorder_(rules(part), limits, history_),
        ownership_(recorder_),
        port_(recorder_, *this),
        cells_(recorder_),
        service_(recorder_, station_),
        duties_(recorder_, station_),
        spi_(recorder_, settings_),
        frames_(recorder_, settings_, station_, duties_),
        uart_(recorder_, settings_, duties_) {}
  Checks(const Checks&) = delete;
  Checks& operator=(const Checks&) = delete;

  void pin(Tick at, tb::PinNumber pin, tb::Level level) override {
    this->pin(at, static_cast<dsdpv1::Pin>(pin), level);
  }
  void pins(const tb::PinEdge* first, const tb::PinEdge* last) override;
  void pin(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  void read(Tick sample) override { port_.read(sample); }
  void hears_looks() override { ownership_.hears_looks(); }
  void looked(tb::PinNumber pin, Tick at) override { ownership_.looked(static_cast<dsdpv1::Pin>(pin), at); }
  void telegram(Tick now, const bus::WireTelegram& telegram) override;
  void finish(Tick end) override;
  void event(const profibus::Event& event) override;

  /// With SPI and UART the parallel port and its handshake are unused (R14), and telegrams show the cells. Refusals
  /// need the chip's events, looks a user CPU that tells them.
  bool applies(CheckId check) const override;
  const Record& record(CheckId check) const override { return recorder_.record(check); }
  const Limit& limit(CheckId check) const override { return recorder_.limit(check); }
  void on_violation(std::function<void(const Violation&)> sink) override { recorder_.on_violation = std::move(sink); }

 private:
  static constexpr Level kSpi = 1, kUart = 2;  // R2; 3 as 0

  bool serial() const { return settings_.mode == kSpi || settings_.mode == kUart; }
  void other_pin(Tick at, dsdpv1::Pin pin, Level level);
  bool strap(dsdpv1::Pin pin, Level level);
  void port_pin(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  void parallel_pin(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  void spi_pin(Tick at, dsdpv1::Pin pin, Level level);
  void intr0_pin(Tick at, bool level);
  void reset_pin(Tick at, bool level);
  void finish_port(Tick end);
  void end_hold_before(Tick at);
  void handshake(Tick at, dsdpv1::Pin pin, bool level);
  void access_began(Tick at) override;
  void access_ended(Tick at) override;
  void accessed(const Access& access) override;

  std::uint32_t pins_;
  SerialSettings settings_;
  PinHistory history_;
  Recorder recorder_;
  Ownership ownership_;
  PortTiming port_;
  CellRules cells_;
  OwnStation station_;
  Service service_;
  UserDuties duties_;
  SpiTiming spi_;
  SpiFrames frames_;
  UartFrames uart_;
  bool in_reset_ = true;
  Tick reset_fell_ = 0;
  bool holding_ = false;          ///< a hold runs from R_STA's rise until R_REQ and R_STA are both low again
  std::optional<Tick> hold_end_;  ///< judged when time advances: a RESET at the same tick voids it
};

}  // namespace dsdpv1::checks
