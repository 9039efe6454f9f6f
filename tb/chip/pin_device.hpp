#pragma once
// What stands behind a chip's pins on the bench: its core, RTL, or both side by side (cosim/). Pins by their numbers in
// the PinTable of the chip's kind.
#include <cstdint>
#include <vector>

#include "model/profibus/addressee.hpp"
#include "model/profibus/event.hpp"
#include "model/profibus/uart_rx.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/pins/pins.hpp"

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
  /// An input has this level from tick `at` on; the device first does what it does up to then. The level that it has
  /// already: nothing.
  virtual void set(Tick at, PinNumber pin, Level level) = 0;
  /// Does everything up to and including tick `to`; changes and events leave through the sinks on the way.
  virtual void advance(Tick to) = 0;
  virtual Tick now() const = 0;
  /// The tick of the next thing that it does by itself, never before now().
  virtual Tick next_event() const = 0;
  /// The same without what neither a pin nor an event shows; peek() wants it to be advanced then.
  virtual Tick next_seen() const { return next_event(); }
  /// The present level, of inputs and outputs.
  virtual Level level(PinNumber pin) const = 0;
  /// The user samples the data bus at tick `at`: the level then; kLevelX when that is not certain yet.
  virtual Level sample(Tick at) = 0;
  /// Tells changes of the outputs in `pins`. One sink; a second call replaces it.
  virtual void watch(const PinSink& sink, PinMask pins) = 0;
  virtual void on_event(const profibus::EventSink& sink) = 0;

  // --- Telegrams as a whole. A device that hears and shows each change leaves all of it alone.
  /// Changes of the line from `from` on and before `until` need not be set at once: hear() in their order, before the
  /// device is advanced to its next_event() or another pin is set, is early enough.
  virtual profibus::Unheard unheard() const { return {}; }
  virtual void hear(Tick /*at*/, bool /*level*/) {}
  /// In the place of the changes that `run` comes to: called at tick `at`, at the run's start or in the idle time
  /// before it. False: it wants the changes. True: the line is not set until the end of the run, unless it is left
  /// before. By leave_run(): changes up to `at` have happened, those after it are set as ever. By the device, which
  /// wants the changes from this tick on: left_run() says so until leave_run() is called, at that tick.
  virtual bool hear(Tick /*at*/, const profibus::CharacterRun& /*run*/) { return false; }
  virtual void leave_run(Tick /*at*/) {}
  virtual bool left_run() const { return false; }
  /// As advance(), but it stops at the tick at which it leaves the run that it hears.
  virtual void advance_in_run(Tick to) { advance(to); }
  /// Runs that it need not hear: of those that come one after the other the last one, before anything else happens to
  /// it or advance() goes beyond its start, is enough. pass() counts those of the others that were for stations.
  virtual profibus::Unconcerned unconcerned() const { return {}; }
  virtual void pass(std::uint64_t /*count*/) {}
  /// At now() the first start bit of an answer falls. Then hide_txd() gives its characters in the place of the changes
  /// of the pin, which stays where it is until the line's driver is disabled, unless show_txd() is called before: at
  /// tick `at` it has, without a report, the level of then, and goes on as ever.
  virtual bool begins_to_send() const { return false; }
  virtual profibus::CharacterRun hide_txd() { return {}; }
  virtual void show_txd(Tick /*at*/) {}

  // --- What no pin shows. RTL has it from a core beside it, on the same inputs.
  virtual ChipStatus status() const = 0;
  /// The station's present address, 0 before the initialisation.
  virtual std::uint8_t address() const = 0;
  /// A cell of the memory that chip and user share, without time or side effects; ChipKind::cells() of them.
  virtual std::uint8_t peek(std::uint16_t address) const = 0;
  virtual void poke(std::uint16_t address, std::uint8_t value) = 0;
  /// Tells the inner signals that have changed since the last look; of a core with Engine::kStep.
  virtual void look_inside(Tick /*now*/, std::size_t /*number*/, ChipListener& /*listener*/) {}
  /// What its access to that memory works on, as its documents call it; empty: nothing, or not known.
  virtual const char* works_on() const { return ""; }

  // --- All that a core is at now(), as bytes for restore() of one with the same parameters, in this process or
  // another.
  virtual std::vector<std::uint8_t> save() const { return {}; }
  /// Throws std::runtime_error, and the device is as before, when the bytes are not what save() gave.
  virtual void restore(const std::uint8_t* /*bytes*/, std::size_t /*size*/) {}
};

}  // namespace dsdpv1::tb
