#include "io/input/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace dsdpv1::tb {
namespace {

struct Unit {
  const char* name;
  bus::Tick ticks;
};
constexpr std::array<Unit, 5> kUnits = {{{"s", bus::kTicksPerSecond},
                                         {"ms", bus::kTicksPerMs},
                                         {"us", bus::kTicksPerUs},
                                         {"ns", bus::kTicksPerNs},
                                         {"cycles", kTicksPerCycle}}};

constexpr std::int64_t kLongest = 100'000'000;  // seconds; keeps every product below 2^63

/// Digits with at most one point, at least one digit; `end` is where they stop.
bool scan_decimal(const std::string& text, std::size_t& end, std::string& whole, std::string& fraction) {
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) whole += text[end++];
  if (end < text.size() && text[end] == '.') {
    ++end;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) fraction += text[end++];
    return !whole.empty() && !fraction.empty();
  }
  return !whole.empty();
}

/// whole.fraction units in ticks: exact in integers, rounded half up once at the end.
std::optional<bus::Tick> scale(const std::string& whole, const std::string& fraction, bus::Tick unit) {
  constexpr std::size_t kDigits = 9;
  if (whole.size() > 15 || fraction.size() > kDigits) return std::nullopt;
  const bus::Tick units = std::stoll(whole);
  if (units > kLongest * bus::kTicksPerSecond / unit) return std::nullopt;
  std::int64_t parts = 0, one = 1;
  for (const char digit : fraction) {
    parts = parts * 10 + (digit - '0');
    one *= 10;
  }
  // Two steps, because parts * unit can reach 10^9 * 1.2 * 10^10.
  const bus::Tick high = unit / one * parts;
  const bus::Tick low = (unit % one * parts + one / 2) / one;
  return units * unit + high + low;
}

}  // namespace

const char* const kTimeForm = "a number with a unit ns, us, ms, s or cycles, like 1.5ms";

std::optional<std::int64_t> parse_integer(const std::string& text) {
  const bool negative = !text.empty() && text[0] == '-';
  const std::string digits = text.substr(negative ? 1 : 0);
  const bool hex = digits.size() > 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
  const std::string body = hex ? digits.substr(2) : digits;
  const auto good = [hex](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return hex ? std::isxdigit(byte) != 0 : std::isdigit(byte) != 0;
  };
  if (body.empty() || body.size() > 15 || !std::all_of(body.begin(), body.end(), good)) return std::nullopt;
  const std::int64_t value = std::stoll(body, nullptr, hex ? 16 : 10);
  return negative ? -value : value;
}

std::optional<bus::Tick> parse_time(const std::string& text) {
  if (!text.empty() && text[0] == '-') {
    const std::optional<bus::Tick> positive =
        text.size() > 1 && text[1] != '-' ? parse_time(text.substr(1)) : std::nullopt;
    return positive ? std::optional(-*positive) : std::nullopt;
  }
  std::size_t end = 0;
  std::string whole, fraction;
  if (!scan_decimal(text, end, whole, fraction)) return std::nullopt;
  while (end < text.size() && text[end] == ' ') ++end;
  const std::string name = text.substr(end);
  for (const Unit& unit : kUnits)
    if (name == unit.name) return scale(whole, fraction, unit.ticks);
  return std::nullopt;
}

std::string time_text(bus::Tick ticks) {
  if (ticks == 0) return "0ns";
  if (ticks < 0) return "-" + time_text(-ticks);
  for (const Unit& unit : kUnits) {
    const bus::Tick whole = ticks / unit.ticks, rest = ticks % unit.ticks;
    if (whole == 0 || rest * 1000 % unit.ticks != 0) continue;
    std::string text = fmt::format("{}.{:03}", whole, rest * 1000 / unit.ticks);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + unit.name;
  }
  return fmt::format("{:.3f}ns", static_cast<double>(ticks) / static_cast<double>(bus::kTicksPerNs));
}

std::string cycle_text(bus::Tick at) {
  const bus::Tick rest = at % kTicksPerCycle;
  const std::string within = rest == 0 ? "" : fmt::format(" + {} ticks", rest);
  return fmt::format("cycle {}{} ({:.3f} us)", at / kTicksPerCycle, within,
                     static_cast<double>(at) / static_cast<double>(bus::kTicksPerUs));
}

std::optional<bus::Bytes> parse_bytes(const std::string& text) {
  bus::Bytes bytes;
  std::istringstream in(text);
  for (std::string token; in >> token;) {
    const std::size_t star = token.find('*');
    const std::string hex = token.substr(0, star);
    const std::string count = star == std::string::npos ? "1" : token.substr(star + 1);
    const auto is_hex = [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; };
    const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    if (hex.size() != 2 || !std::all_of(hex.begin(), hex.end(), is_hex)) return std::nullopt;
    if (count.empty() || count.size() > 3 || !std::all_of(count.begin(), count.end(), is_digit)) return std::nullopt;
    bytes.insert(bytes.end(), static_cast<std::size_t>(std::stoi(count)),
                 static_cast<std::uint8_t>(std::stoi(hex, nullptr, 16)));
  }
  return bytes;
}

std::string bytes_text(const bus::Bytes& bytes, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(bytes.size(), most); ++i)
    text += fmt::format("{}{:02X}", i == 0 ? "" : " ", bytes[i]);
  if (bytes.size() > most) text += fmt::format(" ... ({} bytes)", bytes.size());
  return text;
}

}  // namespace dsdpv1::tb
