#pragma once
// A user of the SPC3 family by its accesses alone, with the chip's answers written down: what its checks find.
#include <string>
#include <vector>

#include "kinds/spc3/checks/checks.hpp"

namespace dsdpv1::spc3_test {

using bus::Bytes;
using bus::Tick;
using spc3::Pin;
using spc3_checks::Address;
using spc3_checks::Check;
namespace regs = spc3::regs;

inline const tb::PinTable& script_pins() {
  static const tb::PinTable pins = [] {
    tb::PinTable table;
    for (int i = 0; i < spc3::kPinCount; ++i)
      table.push_back({spc3::kPinRows[i].name, spc3::kPinRows[i].width, spc3::is_input(static_cast<Pin>(i))});
    return table;
  }();
  return pins;
}

class Script {
 public:
  explicit Script(spc3::Variant variant = spc3::Variant::kApc3)
      : checks(checks::Limits(spc3_checks::rules()), variant, script_pins()) {
    checks.on_violation([this](const checks::Violation& violation) { found.push_back(violation); });
    pin(Pin::kReset, 0);
  }

  // --- the user; each access takes a microsecond
  void write(Address address, std::uint8_t value) { access({0, address, value, true}); }
  void write_word(Address address, unsigned value) {
    write(address, static_cast<std::uint8_t>(value));
    write(static_cast<Address>(address + 1), static_cast<std::uint8_t>(value >> 8));
  }
  void write_all(Address address, const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) write(address++, byte);
  }
  /// The chip answers `value`.
  void read(Address address, std::uint8_t value = 0) { access({0, address, value, false}); }
  void read_events(unsigned irr) {
    read(regs::kIrr, static_cast<std::uint8_t>(irr));
    read(regs::kIrr + 1, static_cast<std::uint8_t>(irr >> 8));
  }

  /// A right one: address 5, two inputs and outputs, one Aux, two bytes of configuration.
  void initialise() {
    write_word(regs::kMode0, regs::kMode0DpMode);
    write_all(regs::kOrg, {5, 25, 20, 0, 2, 8,  9, 10, 2, 11, 12, 13, 0, 0, 6, 6, 14, 15,   16,
                           0, 0,  16, 0, 0, 18, 0, 20, 0, 22, 2,  24, 0, 0, 0, 0, 0,  0x34, 0x12});
    write(25 << 3, 0xFF);
    write_all(kDout2, {0, 0});
    write(regs::kMode1S, regs::kMode1ResUserWd);
  }
  void start() { write(regs::kMode1S, regs::kMode1Start); }
  void online() {
    initialise();
    read(regs::kNewDin, 3);
    start();
    found.clear();
  }
  void data_ex() {
    online();
    pin(Pin::kXDataExch, 0);
  }
  /// The Set_Prm in the buffer of `pointer` is seen and read, not answered.
  void open_prm(std::uint8_t pointer = kAux) {
    read_events(regs::kEventNewPrm);
    read(regs::kOrgPrmPointer, pointer);
    read(static_cast<Address>(pointer << 3));
  }

  // --- the chip and the line
  void pin(Pin pin, tb::Level level) { checks.pin(now += 12, static_cast<tb::PinNumber>(pin), level); }
  void wait_ms(Tick ms) {
    now += ms * bus::kTicksPerMs;
    telegram({}, now - 1000);  // time passes with any telegram
  }
  void tell(const profibus::ReasonRow& row, std::uint16_t a = 0, std::uint16_t b = 0) {
    checks.event({now, profibus::Reason(row), a, b});
  }
  /// A Data_Exchange with two outputs and its answer, framed by RTS.
  void exchange() {
    fcb_ ^= bus::fc::kFcb;
    const auto fc = static_cast<std::uint8_t>(bus::fc::kRequest | bus::fc::kFcv | fcb_ | bus::fc::kSrdHigh);
    now += 10'000;
    telegram(bus::make_telegram(5, 2, fc, {1, 2}), now - 5000);
    now += 5000;
    pin(Pin::kRts, 1);
    const Tick begin = now + 1000;
    now += 12'000;
    telegram(bus::make_telegram(2, 5, bus::fc::kDl, {3, 4}), begin, true);
    now += 1000;
    pin(Pin::kRts, 0);
  }

  std::vector<std::string> ids() const {
    std::vector<std::string> all;
    for (const checks::Violation& each : found) all.emplace_back(spc3_checks::rules().at(each.check.index).id);
    return all;
  }

  static constexpr Address kDout1 = 0x40, kDout2 = 0x48, kDin1 = 0x58, kDiag1 = 0x70, kDiag2 = 0x78;
  static constexpr std::uint8_t kAux = 16, kPrm = 20, kCfg = 22;  ///< pointers
  spc3_checks::Checks checks;
  std::vector<checks::Violation> found;
  Tick now = 1000;

 private:
  void access(spc3_checks::RegisterAccess access) {
    access.at = now += bus::kTicksPerUs;
    checks.accessed(access);
  }
  void telegram(const bus::Telegram& telegram, Tick begin, bool answers = false) {
    bus::WireTelegram wire;
    wire.start = begin;
    wire.end = now;
    wire.decoded.telegram = telegram;
    wire.decoded.readable = true;
    if (answers) {
      wire.tsdr = 1000;
      wire.station = 5;
    }
    checks.telegram(now, wire);
  }
  std::uint8_t fcb_ = 0;
};

}  // namespace dsdpv1::spc3_test
