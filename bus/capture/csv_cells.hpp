#pragma once
// Lines of a table, and what stands in their cells. Internal to the CSV readers.
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

/// Separated by semicolons or tabs if there are any, else by commas; without blanks and quotes. In a line with
/// semicolons or tabs a comma between digits is a decimal point.
std::vector<std::string> cells_of(const std::string& line);
/// A comment of sigrok or of a user, or nothing.
bool is_remark(const std::string& line);
std::optional<double> decimal(const std::string& cell);
/// A number, or a date and a time of day as in ISO 8601: "2026-11-29T12:00:00.000001", with a blank for T, with Z.
class TimeCell {
 public:
  /// A number in units of `unit` seconds, or the time since midnight of the first date. nullopt for anything else, or
  /// beyond three years.
  std::optional<Tick> read(const std::string& cell, double unit);

 private:
  std::optional<std::int64_t> first_day_;
};
bool is_time(const std::string& cell);
/// A line of times and levels or volts.
bool is_row(const std::vector<std::string>& cells);
/// The unit named in the first column's heading; 0 if it is not a time.
double seconds_of(const std::string& heading);

/// Reads lines up to a length, and knows their number.
class CsvLines {
 public:
  explicit CsvLines(std::istream& in) : in_(in) {}
  /// Returns false at the end. Throws CaptureError.
  bool next(std::string& line);
  [[noreturn]] void fail(const std::string& what) const { throw CaptureError(what, number_); }

 private:
  std::istream& in_;
  int number_ = 0;
};

}  // namespace dsdpv1::bus::capture
