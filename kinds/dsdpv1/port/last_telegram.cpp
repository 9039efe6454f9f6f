#include "kinds/dsdpv1/port/last_telegram.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/input/units.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kShown = 16;  ///< bytes; the longest frame has 513

}  // namespace

void LastTelegram::pin(Tick at, Pin pin, Level level) {
  switch (pin) {
    case Pin::kXss: return xss(at, level != 0);
    case Pin::kSck: return sck(level != 0);
    case Pin::kMosi: mosi_ = level != 0; break;
    case Pin::kRxd: return rxd(at, level != 0);
    case Pin::kUbr: ubr_ = level; break;
    default: break;
  }
}

void LastTelegram::begin(Tick at, const char* what) {
  begin_ = at;
  what_ = what;
  bytes_.clear();
}

void LastTelegram::xss(Tick at, bool level) {
  selected_ = !level;
  if (!selected_) return;
  begin(at, "SPI frame");
  shift_ = 1;
}

void LastTelegram::sck(bool level) {
  if (!selected_ || !level) return;
  shift_ = shift_ << 1U | unsigned{mosi_};
  if (shift_ < 0x100) return;
  bytes_.push_back(static_cast<std::uint8_t>(shift_));
  shift_ = 1;
}

void LastTelegram::rxd(Tick at, bool level) {
  sample_until(at);
  rxd_ = level;
  if (level || sampled_ < kIdle) return;
  const Tick silence = at - (character_ + kIdle * bit());
  if (bytes_.empty() || silence > 7 * kIdle * bit() / 2) begin(at, "UART telegram");
  character_ = at;
  sampled_ = 0;
  shift_ = 0;
}

void LastTelegram::sample_until(Tick at) {
  while (sampled_ < kIdle && character_ + sampled_ * bit() + bit() / 2 <= at) {
    shift_ |= unsigned{rxd_} << static_cast<unsigned>(sampled_);
    if (++sampled_ == kIdle) bytes_.push_back(static_cast<std::uint8_t>(shift_ >> 1U));
  }
}

/// A character whose end no edge shows is taken as it stands.
std::string LastTelegram::words() const {
  LastTelegram whole = *this;
  whole.sample_until(profibus::kNever);
  const std::vector<std::uint8_t>& bytes = whole.bytes_;
  const std::vector<std::uint8_t> shown(bytes.begin(),
                                        bytes.begin() + static_cast<long>(std::min(bytes.size(), kShown)));
  return fmt::format("{} of {} byte{} from {}{}{}{}", what_, bytes.size(), bytes.size() == 1 ? "" : "s",
                     cycle_text(begin_), bytes.empty() ? "" : ": ", fmt::format("{:02X}", fmt::join(shown, " ")),
                     bytes.size() > kShown ? " ..." : "");
}

}  // namespace dsdpv1::tb
