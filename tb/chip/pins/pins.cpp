#include "tb/chip/pins/pins.hpp"

#include <fmt/format.h>

namespace dsdpv1::tb {

std::string level_text(const PinInfo& pin, Level level) {
  if (level == kLevelZ) return "z";
  if (level == kLevelX) return "x";
  return pin.width == 1 ? fmt::format("{}", level) : fmt::format("{:0{}X}", level, (pin.width + 3) / 4);
}

}  // namespace dsdpv1::tb
