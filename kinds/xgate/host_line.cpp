#include "kinds/xgate/host_line.hpp"

#include <utility>
#include <vector>

#include "kinds/xgate/pins.hpp"
#include "model/xgate/host_link.hpp"

namespace dsdpv1::xgate {
namespace {

SpiTiming spi_of(const UserSettings& user, const ChipSettings& chip) {
  SpiTiming timing = tb::spi_timing_of(user.spi);
  timing.mode = chip.spi_mode;
  return timing;
}

kit::PinNumber bench_pin(dsdpv1::Pin pin) {
  switch (pin) {
    case dsdpv1::Pin::kXss: return kNss;
    case dsdpv1::Pin::kSck: return kSck;
    default: return kMosi;
  }
}

}  // namespace

HostLine::HostLine(kit::Cpu& cpu)
    : cpu_(cpu),
      by_spi_(chip_settings_of(cpu.chip_settings()).port == Port::kSpi),
      uart_(uart_timing(user_settings_of(cpu.settings()).rate.value_or(chip_settings_of(cpu.chip_settings()).rate),
                        user_settings_of(cpu.settings()).byte_gap)),
      spi_(spi_of(user_settings_of(cpu.settings()), chip_settings_of(cpu.chip_settings()))),
      receiver_(uart_) {
  cpu_.on_change([this](Tick at, kit::PinNumber pin, kit::Level level) {
    if (pin == kHostTxd) receiver_.txd_changed(at, level != 0);
  });
  if (by_spi_) cpu_.set(kSck, (spi_.mode & 2U) != 0 ? 1 : 0);
}

void HostLine::send(const std::uint8_t* bytes, std::size_t n) {
  std::vector<std::uint8_t> out(bytes, bytes + n);
  answer_begun_ = false;
  if (by_spi_) {
    clock(std::move(out));
    return;
  }
  const UartTelegram telegram(std::move(out), uart_);
  const Tick begin = cpu_.now();
  for (std::size_t edge = 0; edge < telegram.size(); ++edge) {
    cpu_.wait_until(begin + telegram[edge].at);
    cpu_.set(kHostRxd, telegram[edge].level ? 1 : 0);
  }
}

/// One frame of NSS; returns the last byte of MISO.
std::uint8_t HostLine::clock(std::vector<std::uint8_t> out) {
  SpiFrame frame(std::move(out), spi_);
  cpu_.wait_until(free_at_);
  const Tick begin = cpu_.now();
  for (std::size_t number = 0; number < frame.size(); ++number) {
    const SerialEdge edge = frame[number];
    cpu_.wait_until(begin + edge.at);
    if (edge.pin == dsdpv1::Pin::kMiso)
      frame.sampled(cpu_.level(kMiso) != 0);
    else
      cpu_.set(bench_pin(edge.pin), edge.level ? 1 : 0);
  }
  free_at_ = cpu_.now() + spi_.gap;
  return frame.received().back();
}

bool HostLine::wait_for_int(Tick until) {
  while (cpu_.level(kInt) != 0 && cpu_.now() < until) cpu_.wait_interrupt(until);
  return cpu_.level(kInt) == 0;
}

std::optional<std::uint8_t> HostLine::receive(Tick timeout) {
  if (by_spi_) {
    if (!answer_begun_ && !wait_for_int(cpu_.now() + timeout)) return std::nullopt;
    const std::uint8_t byte = clock({HostLink::kIdle});
    answer_begun_ = answer_begun_ || byte != HostLink::kIdle;
    return byte;
  }
  receiver_.begin(cpu_.now(), 1, timeout);
  for (receiver_.run(cpu_.now()); !receiver_.done(); receiver_.run(cpu_.now())) cpu_.wait_change(receiver_.next());
  if (receiver_.received().empty()) return std::nullopt;
  return receiver_.received().front();
}

}  // namespace dsdpv1::xgate
