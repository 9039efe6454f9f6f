#include "bus/capture/csv_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <istream>

#include "bus/capture/lower_case.hpp"

namespace dsdpv1::bus::capture {
namespace {

constexpr std::size_t kLongestRow = 65'536;
constexpr double kLongestTime = 1e8;  ///< seconds, three years

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

bool is_number_with_comma(const std::string& cell) {
  return std::count(cell.begin(), cell.end(), ',') == 1 &&
         cell.find_first_not_of("+-0123456789,eE") == std::string::npos;
}

/// Days since 1970 of a date in the Gregorian calendar.
std::int64_t days_of(int year, int month, int day) {
  const std::int64_t y = month <= 2 ? year - 1 : year, era = y / 400, of_era = y % 400;
  const std::int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146'097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719'468;
}

/// A point in time: days, and ticks of the day.
struct Moment {
  std::int64_t day;
  Tick tick;
};

std::optional<Moment> moment_of(const std::string& cell) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  const int read =
      std::sscanf(cell.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d:%n", &year, &month, &day, &hour, &minute, &used);
  if (read != 5 || used == 0 || year < 1970 || month < 1 || month > 12) return std::nullopt;
  char* end = nullptr;
  const double second = std::strtod(cell.c_str() + used, &end);
  const std::string zone(end);
  if (end == cell.c_str() + used || !(second >= 0 && second < 61)) return std::nullopt;
  if (!zone.empty() && zone != "Z" && zone[0] != '+' && zone[0] != '-') return std::nullopt;
  const Tick minutes = (hour * 60 + minute) * 60 * kTicksPerSecond;
  return Moment{days_of(year, month, day), minutes + std::llround(second * static_cast<double>(kTicksPerSecond))};
}

}  // namespace

std::vector<std::string> cells_of(const std::string& line) {
  const char separator = line.find('\t') != std::string::npos ? '\t' : line.find(';') != std::string::npos ? ';' : ',';
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    if (separator != ',' && is_number_with_comma(cells.back()))
      std::replace(cells.back().begin(), cells.back().end(), ',', '.');
    at = end + 1;
  }
  return cells;
}

bool is_remark(const std::string& line) {
  return line.empty() || line[0] == ';' || line[0] == '#' || line.compare(0, 4, "META") == 0;
}

std::optional<double> decimal(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0') return std::nullopt;
  return value;
}

std::optional<Tick> TimeCell::read(const std::string& cell, double unit) {
  constexpr std::int64_t kMostDays = 1000;
  if (const std::optional<Moment> moment = moment_of(cell)) {
    if (!first_day_) first_day_ = moment->day;
    const std::int64_t days = moment->day - *first_day_;
    if (days < 0 || days > kMostDays) return std::nullopt;
    return days * 24 * 3600 * kTicksPerSecond + moment->tick;
  }
  const std::optional<double> time = decimal(cell);
  if (!time || !(std::abs(*time) * unit < kLongestTime)) return std::nullopt;
  return std::llround(*time * unit * static_cast<double>(kTicksPerSecond));
}

bool is_time(const std::string& cell) { return decimal(cell).has_value() || moment_of(cell).has_value(); }

bool is_row(const std::vector<std::string>& cells) {
  return is_time(cells[0]) &&
         std::all_of(
             cells.begin() + 1, cells.end(), [](const std::string& cell) { return decimal(cell).has_value(); });
}

double seconds_of(const std::string& heading) {
  const std::string name = lower_case(heading);
  const auto has = [&name](const char* part) { return name.find(part) != std::string::npos; };
  if (!has("time") && !has("second") && name != "(s)" && name != "(ms)" && name != "(us)" && name != "(ns)") return 0;
  if (has("milli") || has("[ms]") || has("(ms)")) return 1e-3;
  if (has("micro") || has("[us]") || has("(us)")) return 1e-6;
  return has("nano") || has("[ns]") || has("(ns)") ? 1e-9 : 1;
}

bool CsvLines::next(std::string& line) {
  line.clear();
  ++number_;
  for (char c = 0; in_.get(c) && c != '\n';) {
    line += c;
    if (line.size() > kLongestRow)
      fail(fmt::format("is longer than {} bytes, expected lines of up to that", kLongestRow));
  }
  return in_.good() || !line.empty();
}

}  // namespace dsdpv1::bus::capture
