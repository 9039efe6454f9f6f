#include "bus/capture/sample_clock.hpp"

#include <cctype>
#include <sstream>

namespace dsdpv1::bus::capture {

std::optional<std::uint64_t> sample_rate(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double number = 0;
  std::string unit;
  if (!(in >> number)) return std::nullopt;
  in >> unit;
  const char prefix = unit.empty() ? 'H' : unit[0];
  const double factor = prefix == 'G' ? 1e9 : prefix == 'M' ? 1e6 : prefix == 'k' || prefix == 'K' ? 1e3 : 1;
  const double rate = std::round(number * factor);
  if (!(rate >= 1 && rate <= 1e12)) return std::nullopt;
  return static_cast<std::uint64_t>(rate);
}

}  // namespace dsdpv1::bus::capture
