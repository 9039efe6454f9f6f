#include "lab/traces/trace.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <sstream>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::traces {
namespace {

constexpr const char* kMagic = "golden trace 1";
constexpr int kMostWires = 15;  // of a pin
constexpr const char* kData = "data";
constexpr std::array<const char*, 3> kKinds = {"input", "output", "line"};  // by Signal::Kind

/// LEB128: seven bits a byte, the lowest first, bit 7 says that more follow.
void put(std::string& to, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7U) to += static_cast<char>(value | 0x80U);
  to += static_cast<char>(value);
}

std::uint64_t take(std::string_view& from) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; !from.empty() && shift < 64; shift += 7) {
    const auto byte = static_cast<unsigned char>(from.front());
    from.remove_prefix(1);
    value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) break;
  }
  return value;
}

/// Levels as numbers that are not negative: Z, X, then the values.
std::uint64_t code_of(Level level) {
  if (level == kLevelZ) return 0;
  return level == kLevelX ? 1 : static_cast<std::uint64_t>(level) + 2;
}

Level level_of(std::uint64_t code) {
  if (code == 0) return kLevelZ;
  return code == 1 ? kLevelX : static_cast<Level>(code - 2);
}

/// Reads the head line by line.
class Head {
 public:
  Head(std::string_view content, const std::string& file) : rest_(content), file_(file) {}

  std::istringstream line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail();
    std::istringstream words{std::string(rest_.substr(0, end))};
    rest_.remove_prefix(end + 1);
    return words;
  }
  std::string_view column(std::size_t bytes) {
    if (bytes > rest_.size()) fail();
    const std::string_view part = rest_.substr(0, bytes);
    rest_.remove_prefix(bytes);
    return part;
  }
  void expect_end() const {
    if (!rest_.empty()) fail();
  }
  [[noreturn]] void fail() const {
    throw InputError(file_, 0,
                     fmt::format("holds no trace, expected what begins with \"{}\" (docs/traces.md)", kMagic));
  }

 private:
  std::string_view rest_;
  const std::string& file_;
};

bool read_kind(const std::string& word, Signal::Kind& kind) {
  for (std::size_t i = 0; i < kKinds.size(); ++i)
    if (word == kKinds.at(i)) {
      kind = static_cast<Signal::Kind>(i);
      return true;
    }
  return false;
}

struct Sizes {
  std::size_t times = 0, levels = 0;  ///< bytes
};

bool read_signal(std::istringstream& line, Signal& signal, std::uint64_t& entries, Sizes& sizes) {
  std::string word, kind;
  line >> word >> signal.slave >> signal.name >> signal.width >> kind >> entries >> sizes.times >> sizes.levels;
  return line && word == "signal" && read_kind(kind, signal.kind) && signal.width >= 1 && signal.width <= kMostWires &&
         entries > 0 && entries <= sizes.times && entries <= sizes.levels;
}

}  // namespace

Signals signals_of(const scenario::Scenario& scenario) {
  Signals signals;
  for (const scenario::Slave& slave : scenario.slaves)
    for (const PinInfo& pin : slave.kind->pins())
      signals.push_back(
          {slave.name.text, pin.name, pin.width, pin.input ? Signal::Kind::kInput : Signal::Kind::kOutput});
  signals.push_back({"bus", "line", 1, Signal::Kind::kLine});
  return signals;
}

std::string level_words(const Signal& signal, Level level) {
  if (level == kLevelZ) return "Z";
  if (level == kLevelX) return "X";
  return signal.width == 1 ? fmt::format("{}", level) : fmt::format("{:0{}X}", level, (signal.width + 3) / 4);
}

void TraceWriter::change(std::size_t signal, Tick at, Level level) {
  Column& column = columns_[signal];
  ++column.entries;
  put(column.times, static_cast<std::uint64_t>(at - column.last));
  put(column.levels, code_of(level));
  column.last = at;
}

std::string TraceWriter::content(Tick end) const {
  std::string text = fmt::format("{}\nend {}\n", kMagic, end);
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const Signal& signal = signals_[i];
    const Column& column = columns_[i];
    text += fmt::format("signal {} {} {} {} {} {} {}\n", signal.slave, signal.name, signal.width,
                        kKinds.at(static_cast<std::size_t>(signal.kind)), column.entries, column.times.size(),
                        column.levels.size());
  }
  text += fmt::format("{}\n", kData);
  for (const Column& column : columns_) text.append(column.times).append(column.levels);
  return text;
}

void Cursor::step() {
  if (left_ == 0) {
    at_ = bus::kNever;
    return;
  }
  --left_;
  const std::uint64_t delta = take(times_);
  if (delta >= static_cast<std::uint64_t>(bus::kNever - at_)) {  // no run is so long
    left_ = 0;
    at_ = bus::kNever;
    return;
  }
  at_ += static_cast<Tick>(delta);
  level_ = level_of(take(levels_));
}

Trace::Trace(std::string content, const std::string& file) : content_(std::move(content)) {
  Head head(content_, file);
  if (head.line().str() != kMagic) head.fail();
  std::string word;
  if (!(head.line() >> word >> end_) || word != "end" || end_ < 0) head.fail();
  std::vector<Sizes> sizes;
  for (std::istringstream line = head.line(); line.str() != kData; line = head.line()) {
    signals_.emplace_back();
    columns_.emplace_back();
    sizes.emplace_back();
    if (!read_signal(line, signals_.back(), columns_.back().entries, sizes.back())) head.fail();
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    columns_[i].times = head.column(sizes[i].times);
    columns_[i].levels = head.column(sizes[i].levels);
  }
  head.expect_end();
}

std::uint64_t Trace::changes() const {
  return std::accumulate(
      columns_.begin(), columns_.end(), std::uint64_t{0},
      [](std::uint64_t sum, const Column& column) { return sum + column.entries - 1; });
}

std::vector<Cursor> Trace::cursors() const {
  std::vector<Cursor> cursors;
  for (std::size_t i = 0; i < signals_.size(); ++i) cursors.push_back(cursor(i));
  return cursors;
}

}  // namespace dsdpv1::tb::traces
