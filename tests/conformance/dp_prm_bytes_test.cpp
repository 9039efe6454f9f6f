// Bytes and bits of Set_Prm one by one, and what B024 lets the master ask for: tables 12, 19, 21 and 25, written here a
// second time.
#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::conformance {
namespace {

/// Table 19 as it goes over the line.
Bytes table_19(std::uint8_t status, std::uint8_t wd1 = 1, std::uint8_t wd2 = 1, const Bytes& ident = {0x0C, 0xC9},
               const Bytes& user = {}) {
  Bytes bytes = {status, wd1, wd2, 11, ident.at(0), ident.at(1), 0};
  bytes.insert(bytes.end(), user.begin(), user.end());
  return bytes;
}

Init with_b024(unsigned command) {
  Init init;
  init.command = static_cast<std::uint8_t>(command);
  return init;
}

class PrmBytes : public Dpv1Test {
 protected:
  static constexpr std::uint8_t kPrmFault = 0x40, kNotSupported = 0x10;

  void expect_taken(const Bytes& bytes) {
    EXPECT_TRUE(is_sc(ask(bench, 61, bytes)));
    EXPECT_EQ(bench.dp_state(), DpState::kWaitCfg);
    EXPECT_EQ(diag(bench, 9).at(0) & (kPrmFault | kNotSupported), 0);
  }
  void expect_fault(const Bytes& bytes, Reason reason, int bits = kPrmFault) {
    const int before = bench.count(reason);
    EXPECT_TRUE(is_sc(ask(bench, 61, bytes)));
    EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
    EXPECT_EQ(bench.count(reason), before + 1);
    EXPECT_EQ(diag(bench, 9).at(0) & (kPrmFault | kNotSupported), bits);
  }
};

// Table 19, bytes 4 and 5.
TEST_F(PrmBytes, IdentIsBytesFourAndFiveHighByteFirst) {
  bench.to_wait_prm();
  expect_taken(table_19(0x80));
  expect_fault(table_19(0x80, 1, 1, {0xC9, 0x0C}), Reason::kPrmIdent);
  for (unsigned bit = 0; bit < 16; ++bit) {
    const unsigned ident = 0x0CC9U ^ 1U << bit;
    expect_fault(table_19(0x80, 1, 1, {static_cast<std::uint8_t>(ident >> 8), static_cast<std::uint8_t>(ident & 0xFF)}),
                 Reason::kPrmIdent);
  }
}

// The note under table 19.
TEST_F(PrmBytes, WatchdogFactorsAreOneTo255) {
  bench.to_wait_prm();
  for (unsigned factor = 1; factor < 256; ++factor) {
    SCOPED_TRACE(factor);
    expect_taken(table_19(0x88, static_cast<std::uint8_t>(factor), 255));
    EXPECT_EQ(bench.last(Reason::kWatchdogOn).a, factor * 255U);
    expect_taken(table_19(0x88, 255, static_cast<std::uint8_t>(factor)));
    EXPECT_EQ(bench.last(Reason::kWatchdogOn).a, factor * 255U);
  }
  for (const auto& [wd1, wd2] : {std::pair<int, int>{0, 1}, {1, 0}, {0, 255}, {255, 0}, {0, 0}})
    expect_fault(table_19(0x88, static_cast<std::uint8_t>(wd1), static_cast<std::uint8_t>(wd2)), Reason::kPrmWatchdog);
}

// 6.2.2: the user judges what follows them; of a telegram in which they are wrong it hears nothing.
TEST_F(PrmBytes, FirstSevenAreJudgedByTheChipInEveryMode) {
  for (const std::uint8_t mode : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}}) {
    SCOPED_TRACE(int{mode});
    SlaveBench one(quick_search());
    Init init = with_b024(0);
    init.prm_mode = mode;
    init.max_prm = 1;
    one.to_wait_prm(init);
    const Bytes user = {0};
    for (const auto& [bytes, reason] :
         {std::pair<Bytes, Reason>{table_19(0x80, 1, 1, {0x0C, 0xC8}, user), Reason::kPrmIdent},
          {table_19(0xA0, 1, 1, {0x0C, 0xC9}, user), Reason::kPrmSync},
          {table_19(0x90, 1, 1, {0x0C, 0xC9}, user), Reason::kPrmFreeze},
          {table_19(0x88, 0, 1, {0x0C, 0xC9}, user), Reason::kPrmWatchdog},
          {Bytes(6, 0x80), Reason::kPrmShort}}) {
      EXPECT_TRUE(is_sc(ask(one, 61, bytes)));
      EXPECT_EQ(one.count(reason), 1) << profibus::code(reason);
      EXPECT_EQ(diag(one, 9).at(0) & kPrmFault, kPrmFault);
      settle(one);
      EXPECT_EQ(one.peek(0x00E), 0) << "B00E.1";
      EXPECT_EQ(one.chip.level(Pin::kIntr0), 1);
    }
    ASSERT_TRUE(is_sc(ask(one, 61, table_19(0x80, 0, 0, {0x0C, 0xC9}, user))));
    settle(one);
    EXPECT_EQ(one.peek(0x00E), 0x02) << "right ones reach the user";
    EXPECT_EQ(one.dp_state(), mode == 2 ? DpState::kWaitPrm : DpState::kWaitCfg);
  }
}

// Table 25, bytes 0 to 6, with DPV1 on at both sides.
TEST_F(PrmBytes, FirstSevenAreThoseOfTable19WithDpv1Too) {
  const Bytes user = {0x80, 0, 0};
  bench.power_on();
  bench.enable_dpv1(true);
  ASSERT_TRUE(bench.initialise(with_b024(0)));
  bench.find_baud(0);
  expect_fault(table_19(0x80, 1, 1, {0x0D, 0xC9}, user), Reason::kPrmIdent);
  expect_fault(table_19(0x80, 1, 1, {0x0C, 0xC8}, user), Reason::kPrmIdent);
  expect_fault(table_19(0x88, 0, 1, {0x0C, 0xC9}, user), Reason::kPrmWatchdog);
  expect_fault(table_19(0xA0, 1, 1, {0x0C, 0xC9}, user), Reason::kPrmSync, kPrmFault | kNotSupported);
  expect_fault(table_19(0x90, 1, 1, {0x0C, 0xC9}, user), Reason::kPrmFreeze, kPrmFault | kNotSupported);
  Bytes right = table_19(0x88, 7, 9, {0x0C, 0xC9}, user);
  right[3] = 33;    // Min_Tsdr
  right[6] = 0x40;  // Group_Ident
  expect_taken(right);
  EXPECT_EQ(bench.last(Reason::kWatchdogOn).a, 63U);
  EXPECT_EQ(static_cast<int>(bench.fdl_status().tsdr_bits()), 33);
  ASSERT_TRUE(is_sc(ask(bench, 62, {0x11, 0x21})));
  tell(bench, bus::kBroadcast, 58, {0x02, 0xBF});
  EXPECT_EQ(bench.count(Reason::kGcOtherGroup), 1);
  tell(bench, bus::kBroadcast, 58, {0x02, 0x40});
  EXPECT_EQ(bench.count(Reason::kGlobalControl), 1);
}

// Tables 21 and 25, byte 7: each of its bits alone.
TEST_F(PrmBytes, Dpv1Status1HasThreeBitsAndTheRestIsReserved) {
  for (unsigned bit = 0; bit < 8; ++bit) {
    SCOPED_TRACE(bit);
    SlaveBench one(quick_search());
    one.power_on();
    one.enable_dpv1(true);
    ASSERT_TRUE(one.initialise());
    one.find_baud(0);
    const Bytes user = {static_cast<std::uint8_t>(1U << bit), 0, 0};
    ASSERT_TRUE(is_sc(ask(one, 61, table_19(0x88, 200, 1, {0x0C, 0xC9}, user))));
    EXPECT_EQ(one.last(Reason::kWatchdogOn).b, bit == 2 ? 1U : 10U) << "WD_Base";
    ASSERT_TRUE(is_sc(ask(one, 62, {0x11, 0x21})));
    EXPECT_EQ(kind_of(send_fc(one, kSrdFirst, kC1Sap, kC1Sap, {})), bit == 7 ? "SC" : "RS") << "DPV1_Enable";
    EXPECT_EQ(kind_of(ask(one, kNoSap, {})), bit == 6 ? "DL" : "RR") << "Fail_Safe";
  }
}

// Table 12, 4.1.5: each of the sixteen choices, with bits 4 to 7 all 0 and all 1; a bit says what the master may ask
// for, and nothing about the others.
TEST_F(PrmBytes, EachBitOfB024SupportsItsFunctionAlone) {
  struct Function {
    unsigned bit;
    Bytes prm;
    Reason reason;
  };
  const Function functions[] = {{0x02, table_19(0x90), Reason::kPrmFreeze},
                                {0x04, table_19(0xA0), Reason::kPrmSync},
                                {0x08, table_19(0x80, 1, 1, {0x0C, 0xC9}, {0x40}), Reason::kPrmFailSafe}};
  const Bytes other_address = {42, 0x0C, 0xC9, 0};
  bench.power_on();
  for (unsigned choice = 0; choice < 32; ++choice) {
    const unsigned command = choice < 16 ? choice : choice + 0xE0;  // reserved bits say nothing
    SCOPED_TRACE(command);
    ASSERT_TRUE(bench.initialise(with_b024(command)));
    bench.find_baud(0);
    for (const Function& function : functions)
      if ((command & function.bit) != 0)
        expect_taken(function.prm);
      else
        expect_fault(function.prm, function.reason, kPrmFault | kNotSupported);
    expect_taken(table_19(0x80));
    ask(bench, 61, table_19(0x40));  // Unlock: SAP 55 is for WAIT_PRM
    ASSERT_EQ(bench.dp_state(), DpState::kWaitPrm);
    EXPECT_EQ(kind_of(ask(bench, 55, other_address)), (command & 0x01) != 0 ? "SC" : "RS");
    EXPECT_EQ(bench.chip.status().address, (command & 0x01) != 0 ? 42 : 5);
    bench.address = 5;
  }
}

// 6.1: "all but SAP 55 and SAP 58", which the user switches on. For SAP 58: GlobalControl.WithB024Zero.
TEST_F(PrmBytes, WithB024ZeroEverySapButSap55IsServed) {
  bench.to_wait_prm(with_b024(0));
  EXPECT_EQ(kind_of(ask(bench, 55, {42, 0x0C, 0xC9, 0})), "RS");
  EXPECT_EQ(bench.count(Reason::kAddressDisabled), 1);
  EXPECT_EQ(kind_of(ask(bench, 61, table_19(0x80))), "SC");
  EXPECT_EQ(kind_of(ask(bench, 62, {0x11, 0x21})), "SC");
  for (const int sap : {kNoSap, 56, 57, 59, 60})
    EXPECT_EQ(kind_of(ask(bench, sap, sap == kNoSap ? Bytes{1, 2} : Bytes{})), "DL") << sap;
}

// Table 2, 02A; software manual 10.3.1.
TEST_F(PrmBytes, B02AOfZeroAllowsNoUserParameters) {
  for (const std::uint8_t mode : {std::uint8_t{0}, std::uint8_t{1}}) {
    SlaveBench one(quick_search());
    Init init;
    init.max_prm = 0;
    init.prm_mode = mode;
    one.to_wait_prm(init);
    EXPECT_TRUE(is_sc(ask(one, 61, table_19(0x80, 1, 1, {0x0C, 0xC9}, {0}))));
    EXPECT_EQ(one.count(Reason::kPrmUserLength), 1);
    EXPECT_EQ(one.dp_state(), DpState::kWaitPrm);
    EXPECT_TRUE(is_sc(ask(one, 61, table_19(0x80))));
    EXPECT_EQ(one.dp_state(), DpState::kWaitCfg);
    settle(one);
    EXPECT_EQ(one.peek(0x410), 0);
  }
}

}  // namespace
}  // namespace dsdpv1::conformance
