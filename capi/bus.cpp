#include "capi/bus.hpp"

#include <algorithm>
#include <utility>

#include "capi/chip.hpp"
#include "capi/master.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"
#include "tb/bench/scenario_masters.hpp"

using capi::fail;
using capi::guarded;
using capi::need;
using capi::Tick;

namespace dsdpv1::capi {

dpsim_heard heard_of(const bus::WireTelegram& telegram) {
  dpsim_heard heard{};
  heard.start = static_cast<std::uint64_t>(telegram.start);
  heard.end = static_cast<std::uint64_t>(telegram.end);
  heard.tsdr = telegram.tsdr ? static_cast<std::uint64_t>(*telegram.tsdr) : DPSIM_NEVER;
  heard.bytes = telegram.decoded.bytes.data();
  heard.count = static_cast<std::uint16_t>(telegram.decoded.bytes.size());
  heard.station = telegram.station;
  heard.character_errors = telegram.character_errors ? 1 : 0;
  heard.error = static_cast<dpsim_decode_error>(telegram.decoded.error);
  heard.baud = telegram.baud;
  return heard;
}

dpsim_event event_of(dpsim_event_type type, Tick at) {
  dpsim_event event{};
  event.tick = static_cast<std::uint64_t>(at);
  event.type = type;
  event.station = DPSIM_LINE;
  event.address = 255;
  event.text = "";
  return event;
}

}  // namespace dsdpv1::capi

dpsim_bus::dpsim_bus(int baud_index) : baud(baud_index) {}
dpsim_bus::~dpsim_bus() = default;

void dpsim_bus::run(Tick tick) {
  end_chips();
  timeline.run_until(tick);
  clock.now = tick;
}

void dpsim_bus::end_chips() {
  if (tap) return;
  tap = std::make_unique<capi::LineTap>(
      segment, changes,
      [this] {
        for (const auto& master : masters)
          if (master->running() && master->baud() != monitor->baud()) monitor->set_baud(master->baud());
      });
  segment.on_drive = [this](bus::StationId id, Tick at, bool enabled, bool level) { drive(id, at, enabled, level); };
  monitor = std::make_unique<bus::Monitor>(segment);
  monitor->set_baud(baud);
  monitor->on_telegram = [this](const bus::WireTelegram& telegram) {
    if (telegram_fn == nullptr) return;
    const dpsim_heard heard = capi::heard_of(telegram);
    const capi::Callback inside(clock);
    telegram_fn(telegram_user, &heard);
  };
  monitor->on_flag = [this](const bus::Flag& flag) {
    dpsim_event event = capi::event_of(DPSIM_EVENT_FLAG, flag.at);
    event.id = static_cast<std::uint32_t>(flag.kind);
    event.text = flag.text.c_str();
    tell(event);
  };
  timeline.add(*monitor);
}

void dpsim_bus::drive(bus::StationId id, Tick at, bool enabled, bool level) {
  for (std::size_t i = 0; i < stations.size(); ++i)
    if (stations[i].id == id && stations[i].kind != capi::Station::Kind::kChip)
      tap->driven(static_cast<std::uint16_t>(i), at, enabled, level);
}

void dpsim_bus::check_changes() {
  changes.check();
  for (const auto& chip : chips) chip->changes.check();
}

namespace {

capi::Station& station_of(dpsim_bus& bus, std::uint16_t number) {
  if (number >= bus.stations.size())
    fail(DPSIM_ERR_NOT_FOUND,
         "the bus has no station " + std::to_string(number) + ", it has " + std::to_string(bus.stations.size()));
  return bus.stations[number];
}

void set_level(const char* name, int level) { capi::need_range(name, level, 0, 1); }

void check_station_count(const dpsim_bus& bus) {
  if (bus.stations.size() >= DPSIM_LINE) fail(DPSIM_ERR_STATE, "the bus has as many stations as it can have");
}

}  // namespace

dpsim_status dpsim_bus_create(const dpsim_bus_options* options, dpsim_bus** bus) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        const dpsim_bus_options given = capi::options_of(options, "options");
        capi::need_range("baud", given.baud, 0, DPSIM_BAUD_COUNT - 1);
        *bus = std::make_unique<dpsim_bus>(given.baud).release();
      });
}

void dpsim_bus_destroy(dpsim_bus* bus) { delete bus; }

dpsim_status dpsim_bus_run(dpsim_bus* bus, uint64_t tick) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        capi::need_outside(bus->clock);
        bus->run(capi::tick_from(tick, bus->clock.now));
        bus->check_changes();
      });
}

dpsim_status dpsim_bus_next(dpsim_bus* bus, uint64_t* tick) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        need(tick, "tick");
        capi::need_outside(bus->clock);
        // A command given now is still planned for a time in the past.
        *tick = capi::tick_out(std::max(bus->timeline.next(), bus->timeline.now()));
      });
}

dpsim_status dpsim_bus_now(const dpsim_bus* bus, uint64_t* tick) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        need(tick, "tick");
        *tick = capi::tick_out(bus->timeline.now());
      });
}

dpsim_status dpsim_bus_add_chip(dpsim_bus* bus, const dpsim_chip_options* options, dpsim_chip** chip) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        need(chip, "chip");
        capi::need_outside(bus->clock);
        if (bus->tap)
          fail(DPSIM_ERR_STATE, "chips are added before other stations, and before the bus runs or is watched");
        check_station_count(*bus);
        const dpsim_chip_options given = capi::options_of(options, "options");
        const capi::Kind& kind = capi::kind_of(given.kind);
        auto plan = capi::plan_of(given, kind, "chip" + std::to_string(bus->next_station()));
        bus->chips.push_back(std::make_unique<dpsim_chip>(kind, std::move(plan), *bus));
        *chip = bus->chips.back().get();
      });
}

dpsim_status dpsim_bus_add_station(dpsim_bus* bus, const char* name, uint16_t* station) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        need(station, "station");
        capi::need_outside(bus->clock);
        check_station_count(*bus);
        bus->end_chips();
        const std::uint16_t number = bus->next_station();
        const bus::StationId id =
            bus->segment.attach(name != nullptr ? name : "station" + std::to_string(number), nullptr);
        bus->add_station({id, capi::Station::Kind::kOutside});
        *station = number;
      });
}

dpsim_status dpsim_bus_drive(dpsim_bus* bus, uint64_t tick, uint16_t station, int32_t enabled, int32_t level) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        set_level("enabled", enabled);
        set_level("level", level);
        const capi::Station& driver = station_of(*bus, station);
        if (driver.kind != capi::Station::Kind::kOutside)
          fail(DPSIM_ERR_NOT_FOUND, "station " + std::to_string(station) + " drives the line by itself");
        capi::need_outside(bus->clock);
        const Tick at = capi::tick_from(tick, bus->clock.now);
        bus->run(at);
        bus->segment.drive(driver.id, at, enabled != 0, level != 0);
        bus->check_changes();
      });
}

dpsim_status dpsim_bus_line(const dpsim_bus* bus, dpsim_level* level) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        need(level, "level");
        const bool high = bus->tap ? bus->tap->level(bus->timeline.now()) : bus->segment.level();
        *level = high ? 1 : 0;
      });
}

dpsim_status dpsim_bus_force(dpsim_bus* bus, uint64_t tick, dpsim_level level) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        if (level != DPSIM_Z) set_level("level (beside DPSIM_Z)", level);
        capi::need_outside(bus->clock);
        const Tick at = capi::tick_from(tick, bus->clock.now);
        bus->run(at);
        bus->segment.force(at, level == DPSIM_Z ? std::nullopt : std::optional<bool>(level != 0));
        bus->check_changes();
      });
}

dpsim_status dpsim_bus_plug(dpsim_bus* bus, uint64_t tick, uint16_t station, int32_t plugged) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        set_level("plugged", plugged);
        const bus::StationId id = station_of(*bus, station).id;
        capi::need_outside(bus->clock);
        const Tick at = capi::tick_from(tick, bus->clock.now);
        bus->run(at);
        bus->segment.plug(id, at, plugged != 0);
        bus->check_changes();
      });
}

dpsim_status dpsim_chip_station(const dpsim_chip* chip, uint16_t* station) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(station, "station");
        if (chip->bus == nullptr) fail(DPSIM_ERR_STATE, "the chip is on no bus");
        *station = chip->station;
      });
}

dpsim_status dpsim_bus_watch(dpsim_bus* bus, uint32_t what, dpsim_change_fn fn, void* user) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        capi::need_range("what", what, 0, DPSIM_WATCH_LINE | DPSIM_WATCH_DRIVERS);
        capi::need_outside(bus->clock);
        bus->end_chips();
        bus->changes.tell(fn, user);
        bus->tap->watch(bus->timeline.now(), what);
      });
}

dpsim_status dpsim_bus_read_changes(dpsim_bus* bus, dpsim_change* changes, size_t capacity, size_t* count) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        capi::need_outside(bus->clock);
        capi::read_changes(bus->changes, changes, capacity, count);
      });
}

dpsim_status dpsim_bus_on_telegram(dpsim_bus* bus, dpsim_telegram_fn fn, void* user) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        capi::need_outside(bus->clock);
        bus->telegram_fn = fn;
        bus->telegram_user = user;
      });
}

dpsim_status dpsim_bus_on_event(dpsim_bus* bus, dpsim_event_fn fn, void* user) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        capi::need_outside(bus->clock);
        bus->event_fn = fn;
        bus->event_user = user;
      });
}

const char* dpsim_flag_name(dpsim_flag flag) {
  return flag >= 0 && flag < DPSIM_FLAG_COUNT ? bus::name(static_cast<bus::FlagKind>(flag)) : "";
}

dpsim_status dpsim_bus_get_statistics(const dpsim_bus* bus, dpsim_bus_statistics* statistics) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        dpsim_bus_statistics filled{};
        if (bus->monitor) {
          const bus::MonitorStatistics& own = bus->monitor->statistics();
          filled.telegrams = own.telegrams;
          filled.wrong = own.wrong;
          std::copy(own.by_kind.begin(), own.by_kind.end(), filled.by_kind);
          std::copy(own.flags.begin(), own.flags.end(), filled.flags);
        }
        capi::give(filled, statistics, "statistics");
      });
}

dpsim_status dpsim_bus_get_tsdr(const dpsim_bus* bus, uint8_t address, dpsim_tsdr_statistics* statistics) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        capi::need_range("address", address, 0, bus::kHighestAddress);
        dpsim_tsdr_statistics filled{};
        if (bus->monitor && bus->monitor->statistics().stations.count(address) != 0) {
          const bus::StationStatistics& own = bus->monitor->statistics().stations.at(address);
          filled.requests = own.requests;
          filled.answers = own.answers;
          filled.unanswered = own.unanswered;
          filled.tsdr_min = own.answers == 0 ? 0 : static_cast<std::uint64_t>(own.tsdr_min);
          filled.tsdr_max = static_cast<std::uint64_t>(own.tsdr_max);
          filled.tsdr_mean = static_cast<std::uint64_t>(own.tsdr_mean());
        }
        capi::give(filled, statistics, "statistics");
      });
}
