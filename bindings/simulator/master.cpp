// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/master.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/simulator/options.hpp"
#include "bindings/simulator/pins.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

struct MasterOptions {
  dpsim_master_options master{};
  dpsim_bus_options bus{};
  int32_t verbose = 0;  ///< 1: events are reported as messages
};

/// Sets one member; returns false for an unknown name.
bool set_member(MasterOptions& options, const Option& option) {
  dpsim_master_options& master = options.master;
  const std::map<std::string, int32_t*> numbers{{"master_class", &master.master_class},
                                                {"personality", &master.personality},
                                                {"slot_bits", &master.slot_bits},
                                                {"set_bits", &master.set_bits},
                                                {"quiet_bits", &master.quiet_bits},
                                                {"target_rotation_bits", &master.target_rotation_bits},
                                                {"max_retries", &master.max_retries},
                                                {"gap_factor", &master.gap_factor},
                                                {"clock_ppm", &master.clock_ppm},
                                                {"min_slave_interval_us", &master.min_slave_interval_us},
                                                {"baud", &options.bus.baud},
                                                {"verbose", &options.verbose}};
  const std::map<std::string, uint8_t*> bytes{{"address", &master.address},
                                              {"highest_address", &master.highest_address},
                                              {"ring", &master.ring},
                                              {"no_token", &master.no_token}};
  if (const auto number = numbers.find(option.name); number != numbers.end()) {
    *number->second = static_cast<int32_t>(number_of(option, INT32_MIN, INT32_MAX));
    return true;
  }
  if (const auto byte = bytes.find(option.name); byte != bytes.end()) {
    *byte->second = static_cast<uint8_t>(number_of(option, 0, 255));
    return true;
  }
  return false;
}

MasterOptions read_options(const char* text) {
  MasterOptions options;
  options.master.size = sizeof options.master;
  options.bus.size = sizeof options.bus;
  for (const Option& each : options_of(text))
    if (!set_member(options, each))
      throw Error(DPSIM_ERR_NOT_FOUND, "option " + each.name +
                                           " of a master is unknown, expected baud, verbose and the "
                                           "members of dpsim_master_options");
  return options;
}

const char* state_name(int32_t state) {
  static constexpr std::array<const char*, 9> kNames{"offline",       "Slave_Diag", "Clear",
                                                     "Set_Prm",       "Chk_Cfg",    "Slave_Diag until ready",
                                                     "data exchange", "releasing",  "released"};
  return state < 0 || state > 8 ? "?" : kNames[static_cast<std::size_t>(state)];
}

}  // namespace

/// Destroys the bus if the construction of its master fails.
struct BusGuard {
  dpsim_bus*& bus;
  bool keep = false;
  ~BusGuard() {
    if (!keep) dpsim_bus_destroy(bus);
  }
};

Master::Master(const char* options) {
  const MasterOptions chosen = read_options(options);
  BusGuard guard{bus_};
  verbose_ = chosen.verbose != 0;
  make_bus(chosen.bus);
  check(dpsim_bus_add_master(bus_, &chosen.master, &master_));
  watch();
  guard.keep = true;
}

Master::Master(const char* scenario, const char* settings, bool verbose) : verbose_(verbose) {
  const std::vector<std::string> texts = words_of(settings, ";");
  std::vector<const char*> words;
  words.reserve(texts.size());
  for (const std::string& text : texts) words.push_back(text.c_str());
  dpsim_scenario_options options{};
  options.size = sizeof options;
  options.path = scenario;
  options.settings = words.data();
  options.setting_count = static_cast<uint32_t>(words.size());
  std::array<dpsim_master*, 128> masters{};  // a bus has no more addresses
  std::size_t count = 0;
  const char* left_out = "";
  BusGuard guard{bus_};
  make_bus({sizeof(dpsim_bus_options), 0});
  check(dpsim_bus_add_scenario(bus_, &options, masters.data(), masters.size(), &count, &left_out));
  master_ = masters.front();
  watch();
  say(left_out);
  guard.keep = true;
}

void Master::make_bus(const dpsim_bus_options& options) {
  check(dpsim_bus_create(&options, &bus_));
  check(dpsim_bus_add_station(bus_, "others", &others_));
}

void Master::watch() {
  check(dpsim_bus_watch(bus_, DPSIM_WATCH_DRIVERS, changed, this));
  check(dpsim_bus_on_event(bus_, happened, this));
}

void Master::changed(void* self, const dpsim_change* change) {
  auto* master = static_cast<Master*>(self);
  if (change->station == master->others_) return;
  Driver& driver = master->drivers_[change->station];
  (change->pin == DPSIM_STATION_TXD ? driver.txd : driver.rts) = change->level;
}

int32_t Master::outputs() const {
  int32_t txd = 1, rts = 0;
  for (const auto& [station, driver] : drivers_) {
    rts |= driver.rts;
    if (driver.rts != 0) txd &= driver.txd;
  }
  return txd + 2 * rts;
}

void Master::happened(void* self, const dpsim_event* event) {
  auto* master = static_cast<Master*>(self);
  const bool done = event->type == DPSIM_EVENT_REQUEST_DONE || event->type == DPSIM_EVENT_ACYCLIC_DONE;
  if (done && event->id != 0) master->note_answer(*event);
  if (master->verbose_) master->tell(*event);
}

/// For a telegram its data and FC; for an acyclic service its data and codes.
void Master::note_answer(const dpsim_event& event) {
  Answer& answer = answers_[event.id];
  answer.outcome = event.outcome;
  answer.codes = event.codes;
  if (event.type == DPSIM_EVENT_ACYCLIC_DONE) {
    answer.data.assign(event.data, event.data + event.data_size);
    return;
  }
  dpsim_telegram telegram{};
  telegram.size = sizeof telegram;
  dpsim_decode_error error = DPSIM_DECODE_TRUNCATED;
  if (event.data_size == 0 ||
      dpsim_telegram_decode(event.data, event.data_size, &telegram, &error, nullptr) != DPSIM_OK ||
      error != DPSIM_DECODE_OK)
    return;
  answer.codes = telegram.fc;
  answer.data.assign(telegram.data, telegram.data + telegram.data_size);
}

/// The master enters or leaves the ring; the rotation of the token is not reported.
bool enters_or_leaves(const dpsim_event& event) {
  const auto outside = [](int32_t state) { return state <= DPSIM_RING_CLAIM_TOKEN || state == DPSIM_RING_OUT; };
  return outside(event.from) != outside(event.to);
}

void Master::tell(const dpsim_event& event) {
  switch (event.type) {
    case DPSIM_EVENT_SLAVE_STATE:
      return say(fmt::format("slave {}: {} to {}{}{}", event.address, state_name(event.from), state_name(event.to),
                             *event.text != 0 ? ", " : "", event.text));
    case DPSIM_EVENT_REQUEST_DONE:
    case DPSIM_EVENT_ACYCLIC_DONE:
      if (event.id == 0) say(event.text);
      return;
    case DPSIM_EVENT_RING_STATE:
      if (enters_or_leaves(event)) say(fmt::format("token ring: {}", event.text));
      return;
    case DPSIM_EVENT_FLAG:
    case DPSIM_EVENT_CONNECTION_END: return say(event.text);
    default: return;
  }
}

void Master::step(uint64_t tick, bool enabled, bool level) {
  now_ = std::max(now_, tick);
  if (enabled == enabled_ && level == level_) {
    check(dpsim_bus_run(bus_, now_));
    return;
  }
  enabled_ = enabled;
  level_ = level;
  check(dpsim_bus_drive(bus_, now_, others_, enabled, level));
}

int64_t Master::wake() const {
  uint64_t tick = 0;
  check(dpsim_bus_next(bus_, &tick));
  return tick == DPSIM_NEVER ? -1 : static_cast<int64_t>(dpsim_ticks_to(tick, DPSIM_PS));
}

dpsim_slave_status Master::slave(int32_t address) const {
  dpsim_slave_status status{};
  status.size = sizeof status;
  check(dpsim_master_get_slave(master_, static_cast<uint8_t>(address), &status));
  return status;
}

bool Master::take_answer(uint32_t id, Answer& answer) {
  const auto found = answers_.find(id);
  if (found == answers_.end()) return false;
  answer = std::move(found->second);
  answers_.erase(found);
  return true;
}

}  // namespace dsdpv1::simulator

int32_t dsdpv1_master_create(const char* options) {
  return dsdpv1::simulator::created([&] { return std::make_unique<dsdpv1::simulator::Master>(options); });
}

int32_t dsdpv1_master_load(const char* scenario, const char* settings, int32_t verbose) {
  return dsdpv1::simulator::created(
      [&] { return std::make_unique<dsdpv1::simulator::Master>(scenario, settings, verbose != 0); });
}

int32_t dsdpv1_master_step(int32_t handle, int64_t ps, int32_t enabled, int32_t level, int64_t* wake) {
  return dsdpv1::simulator::guarded([&] {
    auto& master = dsdpv1::simulator::get<dsdpv1::simulator::Master>(handle);
    master.step(dpsim_ticks_from(static_cast<uint64_t>(ps), DPSIM_PS), enabled != 0, level != 0);
    *wake = master.wake();
    return master.outputs();
  });
}
