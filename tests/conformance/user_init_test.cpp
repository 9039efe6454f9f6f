// Initialisation through the DPRAM: chapter 8, tables 2, 3, 12 to 14; rulings D7, D11, D12, D13.
#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

/// The effects of an initialisation that the user and the pins show.
struct Shown {
  std::uint8_t status1, status2, status4;
  Level ready;
  bool operator==(const Shown& other) const {
    return status1 == other.status1 && status2 == other.status2 && status4 == other.status4 && ready == other.ready;
  }
};

std::ostream& operator<<(std::ostream& out, const Shown& shown) {
  return out << "B00A " << int{shown.status1} << ", B00B " << int{shown.status2} << ", B013 " << int{shown.status4}
             << ", READY " << shown.ready;
}

Shown shown(SlaveBench& bench) {
  return {bench.peek(regs::kChipStatus1), bench.peek(regs::kChipStatus2), bench.peek(regs::kChipStatus4),
          bench.chip.level(Pin::kReady)};
}

constexpr Shown kGood = {1, 0, 0, 1}, kCrcWrong = {0, 1, 0, 0}, kLimitWrong = {0, 0, 1, 0};

Init with(void (*change)(Init&)) {
  Init init;
  change(init);
  return init;
}

/// Configuration bytes whose identifiers take `count` bytes and describe nothing: empty places.
Bytes empty_places(std::size_t count) { return Bytes(count, 0x00); }

TEST(UserInit, RightDataInitialise) {
  SlaveBench bench;
  bench.power_on();
  EXPECT_EQ(shown(bench), (Shown{0, 0, 0, 0}));
  EXPECT_EQ(bench.dp_state(), DpState::kOffline);
  ASSERT_TRUE(bench.initialise());
  EXPECT_EQ(shown(bench), kGood);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.peek(regs::kChipStatus3), 0xF4) << "WAIT_PRM, searching";
  EXPECT_EQ(bench.count(dpram::Reason::kInitialised), 1);
  EXPECT_EQ(bench.last(dpram::Reason::kInitialised).a, 5);
  EXPECT_EQ(bench.last(dpram::Reason::kInitialised).b, 0x0CC9);
  EXPECT_EQ(bench.chip.status().address, 5);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 1);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 0);
  expect_no_violation(bench);
}

struct Case {
  const char* name;
  Init init;
  Shown expected;
  Reason reason;
};

class UserInitCase : public testing::TestWithParam<Case> {};

TEST_P(UserInitCase, ShowsItAndLeavesTheFlagCleared) {
  SlaveBench bench;
  bench.power_on();
  bench.initialise(GetParam().init);
  EXPECT_EQ(shown(bench), GetParam().expected);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0) << "H5";
  EXPECT_EQ(bench.count(GetParam().reason), 1) << profibus::code(GetParam().reason);
  const bool good = GetParam().expected == kGood;
  EXPECT_EQ(bench.dp_state(), good ? DpState::kWaitPrm : DpState::kOffline);
  EXPECT_EQ(bench.count(dpram::Reason::kInitialised), good ? 1 : 0);
  // And after a refusal a right one is accepted and clears the errors (D5).
  ASSERT_TRUE(bench.initialise());
  EXPECT_EQ(shown(bench), kGood);
}

const Case kCases[] = {
    {"CrcLowWrong", with([](Init& i) { i.crc_error = 0x0001; }), kCrcWrong, dpram::Reason::kInitCrc},
    {"CrcHighWrong", with([](Init& i) { i.crc_error = 0x8000; }), kCrcWrong, dpram::Reason::kInitCrc},
    {"CrcIsLookedAtFirst", with([](Init& i) { i.crc_error = 1, i.address = 200; }), kCrcWrong, dpram::Reason::kInitCrc},
    {"Address0", with([](Init& i) { i.address = 0; }), kGood, dpram::Reason::kInitialised},
    {"Address126", with([](Init& i) { i.address = 126; }), kGood, dpram::Reason::kInitialised},
    {"Address127", with([](Init& i) { i.address = 127; }), kLimitWrong, dpram::Reason::kInitAddress},
    {"Address255", with([](Init& i) { i.address = 255; }), kLimitWrong, dpram::Reason::kInitAddress},
    {"MaxInput244", with([](Init& i) { i.max_input = 244; }), kGood, dpram::Reason::kInitialised},
    {"MaxInput245", with([](Init& i) { i.max_input = 245; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"MaxOutput244", with([](Init& i) { i.max_output = 244; }), kGood, dpram::Reason::kInitialised},
    {"MaxOutput245", with([](Init& i) { i.max_output = 245; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"MaxDiag0", with([](Init& i) { i.max_diag = 0; }), kGood, dpram::Reason::kInitialised},
    {"MaxDiag238", with([](Init& i) { i.max_diag = 238; }), kGood, dpram::Reason::kInitialised},
    {"MaxDiag239", with([](Init& i) { i.max_diag = 239; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"MaxPrm0", with([](Init& i) { i.max_prm = 0; }), kGood, dpram::Reason::kInitialised},
    {"MaxPrm237", with([](Init& i) { i.max_prm = 237; }), kGood, dpram::Reason::kInitialised},
    {"MaxPrm238", with([](Init& i) { i.max_prm = 238; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"PrmMode2", with([](Init& i) { i.prm_mode = 2; }), kGood, dpram::Reason::kInitialised},
    {"PrmMode3", with([](Init& i) { i.prm_mode = 3; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"CfgMode2", with([](Init& i) { i.cfg_mode = 2; }), kGood, dpram::Reason::kInitialised},
    {"CfgMode3", with([](Init& i) { i.cfg_mode = 3; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"MaxCfg200", with([](Init& i) { i.max_cfg = 200; }), kGood, dpram::Reason::kInitialised},
    {"MaxCfg201", with([](Init& i) { i.max_cfg = 201; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"CfgAsLongAsAllowed", with([](Init& i) { i.max_cfg = 2; }), kGood, dpram::Reason::kInitialised},
    {"CfgLongerThanAllowed", with([](Init& i) { i.max_cfg = 1; }), kLimitWrong, dpram::Reason::kInitLimit},
    {"Cfg200Bytes", with([](Init& i) { i.cfg = empty_places(200); }), kGood, dpram::Reason::kInitialised},
    {"LengthUpToTheEnd", with([](Init& i) { i.length = 214; }), kGood, dpram::Reason::kInitialised},
    {"Length215", with([](Init& i) { i.length = 215; }), kLimitWrong, dpram::Reason::kInitLength},
    {"Length255", with([](Init& i) { i.length = 255; }), kLimitWrong, dpram::Reason::kInitLength},
    {"LengthOneShortOfTheCfg", with([](Init& i) { i.length = 15; }), kLimitWrong, dpram::Reason::kInitLength},
    {"LengthShortOfTheHeader", with([](Init& i) { i.length = 13; }), kLimitWrong, dpram::Reason::kInitLength},
    {"Length0", with([](Init& i) { i.length = 0; }), kLimitWrong, dpram::Reason::kInitLength},
    {"Length1", with([](Init& i) { i.length = 1; }), kLimitWrong, dpram::Reason::kInitLength},
    {"CfgFillsTheInputs", with([](Init& i) { i.cfg = {0x1F}, i.max_input = 16; }), kGood, dpram::Reason::kInitialised},
    {"CfgBeyondTheInputs", with([](Init& i) { i.cfg = {0x1F}, i.max_input = 15; }), kLimitWrong,
     dpram::Reason::kInitCfg},
    {"CfgFillsTheOutputs", with([](Init& i) { i.cfg = {0x2F}, i.max_output = 16; }), kGood,
     dpram::Reason::kInitialised},
    {"CfgBeyondTheOutputs", with([](Init& i) { i.cfg = {0x2F}, i.max_output = 15; }), kLimitWrong,
     dpram::Reason::kInitCfg},
    {"CfgIncomplete", with([](Init& i) {
       i.cfg = {0x11, 0x40};
     }),
     kLimitWrong, dpram::Reason::kInitCfg},
    {"CfgManufacturerBytesMissing", with([](Init& i) {
       i.cfg = {0x03, 1, 2};
     }),
     kLimitWrong, dpram::Reason::kInitCfg},
    {"CfgFills244", with([](Init& i) { i.cfg = {0xC0, 0x7F, 0x7F, 0xC0, 0x79, 0x79}; }), kGood,
     dpram::Reason::kInitialised},
    {"CfgNeeds245Inputs", with([](Init& i) { i.cfg = {0xC0, 0x7F, 0x7F, 0xC0, 0x79, 0x79, 0x10}; }), kLimitWrong,
     dpram::Reason::kInitCfg},
    {"CfgNeeds245Outputs", with([](Init& i) { i.cfg = {0xC0, 0x7F, 0x7F, 0xC0, 0x79, 0x79, 0x20}; }), kLimitWrong,
     dpram::Reason::kInitCfg},
};

INSTANTIATE_TEST_SUITE_P(UserInit, UserInitCase, testing::ValuesIn(kCases),
                         [](const auto& at) { return at.param.name; });

TEST(UserInit, EveryCoveredByteIsInTheCrc) {
  SlaveBench bench;
  bench.power_on();
  const Init init;
  const Bytes block = init.block();
  const std::uint16_t crc = document_crc(block);
  for (std::size_t flipped = 1; flipped < block.size() + 1; ++flipped) {
    bench.acquire();
    Bytes sent = block;
    sent.push_back(0x55);  // one byte after the block: not covered
    sent[flipped] = static_cast<std::uint8_t>(sent[flipped] ^ 0x10);
    for (std::size_t i = 0; i < sent.size(); ++i) bench.write(static_cast<std::uint16_t>(regs::kInit + i), sent[i]);
    bench.write(regs::kInitCrc, static_cast<std::uint8_t>(crc >> 8));
    bench.write(regs::kInitCrc + 1, static_cast<std::uint8_t>(crc & 0xFF));
    bench.write(regs::kUserCommand1, regs::kUserCommand1Init);
    bench.chip_accesses();
    EXPECT_EQ(shown(bench), flipped < block.size() ? kCrcWrong : kGood) << "byte " << flipped;
  }
}

TEST(UserInit, ALengthByteThatCannotBeRightLeavesTheCrcBitAlone) {
  SlaveBench bench;
  bench.power_on();
  bench.initialise(with([](Init& i) { i.crc_error = 1; }));
  ASSERT_EQ(shown(bench), kCrcWrong);
  bench.initialise(with([](Init& i) { i.length = 230; }));
  EXPECT_EQ(shown(bench), (Shown{0, 1, 1, 0})) << "D12";
  bench.initialise(with([](Init& i) { i.length = 230, i.crc_error = 3; }));
  EXPECT_EQ(shown(bench), (Shown{0, 1, 1, 0}));
}

// Reserved bits are 0, and so are bits 1 and 2 of B013 (R5): nothing can be over the limits that they show.
TEST(UserInit, WritesAllBitsOfB00AAndB013) {
  for (const std::uint8_t max_input : Bytes{244, 245}) {
    SlaveBench bench;
    bench.power_on();
    bench.poke(0x00A, 0xFE);
    bench.poke(0x013, 0xFE);
    Init init;
    init.max_input = max_input;
    bench.initialise(init);
    EXPECT_EQ(bench.peek(0x00A), max_input == 245 ? 0 : 1);
    EXPECT_EQ(bench.peek(0x013), max_input == 245 ? 1 : 0);
  }
}

TEST(UserInit, UserMayClearTheStatusAndItStays) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.poke(regs::kChipStatus1, 0);
  bench.chip_accesses(20);
  bench.give_inputs({1, 2});
  EXPECT_EQ(bench.peek(regs::kChipStatus1), 0);
  EXPECT_EQ(bench.chip.level(Pin::kReady), 1);
  EXPECT_TRUE(bench.data_exchange({1, 2}).answered());
  ASSERT_TRUE(bench.initialise());
  EXPECT_EQ(shown(bench), kGood) << "set again by the next initialisation";
  expect_no_violation(bench);
}

TEST(UserInit, UserWhoClearsTheCrcBitIsNotOverruled) {
  SlaveBench bench;
  bench.power_on();
  bench.initialise(with([](Init& i) { i.crc_error = 1; }));
  bench.poke(regs::kChipStatus2, 0);
  bench.chip_accesses(5);
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0);
}

TEST(UserInit, BlocksBeforeTheInitialisationAreDroppedWithAReason) {
  for (const std::uint8_t flag : {regs::kUserCommand1Input, regs::kUserCommand1Diag}) {
    SlaveBench bench;
    bench.power_on();
    bench.poke(regs::kUserCommand1, flag);
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(regs::kUserCommand1), 0) << int{flag};
    EXPECT_EQ(bench.count(dpram::Reason::kBeforeInit), 1) << int{flag};
  }
  for (const std::uint8_t flag : {regs::kUserCommand1PrmVerdict, regs::kUserCommand1CfgVerdict}) {
    SlaveBench bench;
    bench.power_on();
    bench.poke(regs::kUserCommand1, flag);
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(regs::kUserCommand1), 0) << int{flag};
    EXPECT_EQ(bench.count(dpram::Reason::kBeforeInit) + bench.count(Reason::kVerdictUnexpected), 1) << int{flag};
  }
}

TEST(UserInit, InputsOfTheSameHoldAreTakenAfterTheInitialisation) {
  SlaveBench bench;
  bench.power_on();
  bench.acquire();
  bench.write_block(regs::kInit, Init{}.block(), regs::kInitCrc);
  bench.write_block(regs::kInput, {2, 0x12, 0x34}, regs::kInputCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Init | regs::kUserCommand1Input);
  bench.chip_accesses();
  EXPECT_EQ(shown(bench), kGood);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
  EXPECT_EQ(bench.count(dpram::Reason::kBeforeInit), 0);
  EXPECT_EQ(bench.count(Reason::kInputLength), 0);
  bench.find_baud();
  bench.set_prm({});
  bench.check_cfg();
  const bus::Exchange exchange = bench.data_exchange({0, 0});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().data, (Bytes{0x12, 0x34}));
}

// --- in operation ----------------------------------------------------------------------------------------------------

Init other_init() {
  Init init;
  init.address = 77;
  init.ident = 0xBEEF;
  init.cfg = {0x13, 0x20};  // 4 inputs, 1 output
  return init;
}

void expect_new_values_work(SlaveBench& bench) {
  EXPECT_EQ(shown(bench), kGood);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.chip.status().baud_index.code(), 15);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 0);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 1);
  EXPECT_EQ(bench.chip.status().address, 77);
  EXPECT_EQ(bench.chip.status().master, 255);
  bench.fcb = true;
  bench.fcb_valid = false;
  bench.find_baud();
  Prm prm;
  prm.ident = 0xBEEF;
  ASSERT_TRUE(bench.set_prm(prm).short_acknowledge());
  ASSERT_TRUE(bench.check_cfg({0x13, 0x20}).short_acknowledge());
  ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  bus::Exchange exchange = bench.data_exchange({9});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().data, Bytes(4, 0)) << "inputs are zero until the first valid block (D10)";
  bench.give_inputs({1, 2, 3, 4});
  exchange = bench.data_exchange({9});
  EXPECT_EQ(exchange.answer().data, (Bytes{1, 2, 3, 4}));
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{9}));
}

TEST(UserInit, AgainWhileSearching) {
  SlaveBench bench;
  bench.power_on();
  ASSERT_TRUE(bench.initialise());
  bench.run_ms(30);
  ASSERT_TRUE(bench.initialise(other_init()));
  expect_new_values_work(bench);
}

TEST(UserInit, AgainInWaitPrm) {
  SlaveBench bench;
  bench.to_wait_prm();
  ASSERT_TRUE(bench.initialise(other_init()));
  expect_new_values_work(bench);
}

TEST(UserInit, AgainInWaitCfg) {
  SlaveBench bench;
  bench.to_wait_cfg();
  ASSERT_TRUE(bench.initialise(other_init()));
  EXPECT_EQ(bench.peek(regs::kOfflineCount + 1), 0);
  expect_new_values_work(bench);
}

TEST(UserInit, AgainInDataExchangeGoesThroughOfflineAndCounts) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({5, 6});
  bench.data_exchange({0xAA, 0xBB});
  bench.chip_accesses();
  ASSERT_TRUE(bench.fetch_outputs().has_value());
  const std::size_t events = bench.chip.events().size();
  ASSERT_TRUE(bench.initialise(other_init()));
  std::vector<int> states;
  for (std::size_t i = events; i < bench.chip.events().size(); ++i) {
    const profibus::Event& event = bench.chip.events()[i];
    if (event.reason == Reason::kDpState) states.push_back(event.b);
  }
  EXPECT_EQ(states, (std::vector<int>{0, 1})) << "OFFLINE, WAIT_PRM";
  EXPECT_EQ(bench.peek(regs::kOfflineCount), 0);
  EXPECT_EQ(bench.peek(regs::kOfflineCount + 1), 1) << "S18 counts it";
  expect_new_values_work(bench);
}

TEST(UserInit, AgainInDataExchangeGivesTheUserClearedOutputs) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.data_exchange({0xAA, 0xBB});
  bench.chip_accesses();
  ASSERT_EQ(bench.fetch_outputs(), (Bytes{0xAA, 0xBB}));
  ASSERT_TRUE(bench.initialise());
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0})) << "S18: leaving DATA_EXCH for whatever reason";
}

TEST(UserInit, AgainWhileTheUserJudgesDropsTheVerdict) {
  SlaveBench bench;
  Init judging;
  judging.prm_mode = 2;
  bench.to_wait_prm(judging);
  ASSERT_TRUE(bench.set_prm({}).short_acknowledge());
  bench.chip_accesses(3);
  ASSERT_TRUE(bench.initialise(judging));
  bench.verdict(true, std::nullopt);
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 1);
  EXPECT_EQ(bench.dp_state(), DpState::kWaitPrm);
}

TEST(UserInit, FrameCountMemoryAndAddressLockAreForgotten) {
  SlaveBench bench;
  bench.to_wait_prm();
  ASSERT_TRUE(bench.srd(55, 62, {44, 0x0C, 0xC9, 0x01}).short_acknowledge());  // locked by No_Add_Chg
  EXPECT_EQ(bench.chip.status().address, 44);
  ASSERT_TRUE(bench.initialise());
  EXPECT_EQ(bench.chip.status().address, 5) << "S5: the new address lives until a new initialisation";
  bench.fcb = true;
  bench.fcb_valid = false;
  bench.find_baud();
  ASSERT_TRUE(bench.srd(55, 62, {45, 0x0C, 0xC9, 0x00}).short_acknowledge());
  EXPECT_EQ(bench.chip.status().address, 45);
}

class RefusedInOperation : public testing::TestWithParam<Case> {};

TEST_P(RefusedInOperation, ChangesNothingButTheStatusBytes) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({5, 6});
  bench.data_exchange({0xAA, 0xBB});
  bench.chip_accesses();
  bench.fetch_outputs();
  bench.chip_accesses();
  const Bytes before = bench.peek(0x000, 0x800);
  const std::size_t events = bench.chip.events().size();
  const auto trace = bench.chip.trace().size();
  const std::uint8_t address = bench.address;
  bench.initialise(GetParam().init);
  bench.address = address;
  EXPECT_EQ(bench.chip.events().size(), events + 1) << "one reason, nothing else";
  for (std::size_t i = trace; i < bench.chip.trace().size(); ++i) {
    const Pin pin = bench.chip.trace()[i].pin;
    EXPECT_TRUE(pin == Pin::kLReq || pin == Pin::kLSta) << dsdpv1::name(pin);
  }
  Shown expected = GetParam().expected;
  expected.ready = 1;
  EXPECT_EQ(shown(bench), expected);
  const Bytes after = bench.peek(0x000, 0x800);
  for (std::uint16_t cell = 0; cell < 0x800; ++cell) {
    const bool status = cell == regs::kChipStatus1 || cell == regs::kChipStatus2 || cell == regs::kChipStatus4;
    const bool own = cell >= 0x020 && cell < 0x12F;
    EXPECT_TRUE(status || own || before[cell] == after[cell]) << "B" << std::hex << cell;
  }
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  const bus::Exchange exchange = bench.data_exchange({1, 2});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().data, (Bytes{5, 6}));
}

const Case kRefused[] = {
    {"Crc", with([](Init& i) { i.crc_error = 1; }), kCrcWrong, dpram::Reason::kInitCrc},
    {"Address", with([](Init& i) { i.address = 127; }), kLimitWrong, dpram::Reason::kInitAddress},
    {"Length", with([](Init& i) { i.length = 250; }), kLimitWrong, dpram::Reason::kInitLength},
    {"Cfg", with([](Init& i) { i.cfg = {0x40}; }), kLimitWrong, dpram::Reason::kInitCfg},
    {"Mode", with([](Init& i) { i.cfg_mode = 9; }), kLimitWrong, dpram::Reason::kInitLimit},
};

INSTANTIATE_TEST_SUITE_P(UserInit, RefusedInOperation, testing::ValuesIn(kRefused),
                         [](const auto& at) { return at.param.name; });

TEST(UserInit, WhileAnAnswerIsSentItIsStopped) {
  // Micro-architecture 10: the transmitter is aborted. The user writes the block before and lets the chip in during the
  // answer.
  SlaveBench bench;
  bench.to_data_exch();
  bench.acquire();
  bench.write_block(regs::kInit, other_init().block(), regs::kInitCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Init);
  Script script(bench);
  const Tick start = bench.now() + 100 * bench.requester.bit();
  const Tick request = 11 * 11 * bench.requester.bit();
  const Tick in_answer = start + request + 20 * bench.requester.bit();
  script.set(in_answer, Pin::kRSta, 0);
  script.set(in_answer, Pin::kRReq, 0);
  bench.requester.send(bench.timeline, bus::make_telegram(5, 2, 0x7D, {}, 60, 62), {.at = start});
  bench.release();
  bench.run_ms(1);
  EXPECT_EQ(bench.chip.level(Pin::kPbrts), 0);
  const Tick fall = bench.changes(Pin::kPbrts).back().at;
  EXPECT_EQ(bench.last(dpram::Reason::kInitialised).at, fall);
  bench.address = 77;
  expect_new_values_work(bench);
}

TEST(UserInit, StatusBytesAreWrittenInTheAccessOfTheInitialisation) {
  SlaveBench bench;
  bench.power_on();
  bench.acquire();
  bench.write_block(regs::kInit, Init{}.block(), regs::kInitCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Init);
  bench.release();
  run_to_l_sta(bench, 1);
  run_to_l_sta(bench, 0);
  EXPECT_EQ(shown(bench), kGood);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
  EXPECT_EQ(bench.peek(regs::kChipStatus3), 0xF4);
}

}  // namespace
}  // namespace dsdpv1::conformance
