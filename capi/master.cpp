// Shared by masters of both classes.
#include "capi/master.hpp"

#include <utility>

#include "capi/names.hpp"
#include "capi/sized.hpp"

using capi::fail;
using capi::guarded;
using capi::need;

dpsim_master::dpsim_master(dpsim_bus& its_bus, std::uint8_t its_address)
    : bus(its_bus), station(its_bus.next_station()), address(its_address) {}

dpsim_master::dpsim_master(dpsim_bus& its_bus, int master_class, const bus::MasterConfig& config)
    : dpsim_master(its_bus, config.address) {
  const bus::StationId id = bus.segment.stations();
  if (master_class == 1) {
    own_1_ = std::make_unique<bus::Master1>(bus.segment, config);
    add(id, *own_1_);
  } else {
    own_2_ = std::make_unique<bus::Master2>(bus.segment, config);
    add(id, *own_2_);
  }
}

dpsim_master::dpsim_master(dpsim_bus& its_bus, bus::StationId id, std::uint8_t its_address, bus::Master1& own)
    : dpsim_master(its_bus, its_address) {
  add(id, own);
}

dpsim_master::dpsim_master(dpsim_bus& its_bus, bus::StationId id, std::uint8_t its_address, bus::Master2& own)
    : dpsim_master(its_bus, its_address) {
  add(id, own);
}

void dpsim_master::add(bus::StationId id, bus::Master1& own) {
  class_1 = &own;
  capi::connect(*this, own);
  bus.timeline.add(own);
  bus.add_station({id, capi::Station::Kind::kMaster});
}

void dpsim_master::add(bus::StationId id, bus::Master2& own) {
  class_2 = &own;
  capi::connect(*this, own);
  bus.timeline.add(own);
  bus.add_station({id, capi::Station::Kind::kMaster});
}

dpsim_event dpsim_master::event(dpsim_event_type type, bus::Tick at) const {
  dpsim_event made = capi::event_of(type, at);
  made.station = station;
  return made;
}

namespace dsdpv1::capi {

namespace {

void need_class(const dpsim_master* master, bool has_it, int wanted, int other) {
  need(master, "master");
  if (!has_it)
    fail(DPSIM_ERR_STATE,
         "the master is of class " + std::to_string(other) + ", this is for one of class " + std::to_string(wanted));
}

}  // namespace

const bus::Master1& class_1_of(const dpsim_master* master) {
  need_class(master, master != nullptr && master->class_1 != nullptr, 1, 2);
  return *master->class_1;
}
bus::Master1& class_1_of(dpsim_master* master) {
  class_1_of(static_cast<const dpsim_master*>(master));
  return *master->class_1;
}

const bus::Master2& class_2_of(const dpsim_master* master) {
  need_class(master, master != nullptr && master->class_2 != nullptr, 2, 1);
  return *master->class_2;
}
bus::Master2& class_2_of(dpsim_master* master) {
  class_2_of(static_cast<const dpsim_master*>(master));
  return *master->class_2;
}

bus::Bytes bytes_of(const std::uint8_t* data, std::size_t count) {
  need_buffer(data, count, "data");
  return count == 0 ? bus::Bytes{} : bus::Bytes(data, data + count);
}

void connect(dpsim_master& master, bus::TokenRing& ring) {
  ring.on_state = [&master](bus::Tick at, bus::RingState from, bus::RingState to, const char* why) {
    dpsim_event event = master.event(DPSIM_EVENT_RING_STATE, at);
    event.from = static_cast<std::int32_t>(from);
    event.to = static_cast<std::int32_t>(to);
    event.text = why;
    master.bus.tell(event);
  };
}

bus::AcyclicCallback acyclic_done(dpsim_master& master, std::uint32_t id, std::uint8_t address) {
  return [&master, id, address](const bus::AcyclicResult& result) {
    dpsim_event event = master.event(DPSIM_EVENT_ACYCLIC_DONE, result.done_at);
    const std::string words = bus::describe(result);
    event.id = id;
    event.address = address;
    event.outcome = static_cast<std::int32_t>(result.outcome);
    event.codes =
        result.outcome == bus::AcyclicOutcome::kRefused
            ? result.refusal
            : static_cast<std::uint32_t>(result.error_decode << 16 | result.error_code_1 << 8 | result.error_code_2);
    event.data = result.data.data();
    event.data_size = static_cast<std::uint32_t>(result.data.size());
    event.text = words.c_str();
    master.bus.tell(event);
  };
}

}  // namespace dsdpv1::capi

namespace {

/// 0 means the default for the rate, -1 means 0.
std::optional<int> optional_of(const char* name, int value, int low, int high) {
  if (value != 0 && value != -1) capi::need_range(name, value, low, high);
  if (value == 0) return std::nullopt;
  return value == -1 ? 0 : value;
}

std::optional<int> positive(const char* name, int value, int low, int high) {
  if (value == 0) return std::nullopt;
  capi::need_range(name, value, low, high);
  return value;
}

// Ranges as in scenarios.
bus::BusParameters parameters_of(const dpsim_master_options& options) {
  bus::BusParameters bus;
  bus.slot_bits = positive("slot_bits", options.slot_bits, 37, 16383);
  bus.set_bits = positive("set_bits", options.set_bits, 1, 255);
  bus.quiet_bits = positive("quiet_bits", options.quiet_bits, 1, 255);
  bus.max_retries = optional_of("max_retries", options.max_retries, 1, 8);
  bus.gap_factor = optional_of("gap_factor", options.gap_factor, 1, 100).value_or(bus.gap_factor);
  bus.highest_address = static_cast<std::uint8_t>(
      positive("highest_address", options.highest_address, 1, bus::kHighestAddress).value_or(bus.highest_address));
  bus.min_slave_interval_us = optional_of("min_slave_interval_us", options.min_slave_interval_us, 1, 10'000'000);
  bus.token = options.no_token == 0;
  bus.ring = options.ring != 0;
  bus.target_rotation_bits = positive("target_rotation_bits", options.target_rotation_bits, 256, 16'777'215)
                                 .value_or(bus::kTargetRotationBits);
  capi::need_range("clock_ppm", options.clock_ppm, -20'000, 20'000);
  bus.clock_ppm = options.clock_ppm;
  return bus;
}

bus::MasterConfig config_of(const dpsim_master_options& options, const dpsim_bus& bus) {
  capi::need_range("master_class", options.master_class, 0, 2);
  capi::need_range("address", options.address, 0, bus::kHighestAddress - 1);
  capi::need_range("personality", options.personality, DPSIM_PERSONALITY_HIGH_ALWAYS, DPSIM_PERSONALITY_CLASSIC);
  bus::MasterConfig config;
  config.name = options.name != nullptr ? options.name : "master" + std::to_string(bus.next_station());
  config.address = options.address;
  config.baud = bus.baud;
  config.personality = static_cast<bus::Personality>(options.personality);
  config.bus = parameters_of(options);
  return config;
}

dpsim_ring_status status_of(const bus::TokenRing& ring) {
  dpsim_ring_status status{};
  const bus::RingStatistics& own = ring.statistics();
  status.state = static_cast<dpsim_ring_state>(ring.state());
  for (const std::uint8_t address : ring.stations().addresses())
    status.stations[address / 8] = static_cast<std::uint8_t>(status.stations[address / 8] | 1U << (address % 8U));
  status.rotations = own.rotations.count;
  status.rotation_min = own.rotations.count == 0 ? 0 : static_cast<std::uint64_t>(own.rotations.min);
  status.rotation_max = static_cast<std::uint64_t>(own.rotations.max);
  status.rotation_mean = static_cast<std::uint64_t>(own.rotations.mean());
  status.token_retries = own.token_retries;
  status.stations_dropped = own.stations_dropped;
  status.stations_found = own.stations_found;
  status.claims = own.claims;
  status.tokens_given_up = own.tokens_given_up;
  return status;
}

}  // namespace

dpsim_status dpsim_bus_add_master(dpsim_bus* bus, const dpsim_master_options* options, dpsim_master** master) {
  return guarded(
      __func__,
      [&] {
        need(bus, "bus");
        need(master, "master");
        capi::need_outside(bus->clock);
        if (bus->stations.size() >= DPSIM_LINE) fail(DPSIM_ERR_STATE, "the bus has as many stations as it can have");
        const dpsim_master_options given = capi::options_of(options, "options");
        const bus::MasterConfig config = config_of(given, *bus);
        bus->end_chips();
        bus->masters.push_back(std::make_unique<dpsim_master>(*bus, given.master_class == 2 ? 2 : 1, config));
        *master = bus->masters.back().get();
      });
}

dpsim_status dpsim_master_station(const dpsim_master* master, uint16_t* station) {
  return guarded(
      __func__,
      [&] {
        need(master, "master");
        need(station, "station");
        *station = master->station;
      });
}

dpsim_status dpsim_master_start(dpsim_master* master) {
  return guarded(
      __func__,
      [&] {
        need(master, "master");
        if (master->class_1 != nullptr)
          master->class_1->start();
        else
          master->class_2->start();
      });
}

dpsim_status dpsim_master_stop(dpsim_master* master) {
  return guarded(
      __func__,
      [&] {
        need(master, "master");
        if (master->class_1 != nullptr)
          master->class_1->stop();
        else
          master->class_2->stop();
      });
}

dpsim_status dpsim_master_set_baud(dpsim_master* master, dpsim_baud baud) {
  return guarded(
      __func__,
      [&] {
        need(master, "master");
        capi::need_range("baud", baud, 0, DPSIM_BAUD_COUNT - 1);
        if (master->class_1 != nullptr) return master->class_1->change_baud(baud);
        master->class_2->change_baud(baud);
      });
}

dpsim_status dpsim_master_get_ring(const dpsim_master* master, dpsim_ring_status* status) {
  return guarded(
      __func__,
      [&] {
        need(master, "master");
        const bus::TokenRing* ring = master->ring();
        if (ring == nullptr) fail(DPSIM_ERR_STATE, "the master is alone, it was made without `ring`");
        capi::give(status_of(*ring), status, "status");
      });
}

dpsim_status dpsim_master_read(dpsim_master* master, uint32_t peer, uint8_t slot, uint8_t index, uint8_t count,
                               uint32_t* id) {
  return guarded(
      __func__, [&] { capi::acyclic(master, peer, bus::read_request(slot, index, count), id); });
}

// As many parameters as DS_Write and DS_Transport have.
// NOLINTNEXTLINE(readability-function-size)
dpsim_status dpsim_master_write(dpsim_master* master, uint32_t peer, uint8_t slot, uint8_t index, const uint8_t* data,
                                size_t count, uint32_t* id) {
  return guarded(
      __func__, [&] { capi::acyclic(master, peer, bus::write_request(slot, index, capi::bytes_of(data, count)), id); });
}

// NOLINTNEXTLINE(readability-function-size)
dpsim_status dpsim_master_transport(dpsim_master* master, uint32_t peer, uint8_t slot, uint8_t index,
                                    const uint8_t* data, size_t count, uint32_t* id) {
  return guarded(
      __func__,
      [&] {
        capi::class_2_of(master);
        capi::acyclic(master, peer, bus::transport_request(slot, index, capi::bytes_of(data, count)), id);
      });
}
