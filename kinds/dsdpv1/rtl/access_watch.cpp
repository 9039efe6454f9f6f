#include "kinds/dsdpv1/rtl/access_watch.hpp"

#include <fmt/format.h>

#include "io/input/units.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kShortAccess = 7 * kCycle;  // 9.1: no work, only B006 := 01
constexpr Tick kSettles = 4 * kCycle;      // P8: longer than a user's write is pending
constexpr unsigned kImageEvery = 256;      // ... the DPRAM is still compared from time to time
constexpr Tick kStartsUp = 3500 * kCycle;  // H6: the start-up access has written every cell
constexpr Tick kImageGap = 1000 * kCycle;  // with a serial port no pin shows an access: compare this often

}  // namespace

AccessWatch::AccessWatch(Part part) : part_(part) {
  for (const Pin high : {Pin::kCsr, Pin::kRd, Pin::kWr, Pin::kXss, Pin::kRxd}) level(high) = 1;
}

void AccessWatch::change(Tick at, PinNumber changed, Level to) {
  const Pin pin = static_cast<Pin>(changed);
  const bool differs = level(pin) != to;
  level(pin) = to;
  if (pin == Pin::kLReq && to == 0 && level(Pin::kReset) != 0) end_ = at;
  if (has_serial_ports(part_)) serial_change(at, pin);
  if (pin == Pin::kWr && to != 0) {
    user_wrote_ = true;
    last_write_ = at;
  }
  if (!differs) return;
  if (pin == Pin::kLReq) (to != 0 ? chip_start_ : chip_end_) = at;
  user_.pin(at, changed, to);
}

/// With a serial port the DPRAM is equal in every cycle, so it may be compared in any.
void AccessWatch::serial_change(Tick at, Pin pin) {
  if (pin == Pin::kReset) {
    image_at_ = at + kStartsUp;
    const auto mode = static_cast<HostMode>(level(Pin::kMode));  // R11: at the end of the reset
    serial_ = mode == HostMode::kSpi || mode == HostMode::kUart;
  }
  const bool moves = pin == Pin::kXss || pin == Pin::kRxd || pin == Pin::kTxd || pin == Pin::kPbrts;
  if (!moves || level(Pin::kReset) == 0 || !serial_ || at < image_at_ + kImageGap) return;
  end_ = image_at_ = at;
}

bool AccessWatch::worth_a_look(Tick end) {
  const bool chip_wrote = end - chip_start_ > kShortAccess;
  return chip_wrote || user_wrote_ || ++unseen_ % kImageEvery == 0;
}

void AccessWatch::compared(Tick end) { user_wrote_ = last_write_ > end - kSettles; }

std::string AccessWatch::last_of_chip() const {
  if (chip_start_ < 0) return "no access of the chip yet";
  if (chip_end_ < chip_start_) return fmt::format("in an access since {}", tb::cycle_text(chip_start_));
  return fmt::format("last access from {} to {}", tb::cycle_text(chip_start_), tb::cycle_text(chip_end_));
}

}  // namespace dsdpv1::cosim
