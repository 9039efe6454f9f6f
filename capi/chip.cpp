#include "capi/chip.hpp"

#include <algorithm>
#include <utility>

#include "bus/wire/character_run.hpp"
#include "capi/bus.hpp"
#include "capi/bus_device.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"
#include "io/keys/keys.hpp"

using capi::fail;
using capi::guarded;
using capi::need;
using capi::Tick;
using tb::Level;

namespace dsdpv1::capi {
ChipPlan plan_of(const dpsim_chip_options& options, const Kind& kind, const std::string& usual_name) {
  need_range("engine", options.engine, DPSIM_ENGINE_SKIP, DPSIM_ENGINE_STEP);
  need_buffer(options.parameters, options.parameter_count, "parameters");
  ChipPlan plan;
  plan.name = options.name != nullptr ? options.name : usual_name;
  plan.settings = kind.chip.make_chip_settings();
  plan.engine = options.engine == DPSIM_ENGINE_STEP ? tb::Engine::kStep : tb::Engine::kSkip;
  set_parameters(options.parameters, options.parameter_count, kind, *plan.settings);
  for (std::size_t i = 0; i < options.parameter_count; ++i)
    plan.parameters.emplace_back(options.parameters[i].name, options.parameters[i].value);
  return plan;
}

void ChipEvents::add(const profibus::Event& event) const {
  if (fn_ == nullptr) return;
  const auto& reasons = kind_.chip.reasons();
  const auto place = std::find(reasons.begin(), reasons.end(), event.reason) - reasons.begin();
  const dpsim_chip_event told = {
      static_cast<std::uint64_t>(event.at), station_, static_cast<std::uint16_t>(place), event.a, event.b, event.c, {}};
  const Callback inside(clock_);
  fn_(user_, &told);
}

}  // namespace dsdpv1::capi

namespace {

constexpr std::size_t kTooLong = 1 << 20;  // longer than any run accepted by a core

/// The pin's row of the table; throws for an unknown number.
const tb::PinInfo& pin_of(const capi::Kind& kind, std::uint16_t number) {
  const tb::PinTable& pins = kind.chip.pins();
  if (number >= pins.size())
    fail(DPSIM_ERR_NOT_FOUND,
         "pin is " + std::to_string(number) + ", expected 0 to " + std::to_string(pins.size() - 1));
  return pins[number];
}

bool may_float(const tb::PinInfo& pin) { return pin.bus != nullptr; }
Level highest_of(const tb::PinInfo& pin) { return static_cast<Level>((1 << pin.width) - 1); }

void check_address(const dpsim_chip& chip, std::uint16_t address) {
  if (chip.kind.chip.cells() == 0) fail(DPSIM_ERR_UNSUPPORTED, "a chip of this kind shares no memory with its user");
  capi::need_range("address", address, 0, chip.kind.chip.cells() - 1);
}

/// Applies the changes of the line for these characters, those after `heard`.
void spell_out(dpsim_chip& chip, const bus::CharacterRun& run, Tick heard) {
  const tb::PinNumber line = chip.line_pin();
  bus::for_each_change(run, [&](Tick at, bool level) {
    if (at > heard) chip.set(at, line, level ? 1 : 0);
  });
}

void receive(dpsim_chip& chip, const bus::CharacterRun& run) {
  const Tick heard = chip.hear(run);
  if (heard < run.end()) spell_out(chip, run, heard);
  chip.advance(run.end());
}

[[noreturn]] void refuse_state(const std::string& what) {
  fail(DPSIM_ERR_STATE, "the chip is on a bus, expected one without a bus to be " + what);
}

void restore(dpsim_chip& chip, const std::uint8_t* bytes, std::size_t size) {
  try {
    chip.device().restore(bytes, size);
  } catch (const std::runtime_error& error) {
    fail(DPSIM_ERR_INPUT, error.what());
  }
}

dpsim_chip_status status_of(const tb::ChipStatus& own) {
  dpsim_chip_status status{};
  status.dp_state = static_cast<dpsim_dp_state>(own.dp_state);
  status.baud = own.baud.value_or(DPSIM_BAUD_NONE);
  status.address = own.address;
  status.master = own.master;
  status.telegrams_received = own.telegrams_received;
  status.telegrams_answered = own.telegrams_answered;
  status.data_exchanges = own.data_exchanges;
  status.outputs_missed = own.outputs_missed;
  status.accesses = own.accesses;
  status.longest_wait = static_cast<std::uint64_t>(own.longest_wait);
  for (std::size_t i = 0; i < own.c2.size(); ++i) {
    status.c2_master[i] = own.c2[i].master;
    status.c2_state[i] = static_cast<std::uint8_t>(own.c2[i].bits());
  }
  return status;
}

}  // namespace

dpsim_chip::dpsim_chip(const capi::Kind& its_kind, capi::ChipPlan plan)
    : dpsim_chip(its_kind, nullptr, make(its_kind, std::move(plan), nullptr)) {}

dpsim_chip::dpsim_chip(const capi::Kind& its_kind, capi::ChipPlan plan, dpsim_bus& its_bus)
    : dpsim_chip(its_kind, &its_bus, make(its_kind, std::move(plan), &its_bus)) {}

dpsim_chip::Made dpsim_chip::make(const capi::Kind& kind, capi::ChipPlan plan, dpsim_bus* bus) {
  Made made{std::make_unique<const capi::ChipPlan>(std::move(plan)), nullptr};
  if (bus == nullptr)
    made.device = kind.chip.make_device(made.plan->request());
  else
    made.device = std::make_unique<capi::BusDevice>(kind, *made.plan, *bus);
  return made;
}

dpsim_chip::dpsim_chip(const capi::Kind& its_kind, dpsim_bus* its_bus, Made made)
    : kind(its_kind),
      bus(its_bus),
      station(its_bus == nullptr ? 0 : static_cast<std::uint16_t>(its_bus->next_station() - 1)),
      clock(its_bus == nullptr ? own_ : its_bus->clock),
      changes(clock),
      events(its_kind, station, clock),
      levels_(levels_of(its_kind)),
      plan_(std::move(made.plan)),
      device_(std::move(made.device)) {
  told_.station = station;
  device_->on_event(
      {[](void* self, const profibus::Event& event) { static_cast<dpsim_chip*>(self)->events.add(event); }, this});
}

void dpsim_chip::watch(tb::PinMask pins) {
  watched_ = pins;
  const bool directly = bus == nullptr && changes.are_told();
  sink_ = {directly ? tell : keep, this};
  watch_device();
}

void dpsim_chip::watch_device() {
  if (uart_)
    device_->watch({hear_txd, this}, watched_ | tb::mask_of(uart_->txd()));
  else
    device_->watch(sink_, watched_);
}

void dpsim_chip::hear_txd(void* self, Tick at, PinNumber pin, Level level) {
  auto* own = static_cast<dpsim_chip*>(self);
  if (pin == own->uart_->txd()) own->uart_->txd_changed(at, level != 0);
  if ((own->watched_ & tb::mask_of(pin)) != 0) own->sink_.call(own->sink_.self, at, pin, level);
}

void dpsim_chip::open_uart(PinNumber txd, const dsdpv1::UartTiming& timing) {
  if (uart_) return uart_->set_rate(timing, clock.now);
  uart_ = std::make_unique<capi::UserUart>(txd, timing);
  watch_device();
}

capi::UserUart& dpsim_chip::uart() const {
  if (!uart_) fail(DPSIM_ERR_STATE, "the UART is not open, call dpsim_chip_uart_open before");
  return *uart_;
}

void dpsim_chip::resume() {
  clock.now = device_->now();
  changes.forget();
  if (uart_) uart_->restart(clock.now);
}

std::int64_t dpsim_chip::parameter(const std::string& name) const {
  for (const auto& [given, value] : plan_->parameters)
    if (given == name) return value;
  for (const capi::Parameter& each : kind.parameters)
    if (each.name == name) return each.default_value;
  return 0;
}

// Passes a change from the core directly to the caller's function; this is all that the library adds to a change.
void dpsim_chip::tell(void* self, Tick at, PinNumber pin, Level level) {
  auto* own = static_cast<dpsim_chip*>(self);
  own->told_.tick = static_cast<std::uint64_t>(at);
  own->told_.pin = pin;
  own->told_.level = level;
  own->changes.tell_running(own->told_);
}

void dpsim_chip::keep(void* self, Tick at, PinNumber pin, Level level) {
  auto* own = static_cast<dpsim_chip*>(self);
  own->changes.add({static_cast<std::uint64_t>(at), own->station, pin, level, 0});
}

[[gnu::noinline]] void dpsim_chip::set_watched(Tick at, PinNumber pin, Level level) {
  const Level before = device_->level(pin);
  device_->set(at, pin, level);
  if (level != before) sink_.call(sink_.self, at, pin, level);
}

Tick dpsim_chip::hear(const bus::CharacterRun& run) {
  const tb::PinNumber line = line_pin();
  const profibus::CharacterRun told{run.start, run.bit / profibus::kTicksPerCycle, run.bytes,
                                    static_cast<int>(std::min(run.size, kTooLong))};
  const bool silent = (watched_ & tb::mask_of(line)) == 0 && device_->level(line) == 1;
  if (run.size == 0 || run.bit % profibus::kTicksPerCycle != 0 || !silent || !device_->hear(run.start, told))
    return kNotHeard;
  heard_ = &run;
  device_->advance_in_run(run.end());
  heard_ = nullptr;
  if (device_->left_run()) device_->leave_run(device_->now());
  return device_->now();
}

/// In a callback: the line's level before changes at the present tick.
Level dpsim_chip::heard_level() const {
  const Tick before = device_->now() - 1;
  return before < heard_->start || heard_->level(before) ? 1 : 0;
}

std::array<dpsim_chip::Levels, tb::kMostPins> dpsim_chip::levels_of(const capi::Kind& its_kind) const {
  std::array<Levels, tb::kMostPins> levels{};
  const tb::PinTable& pins = its_kind.chip.pins();
  for (std::size_t i = 0; i < pins.size(); ++i) {
    if (!pins[i].input || (bus != nullptr && i == its_kind.chip.board_pins().rxd)) continue;
    const Level low = may_float(pins[i]) ? DPSIM_Z : Level{0};
    levels[i] = {low, static_cast<std::uint16_t>(highest_of(pins[i]) - low + 1)};
  }
  return levels;
}

void dpsim_chip::refuse(std::uint16_t number, Level level) const {
  const tb::PinInfo& pin = pin_of(kind, number);
  if (!pin.input) fail(DPSIM_ERR_ARGUMENT, std::string(pin.name) + " is an output");
  if (bus != nullptr && number == line_pin())
    fail(DPSIM_ERR_STATE, std::string(pin.name) + " of a chip on a bus is the line");
  fail(DPSIM_ERR_ARGUMENT, "the level of " + std::string(pin.name) + " is " + std::to_string(level) +
                               ", expected 0 to " + std::to_string(highest_of(pin)) +
                               (may_float(pin) ? " and DPSIM_Z" : ""));
}

dpsim_status dpsim_chip_create(const dpsim_chip_options* options, dpsim_chip** chip) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        const dpsim_chip_options given = capi::options_of(options, "options");
        const capi::Kind& kind = capi::kind_of(given.kind);
        *chip = std::make_unique<dpsim_chip>(kind, capi::plan_of(given, kind, "chip")).release();
      });
}

void dpsim_chip_destroy(dpsim_chip* chip) {
  if (chip != nullptr && chip->bus == nullptr) delete chip;
}

dpsim_status dpsim_chip_set(dpsim_chip* chip, uint64_t tick, uint16_t pin, dpsim_level level) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        const capi::Running running(chip->clock);
        chip->set_checked(tick, pin, level);
        chip->changes.check();
      });
}

dpsim_status dpsim_chip_set_many(dpsim_chip* chip, const dpsim_change* changes, size_t count, size_t* done) {
  std::size_t number = 0;
  const dpsim_status status = guarded(__func__, [&] {
    need(chip, "chip");
    capi::need_buffer(changes, count, "changes");
    const capi::Running running(chip->clock);
    for (; number < count; ++number)
      chip->set_checked(changes[number].tick, changes[number].pin, changes[number].level);
    chip->changes.check();
  });
  if (done != nullptr) *done = number;
  return status;
}

dpsim_status dpsim_chip_receive(dpsim_chip* chip, uint64_t tick, uint32_t bit, const uint8_t* bytes, size_t count,
                                uint64_t* end) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_buffer(bytes, count, "bytes");
        capi::need_range("bit", bit, 1, bus::kTicksPerMs);
        const capi::Running running(chip->clock);
        if (chip->bus != nullptr) fail(DPSIM_ERR_STATE, "the chip is on a bus, whose line it hears");
        const bus::CharacterRun run{capi::tick_from(tick, chip->clock.now), bit, bytes, count};
        receive(*chip, run);
        chip->clock.now = run.end();
        chip->changes.check();
        if (end != nullptr) *end = capi::tick_out(run.end());
      });
}

dpsim_status dpsim_chip_advance(dpsim_chip* chip, uint64_t tick) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        const capi::Running running(chip->clock);
        const Tick to = capi::tick_from(tick, chip->clock.now);
        chip->advance(to);
        chip->clock.now = to;
        chip->changes.check();
      });
}

dpsim_status dpsim_chip_next(dpsim_chip* chip, uint64_t* tick) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(tick, "tick");
        capi::need_outside(chip->clock);
        *tick = capi::tick_out(chip->device().next_event());
      });
}

dpsim_status dpsim_chip_now(const dpsim_chip* chip, uint64_t* tick) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(tick, "tick");
        *tick = capi::tick_out(chip->device().now());
      });
}

dpsim_status dpsim_chip_level(const dpsim_chip* chip, uint16_t pin, dpsim_level* level) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(level, "level");
        pin_of(chip->kind, pin);
        *level = chip->level(static_cast<tb::PinNumber>(pin));
      });
}

dpsim_status dpsim_chip_sample(dpsim_chip* chip, uint64_t tick, dpsim_level* level) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(level, "level");
        if (!chip->kind.has_host_bus) capi::refuse_host_bus();
        const capi::Running running(chip->clock);
        const Tick at = capi::tick_from(tick, chip->clock.now);
        *level = chip->device().sample(at);
        chip->clock.now = at;
        chip->changes.check();
      });
}

dpsim_status dpsim_chip_watch(dpsim_chip* chip, uint64_t pins, dpsim_change_fn fn, void* user) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_outside(chip->clock);
        chip->changes.tell(fn, user);
        chip->watch(static_cast<tb::PinMask>(pins & tb::all_of(chip->kind.chip.pins())));
      });
}

dpsim_status dpsim_chip_read_changes(dpsim_chip* chip, dpsim_change* changes, size_t capacity, size_t* count) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_outside(chip->clock);
        capi::read_changes(chip->changes, changes, capacity, count);
      });
}

dpsim_status dpsim_chip_on_event(dpsim_chip* chip, dpsim_chip_event_fn fn, void* user) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_outside(chip->clock);
        chip->events.tell(fn, user);
      });
}

dpsim_status dpsim_chip_event_text(const char* kind, const dpsim_chip_event* event, char* text, size_t capacity) {
  return guarded(
      __func__,
      [&] {
        need(event, "event");
        need(text, "text");
        capi::need_range("capacity", static_cast<long long>(capacity), 1, INT64_MAX);
        const capi::Kind& own = capi::kind_of(kind);
        const auto& reasons = own.chip.reasons();
        if (event->reason >= reasons.size())
          fail(DPSIM_ERR_NOT_FOUND,
               "reason is " + std::to_string(event->reason) + ", expected 0 to " + std::to_string(reasons.size() - 1));
        const std::string words =
            own.chip.describe({static_cast<Tick>(event->tick), reasons[event->reason], event->a, event->b, event->c});
        text[words.copy(text, capacity - 1)] = '\0';
        if (words.size() >= capacity)
          fail(DPSIM_ERR_SPACE, "the text has " + std::to_string(words.size()) + " bytes, capacity is " +
                                    std::to_string(capacity) + " with its final 0");
      });
}

dpsim_status dpsim_chip_get_status(const dpsim_chip* chip, dpsim_chip_status* status) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::give(status_of(chip->device().status()), status, "status");
      });
}

dpsim_status dpsim_chip_peek(const dpsim_chip* chip, uint16_t address, uint8_t* value) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(value, "value");
        check_address(*chip, address);
        *value = chip->device().peek(address);
      });
}

dpsim_status dpsim_chip_save(const dpsim_chip* chip, uint8_t* bytes, size_t capacity, size_t* size) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(size, "size");
        capi::need_buffer(bytes, capacity, "bytes");
        capi::need_outside(chip->clock);
        if (chip->bus != nullptr) refuse_state("saved");
        const std::vector<std::uint8_t> state = chip->device().save();
        *size = state.size();
        if (state.size() > capacity)
          fail(DPSIM_ERR_SPACE,
               "the state has " + std::to_string(state.size()) + " bytes, capacity is " + std::to_string(capacity));
        std::copy(state.begin(), state.end(), bytes);
      });
}

dpsim_status dpsim_chip_restore(dpsim_chip* chip, const uint8_t* bytes, size_t size) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_buffer(bytes, size, "bytes");
        capi::need_outside(chip->clock);
        if (chip->bus != nullptr) refuse_state("restored");
        restore(*chip, bytes, size);
        chip->resume();
      });
}

dpsim_status dpsim_chip_poke(dpsim_chip* chip, uint16_t address, uint8_t value) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        check_address(*chip, address);
        capi::need_outside(chip->clock);
        chip->device().poke(address, value);
      });
}
