#include "kinds/dsdpv1/user_cpu/uart_master.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::user_cpu {
void UartSender::begin(Tick at, std::vector<std::uint8_t> bytes, const UartFault& fault) {
  if (fault.cut_after) bytes.resize(std::min(bytes.size(), *fault.cut_after));
  if (const auto bit = fault.flipped_bit; bit && *bit / 8 < bytes.size())
    bytes[*bit / 8] = static_cast<std::uint8_t>(bytes[*bit / 8] ^ 1U << *bit % 8);
  if (fault.break_at) bytes.resize(std::min(bytes.size(), *fault.break_at + 1));
  UartFaults faults = static_cast<const UartFaults&>(fault);
  if (fault.talk_over) {
    faults.pause_before = bytes.size();
    faults.pause = *fault.talk_over;
    bytes.push_back(0xFF);
  }
  send(at, std::move(bytes), faults);
}

void PinUartSender::send(Tick at, std::vector<std::uint8_t> bytes, const UartFaults& faults) {
  begin_ = at;
  telegram_ = UartTelegram(std::move(bytes), timing_, faults);
  edge_ = 0;
}

void PinUartSender::run(Tick now) {
  const bool level = telegram_[edge_++].level;
  if (level != level_) pins_.set_serial(now, dsdpv1::Pin::kRxd, level);
  level_ = level;
}

std::unique_ptr<UartSender> SerialPins::make_uart_sender(const UartTiming& timing) {
  return std::make_unique<PinUartSender>(*this, timing);
}

}  // namespace dsdpv1::user_cpu
