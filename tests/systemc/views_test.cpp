// One stimulus for the bare core, the pin module (CLK unbound, bound, another phase) and the TLM module, all in one
// simulation: every pin must change at the same tick of the chip.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <algorithm>
#include <memory>

#include "tests/systemc/bench.hpp"

using dsdpv1::Config;
using dsdpv1::Engine;
using dsdpv1::Level;
using dsdpv1::Pin;
using dsdpv1::Tick;
using dsdpv1::systemc::AccessTiming;
using dsdpv1::systemc::BusCharacter;
using dsdpv1::systemc::HostAccess;
using dsdpv1::systemc::to_time;

namespace {

constexpr Tick kResetAt = 12'007, kRequestAt = 480 * 3000, kOwnAt = kRequestAt + 12'031, kEnd = 170 * kUs;
constexpr Tick kFirstAccess = kOwnAt + 1201, kTelegramAt = 150 * kUs + 5, kBit = 1000;
constexpr Tick kPhase = 100;

struct Transaction {
  bool write;
  std::uint16_t address;
  std::uint8_t value;
};
const std::vector<Transaction> kTransactions = {{true, 0x021, 0x5A}, {false, 0x021, 0}, {false, 0x000, 0},
                                                {false, 0x001, 0},   {false, 0x004, 0}, {true, 0x7FF, 0xC3},
                                                {false, 0x7FF, 0}};
const std::vector<std::uint8_t> kTelegram = {0x10, 0x09, 0x02, 0x49, 0x54, 0x16};

HostAccess access_of(const Transaction& t) {
  return t.write ? HostAccess::write(t.address, t.value, AccessTiming{}) : HostAccess::read(t.address, AccessTiming{});
}

Tick add_accesses(Changes& stimulus) {
  Tick start = kFirstAccess;
  for (const Transaction& t : kTransactions) {
    const HostAccess access = access_of(t);
    for (const auto& edge : access)
      if (edge.pin != Pin::kDOut) stimulus.push_back({start + edge.at, edge.pin, edge.level});
    start += access.duration();
  }
  return start;
}

void add_telegram(Changes& stimulus) {
  Tick start = kTelegramAt;
  bool level = true;
  for (const std::uint8_t byte : kTelegram) {
    const std::uint16_t frame = dsdpv1::systemc::frame_of(byte, true, true);
    for (int bit = 0; bit < 11; ++bit, start += kBit) {
      const bool next = (frame >> bit & 1) != 0;
      if (next != level) stimulus.push_back({start, Pin::kPbrxd, next});
      level = next;
    }
  }
}

/// Everything that happens to the chip, in order of time.
const Changes& stimulus() {
  static const Changes all = [] {
    Changes s = {{kResetAt, Pin::kReset, 1}, {kRequestAt, Pin::kRReq, 1}, {kOwnAt, Pin::kRSta, 1}};
    const Tick end = add_accesses(s);
    s.push_back({end, Pin::kRSta, 0});
    s.push_back({end + 200, Pin::kRReq, 0});
    add_telegram(s);
    return s;
  }();
  return all;
}

/// Changes at one tick may come in any order of pins.
Changes sorted(Changes changes) {
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.at != b.at ? a.at < b.at : a.pin < b.pin; });
  return changes;
}

Changes outputs(const Changes& all) {
  Changes some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), [](const Change& c) { return !is_input(c.pin); });
  return sorted(some);
}

/// The output changes of the bare core.
Changes core_trace(Engine engine) {
  Config config;
  config.engine = engine;
  dsdpv1::Chip chip(config);
  Changes changes;
  chip.watch({[](void* self, Tick at, Pin pin, Level level) {
                static_cast<Changes*>(self)->push_back({at, pin, level});
              },
              &changes},
             dsdpv1::kOutputPins);
  for (const Change& c : stimulus()) chip.set(c.at, c.pin, c.level);
  chip.advance(kEnd);
  return sorted(changes);
}

/// A pin module with the stimulus, `shift` ticks later.
struct StimulatedPins : PinBench {
  StimulatedPins(const char* name, const dsdpv1::systemc::PinOptions& options, Tick shift) : PinBench(name, options) {
    thread([this, shift] {
      drive(Pin::kDIn, dsdpv1::kLevelZ);
      for (const Change& c : stimulus()) {
        wait_until(c.at + shift);
        drive(c.pin, c.level);
      }
    });
    record(l_req, Pin::kLReq);
    record(l_sta, Pin::kLSta);
    method_on(d.value_changed_event(),
              [this] { data_bus.emplace_back(sc_core::sc_time_stamp(), d.read().to_string()); });
  }

  void record(sc_core::sc_signal<bool>& signal, Pin pin) {
    method_on(
        signal.value_changed_event(),
        [this, &signal, pin] {
          signals.push_back({dsdpv1::systemc::current_tick(), pin, static_cast<Level>(signal.read())});
          off_time += sc_core::sc_time_stamp() != to_time(dsdpv1::systemc::current_tick());
        });
  }

  Changes signals;
  int off_time = 0;
  std::vector<std::pair<sc_core::sc_time, std::string>> data_bus;
};

/// The TLM module with the same stimulus as transactions and characters.
struct StimulatedTlm : sc_core::sc_module {
  dsdpv1::systemc::TlmModule chip{"chip"};
  tlm_utils::simple_initiator_socket<StimulatedTlm> socket{"socket"};
  sc_core::sc_signal<bool> reset, r_req, r_sta;
  Changes changes;
  std::vector<int> read;

  explicit StimulatedTlm(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.bind(chip.host_socket);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
    chip.on_pin = [this](Tick at, Pin pin, Level level) { changes.push_back({at, pin, level}); };
    thread([this] { drive_pins(); });
    thread([this] { access(); });
    thread([this] { send(); });
  }

  void drive_pins() {
    for (const Change& c : stimulus()) {
      wait_until(c.at);
      if (c.pin == Pin::kReset) reset.write(c.level != 0);
      if (c.pin == Pin::kRReq) r_req.write(c.level != 0);
      if (c.pin == Pin::kRSta) r_sta.write(c.level != 0);
    }
  }

  void access() {
    sc_core::sc_time delay = to_time(kFirstAccess);  // as of a loosely-timed initiator that runs ahead
    for (const Transaction& t : kTransactions) {
      tlm::tlm_generic_payload payload;
      std::uint8_t byte = t.value;
      payload.set_command(t.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
      payload.set_address(t.address);
      payload.set_data_ptr(&byte);
      payload.set_data_length(1);
      payload.set_streaming_width(1);
      socket->b_transport(payload, delay);
      if (!t.write) read.push_back(payload.is_response_ok() ? byte : -1);
    }
  }

  void send() {
    wait_until(kTelegramAt - kUs);
    for (std::size_t i = 0; i < kTelegram.size(); ++i) {
      chip.bus_in->write(
          {to_time(kTelegramAt + static_cast<Tick>(i) * 11 * kBit), to_time(kBit), kTelegram[i], true, true});
    }
  }
};

struct World {
  StimulatedPins unbound{"unbound", {}, 0};
  StimulatedPins step{"step", step_options(), 0};
  StimulatedPins shifted{"shifted", phase_options(), kPhase};
  StimulatedPins bound{"bound", {}, 0};
  StimulatedTlm tlm{"tlm"};
  sc_core::sc_signal<bool> clk{"clk"};

  World() {
    bound.chip.CLK(clk);
    thread([this] {
      for (Tick edge = 0; edge < kEnd; edge += 250) {
        wait_until(edge);
        clk.write(true);
        wait_until(edge + 125);
        clk.write(false);
      }
    });
  }

  static dsdpv1::systemc::PinOptions step_options() {
    dsdpv1::systemc::PinOptions options;
    options.chip.engine = Engine::kStep;
    return options;
  }
  static dsdpv1::systemc::PinOptions phase_options() {
    dsdpv1::systemc::PinOptions options;
    options.phase = kPhase;
    return options;
  }
};

std::unique_ptr<World> world;

}  // namespace

void simulate() {
  dsdpv1::systemc::require_femtoseconds();
  collect_reports();
  world = std::make_unique<World>();
  sc_core::sc_start(to_time(kEnd));
}

namespace {

TEST(Views, PinModuleWithoutClkFollowsTheCore) {
  EXPECT_EQ(outputs(world->unbound.changes), core_trace(Engine::kSkip));
}

TEST(Views, PinModuleInStepFollowsTheCore) { EXPECT_EQ(outputs(world->step.changes), core_trace(Engine::kStep)); }

TEST(Views, PinModuleWithClkFollowsTheCore) { EXPECT_EQ(outputs(world->bound.changes), core_trace(Engine::kSkip)); }

TEST(Views, TlmModuleFollowsTheCore) { EXPECT_EQ(outputs(world->tlm.changes), core_trace(Engine::kSkip)); }

TEST(Views, PinsAndTransactionsMoveTheSameInputs) {
  EXPECT_EQ(sorted(world->tlm.changes), sorted(world->unbound.changes));
  EXPECT_EQ(sorted(world->bound.changes), sorted(world->unbound.changes));
}

TEST(Views, APhaseShiftsTheChipInSimulationTimeOnly) {
  EXPECT_EQ(sorted(world->shifted.changes), sorted(world->unbound.changes));
  ASSERT_EQ(world->shifted.signals.size(), world->unbound.signals.size());
  for (std::size_t i = 0; i < world->shifted.signals.size(); ++i)
    EXPECT_EQ(world->shifted.signals[i].at, world->unbound.signals[i].at + kPhase);
}

TEST(Views, SignalsChangeAtTheExactTimes) {
  const StimulatedPins& pins = world->unbound;
  EXPECT_EQ(only(pins.signals, Pin::kLReq), only(pins.changes, Pin::kLReq));
  EXPECT_EQ(only(pins.signals, Pin::kLSta), only(pins.changes, Pin::kLSta));
  EXPECT_GT(pins.signals.size(), 100U);
  EXPECT_EQ(pins.off_time, 0);
  for (const Change& change : pins.signals) ASSERT_EQ(change.at % 250, 0) << change;
}

TEST(Views, TransactionsReadWhatThePinsShow) {
  EXPECT_THAT(world->tlm.read, testing::ElementsAre(0x5A, 0x01, 0x0D, 0xC5, 0xC3));
}

TEST(Views, TheDataBusIsReleasedThenUnknownThenDriven) {
  std::vector<std::string> seen;
  for (const auto& [at, level] : world->unbound.data_bus)
    if (at >= to_time(kFirstAccess)) seen.push_back(level);
  ASSERT_GE(seen.size(), 5U);
  seen.resize(5);
  // The user's write, then the chip's answer to the read of the same byte.
  EXPECT_THAT(seen, testing::ElementsAre("01011010", "ZZZZZZZZ", "XXXXXXXX", "01011010", "ZZZZZZZZ"));
}

TEST(Views, ARightStimulusIsReportedByNobody) {
  for (const auto& [id, text] : reports()) ADD_FAILURE() << id << " " << text;
}

}  // namespace
