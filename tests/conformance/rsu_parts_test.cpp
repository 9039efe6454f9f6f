// Which chip has what: pins, straps, dead ports (R1, R2, R10, R11, R14).
#include "tests/conformance/rsu_bench.hpp"
#include "tests/conformance/slave_bench.hpp"

namespace dsdpv1::conformance {
namespace {

using R = dsdpv1::Reason;

// Table 1 of the datasheet, with PBRTS as P2 has it and a row for each direction of D, and R2.
TEST(RsuParts, Pins) {
  EXPECT_EQ(pin_count(Part::kDsdpv1), 18);
  EXPECT_EQ(pin_count(Part::kR), 18);
  EXPECT_EQ(pin_count(Part::kRsu), 28);
  EXPECT_EQ(outputs_of(Part::kR), kOutputPins);
  struct Case {
    Pin pin;
    const char* name;
    int width;
    bool input;
  };
  for (const Case& each : {Case{Pin::kPbf, "PBF", 1, false},     Case{Pin::kBr, "BR", 1, false},
                           Case{Pin::kReady, "READY", 1, false}, Case{Pin::kLReq, "L_REQ", 1, false},
                           Case{Pin::kLSta, "L_STA", 1, false},  Case{Pin::kRReq, "R_REQ", 1, true},
                           Case{Pin::kRSta, "R_STA", 1, true},   Case{Pin::kA, "A", 11, true},
                           Case{Pin::kRd, "RD", 1, true},        Case{Pin::kWr, "WR", 1, true},
                           Case{Pin::kDIn, "D_IN", 8, true},     Case{Pin::kDOut, "D_OUT", 8, false},
                           Case{Pin::kIntr0, "INTR0", 1, false}, Case{Pin::kCsr, "CSR", 1, true},
                           Case{Pin::kReset, "RESET", 1, true},  Case{Pin::kPbtxd, "PBTXD", 1, false},
                           Case{Pin::kPbrts, "PBRTS", 1, false}, Case{Pin::kPbrxd, "PBRXD", 1, true},
                           Case{Pin::kXss, "XSS", 1, true},      Case{Pin::kSck, "SCK", 1, true},
                           Case{Pin::kMosi, "MOSI", 1, true},    Case{Pin::kMiso, "MISO", 1, false},
                           Case{Pin::kRxd, "RXD", 1, true},      Case{Pin::kTxd, "TXD", 1, false},
                           Case{Pin::kMode, "MODE", 2, true},    Case{Pin::kAdr, "ADR", 2, true},
                           Case{Pin::kUbr, "UBR", 3, true},      Case{Pin::kUiv, "UIV", 3, true}}) {
    EXPECT_STREQ(name(each.pin), each.name);
    EXPECT_EQ(width(each.pin), each.width) << each.name;
    EXPECT_EQ(is_input(each.pin), each.input) << each.name;
  }
}

TEST(RsuParts, PinsBeginAtTheLevelsOfTheirRows) {
  Config config;
  config.part = Part::kRsu;
  const Chip chip(config);
  for (int i = 0; i < kRsuPinCount; ++i)
    EXPECT_EQ(chip.level(static_cast<Pin>(i)), kPinRows[i].level) << kPinRows[i].name;
}

TEST(RsuParts, AreFoundByTheirNames) {
  for (const Part part : {Part::kDsdpv1, Part::kR, Part::kRsu}) EXPECT_EQ(part_called(row(part).name), part);
  EXPECT_EQ(part_called("dsdpv1_x"), std::nullopt);
}

TEST(RsuParts, OtherPartsHaveNoStraps) {
  for (const Part part : {Part::kDsdpv1, Part::kR}) {
    Config config;
    config.part = part;
    Chip chip(config);
    chip.set(0, Pin::kMode, 1);
    chip.set(5000, Pin::kReset, 1);
    chip.advance(2100 * 250);
    EXPECT_EQ(chip.mode(), HostMode::kParallel);
    EXPECT_EQ(chip.level(Pin::kMode), 0);
    chip.set(2100 * 250, Pin::kXss, 0);
    EXPECT_EQ(chip.level(Pin::kMiso), kLevelZ);
  }
}

TEST(RsuStraps, ChooseAtR) {
  const HostMode modes[] = {HostMode::kParallel, HostMode::kSpi, HostMode::kUart, HostMode::kParallel};
  for (Level mode = 0; mode < 4; ++mode) {
    Straps straps;
    straps.mode = static_cast<HostMode>(mode);
    RsuBench bench(straps);
    bench.set(5000, Pin::kReset, 1);
    bench.run_until(23 * 250 - 1);
    EXPECT_EQ(bench.mode(), HostMode::kParallel) << "before R";
    bench.run_until(23 * 250);
    EXPECT_EQ(bench.mode(), modes[mode]);
  }
}

TEST(RsuStraps, LaterChangesAreReported) {
  RsuBench bench;
  bench.power_on();
  bench.set(bench.now() + 77, Pin::kMode, 2);
  EXPECT_EQ(bench.last(R::kStrapChanged).a, 0);
  EXPECT_EQ(bench.last(R::kStrapChanged).b, 2);
  EXPECT_EQ(bench.last(R::kStrapChanged).c, 1);
  EXPECT_EQ(bench.last(R::kStrapChanged).at, bench.now());
  bench.set(bench.now(), Pin::kUiv, 5);
  EXPECT_EQ(bench.last(R::kStrapChanged).a, 3);
  EXPECT_EQ(bench.mode(), HostMode::kSpi);
  bench.reset_for(20);
  bench.run_cycles(10);
  EXPECT_EQ(bench.mode(), HostMode::kUart);
  EXPECT_EQ(bench.count(R::kStrapChanged), 2);
}

TEST(RsuStraps, CardAddress) {
  for (Level address = 0; address < 4; ++address) {
    Straps straps;
    straps.address = address;
    RsuBench bench(straps);
    bench.power_on();
    for (std::uint8_t card = 0; card < 4; ++card) {
      const Bytes reply = bench.ask(read_telegram(0x000, 1, card), 5);
      const bool own = card == address && (card == 1 || card == 2);
      EXPECT_EQ(reply[0], own ? 0x80 | card : 0xFF) << address << " " << int{card};
      const Bytes written = bench.ask(write_telegram(0x014, {0x00}, card), 4);
      EXPECT_EQ(written[0], own ? 0xA0 | card : 0xFF) << address << " " << int{card};
      const Bytes refused = bench.ask(read_telegram(0x800, 1, card), 4);
      EXPECT_EQ(refused[0], own ? 0xE0 | card : 0xFF) << address << " " << int{card};
    }
  }
}

// R14: the parallel port is dead in SPI and UART mode, and nothing waits for R_REQ or R_STA.
TEST(RsuPorts, ParallelPortIsDead) {
  for (const HostMode mode : {HostMode::kSpi, HostMode::kUart}) {
    Straps straps;
    straps.mode = mode;
    RsuBench bench(straps);
    bench.set(0, Pin::kRReq, 1);
    bench.set(0, Pin::kRSta, 1);
    bench.power_on();
    EXPECT_EQ(bench.peek(0x000), 0x01) << "the start-up access waits for no one";
    EXPECT_GT(bench.status().accesses, 1U);
    bench.set(bench.now(), Pin::kCsr, 0);
    bench.set(bench.now(), Pin::kRd, 0);
    bench.run_cycles(10);
    EXPECT_EQ(bench.level(Pin::kDOut), kLevelZ);
    bench.set(bench.now(), Pin::kRd, 1);
    bench.set(bench.now(), Pin::kA, 0x100);
    bench.set(bench.now(), Pin::kDIn, 0x55);
    bench.set(bench.now(), Pin::kWr, 0);
    bench.run_cycles(10);
    bench.set(bench.now(), Pin::kWr, 1);
    bench.run_cycles(10);
    EXPECT_EQ(bench.peek(0x100), 0);
    EXPECT_TRUE(bench.changes(Pin::kLReq).empty());
    EXPECT_TRUE(bench.changes(Pin::kLSta).empty());
    EXPECT_TRUE(bench.changes(Pin::kDOut).empty());
    EXPECT_TRUE(bench.events().empty() || bench.events()[0].reason == dpram::Reason::kReadyFlag);
  }
}

TEST(RsuPorts, SerialPinsAreNotLookedAtInParallelMode) {
  Straps straps;
  straps.mode = HostMode::kParallel;
  RsuBench bench(straps);
  bench.power_on();
  bench.forget_events();
  bench.spi(read_telegram(0x000, 1));
  bench.send(read_telegram(0x000, 1));
  bench.run_cycles(5000);
  EXPECT_TRUE(bench.changes(Pin::kMiso).empty());
  EXPECT_TRUE(bench.changes(Pin::kTxd).empty());
  EXPECT_FALSE(bench.changes(Pin::kLSta).empty());
}

TEST(RsuPorts, OtherSerialPortIsDead) {
  RsuBench spi;
  spi.power_on();
  spi.send(read_telegram(0x000, 1));
  spi.run_cycles(5000);
  EXPECT_TRUE(spi.changes(Pin::kTxd).empty());
  EXPECT_EQ(spi.level(Pin::kTxd), 1);
  Straps straps;
  straps.mode = HostMode::kUart;
  RsuBench uart(straps);
  uart.power_on();
  uart.spi(write_telegram(0x100, {7}));
  uart.run_cycles(5000);
  EXPECT_TRUE(uart.changes(Pin::kMiso).empty());
  EXPECT_EQ(uart.level(Pin::kMiso), kLevelZ);
  EXPECT_EQ(uart.peek(0x100), 0);
}

/// B014 to B01F, after the start-up.
constexpr std::uint16_t kFirstOfSerial = 0x014, kLastOfSerial = 0x01F;

TEST(RsuPorts, CellsOfTheSerialPortsArePlainRamInParallelMode) {
  Config config;
  config.part = Part::kRsu;
  SlaveBench bench(config);
  bench.power_on();
  bench.acquire();
  for (std::uint16_t cell = kFirstOfSerial; cell <= kLastOfSerial; ++cell) {
    EXPECT_EQ(bench.read(cell), 0) << cell;
    bench.write(cell, 0xFF);
  }
  bench.chip_accesses(5);
  EXPECT_EQ(bench.peek(kFirstOfSerial, 12), Bytes(12, 0xFF));
}

TEST(RsuPorts, CellsWithoutAUseAreZeroAndThenPlainRamInSerialModes) {
  for (const HostMode mode : {HostMode::kSpi, HostMode::kUart}) {
    Straps straps;
    straps.mode = mode;
    RsuBench bench(straps);
    bench.power_on();
    const bool spi = mode == HostMode::kSpi;
    if (spi) bench.claim();
    for (std::uint16_t cell = kFirstOfSerial; cell <= kLastOfSerial; ++cell) {
      if (spi ? cell == 0x014 : cell == 0x019 || cell == 0x01A) {
        if (!spi) EXPECT_EQ(bench.peek(cell), 0) << cell;
        continue;
      }
      const auto ask = [&bench, spi](const Bytes& request, std::size_t reply) {
        return spi ? bench.ask(request, reply) : bench.talk(request);
      };
      EXPECT_EQ(ask(read_telegram(cell, 1), 5), with_crc({0x81, 0x00, 0x00})) << cell;
      EXPECT_EQ(ask(write_telegram(cell, {0xFF}), 4), with_crc({0xA1, 0x00})) << cell;
      EXPECT_EQ(ask(read_telegram(cell, 1), 5), with_crc({0x81, 0x00, 0xFF})) << cell;
    }
    if (spi) bench.release();
    bench.run_cycles(500);
    EXPECT_EQ(bench.peek(0x015, 4), Bytes(4, 0xFF));
    EXPECT_EQ(bench.peek(0x01B, 5), Bytes(5, 0xFF));
  }
}

TEST(RsuPorts, ModeChangesWithEachReset) {
  RsuBench bench;
  bench.power_on();
  for (const Level mode : std::vector<Level>{0, 2, 1, 3, 1, 0}) {
    bench.set(bench.now(), Pin::kReset, 0);
    bench.set(bench.now(), Pin::kMode, mode);
    bench.run_cycles(30);
    bench.set(bench.now(), Pin::kReset, 1);
    bench.run_cycles(3000);
    EXPECT_EQ(bench.peek(0x000), 0x01);
  }
}

TEST(RsuParts, PinsOfTheParallelPortDisturbNoSerialOne) {
  RsuBench bench;
  bench.power_on();
  bench.claim();
  const Bytes bytes = {1, 2, 3, 4, 5, 6, 7, 8};
  bench.spi(write_telegram(0x400, bytes));
  for (const Level level : {Level{0}, Level{1}}) {  // while the bytes go into the DPRAM
    bench.run_cycles(3);
    for (const Pin pin : {Pin::kCsr, Pin::kRd, Pin::kWr}) bench.set(bench.now() + 1, pin, level);
    bench.set(bench.now() + 1, Pin::kA, level);
  }
  bench.run_cycles(100);
  EXPECT_EQ(bench.peek(0x400, 8), bytes);
}

}  // namespace
}  // namespace dsdpv1::conformance
