// Segment, masters and monitor through the C API.
#include <algorithm>
#include <string>

#include "tests/capi/station.hpp"

namespace dsdpv1::capi_test {
namespace {

struct Event {
  dpsim_event_type type;
  uint32_t id;
  uint16_t station, address;
  int to, outcome;
  uint32_t codes;
  std::vector<uint8_t> data;
  std::string text;
};

struct Events {
  std::vector<Event> all;
  static void note(void* user, const dpsim_event* event) {
    static_cast<Events*>(user)->all.push_back(
        {event->type, event->id, event->station, event->address, event->to, event->outcome, event->codes,
         std::vector<uint8_t>(event->data, event->data + event->data_size), event->text});
  }
  std::vector<Event> of(dpsim_event_type type) const {
    std::vector<Event> found;
    std::copy_if(all.begin(), all.end(), std::back_inserter(found),
                 [&](const Event& each) { return each.type == type; });
    return found;
  }
};

TEST(CapiBus, AMasterBringsAChipToDataExchange) {
  Line line;
  Events events;
  ok(dpsim_bus_on_event(line.bus.get(), Events::note, &events));
  const uint8_t outputs[kBytes] = {1, 2, 3, 4};
  ok(dpsim_master_set_outputs(line.master, kAddress, outputs, kBytes));
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));

  EXPECT_EQ(line.state(), DPSIM_SLAVE_DATA_EXCHANGE);
  auto status = sized<dpsim_chip_status>();
  ok(dpsim_chip_get_status(line.chip, &status));
  EXPECT_EQ(status.dp_state, DPSIM_DP_DATA_EXCH);
  EXPECT_EQ(status.baud, 0);
  EXPECT_EQ(status.address, kAddress);
  EXPECT_EQ(status.master, 2);
  EXPECT_GT(status.data_exchanges, 10U);
  uint8_t cell = 0;
  ok(dpsim_chip_peek(line.chip, dsdpv1::regs::kOutput + 1, &cell));
  EXPECT_EQ(cell, outputs[0]);

  auto statistics = sized<dpsim_bus_statistics>();
  ok(dpsim_bus_get_statistics(line.bus.get(), &statistics));
  EXPECT_EQ(statistics.wrong, 0U);
  EXPECT_GT(statistics.telegrams, 100U);
  auto tsdr = sized<dpsim_tsdr_statistics>();
  ok(dpsim_bus_get_tsdr(line.bus.get(), kAddress, &tsdr));
  EXPECT_GE(tsdr.tsdr_min, 11'000U);
  EXPECT_LE(tsdr.tsdr_max, 12'000U);

  std::vector<int> states;
  for (const Event& each : events.of(DPSIM_EVENT_SLAVE_STATE)) states.push_back(each.to);
  EXPECT_EQ(states, (std::vector<int>{DPSIM_SLAVE_DIAGNOSE, DPSIM_SLAVE_SET_PRM, DPSIM_SLAVE_CHK_CFG,
                                      DPSIM_SLAVE_AWAIT_READY, DPSIM_SLAVE_DATA_EXCHANGE}));
  auto master = sized<dpsim_master_status>();
  ok(dpsim_master_get_status(line.master, &master));
  EXPECT_EQ(master.running, 1);
  EXPECT_GT(master.cycles, 10U);
}

std::vector<dpsim_change> of_pins(const std::vector<dpsim_change>& changes, std::vector<uint16_t> pins, uint64_t from) {
  std::vector<dpsim_change> found;
  for (dpsim_change each : changes) {
    if (each.tick < from || std::find(pins.begin(), pins.end(), each.pin) == pins.end()) continue;
    each.station = 0;
    found.push_back(each);
  }
  return found;
}

const std::vector<uint16_t> kUart = {DPSIM_DSDPV1_PBRXD, DPSIM_DSDPV1_PBTXD, DPSIM_DSDPV1_PBRTS};

/// All changes of the chip's pins, watched from `from` on.
std::vector<dpsim_change> watched_from(uint64_t from) {
  Line line;
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), from));
  ok(dpsim_chip_watch(line.chip, DPSIM_ALL_PINS, nullptr, nullptr));
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));
  return drain(dpsim_chip_read_changes, line.chip);
}

TEST(CapiBus, WhoBeginsToWatchInsideOfATelegramSeesTheRestOfIt) {
  const auto whole = watched_from(Line::kBegin);
  ASSERT_GT(of_pins(whole, {DPSIM_DSDPV1_PBTXD}, 0).size(), 100U);
  for (uint64_t from = 3 * kMs; from < 3 * kMs + 20 * kUs; from += 777)
    ASSERT_EQ(of_pins(watched_from(from), kUart, from + 1), of_pins(whole, kUart, from + 1)) << from;
}

TEST(CapiBus, TheLineHasItsLevelWhetherItIsWatchedOrNot) {
  Line watched, quiet;
  ok(dpsim_bus_watch(watched.bus.get(), DPSIM_WATCH_LINE, nullptr, nullptr));
  for (Line* each : {&watched, &quiet}) each->begin();
  size_t low = 0;
  for (uint64_t now = 3 * kMs; now < 3 * kMs + 100 * kUs; now += 333) {
    dpsim_level expected = DPSIM_X, level = DPSIM_X;
    for (Line* each : {&watched, &quiet}) ok(dpsim_bus_run(each->bus.get(), now));
    ok(dpsim_bus_line(watched.bus.get(), &expected));
    ok(dpsim_bus_line(quiet.bus.get(), &level));
    ASSERT_EQ(level, expected) << now;
    low += level == 0 ? 1 : 0;
  }
  EXPECT_GT(low, 100U);
  EXPECT_GT(drain(dpsim_bus_read_changes, watched.bus.get()).size(), 1000U);
}

/// A chip outside the bus: the caller copies its pins to the line and the line to its pins.
class Outside {
 public:
  Outside() {
    ok(dpsim_bus_add_station(bus_.get(), "dut", &station_));
    const dpsim_slave slave = slave_of_the_chip();
    ok(dpsim_master_add_slave(master_, &slave));
    ok(dpsim_bus_watch(bus_.get(), DPSIM_WATCH_LINE, line_changed, this));
    ok(dpsim_chip_watch(chip_.get(), DPSIM_PIN(DPSIM_DSDPV1_PBTXD) | DPSIM_PIN(DPSIM_DSDPV1_PBRTS), nullptr, nullptr));
    start_up(chip_.get());
    ok(dpsim_chip_advance(chip_.get(), Line::kBegin));
    ok(dpsim_bus_run(bus_.get(), Line::kBegin));
    ok(dpsim_master_start(master_));
  }
  /// The changes of PBTXD and PBRTS up to `end`.
  std::vector<dpsim_change> run(uint64_t end) {
    std::vector<dpsim_change> sent;
    for (now_ = Line::kBegin; now_ <= end; now_ = next()) {
      ok(dpsim_chip_advance(chip_.get(), now_));
      ok(dpsim_bus_run(bus_.get(), now_));
      for (const dpsim_change& each : drain(dpsim_chip_read_changes, chip_.get())) {
        (each.pin == DPSIM_DSDPV1_PBTXD ? txd_ : rts_) = each.level;
        ok(dpsim_bus_drive(bus_.get(), each.tick, station_, rts_, txd_));
        sent.push_back(each);
      }
      hear();
    }
    return sent;
  }

 private:
  static void line_changed(void* user, const dpsim_change* change) {
    static_cast<Outside*>(user)->heard_.push_back(*change);
  }
  void hear() {
    for (const dpsim_change& each : heard_) ok(dpsim_chip_set(chip_.get(), each.tick, DPSIM_DSDPV1_PBRXD, each.level));
    heard_.clear();
  }
  uint64_t next() {
    uint64_t chip = 0, bus = 0;
    ok(dpsim_chip_next(chip_.get(), &chip));
    ok(dpsim_bus_next(bus_.get(), &bus));
    return std::min(chip, bus);
  }

  Owned<dpsim_bus> bus_ = make_bus();
  Owned<dpsim_chip> chip_ = make_chip();
  dpsim_master* master_ = add_master(bus_.get());
  uint16_t station_ = 0;
  std::vector<dpsim_change> heard_;
  int txd_ = 1, rts_ = 0;
  uint64_t now_ = 0;
};

TEST(CapiBus, AStationOutsideAnswersAsAChipOnTheBusDoes) {
  constexpr uint64_t kEnd = 3 * kMs;
  const std::vector<uint16_t> out = {DPSIM_DSDPV1_PBTXD, DPSIM_DSDPV1_PBRTS};
  std::vector<dpsim_change> inside = of_pins(watched_from(Line::kBegin), out, 0);
  inside.erase(std::find_if(inside.begin(), inside.end(), [](const dpsim_change& each) { return each.tick > kEnd; }),
               inside.end());
  ASSERT_GT(inside.size(), 100U);
  EXPECT_EQ(Outside().run(kEnd), inside);
}

TEST(CapiBus, TheNextTickIsNotBeforeThePresentOne) {
  Line line;
  start_up(line.chip);
  ok(dpsim_bus_run(line.bus.get(), Line::kBegin));
  uint64_t next = 0;
  ok(dpsim_master_start(line.master));  // planned for the last time at which the master had a turn: never
  ok(dpsim_bus_next(line.bus.get(), &next));
  EXPECT_EQ(next, Line::kBegin);
}

TEST(CapiBus, DriversOfMastersAreToldWithTheirPins) {
  Line line;
  uint16_t station = 0;
  ok(dpsim_master_station(line.master, &station));
  EXPECT_EQ(station, 1);
  ok(dpsim_bus_watch(line.bus.get(), DPSIM_WATCH_DRIVERS, nullptr, nullptr));
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));
  const auto changes = drain(dpsim_bus_read_changes, line.bus.get());
  ASSERT_GT(changes.size(), 1000U);
  int enabled = 0;
  for (const dpsim_change& each : changes) {
    ASSERT_EQ(each.station, station);
    if (each.pin == DPSIM_STATION_RTS) {
      ASSERT_NE(enabled, each.level);
      enabled = each.level;
    } else {
      ASSERT_EQ(each.pin, DPSIM_STATION_TXD);
      ASSERT_EQ(enabled, 1) << each.tick;
    }
  }
}

TEST(CapiBus, RequestsOutOfTheCycleComeBackUnderTheirNumbers) {
  Line line;
  Events events;
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));
  ok(dpsim_bus_on_event(line.bus.get(), Events::note, &events));
  uint32_t cfg = 0, control = 0, read = 0, absent = 0;
  ok(dpsim_master_ask(line.master, DPSIM_SERVICE_GET_CFG, kAddress, &cfg));
  ok(dpsim_master_global_control(line.master, DPSIM_CONTROL_SYNC, 0, DPSIM_BROADCAST, &control));
  ok(dpsim_master_ask(line.master, DPSIM_SERVICE_FDL_STATUS, 77, &absent));
  ok(dpsim_master_read(line.master, kAddress, 1, 2, 8, &read));
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning + 5 * kMs));
  const auto done = events.of(DPSIM_EVENT_REQUEST_DONE);
  ASSERT_EQ(done.size(), 3U);
  EXPECT_EQ(done[0].id, cfg);
  EXPECT_EQ(done[0].outcome, DPSIM_OUTCOME_ANSWERED);
  auto answer = sized<dpsim_telegram>();
  dpsim_decode_error error = DPSIM_DECODE_FCS;
  ok(dpsim_telegram_decode(done[0].data.data(), done[0].data.size(), &answer, &error, nullptr));
  EXPECT_EQ(bus::Bytes(answer.data, answer.data + answer.data_size), speed::identifiers(kBytes));
  EXPECT_EQ(done[1].id, control);
  EXPECT_EQ(done[1].outcome, DPSIM_OUTCOME_SENT);
  EXPECT_EQ(done[2].id, absent);
  EXPECT_EQ(done[2].outcome, DPSIM_OUTCOME_NO_ANSWER);
  const auto acyclic = events.of(DPSIM_EVENT_ACYCLIC_DONE);
  ASSERT_EQ(acyclic.size(), 1U);
  EXPECT_EQ(acyclic[0].id, read);
  EXPECT_EQ(acyclic[0].outcome, DPSIM_ACYCLIC_REFUSED) << acyclic[0].text;  // not parameterised for DPV1
  EXPECT_EQ(acyclic[0].codes, 3U);                                          // RS
}

TEST(CapiBus, ARequestCarriesTheMastersOwnAddress) {
  Line line;
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));
  std::vector<uint8_t> sources;
  ok(dpsim_bus_on_telegram(
      line.bus.get(),
      [](void* user, const dpsim_heard* heard) {
        if (heard->bytes[0] == 0x10 && heard->bytes[1] == 77)
          static_cast<std::vector<uint8_t>*>(user)->push_back(heard->bytes[2]);
      },
      &sources));
  auto telegram = sized<dpsim_telegram>();
  telegram.kind = DPSIM_SD1;
  telegram.da = 77;
  telegram.sa = 99;  // ignored
  telegram.fc = 0x49;
  telegram.dsap = telegram.ssap = DPSIM_NO_SAP;
  ok(dpsim_master_request(line.master, &telegram, nullptr));
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning + kMs));
  ASSERT_FALSE(sources.empty());
  EXPECT_EQ(sources.front(), 2);
}

TEST(CapiBus, BrokenBytesAreFlagged) {
  Line line;
  Events events;
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));
  ok(dpsim_bus_on_event(line.bus.get(), Events::note, &events));
  const uint8_t status[] = {0x10, kAddress, 2, 0x49, 0x50, 0x16};
  auto faults = sized<dpsim_wire_faults>();
  faults.which = DPSIM_FAULT_PARITY;
  faults.wrong_parity_at = 2;
  ok(dpsim_master_send_raw(line.master, status, sizeof status, &faults, 1, nullptr));
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning + kMs));
  const auto flags = events.of(DPSIM_EVENT_FLAG);
  const auto parity =
      std::find_if(flags.begin(), flags.end(), [](const Event& each) { return each.id == DPSIM_FLAG_CHARACTER_ERROR; });
  ASSERT_NE(parity, flags.end());
  EXPECT_EQ(parity->station, DPSIM_LINE);
  EXPECT_STREQ(dpsim_flag_name(DPSIM_FLAG_CHARACTER_ERROR), "character error");
}

TEST(CapiBus, AChipThatIsUnpluggedIsMissed) {
  Line line;
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));
  ok(dpsim_bus_plug(line.bus.get(), Line::kRunning, 0, 0));
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning + 5 * kMs));
  EXPECT_EQ(line.state(), DPSIM_SLAVE_OFFLINE);
  ok(dpsim_bus_plug(line.bus.get(), Line::kRunning + 5 * kMs, 0, 1));
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning + 12 * kMs));
  EXPECT_EQ(line.state(), DPSIM_SLAVE_DATA_EXCHANGE);
}

TEST(CapiBus, AMasterReleasesItsSlaveChangesItsRateAndFallsSilent) {
  constexpr dpsim_baud k1M5 = 3;
  Line line;
  line.begin();
  uint64_t now = Line::kRunning;
  const auto state_after = [&](dpsim_status command) {
    ok(command);
    ok(dpsim_bus_run(line.bus.get(), now += 5 * kMs));
    return line.state();
  };
  ok(dpsim_bus_run(line.bus.get(), now));
  auto status = sized<dpsim_master_status>();
  EXPECT_EQ(state_after(dpsim_master_set_clear(line.master, 1)), DPSIM_SLAVE_DATA_EXCHANGE);
  ok(dpsim_master_get_status(line.master, &status));
  EXPECT_EQ(status.clear, 1);
  EXPECT_EQ(state_after(dpsim_master_release(line.master, kAddress)), DPSIM_SLAVE_RELEASED);
  EXPECT_EQ(state_after(dpsim_master_activate(line.master, kAddress)), DPSIM_SLAVE_DATA_EXCHANGE);
  EXPECT_EQ(state_after(dpsim_master_set_baud(line.master, k1M5)), DPSIM_SLAVE_OFFLINE);
  ok(dpsim_master_stop(line.master));
  auto before = sized<dpsim_bus_statistics>(), after = sized<dpsim_bus_statistics>();
  ok(dpsim_bus_get_statistics(line.bus.get(), &before));
  ok(dpsim_bus_run(line.bus.get(), now += 5 * kMs));
  ok(dpsim_bus_get_statistics(line.bus.get(), &after));
  EXPECT_GT(before.telegrams, 0U);
  EXPECT_EQ(after.telegrams + after.wrong, before.telegrams + before.wrong);
}

TEST(CapiBus, AForcedLineIsLow) {
  const auto bus = make_bus();
  dpsim_level level = 0;
  ok(dpsim_bus_line(bus.get(), &level));
  EXPECT_EQ(level, 1);
  ok(dpsim_bus_force(bus.get(), 10, 0));
  ok(dpsim_bus_line(bus.get(), &level));
  EXPECT_EQ(level, 0);
  ok(dpsim_bus_force(bus.get(), 20, DPSIM_Z));
  ok(dpsim_bus_line(bus.get(), &level));
  EXPECT_EQ(level, 1);
}

TEST(CapiBus, TwoMastersShareTheTokenAndAClass2Connects) {
  Line line(true);
  Events events;
  ok(dpsim_bus_on_event(line.bus.get(), Events::note, &events));
  dpsim_master* second = add_master(line.bus.get(), 3, 2);
  auto options = sized<dpsim_connection_options>();
  options.slave = kAddress;
  uint32_t connection = 99;
  ok(dpsim_master_add_connection(second, &options, &connection));
  EXPECT_EQ(connection, 0U);
  EXPECT_EQ(dpsim_master_read(second, connection, 0, 1, 8, nullptr), DPSIM_ERR_STATE);
  EXPECT_STREQ(dpsim_error_message(), "dpsim_master_read: connection 0 is closed");
  line.begin();
  ok(dpsim_master_start(second));
  ok(dpsim_bus_run(line.bus.get(), 30 * kMs));
  for (dpsim_master* each : {line.master, second}) {
    auto ring = sized<dpsim_ring_status>();
    ok(dpsim_master_get_ring(each, &ring));
    EXPECT_GT(ring.rotations, 10U);
    EXPECT_EQ(ring.stations[0], 1U << 2 | 1U << 3);
  }
  ok(dpsim_master_connect(second, connection));
  ok(dpsim_bus_run(line.bus.get(), 40 * kMs));
  const auto ends = events.of(DPSIM_EVENT_CONNECTION_END);
  ASSERT_EQ(ends.size(), 1U);  // the user has not switched DPV1 on
  EXPECT_EQ(ends[0].outcome, DPSIM_END_REFUSED) << ends[0].text;
  EXPECT_EQ(ends[0].address, kAddress);
  auto status = sized<dpsim_connection_status>();
  ok(dpsim_master_get_connection(second, connection, &status));
  EXPECT_EQ(status.state, DPSIM_CONNECTION_CLOSED);
  EXPECT_FALSE(events.of(DPSIM_EVENT_RING_STATE).empty());
}

struct InEvent {
  dpsim_bus* bus = nullptr;
  dpsim_master* master = nullptr;
  dpsim_status run = DPSIM_OK, outputs = DPSIM_ERR_INTERNAL;
};

TEST(CapiBus, ACallbackMayCommandMastersButNotRunTheBus) {
  Line line;
  InEvent seen{line.bus.get(), line.master};
  ok(dpsim_bus_on_event(
      line.bus.get(),
      [](void* user, const dpsim_event* event) {
        auto& own = *static_cast<InEvent*>(user);
        if (event->type != DPSIM_EVENT_SLAVE_STATE || event->to != DPSIM_SLAVE_DATA_EXCHANGE) return;
        const uint8_t outputs[kBytes] = {9, 9, 9, 9};
        own.run = dpsim_bus_run(own.bus, event->tick + 1);
        own.outputs = dpsim_master_set_outputs(own.master, kAddress, outputs, kBytes);
      },
      &seen));
  line.begin();
  ok(dpsim_bus_run(line.bus.get(), Line::kRunning));
  EXPECT_EQ(seen.run, DPSIM_ERR_STATE);
  EXPECT_EQ(seen.outputs, DPSIM_OK);
  uint8_t cell = 0;
  ok(dpsim_chip_peek(line.chip, dsdpv1::regs::kOutput + 1, &cell));
  EXPECT_EQ(cell, 9);
}

}  // namespace
}  // namespace dsdpv1::capi_test
