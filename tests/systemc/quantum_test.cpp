// An initiator with a quantum that uses plain TLM-2.0: tests how b_transport treats its delay.
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <memory>

#include "driver/systemc/driver_cpu.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::DriverCpu;
using dsdpv1::systemc::to_tick;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;

namespace {

const Tick kRead = HostAccess::read(0, {}).duration(), kWrite = HostAccess::write(0, 0, {}).duration();

/// The result of one transaction, in ticks.
struct Outcome {
  tlm::tlm_response_status response = tlm::TLM_INCOMPLETE_RESPONSE;
  Tick took = 0, delay_left = 0;
  std::vector<std::uint8_t> data;
};

/// A target of another project: allows DMI, and takes the full payload.
struct ForeignTarget : sc_core::sc_module {
  tlm_utils::simple_target_socket<ForeignTarget> socket{"socket"};
  int accesses = 0, used = 0;  ///< with attributes that an earlier one has set

  explicit ForeignTarget(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.register_b_transport(this, &ForeignTarget::b_transport);
  }
  void b_transport(tlm::tlm_generic_payload& payload, sc_time& /*delay*/) {
    ++accesses;
    used += payload.is_dmi_allowed() || payload.get_gp_option() != tlm::TLM_MIN_PAYLOAD ? 1 : 0;
    payload.set_dmi_allowed(true);
    payload.set_gp_option(tlm::TLM_FULL_PAYLOAD_ACCEPTED);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  }
};

struct World : sc_core::sc_module {
  dsdpv1::systemc::TlmModule chip{"chip", options()}, in_reset{"in_reset", options()};
  tlm_utils::simple_initiator_socket<World> socket{"socket"};
  sc_core::sc_signal<bool> reset, r_req, r_sta, low;
  DriverCpu cpu{"cpu", [this](DriverCpu& itself) { misuse(itself); }};
  ForeignTarget target{"target"};
  DriverCpu visitor{"visitor", [](DriverCpu& itself) {
                      for (int i = 0; i < 2; ++i) itself.port().read(itself.port().ctx, 0x004);
                    }};
  sc_core::sc_event other;
  Outcome unowned, written, read, too_early, interrupted, enabled, refused;
  std::uint8_t unheard = 0;
  Tick waited = 0;
  bool intr0 = true;

  explicit World(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.bind(chip.host_socket);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
    cpu.socket.bind(in_reset.host_socket);
    in_reset.RESET(low), in_reset.R_REQ(cpu_r_req_), in_reset.R_STA(cpu_r_sta_);
    cpu.R_REQ(cpu_r_req_), cpu.R_STA(cpu_r_sta_), cpu.L_REQ(low), cpu.L_STA(low);
    visitor.socket.bind(target.socket);
    visitor.R_REQ(visitor_r_req_), visitor.R_STA(visitor_r_sta_), visitor.L_REQ(low), visitor.L_STA(low);
    thread([this] { run(); });
  }
  static dsdpv1::systemc::TlmOptions options() {
    dsdpv1::systemc::TlmOptions options;
    options.report_violations = false;
    options.observed = 0;
    return options;
  }

  void run() {
    wait_until(kUs);
    reset.write(true);
    wait_until(100 * kUs);
    unowned = transport(tlm::TLM_READ_COMMAND, 0x000, {0}, 50);
    r_req.write(true);
    wait_until(103 * kUs);
    r_sta.write(true);
    wait_until(110 * kUs);
    written = transport(tlm::TLM_WRITE_COMMAND, 0x130, {4, 0x11, 0x22, 0x33}, 100);
    sc_core::wait(to_time(written.delay_left));
    read = transport(tlm::TLM_READ_COMMAND, 0x130, {0, 0, 0, 0}, 70);
    sc_core::wait(to_time(read.delay_left));
    refused = transport(tlm::TLM_READ_COMMAND, 0x800, {0}, 70);
    enabled = transport(tlm::TLM_WRITE_COMMAND, 0x140, {1, 2, 3, 4}, 0, true);
    sc_core::wait(to_time(enabled.delay_left));
    transport(tlm::TLM_READ_COMMAND, 0x130, {0}, 0);
    too_early = transport(tlm::TLM_READ_COMMAND, 0x130, {0}, 0);
    other.notify(to_time(2 * kRead + kRead / 2));
    interrupted = transport(tlm::TLM_READ_COMMAND, 0x130, {0, 0, 0, 0}, 0);
  }

  Outcome transport(tlm::tlm_command command, sc_dt::uint64 address, std::vector<std::uint8_t> data, Tick delay,
                    bool every_other = false) {
    tlm::tlm_generic_payload payload;
    std::uint8_t enables[] = {TLM_BYTE_ENABLED, TLM_BYTE_DISABLED};
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(data.data());
    payload.set_data_length(static_cast<unsigned>(data.size()));
    payload.set_streaming_width(static_cast<unsigned>(data.size()));
    if (every_other) payload.set_byte_enable_ptr(enables), payload.set_byte_enable_length(2);
    const Tick begin = dsdpv1::systemc::current_tick();
    sc_time annotated = to_time(delay);
    socket->b_transport(payload, annotated);
    return {payload.get_response_status(), dsdpv1::systemc::current_tick() - begin, to_tick(annotated), data};
  }

  /// Misuse by a CPU whose chip is in reset; its RESET is unbound.
  void misuse(DriverCpu& itself) {
    try {
      itself.set_reset(true);
    } catch (const sc_core::sc_report&) {
    }
    unheard = itself.port().read(itself.port().ctx, 0x004);
    const Tick before = to_tick(itself.now());
    intr0 = itself.wait_for_intr0(to_time(5 * kUs));
    waited = to_tick(itself.now()) - before;
  }

 private:
  sc_core::sc_signal<bool> cpu_r_req_, cpu_r_sta_, visitor_r_req_, visitor_r_sta_;
};

std::unique_ptr<World> world;

void expect(const Outcome& outcome, tlm::tlm_response_status response, Tick took, Tick delay_left) {
  EXPECT_EQ(outcome.response, response);
  EXPECT_EQ(outcome.took, took);
  EXPECT_EQ(outcome.delay_left, delay_left);
}

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  tlm::tlm_global_quantum::instance().set(sc_time(10, sc_core::SC_US));
  world = std::make_unique<World>("world");
  sc_core::sc_start(200, sc_core::SC_US);
}

namespace {

TEST(Quantum, TheOwnersAccessesAreInTheDelayThatComesBack) {
  expect(world->written, tlm::TLM_OK_RESPONSE, 0, 100 + 4 * kWrite);
  expect(world->read, tlm::TLM_OK_RESPONSE, 0, 70 + 4 * kRead);
  EXPECT_EQ(world->read.data, (std::vector<std::uint8_t>{4, 0x11, 0x22, 0x33}));
}

TEST(Quantum, WithoutOwnershipAnAccessWaits) { expect(world->unowned, tlm::TLM_OK_RESPONSE, 50 + kRead, 0); }

TEST(Quantum, AnotherProcessDoesNotStopATransaction) {
  expect(world->interrupted, tlm::TLM_OK_RESPONSE, 0, 4 * kRead);
  EXPECT_EQ(world->interrupted.data, (std::vector<std::uint8_t>{4, 0x11, 0x22, 0x33}));
}

TEST(Quantum, AnAccessBeginsNotBeforeTheEndOfThoseAhead) {
  expect(world->too_early, tlm::TLM_OK_RESPONSE, 2 * kRead, 0);
}

TEST(Quantum, BytesThatAreNotEnabledTakeNoTime) {
  expect(world->enabled, tlm::TLM_OK_RESPONSE, 0, 2 * kWrite);
  EXPECT_EQ(world->chip.peek(0x140), 1);
  EXPECT_EQ(world->chip.peek(0x141), 0);
  EXPECT_EQ(world->chip.peek(0x142), 3);
}

TEST(Quantum, ARefusedTransactionLeavesTheDelayAsItWas) {
  expect(world->refused, tlm::TLM_ADDRESS_ERROR_RESPONSE, 0, 70);
}

TEST(DriverCpu, SendsAFreshPayloadEachTime) {
  EXPECT_EQ(world->target.accesses, 2);
  EXPECT_EQ(world->target.used, 0);
}

TEST(DriverCpuMisused, AFailedAccessIsReportedAndReadsAsAPulledUpBus) {
  EXPECT_EQ(world->unheard, 0xFF);
  ASSERT_FALSE(reports_of("/dsdpv1/driver_cpu", "world.cpu").empty());
  EXPECT_EQ(reports_of("/dsdpv1/driver_cpu", "world.cpu").back(),
            "world.cpu: reading 0x004 failed: TLM_GENERIC_ERROR_RESPONSE");
}

TEST(DriverCpuMisused, ResetWithoutAPinIsAClearError) {
  EXPECT_EQ(reports_of("/dsdpv1/driver_cpu", "world.cpu").front(), "world.cpu: set_reset needs RESET to be bound");
}

TEST(DriverCpuMisused, WithoutIntr0ItWaitsForAsLongAsItWasTold) {
  EXPECT_FALSE(world->intr0);
  EXPECT_EQ(world->waited, 5 * kUs);
}

}  // namespace
}  // namespace dsdpv1
