#include "kinds/xgate/host_line.hpp"

#include <utility>
#include <vector>

#include "kinds/xgate/pins.hpp"
#include "model/xgate/host_link.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr std::size_t kLongestFrame = kFrameHead + kMostData + 1;

bool is_whole(const std::vector<std::uint8_t>& frame) {
  return frame.size() >= kFrameHead && frame.size() >= kFrameHead + frame[2] + 1U;
}

SpiTiming spi_of(const UserSettings& user, const ChipSettings& chip) {
  SpiTiming timing = tb::spi_timing_of(user.spi.value_or(HostSpi()));
  timing.mode = chip.spi_mode;
  return timing;
}

}  // namespace

kit::PinNumber bench_pin(dsdpv1::Pin pin) {
  switch (pin) {
    case dsdpv1::Pin::kXss: return kNss;
    case dsdpv1::Pin::kSck: return kSck;
    case dsdpv1::Pin::kRxd: return kHostRxd;
    default: return kMosi;
  }
}

HostLine::HostLine(kit::Cpu& cpu)
    : cpu_(cpu),
      own_(user_settings_of(cpu.settings())),
      by_spi_(chip_settings_of(cpu.chip_settings()).port == Port::kSpi),
      uart_(uart_timing(own_.rate.value_or(chip_settings_of(cpu.chip_settings()).rate), own_.byte_gap)),
      spi_(spi_of(user_settings_of(cpu.settings()), chip_settings_of(cpu.chip_settings()))),
      receiver_(uart_) {
  cpu_.on_change([this](Tick at, kit::PinNumber pin, kit::Level level) {
    if (pin == kHostTxd) receiver_.txd_changed(at, level != 0);
  });
  if (by_spi_) cpu_.set(kSck, (spi_.mode & 2U) != 0 ? 1 : 0);
}

void HostLine::send(const std::uint8_t* bytes, std::size_t n) {
  take_orders();
  if (faults_.none()) return transmit({bytes, bytes + n});
  to_damage_.insert(to_damage_.end(), bytes, bytes + n);
  if (is_whole(to_damage_)) send_wrong(std::exchange(to_damage_, {}), faults_.take());
}

void HostLine::take_orders() {
  while (const auto order = cpu_.order()) {
    if (order->order == kHostTelegram)
      for (int i = 0; i < order->times; ++i) interpose(*order);
    else
      faults_.add(*order);
  }
}

/// A frame of the script, and its answer.
void HostLine::interpose(const user_cpu::command::OfChip& order) {
  std::vector<std::uint8_t> out = order.bytes;
  out.push_back(xor_of(out.data(), static_cast<int>(out.size())));
  transmit(std::move(out));
  std::vector<std::uint8_t> answer;
  const std::size_t most = order.listen ? static_cast<std::size_t>(*order.listen) : kLongestFrame;
  while (answer.size() < most) {
    const std::optional<std::uint8_t> byte = receive(own_.answer_ms * bus::kTicksPerMs);
    if (!byte) return;
    if (answer.empty() && *byte != kFrameStart) continue;
    answer.push_back(*byte);
    if (is_whole(answer)) return;
  }
}

void HostLine::send_wrong(std::vector<std::uint8_t> out, const user_cpu::command::OfChip& fault) {
  constexpr std::size_t kBefore = 2, kCutBits = 20;
  if (fault.order == kFlipBit) out.back() ^= 1U;
  if (fault.order == kCutTelegram && by_spi_) {
    clock(std::move(out), kCutBits);
    return;
  }
  if (fault.order == kCutTelegram) out.resize(kBefore);
  if (fault.order == kPauseTelegram) {
    transmit({out.begin(), out.begin() + kBefore});
    cpu_.wait(fault.duration);
    out.erase(out.begin(), out.begin() + kBefore);
  }
  transmit(std::move(out));
  if (fault.order != kTalkOverReply) return;
  cpu_.wait(half_bits(uart_, 40));
  transmit({HostLink::kIdle});
}

void HostLine::transmit(std::vector<std::uint8_t> out) {
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
std::uint8_t HostLine::clock(std::vector<std::uint8_t> out, std::optional<std::size_t> bits) {
  SpiFrame frame(std::move(out), spi_, bits);
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
    const Tick until = cpu_.now() + timeout;
    do {
      if (!answer_begun_ && !wait_for_int(until)) return std::nullopt;
      const std::uint8_t byte = clock({HostLink::kIdle});
      answer_begun_ = answer_begun_ || byte == kFrameStart;
      if (answer_begun_) return byte;
    } while (cpu_.now() < until);
    return std::nullopt;
  }
  receiver_.begin(cpu_.now(), 1, timeout);
  for (receiver_.run(cpu_.now()); !receiver_.done(); receiver_.run(cpu_.now())) cpu_.wait_change(receiver_.next());
  if (receiver_.received().empty()) return std::nullopt;
  return receiver_.received().front();
}

}  // namespace dsdpv1::xgate
