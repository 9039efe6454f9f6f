// SPI by the tick: shift register, limits, moments of XSS (SP1 to SP3, SP7; docs/microarchitecture_rsu.md 5.1, 5.7).
#include "tests/conformance/rsu_bench.hpp"

namespace dsdpv1::conformance {
namespace {

using R = dsdpv1::Reason;

class RsuSpiFrame : public ::testing::Test {
 protected:
  void SetUp() override {
    bench_.power_on();
    bench_.run_until(4300 * 250 + 77);  // B004 is C5
    bench_.forget_events();
  }
  /// A read of the version in a frame with these times; all violations that it has.
  std::vector<profibus::Event> violations(const RsuBench::Frame& frame) {
    bench_.forget_events();
    Bytes mosi = read_telegram(0x014, 1);
    mosi.resize(11, 0xFF);
    reply_ = part_of(bench_.spi(mosi, frame), 6, 5);
    bench_.run_until(bench_.now() + 10'000);
    return bench_.events();
  }
  RsuBench bench_;
  Bytes reply_;
};

TEST_F(RsuSpiFrame, LegalLimits) {
  EXPECT_TRUE(violations({600, 600, 600, 600}).empty());
  EXPECT_EQ(part_of(reply_, 0, 2), (Bytes{0x81, 0x00}));
}

TEST_F(RsuSpiFrame, SckTooFast) {
  const auto high = violations({599, 601, 601, 600});
  ASSERT_EQ(high.size(), 88U);
  EXPECT_EQ(high[0].reason, R::kSpiSckHigh);
  EXPECT_EQ(high[0].a, 599);
  EXPECT_EQ(high[0].b, 600);
  const auto low = violations({700, 599, 600, 600});
  ASSERT_EQ(low.size(), 87U);
  EXPECT_EQ(low[0].reason, R::kSpiSckLow);
  EXPECT_EQ(low[0].a, 599);
  EXPECT_EQ(part_of(reply_, 0, 2), (Bytes{0x81, 0x00})) << "the chip goes on with what it captured";
}

TEST_F(RsuSpiFrame, XssLeadAndLag) {
  auto found = violations({600, 599, 599, 600});
  EXPECT_EQ(found.at(0).reason, R::kSpiXssLead);
  EXPECT_EQ(found.at(0).a, 599);
  found = violations({600, 600, 600, 599});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].reason, R::kSpiXssLag);
  EXPECT_EQ(found[0].a, 599);
}

TEST_F(RsuSpiFrame, XssHigh) {
  bench_.spi(Bytes(1, 0x02));
  bench_.run_until(bench_.now() + 599);
  bench_.spi(Bytes(1, 0x02));
  EXPECT_EQ(bench_.last(R::kSpiXssHigh).a, 599);
  bench_.run_until(bench_.now() + 600);
  bench_.spi(Bytes(1, 0x02));
  EXPECT_EQ(bench_.count(R::kSpiXssHigh), 1);
}

TEST_F(RsuSpiFrame, SckHighWhenXssChanges) {
  bench_.set(bench_.now(), Pin::kSck, 1);
  bench_.run_cycles(10);
  bench_.xss(0);
  EXPECT_EQ(bench_.last(R::kSpiSckIdle).a, 0);
  bench_.run_cycles(10);
  bench_.set(bench_.now(), Pin::kSck, 0);
  bench_.run_cycles(10);
  bench_.set(bench_.now(), Pin::kSck, 1);
  bench_.run_cycles(10);
  bench_.xss(1);
  EXPECT_EQ(bench_.last(R::kSpiSckIdle).a, 1);
  EXPECT_EQ(bench_.last(R::kSpiBits).a, 1);
  bench_.run_cycles(10);
  bench_.set(bench_.now(), Pin::kSck, 0);
  bench_.run_cycles(10);
  EXPECT_EQ(violations({}).size(), 0U);
  EXPECT_EQ(part_of(reply_, 0, 2), (Bytes{0x81, 0x00}));
}

TEST_F(RsuSpiFrame, BitsOfAFrame) {
  bench_.spi({0x01, 0x00, 0x14}, {600, 600, 600, 600, 5, false});
  bench_.run_cycles(10);
  EXPECT_EQ(bench_.last(R::kSpiBits).a, 5);
  EXPECT_EQ(bench_.last(R::kSpiBits).b, 2);
  EXPECT_EQ(bench_.last(R::kTelegramCut).a, 2);
  EXPECT_EQ(bench_.last(R::kTelegramCut).b, 6);
}

TEST_F(RsuSpiFrame, SetupAndHoldOfMosi) {
  const auto rise = [&](Tick change, Level level) {
    bench_.run_until(bench_.now() + 1000);
    bench_.set(bench_.now(), Pin::kMosi, level);
    bench_.run_until(bench_.now() + change);
    bench_.set(bench_.now(), Pin::kSck, 1);
  };
  const auto fall = [&] {
    bench_.run_until(bench_.now() + 600);
    bench_.set(bench_.now(), Pin::kSck, 0);
  };
  bench_.xss(0);
  rise(150, 1);
  EXPECT_EQ(bench_.count(R::kSpiMosiSetup), 0);
  fall();
  rise(149, 0);
  EXPECT_EQ(bench_.last(R::kSpiMosiSetup).a, 149);
  EXPECT_EQ(bench_.last(R::kSpiMosiSetup).c, 1);
  bench_.run_until(bench_.now() + 149);
  bench_.set(bench_.now(), Pin::kMosi, 1);
  EXPECT_EQ(bench_.last(R::kSpiMosiHold).a, 149);
  EXPECT_EQ(bench_.last(R::kSpiMosiHold).c, 1);
  fall();
  // at the tick of the rise, told before or after it: a hold of 0, and the level of before is taken
  bench_.run_until(bench_.now() + 1000);
  bench_.set(bench_.now(), Pin::kMosi, 0);
  bench_.set(bench_.now(), Pin::kSck, 1);
  EXPECT_EQ(bench_.last(R::kSpiMosiHold).a, 0);
  EXPECT_EQ(bench_.last(R::kSpiMosiHold).c, 2);
  fall();
  bench_.run_until(bench_.now() + 1000);
  bench_.set(bench_.now(), Pin::kSck, 1);
  bench_.set(bench_.now(), Pin::kMosi, 1);
  EXPECT_EQ(bench_.last(R::kSpiMosiHold).c, 3);
  EXPECT_EQ(bench_.count(R::kSpiMosiHold), 3);
}

// MOSI that changes at the tick of SCK's rise: the telegram is that of the levels before.
TEST_F(RsuSpiFrame, MosiAtTheTickOfTheRise) {
  const Bytes telegram = write_telegram(0x100, {0x5A});
  std::vector<int> bits;
  for (const std::uint8_t byte : telegram)
    for (int i = 7; i >= 0; --i) bits.push_back(byte >> i & 1);
  bench_.xss(0);
  bench_.set(bench_.now(), Pin::kMosi, static_cast<Level>(bits[0]));
  for (std::size_t i = 0; i < bits.size(); ++i) {
    bench_.run_until(bench_.now() + 600);
    const auto next = static_cast<Level>(i + 1 < bits.size() ? bits[i + 1] : 0);
    if (i % 2 == 0) bench_.set(bench_.now(), Pin::kMosi, next);
    bench_.set(bench_.now(), Pin::kSck, 1);
    if (i % 2 != 0) bench_.set(bench_.now(), Pin::kMosi, next);
    bench_.run_until(bench_.now() + 600);
    bench_.set(bench_.now(), Pin::kSck, 0);
  }
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.peek(0x100), 0x5A);
  bench_.xss(1);
}

// An edge of SCK at the tick of XSS's rise counts, whichever is reported first; one at the tick of its fall does not.
TEST_F(RsuSpiFrame, EdgesAtTheTickOfXss) {
  for (const bool xss_first : {false, true}) {
    bench_.forget_events();
    bench_.poke(0x100, 0);
    const Bytes telegram = write_telegram(0x100, {0x5A});
    // XSS and SCK change together: this rise does not count
    const auto both = [&](Level xss, Level sck) {
      if (xss_first) bench_.xss(xss);
      bench_.set(bench_.now(), Pin::kSck, sck);
      if (!xss_first) bench_.xss(xss);
    };
    bench_.run_cycles(200);
    both(0, 1);
    bench_.run_cycles(4);
    bench_.set(bench_.now(), Pin::kSck, 0);
    bench_.run_cycles(4);
    bench_.clock(part_of(telegram, 0, telegram.size() - 1));
    const std::uint8_t last = telegram.back();
    for (int i = 7; i >= 0; --i) {
      bench_.set(bench_.now(), Pin::kMosi, static_cast<Level>(last >> i & 1));
      bench_.run_cycles(3);
      if (i > 0) {
        bench_.set(bench_.now(), Pin::kSck, 1);
        bench_.run_cycles(3);
        bench_.set(bench_.now(), Pin::kSck, 0);
      } else {
        both(1, 1);  // the last rise with XSS's
      }
    }
    bench_.run_cycles(200);
    EXPECT_EQ(bench_.peek(0x100), 0x5A) << xss_first;
    EXPECT_EQ(bench_.last(R::kSpiBits).a, 7) << "as it stood strictly before";
    bench_.set(bench_.now(), Pin::kSck, 0);
    bench_.run_cycles(200);
  }
}

// A pulse of XSS that no edge of CLK samples does not end the frame, but starts the byte again.
TEST_F(RsuSpiFrame, ShortPulseOfXss) {
  bench_.run_until(5000 * 250 + 10);
  bench_.xss(0);
  bench_.run_until(bench_.now() + 600);
  bench_.clock({0xFF}, {600, 600, 600, 600, 3, true});
  bench_.run_until(6000 * 250 + 10);
  bench_.xss(1);
  bench_.run_until(6000 * 250 + 200);
  EXPECT_EQ(bench_.level(Pin::kMiso), kLevelZ);
  bench_.xss(0);
  bench_.run_until(bench_.now() + 600);
  bench_.clock(read_telegram(0x014, 1));
  EXPECT_EQ(part_of(bench_.clock(Bytes(5, 0xFF)), 0, 2), (Bytes{0x81, 0x00}));
  EXPECT_EQ(bench_.count(R::kTelegramCut), 0);
  bench_.xss(1);
}

TEST_F(RsuSpiFrame, MisoDelay) {
  Config config;
  config.spi_miso_delay = 600;
  RsuBench bench({}, config);
  bench.power_on();
  bench.run_until(1'000'000);
  bench.spi({0x01, 0x00, 0x14, 0x01, 0x18, 0xCF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}, {700, 700, 700, 700});
  std::vector<Tick> at;
  for (const PinChange& change : bench.changes(Pin::kMiso)) at.push_back(change.at);
  // fall 49 is 700 after rise 49 = 1'000'700 + 48 * 1400
  EXPECT_EQ(at.at(1), 1'000'700 + 48 * 1400 + 700 + 600);
}

// In reset and before XSS has once been high nothing is heard.
TEST(RsuSpiListening, XssLowThroughReset) {
  RsuBench bench;
  bench.set(100, Pin::kXss, 0);
  bench.set(5000, Pin::kReset, 1);
  bench.run_until(2200 * 250);
  EXPECT_EQ(bench.level(Pin::kMiso), kLevelZ);
  bench.clock(read_telegram(0x014, 1));
  bench.clock(Bytes(5, 0xFF));
  EXPECT_TRUE(bench.changes(Pin::kMiso).empty());
  EXPECT_TRUE(bench.events().empty());
  bench.xss(1);
  bench.run_cycles(10);
  EXPECT_EQ(part_of(bench.ask(read_telegram(0x014, 1), 5), 0, 2), (Bytes{0x81, 0x00}));
}

TEST_F(RsuSpiFrame, ResetReleasesMisoAndForgets) {
  bench_.claim();
  bench_.spi({0x01, 0x00}, {600, 600, 600, 600, 0, true});
  EXPECT_NE(bench_.level(Pin::kMiso), kLevelZ);
  bench_.reset_for(20);
  EXPECT_EQ(bench_.level(Pin::kMiso), kLevelZ);
  bench_.run_cycles(2200);
  EXPECT_EQ(bench_.peek(0x014), 0);
  EXPECT_EQ(bench_.level(Pin::kMiso), kLevelZ) << "XSS has not been high since";
  bench_.xss(1);
  bench_.run_cycles(10);
  EXPECT_EQ(part_of(bench_.ask(read_telegram(0x014, 1), 5), 0, 2), (Bytes{0x81, 0x00}));
}

}  // namespace
}  // namespace dsdpv1::conformance
