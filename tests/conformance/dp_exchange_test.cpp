// Data exchange: every size, wrong lengths, fail-safe, what the outputs are when DATA_EXCH is left (D10, S18 to S20).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

Bytes pattern(int size, int seed) {
  Bytes bytes;
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(i * 13 + seed));
  return bytes;
}

struct Size {
  const char* name;
  Bytes cfg;
  int inputs, outputs;
};

class ExchangeOf : public testing::TestWithParam<Size> {
 protected:
  void SetUp() override {
    Init init;
    init.cfg = GetParam().cfg;
    bench.to_data_exch(init);
  }
  SlaveBench bench{quick_search()};
};

TEST_P(ExchangeOf, CarriesEveryByteBothWays) {
  const Size& size = GetParam();
  for (int round = 0; round < 3; ++round) {
    const Bytes inputs = pattern(size.inputs, round + 1), outputs = pattern(size.outputs, round + 100);
    bench.give_inputs(inputs);
    const Exchange exchange = ask(bench, kNoSap, outputs);
    EXPECT_EQ(kind_of(exchange), size.inputs > 0 ? "DL" : "SC");
    EXPECT_EQ(exchange.answer().data, inputs);
    settle(bench);
    EXPECT_EQ(output_area(bench), outputs);
    if (size.outputs > 0) EXPECT_EQ(bench.fetch_outputs(), outputs);
    const Exchange read_inputs = ask(bench, 56);
    EXPECT_EQ(kind_of(read_inputs), size.inputs > 0 ? "DL" : "SC");
    EXPECT_EQ(read_inputs.answer().data, inputs);
    const Exchange read_outputs = ask(bench, 57);
    EXPECT_EQ(kind_of(read_outputs), size.outputs > 0 ? "DL" : "SC");
    EXPECT_EQ(read_outputs.answer().data, outputs);
  }
  EXPECT_EQ(bench.chip.status().data_exchanges, 3U);
}

TEST_P(ExchangeOf, SendsZerosUntilTheFirstInputs) {
  const Exchange exchange = ask(bench, kNoSap, pattern(GetParam().outputs, 1));
  EXPECT_EQ(exchange.answer().data, Bytes(static_cast<std::size_t>(GetParam().inputs), 0));
}

TEST_P(ExchangeOf, WithAnotherLengthIsRefusedAndEndsDataExchange) {
  for (const int error : {-1, 1, 244}) {
    const int length = std::min(GetParam().outputs + error, 244);
    if (length < 0 || length == GetParam().outputs) continue;
    SlaveBench one(quick_search());
    Init init;
    init.cfg = GetParam().cfg;
    one.to_data_exch(init);
    ask(one, kNoSap, pattern(GetParam().outputs, 1));
    const Exchange exchange = ask(one, kNoSap, pattern(length, 2));
    EXPECT_EQ(kind_of(exchange), "RR") << length;
    EXPECT_EQ(one.dp_state(), DpState::kWaitPrm);
    EXPECT_EQ(one.count(Reason::kOutputLength), 1);
    EXPECT_EQ(one.chip.status().master, 255);
    EXPECT_EQ(one.chip.status().data_exchanges, 1U);
    EXPECT_EQ(diag(one).at(0), 0x06);
    settle(one);
    EXPECT_EQ(output_area(one), Bytes(static_cast<std::size_t>(GetParam().outputs), 0));
    EXPECT_EQ(offline_count(one), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, ExchangeOf,
    testing::Values(Size{"In0Out0", {0x00}, 0, 0}, Size{"In1Out0", {0x10}, 1, 0}, Size{"In0Out1", {0x20}, 0, 1},
                    Size{"In8Out8", {0x37}, 8, 8}, Size{"In2Out5", {0x11, 0x24}, 2, 5},
                    Size{"In244Out0", {0x40, 0x7F, 0x40, 0x79}, 244, 0},
                    Size{"In0Out244", {0x80, 0x7F, 0x80, 0x79}, 0, 244},
                    Size{"In244Out244", {0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0x79}, 244, 244}),
    [](const auto& at) { return at.param.name; });

class Exchanges : public testing::Test {
 protected:
  SlaveBench bench{quick_search()};
};

TEST_F(Exchanges, NewestOutputsWinAndAreMarked) {
  bench.to_data_exch();
  for (int i = 1; i <= 5; ++i) ask(bench, kNoSap, {static_cast<std::uint8_t>(i), 0});
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{5, 0}));
  EXPECT_EQ(bench.fetch_outputs(), std::nullopt);
  ask(bench, kNoSap, {5, 0});
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{5, 0})) << "the same values are new outputs too";
}

TEST_F(Exchanges, InputsOfAnotherLengthAreRefusedAndTheEarlierStay) {
  bench.to_data_exch();
  bench.give_inputs({1, 2});
  for (const Bytes& wrong : {Bytes{}, {9}, {9, 9, 9}, Bytes(244, 9)}) bench.give_inputs(wrong);
  EXPECT_EQ(bench.count(Reason::kInputLength), 4);
  EXPECT_EQ(ask(bench, kNoSap, {0, 0}).answer().data, (Bytes{1, 2}));
  EXPECT_EQ(bench.peek(0x010), 0);
}

TEST_F(Exchanges, InputsWithAWrongCrcAreRefusedAndTheEarlierStay) {
  bench.to_data_exch();
  bench.give_inputs({1, 2});
  bench.give_inputs({3, 4}, 0x8000);
  EXPECT_EQ(bench.peek(0x00B) & 0x04, 0x04);
  EXPECT_EQ(ask(bench, kNoSap, {0, 0}).answer().data, (Bytes{1, 2}));
  bench.give_inputs({5, 6});
  EXPECT_EQ(bench.peek(0x00B) & 0x04, 0);
  EXPECT_EQ(ask(bench, kNoSap, {0, 0}).answer().data, (Bytes{5, 6}));
}

TEST_F(Exchanges, InputsGivenBeforeDataExchangeAreSentInTheFirstOne) {
  bench.to_wait_prm();
  bench.give_inputs({0x21, 0x43});
  ask(bench, 61, Prm{}.bytes());
  ask(bench, 62, {0x11, 0x21});
  EXPECT_EQ(ask(bench, kNoSap, {0, 0}).answer().data, (Bytes{0x21, 0x43}));
}

TEST_F(Exchanges, InputsAreZeroAgainWhenTheirLengthHasChanged) {
  bench.to_data_exch();
  bench.give_inputs({0x21, 0x43});
  ask(bench, 61, Prm{}.bytes());
  ask(bench, 62, {0x12, 0x21});
  EXPECT_EQ(ask(bench, kNoSap, {0, 0}).answer().data, (Bytes{0, 0, 0}));
  bench.give_inputs({1, 2});
  EXPECT_EQ(bench.count(Reason::kInputLength), 1);
  bench.give_inputs({1, 2, 3});
  EXPECT_EQ(ask(bench, kNoSap, {0, 0}).answer().data, (Bytes{1, 2, 3}));
}

TEST_F(Exchanges, UserWhoHoldsTheDpramDelaysNoAnswer) {
  bench.to_data_exch();
  bench.give_inputs({1, 2});
  bench.acquire();
  for (int i = 0; i < 5; ++i) {
    const Exchange exchange = ask(bench, kNoSap, {static_cast<std::uint8_t>(i), 7});
    EXPECT_EQ(exchange.answer().data, (Bytes{1, 2}));
    EXPECT_EQ(static_cast<int>(exchange.tsdr_bits()), 11);
  }
  const std::pair<int, Bytes> reads[] = {{56, {1, 2}}, {57, {4, 7}}, {59, {0x11, 0x21}}};
  for (const auto& [sap, data] : reads) {
    const Exchange exchange = ask(bench, sap);
    EXPECT_EQ(exchange.answer().data, data) << sap;
    EXPECT_EQ(static_cast<int>(exchange.tsdr_bits()), 11) << sap;
  }
  bench.release();
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{4, 7}));
}

// --- fail-safe

Prm fail_safe() {
  Prm prm;
  prm.user = {0x40};
  return prm;
}

TEST_F(Exchanges, EmptyOutputsInFailSafeClear) {
  bench.to_data_exch({}, fail_safe());
  bench.give_inputs({8, 9});
  ask(bench, kNoSap, {1, 2});
  settle(bench);
  bench.fetch_outputs();
  const Exchange exchange = ask(bench, kNoSap, {});
  EXPECT_EQ(kind_of(exchange), "DL");
  EXPECT_EQ(exchange.answer().data, (Bytes{8, 9}));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(bench.count(Reason::kFailSafeClear), 1);
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0}));
  EXPECT_EQ(ask(bench, 57).answer().data, (Bytes{0, 0}));
  EXPECT_EQ(offline_count(bench), 0);
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {3, 4})), "DL");
  settle(bench);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{3, 4}));
}

TEST_F(Exchanges, EmptyOutputsWithoutFailSafeAreAWrongLength) {
  bench.to_data_exch();
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {})), "RR");
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Exchanges, OtherLengthsInFailSafeAreStillWrong) {
  bench.to_data_exch({}, fail_safe());
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {1})), "RR");
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(Exchanges, FailSafeEndsWithTheNextSetPrmWithoutIt) {
  bench.to_data_exch({}, fail_safe());
  ask(bench, 61, Prm{}.bytes());
  ask(bench, 62, {0x11, 0x21});
  EXPECT_EQ(kind_of(ask(bench, kNoSap, {})), "RR");
}

// --- leaving DATA_EXCH (S18)

TEST_F(Exchanges, LeavingClearsTheOutputsTellsTheUserAndCounts) {
  struct Way {
    const char* name;
    int dsap;
    Bytes request;
  };
  Prm unlock, wrong, good;
  unlock.status = 0x40;
  wrong.ident = 0;
  for (const Way& way : {Way{"good Set_Prm", 61, good.bytes()},
                         {"wrong Set_Prm", 61, wrong.bytes()},
                         {"Unlock", 61, unlock.bytes()},
                         {"other Check_Cfg", 62, {0x12, 0x21}},
                         {"wrong output length", kNoSap, {1, 2, 3}}}) {
    SCOPED_TRACE(way.name);
    SlaveBench one(quick_search());
    one.to_data_exch();
    ask(one, kNoSap, {0xA5, 0x5A});
    settle(one);
    ASSERT_EQ(one.fetch_outputs(), (Bytes{0xA5, 0x5A}));
    ask(one, way.dsap, way.request);
    EXPECT_NE(one.dp_state(), DpState::kDataExch);
    EXPECT_EQ(one.chip.level(Pin::kPbf), 1);
    settle(one);
    EXPECT_EQ(one.fetch_outputs(), (Bytes{0, 0}));
    EXPECT_EQ(offline_count(one), 1);
    EXPECT_TRUE(is_rs(ask(one, 57))) << "S13";
  }
}

TEST_F(Exchanges, OutputsAreZeroWhenDataExchangeIsEnteredAgain) {
  bench.to_data_exch();
  ask(bench, kNoSap, {0xA5, 0x5A});
  ask(bench, 61, Prm{}.bytes());
  ask(bench, 62, {0x11, 0x22});
  ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_EQ(ask(bench, 57).answer().data, (Bytes{0, 0, 0}));
}

}  // namespace
}  // namespace dsdpv1::conformance
