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

/// A time that is not a whole tick: for a wave from another program.
struct Picoseconds {
  std::uint64_t count = 0;
};

class WaveWriter {
 public:
  using Signal = std::uint32_t;
  /// Levels as the chip's pins have them: 0.. a value, kReleased Z on every wire, kUnknown X on every wire.
  static constexpr int kReleased = -1, kUnknown = -2;

  virtual ~WaveWriter() = default;

  // Declarations, all before the first change. Names are plain words; `width` is 1 to 32 wires, any number if the
  // values are levels.
  virtual void open_scope(const std::string& name) = 0;
  virtual void close_scope() = 0;
  virtual Signal wire(const std::string& name, int width) = 0;
  /// A signal whose values are words, such as a state.
  virtual Signal words(const std::string& name) = 0;
  /// Another name, in the open scope, for a declared signal.
  virtual void alias(const std::string& name, Signal of) = 0;

  // Changes; `at` never decreases (std::logic_error).
  virtual void set(bus::Tick at, Signal signal, int level) = 0;
  virtual void say(bus::Tick at, Signal signal, std::string_view word) = 0;

  // The same for a WaveReader's values: `levels` has one of 0, 1, x, z for each bit. A writer gets all its times either
  // in ps or in ticks.
  virtual void set(Picoseconds at, Signal signal, std::string_view levels) = 0;
  virtual void say(Picoseconds at, Signal signal, std::string_view word) = 0;
  virtual void finish(Picoseconds end) = 0;

  /// Puts all changes up to `at` into the temporary file, where `dsdpv1-sim recover` finds them. `at` is not before any
  /// change so far, and no later change is before it.
  virtual void save(bus::Tick at) = 0;
  /// True when a write has failed: then continuing is useless.
  virtual bool failed() const = 0;
  /// Throws InputError when a write has failed.
  virtual void check() const = 0;

  /// Finishes the file at `end` and gives it its name; throws InputError when it cannot be written. A writer that is
  /// destroyed without it leaves no file.
  virtual void finish(bus::Tick end) = 0;
};

/// The writer for the file's ending, .vcd or .fst. `date`: the file's date in one line; empty: none. Throws
/// InputError for others, when the file cannot be created, and for .fst in a program built without it.
std::unique_ptr<WaveWriter> open_wave(const std::string& path, const std::string& date = "");

/// Checks only the ending, before a run is started, with the same errors.
void check_wave_name(const std::string& path);

}  // namespace dsdpv1::tb
