#include "kinds/dsdpv1/random/access_watch.hpp"

#include <fmt/format.h>

#include "io/input/units.hpp"

namespace dsdpv1::cosim {

std::string level_text(Pin pin, Level level) {
  if (level == dsdpv1::kLevelZ) return "Z";
  if (level == dsdpv1::kLevelX) return "X";
  return dsdpv1::width(pin) == 1 ? fmt::format("{}", level) : fmt::format("{:02X}", level);
}

AccessWatch::AccessWatch() {
  for (const Pin high : {Pin::kCsr, Pin::kRd, Pin::kWr, Pin::kXss, Pin::kRxd}) level(high) = 1;
}

void AccessWatch::change(Tick at, Pin pin, Level to) {
  const bool differs = level(pin) != to;
  level(pin) = to;
  if (!differs) return;
  if (pin == Pin::kLReq) (to != 0 ? chip_start_ : chip_end_) = at;
  user_.pin(at, pin, to);
}

std::string AccessWatch::chip_text() const {
  if (chip_start_ < 0) return "no access of the chip yet";
  if (chip_end_ < chip_start_) return fmt::format("in an access since {}", tb::cycle_text(chip_start_));
  return fmt::format("last access from {} to {}", tb::cycle_text(chip_start_), tb::cycle_text(chip_end_));
}

}  // namespace dsdpv1::cosim
