#include "model/dsdpv1/host_commit.hpp"

#include "model/dsdpv1/cells.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {

void HostCommit::start(Cycle now, Kind kind, const Request& request, const std::uint8_t* data) {
  state_ = State::kWaits;
  kind_ = kind;
  next_ = now;
  index_ = 0;
  base_ = request.base();
  length_ = request.length;
  data_ = data;
}

void HostCommit::write(Cycle now, const Request& request, const std::uint8_t* data, int owner) {
  start(now, Kind::kWrite, request, data);
  owner_ = owner;
}

void HostCommit::read(Cycle now, const Request& request) { start(now, Kind::kRead, request, nullptr); }

void HostCommit::read_and_write(Cycle now, const Request& request, const std::uint8_t* data) {
  start(now, Kind::kReadAndWrite, request, data);
  length_ = request.length + 1;
}

void HostCommit::exchange(Cycle now, const Request& request, const std::uint8_t* data) {
  start(now, Kind::kExchange, request, data);
  exchange_.start(request, data);
}

bool HostCommit::eval(Cycle now, bool owns, bool data_exch) {
  if (state_ == State::kIdle || now < next_) return false;
  next_ = now + 1;
  if (state_ == State::kWaits) {
    if (!owns) state_ = State::kMoves;  // nothing moves in this cycle
    return false;
  }
  if (!move(index_++, now, data_exch)) return false;
  state_ = State::kIdle;
  return true;
}

// Returns true after the last move.
bool HostCommit::move(int index, Cycle now, bool data_exch) {
  switch (kind_) {
    case Kind::kWrite: move_write(index, now); return index == length_ - 1;
    case Kind::kRead:
      read_.at(static_cast<std::size_t>(index)) = ram_.read(static_cast<regs::Address>(base_ + index));
      return index == length_ - 1;
    case Kind::kReadAndWrite: return move_read_and_write(index, now);
    case Kind::kExchange: return exchange_.move(index, data_exch);
  }
  return true;
}

void HostCommit::move_write(int index, Cycle now) {
  const auto address = static_cast<regs::Address>(base_ + index);
  if (address != owner_) put(address, data_[index], now);
}

bool HostCommit::move_read_and_write(int index, Cycle now) {
  constexpr int kFlagReads = 2;
  if (index == 0) {
    user_command_ = ram_.read(regs::kUserCommand1);
  } else if (index == 1) {
    chip_command_ = ram_.read(regs::kChipCommand1);
  } else if (index < kFlagReads + length_) {
    put(static_cast<regs::Address>(regs::kInput + index - kFlagReads), data_[index - kFlagReads], now);
  } else if (index == kFlagReads + length_) {
    ram_.write(regs::kUserCommand1, user_command_ | regs::kUserCommand1Input);
  } else {
    ram_.write(regs::kChipCommand1, chip_command_ & static_cast<std::uint8_t>(~regs::kChipCommand1Output));
    return true;
  }
  return false;
}

bool HostCommit::is_of(const Request& request) const {
  const Kind kind = request.command == Command::kRead    ? Kind::kRead
                    : request.command == Command::kWrite ? Kind::kWrite
                                                         : Kind::kExchange;
  return kind == kind_ && request.length == length_;
}

// The next move is one of the possible ones.
bool HostCommit::is_possible() const {
  constexpr int kFlagMoves = 4;
  switch (kind_) {
    case Kind::kWrite: return index_ < length_ && length_ <= HostTelegram::kMostData;
    case Kind::kRead: return index_ < length_ && length_ <= kMostRead;
    case Kind::kReadAndWrite: return index_ < length_ + kFlagMoves && length_ <= kMostReadAndWrite + 1;
    case Kind::kExchange: return exchange_.is_possible(index_);
  }
  return false;
}

void HostCommit::put(regs::Address address, std::uint8_t byte, Cycle now) {
  if (chips_own(address)) log_.at_cycle(now, Reason::kReadOnlyWritten, address, byte);
  if (const unsigned set = bits_set(address, ram_.read(address), byte); set != 0)
    log_.at_cycle(now, Reason::kBitSet, address, byte, set);
  ram_.write(address, byte);
}

}  // namespace dsdpv1
