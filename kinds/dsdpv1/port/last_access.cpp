#include "kinds/dsdpv1/port/last_access.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/input/units.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kShown = 16;  ///< bytes; the longest frame has 513

}  // namespace

void LastAccess::pin(Tick at, PinNumber pin, Level level) {
  const auto which = static_cast<Pin>(pin);
  read(at, which, level);
  switch (which) {
    case Pin::kCsr: csr_ = level; break;
    case Pin::kRd: return level == 0 ? strobe(at, false) : void();
    case Pin::kWr: return level != 0 ? strobe(at, true) : void();
    case Pin::kA:
      a_ = level;
      if (at == access_ && !write_) address_ = level;  // at one tick A is reported after RD
      break;
    case Pin::kDIn: d_ = level; break;
    case Pin::kRxd: return rxd(at, level != 0);
    case Pin::kUbr: ubr_ = level; break;
    default: break;
  }
}

void LastAccess::strobe(Tick at, bool write) {
  if (csr_ != 0) return;
  access_ = at;
  write_ = write;
  address_ = a_;
  data_ = d_;
}

void LastAccess::begin(Tick at, const char* what) {
  telegram_ = at;
  what_ = what;
  bytes_.clear();
}

Tick LastAccess::bit() const { return kUbrCycles.at(static_cast<std::size_t>(ubr_)) * bus::kTicksPerCycle; }

void LastAccess::rxd(Tick at, bool level) {
  sample_until(at);
  rxd_ = level;
  if (level || sampled_ < kBits) return;
  const Tick silence = at - (character_ + kBits * bit());
  if (bytes_.empty() || silence > 7 * kBits * bit() / 2) begin(at, "UART telegram");
  character_ = at;
  sampled_ = 0;
  shift_ = 0;
}

void LastAccess::sample_until(Tick at) {
  while (sampled_ < kBits && character_ + sampled_ * bit() + bit() / 2 <= at) {
    shift_ |= unsigned{rxd_} << static_cast<unsigned>(sampled_);
    if (++sampled_ == kBits) bytes_.push_back(static_cast<std::uint8_t>(shift_ >> 1U));
  }
}

std::string LastAccess::words() const {
  if (telegram_ > access_) return telegram_words();
  if (access_ < 0) return "none";
  if (!write_) return fmt::format("read B{:03X} at {}", address_, cycle_text(access_));
  const PinInfo& d = dsdpv1_pins().at(static_cast<std::size_t>(Pin::kDIn));
  return fmt::format("write B{:03X} := {} at {}", address_, level_text(d, data_), cycle_text(access_));
}

/// A character whose end has no edge counts with its present bits.
std::string LastAccess::telegram_words() const {
  LastAccess whole = *this;
  whole.sample_until(bus::kNever);
  const std::vector<std::uint8_t>& bytes = whole.bytes_;
  const auto shown = bytes.begin() + static_cast<long>(std::min(bytes.size(), kShown));
  return fmt::format("{} of {} byte{} from {}{}{:02X}{}", what_, bytes.size(), bytes.size() == 1 ? "" : "s",
                     cycle_text(telegram_), bytes.empty() ? "" : ": ", fmt::join(bytes.begin(), shown, " "),
                     bytes.size() > kShown ? " ..." : "");
}

}  // namespace dsdpv1::tb
