#pragma once
// The SPC3 family (Config::variant): pin changes and the CPU's register call in, pin changes out. Plain C++17, no
// SystemC, no I/O, no heap after construction. Rulings: docs/spc3.md.
//
//   Chip chip;                                    // RESET is high
//   chip.watch({&on_pin, self}, kOutputPins);
//   chip.set(20 * 250, Pin::kReset, 0);           // release reset at cycle 20
//   chip.store(100, 0x07, 0x01);                  // mode register 0: DP_Mode
//   chip.advance(48'000 * 250);                   // one millisecond
//
// A change of an input made at tick t is seen by the first rising CLK edge strictly after t (ruling P9), and so is an
// access. Calls must be made in order of time.
#include <cstdint>
#include <memory>
#include <vector>

#include "model/profibus/baud.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/event.hpp"
#include "model/profibus/state_frame.hpp"
#include "model/profibus/uart_rx.hpp"
#include "model/spc3/config.hpp"
#include "model/spc3/pins.hpp"

namespace dsdpv1::spc3 {

/// Counters and states for benches and results; reading it changes nothing.
struct Status {
  profibus::DpState dp_state = profibus::DpState::kOffline;
  profibus::BaudIndex baud_index;        ///< none while searching
  std::uint8_t address = 0;              ///< the station's present address, 0 before START
  std::uint8_t master = 255;             ///< the parameterising master, 255 = none
  std::uint64_t telegrams_received = 0;  ///< error-free telegrams of all stations
  std::uint64_t telegrams_answered = 0;  ///< answers sent
  std::uint64_t data_exchanges = 0;      ///< executed data exchanges, repetitions not counted
  std::uint64_t outputs_missed = 0;      ///< outputs in N that newer ones replaced before the user had fetched them
};

using profibus::StateError;  ///< why bytes are not a valid state for restore()

class Chip {
 public:
  explicit Chip(const Config& config = {});
  ~Chip();
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  /// Changes an input pin at tick `at` (>= every earlier call's). Setting a pin to its present level does nothing.
  /// Before the first call inputs have the levels of pins.inc: RESET and RXD are high, the bus is at rest.
  void set(Tick at, Pin pin, Level level);
  /// Evaluates everything up to and including tick `to`; reports pin changes and events to the sinks on the way.
  void advance(Tick to);
  /// The tick of the chip's next event that needs no call (a rising CLK edge); never before `now()`. With
  /// Engine::kStep the next rising edge.
  Tick next_event() const;
  Tick now() const;
  /// Changes of RXD at ticks from `from` on and before `until` may be set late: call hear() in their order before the
  /// chip is advanced to its next_event() or another call is made. For benches with many chips on a line.
  profibus::Unheard unheard() const;
  void hear(Tick at, bool level);
  /// Telegrams as a whole: as dsdpv1::Chip's functions of these names, for RXD, TXD and RTS. Engine::kSkip only.
  bool hear(Tick at, const profibus::CharacterRun& run);
  void advance_in_run(Tick to);
  profibus::Unconcerned unconcerned() const;
  void pass(std::uint64_t count);
  void leave_run(Tick at);
  bool left_run() const;
  bool begins_to_send() const;
  profibus::CharacterRun hide_txd();
  void show_txd(Tick at);

  /// An access of the CPU beside the pins of its bus, after the edge of `cycle`, to which the chip is advanced; a read
  /// may be a command. It takes effect at the next edge (A16). `address` in Intel order, 0 to 7FFH, of the VPC3+ to
  /// FFFH (others wrap); beyond the RAM it is a violation (A3). In reset a read is 0 and nothing happens.
  std::uint8_t load(Cycle cycle, Address address);
  void store(Cycle cycle, Address address, std::uint8_t value);
  /// Access without time or effect, for debuggers and checks: the read side, where commands are 0; poke() leaves
  /// registers as they are.
  std::uint8_t peek(Address address) const;
  void poke(Address address, std::uint8_t value);

  /// The level of DB that a user gets who samples at tick `at`; the chip is advanced to it. kLevelZ: no read. A read
  /// that is not ready yet is reported, and acts now or is kLevelX (A42).
  Level sample(Tick at);
  /// The present level of a pin, input or output.
  Level level(Pin pin) const;
  /// Reports changes of the output pins in `pins` (see mask(Pin)). One sink; a second call replaces it.
  void watch(const PinSink& sink, std::uint32_t pins);
  void on_event(const profibus::EventSink& sink);

  std::uint8_t address() const;  ///< as in status()
  Status status() const;

  /// The complete state of the chip at now() as bytes for restore(), in this process or another; the same number for
  /// every chip of this version. Sinks and watched pins are not part of it. Not from a sink. Allocates.
  std::vector<std::uint8_t> save() const;
  /// Resumes the saved chip at its tick: pin changes, events and later saved states are the same as without the save.
  /// Sinks and watched pins stay; the jump of pin levels is not reported. Throws StateError and leaves the chip
  /// unchanged if the bytes are not from save(), cut or damaged, or of another version, name or parameters.
  /// Config::engine may differ. Not from a sink.
  void restore(const std::uint8_t* bytes, std::size_t size);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dsdpv1::spc3
