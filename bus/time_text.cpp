#include "bus/time_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace dsdpv1::bus {
namespace {

struct Unit {
  const char* name;
  Tick ticks;
};
constexpr std::array<Unit, 4> kUnits = {
    {{"s", kTicksPerSecond}, {"ms", kTicksPerMs}, {"us", kTicksPerUs}, {"ns", kTicksPerNs}}};

/// 1000 or more when rounded to so many digits after the point.
bool is_too_long(Tick ticks, const Unit& unit, int digits) {
  const double one = std::pow(10, digits);
  return std::round(static_cast<double>(ticks) / static_cast<double>(unit.ticks) * one) >= 1000 * one;
}

/// `digits`: those after the point in s, ms, us and ns.
std::string in_unit(Tick ticks, const std::array<int, 4>& digits) {
  if (ticks < 0) return "-" + in_unit(-ticks, digits);
  std::size_t i = digits.size() - 1;
  while (i > 0 && is_too_long(ticks, kUnits[i], digits[i])) --i;
  std::string number =
      fmt::format("{:.{}f}", static_cast<double>(ticks) / static_cast<double>(kUnits[i].ticks), digits[i]);
  while (number.size() - number.find('.') > 4 && number.compare(number.size() - 3, 3, "000") == 0)
    number.resize(number.size() - 3);
  return number + " " + kUnits[i].name;
}

}  // namespace

std::string short_time(Tick ticks) { return in_unit(ticks, {3, 3, 3, 3}); }

std::string moment_text(Tick ticks) { return in_unit(ticks, {9, 6, 3, 3}); }

std::string nanoseconds_text(Tick ticks) {
  const Tick thousandths = (ticks % kTicksPerNs * 1000 + kTicksPerNs / 2) / kTicksPerNs;
  return fmt::format("{}.{:03}", ticks / kTicksPerNs, thousandths);
}

}  // namespace dsdpv1::bus
