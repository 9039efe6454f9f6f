// The host's line: times of UART, lost bytes, gaps, SPI; /Rst, /ISP-CFG, the watchdog and LEDs (4.3.1, 4.7, X2 to X26).
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

TEST(XgateUart, AnAnswerAfterTheDelayByteByByte) {
  ModuleBench bench;
  bench.put(frame(0x01, {1}));
  const Cycle complete = bench.now;
  EXPECT_EQ(bench.hear(), frame(0x01, {1, 0}));
  for (std::size_t i = 0; i < bench.begins.size(); ++i)
    EXPECT_EQ(bench.begins[i], complete + 300 + static_cast<Cycle>(i) * kByte);
  EXPECT_EQ(bench.heard_until, complete + 300 + 7 * kByte);
}

TEST(XgateUart, BytesBeforeTheAnswerHasLeftAreLost) {
  ModuleBench bench;
  bench.put(frame(0x01, {1}));
  EXPECT_EQ(bench.send(frame(0x01, {2})), frame(0x01, {1, 0})) << "the answer to the first";
  ASSERT_FALSE(bench.events.empty());
  EXPECT_STREQ(code(bench.events.front().reason), "XGATE_LOST");
  bench.run(10'000);
  EXPECT_EQ(bench.ask(0x01, {2}), bench.wrong(0x01, error::kOverflow));
  EXPECT_EQ(bench.ask(0x01, {2}), frame(0x01, {1, 0}));
}

TEST(XgateUart, AGapEndsAFrame) {
  ModuleBench bench;
  bench.put({0x7E});
  bench.run(5'001);
  EXPECT_EQ(bench.ask(0x01, {1}), frame(0x01, {1, 0})) << "a start alone is nothing";
  for (const std::size_t size : {2U, 3U, 4U, 5U}) {
    Bytes part = frame(0x16, {0x00, 0x00});
    part.resize(size);
    EXPECT_EQ(bench.send(part), bench.wrong(0x16, error::kTooFew)) << size;
  }
  bench.put({0x7E, 0x01, 0x01, 0x11, 0x01});
  bench.run(4'999 - kByte);
  EXPECT_EQ(bench.send({0x6E}), frame(0x01, {1, 0})) << "in time";
}

TEST(XgateUart, ASlowLineHasLongerGaps) {
  Config config = ModuleBench::quick();
  config.rate = 19'200;  // 10 characters are 250 000 cycles
  ModuleBench bench(config);
  bench.byte_time = 250'000 - 1;
  EXPECT_EQ(bench.ask(0x01, {1}), frame(0x01, {1, 0}));
}

TEST(XgateReset, NothingBeforeTheFirmwareRuns) {
  ModuleBench bench;
  bench.to_exchange();
  EXPECT_TRUE(bench.int_low());
  bench.reset(true);
  EXPECT_FALSE(bench.int_low());
  EXPECT_TRUE(bench.ask(0x01, {1}).empty());
  bench.reset(false);
  bench.run(999 - 6 * kByte);
  bench.put(frame(0x01, {1}));  // ends before the firmware listens
  EXPECT_EQ(bench.module->state(), ModuleState::kPower);
  EXPECT_TRUE(bench.hear().empty());
  EXPECT_EQ(bench.module->state(), ModuleState::kReady);
  EXPECT_EQ(bench.ask(0x20, {1, 2, 3}), bench.wrong(0x20, error::kNotConnected)) << "as new";
  EXPECT_EQ(bench.ask(0x13, {1, 1}), bench.wrong(0x13, error::kResource)) << "without a command 04";
}

TEST(XgateReset, ConfigurationModeHasNoFrames) {
  ModuleBench bench;
  bench.reset(true);
  bench.module->set_config_pin(true);
  bench.reset(false);
  bench.run(2'000);
  EXPECT_EQ(bench.module->state(), ModuleState::kConfiguring);
  EXPECT_TRUE(bench.ask(0x01, {1}).empty());
  EXPECT_EQ(bench.levels[5], bench.levels[6]) << "LED2 blinks in both colours";
  const std::size_t before = bench.changes.size();
  bench.run(1'000 * profibus::kCyclesPerMs);
  EXPECT_EQ(bench.changes.size() - before, 8U) << "2 Hz";
}

TEST(XgateWatchdog, StoredOrOfTheHost) {
  for (const WatchdogUse use : {WatchdogUse::kStored, WatchdogUse::kHost}) {
    Config config = ModuleBench::quick();
    config.watchdog = use;
    ModuleBench bench(config);
    bench.to_exchange();
    bench.ask(0x21, {1, 2, 3});
    ASSERT_EQ(bench.ask(0x16, {0x80, 2}), frame(0x16, {}));
    bench.run(19 * profibus::kCyclesPerMs);
    EXPECT_TRUE(bench.exchanging());
    EXPECT_FALSE(bench.int_low());
    bench.run(2 * profibus::kCyclesPerMs);
    const bool bites = use == WatchdogUse::kHost;
    EXPECT_EQ(bench.exchanging(), !bites);
    EXPECT_EQ(bench.int_low(), bites);
    bench.ask(0x01, {1});
    EXPECT_FALSE(bench.int_low());
  }
}

TEST(XgateLights, ShowStatesInSelfControl) {
  ModuleBench bench;
  const auto lights = [&](bool blinks) {  // at the lit half of a period
    if (blinks) bench.run(500 * profibus::kCyclesPerMs - bench.now % (500 * profibus::kCyclesPerMs));
    return Bytes{static_cast<std::uint8_t>(bench.levels[3]), static_cast<std::uint8_t>(bench.levels[4]),
                 static_cast<std::uint8_t>(bench.levels[5]), static_cast<std::uint8_t>(bench.levels[6])};
  };
  EXPECT_EQ(lights(true), Bytes({0, 0, 0, 0})) << "ready";
  bench.ask(0x04, ModuleBench::initialisation());
  EXPECT_EQ(lights(false), Bytes({1, 1, 1, 0})) << "WAIT_PRM; a command";
  bench.diagnosis();
  bench.set_prm(ModuleBench::prm());
  bench.run(60'000);
  EXPECT_EQ(lights(false), Bytes({0, 1, 0, 0})) << "WAIT_CFG";
  bench.service(62, ModuleBench::cfg());
  EXPECT_EQ(lights(true), Bytes({1, 0, 0, 1})) << "data exchange";
  bench.ask(0x20, {1, 2, 3});
  EXPECT_EQ(lights(false), Bytes({1, 0, 1, 0})) << "and the host's";
}

// --- SPI -------------------------------------------------------------------------------------------------------------

class XgateSpi : public testing::Test {
 protected:
  static Config config() {
    Config config = ModuleBench::quick();
    config.port = Port::kSpi;
    return config;
  }
  std::uint8_t transfer(std::uint8_t mosi) { return bench.transfer(mosi); }
  Bytes transfer(const Bytes& mosi) { return bench.transfer(mosi); }
  ModuleBench bench{config()};
};

TEST_F(XgateSpi, TheHostsClockFetchesTheAnswer) {
  EXPECT_EQ(transfer(frame(0x01, {1})), Bytes(6, 0xFF));
  EXPECT_FALSE(bench.int_low());
  EXPECT_EQ(transfer(Bytes(3, 0x7E)), Bytes(3, 0xFF)) << "not ready; what the host sends is nothing";
  bench.run(300);
  EXPECT_TRUE(bench.int_low());
  EXPECT_EQ(transfer(Bytes(7, 0x7E)), frame(0x01, {1, 0}));
  EXPECT_FALSE(bench.int_low());
  EXPECT_EQ(transfer(0x00), 0xFF);
  EXPECT_EQ(transfer(frame(0x01, {3})), Bytes(6, 0xFF)) << "no byte was lost";
  bench.run(300);
  EXPECT_EQ(transfer(Bytes(7)), frame(0x01, {0, 1}));
}

TEST_F(XgateSpi, NssCutsAByte) {
  const Bytes sent = frame(0x01, {1});
  for (std::size_t i = 0; i < sent.size(); ++i) {
    static_cast<void>(bench.module->begin_byte());
    if (i == 2)
      bench.module->cut_byte();
    else
      bench.module->end_byte(bench.now, sent[i]);
  }
  bench.run(6'000);
  EXPECT_EQ(transfer(Bytes(8)), bench.wrong(0x01, error::kTooFew)) << "a byte is missing";
  transfer(sent);
  bench.run(300);
  Bytes heard = {transfer(0)};
  EXPECT_EQ(bench.module->begin_byte(), 0x01);
  bench.module->cut_byte();
  EXPECT_EQ(heard + transfer(Bytes(6)), frame(0x01, {1, 0})) << "a byte of the answer that is cut comes again";
}

TEST_F(XgateSpi, BytesThatBeginBeforeTheAnswerAreNoneOfIt) {
  transfer(frame(0x01, {1}));
  bench.run(300 - 10);
  EXPECT_EQ(transfer(0), 0xFF) << "it has become ready in this byte";
  EXPECT_EQ(transfer(Bytes(7)), frame(0x01, {1, 0}));
}

}  // namespace
}  // namespace dsdpv1::xgate
