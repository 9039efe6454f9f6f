// A DSDPV1-RSU on the bus: what its host hears by SPI and UART of what a master does, and the other way round.
#include "tests/conformance/rsu_bench.hpp"
#include "tests/conformance/slave_bench.hpp"

namespace dsdpv1::conformance {
namespace {

Config rsu() {
  Config config;
  config.part = Part::kRsu;
  return config;
}

constexpr std::uint8_t kUserJudges = 2;

/// A slave with one input and one output byte, whose host is at the UART.
class RsuUartOnBus : public ::testing::Test {
 protected:
  RsuUartOnBus() {
    bench_.chip.set(0, Pin::kMode, 2);
    bench_.chip.set(0, Pin::kAdr, 1);
    bench_.chip.set(0, Pin::kUbr, 7);
  }
  void SetUp() override {
    bench_.power_on();
    initialise({});
    ASSERT_TRUE(bench_.set_prm({}).answered());
    ASSERT_TRUE(bench_.check_cfg({0x10, 0x20}).answered());
  }
  void initialise(Init init) {
    init.cfg = {0x10, 0x20};
    write(0x020, init.block());
    write(0x010, {0x04});
    bench_.run_cycles(200);
    ASSERT_EQ(bench_.peek(0x00A) & 1, 1);
    bench_.find_baud();
  }
  void send(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      const unsigned frame =
          static_cast<unsigned>(byte) << 1 | static_cast<unsigned>(__builtin_popcount(byte) & 1) << 9 | 1U << 10;
      for (int i = 0; i < 11; ++i) {
        bench_.chip.set(bench_.now(), Pin::kRxd, static_cast<Level>(frame >> i & 1));
        bench_.run_cycles(26);
      }
    }
  }
  void write(std::uint16_t address, const Bytes& data) {
    send(write_telegram(address, data));
    bench_.run_cycles(26 * 11 * 8);
  }
  Bytes sent_since(Tick from) {
    const std::vector<PinChange> txd = bench_.changes(Pin::kTxd);
    const auto level_at = [&](Tick at) {
      Level level = 1;
      for (const PinChange& change : txd)
        if (change.at <= at) level = change.level;
      return level;
    };
    Bytes bytes;
    for (Tick start = from; level_at(start) == 0; start += Tick{11} * 26 * 250) {
      unsigned byte = 0;
      for (int i = 1; i < 9; ++i) byte |= static_cast<unsigned>(level_at(start + (i * 26 + 13) * 250)) << (i - 1);
      bytes.push_back(static_cast<std::uint8_t>(byte));
    }
    return bytes;
  }
  SlaveBench bench_{rsu()};
};

// docs/microarchitecture_rsu.md, section 10.
TEST_F(RsuUartOnBus, WorkedExampleToTheCycle) {
  bool beg_is_judgement = false;
  for (int i = 0; i < 12 && !beg_is_judgement; ++i) {
    ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
    write(0x00E, {0x00});
    write(0x00F, {0x00});
    ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
    bench_.run_cycles(100 + 5 * i);
    ASSERT_EQ(bench_.peek(0x00E), 0x01);
    ASSERT_EQ(bench_.peek(0x319, 2), (Bytes{0x01, 0xAA}));
    const Cycle start = bench_.now() / 250 + 10;  // S = 10000 of the example
    bench_.run_until((start - 2) * 250 - 100);
    send({0x41, 0x00, 0x01, 0x30, 0x02, 0x01, 0x55, 0xAB, 0x18});
    const auto at = [start](Cycle cycle) { return (start + cycle - 10'000) * 250; };
    // 12571 and 12572 are over already: the last stop bit ends at 12572 as the line has it
    bench_.run_until(at(20'000));
    std::vector<PinChange> txd;
    for (const PinChange& change : bench_.changes(Pin::kTxd))
      if (change.at > at(10'000)) txd.push_back(change);
    ASSERT_FALSE(txd.empty());
    EXPECT_EQ(txd.front().at, at(12'858));
    EXPECT_EQ(sent_since(txd.front().at), (Bytes{0x01, 0x01, 0x03, 0x19, 0x02, 0x01, 0xAA, 0x62, 0x69}));
    EXPECT_EQ(bench_.peek(0x00E), 0x00);
    EXPECT_EQ(bench_.peek(0x130, 2), (Bytes{0x01, 0x55}));
    beg_is_judgement = true;
  }
  EXPECT_EQ(bench_.data_exchange({0xAB}).answer().data, Bytes{0x55}) << "the master has the inputs";
}

TEST_F(RsuUartOnBus, NewParametersAndConfiguration) {
  ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
  bench_.run_cycles(200);
  Tick from = bench_.now();
  const auto exchange = [&] {
    from = bench_.now();
    send(exchange_telegram(0, 0x130, {0x01, 0x12}));
    bench_.run_cycles(26 * 11 * 40);
    for (const PinChange& change : bench_.changes(Pin::kTxd))
      if (change.at >= from) return sent_since(change.at);
    return Bytes{};
  };
  EXPECT_EQ(part_of(exchange(), 0, 4), (Bytes{0x01, 0x11, 0x04, 0x10}));
  EXPECT_EQ(exchange(), with_crc({0x01, 0x21, 0x05, 0x00, 0x05, 0x01, 0x01, 0x02, 0x10, 0x20}));
  EXPECT_EQ(exchange(), with_crc({0x01, 0x01, 0x03, 0x19, 0x02, 0x01, 0xAA}));
}

// UA15: judging mode 2, the verdicts by write telegrams to B00C, then B010.
TEST_F(RsuUartOnBus, VerdictByAWrite) {
  Init init;
  init.prm_mode = init.cfg_mode = kUserJudges;
  initialise(init);
  ASSERT_TRUE(bench_.set_prm({}).answered());
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.peek(0x00E) & 0x02, 0x02);
  write(0x00C, {0x00});
  write(0x010, {0x80});
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.dp_state(), DpState::kWaitCfg);
  ASSERT_TRUE(bench_.check_cfg({0x10, 0x20}).answered());
  bench_.run_cycles(200);
  write(0x00C, {0x02});
  write(0x010, {0x40});
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.dp_state(), DpState::kWaitPrm) << "refused";
}

}  // namespace
}  // namespace dsdpv1::conformance
