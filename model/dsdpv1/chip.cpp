#include "model/dsdpv1/chip.hpp"

#include <algorithm>

#include "model/dpram/sequencer.hpp"
#include "model/dsdpv1/handshake.hpp"
#include "model/dsdpv1/host_port.hpp"
#include "model/dsdpv1/interrupt.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "model/profibus/station.hpp"

namespace dsdpv1 {
namespace {

using profibus::first_edge_after;
using profibus::kNever;
using profibus::kTicksPerCycle;

constexpr Cycle kResetSynchroniser = 2;  // P9, P10

// The outputs that are registers of the rising edge; D_OUT is the host port's own.
constexpr std::uint32_t kEdgeOutputs = kOutputPins & ~mask(Pin::kDOut);

constexpr std::uint32_t kResetLevels = mask(Pin::kIntr0) | mask(Pin::kPbtxd) | mask(Pin::kPbf);  // P10

profibus::StationConfig station_of(const Config& config) {
  profibus::StationConfig station;
  station.rts_lead = config.rts_lead;
  station.rts_trail = config.rts_trail;
  station.search_window = config.search_window_ms * profibus::kCyclesPerMs;
  station.search_window_bits = config.search_window_bits;
  station.baud_control = config.baud_control_ms * profibus::kCyclesPerMs;
  station.capacities = dpram::kCapacities;
  return station;
}

constexpr std::uint32_t bit(Pin pin, bool level) { return level ? mask(pin) : 0; }

}  // namespace

struct Chip::Impl {
  explicit Impl(const Config& config)
      : engine(config.engine),
        station(log, station_of(config)),
        host(log, ram),
        interrupt(config.intr_low, config.intr_gap),
        sequencer(log, ram, station.user(), config.access_interval, config.ready_cycles) {
    interrupt.reset();
  }

  void set(Tick at, Pin pin, Level value);
  void set_reset(Tick at, bool high);
  void advance(Tick to);
  Tick next_event() const { return std::min(next_edge(), host.drive_at()); }
  Tick next_edge() const { return engine == Engine::kStep ? (done + 1) * kTicksPerCycle : planned_edge; }
  void plan();
  void apply(Tick at, Pin pin, Level value);
  void rising_edge(Cycle cycle);
  void enter_reset(Tick at);
  std::uint32_t edge_outputs() const;
  void publish_edge_outputs(Tick at, std::uint32_t levels);
  void publish_data(Tick at);
  void report_ownership(Tick at);
  Level level(Pin pin) const;

  const Engine engine;
  profibus::EventLog log;
  Ram ram;
  profibus::Station station;
  HostPort host;
  Handshake handshake;
  Interrupt interrupt;
  dpram::Sequencer sequencer;

  PinSink sink;
  std::uint32_t watched = 0;
  Tick now = 0;
  Cycle done = 0;  // the last rising edge that was evaluated
  Tick planned_edge = kNever;
  bool reset_pin = false, running = false, r_req = false, r_sta = false, rxd = true;
  Cycle release_at = kNever;  // cycle R
  std::uint32_t outputs = kResetLevels;
  Level d_out = kLevelZ;
};

// --- inputs ----------------------------------------------------------------------------------------------------------

void Chip::Impl::set(Tick at, Pin pin, Level value) {
  advance(at);
  apply(at, pin, value);
  plan();
}

void Chip::Impl::apply(Tick at, Pin pin, Level value) {
  const bool high = value != 0;
  switch (pin) {
    case Pin::kReset: return set_reset(at, high);
    case Pin::kRReq:
      r_req = high;
      host.set_handshake(r_req, r_sta);
      return handshake.set_r_req(at, high);
    case Pin::kRSta:
      if (r_sta == high) return;
      r_sta = high;
      host.set_handshake(r_req, r_sta);
      handshake.set_r_sta(at, high);
      return report_ownership(at);
    case Pin::kPbrxd: rxd = high; return station.set_rxd(at, high);
    default: break;
  }
  if (value == host.level(pin)) return;
  host.set(at, pin, value);
  publish_data(at);
}

void Chip::Impl::set_reset(Tick at, bool high) {
  if (high == reset_pin) return;
  reset_pin = high;
  if (high)
    release_at = first_edge_after(at) + kResetSynchroniser;
  else
    enter_reset(at);
}

void Chip::Impl::enter_reset(Tick at) {
  running = false;
  release_at = kNever;
  sequencer.catch_up(done);  // the RAM keeps what was written before RESET fell (H6)
  sequencer.reset();
  station.reset();
  interrupt.reset();
  host.reset();
  publish_edge_outputs(at, kResetLevels);
  publish_data(at);
}

// --- time ------------------------------------------------------------------------------------------------------------

// Asked far more often than changed, so it is kept: by everybody who calls a block.
void Chip::Impl::plan() {
  const Cycle cycle =
      std::min({release_at, station.next(), host.next(), interrupt.next(), handshake.next(), sequencer.next()});
  planned_edge = cycle == kNever ? kNever : std::max(cycle, done + 1) * kTicksPerCycle;
}

void Chip::Impl::advance(Tick to) {
  for (Tick event = next_event(); event <= to; event = next_event()) {
    now = event;
    if (event == host.drive_at()) {
      host.drive();
      publish_data(event);
    } else {
      rising_edge(event / kTicksPerCycle);
      plan();
    }
  }
  now = std::max(now, to);
  done = std::max(done, now / kTicksPerCycle);
}

// The order of the blocks within one cycle: docs/microarchitecture.md.
void Chip::Impl::rising_edge(Cycle cycle) {
  done = cycle;
  if (host.next() <= cycle) {
    sequencer.catch_up(cycle - 1);
    host.eval(cycle, sequencer.owns() || !sequencer.started_up());
  }
  const bool released = cycle == release_at;
  if (released) {
    release_at = kNever;
    running = true;
    host.release();
    sequencer.start_up(cycle);
  }
  handshake.eval(cycle);
  sequencer.user_holds(handshake.user_holds());
  sequencer.eval(cycle);
  if (released && !sequencer.started_up())
    log.at_cycle(cycle, Reason::kHeldThroughReset, handshake.r_req(), handshake.r_sta());  // H6
  if (sequencer.told_user() == cycle) interrupt.trigger(cycle);                            // P7
  station.eval(cycle);
  interrupt.eval(cycle);
  if (!running) return;
  const bool owned = (outputs & mask(Pin::kLSta)) != 0;
  publish_edge_outputs(cycle * kTicksPerCycle, edge_outputs());
  if (!owned) report_ownership(cycle * kTicksPerCycle);
}

// --- outputs ---------------------------------------------------------------------------------------------------------

std::uint32_t Chip::Impl::edge_outputs() const {
  const bool owns = sequencer.owns();
  return bit(Pin::kLReq, owns) | bit(Pin::kLSta, owns) | bit(Pin::kIntr0, interrupt.level()) |
         bit(Pin::kPbtxd, station.txd()) | bit(Pin::kPbrts, station.rts()) |
         bit(Pin::kPbf, station.slave().state() != profibus::DpState::kDataExch) | bit(Pin::kBr, station.baud_found()) |
         bit(Pin::kReady, sequencer.initialised());
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
  if (host.d_out() == d_out) return;
  d_out = host.d_out();
  if ((watched & mask(Pin::kDOut)) != 0) sink.call(sink.self, at, Pin::kDOut, d_out);
}

void Chip::Impl::report_ownership(Tick at) {
  if (r_sta && running && sequencer.owns()) log.at_tick(at, Reason::kBothOwn);
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
    default: return (outputs & mask(pin)) != 0 ? Level{1} : Level{0};
  }
}

// --- the chip --------------------------------------------------------------------------------------------------------

Chip::Chip(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
Chip::~Chip() = default;

void Chip::set(Tick at, Pin pin, Level level) { impl_->set(at, pin, level); }
void Chip::advance(Tick to) { impl_->advance(to); }
Level Chip::sample(Tick at) {
  impl_->advance(at);
  return impl_->host.user_samples(at);
}
Tick Chip::next_event() const { return impl_->next_event(); }
Tick Chip::now() const { return impl_->now; }
Level Chip::level(Pin pin) const { return impl_->level(pin); }

void Chip::watch(const PinSink& sink, std::uint32_t pins) {
  impl_->sink = sink;
  impl_->watched = sink.call != nullptr ? pins & kOutputPins : 0;
}

void Chip::on_event(const profibus::EventSink& sink) { impl_->log.attach(sink); }

std::uint8_t Chip::peek(std::uint16_t address) const {
  impl_->sequencer.catch_up(impl_->done);
  return impl_->ram.read(address);
}

void Chip::poke(std::uint16_t address, std::uint8_t value) {
  impl_->sequencer.catch_up(impl_->done);
  impl_->ram.write(address, value);
}

Status Chip::status() const {
  const profibus::Station& station = impl_->station;
  Status status;
  status.dp_state = station.slave().state();
  status.baud_index = station.baud_index();
  status.address = station.slave().address();
  status.master = station.slave().master();
  status.telegrams_received = station.telegrams_received();
  status.telegrams_answered = station.telegrams_answered();
  status.data_exchanges = station.slave().data_exchanges();
  status.accesses = impl_->sequencer.accesses();
  status.outputs_missed = station.slave().outputs_replaced() + impl_->sequencer.outputs_overwritten();
  status.c2 = station.slave().rm_registry();
  status.longest_wait = static_cast<std::uint64_t>(impl_->sequencer.longest_wait());
  return status;
}

}  // namespace dsdpv1
