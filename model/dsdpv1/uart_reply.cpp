// UART's reply (rulings UA4, UA7 to UA12): judges a telegram and replies after at least the delay TSDR.
#include <algorithm>

#include "model/dsdpv1/host_uart.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {
namespace {

constexpr std::uint8_t kDataExchBit = 0x01, kErrorBit = 0x80;  // function of a reply

}  // namespace

void HostUart::judge(Cycle now, const ChipSide& side) {
  judge_at_ = profibus::kNever;
  state_ = State::kReply;
  const std::uint8_t tsdr = ram_.read(regs::kUartTsdr);
  earliest_ = request_end_ - 2 + Cycle{std::max<std::uint32_t>(config_.uart_min_tsdr, tsdr)} * bit_;
  size_ = 0;
  std::uint8_t code = kCrcWrong;
  if (request_.crc_right())
    code = telegram_.judge(request_, now, log_);
  else
    log_.at_cycle(now, Reason::kTelegramCrc, request_.crc, request_.computed);
  if (code != 0) return reply_error(now, code, side.data_exch);
  carry_out(now);
  commit_.eval(now, side.owns, side.data_exch);
}

void HostUart::carry_out(Cycle now) {
  switch (request_.command) {
    case Command::kRead: return commit_.read(now, request_);
    case Command::kWrite: return commit_.write(now, request_, telegram_.data(), HostCommit::kNobody);
    case Command::kExchange: return commit_.exchange(now, request_, telegram_.data());
  }
}

void HostUart::reply_error(Cycle now, std::uint8_t code, bool data_exch) {
  const auto address = static_cast<std::uint8_t>(address_);
  if (request_.command == Command::kExchange) {
    add(address);
    add(kErrorBit | (data_exch ? kDataExchBit : std::uint8_t{0}));
  } else {
    add(0xE0 | address);
  }
  add(code);
  send(now);
}

// Called after the commit's last move.
void HostUart::reply_done(Cycle now) {
  const auto address = static_cast<std::uint8_t>(address_);
  if (request_.command == Command::kExchange) {
    const Exchange& answer = commit_.answer();
    const std::uint8_t head[] = {address, answer.function(), static_cast<std::uint8_t>(answer.address() >> 8),
                                 static_cast<std::uint8_t>(answer.address() & 0xFF), answer.length_byte()};
    add(head, sizeof head);
    add(answer.data(), answer.size());
  } else {
    add((request_.command == Command::kRead ? 0x80 : 0xA0) | address);
    add(0);
    if (request_.command == Command::kRead) add(commit_.data(), request_.length);
  }
  send(now);
}

void HostUart::send(Cycle ready) {
  const std::uint16_t crc = dpram::crc16(reply_.data(), size_);
  add(static_cast<std::uint8_t>(crc >> 8));
  add(static_cast<std::uint8_t>(crc & 0xFF));
  tx_.send(reply_.data(), size_, bit_, std::max(earliest_, ready + 1), 0, 0);
}

}  // namespace dsdpv1
