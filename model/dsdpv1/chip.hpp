#pragma once
// The DSDPV1, the DSDPV1-R or the DSDPV1-RSU (Config::part): pins in, pin changes out. Plain C++17, no SystemC, no I/O,
// no heap after construction.
//
//   Chip chip;                                     // RESET is low
//   chip.watch({&on_pin, self}, kOutputPins);
//   chip.set(20 * 250, Pin::kReset, 1);            // release reset at cycle 20
//   chip.advance(48'000 * 250);                    // one millisecond
//
// A change of an input made at tick t is seen by the first rising CLK edge strictly after t (ruling P9); the host port,
// which is asynchronous to CLK, sees it at t. Calls must be made in order of time: `set` first runs the chip up to its
// own tick.
#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "model/dpram/inside.hpp"
#include "model/dsdpv1/config.hpp"
#include "model/dsdpv1/host_access.hpp"
#include "model/dsdpv1/pins.hpp"
#include "model/profibus/addressee.hpp"
#include "model/profibus/baud.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/event.hpp"
#include "model/profibus/rm_registry.hpp"
#include "model/profibus/uart_rx.hpp"
#include "model/profibus/watchdog.hpp"

namespace dsdpv1 {

using profibus::BaudIndex;  ///< coding of B012, table 5
using profibus::DpState;    ///< likewise

/// Counters and states for benches and results; reading it changes nothing.
struct Status {
  DpState dp_state = DpState::kOffline;
  BaudIndex baud_index;                  ///< none while searching
  std::uint8_t address = 0;              ///< the station's present address, 0 before the initialisation
  std::uint8_t master = 255;             ///< the parameterising master, 255 = none
  std::uint64_t telegrams_received = 0;  ///< error-free telegrams of all stations
  std::uint64_t telegrams_answered = 0;  ///< answers sent
  std::uint64_t data_exchanges = 0;      ///< executed data exchanges, repetitions not counted
  std::uint64_t outputs_missed = 0;      ///< H5: blocks that newer ones replaced before the user had fetched them
  std::uint64_t accesses = 0;            ///< DPRAM accesses of the chip
  profibus::RmRegistry c2 = {};          ///< table 30: who has the C2 channels 0x30 and 0x2F
  std::uint64_t longest_wait = 0;        ///< H1: most cycles that a due access waited for R_REQ and R_STA
};

/// What no pin shows, for waves and debuggers.
struct Inside {
  dpram::Inside access;
  BaudIndex tried;  ///< while searching: the rate that is listened at
  profibus::Watchdog::State watchdog = profibus::Watchdog::State::kBaudSearch;
};

/// Why bytes are not what a chip may be restored from: one line.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Chip {
 public:
  explicit Chip(const Config& config = {});
  ~Chip();
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  /// Changes an input pin at tick `at` (>= every earlier call's). Setting a pin to the level it has does nothing.
  /// Before the first call RESET is low, R_REQ, R_STA and A are 0, CSR, RD, WR and PBRXD are 1, D is released; XSS and
  /// RXD are 1, SCK, MOSI and the straps 0. Pins that the part does not have are not looked at.
  void set(Tick at, Pin pin, Level level);
  /// Evaluates everything up to and including tick `to`; pin changes and events leave through the sinks on the way.
  void advance(Tick to);
  /// A whole access of the host, its first edge at tick `begin`, in the place of set() and sample() for each of its
  /// edges; of a read, what was `sampled`. The chip is at the last edge then. False: to be done edge by edge, as
  /// something else happens before the last, it reports something or somebody watches D; the chip may have advanced to
  /// `begin`.
  bool carry_out(Tick begin, const HostAccess& access, Level& sampled);
  /// Whatever happens on the line until the access is over, nobody but the host hears of it, and it does what it does
  /// by itself: it keeps all limits, the host has the DPRAM, nobody watches D. Its edges may be set later than others
  /// act, as long as they are set in their order, and before `advance` goes beyond them. The chip has advanced to
  /// `begin`.
  bool is_private(Tick begin, const HostAccess& access);
  /// The tick of the next thing that the chip does by itself (a rising CLK edge, or the falling edge at which D is
  /// driven); never before `now()`. With Engine::kStep the next rising edge.
  Tick next_event() const;
  /// The same without what nobody sees who looks at pins and events only: writes of the DPRAM's owner settle. peek()
  /// wants the chip to be advanced then.
  Tick next_seen() const;
  Tick now() const;
  /// Changes of PBRXD at a tick from `from` on and before `until` need not be set at once: hear() in their order,
  /// before the chip is advanced to its next_event() or another pin is set, is early enough. For benches with many
  /// chips on a line.
  profibus::Unheard unheard() const;
  void hear(Tick at, bool level);
  /// In the place of the changes of PBRXD that `run` comes to: called at tick `at`, at the run's start or in the idle
  /// time before it. False: the chip wants the changes. True: PBRXD is not set until the end of the run, unless it is
  /// left before. By leave_run(): changes up to `at` have happened, those behind it are set as ever. By the chip, which
  /// searches a baud rate from this tick on or is in RESET: left_run() says so until leave_run() is called, at that
  /// tick. Engine::kSkip only.
  bool hear(Tick at, const profibus::CharacterRun& run);
  /// As advance(), but it stops at the tick at which the chip leaves the run that it hears.
  void advance_in_run(Tick to);
  /// Runs that the chip need not hear: of those that come one after the other the last one, before anything else
  /// happens to the chip or advance() goes beyond its start, is enough, late as it is; the chip takes it. pass() counts
  /// those of the others that were for stations. Holds until something happens to the chip. Engine::kSkip only.
  profibus::Unconcerned unconcerned() const;
  void pass(std::uint64_t count);
  void leave_run(Tick at);
  bool left_run() const;
  /// At now() the first start bit of an answer falls. Then, hide_txd() gives its characters in the place of the changes
  /// of PBTXD, which stays where it is until PBRTS falls, unless show_txd() is called before, within the characters: at
  /// tick `at` it has, without a report, the level of then, and goes on as ever.
  bool begins_to_send() const;
  profibus::CharacterRun hide_txd();
  void show_txd(Tick at);
  /// The station's present address, 0 before the initialisation.
  std::uint8_t address() const;
  /// The host port that the straps chose at the end of the last reset; in reset, and of other parts, the parallel one.
  HostMode mode() const;
  /// The present level of a pin, input or output.
  Level level(Pin pin) const;
  /// The user samples D at tick `at` (>= every earlier call's): its level then. Earlier than Tw after RD and CSR fell
  /// it is X and the violation is reported, whatever D is already by the phase of CLK (P5). `level` cannot know who
  /// looks, and when.
  Level sample(Tick at);

  /// Reports changes of the output pins in `pins` (see mask(Pin)). One sink; a second call replaces it.
  void watch(const PinSink& sink, std::uint32_t pins);
  void on_event(const profibus::EventSink& sink);

  /// DPRAM without pins, time or side effects: for debuggers and checks. `address` 0..0x7FF (others wrap). In SPI mode
  /// B014 is the register of the ownership, which poke() leaves alone.
  std::uint8_t peek(std::uint16_t address) const;
  void poke(std::uint16_t address, std::uint8_t value);

  Status status() const;
  /// As of the last rising edge; Engine::kStep only, as others leave edges out.
  Inside inside() const;

  /// All that the chip is at now(), as bytes for restore(), in this process or another; as many for every chip of this
  /// version. Who watches and listens is no part of it. Not from a sink. On the heap.
  std::vector<std::uint8_t> save() const;
  /// The chip is the one that was saved, at its tick, and goes on as that one did: pin changes, events and what is
  /// saved again are the same. Sinks and watched pins stay; that pins have other levels than a moment ago is told to
  /// nobody. Throws StateError, and the chip is as before, when the bytes are not what save() gave, cut or damaged, of
  /// another version, part or parameters. Config::engine may be another one. Not from a sink.
  void restore(const std::uint8_t* bytes, std::size_t size);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dsdpv1
