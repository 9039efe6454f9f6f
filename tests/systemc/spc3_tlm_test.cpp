// The SPC3 family's socket: responses, time, debug transport, and what leaves it whole: a killed initiator, exceptions
// of observers.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "model/spc3/reasons.hpp"
#include "tests/systemc/spc3_initiator.hpp"

namespace dsdpv1 {

namespace {

std::unique_ptr<systemc::Spc3TlmOptions> vpc3() {
  auto options = std::make_unique<systemc::Spc3TlmOptions>();
  options->chip.variant = spc3::Variant::kVpc3;
  return options;
}

struct World : sc_core::sc_module {
  Spc3TlmModule chip{"chip"}, large{"large", *vpc3()}, thrown{"thrown"}, twin{"twin"};
  Initiator cpu{"cpu"}, of_large{"of_large"}, of_thrown{"of_thrown"}, of_twin{"of_twin"};
  sc_core::sc_signal<bool> reset{"reset", true};
  std::vector<Tick> changed;  ///< of X_INT
  Tick opened = 0;
  sc_core::sc_event go;

  Outcome in_reset, burst, burst_read, delayed, every_other, wrong_enable, empty, streaming, outside, across,
      top_of_large, outside_large, ignored, by_extension, after_kill, after_throw;
  std::vector<std::uint8_t> cells, commands_peeked;
  std::string failure;
  bool stored = false, is_whole = false;
  unsigned debug_read = 0, debug_outside = 0, debug_written = 0;

  explicit World(const sc_core::sc_module_name& name) : sc_module(name) {
    cpu.socket.bind(chip.host_socket);
    of_large.socket.bind(large.host_socket), of_thrown.socket.bind(thrown.host_socket);
    of_twin.socket.bind(twin.host_socket);
    for (Spc3TlmModule* each : {&chip, &large, &thrown, &twin}) each->RESET(reset);
    chip.on_pin = [this](Tick at, spc3::Pin pin, spc3::Level) {
      if (pin == spc3::Pin::kXInt) changed.push_back(at);
    };
    thrown.on_event = [](const profibus::Event& event) {
      if (event.reason == spc3::Reason::kRamViolation) throw std::runtime_error("from on_event");
    };
    thread([this] { run(); });
  }

  void run() {
    wait_until(kUs);
    in_reset = cpu.read(0x16, 3);
    reset.write(false);
    wait_until(2 * kUs);
    answer_by_rule();
    debug();
    kill_an_access();
    throw_in_an_access();
  }

  void answer_by_rule() {
    burst = cpu.write(0x40, {1, 2, 3, 4});
    burst_read = cpu.read(0x40, 4);
    delayed = cpu.write(0x44, {5}, to_time(500));
    std::uint8_t enables[] = {TLM_BYTE_DISABLED, TLM_BYTE_ENABLED};
    cpu.payload.set_byte_enable_ptr(enables), cpu.payload.set_byte_enable_length(2);
    every_other = cpu.write(0x48, {9, 9, 9});
    enables[0] = 0x12;
    wrong_enable = cpu.write(0x48, {8, 8, 8});
    cpu.payload.set_byte_enable_ptr(nullptr);
    empty = cpu.write(0x40, {});
    cpu.keep_width = true, cpu.payload.set_streaming_width(1);
    streaming = cpu.write(0x40, {7, 7});
    cpu.keep_width = false;
    outside = cpu.read(0x800, 1);
    across = cpu.write(0x7FF, {1, 1});
    ignored = cpu.send(tlm::TLM_IGNORE_COMMAND, 0x40, {0});
    top_of_large = of_large.read(0xFFF, 1);
    outside_large = of_large.read(0x1000, 1);
    systemc::RegisterAccessExtension quick;
    quick.access = 750;
    cpu.payload.set_extension(&quick);
    by_extension = cpu.write(0x50, {1, 2});
    cpu.payload.clear_extension(&quick);
    for (std::uint16_t address = 0x40; address < 0x4C; ++address) cells.push_back(chip.peek(address));
    // A mask opens over a standing event.
    cpu.write(regs::kIrr, {0x01});
    cpu.write(regs::kImr, {0xFE});
    opened = current_tick();
  }

  void debug() {
    std::vector<std::uint8_t> data = {0xA5, 0x5A};
    tlm::tlm_generic_payload payload;
    payload.set_command(tlm::TLM_WRITE_COMMAND);
    payload.set_data_ptr(data.data()), payload.set_data_length(2), payload.set_address(0x100);
    debug_written = cpu.socket->transport_dbg(payload);
    payload.set_read();
    payload.set_address(0x08);
    debug_read = cpu.socket->transport_dbg(payload);  // Din's states, and New_Din as a cell: no command
    commands_peeked = data;
    payload.set_address(0x800);
    debug_outside = cpu.socket->transport_dbg(payload);
    stored = chip.peek(0x100) == 0xA5 && chip.peek(0x101) == 0x5A && chip.peek(0x08) == 0xE1;
  }

  void kill_an_access() {
    sc_core::sc_process_handle other = sc_core::sc_spawn([this] {
      std::vector<std::uint8_t> data = {1, 2, 3, 4};
      tlm::tlm_generic_payload payload;
      payload.set_write();
      payload.set_data_ptr(data.data()), payload.set_data_length(4), payload.set_streaming_width(4);
      payload.set_address(0x60);
      sc_time none = SC_ZERO_TIME;
      cpu.socket->b_transport(payload, none);
    });
    sc_core::wait(to_time(kAccess + 100));
    other.kill();
    after_kill = cpu.write(0x64, {6});
  }

  /// The same accesses at the same time: an observer of one chip throws.
  void throw_in_an_access() {
    sc_core::sc_spawn([this] {
      of_twin.write(0x600, {1});
      sc_core::wait(to_time(kUs));
      of_twin.write(0x66, {7});
    });
    try {
      of_thrown.write(0x600, {1});
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
    sc_core::wait(to_time(kUs));
    after_throw = of_thrown.write(0x66, {7});
    sc_core::wait(to_time(kUs));
    for (Spc3TlmModule* each : {&thrown, &twin}) each->sync();
    is_whole = thrown.chip().save() == twin.chip().save();
  }
};

std::unique_ptr<World> world;

void expect(const Outcome& outcome, tlm::tlm_response_status response, Tick took) {
  EXPECT_EQ(outcome.response, response);
  EXPECT_EQ(outcome.took, took);
}

}  // namespace

void simulate() {
  collect_reports();
  set_resolution();
  world = std::make_unique<World>("world");
  sc_core::sc_start(100, sc_core::SC_US);
}

namespace {

TEST(Spc3Socket, EveryByteIsAnAccessInOrder) {
  expect(world->burst, tlm::TLM_OK_RESPONSE, 4 * kAccess);
  expect(world->burst_read, tlm::TLM_OK_RESPONSE, 4 * kAccess);
  EXPECT_EQ(world->burst_read.data, (std::vector<std::uint8_t>{1, 2, 3, 4}));
  expect(world->by_extension, tlm::TLM_OK_RESPONSE, 2 * 750);
  EXPECT_EQ(world->cells, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 0, 0, 0, 0, 9, 0, 0}));
}

TEST(Spc3Socket, TheDelayPassesFirst) {
  expect(world->delayed, tlm::TLM_OK_RESPONSE, 500 + kAccess);
  EXPECT_EQ(world->delayed.delay_left, 0);
}

TEST(Spc3Socket, PayloadsAreJudged) {
  expect(world->every_other, tlm::TLM_OK_RESPONSE, kAccess);
  expect(world->wrong_enable, tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE, 0);
  expect(world->empty, tlm::TLM_BURST_ERROR_RESPONSE, 0);
  expect(world->streaming, tlm::TLM_BURST_ERROR_RESPONSE, 0);
  expect(world->outside, tlm::TLM_ADDRESS_ERROR_RESPONSE, 0);
  expect(world->across, tlm::TLM_ADDRESS_ERROR_RESPONSE, 0);
  expect(world->ignored, tlm::TLM_COMMAND_ERROR_RESPONSE, 0);
  expect(world->top_of_large, tlm::TLM_OK_RESPONSE, kAccess);
  expect(world->outside_large, tlm::TLM_ADDRESS_ERROR_RESPONSE, 0);
}

TEST(Spc3Socket, InResetTheBurstEndsWithAnError) { expect(world->in_reset, tlm::TLM_GENERIC_ERROR_RESPONSE, kAccess); }

TEST(Spc3Socket, DebugTransportHasNoEffect) {
  EXPECT_EQ(world->debug_written, 2U);
  EXPECT_TRUE(world->stored);
  EXPECT_EQ(world->debug_read, 2U);
  EXPECT_EQ(world->commands_peeked, (std::vector<std::uint8_t>{0xE1, 0}));
  EXPECT_EQ(world->debug_outside, 0U);
}

TEST(Spc3Socket, AKilledInitiatorAndAnExceptionLeaveThePortWhole) {
  expect(world->after_kill, tlm::TLM_OK_RESPONSE, kAccess);
  EXPECT_EQ(world->chip.peek(0x60), 1);
  EXPECT_EQ(world->chip.peek(0x61), 0);
  EXPECT_EQ(world->chip.peek(0x64), 6);
  EXPECT_EQ(world->failure, "from on_event");
  expect(world->after_throw, tlm::TLM_OK_RESPONSE, kAccess);
  EXPECT_EQ(world->thrown.peek(0x66), 7);
  EXPECT_TRUE(world->is_whole);
}

TEST(Spc3Socket, TheEffectIsAtTheEndOfTheAccess) {
  const Tick taken = profibus::first_edge_after(world->opened) * profibus::kTicksPerCycle;
  EXPECT_EQ(world->changed, std::vector<Tick>{taken + profibus::kTicksPerCycle});  // int_delay
}

}  // namespace
}  // namespace dsdpv1
