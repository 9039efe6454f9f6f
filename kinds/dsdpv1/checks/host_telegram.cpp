#include "kinds/dsdpv1/checks/host_telegram.hpp"

#include "kinds/dsdpv1/checks/blocks.hpp"

namespace dsdpv1::checks {
namespace {

constexpr unsigned kCrcBytes = 2, kCells = 0x800, kMostData = 245, kMostInputs = 244, kMostOverUart = 250;

}  // namespace

bool HostTelegram::complete() const {
  if (size() <= length_at()) return false;
  const std::size_t data = kind() == TelegramKind::kRead ? 0 : count();
  return size() == length_at() + 1 + data + kCrcBytes;
}

unsigned HostTelegram::most_data() const {
  return port_ == SerialPort::kUart && kind() == TelegramKind::kWrite ? kMostOverUart : kMostData;
}

bool HostTelegram::right() const {
  const auto covered = static_cast<unsigned>(size()) - kCrcBytes;
  const auto crc = crc_over(0, covered, [this](Address at) { return std::optional<std::uint8_t>(bytes_[at]); });
  if (!crc || *crc != (static_cast<unsigned>(bytes_[covered]) << 8 | bytes_[covered + 1])) return false;
  if (!addressed()) return count() <= kMostInputs;
  return bytes_[1] < 8 && count() >= 1 && count() <= most_data() && address() + count() <= kCells;
}

std::optional<std::uint8_t> HostTelegram::written(unsigned cell) const {
  if (kind() != TelegramKind::kWrite || !covers(cell)) return std::nullopt;
  return bytes_[length_at() + 1 + cell - address()];
}

}  // namespace dsdpv1::checks
