#include "model/spc3/chip.hpp"

#include <algorithm>
#include <utility>

#include "model/profibus/whole_telegrams.hpp"
#include "model/spc3/bus_port.hpp"
#include "model/spc3/chip_state.hpp"
#include "model/spc3/clear_to_send.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

using profibus::first_edge_after;
using profibus::kNever;
using profibus::kTicksPerCycle;
namespace whole_telegrams = profibus::whole_telegrams;

constexpr Cycle kResetSynchroniser = 2;  // A9

constexpr std::uint32_t kResetLevels = mask(Pin::kTxd) | mask(Pin::kXInt) | mask(Pin::kXDataExch) | mask(Pin::kXReady);

constexpr std::uint32_t bit(Pin pin, bool level) { return level ? mask(pin) : 0; }

profibus::StationConfig station_of(const Config& config) {
  profibus::StationConfig station;
  station.rts_lead = config.rts_lead;
  station.rts_trail = config.rts_trail;
  station.search_window = config.search_window_ms * profibus::kCyclesPerMs;
  station.search_window_bits = config.search_window_bits;
  station.fcb_rule = config.fcb_rule == 0 ? profibus::FcbRule::kLetter : profibus::FcbRule::kContent;
  return station;
}

}  // namespace

struct Chip::Impl {
  explicit Impl(const Config& given)
      : config(given),
        interrupt(delay_of(given, given.int_delay)),
        user(log, config, interrupt, station),
        station(log, station_of(given), user, nullptr),
        map(log, config, user, interrupt, station),
        cts(log, given.cts_wait),
        port(log, config, map) {
    reset_blocks();
  }

  void set(Tick at, Pin pin, Level value);
  void set_reset(Tick at, bool high);
  void enter_reset(Tick at);
  void reset_blocks();
  void advance(Tick to);
  void evaluate(Tick event, Tick to);
  bool only_sends(Cycle cycle) const { return skips() && cycle < std::min(other_plans, station.only_sends_until()); }
  void send_bits(Cycle cycle, Tick to);
  void rising_edge(Cycle cycle);
  bool skips() const { return config.engine == Engine::kSkip; }
  Tick next_event() const { return skips() ? planned_edge : (done + 1) * kTicksPerCycle; }
  void plan();
  void plan_station();
  bool hear(Tick at, bool level);
  void catch_up_line(Cycle upto) { station.catch_up(upto); }
  std::uint8_t load(Cycle cycle, Address address);
  void store(Cycle cycle, Address address, std::uint8_t value);
  Level sample(Tick at);
  Cycle begin_access(Cycle cycle, Address address);
  std::uint32_t outputs_now() const;
  std::uint32_t with_txd() const { return (outputs & ~mask(Pin::kTxd)) | bit(Pin::kTxd, station.txd()); }
  void take_txd() { outputs = with_txd(); }
  void publish(Tick at, std::uint32_t levels);
  void publish_bus(Tick at);
  Level level(Pin pin) const;

  template <class Archive>
  void store(Archive& archive);
  bool is_possible() const;
  void take_over(const Impl& observed);

  const Config config;
  profibus::EventLog log;
  Interrupt interrupt;
  RamStore user;
  profibus::Station station;
  AddressMap map;
  ClearToSend cts;
  BusPort port;

  PinSink sink;
  std::uint32_t watched = 0;
  Tick now = 0;
  Cycle done = 0;  // the last evaluated rising edge
  Tick planned_edge = kNever;
  Cycle other_plans = kNever;  // the earliest but the station's, when plan() ran
  Cycle release_at = kNever;
  bool reset_pin = true, running = false;
  std::uint32_t outputs = kResetLevels;  // those of one wire
  Level db_out = kLevelZ, miso = kLevelZ;
};

// --- inputs ----------------------------------------------------------------------------------------------------------

void Chip::Impl::set(Tick at, Pin pin, Level value) {
  advance(at);
  switch (pin) {
    case Pin::kReset: set_reset(at, value != 0); break;
    case Pin::kRxd: hear(at, value != 0); break;
    case Pin::kXCts: cts.set(at, value != 0); break;
    default:
      if (!is_input(pin) || !port.set(at, pin, value)) return;
      publish_bus(at);
  }
  plan();
}

// Returns false if the station has no new plan.
bool Chip::Impl::hear(Tick at, bool level) {
  catch_up_line(done);
  return station.set_rxd(at, level);
}

void Chip::Impl::set_reset(Tick at, bool high) {
  if (high == reset_pin) return;
  reset_pin = high;
  if (high)
    enter_reset(at);
  else
    release_at = first_edge_after(at) + kResetSynchroniser;
}

void Chip::Impl::enter_reset(Tick at) {
  running = false;
  release_at = kNever;
  catch_up_line(done);
  station.leave_run(at);
  reset_blocks();
  publish(at, kResetLevels);
  publish_bus(at);
}

void Chip::Impl::reset_blocks() {
  interrupt.reset();
  map.reset();
  port.reset();
  user.reset();
}

// --- time ------------------------------------------------------------------------------------------------------------

// Kept because it is read far more often than changed: every caller of a block updates it.
// A55: OFFLINE waits for the end of any telegram.
void Chip::Impl::plan() {
  other_plans = std::min({release_at, user.next(), map.next(), interrupt.next(), cts.next(), port.next(),
                          map.stops() ? station.unseen() : kNever});
  plan_station();
}

void Chip::Impl::plan_station() {
  const Cycle cycle = std::min(other_plans, station.next());
  planned_edge = cycle == kNever ? kNever : std::max(cycle, done + 1) * kTicksPerCycle;
}

void Chip::Impl::advance(Tick to) {
  for (Tick edge = next_event(); edge <= to; edge = next_event()) evaluate(edge, to);
  now = std::max(now, to);
  done = std::max(done, now / kTicksPerCycle);
}

// The edge at tick `event`, and similar ones up to `to`.
void Chip::Impl::evaluate(Tick event, Tick to) {
  now = event;
  const Cycle cycle = event / kTicksPerCycle;
  if (only_sends(cycle)) return send_bits(cycle, to);
  rising_edge(cycle);
  if (skips()) plan();  // step evaluates each edge
}

// Most edges of an answering chip change TXD only.
void Chip::Impl::send_bits(Cycle cycle, Tick to) {
  const Cycle act = std::min({other_plans, station.only_sends_until(), to / kTicksPerCycle + 1});
  do {
    done = cycle;
    now = cycle * kTicksPerCycle;
    cycle = station.send_bit(cycle);
    publish(now, with_txd());
  } while (cycle < act);
  plan_station();
}

// The user's accesses came before; the station decides, the store carries out, the interrupt tells.
void Chip::Impl::rising_edge(Cycle cycle) {
  catch_up_line(cycle - 1);
  done = cycle;
  if (cycle == release_at) {
    release_at = kNever;
    running = true;
    port.release(cycle);
    publish_bus(cycle * kTicksPerCycle);
  }
  cts.eval(cycle, station);
  if (!skips() || std::min(station.next(), station.unseen()) <= cycle) station.eval(cycle);
  user.eval(cycle);
  map.eval(cycle);
  interrupt.eval(cycle);
  if (running) publish(cycle * kTicksPerCycle, outputs_now());
  if (cycle != port.next()) return;
  port.eval(cycle);
  publish_bus(cycle * kTicksPerCycle);
}

// --- accesses --------------------------------------------------------------------------------------------------------

// The edge that takes the access; kNever in reset.
Cycle Chip::Impl::begin_access(Cycle cycle, Address address) {
  advance(cycle * kTicksPerCycle);
  if (running) return done + 1;
  log.at_cycle(done, Reason::kInReset, address);
  return kNever;
}

std::uint8_t Chip::Impl::load(Cycle cycle, Address address) {
  const Cycle edge = begin_access(cycle, address);
  if (edge == kNever) return 0;
  const std::uint8_t value = map.read(edge, address);
  plan();
  return value;
}

void Chip::Impl::store(Cycle cycle, Address address, std::uint8_t value) {
  const Cycle edge = begin_access(cycle, address);
  if (edge == kNever) return;
  map.write(edge, address, value);
  plan();
}

Level Chip::Impl::sample(Tick at) {
  advance(at);
  const Level level = port.user_samples(at);
  publish_bus(at);
  plan();
  return level;
}

// --- outputs ---------------------------------------------------------------------------------------------------------

std::uint32_t Chip::Impl::outputs_now() const {
  const bool high_active = user.modes().has0(regs::kMode0IntPol);
  return bit(Pin::kTxd, station.txd()) | bit(Pin::kRts, station.rts()) |
         bit(Pin::kXInt, interrupt.latch() == high_active) |
         bit(Pin::kXDataExch, station.slave().state() != profibus::DpState::kDataExch) |  // A35
         (outputs & mask(Pin::kXReady));
}

void Chip::Impl::publish(Tick at, std::uint32_t levels) {
  std::uint32_t changed = (levels ^ outputs) & watched;
  outputs = levels;
  for (; changed != 0; changed &= changed - 1) {
    const auto pin = static_cast<Pin>(__builtin_ctz(changed));
    sink.call(sink.self, at, pin, (levels & mask(pin)) != 0 ? Level{1} : Level{0});
  }
}

void Chip::Impl::publish_bus(Tick at) {
  publish(at, (outputs & ~mask(Pin::kXReady)) | bit(Pin::kXReady, port.xready()));
  if (std::exchange(db_out, port.db_out()) != db_out && (watched & mask(Pin::kDbOut)) != 0)
    sink.call(sink.self, at, Pin::kDbOut, db_out);
  if (std::exchange(miso, port.miso()) != miso && (watched & mask(Pin::kMiso)) != 0)
    sink.call(sink.self, at, Pin::kMiso, miso);
}

Level Chip::Impl::level(Pin pin) const {
  if (pin == Pin::kReset) return reset_pin;
  if (pin == Pin::kRxd) return station.rxd();
  if (pin == Pin::kXCts) return cts.pin();
  if (pin == Pin::kDbOut) return db_out;
  if (pin == Pin::kMiso) return miso;
  if (pin == Pin::kClkOut) return kLevelX;
  if (is_input(pin)) return port.level(pin);
  return (outputs & mask(pin)) != 0 ? Level{1} : Level{0};
}

// --- saved and restored ----------------------------------------------------------------------------------------------

template <class Archive>
void Chip::Impl::store(Archive& archive) {
  auto& [its_config, its_log, its_interrupt, its_user, its_station, its_map, its_cts, its_port, its_sink, its_watched,
         its_now, its_done, its_edge, its_other_plans, its_release, its_reset, runs, its_outputs, its_db, its_miso] =
      *this;
  archive.given(its_config, its_log, its_sink, its_watched, its_edge, its_other_plans);
  archive.within(Tick{0}, Tick{1} << 62, its_now);
  archive.cycles(its_done, its_release);
  archive(its_interrupt);
  its_station.store(archive, its_user);
  archive(its_map, its_cts, its_port, its_reset, runs);
  archive.within(0U, kOutputPins, its_outputs);
  archive.within(kLevelX, Level{0xFF}, its_db);
  archive.within(kLevelZ, Level{1}, its_miso);
  if constexpr (Archive::kReads) its_user.derive();
  archive.check(is_possible());
}

// All plans lie in the future.
bool Chip::Impl::is_possible() const {
  const Cycle first = std::min({release_at, user.next(), map.next(), port.next()});
  return done == now / kTicksPerCycle && first > done;
}

void Chip::Impl::take_over(const Impl& observed) {
  log = observed.log;
  sink = observed.sink;
  watched = observed.watched;
  plan();
}

// --- the chip --------------------------------------------------------------------------------------------------------

Chip::Chip(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
Chip::~Chip() = default;

void Chip::set(Tick at, Pin pin, Level level) { impl_->set(at, pin, level); }
void Chip::advance(Tick to) { impl_->advance(to); }
void Chip::advance_in_run(Tick to) { whole_telegrams::advance_in_run(*impl_, to); }
Tick Chip::next_event() const { return impl_->next_event(); }
Tick Chip::now() const { return impl_->now; }
profibus::Unheard Chip::unheard() const { return impl_->station.unheard(); }
void Chip::hear(Tick at, bool level) {
  if (impl_->hear(at, level)) impl_->plan();
}
bool Chip::hear(Tick at, const profibus::CharacterRun& run) { return whole_telegrams::hear(*impl_, at, run); }
profibus::Unconcerned Chip::unconcerned() const { return whole_telegrams::unconcerned(*impl_); }
void Chip::pass(std::uint64_t count) { impl_->station.pass(count); }
void Chip::leave_run(Tick at) { whole_telegrams::leave_run(*impl_, at); }
bool Chip::left_run() const { return impl_->station.left_run(); }
bool Chip::begins_to_send() const { return whole_telegrams::begins_to_send(*impl_); }
profibus::CharacterRun Chip::hide_txd() { return whole_telegrams::hide_txd(*impl_); }
void Chip::show_txd(Tick at) { whole_telegrams::show_txd(*impl_, at); }
std::uint8_t Chip::load(Cycle cycle, Address address) { return impl_->load(cycle, address); }
void Chip::store(Cycle cycle, Address address, std::uint8_t value) { impl_->store(cycle, address, value); }
std::uint8_t Chip::peek(Address address) const { return impl_->map.peek(address); }
void Chip::poke(Address address, std::uint8_t value) { impl_->map.poke(address, value); }
Level Chip::sample(Tick at) { return impl_->sample(at); }
Level Chip::level(Pin pin) const { return impl_->level(pin); }

void Chip::watch(const PinSink& sink, std::uint32_t pins) {
  impl_->sink = sink;
  impl_->watched = sink.call != nullptr ? pins & kOutputPins : 0;
}
void Chip::on_event(const profibus::EventSink& sink) { impl_->log.attach(sink); }

std::uint8_t Chip::address() const { return impl_->station.slave().address(); }

Status Chip::status() const {
  impl_->catch_up_line(impl_->done);
  const profibus::Station& station = impl_->station;
  Status status;
  status.dp_state = station.slave().state();
  status.baud_index = station.baud_index();
  status.address = station.slave().address();
  status.master = station.slave().master();
  status.telegrams_received = station.telegrams_received();
  status.telegrams_answered = station.telegrams_answered();
  status.data_exchanges = impl_->user.data_exchanges();
  status.outputs_missed = impl_->user.outputs_missed();
  return status;
}

std::vector<std::uint8_t> Chip::save() const { return profibus::save_chip<StateHead>(*impl_); }

void Chip::restore(const std::uint8_t* bytes, std::size_t size) {
  profibus::restore_chip<StateHead>(impl_, bytes, size);
}

}  // namespace dsdpv1::spc3
