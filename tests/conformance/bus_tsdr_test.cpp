// The time from the request's last stop bit to the answer's start bit, on the wire (S3, S11).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

/// The answer began so many bit times after the request and at most one cycle later.
bool is_tsdr(const Exchange& exchange, int bits) {
  const Tick late = exchange.tsdr() - bits * exchange.bit;
  return late > 0 && late <= kCycleTicks;
}

class Tsdr : public testing::TestWithParam<int> {
 protected:
  Tick bit() const { return bus::baud(GetParam()).bit; }
  int largest() const { return bus::baud(GetParam()).max_tsdr_bits; }
  void set(int min_tsdr) {
    Prm prm;
    prm.min_tsdr = static_cast<std::uint8_t>(min_tsdr);
    ASSERT_TRUE(is_sc(ask(bench, 61, prm.bytes())));
  }
  /// FDL status at five phases of CLK: the answer begins `bits` after the request, up to one cycle later (S3).
  void expect_tsdr(int bits) {
    for (const Tick phase : {0, 1, 100, 200, 249}) {
      const Tick at = (bench.now() + 60 * bit()) / kCycleTicks * kCycleTicks + phase;
      const Exchange exchange = bench.requester.send(bench.timeline, bus::make_telegram(5, 2, kFdlStatus), {.at = at});
      ASSERT_TRUE(exchange.answered());
      // P9: the chip sees an edge at the first CLK edge strictly after it, so the answer's bits lie on the next grid
      // of cycles.
      EXPECT_EQ(exchange.tsdr(), bits * bit() + kCycleTicks - phase) << bits << " bits, phase " << phase;
    }
    bench.chip.compare(bench.now());
  }

  SlaveBench bench{quick_search()};
};

TEST_P(Tsdr, IsElevenBitsBeforeTheParametersAreSet) {
  bench.to_wait_prm({}, GetParam());
  expect_tsdr(11);
}

TEST_P(Tsdr, IsWhatSetPrmSaysBetweenElevenAndTheLargest) {
  bench.to_wait_prm({}, GetParam());
  for (const int value : {11, 12, 37, 59, 60, 61, 100, 255}) {
    set(value);
    expect_tsdr(std::min(value, largest()));
  }
}

TEST_P(Tsdr, BelowElevenCountsAsEleven) {
  bench.to_wait_prm({}, GetParam());
  for (const int value : {1, 5, 10}) {
    set(40);
    set(value);
    expect_tsdr(11);
  }
}

TEST_P(Tsdr, ZeroLeavesTheEarlierOne) {
  bench.to_wait_prm({}, GetParam());
  set(0);
  expect_tsdr(11);
  set(42);
  set(0);
  expect_tsdr(42);
}

TEST_P(Tsdr, IsTheSameForEveryKindAndLengthOfAnswer) {
  Init init;
  init.cfg = {0x5F, 0x5F, 0x5F, 0x5F, 0x5F, 0x5F, 0x5F, 0x59, 0x20};  // 244 input bytes, 1 output byte
  bench.to_data_exch(init, {}, GetParam());
  set(33);
  ASSERT_TRUE(is_sc(ask(bench, 62, init.cfg)));
  const auto expect = [this](const Exchange& exchange) {
    ASSERT_TRUE(exchange.answered());
    EXPECT_TRUE(is_tsdr(exchange, 33)) << exchange.tsdr_bits();
  };
  const Exchange longest = ask(bench, kNoSap, {1});
  EXPECT_EQ(longest.answer().data.size(), 244U);
  expect(longest);
  expect(ask(bench, 60));                 // diagnosis
  expect(ask(bench, 62, init.cfg));       // SC
  expect(ask(bench, 40, {1}));            // RS
  expect(ask(bench, 62, Bytes(201, 1)));  // RR
}

INSTANTIATE_TEST_SUITE_P(AllRates, Tsdr, testing::Range(0, bus::kBaudCount),
                         [](const auto& at) { return "Code" + std::to_string(at.param); });

TEST(TsdrSetting, IsChangedAloneWithoutLockAndUnlock) {
  SlaveBench bench(quick_search());
  bench.to_data_exch();
  Prm prm;
  prm.status = 0x00;
  prm.min_tsdr = 77;
  ASSERT_TRUE(is_sc(ask(bench, 61, prm.bytes())));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  const Exchange exchange = ask(bench, kNoSap, {1, 2});
  EXPECT_TRUE(is_tsdr(exchange, 77)) << exchange.tsdr_bits();
}

TEST(TsdrSetting, HoldsFromTheAnswerToItsSetPrmOn) {
  SlaveBench bench(quick_search());
  bench.to_wait_prm();
  Prm prm;
  prm.min_tsdr = 60;
  EXPECT_TRUE(is_tsdr(ask(bench, 61, prm.bytes()), 60));
}

TEST(TsdrSetting, HoldsFromTheVerdictOnWhenTheUserJudges) {
  SlaveBench bench(quick_search());
  Init init;
  init.prm_mode = 2;
  bench.to_wait_prm(init);
  Prm prm;
  prm.min_tsdr = 60;
  EXPECT_TRUE(is_tsdr(ask(bench, 61, prm.bytes()), 11));
  bench.chip_accesses(3);
  bench.verdict(true, std::nullopt);
  EXPECT_TRUE(is_tsdr(bench.fdl_status(), 60));
}

TEST(TsdrSetting, LastsUntilANewInitialisation) {
  SlaveBench bench(quick_search());
  Prm prm;
  prm.min_tsdr = 50;
  bench.to_data_exch({}, prm);
  EXPECT_EQ(static_cast<int>(bench.fdl_status().tsdr_bits()), 50);
  ASSERT_TRUE(bench.initialise());
  bench.find_baud(0);
  EXPECT_EQ(static_cast<int>(bench.fdl_status().tsdr_bits()), 11);
}

TEST(TsdrSetting, IsClampedByTheRateThatRunsNotByTheOneAtWhichItWasSet) {
  dsdpv1::Config config = quick_search();
  config.baud_control_ms = 5;
  SlaveBench bench(config);
  Prm prm;
  prm.min_tsdr = 200;
  bench.to_data_exch({}, prm, 0);
  EXPECT_EQ(static_cast<int>(bench.fdl_status().tsdr_bits()), 200);
  bench.run_ms(6);
  bench.find_baud(5);
  EXPECT_EQ(static_cast<int>(bench.fdl_status().tsdr_bits()), 60);
  bench.run_ms(6);
  bench.find_baud(2);
  EXPECT_EQ(static_cast<int>(bench.fdl_status().tsdr_bits()), 200);
}

}  // namespace
}  // namespace dsdpv1::conformance
