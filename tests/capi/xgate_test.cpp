// An XGate-DPS10 through the C API: bytes of its host by UART and SPI, /INT, its slave, its saved state.
#include <algorithm>
#include <string>
#include <utility>

#include "model/dsdpv1/serial_host.hpp"
#include "tests/capi/capi.hpp"
#include "tests/conformance/host_telegrams.hpp"

namespace dsdpv1::capi_test {
namespace {

using Bytes = std::vector<uint8_t>;

constexpr uint32_t kRate = 3'000'000;
constexpr uint8_t kSlave = 6;

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// `7E CMD len special data XOR`.
Bytes frame(uint8_t command, const Bytes& data = {}, uint8_t special = 0x11) {
  Bytes bytes = Bytes{0x7E, command, static_cast<uint8_t>(data.size()), special} + data;
  uint8_t sum = 0;
  for (const uint8_t byte : bytes) sum = static_cast<uint8_t>(sum ^ byte);
  return bytes + Bytes{sum};
}
Bytes error_frame(uint8_t command, uint8_t type, uint8_t code) { return frame(command, {type, code, 0}, 0x91); }

/// Command 04: 4 bytes of inputs, 4 of outputs, 5 user parameters with the three of DPV1.
Bytes initialisation() {
  return frame(0x04, {kSlave, 0x01, 0x0F, 2, 4, 4, 5, 1, 0, 0, 0, 0, 0, 10, 240, 240, 0x80, 0xFC, 1, 0x13, 0x23});
}

uint16_t pin(const char* name) {
  uint16_t number = 0;
  ok(dpsim_pin_find("xgate", name, &number));
  return number;
}

/// Options of a module with a quick host.
class Options {
 public:
  explicit Options(dpsim_engine engine = DPSIM_ENGINE_SKIP, int port = 0)
      : parameters_{{"rate", kRate}, {"answer_delay", 10 * kUs}, {"power_up", 20 * kUs}, {"port", port}} {
    options_ = sized<dpsim_chip_options>();
    options_.kind = "xgate";
    options_.engine = engine;
    options_.parameters = parameters_.data();
    options_.parameter_count = parameters_.size();
  }
  const dpsim_chip_options* operator&() const { return &options_; }

 private:
  std::vector<dpsim_parameter> parameters_;
  dpsim_chip_options options_;
};

Owned<dpsim_chip> make_module(dpsim_engine engine = DPSIM_ENGINE_SKIP, int port = 0) {
  const Options options(engine, port);
  dpsim_chip* chip = nullptr;
  ok(dpsim_chip_create(&options, &chip));
  return Owned<dpsim_chip>(chip);
}

uint64_t now_of(const dpsim_chip* chip) {
  uint64_t now = 0;
  ok(dpsim_chip_now(chip, &now));
  return now;
}
dpsim_level level_of(const dpsim_chip* chip, const char* name) {
  dpsim_level level = DPSIM_X;
  ok(dpsim_chip_level(chip, pin(name), &level));
  return level;
}

/// From /Rst to the first frame.
void power_up(dpsim_chip* chip) {
  ok(dpsim_chip_set(chip, kUs, pin("RESET"), 1));
  ok(dpsim_chip_advance(chip, 40 * kUs));
}

/// The next bytes, at most so many and until `wait` has passed.
Bytes hear(dpsim_chip* chip, size_t bytes, uint64_t wait = kMs) {
  Bytes received(bytes);
  size_t count = 0;
  ok(dpsim_chip_uart_receive(chip, now_of(chip) + wait, received.data(), bytes, &count));
  received.resize(count);
  return received;
}
void send(dpsim_chip* chip, const Bytes& bytes) {
  uint64_t end = 0;
  ok(dpsim_chip_uart_send(chip, now_of(chip), bytes.data(), bytes.size(), &end));
  EXPECT_EQ(end, now_of(chip));
}
/// The answer to a command, a whole frame.
Bytes ask(dpsim_chip* chip, const Bytes& command) {
  send(chip, command);
  const Bytes head = hear(chip, 4);
  return head.size() < 4 ? head : head + hear(chip, (head[2] & 0x7FU) + 1U);
}

TEST(CapiXgate, AnswersItsHostByUart) {
  const auto chip = make_module();
  ok(dpsim_chip_uart_open(chip.get(), kRate));
  send(chip.get(), frame(0x01, {1}));  // /Rst is low
  EXPECT_EQ(hear(chip.get(), 1), Bytes{});
  ok(dpsim_chip_set(chip.get(), now_of(chip.get()), pin("RESET"), 1));
  ok(dpsim_chip_advance(chip.get(), now_of(chip.get()) + 40 * kUs));
  EXPECT_EQ(ask(chip.get(), frame(0x01, {1})), frame(0x01, {0x01, 0x00}));
  EXPECT_EQ(ask(chip.get(), frame(0x55)), error_frame(0x55, 4, 1));
  EXPECT_EQ(ask(chip.get(), frame(0x20, {1, 2, 3, 4})), error_frame(0x20, 3, 4));
  EXPECT_EQ(ask(chip.get(), initialisation()), frame(0x04));
  auto status = sized<dpsim_chip_status>();
  ok(dpsim_chip_get_status(chip.get(), &status));
  EXPECT_EQ(status.dp_state, DPSIM_DP_WAIT_PRM);
  EXPECT_EQ(status.address, kSlave);
  EXPECT_EQ(ask(chip.get(), frame(0x03, {0x00, 0xC2, 0x01})), frame(0x03));  // 115 200 bit/s
  ok(dpsim_chip_advance(chip.get(), now_of(chip.get()) + 2 * kMs));
  ok(dpsim_chip_uart_open(chip.get(), 115'200));
  EXPECT_EQ(ask(chip.get(), frame(0x12, {0})), frame(0x12));
}

TEST(CapiXgate, WhatItSendsIsKeptWhileOthersAdvanceIt) {
  const auto chip = make_module();
  ok(dpsim_chip_uart_open(chip.get(), kRate));
  power_up(chip.get());
  ok(dpsim_chip_watch(chip.get(), DPSIM_PIN(pin("TXD")), nullptr, nullptr));
  send(chip.get(), frame(0x01, {9}));
  ok(dpsim_chip_advance(chip.get(), now_of(chip.get()) + kMs));
  const Bytes answer = frame(0x01, {'X', 'G', 'a', 't', 'e', '-', 'D', 'P', 'S', '1', '0', 0});
  EXPECT_EQ(hear(chip.get(), 3, 0), Bytes(answer.begin(), answer.begin() + 3));
  EXPECT_EQ(hear(chip.get(), 100, 0), Bytes(answer.begin() + 3, answer.end()));
  EXPECT_GT(drain(dpsim_chip_read_changes, chip.get()).size(), answer.size());
}

TEST(CapiXgate, AnswersItsHostBySpi) {
  for (const dpsim_engine engine : {DPSIM_ENGINE_SKIP, DPSIM_ENGINE_STEP}) {
    const auto chip = make_module(engine, 1);
    power_up(chip.get());
    auto timing = sized<dpsim_spi_timing>();
    timing.bit = 2400;  // 5 MHz
    const Bytes command = frame(0x01, {1});
    Bytes in(command.size());
    uint64_t end = 0;
    ok(dpsim_chip_spi(chip.get(), now_of(chip.get()), &timing, command.data(), in.data(), in.size(), &end));
    EXPECT_EQ(in, Bytes(command.size(), 0xFF));  // X14
    EXPECT_EQ(level_of(chip.get(), "INT"), 1);
    ok(dpsim_chip_advance(chip.get(), end += 20 * kUs));
    EXPECT_EQ(level_of(chip.get(), "INT"), 0);
    const Bytes answer = frame(0x01, {1, 0}), idle(answer.size(), 0xFF);
    in.resize(answer.size());
    ok(dpsim_chip_spi(chip.get(), end, &timing, idle.data(), in.data(), in.size(), &end));
    EXPECT_EQ(in, answer);
    ok(dpsim_chip_spi(chip.get(), end, nullptr, idle.data(), nullptr, 1, &end));
    EXPECT_EQ(level_of(chip.get(), "INT"), 1);
    EXPECT_EQ(level_of(chip.get(), "MISO"), DPSIM_Z);
  }
}

/// A module and a master on a bus.
struct ModuleOnBus {
  ModuleOnBus() {
    const Options options;
    ok(dpsim_bus_add_chip(bus.get(), &options, &chip));
    ok(dpsim_bus_add_master(bus.get(), nullptr, &master));
    auto slave = sized<dpsim_slave>();
    slave.address = kSlave;
    slave.ident = 0x0F01;
    slave.input_length = slave.output_length = 4;
    slave.cfg_size = 2;
    slave.cfg[0] = 0x13;
    slave.cfg[1] = 0x23;
    slave.user_prm_size = 5;
    const uint8_t prm[] = {0x80, 0, 0, 0xAA, 0x55};
    std::copy(std::begin(prm), std::end(prm), slave.user_prm);
    ok(dpsim_master_add_slave(master, &slave));
    const uint8_t outputs[] = {1, 2, 3, 4};
    ok(dpsim_master_set_outputs(master, kSlave, outputs, 4));
    ok(dpsim_chip_uart_open(chip, kRate));
    power_up(chip);
  }
  dpsim_slave_status slave() const {
    auto status = sized<dpsim_slave_status>();
    ok(dpsim_master_get_slave(master, kSlave, &status));
    return status;
  }
  void pass(uint64_t time) const { ok(dpsim_bus_run(bus.get(), now_of(chip) + time)); }

  Owned<dpsim_bus> bus = make_bus();
  dpsim_chip* chip = nullptr;
  dpsim_master* master = nullptr;
};

TEST(CapiXgate, ExchangesDataWithAMaster) {
  const ModuleOnBus line;
  dpsim_chip* chip = line.chip;
  EXPECT_EQ(ask(chip, initialisation()), frame(0x04));
  ok(dpsim_master_start(line.master));
  line.pass(5 * kMs);
  EXPECT_EQ(line.slave().state, DPSIM_SLAVE_DATA_EXCHANGE);
  EXPECT_EQ(level_of(chip, "INT"), 0);  // new user parameters
  EXPECT_EQ(ask(chip, frame(0x20, {9, 8, 7, 6})), frame(0x21, {1, 2, 3, 4}));
  EXPECT_EQ(ask(chip, frame(0x22)), frame(0x22, {0x80, 0, 0, 0xAA, 0x55}));
  EXPECT_EQ(ask(chip, frame(0x21, {5, 6, 7, 8})), frame(0x21, {1, 2, 3, 4}));
  EXPECT_EQ(level_of(chip, "INT"), 1);
  line.pass(kMs);
  const dpsim_slave_status status = line.slave();
  ASSERT_EQ(status.input_count, 4U);
  EXPECT_EQ(Bytes(status.inputs, status.inputs + 4), (Bytes{5, 6, 7, 8}));
}

/// The bits of characters at a pin from `at` on.
void spell(std::vector<dpsim_change>& edges, const char* name, uint64_t at, uint32_t bit, unsigned bits,
           uint32_t levels) {
  for (unsigned i = 0; i < bits; ++i)
    edges.push_back({at + i * uint64_t{bit}, 0, pin(name), static_cast<dpsim_level>(levels >> i & 1), 0});
}

/// By SPI: /Rst, a command, its answer.
std::vector<dpsim_change> life_by_spi() {
  std::vector<dpsim_change> edges = {{kUs, 0, pin("RESET"), 1, 0}};
  dsdpv1::SpiTiming timing;
  timing.high = timing.low = 1200;
  uint64_t at = 40 * kUs;
  for (const Bytes& bytes : {frame(0x01, {1}), Bytes(7, 0x55)}) {
    const dsdpv1::SpiFrame frame(bytes, timing);
    for (size_t i = 0; i < frame.size(); ++i) {
      const dsdpv1::SerialEdge edge = frame[i];
      if (edge.pin == dsdpv1::Pin::kMiso) continue;
      const char* name = edge.pin == dsdpv1::Pin::kSck ? "SCK" : edge.pin == dsdpv1::Pin::kMosi ? "MOSI" : "NSS";
      edges.push_back({at + static_cast<uint64_t>(edge.at), 0, pin(name), static_cast<dpsim_level>(edge.level), 0});
    }
    at += 100 * kUs;
  }
  return edges;
}

/// A whole life: /Rst, command 04, Slave_Diag three times, Set_Prm, a wrong command.
std::vector<dpsim_change> life() {
  std::vector<dpsim_change> edges = {{kUs, 0, pin("RESET"), 1, 0}};
  uint64_t at = 40 * kUs;
  for (const uint8_t byte : initialisation())
    spell(edges, "RXD", std::exchange(at, at + 40'000), 4000, 10, byte * 2U | 0x200U);
  at += 20 * kUs;
  const bus::Bytes diagnosis = bus::encode(bus::make_telegram(kSlave, 2, 0x6D, {}, 60, 62));
  const bus::Bytes parameters =
      bus::encode(bus::make_telegram(kSlave, 2, 0x5D, {0x88, 0, 0, 11, 0x0F, 0x01, 0, 0x80, 0, 0, 0xAA, 0x55}, 61, 62));
  for (const bus::Bytes& telegram : {diagnosis, diagnosis, diagnosis, parameters}) {
    for (const uint8_t byte : telegram)
      spell(edges, "PBRXD", std::exchange(at, at + 11'000), 1000, 11, bus::Character::of(byte).bits);
    at += 100 * kUs;
  }
  for (const uint8_t byte : frame(0x55))
    spell(edges, "RXD", std::exchange(at, at + 40'000), 4000, 10, byte * 2U | 0x200U);
  return edges;
}

/// All changes in that life of a module that is exchanged for its saved state every `apart` ticks.
std::vector<dpsim_change> live(dpsim_engine engine, uint64_t apart, int port = 0) {
  auto chip = make_module(engine, port);
  ok(dpsim_chip_watch(chip.get(), DPSIM_ALL_PINS, nullptr, nullptr));
  const std::vector<dpsim_change> edges = port == 0 ? life() : life_by_spi();
  const uint64_t end = edges.back().tick + 200 * kUs;
  std::vector<dpsim_change> all;
  auto edge = edges.begin();
  for (uint64_t tick = std::min(apart, end);; tick = std::min(tick + apart, end)) {
    for (; edge != edges.end() && edge->tick <= tick; ++edge)
      ok(dpsim_chip_set(chip.get(), edge->tick, edge->pin, edge->level));
    ok(dpsim_chip_advance(chip.get(), tick));
    const auto more = drain(dpsim_chip_read_changes, chip.get());
    all.insert(all.end(), more.begin(), more.end());
    if (tick == end) return all;
    std::vector<uint8_t> state(DPSIM_MAX_CHIP_STATE);
    size_t size = 0;
    ok(dpsim_chip_save(chip.get(), state.data(), state.size(), &size));
    chip = make_module(engine, port);
    ok(dpsim_chip_watch(chip.get(), DPSIM_ALL_PINS, nullptr, nullptr));
    ok(dpsim_chip_restore(chip.get(), state.data(), size));
  }
}

TEST(CapiXgate, ARestoredModuleGoesOnAsTheOneThatWasSaved) {
  const auto whole = live(DPSIM_ENGINE_SKIP, DPSIM_LAST_TICK);
  for (const char* name : {"PBTXD", "TXD", "LED2A"})
    EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), [&](const auto& change) { return change.pin == pin(name); }))
        << name;
  EXPECT_EQ(live(DPSIM_ENGINE_SKIP, 3777), whole);
  EXPECT_EQ(live(DPSIM_ENGINE_STEP, 77'777), whole);
  const auto by_spi = live(DPSIM_ENGINE_SKIP, DPSIM_LAST_TICK, 1);
  EXPECT_GT(std::count_if(by_spi.begin(), by_spi.end(), [](const auto& each) { return each.pin == pin("MISO"); }), 20);
  EXPECT_EQ(live(DPSIM_ENGINE_SKIP, 1777, 1), by_spi);
}

TEST(CapiXgate, AStateFitsAModuleWithTheSameSettingsOnly) {
  const auto chip = make_module();
  power_up(chip.get());
  std::vector<uint8_t> state(DPSIM_MAX_CHIP_STATE);
  size_t size = 0;
  ok(dpsim_chip_save(chip.get(), state.data(), state.size(), &size));
  const auto other = make_module(DPSIM_ENGINE_SKIP, 1);
  EXPECT_EQ(dpsim_chip_restore(other.get(), state.data(), size), DPSIM_ERR_INPUT);
  EXPECT_NE(std::string(dpsim_error_message()).find("port"), std::string::npos) << dpsim_error_message();
  for (const size_t at : {size_t{21}, size / 2, size - 1}) {
    state[at] ^= 1;
    EXPECT_EQ(dpsim_chip_restore(chip.get(), state.data(), size), DPSIM_ERR_INPUT);
    state[at] ^= 1;
  }
  EXPECT_EQ(now_of(chip.get()), 40 * kUs);
  ok(dpsim_chip_uart_open(chip.get(), kRate));
  ok(dpsim_chip_restore(chip.get(), state.data(), size));
  ok(dpsim_chip_advance(chip.get(), 50 * kUs));
  EXPECT_EQ(ask(chip.get(), frame(0x24)), error_frame(0x24, 4, 3));
}

void refused(dpsim_status status, dpsim_status wanted, const char* message) {
  EXPECT_EQ(status, wanted) << message;
  EXPECT_STREQ(dpsim_error_message(), message);
}

Owned<dpsim_chip> make_strapped(const char* kind, const std::vector<std::pair<const char*, dpsim_level>>& straps) {
  auto options = sized<dpsim_chip_options>();
  options.kind = kind;
  dpsim_chip* made = nullptr;
  ok(dpsim_chip_create(&options, &made));
  for (const auto& [name, level] : straps) {
    uint16_t number = 0;
    ok(dpsim_pin_find(kind, name, &number));
    ok(dpsim_chip_set(made, now_of(made), number, level));
  }
  ok(dpsim_chip_advance(made, 6000 * kCycle));
  return Owned<dpsim_chip>(made);
}

TEST(CapiSerial, OtherKindsAnswerByTheirPorts) {
  const auto rsu = make_strapped("dsdpv1_rsu", {{"MODE", 2}, {"ADR", 1}, {"UBR", 6}, {"RESET", 1}});
  ok(dpsim_chip_uart_open(rsu.get(), 460'800));
  send(rsu.get(), conformance::read_telegram(0x004, 1));
  const Bytes reply = hear(rsu.get(), 32, 5 * kMs);
  EXPECT_NE(std::find(reply.begin(), reply.end(), 0xC5), reply.end()) << testing::PrintToString(reply);

  const auto vpc3 = make_strapped("vpc3", {{"SERIAL", 1}, {"RESET", 1}, {"RESET", 0}});
  const uint8_t write[] = {0x12, 0x01, 0x00, 0x5A}, read[] = {0x13, 0x01, 0x00, 0xFF};
  uint8_t in[4] = {};
  uint64_t end = now_of(vpc3.get());
  ok(dpsim_chip_spi(vpc3.get(), end, nullptr, write, nullptr, 4, &end));
  ok(dpsim_chip_spi(vpc3.get(), end, nullptr, read, in, 4, &end));
  EXPECT_EQ(in[3], 0x5A);
  refused(dpsim_chip_uart_open(vpc3.get(), 9600), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_uart_open: a chip of this kind has no UART for its user");
}

TEST(CapiXgate, WhatOtherKindsHaveIsRefusedWithTheReason) {
  const auto chip = make_module();
  dpsim_level level = 0;
  uint8_t byte = 0;
  uint64_t end = 0;
  const std::string bus = "a chip of this kind has no parallel host bus";
  refused(dpsim_chip_sample(chip.get(), 0, &level), DPSIM_ERR_UNSUPPORTED, ("dpsim_chip_sample: " + bus).c_str());
  refused(dpsim_chip_read(chip.get(), 0, 0, nullptr, &level, &end), DPSIM_ERR_UNSUPPORTED,
          ("dpsim_chip_read: " + bus).c_str());
  refused(dpsim_chip_write(chip.get(), 0, 0, 0, nullptr, &end), DPSIM_ERR_UNSUPPORTED,
          ("dpsim_chip_write: " + bus).c_str());
  refused(dpsim_chip_load(chip.get(), 0, 0, &byte), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_load: a chip of this kind is accessed by the pins of its host bus or port");
  refused(dpsim_chip_peek(chip.get(), 0, &byte), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_peek: a chip of this kind shares no memory with its user");
  refused(dpsim_chip_poke(chip.get(), 0, 0), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_poke: a chip of this kind shares no memory with its user");
  auto options = sized<dpsim_checker_options>();
  options.kind = "xgate";
  dpsim_checker* checker = nullptr;
  const dpsim_status status = dpsim_checker_create(&options, &checker);
  EXPECT_EQ(status, dpsim_rule_count("xgate") == 0 ? DPSIM_ERR_UNSUPPORTED : DPSIM_OK) << dpsim_error_message();
  dpsim_checker_destroy(checker);
}

TEST(CapiXgate, SerialPortsAreRefusedWithTheReason) {
  const auto other = make_chip(), module = make_module(), by_spi = make_module(DPSIM_ENGINE_SKIP, 1);
  uint8_t byte = 0;
  size_t count = 0;
  uint64_t end = 0;
  refused(dpsim_chip_uart_open(other.get(), 9600), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_uart_open: a chip of this kind has no UART for its user");
  refused(dpsim_chip_spi(other.get(), 0, nullptr, &byte, nullptr, 1, &end), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_spi: a chip of this kind has no SPI for its user");
  refused(dpsim_chip_spi(module.get(), 0, nullptr, &byte, nullptr, 1, &end), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_spi: the parameter port chooses another port than SPI, expected 1");
  refused(dpsim_chip_uart_open(by_spi.get(), 9600), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_uart_open: the parameter port chooses another port than UART, expected 0");
  refused(dpsim_chip_uart_open(module.get(), 1199), DPSIM_ERR_ARGUMENT,
          "dpsim_chip_uart_open: rate is 1199, expected 1200 to 3000000");
  refused(dpsim_chip_uart_send(module.get(), 0, &byte, 1, &end), DPSIM_ERR_STATE,
          "dpsim_chip_uart_send: the UART is not open, call dpsim_chip_uart_open before");
  refused(dpsim_chip_spi(by_spi.get(), 0, nullptr, &byte, nullptr, 0, &end), DPSIM_ERR_ARGUMENT,
          "dpsim_chip_spi: count is 0, expected 1 to 4096");
  auto timing = sized<dpsim_spi_timing>();
  timing.bit = kMs + 1;
  refused(dpsim_chip_spi(by_spi.get(), 0, &timing, &byte, nullptr, 1, &end), DPSIM_ERR_ARGUMENT,
          "dpsim_chip_spi: bit is 12000001, expected 0 to 12000000");
  ok(dpsim_chip_uart_open(module.get(), kRate));
  ok(dpsim_chip_advance(module.get(), kUs));
  refused(dpsim_chip_uart_receive(module.get(), 0, &byte, 1, &count), DPSIM_ERR_TIME,
          "dpsim_chip_uart_receive: tick is 0, which is before the present tick 12000");
  refused(dpsim_chip_uart_send(module.get(), kUs, nullptr, 1, &end), DPSIM_ERR_ARGUMENT,
          "dpsim_chip_uart_send: bytes is NULL");
  refused(dpsim_chip_uart_open(make_strapped("dsdpv1_rsu", {}).get(), 9600), DPSIM_ERR_UNSUPPORTED,
          "dpsim_chip_uart_open: the strap MODE chooses another port than UART, expected 2");
}

}  // namespace
}  // namespace dsdpv1::capi_test
