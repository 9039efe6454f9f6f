#include "tb/kit/core.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "model/profibus/state_frame.hpp"
#include "model/profibus/whole_telegrams.hpp"

namespace dsdpv1::kit {

using profibus::first_edge_after;
using profibus::kNever;
using profibus::kTicksPerCycle;
namespace whole_telegrams = profibus::whole_telegrams;

namespace {

constexpr Cycle kResetSynchroniser = 2;  // P9: the third rising edge after RESET's rise

}  // namespace

Core::Core(const Parts& of, const tb::OwnSettings& settings, bool every_edge)
    : parts(of),
      own_settings(settings),
      step(every_edge),
      user_side(log, of.capacities, station),
      station(log, {}, user_side, &user_side.msac()),
      levels{0, 1, 1, 0} {
  for (const Pin& pin : of.pins) levels.push_back(pin.rest);
  port = of.port(*this);
  port->reset();
}

// --- pins ------------------------------------------------------------------------------------------------------------

void Core::drive(Tick at, PinNumber pin, Level level) {
  if (std::exchange(levels[pin], level) == level || (watched & tb::mask_of(pin)) == 0) return;
  sink.call(sink.self, at, pin, level);
}

void Core::set(Tick at, PinNumber pin, Level level) {
  advance(at);
  if (pin == kRxd) return hear(at, level != 0);
  if (std::exchange(levels[pin], level) == level) return;
  if (pin == kReset)
    set_reset(at, level != 0);
  else if (running)
    port->input(at, pin, level);
  plan();
}

void Core::hear(Tick at, bool level) {
  levels[kRxd] = level ? 1 : 0;
  catch_up_line(done);
  if (station.set_rxd(at, level)) plan_station();
}

void Core::set_reset(Tick at, bool high) {
  if (!high) return reset(at);
  release_at = first_edge_after(at) + kResetSynchroniser;
}

void Core::reset(Tick at) {
  running = false;
  release_at = kNever;
  catch_up_line(done);
  station.leave_run(at);
  user_side.reset();
  port->reset();
  drive(at, kTxd, 1);
  drive(at, kRts, 0);
  for (std::size_t i = 0; i < parts.pins.size(); ++i)
    if (parts.pins[i].direction == kOutput) drive(at, static_cast<PinNumber>(kOwn + i), parts.pins[i].rest);
}

// --- time ------------------------------------------------------------------------------------------------------------

// Kept because it is read far more often than changed.
void Core::plan() {
  other_plans = std::min(release_at, running ? port->next() : kNever);
  plan_station();
}

void Core::plan_station() {
  const Cycle cycle = std::min(other_plans, station.next());
  planned_edge = cycle == kNever ? kNever : std::max(cycle, done + 1) * kTicksPerCycle;
}

void Core::advance(Tick to) {
  for (Tick edge = next_event(); edge <= to; edge = next_event()) evaluate(edge, to);
  now = std::max(now, to);
  done = std::max(done, now / kTicksPerCycle);
}

void Core::evaluate(Tick event, Tick /*to*/) {
  now = event;
  rising_edge(event / kTicksPerCycle);
  if (skips()) plan();
}

// The port acts before the station, which relies on it, and shows what has come of it.
void Core::rising_edge(Cycle cycle) {
  catch_up_line(cycle - 1);
  done = cycle;
  if (cycle == release_at) {
    release_at = kNever;
    running = true;
  }
  if (running) port->eval(cycle);
  if (!skips() || std::min(station.next(), station.unseen()) <= cycle) station.eval(cycle);
  if (!running) return;
  port->show(cycle);
  drive_at(cycle, kTxd, txd());
  drive_at(cycle, kRts, station.rts() ? 1 : 0);
}

// --- the device ------------------------------------------------------------------------------------------------------

void Device::watch(const tb::PinSink& sink, tb::PinMask pins) {
  core_->sink = sink;
  core_->watched = sink.call != nullptr ? pins : 0;
}

bool Device::hear(Tick at, const profibus::CharacterRun& run) { return whole_telegrams::hear(*core_, at, run); }
void Device::leave_run(Tick at) { whole_telegrams::leave_run(*core_, at); }
void Device::advance_in_run(Tick to) { whole_telegrams::advance_in_run(*core_, to); }
profibus::Unconcerned Device::unconcerned() const { return whole_telegrams::unconcerned(*core_); }
bool Device::begins_to_send() const { return whole_telegrams::begins_to_send(*core_); }
profibus::CharacterRun Device::hide_txd() { return whole_telegrams::hide_txd(*core_); }
void Device::show_txd(Tick at) { whole_telegrams::show_txd(*core_, at); }

// --- saved states ----------------------------------------------------------------------------------------------------

namespace {

/// The head of a state: the kind and the settings of the chip that it is from.
struct StateHead {
  static constexpr profibus::StateFrame kFrame{0x3130'5449'4B20'5044, 1};  // "DP KIT01"

  explicit StateHead(const Core& core) {
    const std::string_view own = core.parts.name;
    std::copy_n(own.begin(), std::min(own.size(), name.size()), name.begin());
    if (StoredPort* port = core.port->stored()) parameters = port->parameters();
  }
  template <class Archive>
  void store_name(Archive& archive) {
    archive(name);
  }
  std::string title() const { return {name.begin(), std::find(name.begin(), name.end(), 0)}; }

  std::array<std::uint8_t, 32> name{};
  std::vector<std::pair<std::string, std::uint32_t>> parameters;
};

}  // namespace

template <class Archive>
void Core::store(Archive& archive) {
  for (Level& level : levels) archive(level);
  archive.ticks(now);
  archive.cycles(done, release_at);
  archive(running);
  station.store(archive, user_side);
  port->stored()->store(archive);
}

void Core::take_over(const Core& observed) {
  log = observed.log;
  sink = observed.sink;
  watched = observed.watched;
  if (skips()) plan();
}

std::vector<std::uint8_t> Device::save() const {
  if (core_->port->stored() == nullptr) return {};
  profibus::StateWriter writer;
  profibus::begin_frame(writer, StateHead::kFrame);
  StateHead head(*core_);
  head.store_name(writer);
  for (auto& [name, value] : head.parameters) writer(value);
  core_->store(writer);
  return profibus::end_frame(writer.take());
}

void Device::restore(const std::uint8_t* bytes, std::size_t size) {
  if (core_->port->stored() == nullptr)
    throw profibus::StateError(std::string(core_->parts.name) + " cannot be restored");
  profibus::StateReader reader = profibus::open_frame(bytes, size, StateHead::kFrame);
  const StateHead own(*core_);
  StateHead saved = own;
  saved.store_name(reader);
  profibus::check_title(saved.title(), own.title());
  for (const auto& [name, value] : own.parameters) profibus::check_parameter(reader, name.c_str(), value);
  auto restored = std::make_unique<Core>(core_->parts, core_->own_settings, core_->step);
  restored->store(reader);
  profibus::check_frame(reader);
  restored->take_over(*core_);
  core_ = std::move(restored);
}

tb::ChipStatus Device::status() const {
  core_->catch_up_line(core_->done);
  const profibus::Station& station = core_->station;
  tb::ChipStatus status;
  status.dp_state = station.slave().state();
  if (station.baud_index().known()) status.baud = station.baud_index().code();
  status.address = station.slave().address();
  status.master = station.slave().master();
  status.telegrams_received = station.telegrams_received();
  status.telegrams_answered = station.telegrams_answered();
  status.c2 = core_->user_side.msac().c2.registry();
  status.data_exchanges = core_->user_side.data_exchanges();
  status.outputs_missed = core_->user_side.outputs_replaced();
  return status;
}

}  // namespace dsdpv1::kit
