#pragma once
// A trace in the form of its decompressed file (docs/traces.md): a head in text, then each signal's changes.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lab/traces/tap.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::traces {

struct Signal {
  enum class Kind : std::uint8_t { kInput, kOutput, kLine };  ///< inputs and outputs are the chip's

  std::string slave;  ///< "bus" for the line
  std::string name;   ///< the pin's, "line" for the line
  int width = 1;      ///< number of wires, 1..15
  Kind kind = Kind::kInput;

  bool operator==(const Signal& other) const {
    return slave == other.slave && name == other.name && width == other.width && kind == other.kind;
  }
};
/// All pins of each slave, in the order of the scenario and of the chip's pin table, then the line.
using Signals = std::vector<Signal>;

Signals signals_of(const scenario::Scenario& scenario);

/// "1", "7FF", "Z", "X".
std::string level_words(const Signal& signal, Level level);

/// Size limit of a trace.
constexpr std::size_t kMostBytes = 256U << 20U;

/// Builds a trace from a run.
class TraceWriter : public Sink {
 public:
  explicit TraceWriter(Signals signals) : signals_(std::move(signals)), columns_(signals_.size()) {}
  void change(std::size_t signal, Tick at, Level level) override;
  /// The trace of a run that has ended at `end`.
  std::string content(Tick end) const;

 private:
  struct Column {
    std::uint64_t entries = 0;
    Tick last = 0;
    std::string times, levels;
  };
  Signals signals_;
  std::vector<Column> columns_;
};

/// The changes of one signal, one after the other. A view of a Trace, which must outlive it.
class Cursor {
 public:
  Cursor(std::string_view times, std::string_view levels, std::uint64_t entries)
      : times_(times), levels_(levels), left_(entries) {
    step();
  }
  /// The next change; `at` is bus::kNever at the end.
  Tick at() const { return at_; }
  Level level() const { return level_; }
  /// Advances to the change after it.
  void step();

 private:
  std::string_view times_, levels_;
  std::uint64_t left_;
  Tick at_ = 0;
  Level level_ = kLevelX;
};

class Trace {
 public:
  struct Column {
    std::uint64_t entries = 0;  ///< with the level of power-on
    std::string_view times, levels;
  };
  /// Reads a decompressed trace; throws InputError, with `file` in its text.
  Trace(std::string content, const std::string& file);
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

  const std::string& content() const { return content_; }
  const Signals& signals() const { return signals_; }
  Tick end() const { return end_; }
  /// Number of changes, without the level of power-on.
  std::uint64_t changes(std::size_t signal) const { return columns_[signal].entries - 1; }
  std::uint64_t changes() const;
  Cursor cursor(std::size_t signal) const {
    const Column& column = columns_[signal];
    return {column.times, column.levels, column.entries};
  }
  std::vector<Cursor> cursors() const;

 private:
  const std::string content_;
  Signals signals_;
  std::vector<Column> columns_;
  Tick end_ = 0;
};

}  // namespace dsdpv1::tb::traces
