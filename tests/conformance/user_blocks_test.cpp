// The blocks that cross the DPRAM: table 2, 4.1, 4.2, 6.2.4; rulings D2 to D6, D9, D10, D12 to D15, H5, P7.
#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

/// 244 inputs and 244 outputs: 64 and 58 words each way.
const Bytes kWidest = {0xC0, 0x7F, 0x7F, 0xC0, 0x79, 0x79};

Init widest() {
  Init init;
  init.cfg = kWidest;
  init.max_diag = 238;
  return init;
}

Bytes counting(std::size_t size, int first) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(first + static_cast<int>(i) * 7);
  return bytes;
}

Bytes inputs_seen(SlaveBench& bench, const Bytes& outputs = {0, 0}) {
  const bus::Exchange exchange = bench.data_exchange(outputs);
  EXPECT_TRUE(exchange.answered());
  return exchange.answered() ? exchange.answer().data : Bytes{};
}

int crc_at(SlaveBench& bench, std::uint16_t cell) {
  return bench.peek(cell) << 8 | bench.peek(static_cast<std::uint16_t>(cell + 1));
}

TEST(Crc, ExampleOfTheDatasheet) {
  EXPECT_EQ(document_crc({0x02, 0x07}), 0x1241);
  SlaveBench bench;
  bench.to_data_exch({}, {.user = {0x07, 0x00}});
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kPrm, 3), (Bytes{2, 7, 0}));
  EXPECT_EQ(crc_at(bench, regs::kPrmCrc), document_crc({2, 7, 0})) << "high byte first";
}

// Table 10: a block is read when its flag is set, and not before.
TEST(UserCommands, EachBlockIsReadOnceItsBitOfB010IsSet) {
  SlaveBench bench;
  bench.power_on();
  const auto give = [&bench](std::uint8_t flag) {
    bench.poke(0x010, flag);
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(0x010), 0);
  };
  bench.acquire();
  bench.write_block(0x020, Init{}.block(), 0x0F7);
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(0x00A), 0);
  give(0x04);
  EXPECT_EQ(bench.peek(0x00A), 1);
  bench.find_baud();
  ASSERT_TRUE(bench.set_prm({}).short_acknowledge());
  ASSERT_TRUE(bench.check_cfg().short_acknowledge());
  bench.acquire();
  bench.write_block(0x130, {2, 5, 6}, 0x225);
  bench.write_block(0x227, {0x81, 1, 9}, 0x317);
  bench.chip_accesses(3);
  EXPECT_EQ(inputs_seen(bench), (Bytes{0, 0}));
  EXPECT_EQ(bench.slave_diag().size(), 6U);
  give(0x01);
  EXPECT_EQ(inputs_seen(bench), (Bytes{5, 6}));
  EXPECT_EQ(bench.slave_diag().size(), 6U);
  give(0x02);
  EXPECT_EQ(bench.slave_diag().back(), 9);
}

// --- inputs ----------------------------------------------------------------------------------------------------------

TEST(UserInputs, AreZeroUntilTheFirstValidBlock) {
  SlaveBench bench;
  bench.to_data_exch();
  EXPECT_EQ(inputs_seen(bench), (Bytes{0, 0}));
  bench.give_inputs({1, 2}, 1);
  EXPECT_EQ(inputs_seen(bench), (Bytes{0, 0}));
  bench.give_inputs({3, 4});
  EXPECT_EQ(inputs_seen(bench), (Bytes{3, 4}));
}

TEST(UserInputs, WrongCrcKeepsTheEarlierAndIsShown) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({1, 2});
  bench.give_inputs({3, 4}, 0x0100);
  EXPECT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2InputCrc);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0) << "H5: cleared also when the CRC is wrong";
  EXPECT_EQ(bench.count(dpram::Reason::kInputCrc), 1);
  EXPECT_EQ(inputs_seen(bench), (Bytes{1, 2}));
  bench.give_inputs({5, 6});
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0) << "D5";
  EXPECT_EQ(inputs_seen(bench), (Bytes{5, 6}));
}

TEST(UserInputs, WrongLengthsAreRefusedWithAReason) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({1, 2});
  int refused = 0;
  for (const std::size_t size : {0U, 1U, 3U, 16U, 244U}) {
    bench.give_inputs(Bytes(size, 0x77));
    EXPECT_EQ(bench.count(Reason::kInputLength), ++refused) << size;
    EXPECT_EQ(bench.peek(regs::kChipStatus2), 0) << "the CRC is right";
    EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
    EXPECT_EQ(inputs_seen(bench), (Bytes{1, 2})) << size;
  }
}

TEST(UserInputs, WrongLengthWithARightCrcClearsTheErrorBit) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({1, 2}, 1);
  ASSERT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2InputCrc);
  bench.give_inputs({1, 2, 3});
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0) << "micro-architecture 10: the CRC is looked at before the length";
}

TEST(UserInputs, ALengthAbove244LeavesTheCrcBitAlone) {
  for (const std::uint8_t length : Bytes{245, 255}) {
    SlaveBench bench;
    bench.to_data_exch();
    bench.give_inputs({1, 2}, 1);
    ASSERT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2InputCrc);
    bench.acquire();
    bench.write(regs::kInputLength, length);
    bench.write(regs::kUserCommand1, regs::kUserCommand1Input);
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2InputCrc) << "D12";
    EXPECT_EQ(bench.count(Reason::kInputLength), 1);
    EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
    EXPECT_EQ(inputs_seen(bench), (Bytes{0, 0}));
  }
}

TEST(UserInputs, TwoHundredAndFortyFourBytes) {
  SlaveBench bench;
  bench.to_data_exch(widest());
  const Bytes inputs = counting(244, 3);
  bench.give_inputs(inputs);
  EXPECT_EQ(inputs_seen(bench, Bytes(244, 1)), inputs);
}

TEST(UserInputs, EveryCoveredByteIsInTheCrcAndNoOther) {
  SlaveBench bench;
  bench.to_data_exch();
  const Bytes block = {2, 0x12, 0x34};
  const std::uint16_t crc = document_crc(block);
  for (std::uint16_t flipped = 0x130; flipped <= 0x226;
       flipped = static_cast<std::uint16_t>(flipped == 0x134 ? 0x224 : flipped + 1)) {
    bench.acquire();
    bench.write_block(regs::kInput, block, regs::kInputCrc);
    bench.run_cycles(4);
    bench.write(flipped, bench.peek(flipped) ^ 0x04);
    bench.write(regs::kUserCommand1, regs::kUserCommand1Input);
    bench.chip_accesses();
    const bool covered = flipped <= 0x132 || flipped >= 0x225;
    EXPECT_EQ(bench.peek(regs::kChipStatus2), covered ? regs::kChipStatus2InputCrc : 0)
        << std::hex << flipped << " crc " << crc;
  }
}

// --- error bits (D5, D13) --------------------------------------------------------------------------------------------

TEST(UserErrorBits, AreIndependent) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({1, 2}, 1);
  bench.give_diag(0x81, {1, 2, 3}, 1);
  EXPECT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2InputCrc | regs::kChipStatus2DiagCrc);
  bench.give_inputs({1, 2});
  EXPECT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2DiagCrc);
  bench.give_diag(0x81, {1, 2, 3});
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0);
}

TEST(UserErrorBits, ClearedByTheUserStayCleared) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({1, 2}, 1);
  bench.poke(regs::kChipStatus2, 0);
  bench.chip_accesses(5);
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0);
  bench.give_diag(0x81, {1}, 1);
  EXPECT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2DiagCrc) << "D13: the inputs' bit stays cleared";
}

TEST(UserErrorBits, BothWrongInOneAccess) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.acquire();
  bench.write_block(regs::kInput, {2, 1, 2}, regs::kInputCrc, 1);
  bench.write_block(regs::kDiag, {0x81, 1, 2}, regs::kDiagCrc, 1);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Input | regs::kUserCommand1Diag);
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2InputCrc | regs::kChipStatus2DiagCrc);
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
}

TEST(UserErrorBits, OtherBitsOfB00BAreTheUsers) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.poke(regs::kChipStatus2, 0xC2);
  bench.give_inputs({1, 2}, 1);
  EXPECT_EQ(bench.peek(regs::kChipStatus2), 0xC2 | regs::kChipStatus2InputCrc) << "D13: read, changed, written back";
}

// --- history of the inputs' bit (D16) --------------------------------------------------------------------------------

constexpr std::uint8_t kHistory = 0x40, kClearOnce = 0x80, kInputWrong = 0x04;

TEST(UserErrorHistory, ARightBlockDoesNotClearTheBitUntilHistoryIsSwitchedOff) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.poke(0x011, kHistory);
  bench.give_inputs({1, 2}, 1);
  EXPECT_EQ(bench.peek(0x00B), kInputWrong);
  bench.give_inputs({3, 4});
  EXPECT_EQ(bench.peek(0x00B), kInputWrong);
  EXPECT_EQ(inputs_seen(bench), (Bytes{3, 4})) << "the block itself counts";
  bench.give_inputs({3, 4, 5});
  EXPECT_EQ(bench.peek(0x00B), kInputWrong) << "nor one of another length";
  bench.give_diag(0x81, {1}, 1);
  bench.give_diag(0x81, {1});
  EXPECT_EQ(bench.peek(0x00B), kInputWrong) << "the other bits show the present";
  bench.poke(0x011, 0);
  bench.give_inputs({5, 6});
  EXPECT_EQ(bench.peek(0x00B), 0) << "D5 again";
  EXPECT_EQ(bench.peek(0x011), 0);
}

TEST(UserErrorHistory, ClearOnceClearsTheBitAndItselfAndLeavesHistoryOn) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.poke(0x011, kHistory);
  for (int round = 0; round < 2; ++round) {
    bench.give_inputs({1, 2}, 1);
    ASSERT_EQ(bench.peek(0x00B), kInputWrong);
    bench.poke(0x011, kHistory | kClearOnce);
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(0x00B), 0);
    EXPECT_EQ(bench.peek(0x011), kHistory);
  }
}

TEST(UserErrorHistory, ClearOnceWithoutHistoryClearsOnlyItself) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_inputs({1, 2}, 1);
  bench.poke(0x011, kClearOnce);
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(0x00B), kInputWrong);
  EXPECT_EQ(bench.peek(0x011), 0);
}

TEST(UserErrorHistory, AWrongBlockHandedOverWithTheClearIsShownARightOneIsNot) {
  for (const bool wrong : {true, false}) {
    SlaveBench bench;
    bench.to_data_exch();
    bench.poke(0x011, kHistory);
    bench.give_inputs({1, 2}, 1);
    bench.acquire();
    bench.write_block(regs::kInput, {2, 3, 4}, regs::kInputCrc, wrong ? 1 : 0);
    bench.write(regs::kUserCommand1, regs::kUserCommand1Input);
    bench.write(0x011, kHistory | kClearOnce);
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(0x00B), wrong ? kInputWrong : 0);
    EXPECT_EQ(bench.peek(0x011), kHistory);
  }
}

TEST(UserErrorHistory, OtherBitsOfB00BAndB011StayAndAnswersAreTakenAfterTheClear) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.acquire();
  bench.write(0x00B, 0xFF);
  bench.write_block(regs::kC1, {0x5E, 0, 0, 0}, regs::kC1Crc);
  bench.write(0x011, kHistory | kClearOnce | 0x3C | regs::kUserCommand2C1);
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(0x011), kHistory | 0x3C);
  EXPECT_EQ(bench.peek(0x00B), 0xFF & ~kInputWrong & ~regs::kChipStatus2C1Crc) << "the C1 answer was right";
  EXPECT_EQ(bench.count(Reason::kAcyclicNoRequest), 1);
}

TEST(UserErrorHistory, WorksBeforeTheInitialisationAndTheUserMayStillWriteZero) {
  SlaveBench bench;
  bench.power_on();
  bench.acquire();
  bench.write(0x00B, kInputWrong);
  bench.write(0x011, kHistory | kClearOnce);
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(0x00B), 0) << "OFFLINE";
  EXPECT_EQ(bench.peek(0x011), kHistory);
  bench.to_data_exch();
  bench.poke(0x011, kHistory);
  bench.give_inputs({1, 2}, 1);
  bench.poke(0x00B, 0);
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(0x00B), 0);
}

// --- diagnosis -------------------------------------------------------------------------------------------------------

struct DiagType {
  std::uint8_t type;
  bool ext, stat, high;
};

class UserDiag : public testing::TestWithParam<DiagType> {};

TEST_P(UserDiag, ShowsItsBitAndItsPriority) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_diag(GetParam().type, {0x09, 1, 2, 3});
  EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
  EXPECT_EQ(bench.count(Reason::kDiagAccepted), 1);
  bus::Exchange exchange = bench.data_exchange({0, 0});
  ASSERT_TRUE(exchange.answered());
  EXPECT_EQ(exchange.answer().fc, GetParam().high ? 0x0A : 0x08);
  const Bytes diag = bench.slave_diag();
  ASSERT_EQ(diag.size(), 10U);
  EXPECT_EQ((diag[0] & 0x08) != 0, GetParam().ext);
  EXPECT_EQ((diag[1] & 0x02) != 0, GetParam().stat);
  EXPECT_EQ(Bytes(diag.begin() + 6, diag.end()), (Bytes{0x09, 1, 2, 3}));
  exchange = bench.data_exchange({0, 0});
  EXPECT_EQ(exchange.answer().fc, GetParam().stat ? 0x0A : 0x08) << "read by the holder; Stat_Diag stands (D9)";
}

INSTANTIATE_TEST_SUITE_P(All, UserDiag,
                         testing::Values(DiagType{0x00, false, false, false}, DiagType{0x81, true, false, true},
                                         DiagType{0x01, false, false, true}, DiagType{0x82, false, true, true},
                                         DiagType{0x02, false, false, true}),
                         [](const auto& at) { return "Type" + std::to_string(at.param.type); });

TEST(UserDiagBlocks, GoneClearsItsOwnBit) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_diag(0x81, {1});
  bench.give_diag(0x82, {1});
  Bytes diag = bench.slave_diag();
  EXPECT_EQ(diag[0] & 0x08, 0x08);
  EXPECT_EQ(diag[1] & 0x02, 0x02);
  bench.give_diag(0x01, {});
  diag = bench.slave_diag();
  EXPECT_EQ(diag[0] & 0x08, 0);
  EXPECT_EQ(diag[1] & 0x02, 0x02);
  bench.give_diag(0x02, {});
  diag = bench.slave_diag();
  EXPECT_EQ(diag[1] & 0x02, 0);
}

TEST(UserDiagBlocks, OtherTypesAreRefusedAndTheEarlierStays) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.give_diag(0x81, {7, 8});
  const Bytes before = bench.slave_diag();
  int refused = 0;
  for (const std::uint8_t type : Bytes{0x03, 0x80, 0x83, 0xFF, 0x10}) {
    bench.give_diag(type, {1, 2, 3});
    EXPECT_EQ(bench.count(Reason::kDiagType), ++refused);
    EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
    EXPECT_EQ(bench.peek(regs::kChipStatus2), 0);
    EXPECT_EQ(bench.slave_diag(), before);
  }
}

TEST(UserDiagBlocks, LengthsUpToB029) {
  SlaveBench bench;
  Init init;
  init.max_diag = 5;
  bench.to_data_exch(init);
  bench.give_diag(0x81, {1, 2, 3, 4, 5});
  EXPECT_EQ(bench.slave_diag().size(), 11U);
  bench.give_diag(0x81, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(bench.count(Reason::kDiagLength), 1);
  EXPECT_EQ(bench.slave_diag().size(), 11U);
  bench.give_diag(0x81, {});
  EXPECT_EQ(bench.slave_diag().size(), 6U);
}

TEST(UserDiagBlocks, B029OfZeroAllowsNoBytes) {
  SlaveBench bench;
  Init init;
  init.max_diag = 0;
  bench.to_data_exch(init);
  bench.give_diag(0x81, {1});
  EXPECT_EQ(bench.count(Reason::kDiagLength), 1);
  bench.give_diag(0x81, {});
  EXPECT_EQ(bench.count(Reason::kDiagLength), 1);
  EXPECT_EQ(bench.slave_diag()[0] & 0x08, 0x08);
}

TEST(UserDiagBlocks, TheLongest) {
  SlaveBench bench;
  bench.to_data_exch(widest());
  const Bytes user = counting(238, 9);
  bench.give_diag(0x81, user);
  const Bytes diag = bench.slave_diag();
  ASSERT_EQ(diag.size(), 244U);
  EXPECT_EQ(Bytes(diag.begin() + 6, diag.end()), user);
}

TEST(UserDiagBlocks, ALengthAbove238LeavesTheCrcBitAlone) {
  for (const std::uint8_t length : Bytes{239, 255}) {
    SlaveBench bench;
    bench.to_data_exch(widest());
    bench.give_diag(0x81, {1}, 1);
    bench.acquire();
    bench.write(regs::kDiagLength, length);
    bench.write(regs::kUserCommand1, regs::kUserCommand1Diag);
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(regs::kChipStatus2), regs::kChipStatus2DiagCrc);
    EXPECT_EQ(bench.count(Reason::kDiagLength), 1);
    EXPECT_EQ(bench.peek(regs::kUserCommand1), 0);
  }
}

TEST(UserDiagBlocks, EveryCoveredByteIsInTheCrcAndNoOther) {
  SlaveBench bench;
  bench.to_data_exch();
  const Bytes block = {0x00, 3, 0x12, 0x34, 0x56};
  for (std::uint16_t flipped = 0x227; flipped <= 0x318;
       flipped = static_cast<std::uint16_t>(flipped == 0x22D ? 0x316 : flipped + 1)) {
    bench.acquire();
    bench.write_block(regs::kDiag, block, regs::kDiagCrc);
    bench.run_cycles(4);
    bench.write(flipped, bench.peek(flipped) ^ 0x01);
    bench.write(regs::kUserCommand1, regs::kUserCommand1Diag);
    bench.chip_accesses();
    const bool covered = flipped <= 0x22B || flipped >= 0x317;
    EXPECT_EQ(bench.peek(regs::kChipStatus2), covered ? regs::kChipStatus2DiagCrc : 0) << std::hex << flipped;
  }
}

// --- outputs ---------------------------------------------------------------------------------------------------------

TEST(UserOutputs, BlockHasLengthBytesAndCrc) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.data_exchange({0x5A, 0xA5});
  bench.chip_accesses();
  EXPECT_EQ(bench.peek(regs::kOutput, 3), (Bytes{2, 0x5A, 0xA5}));
  EXPECT_EQ(crc_at(bench, regs::kOutputCrc), document_crc({2, 0x5A, 0xA5}));
  EXPECT_EQ(bench.peek(regs::kChipCommand1) & regs::kChipCommand1Output, 1);
  for (const PinChange& change : bench.changes(Pin::kIntr0)) EXPECT_LT(change.at, bench.now() - 200 * kCycleTicks);
}

TEST(UserOutputs, NewestWins) {
  SlaveBench bench;
  bench.to_data_exch();
  for (const std::uint8_t value : Bytes{1, 2, 3}) {
    bench.data_exchange({value, value});
    bench.chip_accesses();
    EXPECT_EQ(bench.peek(regs::kOutput, 3), (Bytes{2, value, value})) << "H5: not fetched, overwritten";
  }
  EXPECT_EQ(bench.chip.status().outputs_missed, 2U);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{3, 3}));
  EXPECT_FALSE(bench.fetch_outputs().has_value());
  bench.data_exchange({4, 4});
  bench.chip_accesses();
  EXPECT_EQ(bench.chip.status().outputs_missed, 2U) << "the last one was fetched";
}

TEST(UserOutputs, WhileTheUserHoldsTheNewestIsKept) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.data_exchange({1, 1});
  bench.chip_accesses(3);
  bench.acquire();
  for (const std::uint8_t value : Bytes{2, 3, 4}) ASSERT_TRUE(bench.data_exchange({value, value}).answered());
  EXPECT_EQ(bench.peek(regs::kOutput, 3), (Bytes{2, 1, 1}));
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{4, 4}));
}

TEST(UserOutputs, TwoHundredAndFortyFourBytes) {
  SlaveBench bench;
  bench.to_data_exch(widest());
  const Bytes outputs = counting(244, 100);
  bench.data_exchange(outputs);
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), outputs);
}

TEST(UserOutputs, ClearedWhenDataExchangeIsLeft) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.data_exchange({7, 8});
  bench.chip_accesses();
  bench.fetch_outputs();
  bench.chip_accesses();
  Prm unlock;
  unlock.status = 0x40;
  bench.set_prm(unlock);
  bench.chip_accesses(3);
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{0, 0})) << "S18";
}

// --- parameters and configuration ------------------------------------------------------------------------------------

TEST(UserPrmCfg, ParameterBlock) {
  for (const std::size_t size : {0U, 1U, 3U, 237U}) {
    SlaveBench bench;
    Init init;
    init.command = 0x0F;
    Bytes user = counting(size, 0);
    bench.to_wait_cfg(init, {.user = user});
    bench.chip_accesses(3);
    Bytes block = {static_cast<std::uint8_t>(size)};
    block.insert(block.end(), user.begin(), user.end());
    EXPECT_EQ(bench.peek(regs::kPrm, static_cast<int>(block.size())), block);
    EXPECT_EQ(crc_at(bench, regs::kPrmCrc), document_crc(block));
    EXPECT_EQ(bench.peek(regs::kChipCommand1), regs::kChipCommand1Prm);
  }
}

TEST(UserPrmCfg, ConfigurationBlock) {
  struct Try {
    Bytes cfg;
    std::uint8_t output, input;
  };
  for (const Try& one : {Try{{0x11, 0x21}, 2, 2}, Try{kWidest, 244, 244}, Try{Bytes(200, 0x00), 0, 0},
                         Try{{0x53}, 0, 8}, Try{{0x31, 0x70}, 4, 4}, Try{{0x83, 0x03, 0x00, 0x00, 0x00, 0x10}, 4, 1}}) {
    SlaveBench bench;
    Init init;
    init.cfg = {0x11, 0x21};
    bench.to_wait_cfg(init);
    bench.chip_accesses(3);
    bench.check_cfg(one.cfg);
    bench.chip_accesses(3);
    ASSERT_EQ(bench.count(Reason::kCfgAccepted), 1);
    Bytes block = {one.output, one.input, static_cast<std::uint8_t>(one.cfg.size())};
    block.insert(block.end(), one.cfg.begin(), one.cfg.end());
    EXPECT_EQ(bench.peek(regs::kCfg, static_cast<int>(block.size())), block) << "D6";
    EXPECT_EQ(crc_at(bench, regs::kCfgCrc), document_crc(block));
    EXPECT_EQ(bench.peek(regs::kChipCommand1) & regs::kChipCommand1Cfg, regs::kChipCommand1Cfg);
  }
}

TEST(UserPrmCfg, FlagsStayUntilTheUserClearsThem) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.data_exchange({1, 2});
  bench.chip_accesses(10);
  EXPECT_EQ(bench.peek(regs::kChipCommand1), 7);
  bench.poke(regs::kChipCommand1, regs::kChipCommand1Cfg);
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kChipCommand1), regs::kChipCommand1Cfg);
  bench.data_exchange({1, 2});
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(regs::kChipCommand1), regs::kChipCommand1Cfg | regs::kChipCommand1Output)
      << "bits of the user stay";
  bench.poke(0x00E, 0);
  bench.chip_accesses(3);
  EXPECT_EQ(bench.peek(0x00E), 0) << "and what the user has cleared";
}

// --- INTR0 -----------------------------------------------------------------------------------------------------------

/// The cycle at which B00E's `bit` becomes 1, watched cycle by cycle.
Cycle flag_cycle(SlaveBench& bench, std::uint8_t bit) {
  for (int i = 0; i < 5000 && (bench.peek(regs::kChipCommand1) & bit) == 0; ++i) bench.run_cycles(1);
  EXPECT_NE(bench.peek(regs::kChipCommand1) & bit, 0);
  return bench.now() / kCycleTicks;
}

TEST(UserInterrupt, FallsTheCycleAfterTheFlagAndLasts64Cycles) {
  SlaveBench bench;
  bench.to_wait_prm();
  bench.acquire();
  ASSERT_TRUE(bench.set_prm({}).short_acknowledge());
  bench.run_until((bench.now() / kCycleTicks + 1) * kCycleTicks);
  EXPECT_TRUE(bench.changes(Pin::kIntr0).empty()) << "not before the data are in the DPRAM";
  bench.release();
  const Cycle flag = flag_cycle(bench, regs::kChipCommand1Prm);
  bench.run_cycles(200);
  const std::vector<PinChange> changes = bench.changes(Pin::kIntr0);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].at, (flag + 1) * kCycleTicks);
  EXPECT_EQ(changes[1].at - changes[0].at, 64 * kCycleTicks);
}

TEST(UserInterrupt, BothBlocksInOneAccessGiveTwoFullPulses) {
  SlaveBench bench;
  bench.to_wait_prm();
  bench.acquire();
  ASSERT_TRUE(bench.set_prm({}).short_acknowledge());
  ASSERT_TRUE(bench.check_cfg().short_acknowledge());
  ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  bench.run_until((bench.now() / kCycleTicks + 1) * kCycleTicks);
  bench.release();
  const Cycle prm = flag_cycle(bench, regs::kChipCommand1Prm), cfg = flag_cycle(bench, regs::kChipCommand1Cfg);
  EXPECT_LT(cfg, prm + 64);
  bench.run_cycles(400);
  const std::vector<PinChange> changes = bench.changes(Pin::kIntr0);
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ(changes[0].at / kCycleTicks, prm + 1);
  for (int i = 1; i < 4; ++i)
    EXPECT_EQ((changes[static_cast<std::size_t>(i)].at - changes[0].at) / kCycleTicks, 64 * i);
  EXPECT_EQ(accesses(bench).back().length(), 7);
}

TEST(UserInterrupt, ASecondEventInTheGapWaitsForItsEnd) {
  // A configuration of 100 bytes: its flag comes 103 + 2 + 1 cycles after the parameters', between the pulses.
  SlaveBench bench;
  Init init;
  init.cfg = Bytes(90, 0x00);
  bench.to_wait_prm(init);
  bench.acquire();
  ASSERT_TRUE(bench.set_prm({}).short_acknowledge());
  ASSERT_TRUE(bench.check_cfg(init.cfg).short_acknowledge());
  bench.run_until((bench.now() / kCycleTicks + 1) * kCycleTicks);
  bench.release();
  const Cycle prm = flag_cycle(bench, regs::kChipCommand1Prm), cfg = flag_cycle(bench, regs::kChipCommand1Cfg);
  EXPECT_GT(cfg, prm + 65);
  EXPECT_LT(cfg, prm + 128);
  bench.run_cycles(400);
  const std::vector<PinChange> changes = bench.changes(Pin::kIntr0);
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ((changes[2].at - changes[1].at) / kCycleTicks, 64) << "micro-architecture 13";
  EXPECT_EQ((changes[3].at - changes[2].at) / kCycleTicks, 64);
}

TEST(UserInterrupt, WidthAndGapAreParameters) {
  dsdpv1::Config config;
  config.intr_low = 10;
  config.intr_gap = 200;
  SlaveBench bench(config);
  bench.to_wait_prm();
  bench.acquire();
  bench.set_prm({});
  bench.check_cfg();
  bench.release();
  bench.run_cycles(600);
  const std::vector<PinChange> changes = bench.changes(Pin::kIntr0);
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ((changes[1].at - changes[0].at) / kCycleTicks, 10);
  EXPECT_EQ((changes[2].at - changes[1].at) / kCycleTicks, 200);
  EXPECT_EQ((changes[3].at - changes[2].at) / kCycleTicks, 10);
}

TEST(UserInterrupt, OutputsRaiseNone) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses(5);
  const std::size_t before = bench.changes(Pin::kIntr0).size();
  for (int i = 0; i < 10; ++i) bench.data_exchange({1, 2});
  bench.chip_accesses(5);
  EXPECT_EQ(bench.changes(Pin::kIntr0).size(), before);
}

// --- B012, B008 ------------------------------------------------------------------------------------------------------

TEST(UserStatus3, ShowsEveryStateAndRate) {
  for (int baud = 0; baud < bus::kBaudCount; ++baud) {
    dsdpv1::Config config;
    config.search_window_ms = 1;  // the search itself has its own tests
    config.search_window_bits = 400;
    SlaveBench bench(config);
    bench.power_on();
    bench.chip_accesses(2);
    EXPECT_EQ(bench.peek(regs::kChipStatus3), 0xF0) << "searching, OFFLINE";
    ASSERT_TRUE(bench.initialise());
    EXPECT_EQ(bench.peek(regs::kChipStatus3), 0xF4);
    bench.find_baud(baud);
    bench.chip_accesses(2);
    const auto rate = static_cast<std::uint8_t>(baud << 4);
    EXPECT_EQ(bench.peek(regs::kChipStatus3), rate | 0x04);
    bench.set_prm({});
    bench.chip_accesses(2);
    EXPECT_EQ(bench.peek(regs::kChipStatus3), rate | 0x08);
    bench.check_cfg();
    bench.chip_accesses(2);
    EXPECT_EQ(bench.peek(regs::kChipStatus3), rate | 0x0C);
  }
}

TEST(UserOfflineCount, CountsOverABorrowOf256HighByteFirst) {
  SlaveBench bench;
  bench.to_data_exch();
  for (int left = 1; left <= 260; ++left) {
    ASSERT_TRUE(bench.set_prm({}).short_acknowledge());  // DATA_EXCH to WAIT_CFG
    bench.chip_accesses(2);
    ASSERT_EQ(crc_at(bench, regs::kOfflineCount), left);
    ASSERT_TRUE(bench.check_cfg().short_acknowledge());
    ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  }
  EXPECT_EQ(bench.peek(regs::kOfflineCount, 2), (Bytes{1, 4}));
}

TEST(UserOfflineCount, SurvivesANewInitialisationAndNotAReset) {
  SlaveBench bench;
  bench.to_data_exch();
  ASSERT_TRUE(bench.initialise());
  EXPECT_EQ(crc_at(bench, regs::kOfflineCount), 1);
  ASSERT_TRUE(bench.initialise());
  EXPECT_EQ(crc_at(bench, regs::kOfflineCount), 1) << "WAIT_PRM is not data exchange";
  bench.chip.set(bench.now(), Pin::kReset, 0);
  bench.power_on();
  EXPECT_EQ(crc_at(bench, regs::kOfflineCount), 0);
}

TEST(UserOfflineCount, DoesNotCountOtherStates) {
  SlaveBench bench;
  bench.to_wait_cfg();
  Prm unlock;
  unlock.status = 0x40;
  bench.set_prm(unlock);
  bench.chip_accesses(3);
  EXPECT_EQ(crc_at(bench, regs::kOfflineCount), 0);
}

}  // namespace
}  // namespace dsdpv1::conformance
