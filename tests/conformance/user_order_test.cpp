// The order of moves in a DPRAM access, cycle by cycle: rulings H3, H4; chapter 9 of docs/microarchitecture.md.
#include <string>

#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::conformance {
namespace {

/// A cell that changed, at cycles since the start of the access.
struct Move {
  Cycle cycle;
  std::uint16_t cell;
  std::uint8_t value;
  bool operator==(const Move& other) const {
    return cycle == other.cycle && cell == other.cell && value == other.value;
  }
};

std::ostream& operator<<(std::ostream& out, const Move& move) {
  return out << std::dec << move.cycle << ": B" << std::hex << move.cell << " = " << int{move.value} << std::dec;
}

struct Recorded {
  Cycle start = 0, length = 0;
  std::vector<Move> moves;
  std::vector<std::string> items;  ///< what waves show of the access, one after another
};

/// Waves show the true access of this cycle: a cell that changed is the byte that was written.
void check_inside(const SlaveBench& bench, const Bytes& before, const Bytes& now) {
  const dpram::Inside seen = bench.chip.inside().access;
  Bytes expected = before;
  if (seen.moves && seen.writes) expected.at(seen.address) = seen.byte;
  EXPECT_EQ(now, expected);
  if (seen.moves) EXPECT_EQ(now.at(seen.address), seen.byte);
}

/// Runs the next access cycle by cycle and notes every cell that changes.
Recorded record_access(SlaveBench& bench) {
  Recorded access;
  access.start = run_to_l_sta(bench, 1);
  Bytes before = bench.peek(0, regs::kDpramSize);
  for (Cycle cycle = 1; cycle < 5000; ++cycle) {
    run_to_cycle(bench, access.start + cycle);
    const Bytes now = bench.peek(0, regs::kDpramSize);
    for (std::uint16_t cell = 0; cell < regs::kDpramSize; ++cell)
      if (now[cell] != before[cell]) access.moves.push_back({cycle, cell, now[cell]});
    check_inside(bench, before, now);
    const std::string item = bench.chip.inside().access.item;
    if (access.items.empty() || access.items.back() != item) access.items.push_back(item);
    before = now;
    access.length = cycle;
    if (bench.chip.level(Pin::kLSta) == 0) return access;
  }
  ADD_FAILURE() << "the access does not end";
  return access;
}

std::uint8_t high(std::uint16_t crc) { return static_cast<std::uint8_t>(crc >> 8); }
std::uint8_t low(std::uint16_t crc) { return static_cast<std::uint8_t>(crc & 0xFF); }

/// The user fills with this so that every move is seen.
void mark(SlaveBench& bench, std::uint16_t first, int count) {
  for (int i = 0; i < count; ++i) bench.write(static_cast<std::uint16_t>(first + i), 0xEE);
}

/// Lets the user release in the middle between two edges, so that the chip starts three edges later.
void release_and_align(SlaveBench& bench) {
  bench.run_cycles(4);
  bench.release();
}

TEST(UserOrder, NothingDueTakes7Cycles) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses(3);
  bench.poke(regs::kAccessCount, 9);
  const Recorded access = record_access(bench);
  EXPECT_EQ(access.length, 7);
  EXPECT_EQ(access.moves, (std::vector<Move>{{1, 0x006, 1}}));
}

TEST(UserOrder, TheFirstAccessAfterStartUpWritesB012) {
  SlaveBench bench;
  bench.run_cycles(10);
  bench.chip.set(bench.now(), Pin::kReset, 1);
  run_to_l_sta(bench, 1);
  run_to_l_sta(bench, 0);
  const Recorded access = record_access(bench);
  EXPECT_EQ(access.length, 8);
  EXPECT_EQ(access.moves, (std::vector<Move>{{7, 0x012, 0xF0}}));
}

TEST(UserOrder, ReadBlock) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses(3);
  bench.acquire();
  bench.write(0x006, 2);  // H3: 1 again, whatever else the access does
  bench.write_block(regs::kInput, {2, 5, 6}, regs::kInputCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Input);
  release_and_align(bench);
  const Recorded access = record_access(bench);
  // 7 length, 8 look, 9 10 bytes, 11 12 CRC, 13 compare, 14 commit, 15 B00B read, 16 B00B written (no change), 17 end
  EXPECT_EQ(access.moves, (std::vector<Move>{{1, 0x006, 1}, {14, 0x010, 0}}));
  EXPECT_EQ(access.length, 17);
}

TEST(UserOrder, ReadBlockWithAWrongCrc) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses(3);
  bench.acquire();
  bench.write_block(regs::kInput, {2, 5, 6}, regs::kInputCrc, 1);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Input);
  release_and_align(bench);
  const Recorded access = record_access(bench);
  EXPECT_EQ(access.moves, (std::vector<Move>{{14, 0x010, 0}, {16, 0x00B, regs::kChipStatus2InputCrc}}));
  EXPECT_STREQ(bench.chip.inside().access.crc_of, "inputs");
  EXPECT_FALSE(bench.chip.inside().access.crc_right);
  EXPECT_EQ(access.length, 17);
}

TEST(UserOrder, ClearingOfB00BComesAfterTheVerdictsAndBeforeTheInputs) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses(3);
  bench.acquire();
  bench.write(0x00B, regs::kChipStatus2InputCrc);
  bench.write_block(regs::kInput, {2, 5, 6}, regs::kInputCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1CfgVerdict | regs::kUserCommand1Input);
  bench.write(regs::kUserCommand2, 0xC0);
  release_and_align(bench);
  const Recorded access = record_access(bench);
  // 7 8 9 verdict, 10 clearing, 11 .. 18 inputs, 19 B00B read, 20 written, 21 end
  EXPECT_EQ(access.moves, (std::vector<Move>{{9, 0x010, 1}, {10, 0x011, 0x40}, {18, 0x010, 0}, {20, 0x00B, 0}}));
  EXPECT_EQ(access.length, 21);
}

TEST(UserOrder, ClearingWithoutHistoryIsOneWrite) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses(3);
  bench.poke(regs::kUserCommand2, 0x80);
  const Recorded access = record_access(bench);
  EXPECT_EQ(access.moves, (std::vector<Move>{{7, 0x011, 0}}));
  EXPECT_EQ(access.length, 8);
}

TEST(UserOrder, LengthsThatCannotBeRightAreRefusedWithoutReading) {
  struct Try {
    std::uint16_t cell;
    std::uint8_t length, flag;
    Cycle commit;
  };
  for (const Try& one : {Try{0x130, 245, regs::kUserCommand1Input, 9}, Try{0x228, 239, regs::kUserCommand1Diag, 10}}) {
    SlaveBench bench;
    bench.to_data_exch();
    bench.chip_accesses(3);
    bench.acquire();
    bench.write(one.cell, one.length);
    bench.write(regs::kUserCommand1, one.flag);
    release_and_align(bench);
    const Recorded access = record_access(bench);
    EXPECT_EQ(access.moves, (std::vector<Move>{{one.commit, 0x010, 0}}));
    EXPECT_EQ(access.length, one.commit + 1);
  }
}

TEST(UserOrder, InitialisationVerdictsAndInputsInOneAccess) {
  SlaveBench bench;
  bench.power_on();
  bench.chip_accesses(2);
  bench.acquire();
  const Init init;
  bench.write_block(regs::kInit, init.block(), regs::kInitCrc);
  bench.write_block(regs::kInput, {2, 5, 6}, regs::kInputCrc);
  bench.write_block(regs::kDiag, {0x00, 1, 9}, regs::kDiagCrc);
  bench.write(regs::kUserCommand1, 0xC7);
  release_and_align(bench);
  const Recorded access = record_access(bench);
  const std::vector<Move> expected = {
      {28, 0x010, 0xC3},  // initialisation: 7 + 1 + 16 + 4
      {31, 0x010, 0x43},  // verdict on parameters: 29 + 2
      {34, 0x010, 0x03},  // on configuration: 32 + 2
      {42, 0x010, 0x02},  // inputs: 35 + 1 + 2 + 4
      {50, 0x010, 0x00},  // diagnosis: 43 + 2 + 1 + 4
      {51, 0x00A, 1},     // then 52 53 B00B
      {54, 0x012, 0xF4},  // then 55 B013
  };
  EXPECT_EQ(access.moves, expected);
  EXPECT_EQ(access.length, 56);
  EXPECT_EQ(access.items,
            (std::vector<std::string>{"commands", "initialisation", "Set_Prm verdict", "Chk_Cfg verdict", "inputs",
                                      "diagnosis", "status B00A", "status B00B", "status B012", "status B013", "-"}));
  EXPECT_EQ(bench.count(Reason::kVerdictUnexpected), 2);
  EXPECT_EQ(bench.chip.level(Pin::kReady), 1);
  EXPECT_EQ(bench.changes(Pin::kReady).back().at / kCycleTicks, access.start + 28) << "READY with the commit";
  EXPECT_EQ(run_to_l_sta(bench, 1), access.start + 57) << "overdue: one cycle low";
}

TEST(UserOrder, RefusedInitialisations) {
  struct Try {
    const char* name;
    Init init;
    std::vector<Move> moves;
    Cycle length;
  };
  const Try tries[] = {
      {"CRC", {.crc_error = 1}, {{28, 0x010, 0}, {29, 0x00A, 0}, {31, 0x00B, 1}}, 32},
      {"limit", {.address = 127}, {{28, 0x010, 0}, {29, 0x00A, 0}, {32, 0x013, 1}}, 33},
      {"length", {.length = 220}, {{9, 0x010, 0}, {10, 0x00A, 0}, {11, 0x013, 1}}, 12},
  };
  for (const Try& one : tries) {
    SlaveBench bench;
    bench.to_data_exch();
    bench.chip_accesses(3);
    bench.acquire();
    bench.write_block(regs::kInit, one.init.block(), regs::kInitCrc, one.init.crc_error);
    bench.write(regs::kUserCommand1, regs::kUserCommand1Init);
    release_and_align(bench);
    const Recorded access = record_access(bench);
    EXPECT_EQ(access.moves, one.moves) << one.name;
    EXPECT_EQ(access.length, one.length) << one.name;
  }
}

TEST(UserOrder, FromTheUserThenToTheUserThenStatusBytes) {
  SlaveBench bench;
  bench.to_data_exch();
  bench.chip_accesses(3);
  bench.acquire();
  bench.write(regs::kChipCommand1, 0);
  mark(bench, regs::kOutput, 3);
  mark(bench, regs::kOutputCrc, 2);
  mark(bench, regs::kPrm, 3);
  mark(bench, regs::kPrmCrc, 2);
  mark(bench, regs::kCfg, 5);
  mark(bench, regs::kCfgCrc, 2);
  bench.write_block(regs::kInput, {2, 5, 6}, regs::kInputCrc, 1);
  bench.write_block(regs::kDiag, {0x81, 3, 7, 8, 9}, regs::kDiagCrc);
  bench.write(regs::kUserCommand1, regs::kUserCommand1Input | regs::kUserCommand1Diag);
  // Meanwhile the master parameterises and configures again and sends outputs: everything is due at once.
  ASSERT_TRUE(bench.set_prm({.user = {0x33, 0x44}}).short_acknowledge());
  ASSERT_TRUE(bench.check_cfg({0x11, 0x21}).short_acknowledge());
  ASSERT_TRUE(bench.data_exchange({0x51, 0x52}).answered());
  bench.run_until((bench.now() / kCycleTicks + 1) * kCycleTicks + 125);
  bench.release();
  const Recorded access = record_access(bench);
  const std::uint16_t prm = document_crc({2, 0x33, 0x44}), cfg = document_crc({2, 2, 2, 0x11, 0x21}),
                      output = document_crc({2, 0x51, 0x52});
  const std::vector<Move> expected = {
      {14, 0x010, 2},  // inputs committed: 7 + 1 + 2 + 4
      {24, 0x010, 0},  // diagnosis: 15 + 2 + 3 + 4
      {25, 0x410, 2},
      {26, 0x411, 0x33},
      {27, 0x412, 0x44},
      {28, 0x4FE, high(prm)},
      {29, 0x4FF, low(prm)},
      {30, 0x00E, 2},  // flag of the parameters
      {31, 0x500, 2},
      {32, 0x501, 2},
      {33, 0x502, 2},
      {34, 0x503, 0x11},
      {35, 0x504, 0x21},
      {36, 0x5CB, high(cfg)},
      {37, 0x5CC, low(cfg)},
      {38, 0x00E, 6},  // flag of the configuration
      {39, 0x319, 2},
      {40, 0x31A, 0x51},
      {41, 0x31B, 0x52},
      {42, 0x40E, high(output)},
      {43, 0x40F, low(output)},
      {44, 0x00E, 7},  // flag of the outputs
      {45, 0x009, 1},  // data exchange was left once; 46 47 B00B
      {47, 0x00B, regs::kChipStatus2InputCrc},
  };
  EXPECT_EQ(access.moves, expected);
  EXPECT_EQ(access.length, 48) << "B012 is as it was";
  EXPECT_EQ(access.items, (std::vector<std::string>{"commands", "inputs", "diagnosis", "Set_Prm", "Chk_Cfg", "outputs",
                                                    "offline count", "status B00B", "-"}));
  EXPECT_STREQ(bench.chip.inside().access.crc_of, "diagnosis");
  EXPECT_TRUE(bench.chip.inside().access.crc_right);
  const std::vector<PinChange> interrupt = bench.changes(Pin::kIntr0);
  EXPECT_EQ(interrupt.back().level, 0);
  EXPECT_EQ(interrupt.back().at / kCycleTicks, access.start + 31);
  EXPECT_EQ(run_to_l_sta(bench, 1), access.start + 49);
}

class UserOrderWithDpv1 : public Dpv1Test {};

// H4: all that one access may hold in operation but the verdicts and the clearing.
TEST_F(UserOrderWithDpv1, AnswersComeAfterTheDiagnosisAndRequestsAfterTheOutputs) {
  start();
  ASSERT_EQ(connect(), kFirstChannel);
  bench.chip_accesses(3);
  bench.acquire();
  bench.write(0x00E, 0);
  for (const std::uint16_t block : std::vector<std::uint16_t>{0x319, 0x410, 0x500}) mark(bench, block, 5);
  for (const std::uint16_t crc : std::vector<std::uint16_t>{0x40E, 0x4FE, 0x5CB}) mark(bench, crc, 2);
  bench.write_block(0x130, {2, 5, 6}, 0x225);
  bench.write_block(0x227, {0x81, 3, 7, 8, 9}, 0x317);
  for (const Area& area : {kC1Area, kC2Area}) bench.write_block(area.base, {0xDE, 0x80, 0xB2, 0}, area.crc);
  bench.write(0x010, 0x03);
  bench.write(0x011, 0x03);
  Prm prm;
  prm.user = {0x80, 0, 0};
  ASSERT_TRUE(is_sc(bench.set_prm(prm)));
  ASSERT_TRUE(is_sc(bench.check_cfg()));
  ASSERT_TRUE(bench.data_exchange({0x51, 0x52}).answered());
  ASSERT_TRUE(is_sc(c1(read_request(1, 2, 3))));
  ASSERT_TRUE(is_sc(c2(kFirstChannel, read_request(4, 5, 6))));
  bench.run_until((bench.now() / kCycleTicks + 1) * kCycleTicks + 125);
  bench.release();
  const Recorded access = record_access(bench);
  const std::uint16_t parameters = document_crc({3, 0x80, 0, 0}), cfg = document_crc({2, 2, 2, 0x11, 0x21}),
                      output = document_crc({2, 0x51, 0x52}), first = document_crc({0x5E, 1, 2, 3}),
                      second = document_crc({0x5E, 4, 5, 6});
  const std::vector<Move> expected = {
      {14, 0x010, 2},  // inputs
      {24, 0x010, 0},  // diagnosis
      {33, 0x011, 2},  // C1 answer, which nothing asked for: 25 + 4 + 4
      {42, 0x011, 0},  // C2 answer
      {43, 0x410, 3},
      {44, 0x411, 0x80},
      {45, 0x412, 0},
      {46, 0x413, 0},
      {47, 0x4FE, high(parameters)},
      {48, 0x4FF, low(parameters)},
      {49, 0x00E, 2},
      {50, 0x500, 2},
      {51, 0x501, 2},
      {52, 0x502, 2},
      {53, 0x503, 0x11},
      {54, 0x504, 0x21},
      {55, 0x5CB, high(cfg)},
      {56, 0x5CC, low(cfg)},
      {57, 0x00E, 6},
      {58, 0x319, 2},
      {59, 0x31A, 0x51},
      {60, 0x31B, 0x52},
      {61, 0x40E, high(output)},
      {62, 0x40F, low(output)},
      {63, 0x00E, 7},
      {64, 0x5D0, 0x5E},  // C1 request
      {65, 0x5D1, 1},
      {66, 0x5D2, 2},
      {67, 0x5D3, 3},
      {68, 0x6C4, high(first)},
      {69, 0x6C5, low(first)},
      {70, 0x00F, 1},
      {71, 0x6D0, 0x5E},  // C2 request
      {72, 0x6D1, 4},
      {73, 0x6D2, 5},
      {74, 0x6D3, 6},
      {75, 0x7C4, high(second)},
      {76, 0x7C5, low(second)},
      {77, 0x00F, 3},
      {78, 0x009, 1},  // then 79 80 B00B
  };
  EXPECT_EQ(access.moves, expected);
  EXPECT_EQ(access.length, 81);
}

TEST(UserOrder, LongestWriteBlock) {
  SlaveBench bench;
  Init init;
  init.cfg = {0xC0, 0x7F, 0x7F, 0xC0, 0x79, 0x79};
  bench.to_data_exch(init);
  bench.chip_accesses(3);
  bench.acquire();
  ASSERT_TRUE(bench.data_exchange(Bytes(244, 0x5A)).answered());
  bench.run_until((bench.now() / kCycleTicks + 1) * kCycleTicks + 125);
  bench.release();
  const Recorded access = record_access(bench);
  ASSERT_FALSE(access.moves.empty());
  EXPECT_EQ(access.moves.back(), (Move{254, 0x00E, 7}));  // 7 + 245 + 2
  EXPECT_EQ(access.length, 255);
}

TEST(UserOrder, BlocksOfTheUserInTheSameAccessReachTheAnswerOfTheSameCycle) {
  // Chapter 3: a telegram decided at n sees inputs committed at n. The request is moved cycle by cycle past the commit.
  int fresh = 0, stale = 0;
  for (Cycle shift = 0; shift < 60; ++shift) {
    SlaveBench bench;
    bench.to_data_exch();
    bench.chip_accesses(3);
    bench.acquire();
    bench.write_block(regs::kInput, {2, 5, 6}, regs::kInputCrc);
    bench.write(regs::kUserCommand1, regs::kUserCommand1Input);
    bench.run_cycles(4);
    const Tick bit = bench.requester.bit();
    const Cycle begin = bench.now() / kCycleTicks + 300;
    // 11 characters: S of the last one is 110 bits after the first, its decision 12 bits and a cycle later (chapter 7).
    const bus::Bytes request = bus::encode(bus::make_telegram(5, 2, bench.fcb ? 0x7D : 0x5D, {0, 0}));
    const Tick last_start = begin * kCycleTicks + static_cast<Tick>(request.size() - 1) * 11 * bit;
    const Cycle decided = seen_at(last_start) + 12 * bit / kCycleTicks + 1;
    const Cycle start = decided - 14 - 30 + shift;  // of the access: its commit is at start + 14
    Script script(bench);
    script.set((start - 3) * kCycleTicks + 100, Pin::kRSta, 0);
    script.set((start - 3) * kCycleTicks + 100, Pin::kRReq, 0);
    const bus::Exchange exchange = bench.requester.send(bench.timeline, request, {.at = begin * kCycleTicks});
    bench.run_cycles(1);
    ASSERT_TRUE(exchange.answered());
    ASSERT_EQ(seen_at((start - 3) * kCycleTicks + 100), start);
    const bool sees = start + 14 <= decided;
    EXPECT_EQ(exchange.answer().data, sees ? (Bytes{5, 6}) : (Bytes{0, 0}))
        << "commit " << start + 14 << ", decided " << decided;
    (sees ? fresh : stale) += 1;
  }
  EXPECT_GT(fresh, 20);
  EXPECT_GT(stale, 20);
}

TEST(UserOrder, OutputsAreTakenByTheFirstChoiceAfterTheDecision) {
  // 9.2: mail is due at a choice when it was there before it. The decision is moved cycle by cycle past the choice s
  // + 7.
  for (Cycle shift = 0; shift < 48; ++shift) {
    SlaveBench bench;
    bench.to_data_exch();
    bench.chip_accesses(3);
    bench.fetch_outputs();
    bench.chip_accesses(3);
    const Cycle begin = bench.now() / kCycleTicks + 300 + shift;
    const bus::Bytes request = bus::encode(bus::make_telegram(5, 2, bench.fcb ? 0x7D : 0x5D, {1, 2}));
    const Tick bit = bench.requester.bit();
    const Tick last_start = begin * kCycleTicks + static_cast<Tick>(request.size() - 1) * 11 * bit;
    const Cycle decided = seen_at(last_start) + 12 * bit / kCycleTicks + 1;
    bench.requester.send(bench.timeline, request, {.at = begin * kCycleTicks});
    bench.run_cycles(60);
    for (const Access& access : accesses(bench)) {
      if (access.rise + 7 <= decided) continue;
      EXPECT_EQ(access.length(), 7 + 3 + 2 + 1) << "shift " << shift;
      EXPECT_LE(access.rise + 7 - decided, 48);
      break;
    }
    EXPECT_EQ(bench.fetch_outputs(), (Bytes{1, 2}));
  }
}

TEST(UserOrder, AFlagCountsFromTheEdgeAtWhichTheHeaderReadsIt) {
  // The user writes B010 without owning: settled at the edge of s + 2 it is read there (chapter 3), one cycle later it
  // waits.
  for (const Cycle settles : {1, 2, 3, 4}) {
    SlaveBench bench;
    bench.to_data_exch();
    bench.chip_accesses(3);
    bench.acquire();
    bench.write_block(regs::kInput, {2, 5, 6}, regs::kInputCrc);
    release_and_align(bench);
    const Cycle start = run_to_l_sta(bench, 1) + 48;
    const Tick rise = (start + settles - 3) * kCycleTicks + 10;
    bench.run_until(rise - 600);
    bench.chip.set(bench.now(), Pin::kA, regs::kUserCommand1);
    bench.chip.set(bench.now(), Pin::kDIn, regs::kUserCommand1Input);
    bench.chip.set(bench.now(), Pin::kCsr, 0);
    bench.chip.set(bench.now(), Pin::kWr, 0);
    bench.run_until(rise);
    bench.chip.set(rise, Pin::kWr, 1);
    run_to_cycle(bench, start + 20);
    EXPECT_EQ(accesses(bench).back().rise, start);
    EXPECT_EQ(accesses(bench).back().length(), settles <= 2 ? 17 : 7) << "settles at s + " << settles;
  }
}

}  // namespace
}  // namespace dsdpv1::conformance
