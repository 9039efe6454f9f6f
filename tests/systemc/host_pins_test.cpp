// One sequence of transactions for the TLM module and, through HostPins, for the pin module: answers, times and pins
// must be the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <algorithm>
#include <memory>

#include "model/systemc/host_pins.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::AccessTimingExtension;
using dsdpv1::systemc::current_tick;

namespace {

using Bytes = std::vector<std::uint8_t>;

struct Transaction {
  tlm::tlm_command command;
  sc_dt::uint64 address;
  Bytes data;
  AccessTiming timing = {};
  Bytes enables = {};  ///< empty: all
  bool ahead = false;
};

constexpr auto kRead = tlm::TLM_READ_COMMAND;
constexpr auto kWrite = tlm::TLM_WRITE_COMMAND;

AccessTiming sampled(Tick after) {
  AccessTiming timing;
  timing.rd_sample = after;
  return timing;
}

AccessTiming write_low(Tick ticks) {
  AccessTiming timing;
  timing.wr_low = timing.data_setup = ticks;
  return timing;
}

/// Consecutive transactions; the first by an initiator that does not own the DPRAM, the others by the owner.
const std::vector<Transaction>& transactions() {
  static const std::vector<Transaction> all = {
      {kRead, 0x004, {0}},
      {kWrite, 0x130, {4, 0x11, 0x22, 0x33}},
      {kRead, 0x130, {0, 0, 0, 0}},
      {kRead, 0x131, {9, 9, 9, 9}, {}, {0xFF, 0x00}},    // every other byte
      {kRead, 0x131, {9}, sampled(dsdpv1::kTw)},         // D is valid
      {kRead, 0x131, {9, 9}, sampled(dsdpv1::kTw - 1)},  // D is not valid yet: the burst ends at its first byte
      {kRead, 0x800, {9}},                               // refused, as the next four
      {kWrite, 0x7FF, {1, 2}},                           //
      {kRead, 0x130, {}},                                //
      {kRead, 0x130, {9}, {}, {0x01}},                   //
      {tlm::TLM_IGNORE_COMMAND, 0x130, {9}},             //
      {kWrite, 0x134, {0xA5}},
      {kRead, 0x134, {0}},
      {kWrite, 0x134, {1, 2}, write_low(dsdpv1::kTs - 1)},  // violates Ts
  };
  return all;
}

struct Outcome {
  tlm::tlm_response_status response;
  Tick end, delay;
  Bytes data;
};

/// A user CPU without the handshake, which the bench does.
struct Initiator : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Initiator> socket{"socket"};
  explicit Initiator(const sc_core::sc_module_name& name) : sc_module(name) {}

  Outcome transport(Transaction transaction) {
    tlm::tlm_generic_payload payload;
    auto* timing = new AccessTimingExtension;  // owned by the payload, even when this process is killed
    timing->timing = transaction.timing;
    timing->ahead = transaction.ahead;
    payload.set_extension(timing);
    payload.set_command(transaction.command);
    payload.set_address(transaction.address);
    payload.set_data_ptr(transaction.data.data());
    payload.set_data_length(static_cast<unsigned>(transaction.data.size()));
    payload.set_streaming_width(static_cast<unsigned>(transaction.data.size()));
    if (!transaction.enables.empty()) payload.set_byte_enable_ptr(transaction.enables.data());
    payload.set_byte_enable_length(static_cast<unsigned>(transaction.enables.size()));
    sc_core::sc_time delay = dsdpv1::systemc::to_time(100);
    socket->b_transport(payload, delay);
    return {payload.get_response_status(), current_tick(), dsdpv1::systemc::to_tick(delay), transaction.data};
  }
};

/// One of the two chips with its user CPU.
struct Side {
  sc_core::sc_signal<bool> reset, r_req, r_sta;
  std::unique_ptr<Initiator> cpu;
  Changes changes;
  std::vector<Outcome> outcomes;

  explicit Side(const char* name) : cpu(std::make_unique<Initiator>(name)) {
    thread([this] { run(); });
  }

  void run() {
    wait_until(kUs);
    reset.write(true);
    wait_until(100 * kUs);
    for (const Transaction& transaction : transactions()) {
      outcomes.push_back(cpu->transport(transaction));
      if (outcomes.size() == 1) take();
      sc_core::wait(dsdpv1::systemc::to_time(100 * kNs));
    }
  }

  void take() {
    wait_until(102 * kUs);
    r_req.write(true);
    wait_until(105 * kUs);
    r_sta.write(true);
    wait_until(110 * kUs);
  }
};

template <class Options>
Options quiet() {
  Options options;
  options.report_violations = false;
  return options;
}

struct World {
  Side tlm{"tlm_cpu"}, pins{"pin_cpu"};
  dsdpv1::systemc::TlmModule tlm_chip{"tlm_chip", quiet<dsdpv1::systemc::TlmOptions>()};
  PinBench pin_bench{"pin_chip", quiet<dsdpv1::systemc::PinOptions>()};
  dsdpv1::systemc::HostPins host{"host"};
  std::vector<Outcome> after_kill;
  Outcome ahead{};

  World() {
    tlm.cpu->socket.bind(tlm_chip.host_socket);
    tlm_chip.RESET(tlm.reset), tlm_chip.R_REQ(tlm.r_req), tlm_chip.R_STA(tlm.r_sta);
    tlm_chip.on_pin = [this](Tick at, Pin pin, Level level) { tlm.changes.push_back({at, pin, level}); };
    pins.cpu->socket.bind(host.socket);
    host.A(pin_bench.a), host.D(pin_bench.d), host.CSR(pin_bench.csr), host.RD(pin_bench.rd), host.WR(pin_bench.wr);
    thread([this] { follow(); });
    thread([this] { kill(); });
  }

  /// The pin module's signals are those of the bench.
  void follow() {
    for (;;) {
      pin_bench.reset.write(pins.reset.read());
      pin_bench.r_req.write(pins.r_req.read());
      pin_bench.r_sta.write(pins.r_sta.read());
      sc_core::wait(pins.reset.default_event() | pins.r_req.default_event() | pins.r_sta.default_event());
    }
  }

  /// At the end: an initiator ends in the middle of its access, and another one starts immediately.
  void kill() {
    wait_until(150 * kUs);
    pins.changes = pin_bench.changes;
    auto access = sc_core::sc_spawn([this] { pins.cpu->transport({kWrite, 0x135, {0x5A}}); });
    wait_until(150 * kUs + 500);
    access.kill();
    after_kill.push_back(pins.cpu->transport({kRead, 0x135, {0}}));
    ahead = pins.cpu->transport({kRead, 0x135, {7}, {}, {}, true});
  }
};

std::unique_ptr<World> world;

/// The changes of the accesses and of the chip's D; those at one tick in any order.
Changes of_accesses(const Changes& all) {
  Changes some;
  std::copy_if(
      all.begin(), all.end(), std::back_inserter(some),
      [](const Change& change) {
        return (dsdpv1::mask(change.pin) & (dsdpv1::systemc::kHostPins | dsdpv1::mask(Pin::kDOut))) != 0 &&
               change.at > 0 && change.at < 150 * kUs;
      });
  std::stable_sort(some.begin(), some.end(),
                   [](const Change& a, const Change& b) { return a.at != b.at ? a.at < b.at : a.pin < b.pin; });
  return some;
}

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>();
  sc_core::sc_start(200, sc_core::SC_US);
}

namespace {

TEST(HostPins, AnswerAsTheSocketOfTheTlmModuleAtTheSameTimes) {
  ASSERT_EQ(world->tlm.outcomes.size(), transactions().size());
  ASSERT_EQ(world->pins.outcomes.size(), transactions().size());
  for (std::size_t i = 0; i < transactions().size(); ++i) {
    EXPECT_EQ(world->pins.outcomes[i].response, world->tlm.outcomes[i].response) << i;
    EXPECT_EQ(world->pins.outcomes[i].end, world->tlm.outcomes[i].end) << i;
    EXPECT_EQ(world->pins.outcomes[i].delay, world->tlm.outcomes[i].delay) << i;
    EXPECT_EQ(world->pins.outcomes[i].data, world->tlm.outcomes[i].data) << i;
  }
}

TEST(HostPins, TheProgramHasAnswersOfEveryKind) {
  const std::vector<Outcome>& outcomes = world->pins.outcomes;
  EXPECT_EQ(outcomes[2].data, (Bytes{4, 0x11, 0x22, 0x33}));
  EXPECT_EQ(outcomes[3].data, (Bytes{0x11, 9, 0x33, 9}));
  EXPECT_EQ(outcomes[4].data, Bytes{0x11});
  EXPECT_EQ(outcomes[5].response, tlm::TLM_GENERIC_ERROR_RESPONSE);
  EXPECT_EQ(outcomes[6].response, tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(outcomes[12].data, Bytes{0xA5});
  EXPECT_EQ(outcomes[13].response, tlm::TLM_GENERIC_ERROR_RESPONSE);
}

TEST(HostPins, MoveThePinsAsTheTlmModuleDoes) {
  const Changes tlm = of_accesses(world->tlm.changes);
  EXPECT_GT(tlm.size(), 80U);
  EXPECT_EQ(of_accesses(world->pins.changes), tlm);
}

TEST(HostPins, AnAccessGoesOnWhenItsInitiatorIsKilledAndTheNextOneFollows) {
  ASSERT_EQ(world->after_kill.size(), 1U);
  EXPECT_EQ(world->after_kill[0].response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(world->after_kill[0].data, Bytes{0x5A});
}

TEST(HostPins, NothingIsCarriedOutAheadOfTime) {
  EXPECT_EQ(world->ahead.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
  EXPECT_EQ(world->ahead.data, Bytes{7});
  EXPECT_EQ(world->ahead.delay, 100);
}

}  // namespace
}  // namespace dsdpv1
