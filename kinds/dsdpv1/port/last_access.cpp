#include "kinds/dsdpv1/port/last_access.hpp"

#include <fmt/format.h>

#include "io/input/units.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"

namespace dsdpv1::tb {

void LastAccess::pin(dsdpv1::Tick at, Pin pin, Level level) {
  telegram_.pin(at, pin, level);
  if (pin == Pin::kCsr) csr_ = level;
  if (pin == Pin::kA) a_ = level;
  if (pin == Pin::kDIn) d_ = level;
  if (pin == Pin::kA && at == at_ && !write_) address_ = level;  // at one tick A is told after RD
  const bool write = pin == Pin::kWr && level != 0, read = pin == Pin::kRd && level == 0;
  if ((!write && !read) || csr_ != 0) return;
  at_ = at;
  write_ = write;
  address_ = a_;
  data_ = d_;
}

std::string LastAccess::words() const {
  if (telegram_.begin() > at_) return telegram_.words();
  if (at_ < 0) return "none";
  if (!write_) return fmt::format("read B{:03X} at {}", address_, cycle_text(at_));
  const PinInfo& d = dsdpv1_pins().at(static_cast<std::size_t>(Pin::kDIn));
  return fmt::format("write B{:03X} := {} at {}", address_, level_text(d, data_), cycle_text(at_));
}

}  // namespace dsdpv1::tb
