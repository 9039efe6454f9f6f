// The host socket: responses, timing, debug transport, ownership.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <algorithm>
#include <array>
#include <memory>

#include "model/dsdpv1/reasons.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::AccessTimingExtension;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;
using sc_core::SC_ZERO_TIME;
using tlm::tlm_generic_payload;

namespace {

/// The result of one transaction.
struct Outcome {
  tlm::tlm_response_status response = tlm::TLM_INCOMPLETE_RESPONSE;
  sc_time took;        ///< from the call to the return
  sc_time delay_left;  ///< the annotated delay on return
  std::vector<std::uint8_t> data;
};

struct Cpu : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Cpu> socket{"socket"};
  explicit Cpu(const sc_core::sc_module_name& name) : sc_module(name) {}

  static void prepare(tlm_generic_payload& payload, tlm::tlm_command command, sc_dt::uint64 address,
                      std::vector<std::uint8_t>& data) {
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(data.data());
    payload.set_data_length(static_cast<unsigned>(data.size()));
    payload.set_streaming_width(static_cast<unsigned>(data.size()));
  }

  Outcome send(tlm_generic_payload& payload, std::vector<std::uint8_t>& data, sc_time delay = SC_ZERO_TIME) {
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): the reference is to the present time, which moves on
    const sc_time start = sc_core::sc_time_stamp();
    socket->b_transport(payload, delay);
    return {payload.get_response_status(), sc_core::sc_time_stamp() - start, delay, data};
  }

  Outcome transport(tlm::tlm_command command, sc_dt::uint64 address, std::vector<std::uint8_t> data,
                    const sc_time& delay = SC_ZERO_TIME) {
    tlm_generic_payload payload;
    prepare(payload, command, address, data);
    return send(payload, data, delay);
  }
  Outcome write(sc_dt::uint64 address, std::vector<std::uint8_t> data, const sc_time& delay = SC_ZERO_TIME) {
    return transport(tlm::TLM_WRITE_COMMAND, address, std::move(data), delay);
  }
  Outcome read(sc_dt::uint64 address, std::size_t count, const sc_time& delay = SC_ZERO_TIME) {
    return transport(tlm::TLM_READ_COMMAND, address, std::vector<std::uint8_t>(count, 0xEE), delay);
  }
};

struct World : sc_core::sc_module {
  dsdpv1::systemc::TlmModule chip{"chip"};
  dsdpv1::systemc::TlmModule quiet{"quiet", quiet_options()};
  Cpu cpu{"cpu"}, second{"second"};
  sc_core::sc_signal<bool> reset, r_req, r_sta;
  Changes changes;
  std::vector<profibus::Reason> events, quiet_events;

  Outcome burst_write, burst_read, delayed, top, outside, across, far, empty, streaming, ignored, enables, wrong_enable,
      no_enable, no_data, short_strobe, unowned, by_extension, before_start_up;
  std::vector<Outcome> at_tw, before_tw, at_the_fall;  ///< one for each phase of CLK
  std::ptrdiff_t reported_early = 0;
  unsigned dbg_written = 0, dbg_read = 0, dbg_clipped = 0, dbg_outside = 0, dbg_ignored = 0;
  std::vector<std::uint8_t> dbg_data = std::vector<std::uint8_t>(4);
  std::size_t changes_before_dbg = 0, changes_after_dbg = 0;
  sc_time time_before_dbg, time_after_dbg, delayed_from;
  bool dmi = true;
  std::uint8_t enabled_cells[4] = {};
  std::vector<Level> killed_pins, killed_quiet_pins;  ///< CSR, RD, WR, A, D_IN

  explicit World(const sc_core::sc_module_name& name) : sc_module(name) {
    cpu.socket.bind(chip.host_socket);
    second.socket.bind(quiet.host_socket);
    for (auto* module : {&chip, &quiet}) module->RESET(reset), module->R_REQ(r_req), module->R_STA(r_sta);
    chip.on_pin = [this](Tick at, dsdpv1::Pin pin, dsdpv1::Level level) { changes.push_back({at, pin, level}); };
    chip.on_event = [this](const profibus::Event& event) { events.push_back(event.reason); };
    quiet.on_event = [this](const profibus::Event& event) { quiet_events.push_back(event.reason); };
    thread([this] { run(); });
  }

  static dsdpv1::systemc::TlmOptions quiet_options() {
    dsdpv1::systemc::TlmOptions options;
    options.report_violations = false;
    return options;
  }

  void run() {
    wait_until(100);
    reset.write(true);
    wait_until(100 * kUs);
    unowned = cpu.read(0x000, 1);
    second.read(0x000, 1);
    acquire();
    do_accesses();
    do_refusals();
    do_enables();
    do_debug();
    do_violations();
    killed_pins = kill_in_a_write(cpu, chip);
    killed_quiet_pins = kill_in_a_write(second, quiet);
    reset_alone();
  }

  /// The initiator is killed during its strobe.
  std::vector<Level> kill_in_a_write(Cpu& initiator, dsdpv1::systemc::TlmModule& module) {
    const HostAccess access = HostAccess::write(0x160, 0x5A, {});
    const auto edge_of = [&](Pin pin, Level level) {
      return std::find_if(
                 access.begin(), access.end(), [&](const auto& e) { return e.pin == pin && e.level == level; })
          ->at;
    };
    auto killed = sc_core::sc_spawn([&initiator] { initiator.write(0x160, {0x5A}); });
    wait_until(dsdpv1::systemc::current_tick() + (edge_of(Pin::kWr, 0) + edge_of(Pin::kWr, 1)) / 2);
    killed.kill();
    std::vector<Level> levels;
    for (const Pin pin : {Pin::kCsr, Pin::kRd, Pin::kWr, Pin::kA, Pin::kDIn})
      levels.push_back(module.chip().level(pin));
    wait_until(dsdpv1::systemc::current_tick() + kUs);
    return levels;
  }

  /// The user still owns the DPRAM.
  void reset_alone() {
    wait_until(150 * kUs);
    reset.write(false);
    wait_until(151 * kUs);
    reset.write(true);
    wait_until(160 * kUs);
    before_start_up = cpu.read(0x000, 1);
  }

  void acquire() {
    wait_until(110 * kUs);
    r_req.write(true);
    wait_until(112 * kUs);
    r_sta.write(true);
    wait_until(113 * kUs);
  }

  void do_accesses() {
    burst_write = cpu.write(0x130, {4, 0x11, 0x22, 0x33, 0x44});
    burst_read = cpu.read(0x130, 5);
    delayed_from = sc_core::sc_time_stamp();
    delayed = cpu.read(0x131, 1, to_time(777));
    cpu.write(0x7FF, {0x99});
    top = cpu.read(0x7FF, 1);
  }

  void do_refusals() {
    outside = cpu.read(0x800, 1);
    across = cpu.write(0x7FF, {1, 2});
    far = cpu.read(~sc_dt::uint64{0}, 1);
    empty = cpu.read(0x000, 0);
    ignored = cpu.transport(tlm::TLM_IGNORE_COMMAND, 0x000, {0});
    tlm_generic_payload payload;
    std::vector<std::uint8_t> data(4);
    Cpu::prepare(payload, tlm::TLM_READ_COMMAND, 0, data);
    payload.set_streaming_width(2);
    streaming = cpu.send(payload, data, to_time(500));
    payload.set_streaming_width(4);
    payload.set_data_ptr(nullptr);
    no_data = cpu.send(payload, data);
    tlm::tlm_dmi region;
    dmi = cpu.socket->get_direct_mem_ptr(payload, region);
  }

  void do_enables() {
    tlm_generic_payload payload;
    std::vector<std::uint8_t> data = {1, 2, 3, 4};
    std::array<std::uint8_t, 2> enable = {TLM_BYTE_DISABLED, TLM_BYTE_ENABLED};
    Cpu::prepare(payload, tlm::TLM_WRITE_COMMAND, 0x140, data);
    payload.set_byte_enable_ptr(enable.data());
    payload.set_byte_enable_length(2);
    enables = cpu.send(payload, data);
    wait_until(dsdpv1::systemc::current_tick() + kUs);
    for (std::uint16_t i = 0; i < 4; ++i) enabled_cells[i] = chip.peek(static_cast<std::uint16_t>(0x140 + i));
    payload.set_byte_enable_length(0);
    no_enable = cpu.send(payload, data);
    enable[0] = 0x01;
    payload.set_byte_enable_length(2);
    wrong_enable = cpu.send(payload, data);
  }

  unsigned debug(tlm::tlm_command command, sc_dt::uint64 address, std::vector<std::uint8_t>& data) {
    tlm_generic_payload payload;
    Cpu::prepare(payload, command, address, data);
    return cpu.socket->transport_dbg(payload);
  }

  void do_debug() {
    changes_before_dbg = changes.size();
    time_before_dbg = sc_core::sc_time_stamp();
    std::vector<std::uint8_t> written = {0xA1, 0xA2, 0xA3, 0xA4};
    dbg_written = debug(tlm::TLM_WRITE_COMMAND, 0x7FC, written);
    dbg_read = debug(tlm::TLM_READ_COMMAND, 0x7FC, dbg_data);
    dbg_clipped = debug(tlm::TLM_READ_COMMAND, 0x7FE, written);
    dbg_outside = debug(tlm::TLM_READ_COMMAND, 0x800, written);
    dbg_ignored = debug(tlm::TLM_IGNORE_COMMAND, 0x000, written);
    time_after_dbg = sc_core::sc_time_stamp();
    changes_after_dbg = changes.size();
  }

  Outcome with_timing(tlm::tlm_command command, const AccessTiming& timing) {
    tlm_generic_payload payload;
    std::vector<std::uint8_t> data(1, 0x77);
    AccessTimingExtension extension;
    extension.timing = timing;
    Cpu::prepare(payload, command, 0x150, data);
    payload.set_extension(&extension);
    Outcome outcome = cpu.send(payload, data);
    payload.clear_extension(&extension);
    return outcome;
  }

  /// D is valid 125 to 375 ticks after the start of the read, depending on the phase of CLK.
  void do_samples() {
    AccessTiming timing;
    for (Tick phase = 0; phase < profibus::kTicksPerCycle; phase += 5) {
      const auto read = [&](Tick sample) {
        const Tick now = dsdpv1::systemc::current_tick();
        wait_until((now / profibus::kTicksPerCycle + 2) * profibus::kTicksPerCycle + phase);
        timing.rd_sample = sample;
        return with_timing(tlm::TLM_READ_COMMAND, timing);
      };
      at_tw.push_back(read(375));
      before_tw.push_back(read(374));
      at_the_fall.push_back(read(phase == 0 ? -10 : 0));
    }
    reported_early = std::count(events.begin(), events.end(), dsdpv1::Reason::kReadTooShort);
  }

  void do_violations() {
    AccessTiming timing;
    timing.recovery = 1000;
    by_extension = with_timing(tlm::TLM_READ_COMMAND, timing);
    do_samples();
    timing.wr_low = timing.data_setup = 149;
    short_strobe = with_timing(tlm::TLM_WRITE_COMMAND, timing);
  }
};

std::unique_ptr<World> world;

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>("world");
  sc_core::sc_start(200, sc_core::SC_US);
}

namespace {

Tick write_ticks() { return HostAccess::write(0, 0, {}).duration(); }
Tick read_ticks() { return HostAccess::read(0, {}).duration(); }

TEST(HostSocket, ABurstIsOneAccessForEachByte) {
  EXPECT_EQ(world->burst_write.response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(world->burst_write.took, to_time(113 * kUs + 5 * write_ticks()) - to_time(113 * kUs));
  EXPECT_EQ(world->burst_read.response, tlm::TLM_OK_RESPONSE);
  EXPECT_THAT(world->burst_read.data, testing::ElementsAre(4, 0x11, 0x22, 0x33, 0x44));
}

TEST(HostSocket, TheAccessBeginsAfterTheAnnotatedDelay) {
  EXPECT_EQ(world->delayed.response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(world->delayed.data[0], 0x11);
  EXPECT_EQ(world->delayed.delay_left, SC_ZERO_TIME);
  const Tick begin = dsdpv1::systemc::to_tick(world->delayed_from) + 777;
  EXPECT_EQ(world->delayed_from + world->delayed.took, to_time(begin + read_ticks()));
  EXPECT_THAT(world->changes, testing::Contains(Change{begin, dsdpv1::Pin::kA, 0x131}));
}

TEST(HostSocket, TheLastCellIsReached) {
  EXPECT_EQ(world->top.response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(world->top.data[0], 0x99);
}

TEST(HostSocket, AddressesOutsideOfTheDpramAreAddressErrors) {
  EXPECT_EQ(world->outside.response, tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(world->across.response, tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(world->far.response, tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(world->across.took, SC_ZERO_TIME);
}

TEST(HostSocket, EmptyAndStreamingTransactionsAreBurstErrors) {
  EXPECT_EQ(world->empty.response, tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_EQ(world->streaming.response, tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_EQ(world->streaming.delay_left, to_time(500)) << "the delay of a refused transaction belongs to the initiator";
}

TEST(HostSocket, OtherCommandsAreCommandErrors) { EXPECT_EQ(world->ignored.response, tlm::TLM_COMMAND_ERROR_RESPONSE); }

TEST(HostSocket, ATransactionWithoutDataIsAnError) {
  EXPECT_EQ(world->no_data.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
}

TEST(HostSocket, ByteEnablesSelectTheBytes) {
  EXPECT_EQ(world->enables.response, tlm::TLM_OK_RESPONSE);
  EXPECT_THAT(world->enabled_cells, testing::ElementsAre(0, 2, 0, 4));
}

TEST(HostSocket, WrongByteEnablesAreByteEnableErrors) {
  EXPECT_EQ(world->no_enable.response, tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  EXPECT_EQ(world->wrong_enable.response, tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
}

TEST(HostSocket, DirectMemoryAccessIsDenied) { EXPECT_FALSE(world->dmi); }

TEST(HostSocket, DebugTransportReadsAndWritesWithoutTimeOrPins) {
  EXPECT_EQ(world->dbg_written, 4U);
  EXPECT_EQ(world->dbg_read, 4U);
  EXPECT_THAT(world->dbg_data, testing::ElementsAre(0xA1, 0xA2, 0xA3, 0xA4));
  EXPECT_EQ(world->time_after_dbg, world->time_before_dbg);
  EXPECT_EQ(world->changes_after_dbg, world->changes_before_dbg);
}

TEST(HostSocket, DebugTransportEndsWithTheDpram) {
  EXPECT_EQ(world->dbg_clipped, 2U);
  EXPECT_EQ(world->dbg_outside, 0U);
  EXPECT_EQ(world->dbg_ignored, 0U);
}

TEST(HostSocket, AnExtensionGivesOneTransactionItsOwnTiming) {
  AccessTiming timing;
  timing.recovery = 1000;
  const Tick took = HostAccess::read(0, timing).duration();
  EXPECT_NEAR(world->by_extension.took.to_seconds(), to_time(took).to_seconds(), 1e-15);
}

TEST(HostSocket, ASampleBeforeTwIsAGenericErrorAndReportedAtEveryPhaseOfTheClock) {
  for (const Outcome& each : world->at_tw) EXPECT_EQ(each.response, tlm::TLM_OK_RESPONSE);
  for (const auto* early : {&world->before_tw, &world->at_the_fall})
    for (const Outcome& each : *early) EXPECT_EQ(each.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
  EXPECT_EQ(world->reported_early, 2 * 50);
  EXPECT_THAT(reports_of("/dsdpv1/violation", "world.chip"), testing::Contains(testing::HasSubstr("HOST_TW")));
}

TEST(HostSocket, AReadBeforeAStartUpThatTheUserHoldsOffIsAGenericErrorAndReported) {
  EXPECT_EQ(world->before_start_up.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
  EXPECT_THAT(reports_of("/dsdpv1/violation", "world.chip"),
              testing::Contains(testing::HasSubstr("HANDSHAKE_HELD_THROUGH_RESET")));
}

TEST(HostSocket, AWriteThatViolatesTable15IsAGenericErrorAndReported) {
  EXPECT_EQ(world->short_strobe.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
  EXPECT_THAT(world->events, testing::Contains(dsdpv1::Reason::kWriteLowTooShort));
  EXPECT_THAT(reports_of("/dsdpv1/violation", "world.chip"), testing::Contains(testing::HasSubstr("HOST_TS")));
}

TEST(HostSocket, AKilledInitiatorLeavesIdlePinsWhetherSomebodyHearsThemOrNot) {
  for (const auto* pins : {&world->killed_pins, &world->killed_quiet_pins})
    EXPECT_THAT(*pins, testing::ElementsAre(1, 1, 1, HostAccess::kIdleAddress, kLevelZ));
}

TEST(HostSocket, AccessWithoutOwnershipIsCarriedOutAndReported) {
  EXPECT_EQ(world->unowned.response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(world->unowned.data[0], 0x01);
  EXPECT_THAT(world->events, testing::Contains(dsdpv1::Reason::kAccessNotOwned));
  EXPECT_THAT(reports_of("/dsdpv1/violation", "world.chip"), testing::Contains(testing::HasSubstr("HOST_NOT_OWNER")));
}

TEST(HostSocket, ReportsOfViolationsCanBeSwitchedOffTheCallbackStays) {
  EXPECT_THAT(world->quiet_events, testing::Contains(dsdpv1::Reason::kAccessNotOwned));
  EXPECT_TRUE(reports_of("/dsdpv1/violation", "world.quiet").empty());
}

}  // namespace
}  // namespace dsdpv1
