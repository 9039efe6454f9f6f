#include "kinds/spc3/port/last_access.hpp"

#include <fmt/format.h>

#include "io/input/units.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::tb {
namespace {

std::string text_of(spc3::Pin pin, Level level) { return level_text({spc3::name(pin), spc3::width(pin)}, level); }

}  // namespace

std::string Spc3LastAccess::words() const {
  if (at_ < 0) return "none";
  const std::string cell = text_of(spc3::Pin::kAb, last_.address);
  if (!last_.write) return fmt::format("read {} at {}", cell, cycle_text(at_));
  return fmt::format("write {} := {} at {}", cell, text_of(spc3::Pin::kDbIn, last_.data), cycle_text(at_));
}

}  // namespace dsdpv1::tb
