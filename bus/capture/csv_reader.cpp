#include "bus/capture/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <istream>

#include "bus/baud.hpp"
#include "bus/capture/lower_case.hpp"
#include "bus/capture/sample_clock.hpp"
#include "bus/capture/signal_decoder.hpp"

namespace dsdpv1::bus::capture {
namespace {

constexpr std::size_t kLongestLine = 65'536;
constexpr double kLongestTime = 1e8;  ///< seconds, three years
constexpr double kMostSamples = 1e15;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t comma = std::min(line.find(',', at), line.size());
    cells.push_back(trimmed(line.substr(at, comma - at)));
    at = comma + 1;
  }
  return cells;
}

std::optional<double> decimal(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0') return std::nullopt;
  return value;
}

std::optional<bool> level(const std::string& cell) {
  if (cell == "0" || cell == "1") return cell == "1";
  return std::nullopt;
}

bool is_remark(const std::string& line) {
  return line.empty() || line[0] == ';' || line[0] == '#' || line.compare(0, 4, "META") == 0;
}

bool is_row(const std::vector<std::string>& cells) {
  return std::all_of(
      cells.begin(), cells.end(), [](const std::string& cell) { return decimal(cell).has_value(); });
}

/// The unit named in the first column's heading; 0 if it is not a time.
double seconds_of(const std::string& heading) {
  const std::string name = lower_case(heading);
  const auto has = [&name](const char* part) { return name.find(part) != std::string::npos; };
  if (!has("time") && !has("second")) return 0;
  if (has("milli") || has("[ms]")) return 1e-3;
  if (has("micro") || has("[us]")) return 1e-6;
  return has("nano") || has("[ns]") ? 1e-9 : 1;
}

class Table {
 public:
  Table(std::istream& in, LevelTaker& taker) : in_(in), taker_(taker) {}

  std::optional<std::uint64_t> read() {
    for (std::string line; next(line);)
      if (is_remark(line))
        remark(line);
      else if (!begun_)
        begin(cells_of(line));
      else
        row(cells_of(line));
    if (!begun_) fail("is empty, expected a table of levels");
    taker_.finish(last_);
    return rate_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw CaptureError(what, number_); }

  /// Returns false at the end.
  bool next(std::string& line) {
    line.clear();
    ++number_;
    for (char c = 0; in_.get(c) && c != '\n';) {
      line += c;
      if (line.size() > kLongestLine)
        fail(fmt::format("is longer than {} bytes, expected lines of up to that", kLongestLine));
    }
    return in_.good() || !line.empty();
  }

  /// "; Samplerate: 24 MHz", "META samplerate: 24000000", "; Channels (2/2): D0, D1".
  void remark(const std::string& line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) return;
    const std::string name = lower_case(line.substr(0, colon)), value = trimmed(line.substr(colon + 1));
    if (name.find("samplerate") != std::string::npos) {
      const auto rate = sample_rate(value);
      if (!rate) fail(fmt::format("samplerate {}, expected a number and Hz, kHz, MHz or GHz", value.substr(0, 40)));
      clock_.emplace(*rate);
      rate_ = rate;
    }
    if (name.find("channels") != std::string::npos) names_ = cells_of(value);
  }

  /// The first line of the table, which may be headings.
  void begin(const std::vector<std::string>& cells) {
    const bool row_already = is_row(cells);
    time_unit_ = row_already ? (clock_ ? 0 : 1) : seconds_of(cells[0]);
    counted_ = !row_already && lower_case(cells[0]) == "samples";
    first_ = time_unit_ != 0 || counted_ ? 1 : 0;
    columns_ = cells.size();
    if (columns_ <= first_) fail("has no column of levels, expected a time and levels, or levels");
    if (time_unit_ == 0 && !clock_)
      fail("neither a time in the first column nor a samplerate before, expected one of them");
    name_signals(cells, row_already);
    chosen_ = taker_.choose(names_);
    begun_ = true;
    if (row_already) row(cells);
  }

  void name_signals(const std::vector<std::string>& cells, bool row_already) {
    const std::size_t count = columns_ - first_;
    const bool own = !row_already && cells[first_] != "logic";
    if (!own && names_.size() == count) return;
    names_.clear();
    for (std::size_t i = 0; i < count; ++i) names_.push_back(own ? cells[first_ + i] : fmt::format("{}", i));
  }

  void row(const std::vector<std::string>& cells) {
    if (cells.size() != columns_)
      fail(fmt::format("has {} columns, expected {} as in the first", cells.size(), columns_));
    const Tick at = time_of(cells);
    if (at < last_) fail("goes back in time, expected the order of time");
    last_ = at;
    for (std::size_t which = 0; which < chosen_.size(); ++which) {
      const std::string& cell = cells[first_ + chosen_[which]];
      const std::optional<bool> now = level(cell);
      if (!now) fail(fmt::format("level {}, expected 0 or 1", cell.substr(0, 40)));
      taker_.level(at, which, *now);
    }
  }

  Tick time_of(const std::vector<std::string>& cells) {
    if (time_unit_ == 0 && !counted_) return clock_->at(sample_++);
    const std::optional<double> time = decimal(cells[0]);
    if (counted_ && time && *time >= 0 && *time < kMostSamples) return clock_->at(static_cast<std::uint64_t>(*time));
    if (!time || !(std::abs(*time) * time_unit_ < kLongestTime))
      fail(fmt::format("time {}, expected a number", cells[0].substr(0, 40)));
    const Tick at = std::llround(*time * time_unit_ * static_cast<double>(kTicksPerSecond));
    if (!zero_) zero_ = std::min<Tick>(at, 0);  // a trigger may come after the first change
    return at - *zero_;
  }

  std::istream& in_;
  LevelTaker& taker_;
  std::optional<SampleClock> clock_;
  std::vector<std::string> names_;
  std::optional<std::uint64_t> rate_;
  std::vector<std::size_t> chosen_;
  bool begun_ = false;
  std::size_t columns_ = 0, first_ = 0;
  double time_unit_ = 0;  ///< seconds per unit of the first column; 0: samples of the clock
  bool counted_ = false;  ///< the first column is the number of the sample
  std::uint64_t sample_ = 0;
  std::optional<Tick> zero_;
  Tick last_ = 0;
  int number_ = 0;
};

}  // namespace

bool begins_as_csv(std::string_view beginning) {
  std::size_t at = 0;
  while (at < beginning.size()) {
    const std::size_t end = std::min(beginning.find('\n', at), beginning.size());
    const std::string line(beginning.substr(at, end - at));
    at = end + 1;
    if (line.find("libsigrok") != std::string::npos || line.compare(0, 5, "META ") == 0) return true;
    if (is_remark(trimmed(line))) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 2) return false;
    return is_row(cells) ? level(cells[1]).has_value() : seconds_of(cells[0]) != 0;
  }
  return false;
}

std::optional<std::uint64_t> read_csv_levels(std::istream& in, LevelTaker& taker) { return Table(in, taker).read(); }

LogicSource read_csv(std::istream& in, const LogicSettings& settings, const TakeTelegram& take) {
  SignalDecoder decoder(settings, take);
  read_csv_levels(in, decoder);
  return decoder.source();
}

}  // namespace dsdpv1::bus::capture
