#include "lab/compare/scale.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace dsdpv1::tb::compare {
namespace {

constexpr std::array<std::pair<const char*, long double>, 7> kUnits = {
    {{"fs", 1.0L}, {"ps", 1e3L}, {"ns", 1e6L}, {"us", 1e9L}, {"ms", 1e12L}, {"s", 1e15L}, {"cycles", 125e6L / 6}}};
constexpr long double kMost = 9.2e18L;

long double power_of_ten(int exponent) { return std::pow(10.0L, static_cast<long double>(exponent)); }

}  // namespace

std::optional<Femtoseconds> parse_duration(const std::string& text) {
  if (text.find_first_not_of("+-.0123456789") == 0) return std::nullopt;  // inf, nan, hexadecimal
  char* end = nullptr;
  const long double number = std::strtold(text.c_str(), &end);
  for (const auto& [unit, size] : kUnits)
    if (end != text.c_str() && unit == std::string(end) && std::abs(number * size) < kMost)
      return std::llround(number * size);
  return std::nullopt;
}

Time Scale::from(Femtoseconds duration) const {
  return std::llround(static_cast<long double>(duration) / power_of_ten(exponent_ + 15));
}

std::optional<Time> Scale::from(std::uint64_t time, int exponent) const {
  constexpr std::uint64_t kLast = std::uint64_t{1} << 62U;
  for (int i = exponent_; i < exponent; ++i) {
    if (time > kLast / 10) return std::nullopt;
    time *= 10;
  }
  if (time > kLast) return std::nullopt;
  return static_cast<Time>(time);
}

bus::Tick Scale::tick(Time time) const {
  const long double ticks = static_cast<long double>(time) * bus::kTicksPerNs * power_of_ten(exponent_ + 9);
  return std::abs(ticks) < kMost ? std::llround(ticks) : bus::kNever;
}

std::uint64_t Scale::picoseconds(Time time) const {
  const long double ps = static_cast<long double>(time) * power_of_ten(exponent_ + 12);
  return ps > 0 && ps < kMost ? static_cast<std::uint64_t>(std::llround(ps)) : 0;
}

std::string Scale::text(Time time) const {
  constexpr std::array<const char*, 6> kNames = {"fs", "ps", "ns", "us", "ms", "s"};
  const int steps = exponent_ + 15;
  for (int i = 0; i < steps % 3; ++i) time *= 10;
  return fmt::format("{} {}", time, kNames.at(static_cast<std::size_t>(steps / 3)));
}

}  // namespace dsdpv1::tb::compare
