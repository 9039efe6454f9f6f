#pragma once
// Waves: a hierarchy of signals and their changes in order of time. The time scale of the files is 1 ps; each change is
// converted from its absolute tick (1/12 ns) and rounded once, so nothing drifts.
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "bus/time.hpp"

namespace dsdpv1::tb {

/// Picoseconds since the start, rounded to the nearest.
constexpr std::uint64_t picoseconds(bus::Tick tick) { return (static_cast<std::uint64_t>(tick) * 500 + 3) / 6; }

/// A time that is no whole tick: of a wave that comes from elsewhere.
struct Picoseconds {
  std::uint64_t count = 0;
};

class WaveWriter {
 public:
  using Signal = std::uint32_t;
  /// Levels as the chip's pins have them: 0.. a value, kReleased Z on every wire, kUnknown X on every wire.
  static constexpr int kReleased = -1, kUnknown = -2;

  virtual ~WaveWriter() = default;

  // Declarations, all before the first change. Names are plain words; `width` is 1 to 32 wires, any number where the
  // values are levels.
  virtual void open_scope(const std::string& name) = 0;
  virtual void close_scope() = 0;
  virtual Signal wire(const std::string& name, int width) = 0;
  /// A signal whose values are words, like a state.
  virtual Signal words(const std::string& name) = 0;
  /// One more name, in the scope that is open, for a signal that is declared already.
  virtual void alias(const std::string& name, Signal of) = 0;

  // Changes; `at` never decreases (std::logic_error).
  virtual void set(bus::Tick at, Signal signal, int level) = 0;
  virtual void say(bus::Tick at, Signal signal, std::string_view word) = 0;

  // The same for values as a WaveReader has them: `levels` are as many of 0, 1, x, z as the signal is wide. A writer
  // gets all its times either so or as ticks.
  virtual void set(Picoseconds at, Signal signal, std::string_view levels) = 0;
  virtual void say(Picoseconds at, Signal signal, std::string_view word) = 0;
  virtual void finish(Picoseconds end) = 0;

  /// What was written up to `at` is in the temporary file, where `dsdpv1-sim recover` finds it. `at` is not before any
  /// change so far, and no later change is before it.
  virtual void save(bus::Tick at) = 0;
  /// Whether something could not be written: there is no use in going on.
  virtual bool failed() const = 0;
  /// Throws InputError when it has.
  virtual void check() const = 0;

  /// Finishes the file at `end` and gives it its name; throws InputError when it cannot be written. A writer that is
  /// destroyed without it leaves no file.
  virtual void finish(bus::Tick end) = 0;
};

/// The writer for the file's ending, .vcd or .fst. `date`: of the file, in one line; empty: it has none. Throws
/// InputError for others, when the file cannot be created, and for .fst when this program was built without it.
std::unique_ptr<WaveWriter> open_wave(const std::string& path, const std::string& date = "");

/// Checks the ending alone, before a run is started: the same errors.
void check_wave_name(const std::string& path);

}  // namespace dsdpv1::tb
