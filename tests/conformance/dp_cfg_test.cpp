// Check_Cfg judged by the chip: modes 0 and 1, identifier formats, lengths, repetition in operation (D6, D8, S14 to
// S17).
#include <gtest/gtest.h>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

constexpr std::uint8_t kCfgFault = 0x04;

class CheckCfg : public testing::Test {
 protected:
  Exchange cfg(const Bytes& bytes) { return ask(bench, 62, bytes); }
  bool cfg_fault() { return (diag(bench, 9).at(0) & kCfgFault) != 0; }
  /// Parameters again where a refusal took the slave to WAIT_PRM.
  void again() {
    if (bench.dp_state() == DpState::kWaitCfg) return;
    ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));
  }
  void expect_refused(const Bytes& bytes, Reason reason) {
    again();
    const int before = bench.count(reason);
    EXPECT_TRUE(is_sc(cfg(bytes)));
    EXPECT_EQ(bench.count(reason), before + 1) << testing::PrintToString(bytes);
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
    EXPECT_EQ(bench.chip.status().master, 255);
    EXPECT_TRUE(cfg_fault());
  }
  void expect_accepted(const Bytes& bytes, int inputs, int outputs) {
    again();
    EXPECT_TRUE(is_sc(cfg(bytes)));
    ASSERT_EQ(bench.dp_state(), DpState::kDataExch) << testing::PrintToString(bytes);
    EXPECT_FALSE(cfg_fault());
    settle(bench);
    EXPECT_EQ(bench.peek(0x500), outputs) << testing::PrintToString(bytes);
    EXPECT_EQ(bench.peek(0x501), inputs) << testing::PrintToString(bytes);
    EXPECT_EQ(bench.peek(0x502), static_cast<int>(bytes.size()));
    EXPECT_EQ(bench.peek(0x503, static_cast<int>(bytes.size())), bytes);
    const Exchange exchange = ask(bench, kNoSap, Bytes(static_cast<std::size_t>(outputs), 0x11));
    EXPECT_EQ(kind_of(exchange), inputs > 0 ? "DL" : "SC");
    EXPECT_EQ(exchange.answer().data, Bytes(static_cast<std::size_t>(inputs), 0));
  }

  SlaveBench bench{quick_search()};
};

TEST_F(CheckCfg, ModeZeroTakesEveryLengthUpToB02C) {
  Init init;
  init.max_cfg = 4;
  bench.to_wait_cfg(init);
  expect_accepted({0x10}, 1, 0);
  expect_accepted({0x10, 0x20}, 1, 1);
  expect_accepted({0x10, 0x20, 0x30}, 2, 2);
  expect_accepted({0x10, 0x20, 0x30, 0x30}, 3, 3);
  expect_refused({0x10, 0x20, 0x30, 0x30, 0x00}, Reason::kCfgLength);
  expect_refused({}, Reason::kCfgLength);
  expect_refused(Bytes(200, 0), Reason::kCfgLength);
}

// S16: not that of the initialisation, which is another one here.
TEST_F(CheckCfg, InDataExchangeTheConfigurationInUseIsTheOneThatCounts) {
  bench.to_wait_cfg();
  expect_accepted({0x10, 0x20}, 1, 1);
  EXPECT_TRUE(is_sc(cfg({0x10, 0x20})));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  EXPECT_TRUE(is_sc(cfg(Init{}.cfg)));
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_TRUE(cfg_fault());
}

TEST_F(CheckCfg, ModeOneTakesOnlyTheInitialConfiguration) {
  Init init;
  init.cfg_mode = 1;
  init.cfg = {0x11, 0x21, 0x30};
  bench.to_wait_cfg(init);
  for (std::size_t i = 0; i < 3; ++i) {
    Bytes wrong = init.cfg;
    wrong[i] ^= 0x80;  // the consistency only: the lengths stay
    expect_refused(wrong, Reason::kCfgDiffers);
  }
  expect_refused({0x11, 0x21}, Reason::kCfgDiffers);
  expect_refused({0x11, 0x21, 0x30, 0x00}, Reason::kCfgDiffers);
  expect_refused({0x21, 0x11, 0x30}, Reason::kCfgDiffers);
  expect_accepted({0x11, 0x21, 0x30}, 3, 3);
}

TEST_F(CheckCfg, ModeOneRefusesAnEmptyConfiguration) {
  Init init;
  init.cfg_mode = 1;
  bench.to_wait_cfg(init);
  EXPECT_TRUE(is_sc(cfg({})));
  EXPECT_TRUE(cfg_fault());
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST_F(CheckCfg, CompactIdentifiersHaveOneToSixteenBytesOrWords) {
  bench.to_wait_cfg();
  for (int count = 1; count <= 16; ++count) {
    for (const int flags : {0x00, 0x40, 0x80, 0xC0}) {  // words, consistency
      const int bytes = count * ((flags & 0x40) != 0 ? 2 : 1);
      const auto byte = [&](int direction) { return static_cast<std::uint8_t>(flags | direction | (count - 1)); };
      expect_accepted({byte(0x10)}, bytes, 0);
      expect_accepted({byte(0x20)}, 0, bytes);
      expect_accepted({byte(0x30)}, bytes, bytes);
    }
  }
}

TEST_F(CheckCfg, SpecialIdentifiersHaveLengthBytesOutputFirst) {
  bench.to_wait_cfg();
  expect_accepted({0x40, 0x00}, 1, 0);
  expect_accepted({0x40, 0x3F}, 64, 0);
  expect_accepted({0x40, 0x7F}, 128, 0);  // words
  expect_accepted({0x40, 0xBF}, 64, 0);   // consistent
  expect_accepted({0x80, 0x04}, 0, 5);
  expect_accepted({0x80, 0xC4}, 0, 10);
  expect_accepted({0xC0, 0x02, 0x06}, 7, 3);
  expect_accepted({0xC0, 0x7F, 0x3F}, 64, 128);
}

TEST_F(CheckCfg, SpecialIdentifiersMayCarryVendorBytes) {
  bench.to_wait_cfg();
  expect_accepted({0x43, 0x01, 0xAA, 0xBB, 0xCC}, 2, 0);
  expect_accepted({0xC1, 0x01, 0x02, 0xFF, 0x10}, 4, 2);
  Bytes fourteen = {0x8E, 0x00};
  fourteen.insert(fourteen.end(), 14, 0x3F);
  expect_accepted(fourteen, 0, 1);
  expect_accepted({0x4F, 0x01, 0x20}, 2, 1);  // 15: no vendor bytes
}

TEST_F(CheckCfg, EmptySlotsCountNothing) {
  bench.to_wait_cfg();
  expect_accepted({0x00}, 0, 0);
  expect_accepted({0x00, 0x11, 0x00, 0x21, 0x00}, 2, 2);
  expect_accepted({0x02, 0x11, 0x11, 0x21}, 0, 2);  // an empty slot with two vendor bytes
}

TEST_F(CheckCfg, IncompleteIdentifiersAreRefused) {
  bench.to_wait_cfg();
  for (const Bytes& bytes : {Bytes{0x40}, {0x80}, {0xC0}, {0xC0, 0x00}, {0x41, 0x00}, {0x10, 0x42, 0x01, 0x01}, {0x01}})
    expect_refused(bytes, Reason::kCfgUndecodable);
}

TEST_F(CheckCfg, LengthsAboveB027AndB028AreRefused) {
  Init init;
  init.max_input = 4;
  init.max_output = 6;
  bench.to_wait_cfg(init);
  expect_accepted({0x13, 0x25}, 4, 6);
  expect_refused({0x14, 0x25}, Reason::kCfgIoLength);
  expect_refused({0x13, 0x26}, Reason::kCfgIoLength);
  expect_refused({0x13, 0x25, 0x10}, Reason::kCfgIoLength);
}

// D8: modes 0 and 1 only.
TEST_F(CheckCfg, LengthsAboveB027AndB028AreTheUsersToJudgeInModeTwo) {
  Init init;
  init.cfg_mode = 2;
  init.max_input = 4;
  init.max_output = 6;
  bench.to_wait_cfg(init);
  EXPECT_TRUE(is_sc(cfg({0x14, 0x26})));
  settle(bench);
  EXPECT_EQ(bench.count(Reason::kCfgIoLength), 0);
  EXPECT_EQ(bench.peek(0x500, 3), (Bytes{7, 5, 2}));
  bench.verdict(std::nullopt, true);
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(CheckCfg, MoreThan244BytesAreRefused) {
  bench.to_wait_cfg();
  expect_accepted({0x40, 0x7F, 0x40, 0x79}, 244, 0);
  expect_refused({0x40, 0x7F, 0x40, 0x79, 0x10}, Reason::kCfgIoLength);
  expect_accepted({0x80, 0x7F, 0x80, 0x79}, 0, 244);
  expect_refused({0x80, 0x7F, 0x80, 0x79, 0x20}, Reason::kCfgIoLength);
  expect_refused(Bytes(200, 0x7F), Reason::kCfgIoLength);                // 6400 bytes each way: sums must not wrap
  expect_refused({0x40, 0x7F, 0x40, 0x7F, 0x10}, Reason::kCfgIoLength);  // 257 = 1 modulo 256
}

TEST_F(CheckCfg, LongerThan200BytesIsAnsweredRrAndChangesNothing) {
  bench.to_wait_cfg();
  EXPECT_TRUE(is_rr(cfg(Bytes(201, 0))));
  EXPECT_TRUE(is_rr(cfg(Bytes(244, 0))));
  EXPECT_EQ(bench.count(Reason::kCfgTooLong), 2);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
  EXPECT_FALSE(cfg_fault());
  expect_accepted(Bytes(200, 0), 0, 0);
  EXPECT_TRUE(is_rr(cfg(Bytes(201, 0))));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
}

TEST_F(CheckCfg, FaultFallsWithTheNextGoodOneNotWithSetPrm) {
  bench.to_wait_cfg();
  expect_refused({0x40}, Reason::kCfgUndecodable);
  again();
  EXPECT_TRUE(cfg_fault());
  EXPECT_TRUE(is_sc(cfg({0x11, 0x21})));
  EXPECT_FALSE(cfg_fault());
}

// --- in DATA_EXCH (S16)

class CheckCfgInOperation : public CheckCfg, public testing::WithParamInterface<int> {};

// Micro-architecture, section 11: cleared outputs that still wait when a configuration without outputs is accepted.
TEST_F(CheckCfg, WaitingOutputsAreDroppedByAConfigurationWithoutOutputs) {
  bench.to_data_exch();
  settle(bench);
  bench.fetch_outputs();
  bench.acquire();
  ASSERT_TRUE(is_sc(ask(bench, 61, Prm{}.bytes())));  // leaves DATA_EXCH: the cleared outputs wait
  ASSERT_TRUE(is_sc(cfg({0x11})));
  ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  bench.release();
  settle(bench);
  EXPECT_EQ(bench.peek(0x00E) & 0x01, 0);
}

TEST_P(CheckCfgInOperation, TheConfigurationInUseIsAcceptedAgain) {
  Init init;
  init.cfg_mode = static_cast<std::uint8_t>(GetParam());
  bench.to_data_exch(init);
  ASSERT_TRUE(is_data(ask(bench, kNoSap, {4, 5})));
  settle(bench);
  EXPECT_TRUE(is_sc(cfg({0x11, 0x21})));
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  settle(bench);
  EXPECT_EQ(offline_count(bench), 0);
  EXPECT_TRUE(is_data(ask(bench, kNoSap, {6, 7})));
}

TEST_P(CheckCfgInOperation, AnythingElseIsAFault) {
  for (const Bytes& other : {Bytes{0x21, 0x11}, {0x11}, {0x11, 0x21, 0x00}, {0x91, 0x21}, {}}) {
    SlaveBench one(quick_search());
    Init init;
    init.cfg_mode = static_cast<std::uint8_t>(GetParam());
    one.to_data_exch(init);
    ASSERT_TRUE(is_data(ask(one, kNoSap, {4, 5})));
    EXPECT_TRUE(is_sc(ask(one, 62, other)));
    EXPECT_EQ(one.dp_state(), DpState::kWaitPrm) << testing::PrintToString(other);
    EXPECT_EQ(one.chip.status().master, 255);
    EXPECT_EQ(diag(one).at(0) & kCfgFault, kCfgFault);
    settle(one);
    EXPECT_EQ(output_area(one), (Bytes{0, 0}));
    EXPECT_EQ(offline_count(one), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, CheckCfgInOperation, testing::Values(0, 1),
                         [](const auto& at) { return "Mode" + std::to_string(at.param); });

}  // namespace
}  // namespace dsdpv1::conformance
