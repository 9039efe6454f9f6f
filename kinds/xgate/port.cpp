#include "kinds/xgate/port.hpp"

#include <algorithm>

#include "model/xgate/reasons.hpp"

namespace dsdpv1::xgate {

using kit::Level;
using kit::PinNumber;
using kit::Tick;

std::vector<kit::Pin> bench_pins() {
  return {{"RXD", kit::kInput, 1},    {"TXD", kit::kOutput, 1},    {"NSS", kit::kInput, 1},
          {"SCK", kit::kInput, 0},    {"MOSI", kit::kInput, 0},    {"MISO", kit::kOutput, kit::kReleased},
          {"INT", kit::kOutput, 1},   {"ISP_CFG", kit::kInput, 1}, {"LED1A", kit::kOutput, 0},
          {"LED1B", kit::kOutput, 0}, {"LED2A", kit::kOutput, 0},  {"LED2B", kit::kOutput, 0}};
}

struct ModulePort::SpiBytes {
  Firmware& firmware;
  Cycle now;
  Cycle& acts_at;

  std::uint8_t begin_byte() { return firmware.begin_byte(); }
  void end_byte(std::uint8_t mosi) {
    firmware.end_byte(now, mosi);
    acts_at = now;
  }
  void cut_byte() { firmware.cut_byte(); }
};

ModulePort::ModulePort(kit::Chip& chip)
    : chip_(chip),
      config_(chip_settings_of(chip.settings()).config()),
      firmware_(chip.events(), config_, chip.user(), chip.dp_station()),
      spi_(chip_settings_of(chip.settings()).spi_mode) {
  firmware_.on_byte({[](void* self, Cycle begins, Cycle /*ends*/, std::uint8_t byte) {
                       auto& port = *static_cast<ModulePort*>(self);
                       port.out_.begin(begins, byte, port.firmware_.rate());
                     },
                     this});
}

void ModulePort::reset() {
  firmware_.set_reset(0, true);
  in_.reset();
  out_.reset();
  spi_.reset();
  released_ = false;
  acts_at_ = profibus::kNever;
}

std::vector<std::pair<std::string, std::uint32_t>> ModulePort::parameters() const {
  std::vector<std::pair<std::string, std::uint32_t>> all = {{"spi_mode", chip_settings_of(chip_.settings()).spi_mode}};
  Config config = config_;
  config.each_parameter([&all](const char* name, std::uint32_t value) { all.emplace_back(name, value); });
  return all;
}

/// /ISP-CFG is sampled here (X25).
void ModulePort::release(Cycle now) {
  released_ = true;
  firmware_.set_config_pin(chip_settings_of(chip_.settings()).isp_cfg_low || chip_.level(kIspCfg) == 0);
  firmware_.set_reset(now, false);
}

void ModulePort::input(Tick at, PinNumber pin, Level level) {
  const Cycle sees = profibus::first_edge_after(at);
  if (!by_spi()) {
    if (pin == kHostRxd && level == 0) in_.fell(sees, firmware_.rate());
    return;
  }
  SpiBytes bytes{firmware_, sees, acts_at_};
  if (pin == kNss) spi_.select(level == 0, bytes);
  if (pin == kSck) spi_.clock(level != 0, chip_.level(kMosi) != 0, bytes);
  chip_.drive(at, kMiso, !spi_.selected() ? kit::kReleased : spi_.miso() ? Level{1} : Level{0});
}

void ModulePort::eval(Cycle now) {
  now_ = now;
  if (now >= acts_at_) acts_at_ = profibus::kNever;
  if (!released_) release(now);
  firmware_.eval(now);
  if (by_spi()) return;
  const UartIn::Heard heard = in_.eval(now, chip_.level(kHostRxd) != 0);
  if (heard.byte) firmware_.receive(now, *heard.byte);
  if (heard.broken) chip_.say(now, Reason::kCharacter.row());
}

void ModulePort::show(Cycle now) {
  chip_.drive_at(now, kInt, firmware_.interrupt() ? 0 : 1);
  show_led(now, kLed1A, Led::kNetworkRed);
  show_led(now, kLed1B, Led::kNetworkGreen);
  show_led(now, kLed2A, Led::kModuleGreen);
  show_led(now, kLed2B, Led::kModuleRed);
  if (!by_spi()) return chip_.drive_at(now, kHostTxd, out_.level(now) ? 1 : 0);
  if (!spi_.selected()) return;
  spi_.look_again(chip_.level(kSck) != 0, SpiBytes{firmware_, now, acts_at_});
  chip_.drive_at(now, kMiso, spi_.miso() ? 1 : 0);
}

Cycle ModulePort::next() const {
  if (!released_) return now_;  // at the edge at which RESET ends
  return std::min({firmware_.next(now_), in_.next(), out_.next(), acts_at_});
}

}  // namespace dsdpv1::xgate
