#include "tests/mailbox/chip.hpp"

#include <algorithm>

#include "model/profibus/station.hpp"
#include "tests/mailbox/spi_port.hpp"

namespace dsdpv1::mailbox {
namespace {

using profibus::first_edge_after;
using profibus::kNever;
using profibus::kTicksPerCycle;

constexpr Cycle kResetSynchroniser = 2;  // the third rising edge after RESET's rise: two flip-flops, then the logic

// The outputs that are registers of the rising edge; the SPI port drives MISO itself.
constexpr std::uint32_t kEdgeOutputs = kOutputPins & ~mask(Pin::kMiso);
constexpr std::uint32_t kResetLevels = mask(Pin::kInt) | mask(Pin::kPbtxd);

constexpr std::uint32_t bit(Pin pin, bool level) { return level ? mask(pin) : 0; }

}  // namespace

struct Chip::Impl {
  explicit Impl(const Config& config)
      : engine(config.engine), user(log, kCapacities, station), station(log, {}, user, &user.msac()), port(log, user) {}

  void set(Tick at, Pin pin, Level value);
  void set_reset(Tick at, bool high);
  void advance(Tick to);
  Tick next_edge() const { return engine == Engine::kStep ? (done + 1) * kTicksPerCycle : planned_edge; }
  void plan();
  void apply(Tick at, Pin pin, bool high);
  void rising_edge(Cycle cycle);
  void enter_reset(Tick at);
  std::uint32_t edge_outputs() const;
  void publish_edge_outputs(Tick at, std::uint32_t levels);
  void publish_miso(Tick at);
  Level level(Pin pin) const;

  const Engine engine;
  profibus::EventLog log;
  profibus::UserSide user;
  profibus::Station station;  // the times are its defaults
  SpiPort port;

  PinSink sink;
  std::uint32_t watched = 0;
  Tick now = 0;
  Cycle done = 0;  // the last evaluated rising edge
  Tick planned_edge = kNever;
  bool reset_pin = false, running = false, rxd = true;
  Cycle release_at = kNever;
  std::uint32_t outputs = kResetLevels;
  Level miso = kLevelZ;
};

// --- inputs ----------------------------------------------------------------------------------------------------------

void Chip::Impl::set(Tick at, Pin pin, Level value) {
  advance(at);
  apply(at, pin, value != 0);
  plan();
}

void Chip::Impl::apply(Tick at, Pin pin, bool high) {
  switch (pin) {
    case Pin::kReset: return set_reset(at, high);
    case Pin::kPbrxd:
      rxd = high;
      station.set_rxd(at, high);
      return;
    case Pin::kXss:
    case Pin::kSck:
    case Pin::kMosi: port.set(at, pin, high); return publish_miso(at);
    default: return;
  }
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
  user.reset();
  port.reset();
  publish_edge_outputs(at, kResetLevels);
  publish_miso(at);
}

// --- time ------------------------------------------------------------------------------------------------------------

// Kept because it is read far more often than changed: every caller of a block updates it.
void Chip::Impl::plan() {
  const Cycle cycle = std::min({release_at, port.next(), station.next()});
  planned_edge = cycle == kNever ? kNever : std::max(cycle, done + 1) * kTicksPerCycle;
}

void Chip::Impl::advance(Tick to) {
  for (Tick edge = next_edge(); edge <= to; edge = next_edge()) {
    now = edge;
    rising_edge(edge / kTicksPerCycle);
    plan();
  }
  now = std::max(now, to);
  done = std::max(done, now / kTicksPerCycle);
}

// The user's side acts before the station, which relies on it.
void Chip::Impl::rising_edge(Cycle cycle) {
  done = cycle;
  if (cycle == release_at) {
    release_at = kNever;
    running = true;
    port.release();
  }
  port.eval(cycle);
  station.eval(cycle);
  if (running) publish_edge_outputs(cycle * kTicksPerCycle, edge_outputs());
}

// --- outputs ---------------------------------------------------------------------------------------------------------

std::uint32_t Chip::Impl::edge_outputs() const {
  return bit(Pin::kInt, port.int_level()) | bit(Pin::kPbtxd, station.txd()) | bit(Pin::kPbrts, station.rts());
}

void Chip::Impl::publish_edge_outputs(Tick at, std::uint32_t levels) {
  std::uint32_t changed = (levels ^ outputs) & kEdgeOutputs;
  outputs = levels;
  for (changed &= watched; changed != 0; changed &= changed - 1) {
    const auto pin = static_cast<Pin>(__builtin_ctz(changed));
    sink.call(sink.self, at, pin, (levels & mask(pin)) != 0 ? Level{1} : Level{0});
  }
}

void Chip::Impl::publish_miso(Tick at) {
  if (port.miso() == miso) return;
  miso = port.miso();
  if ((watched & mask(Pin::kMiso)) != 0) sink.call(sink.self, at, Pin::kMiso, miso);
}

Level Chip::Impl::level(Pin pin) const {
  switch (pin) {
    case Pin::kReset: return reset_pin;
    case Pin::kPbrxd: return rxd;
    case Pin::kXss:
    case Pin::kSck:
    case Pin::kMosi: return port.level(pin);
    case Pin::kMiso: return miso;
    default: return (outputs & mask(pin)) != 0 ? Level{1} : Level{0};
  }
}

// --- the chip --------------------------------------------------------------------------------------------------------

Chip::Chip(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
Chip::~Chip() = default;

void Chip::set(Tick at, Pin pin, Level level) { impl_->set(at, pin, level); }
void Chip::advance(Tick to) { impl_->advance(to); }
Tick Chip::next_event() const { return impl_->next_edge(); }
Tick Chip::now() const { return impl_->now; }
Level Chip::level(Pin pin) const { return impl_->level(pin); }

void Chip::watch(const PinSink& sink, std::uint32_t pins) {
  impl_->sink = sink;
  impl_->watched = sink.call != nullptr ? pins & kOutputPins : 0;
}

void Chip::on_event(const profibus::EventSink& sink) { impl_->log.attach(sink); }

Status Chip::status() const {
  const profibus::Station& station = impl_->station;
  Status status;
  status.dp_state = station.slave().state();
  status.baud_index = station.baud_index();
  status.address = station.slave().address();
  status.master = station.slave().master();
  status.telegrams_received = station.telegrams_received();
  status.telegrams_answered = station.telegrams_answered();
  status.data_exchanges = impl_->user.data_exchanges();
  status.outputs_missed = impl_->user.outputs_replaced();
  return status;
}

}  // namespace dsdpv1::mailbox
