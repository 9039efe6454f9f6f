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
#include "model/profibus/state_frame.hpp"
#include "model/profibus/uart_rx.hpp"
#include "model/profibus/watchdog.hpp"

namespace dsdpv1 {

using profibus::BaudIndex;  ///< coding of B012, table 5
using profibus::DpState;    ///< coding of B012, table 5

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
  profibus::RmRegistry c2 = {};          ///< table 30: the masters that hold the C2 channels 0x30 and 0x2F
  std::uint64_t longest_wait = 0;        ///< H1: most cycles that a due access waited for R_REQ and R_STA
};

/// Internal state, for waves and debuggers.
struct Inside {
  dpram::Inside access;
  BaudIndex tried;  ///< while searching: the rate being tried
  profibus::Watchdog::State watchdog = profibus::Watchdog::State::kBaudSearch;
};

using profibus::StateError;  ///< why bytes are not a valid state for restore()

class Chip {
 public:
  explicit Chip(const Config& config = {});
  ~Chip();
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  /// Changes an input pin at tick `at` (>= every earlier call's). Setting a pin to its present level does nothing.
  /// Before the first call RESET is low, R_REQ, R_STA and A are 0, CSR, RD, WR and PBRXD are 1, D is released; XSS and
  /// RXD are 1, SCK, MOSI and the straps 0. Pins that the part does not have are ignored.
  void set(Tick at, Pin pin, Level level);
  /// Evaluates everything up to and including tick `to`; reports pin changes and events to the sinks on the way.
  void advance(Tick to);
  /// Executes a whole access of the host with its first edge at tick `begin`, replacing set() and sample() for each
  /// edge; a read returns `sampled`. The chip is then at the last edge. Returns false if the access must be made edge
  /// by edge, because something else happens before its last edge, it would report something, or D is watched; the chip
  /// may then have advanced to `begin`. With `may_report` a read may report that the host does not hold the DPRAM. If D
  /// is watched and its changes may be late, the caller reports them: they follow from the access.
  bool carry_out(Tick begin, const HostAccess& access, Level& sampled, bool may_report = false);
  /// True if only the host can observe the access, whatever happens on the line meanwhile: it keeps all limits, the
  /// host holds the DPRAM, and D is not watched. Its edges may then be set later than other events, but in their order
  /// and before `advance` goes beyond them. The chip has advanced to `begin`.
  bool is_private(Tick begin, const HostAccess& access);
  /// As carry_out(), with `begin` now or later, and the chip stays at now(). Returns false, and the access has no
  /// effect, unless the host holds the DPRAM, so that only its accesses change it: the next one begins later, and the
  /// host keeps R_REQ and R_STA until its end.
  bool carry_out_ahead(Tick begin, const HostAccess& access, Level& sampled);
  /// True if the chip stays away from the DPRAM until the host lowers R_REQ or R_STA, or RESET falls: both are high and
  /// seen, and no access of the chip is running.
  bool host_holds() const;
  /// The 0x800 cells of the DPRAM, null unless host_holds(). The host may read and write them until it lets go; no
  /// access is seen or judged then. Writes in flight settle, so call it after carry_out() and carry_out_ahead(), too.
  std::uint8_t* direct();
  /// The tick of the chip's next event that needs no call (a rising CLK edge, or the falling edge at which D is
  /// driven); never before `now()`. With Engine::kStep the next rising edge.
  Tick next_event() const;
  /// As next_event(), without events that pins and events do not show: settling writes of the DPRAM's owner. Advance
  /// the chip before peek() then.
  Tick next_seen() const;
  Tick now() const;
  /// Changes of PBRXD at ticks from `from` on and before `until` may be set late: call hear() in their order before the
  /// chip is advanced to its next_event() or another pin is set. For benches with many chips on a line.
  profibus::Unheard unheard() const;
  void hear(Tick at, bool level);
  /// Replaces the changes of PBRXD that `run` causes: called at tick `at`, at the run's start or in the idle time
  /// before it. False: the chip needs the changes. True: do not set PBRXD until the end of the run, unless the run is
  /// left. leave_run() leaves it: changes up to `at` have happened, later ones are set as usual. The chip leaves it
  /// when it starts a baud rate search at this tick or is in RESET: left_run() is then true until leave_run() is
  /// called, at that tick. Engine::kSkip only.
  bool hear(Tick at, const profibus::CharacterRun& run);
  /// As advance(), but stops at the tick at which the chip leaves the present run.
  void advance_in_run(Tick to);
  /// Runs that the chip may skip: of several in sequence it is enough to pass the last one, even late, before anything
  /// else happens to the chip or advance() goes beyond its start. pass() counts the skipped runs that were for
  /// stations. Valid until something happens to the chip. Engine::kSkip only.
  profibus::Unconcerned unconcerned() const;
  void pass(std::uint64_t count);
  void leave_run(Tick at);
  bool left_run() const;
  /// True if the first start bit of an answer falls at now(). hide_txd() then returns its characters instead of changes
  /// of PBTXD, which keeps its level until PBRTS falls. show_txd(), called within the characters, ends this: at tick
  /// `at` PBTXD takes its real level without a report, and changes are reported again.
  bool begins_to_send() const;
  profibus::CharacterRun hide_txd();
  void show_txd(Tick at);
  /// The station's present address, 0 before the initialisation.
  std::uint8_t address() const;
  /// The host port chosen by the straps at the end of the last reset; in reset, and for other parts, the parallel one.
  HostMode mode() const;
  /// The present level of a pin, input or output.
  Level level(Pin pin) const;
  /// The level of D that a user gets who samples at tick `at` (>= every earlier call's). Earlier than Tw after RD and
  /// CSR fell it is X and the violation is reported, even if D is already driven by the phase of CLK (P5). `level` does
  /// not count as a sample.
  Level sample(Tick at);

  /// Reports changes of the output pins in `pins` (see mask(Pin)). One sink; a second call replaces it. With `late`,
  /// those of L_REQ and L_STA in accesses that find no work and no request of the user may be reported later, with
  /// their ticks, before a change of another output or of the host's pins, and before level() and status() return; of
  /// several such accesses in sequence only the last three.
  void watch(const PinSink& sink, std::uint32_t pins, bool late = false);
  void on_event(const profibus::EventSink& sink);

  /// Access to the DPRAM without pins, time or side effects: for debuggers and checks. `address` 0..0x7FF (others
  /// wrap). In SPI mode B014 is the ownership register, which poke() does not change.
  std::uint8_t peek(std::uint16_t address) const;
  void poke(std::uint16_t address, std::uint8_t value);

  Status status() const;
  /// Value at the last rising edge. Only valid with Engine::kStep; the other engines skip edges.
  Inside inside() const;

  /// The complete state of the chip at now() as bytes for restore(), in this process or another; the same number for
  /// every chip of this version. Sinks and watched pins are not part of it. Not from a sink. Allocates.
  std::vector<std::uint8_t> save() const;
  /// Resumes the saved chip at its tick: pin changes, events and later saved states are the same as without the save.
  /// Sinks and watched pins stay; the jump of pin levels is not reported. Throws StateError and leaves the chip
  /// unchanged if the bytes are not from save(), cut or damaged, or of another version, part or parameters.
  /// Config::engine may differ. Not from a sink.
  void restore(const std::uint8_t* bytes, std::size_t size);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dsdpv1
