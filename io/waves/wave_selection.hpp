#pragma once
// Selects the signals and the times of a run that go into its wave, by window or around triggers. Also writes CLK,
// which has no other writer.
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/waves/wave_writer.hpp"

namespace dsdpv1::tb {

/// The scope of CLK.
constexpr const char* kClockScope = "clock";

struct WaveSelection {
  /// Patterns of the shell (* ? [..]) on "scope.signal"; empty: every signal.
  std::vector<std::string> signals;
  /// The window, both ends in it.
  bus::Tick from = 0, to = bus::kNever;
  /// Windows around each `trigger` instead of a single one: this long before and after it.
  bool on_trigger = false;
  bus::Tick around = 0;
  /// Writes a bus as single wires, "A[10]": for readers that support nothing else (sigrok).
  bool wires_only = false;
  /// A signal clock.CLK: 48 MHz, rising at every cycle.
  bool clock = false;
};

/// Passes the selected changes to a writer; for its functions see WaveWriter. A signal's value before a window is its
/// first value there; after a window, in the same file, it is unknown.
class SelectedWave {
 public:
  using Signal = WaveWriter::Signal;

  SelectedWave(std::unique_ptr<WaveWriter> writer, WaveSelection selection);

  void open_scope(const std::string& name);
  void close_scope();
  Signal wire(const std::string& name, int width);
  Signal words(const std::string& name);
  void set(bus::Tick at, Signal signal, int level);
  void say(bus::Tick at, Signal signal, std::string_view word);
  void save(bus::Tick at);
  bool failed() const { return writer_->failed(); }
  void check() const { writer_->check(); }
  /// With `on_trigger` and no trigger all signals are unknown from 0 to `end`.
  void finish(bus::Tick end);

  /// Call after all declarations. Throws InputError for a pattern that matches no signal.
  void check_patterns() const;
  /// Replaces the window; call before it begins.
  void set_window(bus::Tick from, bus::Tick to) {
    selection_.from = from;
    selection_.to = to;
  }
  /// The same, and forgets all previous changes.
  void begin_again(bus::Tick from, bus::Tick to);
  /// Reports a trigger at `at`, at most a millisecond before the last change.
  void trigger(bus::Tick at);
  /// True when anything has been written.
  bool has_window() const { return closed_at_ >= 0 || open_; }

 private:
  struct Value {
    int level = WaveWriter::kUnknown;
    std::string word;
  };
  struct Declared {
    Signal signal = 0;  ///< the writer's handle, that of the lowest wire
    int wires = 1;      ///< number of wires written
    bool selected = false, is_word = false;
    bool told = false;  ///< has a value
    Value value;        ///< value before the kept changes
  };
  struct Change {
    bus::Tick at = 0;
    Signal signal = 0;
    Value value;
  };

  Signal declare(const std::string& name, bool is_word, int width);
  std::string path_of(const std::string& name) const;
  bool wants(const std::string& path, bool is_word) const;
  void declare_wires(Declared& declared, const std::string& name, int width);
  bool fits(const std::string& pattern, const std::string& path) const;
  void keep(Change change);
  void forget_before(bus::Tick at);
  void open(bus::Tick at);
  void close();
  void advance(bus::Tick at);
  void write_kept(Change& change);
  /// Writes its new value.
  void write(bus::Tick at, Declared& signal);
  void write_value(bus::Tick at, const Declared& signal, const Value& value);
  void tick_to(bus::Tick at);
  bus::Tick end_of_window() const { return selection_.on_trigger ? until_ : selection_.to; }

  std::unique_ptr<WaveWriter> writer_;
  WaveSelection selection_;
  std::vector<std::string> scopes_, names_;
  std::vector<Declared> signals_;
  std::deque<Change> kept_;  ///< the last ones, while no window is open
  bool open_ = false;
  bus::Tick until_ = -1;      ///< end of the window that a trigger has opened
  bus::Tick closed_at_ = -1;  ///< end of the last window
  Signal clock_ = 0;
  bus::Tick next_clock_ = 0;  ///< the next change of CLK
};

}  // namespace dsdpv1::tb
