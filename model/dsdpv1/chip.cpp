#include "model/dsdpv1/chip.hpp"

#include <algorithm>
#include <utility>

#include "model/dpram/sequencer.hpp"
#include "model/dsdpv1/chip_state.hpp"
#include "model/dsdpv1/handshake.hpp"
#include "model/dsdpv1/host_port.hpp"
#include "model/dsdpv1/interrupt.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "model/dsdpv1/serial_ports.hpp"
#include "model/profibus/station.hpp"
#include "model/profibus/whole_telegrams.hpp"

namespace dsdpv1 {
namespace {

using profibus::first_edge_after;
using profibus::kNever;
using profibus::kTicksPerCycle;
namespace whole_telegrams = profibus::whole_telegrams;

constexpr Cycle kResetSynchroniser = 2;  // P9, P10

// The outputs registered on the rising edge; the host ports drive D_OUT and MISO.
constexpr std::uint32_t kEdgeOutputs = kRsuOutputPins & ~mask(Pin::kDOut) & ~mask(Pin::kMiso);

constexpr std::uint32_t kResetLevels =
    kEdgeOutputs & pins_where([](const PinRow& row) { return row.level == 1; });  // P10, R14

profibus::StationConfig station_of(const Config& config) {
  profibus::StationConfig station;
  station.rts_lead = config.rts_lead;
  station.rts_trail = config.rts_trail;
  station.search_window = config.search_window_ms * profibus::kCyclesPerMs;
  station.search_window_bits = config.search_window_bits;
  station.baud_control = config.baud_control_ms * profibus::kCyclesPerMs;
  station.fcb_rule = config.fcb_rule == 0 ? profibus::FcbRule::kLetter : profibus::FcbRule::kContent;
  return station;
}

constexpr std::uint32_t bit(Pin pin, bool level) { return level ? mask(pin) : 0; }

constexpr std::uint64_t kShown = 3;  // of the accesses that were dozed through
constexpr std::uint32_t kAccessPins = mask(Pin::kLReq) | mask(Pin::kLSta);

}  // namespace

struct Chip::Impl {
  // The next event of each block, updated by its caller because it is read far more often than changed. Calling a block
  // without an event does nothing: Engine::kSkip calls only those that are due, and Engine::kStep, which trusts no
  // plan, calls all.
  struct Plan {
    Cycle release = kNever;  // at cycle R; `host` is the live port's
    Cycle host = kNever, handshake = kNever, sequencer = kNever, station = kNever, interrupt = kNever;

    Cycle but_the_stations() const { return std::min({release, host, handshake, sequencer, interrupt}); }
    Cycle but_the_hosts() const { return std::min({release, handshake, sequencer, station, interrupt}); }

    template <class Archive>
    void store(Archive& archive) {
      auto& [of_release, of_host, of_handshake, of_sequencer, of_station, of_interrupt] = *this;
      archive.cycles(of_release, of_host, of_handshake, of_sequencer, of_station, of_interrupt);
    }
  };

  explicit Impl(const Config& given)
      : engine(given.engine),
        user(log, dpram::kCapacities, station),
        station(log, station_of(given), user, &user.msac()),
        host(log, ram),
        interrupt(given.intr_low, given.intr_gap),
        sequencer(log, ram, user, given.access_interval, given.ready_cycles),
        serial(log, ram, given),
        config(given) {
    interrupt.reset();
    if (engine == Engine::kStep) sequencer.note_moves();  // its inside() is only used then
  }

  void set(Tick at, Pin pin, Level value);
  void set_reset(Tick at, bool high);
  void advance(Tick to);
  Tick next_event() const { return std::min(next_edge(), drive_at()); }
  // When D of the parallel port, or MISO, changes.
  Tick drive_at() const { return live ? serial.drive_at() : host.drive_at(); }
  void drive(Tick at);
  Tick next_seen() const;
  Tick next_edge() const { return engine == Engine::kStep ? next_cycle() : planned_edge; }
  Tick next_cycle() const { return first_edge_after(now) * kTicksPerCycle; }
  Cycle done() const { return now / kTicksPerCycle; }  // the last rising edge that has passed
  bool due(Cycle next, Cycle cycle) const { return next <= cycle || engine == Engine::kStep; }
  Tick edge_of(Cycle cycle) const {
    if (cycle == kNever) return kNever;
    const Tick edge = cycle * kTicksPerCycle;
    return edge > now ? edge : next_cycle();
  }
  [[gnu::always_inline]] inline void evaluate(Tick event, Tick to);
  void plan_edge(Cycle cycle) { planned_edge = edge_of(cycle); }
  void plan();
  void plan_station() {
    plans.station = station.next();
    plan();
  }
  bool skips() const { return engine == Engine::kSkip; }
  bool apply(Tick at, Pin pin, Level value);
  bool carry_out(Tick begin, const HostAccess& access, Level& sampled, bool may_report);
  bool carry_out_ahead(Tick begin, const HostAccess& access, Level& sampled);
  bool stays_away() const {
    return !live && handshake.user_holds() && handshake.next() == kNever && !sequencer.owns() && sequencer.started_up();
  }
  bool host_holds() const { return r_req && r_sta && stays_away(); }
  std::uint8_t* direct();
  Level read_unheld(Tick begin, const HostAccess& access);
  bool is_private(Tick begin, const HostAccess& access);
  bool hear(Tick at, bool level);
  void set_handshake(Tick at, bool req, bool sta);
  void rising_edge(Cycle cycle);
  bool only_sends(Cycle cycle) const;
  void send_bits(Cycle cycle, Tick to);
  bool only_settles(Cycle cycle) const;
  void settle_writes(Cycle cycle);
  // Not inline: inlining would slow the edges of every chip.
  [[gnu::noinline]] void choose_port(Cycle cycle);
  [[gnu::noinline]] void eval_serial(Cycle cycle);
  [[gnu::noinline]] bool set_serial(Tick at, Pin pin, Level value);
  void release(Cycle cycle);
  bool eval_sequencer(Cycle cycle);
  void end_edge(Cycle cycle);
  bool only_accesses(Cycle cycle) const;
  void access_edges(Cycle cycle, Tick to);
  bool unasked() const;
  // Inline: it runs at the begin and the end of each access, and with two kinds of ports the compiler would make it a
  // call.
  [[gnu::always_inline]] inline Cycle last_quiet(Tick to) const;
  // The first edge after `to`, or the first at or after the host's next drive, whichever is earlier.
  Cycle unheard_until(Tick to) const { return first_edge_after(std::min(to, drive_at() - 1)); }
  void quiet_access();
  void show_access(Cycle begin);
  void show_end(Cycle begin);
  void access_edge(Cycle cycle);
  void eval_station(Cycle cycle);
  // The effects of telegrams for other stations.
  void catch_up_line(Cycle upto) {
    if (station.catch_up(upto)) plans.station = station.next();
  }
  void doze_if_unseen(bool ended);
  bool shows_late() const { return (watched & kAccessPins) != 0 && sequencer.dozing(); }
  void wake();
  void make_up(Cycle until);
  void catch_up();
  void update_access_pins();
  // L_REQ and L_STA stay low without a parallel port (R14).
  std::uint32_t owned_pins() const { return live ? 0 : kAccessPins; }
  std::uint32_t access_pins() const { return sequencer.owns() ? owned_pins() : 0; }
  void enter_reset(Tick at);
  std::uint32_t edge_outputs() const;
  std::uint32_t with_txd() const { return (outputs & ~mask(Pin::kPbtxd)) | bit(Pin::kPbtxd, station.txd()); }
  void take_txd() { outputs = with_txd(); }
  void publish_edge(Cycle cycle, std::uint32_t levels);
  void publish_edge_outputs(Tick at, std::uint32_t levels);
  void publish_data(Tick at);
  void report_ownership(Tick at);
  Level level(Pin pin) const;

  template <class Archive>
  void store(Archive& archive);
  bool is_possible() const;
  void take_over(const Impl& observed);

  const Engine engine;
  profibus::EventLog log;
  Ram ram;
  profibus::UserSide user;
  profibus::Station station;
  HostPort host;
  Handshake handshake;
  Interrupt interrupt;
  dpram::Sequencer sequencer;

  PinSink sink;
  std::uint32_t watched = 0, prompt = 0;  // of these, pins whose changes must not be late
  Tick now = 0;
  Tick planned_edge = kNever;
  Plan plans;
  Cycle other_plans = kNever;  // the earliest but the station's, when plan() ran
  bool reset_pin = false, running = false, r_req = false, r_sta = false, rxd = true;
  std::uint32_t outputs = kResetLevels;
  bool live = false;  // the live host port is serial
  Level d_out = kLevelZ, miso = kLevelZ;
  SerialPorts serial;  // after the members that every chip uses at each edge
  const Config config;
  bool host_acts = false;  // at the present edge
};

// --- inputs ----------------------------------------------------------------------------------------------------------

void Chip::Impl::set(Tick at, Pin pin, Level value) {
  advance(at);
  if (apply(at, pin, value)) plan();
}

// Returns false if no block has a new plan.
bool Chip::Impl::apply(Tick at, Pin pin, Level value) {
  const bool high = value != 0;
  switch (pin) {
    case Pin::kPbrxd: return hear(at, high);
    case Pin::kReset: set_reset(at, high); return true;
    case Pin::kRReq: set_handshake(at, high, r_sta); return true;
    case Pin::kRSta: set_handshake(at, r_req, high); return true;
    default: break;
  }
  if (pin > Pin::kReady) return set_serial(at, pin, value);
  if (value == host.level(pin)) return false;
  if (shows_late()) make_up(done());
  host.set(at, pin, value);
  if (!live) plans.host = host.next();  // else the port ignores its pins
  publish_data(at);
  return true;
}

bool Chip::Impl::set_serial(Tick at, Pin pin, Level value) {
  serial.set(at, pin, value);
  publish_data(at);
  if (!live) return false;
  plans.host = serial.next();
  return true;
}

bool Chip::Impl::carry_out(Tick begin, const HostAccess& access, Level& sampled, bool may_report) {
  if (engine != Engine::kSkip || (prompt & mask(Pin::kDOut)) != 0) return false;
  advance(begin);
  const Tick last = begin + access.last();
  if (plans.but_the_hosts() <= last / kTicksPerCycle || !sequencer.started_up()) return false;
  if (may_report && plans.host == kNever && host.is_plain_unheld(begin, access)) {
    sampled = read_unheld(begin, access);
    return true;
  }
  if (sequencer.owns()) return false;
  if (!host.carry_out(begin, access, sampled)) return false;
  plans.host = host.next();
  plan();
  advance(last);
  return true;
}

bool Chip::Impl::carry_out_ahead(Tick begin, const HostAccess& access, Level& sampled) {
  const bool hidden = engine == Engine::kSkip && (watched & mask(Pin::kDOut)) == 0;
  if (!hidden || !stays_away()) return false;
  host.settle_until(begin / kTicksPerCycle, true);
  const bool plain = host.carry_out(begin, access, sampled);
  plans.host = host.next();
  plan();
  return plain;
}

std::uint8_t* Chip::Impl::direct() {
  if (!host_holds()) return nullptr;
  host.settle_until(kNever, true);
  plans.host = host.next();
  plan();
  return ram.cells();
}

// Meanwhile the dozing chip may have accesses, and D is unreadable during one.
Level Chip::Impl::read_unheld(Tick begin, const HostAccess& access) {
  now = begin + std::max(access.times().select, access.times().strobe);  // nothing else is planned before its end
  host.tell_unheld(now, access);
  make_up(first_edge_after(now) - 1);
  const Level sampled = host.read_unheld(begin, access, sequencer.owns());
  now = begin + access.last();
  return sampled;
}

// The chip starts no access while the user holds the DPRAM, whatever the station does.
bool Chip::Impl::is_private(Tick begin, const HostAccess& access) {
  if (engine != Engine::kSkip || (watched & mask(Pin::kDOut)) != 0) return false;
  advance(begin);
  const Cycle last = (begin + access.last()) / kTicksPerCycle;
  if (std::min({plans.release, plans.handshake, plans.sequencer}) <= last) return false;
  return !sequencer.owns() && sequencer.started_up() && host.is_plain(begin, access);
}
bool Chip::Impl::hear(Tick at, bool level) {
  catch_up_line(done());
  rxd = level;
  if (!station.set_rxd(at, level)) return false;
  plans.station = station.next();
  return true;
}

void Chip::Impl::set_handshake(Tick at, bool req, bool sta) {
  wake();
  const bool sta_changes = sta != r_sta;
  r_req = req;
  r_sta = sta;
  host.set_handshake(r_req, r_sta);
  handshake.set_r_req(at, r_req);
  handshake.set_r_sta(at, r_sta);
  plans.handshake = handshake.next();
  if (sta_changes) report_ownership(at);
}

void Chip::Impl::set_reset(Tick at, bool high) {
  if (high == reset_pin) return;
  reset_pin = high;
  if (high)
    plans.release = first_edge_after(at) + kResetSynchroniser;
  else
    enter_reset(at);
}

void Chip::Impl::enter_reset(Tick at) {
  running = false;
  catch_up_line(done());
  station.leave_run(at);
  make_up(done());  // the RAM keeps what was written before RESET fell (H6)
  sequencer.reset();
  user.reset();
  interrupt.reset();
  host.reset();
  serial.reset();
  live = false;
  plans = {kNever, host.next(), handshake.next(), sequencer.next(), station.next(), interrupt.next()};
  publish_edge_outputs(at, kResetLevels);
  publish_data(at);
}

// --- time ------------------------------------------------------------------------------------------------------------

void Chip::Impl::plan() {
  other_plans = plans.but_the_stations();
  plan_edge(std::min(other_plans, plans.station));
}

// The settling of writes by the DPRAM's owner is not observable: to see them it reads or releases the DPRAM, and both
// are calls of the chip.
Tick Chip::Impl::next_seen() const {
  if (engine == Engine::kStep || sequencer.owns() || live || host.next_seen() == plans.host) return next_event();
  return std::min(edge_of(std::min(plans.but_the_hosts(), host.next_seen())), host.drive_at());
}

void Chip::Impl::advance(Tick to) {
  for (Tick event = next_event(); event <= to; event = next_event()) evaluate(event, to);
  now = std::max(now, to);
}

// Evaluates the events at tick `event`, and similar ones up to `to`.
void Chip::Impl::evaluate(Tick event, Tick to) {
  const bool drives = event < next_edge();  // MISO may change at the tick of an edge: after it
  now = event;
  if (drives) return drive(event);
  const Cycle cycle = event / kTicksPerCycle;
  if (only_sends(cycle)) return send_bits(cycle, to);
  if (only_settles(cycle))
    settle_writes(cycle);
  else if (only_accesses(cycle))
    access_edges(cycle, to);
  else
    rising_edge(cycle);
  plan();
}

void Chip::Impl::drive(Tick at) {
  if (shows_late()) make_up(at / kTicksPerCycle);
  live ? serial.drive() : host.drive();
  publish_data(at);
}

// The order of the blocks within one cycle: docs/microarchitecture.md, docs/microarchitecture_rsu.md.
void Chip::Impl::rising_edge(Cycle cycle) {
  catch_up_line(cycle - 1);
  plans.station = std::min(plans.station, station.unseen());
  const bool released = cycle == plans.release;
  if (released) choose_port(cycle);
  if (due(plans.host, cycle)) {
    make_up(cycle - 1);
    sequencer.wake(cycle - 1);  // the user's write may be a command
    host_acts = true;
    if (live) {
      eval_serial(cycle);
    } else {
      host.eval(cycle, sequencer.owns(), sequencer.started_up());
      plans.host = host.next();
    }
    host_acts = false;
    plans.sequencer = sequencer.next();
  }
  if (released) release(cycle);
  if (due(std::min(plans.handshake, plans.sequencer), cycle)) eval_sequencer(cycle);
  if (released && !live && !sequencer.started_up())
    log.at_cycle(cycle, Reason::kHeldThroughReset, handshake.r_req(), handshake.r_sta());  // H6
  end_edge(cycle);
}

void Chip::Impl::eval_serial(Cycle cycle) {
  const bool data_exch = station.slave().state() == profibus::DpState::kDataExch;
  serial.eval(cycle, {sequencer.owns(), sequencer.starts_up(), data_exch});
  sequencer.user_holds(serial.holds());
  publish_data(cycle * kTicksPerCycle);
  plans.host = serial.next();
}

void Chip::Impl::end_edge(Cycle cycle) {
  if (due(plans.station, cycle)) eval_station(cycle);
  if (due(plans.interrupt, cycle)) {
    interrupt.eval(cycle);
    plans.interrupt = interrupt.next();
  }
  if (!running) return;
  if (shows_late() && ((edge_outputs() ^ outputs) & watched & ~kAccessPins) != 0) make_up(cycle - 1);
  publish_edge(cycle, edge_outputs());
}

// Most edges of an answering chip change PBTXD only.
bool Chip::Impl::only_sends(Cycle cycle) const {
  return engine == Engine::kSkip && cycle < std::min(other_plans, station.only_sends_until());
}

// Evaluates such edges in sequence, as long as nothing else is due.
void Chip::Impl::send_bits(Cycle cycle, Tick to) {
  const Cycle act = std::min({other_plans, station.only_sends_until(), unheard_until(to)});
  do {
    now = cycle * kTicksPerCycle;
    if (shows_late()) make_up(cycle - 1);
    plans.station = station.send_bit(cycle);
    publish_edge_outputs(now, with_txd());
    cycle = plans.station;
  } while (cycle < act);
  plan_edge(std::min(other_plans, cycle));
}

// Most edges while the user owns the DPRAM only settle a write.
bool Chip::Impl::only_settles(Cycle cycle) const {
  return engine == Engine::kSkip && !live && plans.host <= cycle && host.next_seen() > cycle && !sequencer.owns() &&
         !sequencer.dozing() && cycle < plans.but_the_hosts();
}

void Chip::Impl::settle_writes(Cycle cycle) {
  host.eval(cycle, false, sequencer.started_up());
  plans.host = host.next();
}

// Without requests only accesses of the chip begin and end.
bool Chip::Impl::only_accesses(Cycle cycle) const {
  return engine == Engine::kSkip && running && station.unseen() >= cycle &&
         cycle < std::min({plans.release, plans.host, plans.handshake, plans.station, plans.interrupt});
}

// The last cycle at which an access may begin and still end before anything else acts.
Cycle Chip::Impl::last_quiet(Tick to) const {
  const Cycle act = std::min({plans.release, plans.host, plans.handshake, plans.station, plans.interrupt,
                              station.unseen(), unheard_until(to)});
  return act - dpram::Sequencer::kQuietAccess - 1;
}

// Evaluates accesses in sequence, as long as they find no work and nothing else is due.
void Chip::Impl::access_edges(Cycle cycle, Tick to) {
  const Cycle last = last_quiet(to);
  if (cycle > last || !unasked()) return access_edge(cycle);
  for (; sequencer.next() <= last; plans.sequencer = sequencer.next()) quiet_access();
}

void Chip::Impl::quiet_access() {
  const Cycle begin = sequencer.next();
  now = begin * kTicksPerCycle;
  sequencer.begin_quietly();
  show_access(begin);
  now += dpram::Sequencer::kQuietAccess * kTicksPerCycle;
  sequencer.end_quietly();
  show_end(begin);
}

void Chip::Impl::show_access(Cycle begin) { publish_edge_outputs(begin * kTicksPerCycle, outputs | owned_pins()); }

// The end of an access without work.
void Chip::Impl::show_end(Cycle begin) {
  publish_edge_outputs((begin + dpram::Sequencer::kQuietAccess) * kTicksPerCycle, outputs & ~kAccessPins);
}

// The user requests no DPRAM, and no work waits for an access.
bool Chip::Impl::unasked() const { return !r_req && !r_sta && handshake.next() == kNever && sequencer.may_doze(); }

void Chip::Impl::access_edge(Cycle cycle) {
  if (eval_sequencer(cycle))
    end_edge(cycle);
  else
    publish_edge(cycle, (outputs & ~kAccessPins) | access_pins());
}

// Chosen by the straps; a serial port starts at this edge.
void Chip::Impl::choose_port(Cycle cycle) {
  serial.release(cycle);
  live = serial.live();
  if (live) plans.host = cycle;
}

void Chip::Impl::release(Cycle cycle) {
  running = true;
  if (!live) host.release();
  sequencer.judge_crc(serial.judges_crc());
  sequencer.user_holds(live ? serial.holds() : handshake.user_holds());
  sequencer.start_up(cycle);
  plans.release = kNever;
  plans.sequencer = cycle;
}

// Returns true if the edge had an effect that must be reported.
bool Chip::Impl::eval_sequencer(Cycle cycle) {
  const bool owned = sequencer.owns();
  if (due(plans.handshake, cycle)) {
    handshake.eval(cycle);
    if (!live) sequencer.user_holds(handshake.user_holds());
    plans.handshake = handshake.next();
  }
  const bool has_effect = sequencer.eval(cycle);
  if (has_effect) {
    if (sequencer.told_user() == cycle) interrupt.trigger(cycle);  // P7
    plans.interrupt = interrupt.next();
    plans.station = station.next();
  }
  doze_if_unseen(owned && !sequencer.owns());
  plans.sequencer = sequencer.next();
  return has_effect;
}

// The sequencer acts before the station, so accesses that it dozes through up to this edge do not depend on the
// station's actions at this edge.
void Chip::Impl::eval_station(Cycle cycle) {
  const bool changes_mail = station.may_act(cycle);
  if (sequencer.dozing() && changes_mail) make_up(cycle);
  station.eval(cycle);
  plans.station = station.next();
  if (!sequencer.dozing() || !changes_mail || sequencer.nothing_due()) return;
  sequencer.wake(cycle);  // nothing is left to make up
  plans.sequencer = sequencer.next();
}

// An access without work is visible only on L_REQ and L_STA, and to a user who requests the DPRAM. If these are
// watched, the first one after a request is not late: it shows that the user's hold is over.
void Chip::Impl::doze_if_unseen(bool ended) {
  const bool unseen = (prompt & kAccessPins) == 0 && (ended || (watched & kAccessPins) == 0);
  if (engine == Engine::kSkip && unseen && unasked()) sequencer.doze();
}

void Chip::Impl::wake() {
  if (!sequencer.dozing()) return;
  make_up(done());
  sequencer.wake(done());
  plans.sequencer = sequencer.next();
  update_access_pins();
}

// Simulates accesses up to and including `until`. While the sequencer dozes, those that end or are the last three are
// shown: four changes of a pin, if the last one goes on.
void Chip::Impl::make_up(Cycle until) {
  const bool shows = shows_late(), owned = sequencer.owns();
  const Cycle before = sequencer.began();
  const std::uint64_t accesses = sequencer.accesses();
  sequencer.catch_up(until);
  if (!shows) return;
  const std::uint64_t made = sequencer.accesses() - accesses;
  const Cycle last = sequencer.began();
  if (owned && (made > 0 || !sequencer.owns())) show_end(before);
  for (std::uint64_t back = std::min<std::uint64_t>(made, kShown); back > 1; --back) {
    const Cycle begin = last - static_cast<Cycle>(back - 1) * sequencer.period();
    show_access(begin);
    show_end(begin);
  }
  if (made > 0) show_access(last);
  if (made > 0 && !sequencer.owns()) show_end(last);
}

// The host port acts before the sequencer: an event's listener that asks then finds the sequencer as it was before.
void Chip::Impl::catch_up() {
  make_up(host_acts ? done() - 1 : done());
  if (sequencer.dozing()) update_access_pins();
}

// Updates only these pins: in the middle of an edge, when an event's listener reads pins, the others are not reported
// yet. If they are watched, they change with a report.
void Chip::Impl::update_access_pins() {
  if ((watched & kAccessPins) == 0) outputs = (outputs & ~kAccessPins) | access_pins();
}

// --- outputs ---------------------------------------------------------------------------------------------------------

std::uint32_t Chip::Impl::edge_outputs() const {
  return access_pins() | bit(Pin::kIntr0, interrupt.level()) | bit(Pin::kPbtxd, station.txd()) |
         bit(Pin::kPbrts, station.rts()) | bit(Pin::kPbf, station.slave().state() != profibus::DpState::kDataExch) |
         bit(Pin::kBr, station.baud_found()) | bit(Pin::kReady, sequencer.initialised()) |
         bit(Pin::kTxd, !live || serial.txd());
}

void Chip::Impl::publish_edge(Cycle cycle, std::uint32_t levels) {
  const bool owned = (outputs & mask(Pin::kLSta)) != 0;
  publish_edge_outputs(cycle * kTicksPerCycle, levels);
  if (!owned) report_ownership(cycle * kTicksPerCycle);
}

void Chip::Impl::publish_edge_outputs(Tick at, std::uint32_t levels) {
  std::uint32_t changed = (levels ^ outputs) & kEdgeOutputs;
  outputs = levels;
  for (changed &= watched; changed != 0; changed &= changed - 1) {
    const auto pin = static_cast<Pin>(__builtin_ctz(changed));
    sink.call(sink.self, at, pin, (levels & mask(pin)) != 0 ? Level{1} : Level{0});
  }
}

void Chip::Impl::publish_data(Tick at) {
  const auto publish = [&](Pin pin, Level& told, Level level) {
    if (std::exchange(told, level) != level && (watched & mask(pin)) != 0) sink.call(sink.self, at, pin, level);
  };
  publish(Pin::kDOut, d_out, host.d_out());
  if (live || miso != kLevelZ) publish(Pin::kMiso, miso, serial.miso());
}

void Chip::Impl::report_ownership(Tick at) {
  if (r_sta && running && access_pins() != 0) log.at_tick(at, Reason::kBothOwn);
}

Level Chip::Impl::level(Pin pin) const {
  switch (pin) {
    case Pin::kReset: return reset_pin;
    case Pin::kRReq: return r_req;
    case Pin::kRSta: return r_sta;
    case Pin::kPbrxd: return rxd;
    case Pin::kCsr:
    case Pin::kRd:
    case Pin::kWr:
    case Pin::kA:
    case Pin::kDIn: return host.level(pin);
    case Pin::kDOut: return d_out;
    case Pin::kXss:
    case Pin::kSck:
    case Pin::kMosi:
    case Pin::kRxd:
    case Pin::kMode:
    case Pin::kAdr:
    case Pin::kUbr:
    case Pin::kUiv:
    case Pin::kMiso: return serial.level(pin);
    default: return (outputs & mask(pin)) != 0 ? Level{1} : Level{0};
  }
}

// --- saved and restored ----------------------------------------------------------------------------------------------

template <class Archive>
void Chip::Impl::store(Archive& archive) {
  auto& [its_engine, its_log, its_ram, its_user, its_station, its_host, its_handshake, its_interrupt, its_sequencer,
         its_sink, its_watched, its_prompt, its_now, its_edge, its_plans, its_other_plans, its_reset, runs, its_req,
         its_sta, its_rxd, its_outputs, is_live, its_d, its_miso, its_serial, its_config, its_host_acts] = *this;
  archive.given(its_engine, its_log, its_sink, its_watched, its_prompt, its_edge, its_other_plans, its_config,
                its_host_acts);
  archive.within(Tick{0}, Tick{1} << 62, its_now);
  archive(its_ram);
  its_station.store(archive, its_user);
  archive(its_host, its_handshake, its_interrupt, its_sequencer, its_serial, its_plans);
  archive(its_reset, runs, its_req, its_sta, its_rxd, is_live);
  archive.within(0U, (1U << kRsuPinCount) - 1, its_outputs);
  archive.within(kLevelX, kHighestLevel, its_d, its_miso);
  archive.check(is_possible());
}

// All plans lie in the future, none after its block's next event.
bool Chip::Impl::is_possible() const {
  const Cycle over = done();
  const auto right = [over](Cycle plan, Cycle next) { return plan > over && plan <= next; };
  return live == serial.live() && drive_at() > now && plans.release > over &&
         right(plans.host, live ? serial.next() : host.next()) && right(plans.handshake, handshake.next()) &&
         right(plans.sequencer, sequencer.next()) && right(plans.station, station.next()) &&
         right(plans.interrupt, interrupt.next()) && sequencer.is_possible(over);
}

// Observers stay attached; with step, or if they watch accesses and not late, the chip wakes.
void Chip::Impl::take_over(const Impl& observed) {
  log = observed.log;
  if (engine == Engine::kStep || (observed.prompt & kAccessPins) != 0) wake();
  sink = observed.sink;
  watched = observed.watched;
  prompt = observed.prompt;
  plan();
}

// --- the chip --------------------------------------------------------------------------------------------------------

Chip::Chip(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
Chip::~Chip() = default;

void Chip::set(Tick at, Pin pin, Level level) { impl_->set(at, pin, level); }
void Chip::advance(Tick to) { impl_->advance(to); }
void Chip::advance_in_run(Tick to) { whole_telegrams::advance_in_run(*impl_, to); }
Level Chip::sample(Tick at) {
  impl_->advance(at);
  return impl_->host.user_samples(at);
}
bool Chip::carry_out(Tick begin, const HostAccess& access, Level& sampled, bool may_report) {
  return impl_->carry_out(begin, access, sampled, may_report);
}
bool Chip::carry_out_ahead(Tick begin, const HostAccess& access, Level& sampled) {
  return impl_->carry_out_ahead(begin, access, sampled);
}
bool Chip::host_holds() const { return impl_->host_holds(); }
std::uint8_t* Chip::direct() { return impl_->direct(); }
bool Chip::is_private(Tick begin, const HostAccess& access) { return impl_->is_private(begin, access); }
Tick Chip::next_event() const { return impl_->next_event(); }
Tick Chip::next_seen() const { return impl_->next_seen(); }
Tick Chip::now() const { return impl_->now; }
profibus::Unheard Chip::unheard() const { return impl_->station.unheard(); }
void Chip::hear(Tick at, bool level) {
  if (impl_->hear(at, level)) impl_->plan();
}
bool Chip::hear(Tick at, const profibus::CharacterRun& run) { return whole_telegrams::hear(*impl_, at, run); }
profibus::Unconcerned Chip::unconcerned() const { return whole_telegrams::unconcerned(*impl_); }
void Chip::pass(std::uint64_t count) { impl_->station.pass(count); }
void Chip::leave_run(Tick at) {
  whole_telegrams::leave_run(*impl_, at);
  impl_->rxd = impl_->station.rxd();
}
bool Chip::begins_to_send() const { return whole_telegrams::begins_to_send(*impl_); }
profibus::CharacterRun Chip::hide_txd() { return whole_telegrams::hide_txd(*impl_); }
void Chip::show_txd(Tick at) { whole_telegrams::show_txd(*impl_, at); }
bool Chip::left_run() const { return impl_->station.left_run(); }
Level Chip::level(Pin pin) const {
  if ((mask(pin) & kAccessPins) != 0) impl_->catch_up();
  return impl_->level(pin);
}

void Chip::watch(const PinSink& sink, std::uint32_t pins, bool late) {
  impl_->wake();
  impl_->plan();
  impl_->sink = sink;
  impl_->watched = sink.call != nullptr ? pins & kRsuOutputPins : 0;
  impl_->prompt = late ? impl_->watched & ~(kAccessPins | mask(Pin::kDOut)) : impl_->watched;
}

void Chip::on_event(const profibus::EventSink& sink) { impl_->log.attach(sink); }

std::uint8_t Chip::peek(std::uint16_t address) const {
  impl_->catch_up();
  if (impl_->serial.is_register(address % regs::kDpramSize)) return impl_->serial.ownership(impl_->sequencer.owns());
  return impl_->ram.read(address);
}

void Chip::poke(std::uint16_t address, std::uint8_t value) {
  impl_->wake();
  impl_->plan();
  impl_->catch_up();
  if (!impl_->serial.is_register(address % regs::kDpramSize)) impl_->ram.write(address, value);
}

HostMode Chip::mode() const { return impl_->serial.mode(); }
std::uint8_t Chip::address() const { return impl_->station.slave().address(); }

Status Chip::status() const {
  impl_->catch_up();
  impl_->catch_up_line(impl_->done());
  const profibus::Station& station = impl_->station;
  Status status;
  status.dp_state = station.slave().state();
  status.baud_index = station.baud_index();
  status.address = station.slave().address();
  status.master = station.slave().master();
  status.telegrams_received = station.telegrams_received();
  status.telegrams_answered = station.telegrams_answered();
  status.data_exchanges = impl_->user.data_exchanges();
  status.accesses = impl_->sequencer.accesses();
  status.outputs_missed = impl_->user.outputs_replaced() + impl_->sequencer.outputs_overwritten();
  status.c2 = impl_->user.msac().c2.registry();
  status.longest_wait = static_cast<std::uint64_t>(impl_->sequencer.longest_wait());
  return status;
}

std::vector<std::uint8_t> Chip::save() const { return profibus::save_chip<StateHead>(*impl_); }

void Chip::restore(const std::uint8_t* bytes, std::size_t size) {
  profibus::restore_chip<StateHead>(impl_, bytes, size);
}

Inside Chip::inside() const {
  return {impl_->sequencer.inside(impl_->done()), impl_->station.tried(), impl_->station.watchdog()};
}

}  // namespace dsdpv1
