#include "model/dsdpv1/serial_ports.hpp"

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {

void SerialPorts::reset() {
  running_ = false;
  mode_ = HostMode::kParallel;
  spi_.reset();
  uart_.reset();
}

void SerialPorts::release(Cycle now) {
  if (!has_serial_ports(config_.part)) return;
  running_ = true;
  in_force_ = straps_;
  const auto [mode, address, rate, interval] = in_force_;
  mode_ = mode == 1 ? HostMode::kSpi : mode == 2 ? HostMode::kUart : HostMode::kParallel;
  if (mode_ == HostMode::kSpi) spi_.start(address);
  if (mode_ == HostMode::kUart) uart_.start(now, address, rate, interval);
}

void SerialPorts::set(Tick at, Pin pin, Level level) {
  if (!has_serial_ports(config_.part)) return;
  switch (pin) {
    case Pin::kXss: return spi_.shift().set_xss(at, level != 0);
    case Pin::kSck: return spi_.shift().set_sck(at, level != 0);
    case Pin::kMosi: return spi_.shift().set_mosi(at, level != 0);
    case Pin::kRxd: return uart_.set_rxd(at, level != 0);
    case Pin::kMode:
    case Pin::kAdr:
    case Pin::kUbr:
    case Pin::kUiv: return set_strap(at, pin, level);
    default: return;
  }
}

void SerialPorts::set_strap(Tick at, Pin pin, Level level) {
  Level& now = straps_.at(strap(pin));
  if (now == level) return;
  now = level;
  if (!running_) return;
  const auto index = strap(pin);
  log_.at_tick(at, Reason::kStrapChanged, static_cast<unsigned>(index), static_cast<unsigned>(level),
               static_cast<unsigned>(in_force_.at(index)));
}

Level SerialPorts::level(Pin pin) const {
  switch (pin) {
    case Pin::kRxd: return uart_.rxd();
    case Pin::kTxd: return uart_.txd();
    case Pin::kMode:
    case Pin::kAdr:
    case Pin::kUbr:
    case Pin::kUiv: return straps_.at(strap(pin));
    default: return spi_.shift().level(pin);
  }
}

void SerialPorts::eval(Cycle now, const ChipSide& side) {
  if (mode_ == HostMode::kSpi) spi_.eval(now, side);
  if (mode_ == HostMode::kUart) uart_.eval(now, side);
}

Cycle SerialPorts::next() const {
  switch (mode_) {
    case HostMode::kSpi: return spi_.next();
    case HostMode::kUart: return uart_.next();
    default: return profibus::kNever;
  }
}

}  // namespace dsdpv1
