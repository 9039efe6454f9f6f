#include "bus/capture/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>

#include "bus/baud.hpp"
#include "bus/capture/csv_cells.hpp"
#include "bus/capture/csv_characters.hpp"
#include "bus/capture/lower_case.hpp"
#include "bus/capture/sample_clock.hpp"
#include "bus/capture/signal_decoder.hpp"

namespace dsdpv1::bus::capture {
namespace {

constexpr double kMostSamples = 1e15;

std::optional<bool> level(const std::string& cell) {
  if (cell == "0" || cell == "1") return cell == "1";
  return std::nullopt;
}

/// A signal in volts: its level by the middle of what it has shown, with hysteresis.
class Volts {
 public:
  bool moved() const { return level_.has_value(); }
  /// nullopt before the signal has moved.
  std::optional<bool> level(double volts) {
    constexpr double kLeastSwing = 0.5, kHysteresis = 0.2;  // V; share of the swing
    low_ = std::min(low_, volts);
    high_ = std::max(high_, volts);
    const double swing = high_ - low_, middle = (high_ + low_) / 2;
    if (swing < kLeastSwing) return std::nullopt;
    if (!level_ || std::abs(volts - middle) > kHysteresis / 2 * swing) level_ = volts > middle;
    return level_;
  }

 private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
  std::optional<bool> level_;
};

class Table {
 public:
  Table(CsvLines& lines, LevelTaker& taker) : lines_(lines), taker_(taker) {}

  /// `line`: the first.
  std::optional<std::uint64_t> read(std::string line) {
    do {
      if (is_remark(line))
        remark(line);
      else if (!begun_)
        begin(cells_of(line));
      else
        row(cells_of(line));
    } while (lines_.next(line));
    if (!begun_) fail("is empty, expected a table of levels");
    taker_.finish(last_);
    return rate_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { lines_.fail(what); }

  /// "; Samplerate: 24 MHz", "META samplerate: 24000000", "; Channels (2/2): D0, D1".
  void remark(const std::string& line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) return;
    const std::string name = lower_case(line.substr(0, colon));
    std::string value = line.substr(colon + 1);
    value.erase(0, value.find_first_not_of(" \t"));
    value.erase(value.find_last_not_of(" \t\r") + 1);
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
    const bool row_already = is_row(cells), sampled = lower_case(cells[0]) == "x" && cells.size() > 2;
    time_unit_ = row_already ? (clock_ ? 0 : 1) : sampled ? 1 : seconds_of(cells[0]);
    counted_ = !row_already && lower_case(cells[0]) == "samples";
    first_ = time_unit_ != 0 || counted_ ? 1 : 0;
    columns_ = cells.size();
    if (sampled) find_increment(cells);
    if (columns_ <= first_) fail("has no column of levels, expected a time and levels, or levels");
    if (time_unit_ == 0 && !clock_)
      fail("neither a time in the first column nor a samplerate before, expected one of them");
    name_signals(cells, row_already);
    chosen_ = taker_.choose(names_);
    volts_.resize(chosen_.size());
    begun_ = true;
    if (row_already) row(cells);
  }

  /// "X,CH1,Start,Increment": the line of units below has both.
  void find_increment(const std::vector<std::string>& cells) {
    const auto at = [&cells](const char* name) {
      const auto found = std::find_if(cells.begin(), cells.end(),
                                      [name](const std::string& cell) { return lower_case(cell) == name; });
      return static_cast<std::size_t>(found - cells.begin());
    };
    start_ = at("start");
    increment_ = at("increment");
    if (increment_ < cells.size()) columns_ = std::min(start_, increment_);
  }

  bool are_units(const std::vector<std::string>& cells) const {
    const auto number = [](const std::string& cell) { return decimal(cell).has_value(); };
    return !is_time(cells[0]) && (increment_ != 0 || std::none_of(cells.begin(), cells.end(), number));
  }

  /// "Second,Volt", "(ms),(V)", "Sequence,Volt,-0.001,1e-8".
  void units(const std::vector<std::string>& cells) {
    if (const double unit = seconds_of(cells[0]); unit != 0) time_unit_ = unit;
    const auto number = [&cells](std::size_t at) { return at < cells.size() ? decimal(cells[at]) : std::nullopt; };
    if (const auto step = number(increment_)) {
      time_unit_ = *step;
      offset_ = std::llround(number(start_).value_or(0) * static_cast<double>(kTicksPerSecond));
    }
  }

  void name_signals(const std::vector<std::string>& cells, bool row_already) {
    const std::size_t count = columns_ - first_;
    const bool own = !row_already && cells[first_] != "logic";
    if (!own && names_.size() == count) return;
    names_.clear();
    for (std::size_t i = 0; i < count; ++i) names_.push_back(own ? cells[first_ + i] : fmt::format("{}", i));
  }

  void row(const std::vector<std::string>& cells) {
    if (rows_ == 0 && are_units(cells)) return units(cells);
    if (cells.size() != columns_ && increment_ == 0)
      fail(fmt::format("has {} columns, expected {} as in the first", cells.size(), columns_));
    if (cells.size() < columns_) fail(fmt::format("has {} columns, expected {}", cells.size(), columns_));
    const Tick at = time_of(cells);
    if (at < last_) fail("goes back in time, expected the order of time");
    last_ = at;
    ++rows_;
    for (std::size_t which = 0; which < chosen_.size(); ++which) take(at, which, cells[first_ + chosen_[which]]);
  }

  void take(Tick at, std::size_t which, const std::string& cell) {
    std::optional<Volts>& volts = volts_[which];
    const std::optional<bool> digital = volts ? std::nullopt : level(cell);
    if (digital) return taker_.level(at, which, *digital);
    const std::optional<double> value = decimal(cell);
    if (!value || (!volts && cell.find_first_of(".eE") == std::string::npos))
      fail(fmt::format("level {}, expected 0 or 1, or volts like 3.3", cell.substr(0, 40)));
    if (!volts) volts.emplace();
    const bool still = !volts->moved();
    const std::optional<bool> now = volts->level(*value);
    if (!now) return;
    if (still) taker_.level(at, which, !*now);  // up to its first change it was the other way round
    taker_.level(at, which, *now);
  }

  Tick time_of(const std::vector<std::string>& cells) {
    if (time_unit_ == 0 && !counted_) return clock_->at(sample_++);
    if (counted_) {
      const std::optional<double> count = decimal(cells[0]);
      if (count && *count >= 0 && *count < kMostSamples) return clock_->at(static_cast<std::uint64_t>(*count));
    }
    const std::optional<Tick> time = times_.read(cells[0], time_unit_);
    if (!time || counted_) fail(fmt::format("time {}, expected a number or a date and time", cells[0].substr(0, 40)));
    const Tick at = *time + offset_;
    if (!zero_) zero_ = clocked_by_day(cells[0]) ? at : std::min<Tick>(at, 0);  // a trigger may come after the first
    return at - *zero_;
  }

  static bool clocked_by_day(const std::string& cell) { return !decimal(cell).has_value(); }

  CsvLines& lines_;
  LevelTaker& taker_;
  TimeCell times_;
  std::optional<SampleClock> clock_;
  std::vector<std::string> names_;
  std::optional<std::uint64_t> rate_;
  std::vector<std::size_t> chosen_;
  bool begun_ = false;
  std::size_t columns_ = 0, first_ = 0;
  double time_unit_ = 0;  ///< seconds per unit of the first column; 0: samples of the clock
  bool counted_ = false;  ///< the first column is the number of the sample
  std::uint64_t sample_ = 0;
  std::vector<std::optional<Volts>> volts_;  ///< by chosen signal
  std::size_t start_ = 0, increment_ = 0;    ///< columns of the line of units; 0: none
  Tick offset_ = 0;
  std::uint64_t rows_ = 0;
  std::optional<Tick> zero_;
  Tick last_ = 0;
};

}  // namespace

bool begins_as_csv(std::string_view beginning) {
  bool headed = false;
  for (std::size_t at = 0; at < beginning.size();) {
    const std::size_t end = std::min(beginning.find('\n', at), beginning.size());
    const std::string line(beginning.substr(at, end - at));
    at = end + 1;
    if (line.find("libsigrok") != std::string::npos || line.compare(0, 5, "META ") == 0) return true;
    if (is_remark(line) || line == "\r") continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 2) return false;
    if (is_row(cells)) return level(cells[1]).has_value() || cells[1].find('.') != std::string::npos;
    if (headed) return true;
    if (character_columns(cells)) return true;
    headed = seconds_of(cells[0]) != 0 || lower_case(cells[0]) == "x";
    if (!headed) return false;
  }
  return headed;
}

namespace {

std::string first_line(CsvLines& lines) {
  std::string line;
  if (!lines.next(line)) lines.fail("is empty, expected a table of levels");
  return line;
}

}  // namespace

std::optional<std::uint64_t> read_csv_levels(std::istream& in, LevelTaker& taker) {
  CsvLines lines(in);
  return Table(lines, taker).read(first_line(lines));
}

LogicSource read_csv(std::istream& in, const LogicSettings& settings, const TakeTelegram& take) {
  CsvLines lines(in);
  const std::string first = first_line(lines);
  if (const auto columns = character_columns(cells_of(first))) return read_characters(lines, *columns, settings, take);
  SignalDecoder decoder(settings, take);
  Table(lines, decoder).read(first);
  return decoder.source();
}

}  // namespace dsdpv1::bus::capture
