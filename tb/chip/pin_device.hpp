#pragma once
// The device that drives a chip's pins on the bench: its core, RTL, or both in lockstep (cosim/). Pins by their numbers
// in the PinTable of the chip's kind.
#include <cstdint>
#include <vector>

#include "model/profibus/addressee.hpp"
#include "model/profibus/event.hpp"
#include "model/profibus/uart_rx.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/pins/pins.hpp"
#include "tb/chip/user_cpu/register_port.hpp"

namespace dsdpv1::tb {

/// Receives the changes of output pins, in order of time. `call` is never null while attached.
struct PinSink {
  void (*call)(void* self, Tick at, PinNumber pin, Level level) = nullptr;
  void* self = nullptr;
};

class PinDevice {
 public:
  virtual ~PinDevice() = default;

  // --- Pins. Calls come in order of time.
  // Sets an input from tick `at` on, after running the device up to then. Setting the present level does nothing.
  virtual void set(Tick at, PinNumber pin, Level level) = 0;
  /// Runs up to and including tick `to`; reports changes and events to the sinks on the way.
  virtual void advance(Tick to) = 0;
  virtual Tick now() const = 0;
  /// The tick of its next event that needs no call, never before now().
  virtual Tick next_event() const = 0;
  /// As next_event(), without events that neither a pin nor an event shows; advance it before peek() then.
  virtual Tick next_seen() const { return next_event(); }
  /// The present level, of inputs and outputs.
  virtual Level level(PinNumber pin) const = 0;
  /// The level that a user gets who samples the data bus at tick `at`; kLevelX if it is not certain yet.
  virtual Level sample(Tick at) = 0;
  /// Reports changes of the outputs in `pins`. One sink; a second call replaces it.
  virtual void watch(const PinSink& sink, PinMask pins) = 0;
  /// As watch(). Changes that nobody can react to may be reported later, with their ticks, before those of other pins;
  /// of many without a cause only the last, at least as many as PinHistory keeps.
  virtual void watch_late(const PinSink& sink, PinMask pins) { watch(sink, pins); }
  virtual void on_event(const profibus::EventSink& sink) = 0;

  // --- Telegrams as a whole. Optional for devices that receive and show each change.
  // Changes of the line from `from` on and before `until` may be set late: call hear() in their order before the device
  // is advanced to its next_event() or another pin is set.
  virtual profibus::Unheard unheard() const { return {}; }
  virtual void hear(Tick /*at*/, bool /*level*/) {}
  /// Replaces the changes that `run` causes: called at tick `at`, at the run's start or in the idle time before it.
  /// False: the device needs the changes. True: do not set the line until the end of the run, unless it is left before.
  /// leave_run() leaves it: changes up to `at` have happened, later ones are set as usual. The device leaves it if it
  /// needs the changes from this tick on: left_run() is then true until leave_run() is called, at that tick.
  virtual bool hear(Tick /*at*/, const profibus::CharacterRun& /*run*/) { return false; }
  virtual void leave_run(Tick /*at*/) {}
  virtual bool left_run() const { return false; }
  /// As advance(), but stops at the tick at which it leaves the present run.
  virtual void advance_in_run(Tick to) { advance(to); }
  /// Runs that it may skip: of several in sequence it is enough to pass the last one, before anything else happens to
  /// it or advance() goes beyond its start. pass() counts the skipped runs that were for stations.
  virtual profibus::Unconcerned unconcerned() const { return {}; }
  virtual void pass(std::uint64_t /*count*/) {}
  /// True if the first start bit of an answer falls at now(). hide_txd() then returns its characters instead of changes
  /// of the pin, which keeps its level until the line's driver is disabled. show_txd() before that ends it: at tick
  /// `at` the pin takes its real level without a report, and changes are reported again.
  virtual bool begins_to_send() const { return false; }
  virtual profibus::CharacterRun hide_txd() { return {}; }
  virtual void show_txd(Tick /*at*/) {}

  // --- Internal state. RTL gets it from a core with the same inputs.
  virtual ChipStatus status() const = 0;
  /// The station's present address, 0 before the initialisation.
  virtual std::uint8_t address() const = 0;
  /// A cell of the memory shared by chip and user, without time or side effects; ChipKind::cells() of them.
  virtual std::uint8_t peek(std::uint16_t address) const = 0;
  virtual void poke(std::uint16_t address, std::uint8_t value) = 0;
  /// Accesses without the pins of a CPU's bus, of a device that is advanced to their tick; null: only by pins.
  virtual RegisterPort* registers() { return nullptr; }
  /// Reports internal signals that have changed since the last call; for a core with Engine::kStep.
  virtual void look_inside(Tick /*now*/, std::size_t /*number*/, ChipListener& /*listener*/) {}
  /// The item of its present access to that memory, as in its documents; empty: none, or unknown.
  virtual const char* works_on() const { return ""; }

  // --- The complete state of a core at now(), as bytes for restore() with the same parameters, in this process or
  // another.
  virtual std::vector<std::uint8_t> save() const { return {}; }
  /// Throws std::runtime_error, leaving the device unchanged, if the bytes are not from save().
  virtual void restore(const std::uint8_t* /*bytes*/, std::size_t /*size*/) {}
};

}  // namespace dsdpv1::tb
