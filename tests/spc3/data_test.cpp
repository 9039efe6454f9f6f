// Data exchange, Read_Inputs, Read_Outputs and Global_Control (docs/spc3.md, "Dout", "Din"; A28, A29, A38, A46 to A48,
// A56).
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

using spc3::Reason;

constexpr std::uint8_t kSync = 0x20, kUnsync = 0x10, kFreeze = 0x08, kUnfreeze = 0x04, kClear = 0x02;
constexpr std::uint8_t kLockSyncFreeze = 0xB0;

/// DATA_EX, with Sync and Freeze asked for, group 1.
void to_data_ex(Bench& bench, const Organisation& given = {}) {
  bench.to_wait_prm(given);
  bench.set_prm({}, kLockSyncFreeze, 0, 0, 0, 0x01);
  bench.check_cfg();
  bench.load(regs::kCfgOk);
  bench.give_inputs(Bytes(given.inputs, 0x10));
  bench.run_cycles(2);
  ASSERT_EQ(bench.state(), DpState::kDataExch);
  bench.exchange(Bytes(given.outputs, 0x01));
  bench.fetch_outputs();
  bench.acknowledge(0xFFFF);
}

Bytes inputs_of(const bus::Exchange& exchange) { return exchange.answered() ? exchange.answer().data : Bytes{}; }

TEST(Data, NewInputsAreInTheNextAnswer) {
  Bench bench;
  to_data_ex(bench);
  bench.give_inputs({1, 1, 1});
  bench.give_inputs({2, 2, 2});
  EXPECT_EQ(inputs_of(bench.exchange({5, 5})), (Bytes{2, 2, 2}));
  EXPECT_EQ(inputs_of(bench.exchange({5, 5})), (Bytes{2, 2, 2})) << "the same without new ones";
  bench.give_inputs({3, 3, 3});
  EXPECT_EQ(inputs_of(bench.ask(56)), (Bytes{3, 3, 3})) << "Read_Inputs exchanges, too";
}

TEST(Data, TheUserGetsTheNewestOutputs) {
  Bench bench;
  to_data_ex(bench);
  const std::uint64_t missed = bench.twins.chip().status().outputs_missed;
  bench.exchange({1, 2});
  bench.exchange({3, 4});
  EXPECT_TRUE(bench.raised(regs::kEventDxOut));
  int answer = 0;
  EXPECT_EQ(bench.fetch_outputs(&answer), (Bytes{3, 4}));
  EXPECT_EQ(answer & 0x0C, 0x04) << "new, not cleared";
  EXPECT_EQ(bench.fetch_outputs(&answer), (Bytes{3, 4}));
  EXPECT_EQ(answer & 0x0C, 0x00);
  EXPECT_EQ(bench.twins.chip().status().outputs_missed, missed + 1);
  EXPECT_EQ(inputs_of(bench.ask(57)), (Bytes{3, 4}));
}

TEST(Data, ARepeatedReadOfOutputsIsComposedAgain) {
  Bench bench;
  to_data_ex(bench);
  bench.exchange({7, 7});
  EXPECT_EQ(inputs_of(bench.ask(57)), (Bytes{1, 1})) << "U as it is";
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{7, 7}));
  EXPECT_EQ(inputs_of(bench.repeat(57)), (Bytes{7, 7})) << "A28";
  bench.give_inputs({1, 1, 1});
  EXPECT_EQ(inputs_of(bench.ask(56)), (Bytes{1, 1, 1}));
  bench.give_inputs({2, 2, 2});
  EXPECT_EQ(inputs_of(bench.repeat(56)), (Bytes{1, 1, 1}));
}

TEST(Data, ARepeatedReadOfInputsMayBeComposedAgain) {
  spc3::Config config;
  config.fresh_56 = 1;
  Bench bench(Variant::kApc3, config);
  to_data_ex(bench);
  bench.give_inputs({1, 1, 1});
  bench.ask(56);
  bench.give_inputs({2, 2, 2});
  EXPECT_EQ(inputs_of(bench.repeat(56)), (Bytes{2, 2, 2}));
}

TEST(Data, ReadServicesWithDataAreRrAndWaitForDataExchange) {
  Bench bench;
  bench.to_wait_prm();
  for (const int sap : {56, 57}) EXPECT_EQ(kind_of(bench.ask(sap)), "RS");
  for (const int sap : {59, 60}) EXPECT_EQ(kind_of(bench.ask(sap, {0})), "RR");
  for (const int sap : {47, 49, 51, 53}) EXPECT_EQ(kind_of(bench.ask(sap)), "RS");
}

TEST(Data, SyncHoldsTheOutputsBack) {
  Bench bench;
  to_data_ex(bench);
  bench.control(kSync);
  EXPECT_FALSE(bench.raised(regs::kEventDxOut)) << "nothing was filled (A56)";
  EXPECT_TRUE(bench.raised(regs::kEventNewGc));
  EXPECT_EQ(bench.load(regs::kOrgGcCommand), kSync);
  const std::uint8_t states = bench.load(regs::kDoutSm);
  bench.exchange({1, 2});
  bench.exchange({3, 4});
  EXPECT_EQ(bench.load(regs::kDoutSm), states);
  EXPECT_FALSE(bench.raised(regs::kEventDxOut));
  EXPECT_EQ(bench.diag()[1] & 0x20, 0x20) << "Sync_Mode";
  bench.control(kSync);
  EXPECT_TRUE(bench.raised(regs::kEventDxOut));
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{3, 4}));
  bench.exchange({5, 6});
  bench.acknowledge(0xFFFF);
  bench.control(kUnsync);
  EXPECT_TRUE(bench.raised(regs::kEventDxOut));
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{5, 6}));
  bench.exchange({7, 8});
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{7, 8}));
  EXPECT_EQ(bench.diag()[1] & 0x20, 0);
}

TEST(Data, FreezeHoldsTheInputs) {
  Bench bench;
  to_data_ex(bench);
  bench.give_inputs({1, 1, 1});
  bench.control(kFreeze);
  bench.give_inputs({2, 2, 2});
  EXPECT_EQ(inputs_of(bench.exchange({0, 0})), (Bytes{1, 1, 1}));
  EXPECT_EQ(inputs_of(bench.ask(56)), (Bytes{1, 1, 1}));
  EXPECT_EQ(bench.diag()[1] & 0x10, 0x10) << "Freeze_Mode";
  bench.control(kFreeze);
  EXPECT_EQ(inputs_of(bench.exchange({0, 0})), (Bytes{2, 2, 2})) << "each Freeze exchanges once";
  bench.give_inputs({3, 3, 3});
  const std::uint8_t states = bench.load(regs::kDinSm);
  bench.control(kUnfreeze);
  EXPECT_EQ(bench.load(regs::kDinSm), states) << "A29";
  EXPECT_EQ(inputs_of(bench.exchange({0, 0})), (Bytes{3, 3, 3}));
}

TEST(Data, ClearDataClearsAlsoUnderSync) {
  Bench bench;
  to_data_ex(bench);
  bench.control(kSync);
  bench.exchange({1, 2});
  bench.control(kClear);
  int answer = 0;
  EXPECT_EQ(bench.fetch_outputs(&answer), (Bytes{0, 0}));
  EXPECT_EQ(answer & 0x0C, 0x0C);
  bench.acknowledge(0xFFFF);
  bench.control(kSync);
  EXPECT_FALSE(bench.raised(regs::kEventDxOut)) << "no older outputs come back";
}

TEST(Data, ParametersInDataExchangeEndSyncAndFreeze) {
  Bench bench;
  to_data_ex(bench);
  bench.control(kSync | kFreeze);
  EXPECT_EQ(bench.diag()[1] & 0x30, 0x30);
  bench.set_prm({}, kLockSyncFreeze, 0, 0, 0, 0x01);
  EXPECT_EQ(bench.diag()[1] & 0x30, 0);
}

TEST(Data, AControlOfAnotherGroupOrMasterLeavesItsCell) {
  Bench bench;
  to_data_ex(bench);
  bench.control(kFreeze, 0x02);
  bench.control(kFreeze, 0x00, 7);
  EXPECT_EQ(bench.load(regs::kOrgGcCommand), 0);
  EXPECT_FALSE(bench.raised(regs::kEventNewGc));
  bench.control(kFreeze, 0x03);
  EXPECT_EQ(bench.load(regs::kOrgGcCommand), kFreeze);
}

TEST(Data, TheEventOfAControlComesAtAChangeOrEachTime) {
  for (const Variant variant : {Variant::kApc3, Variant::kSpc3, Variant::kVpc3}) {
    Bench bench(variant);
    to_data_ex(bench);
    bench.control(kUnfreeze);
    EXPECT_TRUE(bench.raised(regs::kEventNewGc));
    bench.acknowledge(0xFFFF);
    bench.control(kUnfreeze);
    EXPECT_EQ(bench.raised(regs::kEventNewGc), variant == Variant::kVpc3) << "A47";
    if (variant != Variant::kVpc3) continue;
    bench.store(regs::kMode2, 0);
    bench.acknowledge(0xFFFF);
    bench.control(kUnfreeze);
    EXPECT_FALSE(bench.raised(regs::kEventNewGc));
    bench.control(0xC0);
    EXPECT_FALSE(bench.raised(regs::kEventNewGc)) << "reserved bits";
    bench.store(regs::kMode2, regs::kMode2NoGcCheck);
    bench.control(0xC0);
    EXPECT_TRUE(bench.raised(regs::kEventNewGc));
  }
}

TEST(Data, StartZeroesTheControlCellButNotOfVpc3) {
  for (const Variant variant : {Variant::kApc3, Variant::kVpc3}) {
    Bench bench(variant);
    bench.power_on();
    bench.initialise();
    bench.store(regs::kOrgGcCommand, 0x20);
    bench.start();
    EXPECT_EQ(bench.load(regs::kOrgGcCommand), variant == Variant::kVpc3 ? 0x20 : 0x00) << "A7";
  }
}

TEST(Data, EmptyDataAreClearWithSpecClear) {
  for (const bool clears : {false, true}) {
    Bench bench;
    Organisation given;
    if (clears) given.modes |= regs::kMode0SpecClear;
    bench.to_data_ex(given);
    bench.exchange({1, 2});
    EXPECT_EQ(kind_of(bench.exchange({})), clears ? "DL" : "RR");
    EXPECT_EQ(bench.state(), clears ? DpState::kDataExch : DpState::kWaitPrm);
    EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0}));
    EXPECT_EQ(bench.count(Reason::kSpecClear), clears);
  }
}

TEST(Data, EmptyDataMayNeedFailSafeInTheParameters) {
  spc3::Config config;
  config.empty_data = 1;
  for (const bool fail_safe : {false, true}) {
    Bench bench(Variant::kApc3, config);
    Organisation given;
    given.modes |= regs::kMode0SpecClear;
    bench.to_data_ex(given, {fail_safe ? std::uint8_t{0x40} : std::uint8_t{0}});
    bench.exchange({1, 2});
    EXPECT_EQ(kind_of(bench.exchange({})), "DL");
    EXPECT_EQ(bench.fetch_outputs(), (fail_safe ? Bytes{0, 0} : Bytes{1, 2}));
  }
}

TEST(Data, WithoutOutputsNothingIsExchanged) {
  for (const Variant variant : {Variant::kApc3, Variant::kVpc3}) {
    Bench bench(variant);
    Organisation given;
    given.outputs = 0;
    bench.to_data_ex(given);
    EXPECT_EQ(bench.load(regs::kDoutSm), 0xE1) << "A48";
    EXPECT_FALSE(bench.raised(regs::kEventDxOut));
    EXPECT_EQ(kind_of(bench.exchange({})), "DL");
    EXPECT_FALSE(bench.raised(regs::kEventDxOut));
    if (variant != Variant::kVpc3) continue;
    bench.store(regs::kMode2, regs::kMode2DxOutAlways);
    bench.exchange({});
    EXPECT_TRUE(bench.raised(regs::kEventDxOut));
  }
}

TEST(Data, APointerOfZeroIsRrAndChangesNothing) {
  Bench bench;
  to_data_ex(bench);
  const std::uint8_t states = bench.load(regs::kDoutSm);
  const auto of_d = static_cast<Address>(regs::kOrgDoutPointer + (states & 3U) - 1);
  const std::uint8_t segment = bench.load(of_d);
  bench.store(of_d, 0);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "RR");
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  EXPECT_EQ(bench.load(regs::kDoutSm), states);
  bench.store(of_d, segment);
  bench.give_inputs({9, 9, 9});
  const auto of_n = static_cast<Address>(regs::kOrgDinPointer + (bench.load(regs::kDinSm) >> 2 & 3) - 1);
  const std::uint8_t next = bench.load(of_n);
  bench.store(of_n, 0);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "RR") << "the buffer that would be D";
  EXPECT_EQ(bench.load(regs::kDoutSm), states);
  bench.store(of_n, next);
  for (const Address pointer :
       {Address{regs::kOrgDinPointer}, Address{regs::kOrgDinPointer + 1}, Address{regs::kOrgDinPointer + 2}})
    bench.store(pointer, 0);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "RR");
  EXPECT_EQ(kind_of(bench.ask(56)), "RR");
}

TEST(Data, AClearWithoutPointerLeavesTheOrganisation) {
  Bench bench;
  Organisation given;
  given.outputs = 60;
  bench.to_data_ex(given);
  bench.exchange(Bytes(60, 1));
  for (int i = 0; i < 3; ++i) bench.store(static_cast<Address>(regs::kOrgDoutPointer + i), 0);
  bench.set_mode1(regs::kMode1UserLeaveMaster);
  bench.run_cycles(2);
  EXPECT_EQ(bench.load(regs::kOrgDoutLength), 60);
  EXPECT_EQ(bench.load(regs::kOrgIdentHigh), 0x0C);
}

TEST(Data, LengthsMayChangeInWaitCfg) {
  Bench bench;
  bench.to_wait_cfg();
  bench.check_cfg();
  bench.store(regs::kOrgDoutLength, 5);
  bench.store(regs::kOrgDinLength, 0);
  EXPECT_EQ(bench.count(Reason::kOrganisationOnline), 0);
  bench.load(regs::kCfgOk);
  bench.run_cycles(2);
  EXPECT_EQ(kind_of(bench.exchange(Bytes(5, 9))), "SC");
  EXPECT_EQ(bench.fetch_outputs(), Bytes(5, 9));
  bench.store(regs::kOrgDinLength, 200);
  bench.store(regs::kOrgDoutLength, 255);
  EXPECT_EQ(bench.count(Reason::kOrganisationOnline), 2) << "in DATA_EX it is reported (A5)";
}

}  // namespace
}  // namespace dsdpv1::spc3_test
