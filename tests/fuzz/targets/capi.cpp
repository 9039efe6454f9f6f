// Calls of the C API in any order, with valid and invalid arguments: each returns one of its statuses, and never the
// one for a fault of the library.
#include "dsdpv1/dsdpv1.h"

#include <array>
#include <cstring>
#include <deque>

#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

constexpr std::uint64_t kMostTicks = 24'000'000;  ///< 2 ms for all objects together, in which a slave comes up
constexpr const char* kScenario =
    "name: short\nbaud: 12M\nend: 650us\n"
    "slaves:\n  - {name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 4, max_outputs: 4, cfg: \"33\"}}\n"
    "masters:\n  - {name: plc, address: 2, start: 500us, slaves: [{slave: io, outputs: \"01 02 03 04\"}]}\n";

void check(dpsim_status status) {
  if (status == DPSIM_OK) return;
  if (status > DPSIM_OK || status <= DPSIM_ERR_INTERNAL)
    fuzz::promise(false, std::string("a status is one of an error of the caller: ") + dpsim_error_message());
  fuzz::promise(std::strlen(dpsim_error_message()) > 0, "an error has words");
  if (status != DPSIM_ERR_INPUT)  // a GSD file may have several
    fuzz::promise(std::strchr(dpsim_error_message(), '\n') == nullptr, "an error is one line");
}

template <class T>
T sized() {
  T made{};
  made.size = sizeof made;
  return made;
}

/// Up to three objects of a kind; some calls get none.
template <class T>
class Objects {
 public:
  T* pick(fuzz::Input& input) const { return all_[input.below(all_.size())]; }
  /// The place of the next one; nullptr if there are enough.
  T** place() {
    for (std::size_t i = 0; i + 1 < all_.size(); ++i)
      if (all_[i] == nullptr) return &all_[i];
    return nullptr;
  }
  void forget(const T* object) {
    for (T*& each : all_)
      if (each == object) each = nullptr;
  }
  void forget_all() { all_.fill(nullptr); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

 private:
  std::array<T*, 4> all_{};  ///< the last one is never there
};

class Caller {
 public:
  explicit Caller(fuzz::Input& input) : input_(input) {}
  ~Caller() {
    end_bus();
    for (dpsim_chip* each : chips_) dpsim_chip_destroy(each);
    for (dpsim_checker* each : checkers_) dpsim_checker_destroy(each);
    for (dpsim_gsd* each : gsds_) dpsim_gsd_destroy(each);
    for (dpsim_run* each : runs_) dpsim_run_destroy(each);
  }

  void run() {
    using Call = void (Caller::*)();
    static constexpr Call kCalls[] = {
        &Caller::make_chip,     &Caller::make_bus,     &Caller::set_pin,        &Caller::set_pins,
        &Caller::receive,       &Caller::advance,      &Caller::ask_chip,       &Caller::access,
        &Caller::watch,         &Caller::read_changes, &Caller::cells,          &Caller::bring_up,
        &Caller::add_chip,      &Caller::add_station,  &Caller::drive,          &Caller::ask_bus,
        &Caller::run_bus,       &Caller::end_bus,      &Caller::add_master,     &Caller::add_scenario,
        &Caller::switch_master, &Caller::add_slave,    &Caller::ask_master,     &Caller::command_master,
        &Caller::request,       &Caller::acyclic,      &Caller::add_connection, &Caller::connection,
        &Caller::make_checker,  &Caller::feed_checker, &Caller::ask_checker,    &Caller::telegram,
        &Caller::tables,        &Caller::make_gsd,     &Caller::ask_gsd,        &Caller::make_run,
        &Caller::execute_run,   &Caller::ask_run,      &Caller::end_chip,       &Caller::time,
    };
    while (!input_.empty()) (this->*kCalls[input_.below(std::size(kCalls))])();
  }

 private:
  // --- arguments
  /// Sometimes no place for an answer.
  template <class T>
  T* or_null(T& place) {
    return input_.byte() % 16 == 0 ? nullptr : &place;
  }
  /// As many of the remaining ticks; none if that is too many.
  std::uint64_t spend(std::uint64_t ticks) {
    if (ticks > left_) return 0;
    left_ -= ticks;
    return ticks;
  }
  /// A little later than `now`, and now and then before it or beyond all time.
  std::uint64_t tick(std::uint64_t now) {
    const std::uint8_t how = input_.byte();
    if (how == 1) return DPSIM_LAST_TICK + 1 + input_.number(8) / 2;
    if (how != 0) return now + spend(how % 4 == 0 ? input_.number(3) : input_.number(2));
    const std::uint64_t any = input_.number(4);
    return any < now ? any : now + spend(any - now);
  }
  std::uint64_t now_of(const dpsim_chip* chip) const {
    std::uint64_t now = 0;
    if (chip != nullptr) check(dpsim_chip_now(chip, &now));
    return now;
  }
  std::uint64_t now_of(const dpsim_bus* bus) const {
    std::uint64_t now = 0;
    if (bus != nullptr) check(dpsim_bus_now(bus, &now));
    return now;
  }
  std::uint16_t pin() { return input_.byte() % 40; }
  dpsim_level level() { return static_cast<dpsim_level>(static_cast<int>(input_.byte()) - 2); }
  std::uint8_t address() { return input_.byte() % 4 == 0 ? input_.byte() : 5; }
  const char* kind() {
    constexpr const char* kKinds[] = {nullptr, "", "dsdpv1", "dsdpv1_r", "dsdpv1_rsu", "other"};
    return kKinds[input_.below(std::size(kKinds))];
  }
  const std::string& words(std::size_t most) { return words_.emplace_back(input_.text(input_.below(most))); }

  // --- one chip
  dpsim_chip_options chip_options() {
    auto options = sized<dpsim_chip_options>();
    options.kind = kind();
    options.engine = static_cast<dpsim_engine>(input_.below(5)) / 2;
    if (input_.byte() % 16 == 0) options.size = input_.byte();
    parameter_ = {"ready_cycles", static_cast<std::int64_t>(input_.number(2))};
    if (input_.byte() % 8 == 0) parameter_ = {input_.byte() % 2 == 0 ? nullptr : "other", 1};
    options.parameters = &parameter_;
    options.parameter_count = input_.byte() % 2;
    return options;
  }
  void make_chip() {
    dpsim_chip** const place = chips_.place();
    if (place == nullptr) return;
    const dpsim_chip_options options = chip_options();
    check(dpsim_chip_create(input_.byte() % 2 == 0 ? nullptr : &options, place));
  }
  void end_chip() {
    dpsim_chip* const chip = chips_.pick(input_);
    const bool stays = chip != nullptr && on_bus(chip);
    dpsim_chip_destroy(chip);
    if (!stays) chips_.forget(chip);
  }
  bool on_bus(const dpsim_chip* chip) const {
    std::uint16_t station = 0;
    return dpsim_chip_station(chip, &station) == DPSIM_OK;
  }
  void set_pin() {
    dpsim_chip* const chip = chips_.pick(input_);
    check(dpsim_chip_set(chip, tick(now_of(chip)), pin(), level()));
  }
  void set_pins() {
    dpsim_chip* const chip = chips_.pick(input_);
    std::vector<dpsim_change> changes(input_.below(8));
    std::uint64_t now = now_of(chip);
    for (dpsim_change& each : changes) each = {now = tick(now), 0, pin(), level(), 0};
    std::size_t done = 0;
    check(dpsim_chip_set_many(chip, changes.data(), changes.size(), or_null(done)));
  }
  void receive() {
    dpsim_chip* const chip = chips_.pick(input_);
    const std::vector<std::uint8_t> bytes = input_.bytes(input_.below(32));
    std::uint64_t end = 0;
    const std::uint32_t bit = input_.byte() % 8 == 0 ? static_cast<std::uint32_t>(input_.number(2)) : 1000;
    const std::uint64_t begin = tick(now_of(chip));
    check(dpsim_chip_receive(chip, begin, bit, bytes.data(), bytes.size(), or_null(end)));
  }
  void advance() {
    dpsim_chip* const chip = chips_.pick(input_);
    check(dpsim_chip_advance(chip, tick(now_of(chip))));
  }
  void ask_chip() {
    dpsim_chip* const chip = chips_.pick(input_);
    std::uint64_t next = 0;
    check(dpsim_chip_next(chip, or_null(next)));
    dpsim_level found = 0;
    check(dpsim_chip_level(chip, pin(), or_null(found)));
    check(dpsim_chip_sample(chip, tick(now_of(chip)), or_null(found)));
    auto status = sized<dpsim_chip_status>();
    if (input_.byte() % 8 == 0) status.size = input_.byte();
    check(dpsim_chip_get_status(chip, or_null(status)));
    std::uint16_t station = 0;
    check(dpsim_chip_station(chip, or_null(station)));
  }
  void access() {
    dpsim_chip* const chip = chips_.pick(input_);
    auto timing = sized<dpsim_access_timing>();
    check(dpsim_access_timing_default(&timing));
    if (input_.byte() % 4 == 0) timing.wr_low = timing.rd_low = static_cast<std::int16_t>(input_.number(2));
    if (input_.byte() % 4 == 0) timing.cs_lead = static_cast<std::int16_t>(input_.number(2));
    if (input_.byte() % 4 == 0) timing.rd_sample = static_cast<std::int16_t>(input_.number(2));
    if (input_.byte() % 8 == 0) timing.recovery = static_cast<std::int64_t>(input_.number(8));
    const auto cell = static_cast<std::uint16_t>(input_.number(2) % 0x900);
    const dpsim_access_timing* const given = or_null(timing);
    std::uint64_t end = 0;
    const std::uint64_t begin = tick(now_of(chip));
    dpsim_level value = 0;
    if (input_.byte() % 2 == 0)
      check(dpsim_chip_read(chip, begin, cell, given, or_null(value), or_null(end)));
    else
      check(dpsim_chip_write(chip, begin, cell, input_.byte(), given, or_null(end)));
  }
  void watch() {
    dpsim_chip* const chip = chips_.pick(input_);
    const auto count = [](void* user, const dpsim_change*) { ++*static_cast<std::uint64_t*>(user); };
    const auto word = [](void*, const dpsim_chip_event* event) {
      char text[256];
      check(dpsim_chip_event_text(nullptr, event, text, sizeof text));
    };
    check(dpsim_chip_watch(chip, input_.number(4), input_.byte() % 2 == 0 ? +count : nullptr, &told_));
    check(dpsim_chip_on_event(chip, input_.byte() % 2 == 0 ? +word : nullptr, nullptr));
    dpsim_bus* const bus = buses_.pick(input_);
    check(dpsim_bus_watch(bus, input_.byte() % 5, input_.byte() % 2 == 0 ? +count : nullptr, &told_));
  }
  void read_changes() {
    std::vector<dpsim_change> changes(input_.below(16));
    std::size_t count = 0;
    check(dpsim_chip_read_changes(chips_.pick(input_), changes.data(), changes.size(), or_null(count)));
    fuzz::promise(count <= changes.size(), "no more changes than there is room for");
    check(dpsim_bus_read_changes(buses_.pick(input_), changes.data(), changes.size(), or_null(count)));
    fuzz::promise(count <= changes.size(), "no more changes than there is room for");
  }
  void cells() {
    dpsim_chip* const chip = chips_.pick(input_);
    std::uint8_t value = 0;
    check(dpsim_chip_peek(chip, static_cast<std::uint16_t>(input_.number(2) % 0x900), or_null(value)));
    check(dpsim_chip_poke(chip, static_cast<std::uint16_t>(input_.number(2) % 0x900), input_.byte()));
  }
  /// Out of reset.
  void bring_up() {
    dpsim_chip* const chip = chips_.pick(input_);
    check(dpsim_chip_set(chip, now_of(chip) + 10 * DPSIM_TICKS_PER_CYCLE, DPSIM_DSDPV1_RESET, 1));
    check(dpsim_chip_advance(chip, now_of(chip) + spend(6000 * DPSIM_TICKS_PER_CYCLE)));
  }

  // --- the bus
  void make_bus() {
    dpsim_bus** const place = buses_.place();
    if (place == nullptr) return;
    auto options = sized<dpsim_bus_options>();
    options.baud = static_cast<dpsim_baud>(input_.below(12)) - 1;
    check(dpsim_bus_create(input_.byte() % 2 == 0 ? nullptr : &options, place));
  }
  /// Its chips and masters are destroyed as well: their bus is not recorded here, so all are forgotten.
  void end_bus() {
    for (dpsim_chip* each : chips_)
      if (each != nullptr && on_bus(each)) chips_.forget(each);
    for (dpsim_bus* each : buses_) dpsim_bus_destroy(each);
    buses_.forget_all();
    masters_.forget_all();
  }
  void add_chip() {
    dpsim_chip** const place = chips_.place();
    if (place == nullptr) return;
    const dpsim_chip_options options = chip_options();
    check(dpsim_bus_add_chip(buses_.pick(input_), input_.byte() % 2 == 0 ? nullptr : &options, place));
  }
  void add_station() {
    std::uint16_t station = 0;
    check(dpsim_bus_add_station(buses_.pick(input_), input_.byte() % 2 == 0 ? nullptr : "outside", or_null(station)));
  }
  void drive() {
    dpsim_bus* const bus = buses_.pick(input_);
    const auto station = static_cast<std::uint16_t>(input_.below(8));
    switch (input_.below(3)) {
      case 0: return check(dpsim_bus_drive(bus, tick(now_of(bus)), station, input_.byte() % 3, input_.byte() % 3));
      case 1: return check(dpsim_bus_force(bus, tick(now_of(bus)), level()));
      default: return check(dpsim_bus_plug(bus, tick(now_of(bus)), station, input_.byte() % 2));
    }
  }
  void ask_bus() {
    dpsim_bus* const bus = buses_.pick(input_);
    std::uint64_t next = 0;
    check(dpsim_bus_next(bus, or_null(next)));
    dpsim_level found = 0;
    check(dpsim_bus_line(bus, or_null(found)));
    auto statistics = sized<dpsim_bus_statistics>();
    check(dpsim_bus_get_statistics(bus, or_null(statistics)));
    auto tsdr = sized<dpsim_tsdr_statistics>();
    check(dpsim_bus_get_tsdr(bus, input_.byte(), or_null(tsdr)));
    fuzz::promise(dpsim_flag_name(input_.byte() - 1) != nullptr, "a flag has a name");
  }
  void run_bus() {
    dpsim_bus* const bus = buses_.pick(input_);
    const auto heard = [](void* user, const dpsim_heard* telegram) {
      auto& caller = *static_cast<Caller*>(user);
      caller.told_ += telegram->count;
    };
    const auto event = [](void* user, const dpsim_event* each) {
      auto& caller = *static_cast<Caller*>(user);
      caller.told_ += std::strlen(each->text) + each->data_size;
    };
    check(dpsim_bus_on_telegram(bus, input_.byte() % 2 == 0 ? +heard : nullptr, this));
    check(dpsim_bus_on_event(bus, input_.byte() % 2 == 0 ? +event : nullptr, this));
    check(dpsim_bus_run(bus, tick(now_of(bus))));
  }

  // --- masters
  void add_master() {
    dpsim_master** const place = masters_.place();
    if (place == nullptr) return;
    auto options = sized<dpsim_master_options>();
    options.address = input_.byte() % 4 == 0 ? input_.byte() : 2;
    options.master_class = static_cast<std::int32_t>(input_.below(4));
    options.personality = static_cast<dpsim_personality>(input_.below(3));
    options.ring = input_.byte() % 2;
    options.no_token = input_.byte() % 4 == 0 ? 1 : 0;
    if (input_.byte() % 4 == 0) options.highest_address = input_.byte();
    if (input_.byte() % 4 == 0) options.slot_bits = static_cast<std::int32_t>(input_.number(4));
    if (input_.byte() % 4 == 0) options.set_bits = static_cast<std::int32_t>(input_.number(4));
    if (input_.byte() % 4 == 0) options.target_rotation_bits = static_cast<std::int32_t>(input_.number(4));
    if (input_.byte() % 4 == 0) options.max_retries = static_cast<std::int32_t>(input_.number(4));
    if (input_.byte() % 4 == 0) options.gap_factor = static_cast<std::int32_t>(input_.number(4));
    if (input_.byte() % 4 == 0) options.clock_ppm = static_cast<std::int32_t>(input_.number(4));
    check(dpsim_bus_add_master(buses_.pick(input_), input_.byte() % 4 == 0 ? nullptr : &options, place));
  }
  void add_scenario() {
    auto options = sized<dpsim_scenario_options>();
    options.path = "short.yaml";
    options.text = kScenario;
    const char* const setting = words(40).c_str();
    options.settings = &setting;
    options.setting_count = input_.byte() % 2;
    dpsim_master* made[2] = {};
    std::size_t count = 0;
    const char* left_out = nullptr;
    check(dpsim_bus_add_scenario(buses_.pick(input_), or_null(options), made, input_.below(3), or_null(count),
                                 or_null(left_out)));
    if (dpsim_master** const place = masters_.place(); place != nullptr) *place = made[0];
  }
  void switch_master() {
    dpsim_master* const master = masters_.pick(input_);
    switch (input_.below(4)) {
      case 0: return check(dpsim_master_start(master));
      case 1: return check(dpsim_master_stop(master));
      case 2: return check(dpsim_master_set_clear(master, input_.byte() % 2));
      default: return check(dpsim_master_set_baud(master, static_cast<dpsim_baud>(input_.below(12)) - 1));
    }
  }
  void add_slave() {
    auto slave = sized<dpsim_slave>();
    slave.address = address();
    slave.ident = 0x0CC9;
    slave.input_length = slave.output_length = input_.byte();
    slave.flags = static_cast<std::uint32_t>(input_.number(2));
    slave.wd_fact_1 = input_.byte();
    slave.wd_fact_2 = input_.byte();
    slave.user_prm_size = static_cast<std::uint16_t>(input_.number(2) % 300);
    slave.cfg_size = static_cast<std::uint16_t>(input_.number(2) % 300);
    slave.min_slave_interval_us = static_cast<std::int32_t>(input_.number(4));
    slave.c1_response_timeout = static_cast<std::int32_t>(input_.number(4));
    for (std::uint8_t& each : slave.cfg) each = 0x33;
    check(dpsim_master_add_slave(masters_.pick(input_), or_null(slave)));
  }
  void ask_master() {
    const dpsim_master* const master = masters_.pick(input_);
    auto status = sized<dpsim_master_status>();
    check(dpsim_master_get_status(master, or_null(status)));
    auto ring = sized<dpsim_ring_status>();
    check(dpsim_master_get_ring(master, or_null(ring)));
    auto slave = sized<dpsim_slave_status>();
    check(dpsim_master_get_slave(master, address(), or_null(slave)));
    auto connection = sized<dpsim_connection_status>();
    check(dpsim_master_get_connection(master, input_.byte() % 3, or_null(connection)));
    std::uint16_t station = 0;
    check(dpsim_master_station(master, or_null(station)));
  }
  void command_master() {
    dpsim_master* const master = masters_.pick(input_);
    std::uint32_t id = 0;
    const std::vector<std::uint8_t> bytes = input_.bytes(input_.below(16));
    switch (input_.below(6)) {
      case 0: return check(dpsim_master_set_outputs(master, address(), bytes.data(), bytes.size()));
      case 1: return check(dpsim_master_release(master, address()));
      case 2: return check(dpsim_master_activate(master, address()));
      case 3:
        return check(dpsim_master_ask(master, static_cast<dpsim_service>(input_.byte() % 64), address(), or_null(id)));
      case 4:
        return check(dpsim_master_global_control(master, input_.byte(), input_.byte(), input_.byte(), or_null(id)));
      default:
        return check(dpsim_master_set_slave_address(master, address(), input_.byte(),
                                                    static_cast<std::uint16_t>(input_.number(2)), input_.byte() % 2,
                                                    or_null(id)));
    }
  }
  dpsim_telegram any_telegram() {
    auto telegram = sized<dpsim_telegram>();
    telegram.kind = static_cast<dpsim_telegram_kind>(input_.below(7)) - 1;
    telegram.da = address();
    telegram.sa = input_.byte();
    telegram.fc = input_.byte();
    telegram.dsap = static_cast<std::int16_t>(input_.byte() - 1);
    telegram.ssap = static_cast<std::int16_t>(input_.byte() - 1);
    telegram.data_size = static_cast<std::uint16_t>(input_.number(2) % 260);
    return telegram;
  }
  void request() {
    dpsim_master* const master = masters_.pick(input_);
    std::uint32_t id = 0;
    const dpsim_telegram telegram = any_telegram();
    if (input_.byte() % 2 == 0) return check(dpsim_master_request(master, or_null(telegram), or_null(id)));
    auto faults = sized<dpsim_wire_faults>();
    faults.which = input_.byte();
    faults.wrong_parity_at = faults.missing_stop_at = faults.gap_before = input_.byte();
    faults.truncate_after = faults.glitch_at = input_.byte();
    faults.truncate_bits = static_cast<std::int32_t>(input_.number(4));
    faults.gap_millibits = static_cast<std::int32_t>(input_.number(3));
    faults.glitch_start_millibits = static_cast<std::int32_t>(input_.number(2));
    faults.glitch_length_millibits = static_cast<std::int32_t>(input_.number(2));
    const std::vector<std::uint8_t> bytes = input_.bytes(input_.below(64));
    check(dpsim_master_send_raw(master, bytes.data(), bytes.size(), or_null(faults), input_.byte() % 2, or_null(id)));
  }
  void acyclic() {
    dpsim_master* const master = masters_.pick(input_);
    const std::uint32_t peer = input_.byte() % 8;
    const std::uint8_t slot = input_.byte(), index = input_.byte();
    const std::vector<std::uint8_t> bytes(input_.byte(), 0x5A);
    std::uint32_t id = 0;
    switch (input_.below(3)) {
      case 0: return check(dpsim_master_read(master, peer, slot, index, input_.byte(), or_null(id)));
      case 1: return check(dpsim_master_write(master, peer, slot, index, bytes.data(), bytes.size(), or_null(id)));
      default: return check(dpsim_master_transport(master, peer, slot, index, bytes.data(), bytes.size(), or_null(id)));
    }
  }
  void add_connection() {
    auto options = sized<dpsim_connection_options>();
    options.slave = address();
    options.send_timeout = static_cast<std::uint16_t>(input_.number(2));
    options.add_addr_size = input_.byte();
    options.poll_interval_us = static_cast<std::uint32_t>(input_.number(4));
    std::uint32_t made = 0;
    check(dpsim_master_add_connection(masters_.pick(input_), or_null(options), or_null(made)));
  }
  void connection() {
    dpsim_master* const master = masters_.pick(input_);
    const std::uint32_t which = input_.byte() % 4;
    if (input_.byte() % 2 == 0) return check(dpsim_master_connect(master, which));
    check(dpsim_master_abort(master, which, input_.byte() % 20));
  }

  // --- checks
  void make_checker() {
    dpsim_checker** const place = checkers_.place();
    if (place == nullptr) return;
    auto options = sized<dpsim_checker_options>();
    options.kind = kind();
    const dpsim_limit limit{"TIMING_TS", static_cast<std::int64_t>(input_.number(8)), input_.byte() % 2, 0};
    options.limits = &limit;
    options.limit_count = input_.byte() % 2;
    check(dpsim_checker_create(input_.byte() % 2 == 0 ? nullptr : &options, place));
  }
  void feed_checker() {
    dpsim_checker* const checker = checkers_.pick(input_);
    checked_ += input_.number(2);
    const dpsim_change change{checked_, 0, pin(), level(), 0};
    switch (input_.below(5)) {
      case 0: return check(dpsim_checker_sample(checker, checked_));
      case 1: {
        const std::vector<std::uint8_t> bytes = input_.bytes(input_.below(32));
        dpsim_heard heard{};
        heard.start = checked_;
        heard.end = checked_ + 1000;
        heard.bytes = bytes.data();
        heard.count = static_cast<std::uint16_t>(bytes.size());
        heard.baud = static_cast<std::int32_t>(input_.below(12)) - 1;
        return check(dpsim_checker_telegram(checker, or_null(heard)));
      }
      case 2: return input_.byte() % 8 == 0 ? check(dpsim_checker_finish(checker, checked_)) : void();
      case 3: return check(dpsim_checker_pin(checker, change.tick, change.pin, change.level));
      default: {
        std::size_t done = 0;
        return check(dpsim_checker_pins(checker, &change, 1, or_null(done)));
      }
    }
  }
  void ask_checker() {
    dpsim_checker* const checker = checkers_.pick(input_);
    const auto violated = [](void*, const dpsim_violation* each) {
      fuzz::promise(std::strlen(each->name) > 0 && std::strlen(each->text) > 0, "a violation has words");
    };
    check(dpsim_checker_on_violation(checker, input_.byte() % 2 == 0 ? +violated : nullptr, nullptr));
    auto result = sized<dpsim_check_result>();
    check(dpsim_checker_get_result(checker, input_.byte() % 64, or_null(result)));
    std::uint64_t pins = 0;
    check(dpsim_checker_wants(checker, or_null(pins)));
  }

  // --- without an object
  void telegram() {
    dpsim_telegram telegram = any_telegram();
    std::uint8_t encoded[DPSIM_MAX_TELEGRAM] = {};
    std::size_t count = 0;
    const dpsim_status status = dpsim_telegram_encode(&telegram, encoded, input_.byte(), &count);
    check(status);
    if (status != DPSIM_OK) count = 0;
    dpsim_decode_error error = 0;
    std::size_t used = 0;
    check(dpsim_telegram_decode(encoded, count, &telegram, or_null(error), or_null(used)));
    fuzz::promise(used <= count, "no byte is made up");
    const char* text = nullptr;
    check(dpsim_telegram_explain(encoded, count, static_cast<dpsim_explain_style>(input_.below(5)) - 1,
                                 static_cast<std::int32_t>(input_.below(4)) - 2, or_null(text)));
  }
  void tables() {
    const char* const of = kind();
    const std::size_t number = input_.byte();
    auto pin_info = sized<dpsim_pin_info>();
    check(dpsim_pin_get(of, number, or_null(pin_info)));
    auto parameter = sized<dpsim_parameter_info>();
    check(dpsim_parameter_get(of, number, or_null(parameter)));
    auto rule = sized<dpsim_rule_info>();
    check(dpsim_rule_get(of, number, or_null(rule)));
    auto reason = sized<dpsim_reason_info>();
    check(dpsim_reason_get(of, number, or_null(reason)));
    const std::string& name = words(20);
    std::uint16_t found = 0;
    check(dpsim_pin_find(of, name.c_str(), or_null(found)));
    std::size_t rule_number = 0;
    check(dpsim_rule_find(of, name.c_str(), or_null(rule_number)));
    fuzz::promise(dpsim_status_name(input_.byte() - 128) != nullptr, "a status has a name");
    fuzz::promise(dpsim_decode_error_text(input_.byte() - 1) != nullptr, "an error has words");
    dpsim_chip_event event{};
    event.reason = static_cast<std::uint16_t>(input_.number(2));
    event.a = static_cast<std::uint16_t>(input_.number(2));
    char text[32];
    check(dpsim_chip_event_text(of, &event, text, 1 + input_.below(sizeof text)));
  }
  void time() {
    const std::uint64_t value = input_.number(8);
    const auto unit = static_cast<dpsim_unit>(input_.below(7));
    const std::uint64_t time = dpsim_ticks_to(value, unit);
    fuzz::promise(unit > DPSIM_PS || time == UINT64_MAX || dpsim_ticks_from(time, unit) == value,
                  "fine units keep ticks");
  }

  // --- GSD files
  void make_gsd() {
    dpsim_gsd** const place = gsds_.place();
    if (place == nullptr) return;
    const std::string& text = words(255);
    check(dpsim_gsd_parse(text.data(), text.size(), "a.gsd", place));
  }
  void ask_gsd() {
    dpsim_gsd* const gsd = gsds_.pick(input_);
    const char* text = nullptr;
    check(dpsim_gsd_warnings(gsd, or_null(text)));
    auto info = sized<dpsim_gsd_info>();
    check(dpsim_gsd_get_info(gsd, or_null(info)));
    check(dpsim_gsd_module(gsd, input_.byte() % 4, or_null(text)));
    auto slave = sized<dpsim_slave>();
    check(dpsim_gsd_slave(gsd, nullptr, 0, input_.byte(), or_null(slave)));
    check(dpsim_gsd_report(gsd, nullptr, 0, input_.byte() % 2, or_null(text)));
  }

  // --- runs
  void make_run() {
    dpsim_run** const place = runs_.place();
    if (place == nullptr || run_count_++ == 2) return;
    auto options = sized<dpsim_run_options>();
    options.engine = static_cast<dpsim_engine>(input_.below(3));
    options.checks = static_cast<dpsim_checks_mode>(input_.below(5));
    options.path = "short.yaml";
    options.text = kScenario;
    const char* const setting = words(40).c_str();
    options.settings = &setting;
    options.setting_count = input_.byte() % 2;
    check(dpsim_run_create(or_null(options), place));
  }
  void execute_run() {
    dpsim_run* const run = runs_.pick(input_);
    check(dpsim_run_keep(run, input_.byte() % 5));
    int polls = 0;
    const auto poll = [](void* user, std::uint64_t) { return ++*static_cast<int*>(user) < 10 ? 1 : 0; };
    check(dpsim_run_execute(run, +poll, &polls));
  }
  void ask_run() {
    dpsim_run* const run = runs_.pick(input_);
    const char* text = nullptr;
    check(dpsim_run_result(run, or_null(text)));
    check(dpsim_run_report(run, or_null(text)));
    check(dpsim_run_slave(run, input_.byte() % 3, or_null(text)));
    auto summary = sized<dpsim_run_summary>();
    check(dpsim_run_get_summary(run, or_null(summary)));
    auto info = sized<dpsim_run_info>();
    check(dpsim_run_get_info(run, or_null(info)));
    const dpsim_heard* heard = nullptr;
    std::size_t count = 0;
    check(dpsim_run_telegrams(run, or_null(heard), or_null(count)));
    std::vector<dpsim_change> changes(8);
    check(dpsim_run_read_changes(run, changes.data(), changes.size(), or_null(count)));
  }

  fuzz::Input& input_;
  Objects<dpsim_chip> chips_;
  Objects<dpsim_bus> buses_;
  Objects<dpsim_master> masters_;
  Objects<dpsim_checker> checkers_;
  Objects<dpsim_gsd> gsds_;
  Objects<dpsim_run> runs_;
  dpsim_parameter parameter_{};
  std::deque<std::string> words_;  ///< pointers into them stay right
  std::uint64_t left_ = kMostTicks, checked_ = 0, told_ = 0;
  int run_count_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  Caller(input).run();
  return 0;
}

}  // namespace dsdpv1
