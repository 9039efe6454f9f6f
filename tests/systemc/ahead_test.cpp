// Accesses of a decoupled initiator: ahead of simulation time, or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <memory>

#include "model/dsdpv1/reasons.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::AccessTimingExtension;
using dsdpv1::systemc::TlmOptions;
using dsdpv1::systemc::to_tick;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;

namespace {

/// The result of one transaction, in ticks.
struct Outcome {
  tlm::tlm_response_status response = tlm::TLM_OK_RESPONSE;
  Tick took = 0, delay_left = 0;
  std::uint8_t first_byte = 0;
  bool done = false;  ///< ahead of simulation time
};

const Tick kRead = HostAccess::read(0, {}).duration(), kWrite = HostAccess::write(0, 0, {}).duration();

struct World : sc_core::sc_module {
  dsdpv1::systemc::TlmModule chip{"chip", options()};
  tlm_utils::simple_initiator_socket<World> socket{"socket"};
  sc_core::sc_signal<bool> reset, r_req, r_sta;
  sc_core::sc_event other;
  Changes changes;
  std::vector<profibus::Reason> events;

  Outcome unowned, written, read, burst, before_the_chip, at_another, before_another, waited, too_early, violating,
      violating_waited;
  Tick others_end = 0, released = 0, synchronised = 0;
  std::size_t events_before = 0, events_ahead = 0;

  explicit World(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.bind(chip.host_socket);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
    chip.on_pin = [this](Tick at, Pin pin, dsdpv1::Level level) { changes.push_back({at, pin, level}); };
    chip.on_event = [this](const profibus::Event& event) { events.push_back(event.reason); };
    thread([this] { run(); });
  }
  static TlmOptions options() {
    TlmOptions options;
    options.report_violations = false;
    options.observed = 0;  // R_REQ, R_STA and RESET are always observed
    return options;
  }

  void run() {
    wait_until(100);
    reset.write(true);
    wait_until(100 * kUs);
    unowned = transport(true, false, 0x000, 0);
    r_req.write(true);
    wait_until(103 * kUs);
    r_sta.write(true);
    wait_until(110 * kUs);
    run_ahead();
    meet_another();
    wait_until(120 * kUs);
    violate();
    wait_until(130 * kUs);  // until the chip has processed the writes
    release();
  }
  void run_ahead() {
    chip.poke(0x131, 0x77);
    written = transport(true, true, 0x130, 0);
    read = transport(true, false, 0x131, kWrite);
    burst = transport(true, false, 0x130, kWrite + kRead, 2);
    before_the_chip = transport(true, false, 0x130, 0);
    waited = transport(false, false, 0x130, kWrite + kRead);
    transport(true, false, 0x130, 0);
    too_early = transport(false, false, 0x130, 0);
  }
  /// Another process may look at the chip at the end of the access; one tick later there is no conflict.
  void meet_another() {
    other.notify(to_time(kRead));
    at_another = transport(true, false, 0x130, 0);
    other.cancel();
    other.notify(to_time(kRead + 1));
    before_another = transport(true, false, 0x130, 0);
  }
  void violate() {
    AccessTiming timing;
    timing.wr_low = timing.data_setup = 149;
    events_before = events.size();
    violating = transport(true, true, 0x140, 0, 1, timing);
    events_ahead = events.size();
    violating_waited = transport(false, true, 0x140, 0, 1, timing);
  }
  /// A pin that another process moves is seen at the chip's time.
  void release() {
    const Tick now = dsdpv1::systemc::current_tick();
    transport(true, false, 0x130, 0);
    r_sta.write(false);
    wait(sc_core::SC_ZERO_TIME);
    wait(sc_core::SC_ZERO_TIME);
    released = changes.back().at - now;
    chip.sync(to_time(5 * kUs));
    synchronised = chip.chip().now() - now;
  }

  Outcome transport(bool ahead, bool write, std::uint16_t address, Tick delay, unsigned bytes = 1,
                    const AccessTiming& timing = {}) {
    std::uint8_t data[2] = {0x5A, 0x5A};
    if (!write) data[0] = 0xEE;
    AccessTimingExtension extension;
    extension.timing = timing;
    extension.ahead = ahead;
    tlm::tlm_generic_payload payload;
    payload.set_command(write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
    payload.set_address(address);
    payload.set_data_ptr(data);
    payload.set_data_length(bytes);
    payload.set_streaming_width(bytes);
    payload.set_extension(&extension);
    const Tick begin = dsdpv1::systemc::current_tick();
    sc_time annotated = to_time(delay);
    socket->b_transport(payload, annotated);
    payload.clear_extension(&extension);
    return {payload.get_response_status(), dsdpv1::systemc::current_tick() - begin, to_tick(annotated), data[0],
            extension.done};
  }
};

std::unique_ptr<World> world;

void expect(const Outcome& outcome, tlm::tlm_response_status response, Tick took, Tick delay_left) {
  EXPECT_EQ(outcome.response, response);
  EXPECT_EQ(outcome.done, response == tlm::TLM_OK_RESPONSE && took == 0);
  EXPECT_EQ(outcome.took, took);
  EXPECT_EQ(outcome.delay_left, delay_left);
}

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>("world");
  sc_core::sc_start(200, sc_core::SC_US);
}

namespace {

TEST(Ahead, AnAccessMovesTheAnnotatedDelayOnAndTakesNoSimulationTime) {
  expect(world->written, tlm::TLM_OK_RESPONSE, 0, kWrite);
  expect(world->read, tlm::TLM_OK_RESPONSE, 0, kWrite + kRead);
  EXPECT_EQ(world->read.first_byte, 0x77);
}

TEST(Ahead, AnAccessThatWaitsFollowsThoseBeforeIt) {
  expect(world->waited, tlm::TLM_OK_RESPONSE, kWrite + 2 * kRead, 0);
  EXPECT_EQ(world->waited.first_byte, 0x5A);
}

TEST(Ahead, AnAccessThatWaitsBeginsNotBeforeTheTimeOfTheChip) {
  expect(world->too_early, tlm::TLM_OK_RESPONSE, HostAccess::read(0, {}).last() + kRead, 0);
  EXPECT_EQ(world->too_early.first_byte, 0x5A);
}

TEST(Ahead, NothingIsDoneWithoutOwnershipForABurstOrBeforeTheTimeOfTheChip) {
  expect(world->unowned, tlm::TLM_GENERIC_ERROR_RESPONSE, 0, 0);
  EXPECT_THAT(world->events, testing::Not(testing::Contains(dsdpv1::Reason::kAccessNotOwned)));
  expect(world->burst, tlm::TLM_GENERIC_ERROR_RESPONSE, 0, kWrite + kRead);
  EXPECT_EQ(world->burst.first_byte, 0xEE);
  expect(world->before_the_chip, tlm::TLM_GENERIC_ERROR_RESPONSE, 0, 0);
}

TEST(Ahead, NothingIsDoneWhenTheKernelHasSomethingToDoBeforeTheAccessIsOver) {
  expect(world->at_another, tlm::TLM_GENERIC_ERROR_RESPONSE, 0, 0);
  expect(world->before_another, tlm::TLM_OK_RESPONSE, 0, kRead);
}

TEST(Ahead, AViolationIsLeftToAnAccessThatWaits) {
  expect(world->violating, tlm::TLM_GENERIC_ERROR_RESPONSE, 0, 0);
  EXPECT_EQ(world->events_ahead, world->events_before);
  EXPECT_EQ(world->violating_waited.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
  EXPECT_THAT(world->events, testing::Contains(dsdpv1::Reason::kWriteLowTooShort));
}

TEST(Ahead, APinThatIsMovedMeanwhileIsSeenAtTheTimeOfTheChip) {
  EXPECT_EQ(world->released, HostAccess::read(0, {}).last());
  EXPECT_EQ(world->synchronised, 5 * kUs);
}

}  // namespace
}  // namespace dsdpv1
