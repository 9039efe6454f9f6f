// A complete telegram of SPI (rulings SP8, SP9, SP13, SP16): judges, executes and answers it.
#include <algorithm>

#include "model/dsdpv1/reasons.hpp"
#include "model/dsdpv1/spi_port.hpp"

namespace dsdpv1 {
namespace {

constexpr regs::Address kOwnership = regs::kOwnership;

std::uint8_t reply_start(Command command) {
  return command == Command::kRead ? 0x80 : command == Command::kWrite ? 0xA0 : 0xC0;
}

}  // namespace

void SpiPort::judge(Cycle now, const ChipSide& side) {
  judge_at_ = profibus::kNever;
  bool good = false;
  std::uint8_t code = kCrcWrong;
  if (request_.crc_right())
    code = judge_right(now, side, good);
  else
    log_.at_cycle(now, Reason::kTelegramCrc, request_.crc, request_.computed);
  begin_reply(now, side, good, code);
}

std::uint8_t SpiPort::judge_right(Cycle now, const ChipSide& side, bool& good) {
  const std::uint8_t code = telegram_.judge(request_, now, log_);
  good = code == 0 && !refused(now, side);
  if (good) carry_out(now);
  restart_u_timer(now);
  return code;
}

// SP9, SP13, SP16.
bool SpiPort::refused(Cycle now, const ChipSide& side) {
  if (request_.command == Command::kRead) return false;
  const bool claims = request_.command == Command::kWrite && request_.covers(kOwnership) &&
                      (telegram_.data()[kOwnership - request_.base()] & regs::kOwnershipHost) != 0;
  const bool exchange = request_.command == Command::kExchange;
  if (commit_.busy())
    log_.at_cycle(now, Reason::kSpiBusy, 2);
  else if (side.owns && (claims || exchange))
    log_.at_cycle(now, Reason::kSpiBusy, exchange ? 1 : 0);
  else
    return false;
  return true;
}

void SpiPort::carry_out(Cycle now) {
  if (request_.command == Command::kExchange) {
    commit_.read_and_write(now, request_, telegram_.data());
    frame_holds_ = !frame_over_;
    return;
  }
  report_no_claim(now);
  if (request_.command == Command::kRead) return;
  if (request_.covers(kOwnership))
    set_claimed(now, (telegram_.data()[kOwnership - request_.base()] & regs::kOwnershipHost) != 0);
  commit_.write(now, request_, telegram_.data(), kOwnership);
}

void SpiPort::report_no_claim(Cycle now) {
  const bool only_ownership = request_.base() == kOwnership && request_.length == 1;
  if (claimed_ || only_ownership) return;
  log_.at_cycle(now, Reason::kSpiNoClaim, request_.address, static_cast<unsigned>(request_.length),
                request_.command == Command::kWrite);
}

void SpiPort::begin_reply(Cycle now, const ChipSide& side, bool good, std::uint8_t code) {
  int data = 0;
  if (good && request_.command == Command::kRead) data = request_.length;
  if (good && request_.command == Command::kExchange) data = SpiReply::kOutputs;
  const unsigned start = (good ? reply_start(request_.command) : 0xE0U) + static_cast<unsigned>(address_);
  reply_.begin(static_cast<std::uint8_t>(start), code, data, static_cast<int>(config_.spi_reply_gap));
  if (frame_over_) return report_cut(now, 0);
  replies_ = true;
  for (const int slot : {request_.bytes, request_.bytes + 1}) shift_.load(now, slot, next_reply_byte(side));
}

std::uint8_t SpiPort::next_reply_byte(const ChipSide& side) {
  const int wanted = reply_.wants();
  if (wanted < 0) return reply_.take(0);
  const regs::Address base = request_.command == Command::kExchange ? regs::kOutput : request_.base();
  return reply_.take(read(static_cast<regs::Address>(base + wanted), side));
}

std::uint8_t SpiPort::read(regs::Address address, const ChipSide& side) const {
  if (address == kOwnership) return ownership(side.owns);
  return side.starts_up ? std::uint8_t{0} : ram_.read(address);
}

void SpiPort::report_cut(Cycle now, int sent) {
  const int size = reply_.size();
  if (size == 0 || sent < size)
    log_.at_cycle(now, Reason::kSpiReplyCut, static_cast<unsigned>(std::max(sent, 0)), static_cast<unsigned>(size));
}

}  // namespace dsdpv1
