#pragma once
// The rules of the user's side of a chip of the SPC3 family, judged from the pins of its bus, RESET, RTS, X/INT and
// XDATAEXCH, and from the telegrams on the line; the chip's events, if it tells them, say when a block came.
//
//   spc3_checks::Checks checks(limits, variant, pins);
//   checks.on_violation(...);
//   checks.pin(at, pin, level);  // and telegram(now, telegram), in order of time
//   checks.finish(end);
#include <functional>
#include <utility>

#include "kinds/spc3/checks/blocks.hpp"
#include "kinds/spc3/checks/bus_rules.hpp"
#include "kinds/spc3/checks/interrupt_rules.hpp"
#include "kinds/spc3/checks/live_rules.hpp"
#include "kinds/spc3/checks/seen_chip.hpp"
#include "kinds/spc3/checks/spi_rules.hpp"
#include "kinds/spc3/checks/use_rules.hpp"
#include "kinds/spc3/port/bus_reader.hpp"
#include "model/spc3/pins.hpp"
#include "tb/chip/checks/chip_checks.hpp"

namespace dsdpv1::spc3_checks {

class Checks : public checks::ChipChecks, private spc3_bus::AccessSink {
 public:
  static constexpr tb::PinMask kPins =
      spc3::mask(spc3::Pin::kReset) | spc3::mask(spc3::Pin::kRts) | spc3::mask(spc3::Pin::kXInt) |
      spc3::mask(spc3::Pin::kXDataExch) | spc3::mask(spc3::Pin::kXIntMot) | spc3::mask(spc3::Pin::kMode) |
      spc3::mask(spc3::Pin::kXCs) | spc3::mask(spc3::Pin::kXRd) | spc3::mask(spc3::Pin::kXWr) |
      spc3::mask(spc3::Pin::kAle) | spc3::mask(spc3::Pin::kAb) | spc3::mask(spc3::Pin::kDbIn) |
      spc3::mask(spc3::Pin::kDbOut) | spc3::mask(spc3::Pin::kXReady) | spc3::mask(spc3::Pin::kAb11) |
      spc3::mask(spc3::Pin::kSerial) | spc3::mask(spc3::Pin::kSck) | spc3::mask(spc3::Pin::kMosi) |
      spc3::mask(spc3::Pin::kXss) | spc3::mask(spc3::Pin::kMiso);

  /// `pins`: the kind's, with the numbers of spc3::Pin; must outlive it. `bus`: the straps, until pin() moves them.
  /// `spi_mode`: as the chip's parameter.
  Checks(const checks::Limits& limits, spc3::Variant variant, const tb::PinTable& pins,
         spc3::Bus bus = spc3::Bus::kIntelAsync, unsigned spi_mode = 0)
      : history_(pins),
        recorder_(rules(), limits, history_),
        reader_(*this, bus, spi_mode),
        spi_(recorder_, spi_mode),
        chip_(variant) {}
  Checks(const Checks&) = delete;
  Checks& operator=(const Checks&) = delete;

  void pin(Tick at, tb::PinNumber pin, tb::Level level) override;
  /// An access without pins; addresses in Intel order.
  void accessed(const RegisterAccess& access);
  void unseen_access(Tick at, std::uint16_t address, std::uint8_t value, bool write) override {
    accessed({at, address, value, write});
  }
  void telegram(Tick now, const bus::WireTelegram& telegram) override;
  void event(const profibus::Event& event) override;
  void finish(Tick end) override;

  /// Without accesses nothing is judged; of SPI and the parallel buses only the one that is used.
  bool applies(checks::CheckId check) const override;
  const checks::Record& record(checks::CheckId check) const override { return recorder_.record(check); }
  const checks::Limit& limit(checks::CheckId check) const override { return recorder_.limit(check); }
  void on_violation(std::function<void(const checks::Violation&)> sink) override {
    recorder_.on_violation = std::move(sink);
  }

 private:
  // spc3_bus::AccessSink
  void read_answered(Tick at, const spc3_bus::BusAccess& access) override { transferred(at, access); }
  void access_began(const spc3_bus::BusAccess& access) override {
    if (!by_spi()) bus_.began(access, reader_.lines());
  }
  void access_ended(Tick at, const spc3_bus::BusAccess& access) override {
    if (!by_spi()) bus_.ended(at, access, reader_.lines());
    if (access.write) transferred(at, access);
  }
  void frame_ended(const spc3_bus::SpiFrame& frame) override { spi_.ended(frame); }
  bool by_spi() const { return reader_.lines().bus() == spc3::Bus::kSpi; }
  void transferred(Tick at, const spc3_bus::BusAccess& access);
  void reset_pin(bool level);
  void take(const RegisterAccess& access);
  void pass(Tick now);

  checks::PinHistory history_;
  checks::Recorder recorder_;
  spc3_bus::BusReader reader_;
  BusRules bus_{recorder_};
  SpiRules spi_;
  SeenChip chip_;
  UseRules use_{recorder_, chip_};
  Blocks blocks_{recorder_, chip_};
  InterruptRules interrupt_{recorder_, chip_};
  LiveRules live_{recorder_, chip_, interrupt_};
  bool in_reset_ = true, has_accesses_ = false;
};

}  // namespace dsdpv1::spc3_checks
