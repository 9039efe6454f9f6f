// The rules on the content of the DPRAM, by accesses at the pins.
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <utility>
#include <vector>

#include "kinds/dsdpv1/checks/blocks.hpp"
#include "tests/kinds/dsdpv1/checks/board.hpp"

namespace dsdpv1 {
namespace {

using checks::Check;
using checks_test::Board;
using checks_test::Cells;

/// A hold with B006 counted correctly and the test's actions in it.
template <class Act>
void in_hold(Board& board, const Act& act) {
  board.ask();
  board.count();
  act();
  board.release();
  board.ask();  // time advances
  board.count();
  board.release();
  board.checks().finish(board.now());
}

struct Case {
  const char* name;
  Check check;
  void (*right)(Board& board);
  void (*wrong)(Board& board);
};

void inputs(Board& board, unsigned crc_low) {
  board.write(0x130, 0x02);  // 02 07 is the datasheet's example: 1241
  board.write(0x131, 0x07);
  board.write(0x132, 0x00);
  board.write(0x225, 0x50);
  board.write(0x226, crc_low);
  board.read(0x010, 0x00);
  board.write(0x010, 0x01);
}

void outputs(Board& board, bool with_crc) {
  board.read(0x319, 0x01);
  board.read(0x31A, 0x55);
  board.read(0x40E, 0x12);
  if (with_crc) board.read(0x40F, 0x34);
}

void next_hold(Board& board) {
  board.release();
  board.ask();
  board.count();
}

/// `others` of B00E stay set.
void fetch_parameters(Board& board, unsigned others = 0) {
  board.fetch(0x00E, 0x02, checks_test::kEmptyParameters, others);
}

/// Outputs of 70 bytes, of which `count` are read.
void long_outputs(Board& board, unsigned count) {
  Cells cells = {{0x319, 70}, {0x40E, 0x12}, {0x40F, 0x34}};
  for (unsigned i = 0; i < count; ++i) cells.emplace_back(0x31A + i, i);
  board.fetch(0x00E, 0x01, cells);
}

/// A C1 request with length 1, of whose data `count` bytes are read.
void request(Board& board, unsigned function, unsigned count) {
  Cells cells = {{0x5D0, function}, {0x5D1, 1}, {0x5D2, 2}, {0x5D3, 1}, {0x6C4, 0x12}, {0x6C5, 0x34}};
  for (unsigned i = 0; i < count; ++i) cells.emplace_back(0x5D4 + i, 0x77);
  board.fetch(0x00F, 0x01, cells);
}

const Case kCases[] = {
    {"CountByChip", Check::kCountByChip, [](Board&) {},
     [](Board& board) {
       board.release();
       board.ask();
       board.read(0x006, 0x07);
       board.write(0x006, 0x08);
     }},
    {"CountByUserTwice", Check::kCountByUser, [](Board&) {},
     [](Board& board) {
       board.read(0x006, 0x02);
       board.write(0x006, 0x03);
     }},
    {"CountByUserNotAtAll", Check::kCountByUser, [](Board&) {},
     [](Board& board) {
       board.release();
       board.ask();
       board.read(0x014, 0x00);
     }},
    {"CountByUserOtherValue", Check::kCountByUser, [](Board&) {},
     [](Board& board) {
       board.release();
       board.ask();
       board.read(0x006, 0x01);
       board.write(0x006, 0x01);
     }},
    {"CrcFetched", Check::kCrcFetched, [](Board& board) { outputs(board, true); },
     [](Board& board) { outputs(board, false); }},
    {"CrcFetchedOfAnEmptyBlock", Check::kCrcFetched,
     [](Board& board) {
       board.read(0x410, 0x00);  // a read that fetches nothing
     },
     [](Board& board) {
       board.read(0x00E, 0x02);
       board.read(0x410, 0x00);
       board.write(0x00E, 0x00);
     }},
    {"FlagByUserSetsTheChips", Check::kFlagByUser,
     [](Board& board) {
       board.read(0x00E, 0x01);
       outputs(board, true);
       board.write(0x00E, 0x00);
     },
     [](Board& board) {
       board.read(0x00E, 0x00);
       board.write(0x00E, 0x01);
     }},
    {"FlagByUserClearsHisOwn", Check::kFlagByUser,
     [](Board& board) {
       board.read(0x011, 0x00);
       board.write(0x011, 0x01);
       board.write(0x011, 0x03);
     },
     [](Board& board) {
       board.read(0x011, 0x00);
       board.write(0x011, 0x01);
       board.write(0x011, 0x02);
     }},
    {"FlagByUserWithdrawsTheClearingOfB00B", Check::kFlagByUser,  // D16: B011.6 is the user's, B011.7 the chip clears
     [](Board& board) {
       board.read(0x011, 0x40);
       board.write(0x011, 0xC0);
       board.write(0x011, 0x80);
     },
     [](Board& board) {
       board.read(0x011, 0x40);
       board.write(0x011, 0xC0);
       board.write(0x011, 0x40);
     }},
    {"FlagByUserSetsStatus", Check::kFlagByUser,
     [](Board& board) {
       board.read(0x00A, 0x01);
       board.write(0x00A, 0x00);
     },
     [](Board& board) {
       board.read(0x00B, 0x00);
       board.write(0x00B, 0x04);
     }},
    {"FlagByUserWithdrawsAtAnInitialisation", Check::kFlagByUser,
     [](Board& board) {
       board.write(0x0F7, 0x40);  // of the single byte B020 = 0
       board.write(0x0F8, 0xBF);
       board.read(0x010, 0x00);
       board.write(0x010, 0xC0);
       board.write(0x010, 0x04);
     },
     [](Board& board) {
       board.read(0x00E, 0x00);
       board.read(0x010, 0x00);
       board.write(0x010, 0xC0);
       board.write(0x010, 0x80);
     }},
    {"FlagByUserGivesBackWhatHeHasCleared", Check::kFlagByUser,  // P6
     [](Board& board) {
       board.read(0x00F, 0x00);
       board.write(0x00F, 0x00);
     },
     [](Board& board) {
       board.read(0x00F, 0x02);
       board.write(0x00F, 0x00);
       board.write(0x00F, 0x02);
     }},
    {"FlagByChipSetsTheUsers", Check::kFlagByChip, [](Board& board) { board.read(0x010, 0x00); },
     [](Board& board) { board.read(0x010, 0x01); }},
    {"FlagByChipClearsItsOwn", Check::kFlagByChip,
     [](Board& board) {
       board.read(0x00E, 0x01);
       board.release();
       board.ask();
       board.count();
       board.read(0x00E, 0x03);
     },
     [](Board& board) {
       board.read(0x00E, 0x03);
       board.release();
       board.ask();
       board.count();
       board.read(0x00E, 0x01);
     }},
    {"FlagByChipWritesTheUsersByte", Check::kFlagByChip, [](Board& board) { board.read(0x00C, 0x00); },
     [](Board& board) { board.read(0x00D, 0x01); }},
    {"VerdictUnfetchedOnParameters", Check::kVerdictUnfetched,
     [](Board& board) {
       board.write(0x010, 0x80);  // before the fetch: the release counts
       fetch_parameters(board);
     },
     [](Board& board) {
       board.read(0x00E, 0x02);
       board.write(0x010, 0x80);
     }},
    {"VerdictUnfetchedOnConfiguration", Check::kVerdictUnfetched,
     [](Board& board) {
       board.read(0x00E, 0x02);
       board.write(0x010, 0x40);  // the flag of the parameters is not its business
     },
     [](Board& board) {
       fetch_parameters(board, 0x04);
       board.write(0x010, 0xC0);
     }},
    {"VerdictUnfetchedWithoutALook", Check::kVerdictUnfetched,
     [](Board& board) {
       fetch_parameters(board);
       next_hold(board);
       board.write(0x010, 0x80);
     },
     [](Board& board) {
       fetch_parameters(board);
       board.write(0x010, 0x80);
       next_hold(board);
       board.read(0x010, 0x00);
       board.write(0x010, 0x80);  // a second one, without a block
     }},
    {"VerdictUnfetchedSeenEarlier", Check::kVerdictUnfetched,
     [](Board& board) {
       board.read(0x00E, 0x02);
       next_hold(board);
       board.write(0x010, 0x80);
       board.write(0x010, 0x84);
       board.write(0x010, 0x04);  // taken back, by an initialisation with its CRC
       board.write(0x0F7, 0x40);
       board.write(0x0F8, 0xBF);
     },
     [](Board& board) {
       board.read(0x00E, 0x02);
       next_hold(board);
       board.write(0x010, 0x80);
     }},
    {"VerdictUnfetchedOnANewerBlockSeenEarlier", Check::kVerdictUnfetched,
     [](Board& board) {
       fetch_parameters(board);
       next_hold(board);
       fetch_parameters(board);
       next_hold(board);
       board.write(0x010, 0x80);
     },
     [](Board& board) {
       fetch_parameters(board);
       next_hold(board);
       board.read(0x00E, 0x02);
       next_hold(board);
       board.write(0x010, 0x80);  // on the newer block, which has not been fetched
     }},
    {"VerdictUnfetchedWhenANewerBlockCame", Check::kVerdictUnfetched,
     [](Board& board) {
       fetch_parameters(board);
       board.write(0x010, 0x80);
       next_hold(board);
       board.read(0x00E, 0x02);
       board.read(0x010, 0x80);
       board.write(0x010, 0xA0);  // the verdict has been set since the earlier hold
     },
     [](Board& board) {
       fetch_parameters(board);
       next_hold(board);
       board.read(0x00E, 0x02);
       board.write(0x010, 0x80);
     }},
    {"BlockWholeOutputs", Check::kBlockWhole,
     [](Board& board) {
       board.read(0x00E, 0x01);
       outputs(board, true);
       board.write(0x00E, 0x00);
     },
     [](Board& board) {
       board.read(0x00E, 0x01);
       board.write(0x00E, 0x00);
     }},
    {"BlockWholeInOneHold", Check::kBlockWhole,
     [](Board& board) {
       board.read(0x00E, 0x01);
       next_hold(board);
       outputs(board, true);
       board.write(0x00E, 0x00);
     },
     [](Board& board) {
       board.read(0x00E, 0x01);
       outputs(board, true);
       next_hold(board);
       board.write(0x00E, 0x00);
     }},
    {"BlockWholeEachByteThatTheLengthCounts", Check::kBlockWhole, [](Board& board) { long_outputs(board, 70); },
     [](Board& board) { long_outputs(board, 69); }},
    {"BlockWholeRequestToWrite", Check::kBlockWhole, [](Board& board) { request(board, 0x5F, 1); },
     [](Board& board) { request(board, 0x5F, 0); }},
    {"BlockWholeRequestToReadHasNoBytes", Check::kBlockWhole,  // D3
     [](Board& board) { request(board, 0x5E, 0); },
     [](Board& board) {
       board.read(0x00F, 0x02);
       board.write(0x00F, 0x00);
     }},
    {"BlockWholeSetAsideByAnInitialisation", Check::kBlockWhole,  // D11
     [](Board& board) {
       board.read(0x00E, 0x01);
       board.write(0x0F7, 0x40);
       board.write(0x0F8, 0xBF);
       board.write(0x00E, 0x00);
       board.write(0x010, 0x04);
     },
     [](Board& board) {
       board.read(0x00E, 0x01);
       board.write(0x00E, 0x00);
       next_hold(board);
       board.write(0x0F7, 0x40);
       board.write(0x0F8, 0xBF);
       board.write(0x010, 0x04);
     }},
    {"CellOfChip", Check::kCellOfChip, [](Board& board) { board.write(0x014, 0x01); },
     [](Board& board) { board.write(0x012, 0x01); }},
    {"CellOfChipPrm", Check::kCellOfChip, [](Board& board) { board.write(0x31A, 0x01); },
     [](Board& board) { board.write(0x411, 0x01); }},
    {"CellOfChipBit", Check::kCellOfChip,
     [](Board& board) {
       board.read(0x00B, 0x84);
       board.write(0x00B, 0x80);
     },
     [](Board& board) {
       board.read(0x00B, 0x04);
       board.write(0x00B, 0x84);
     }},
};

void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

class EachRule : public testing::TestWithParam<Case> {};

TEST_P(EachRule, IsSilentWhenKept) {
  Board board;
  in_hold(board, [&board] { GetParam().right(board); });
  EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
}

TEST_P(EachRule, IsFoundWhenBroken) {
  Board board;
  in_hold(board, [&board] { GetParam().wrong(board); });
  const checks::Record& record = board.checks().record(GetParam().check);
  EXPECT_EQ(record.violations, 1U);
  EXPECT_EQ(record.worst_margin, std::nullopt);
  ASSERT_EQ(board.violations.size(), 1U);
  EXPECT_EQ(board.violations[0].check, GetParam().check);
  EXPECT_EQ(board.violations[0].at, record.at);
  EXPECT_FALSE(board.violations[0].text.empty());
}

INSTANTIATE_TEST_SUITE_P(Checks, EachRule, testing::ValuesIn(kCases), [](const auto& each) { return each.param.name; });

TEST(CountByChip, ZeroIsNeitherTheChipsNorWhatTheUserLeft) {
  Board board;
  board.ask();
  board.read(0x006, 0x00);
  board.write(0x006, 0x01);
  board.release();
  board.checks().finish(board.now());
  EXPECT_EQ(board.checks().record(Check::kCountByChip).violations, 1U);
  EXPECT_EQ(board.violations.size(), 1U);
}

/// The five blocks of the user, written with the CRC that `crc_over` gives for `count` bytes.
struct UserBlock {
  const char* name;
  std::vector<std::pair<unsigned, unsigned>> bytes;
  unsigned first, count, crc, command, flag;
};

const UserBlock kUserBlocks[] = {
    {"Init", {{0x020, 2}, {0x021, 5}, {0x022, 9}}, 0x020, 3, 0x0F7, 0x010, 0x04},
    {"Inputs", {{0x130, 1}, {0x131, 7}}, 0x130, 2, 0x225, 0x010, 0x01},
    {"Diagnosis", {{0x227, 1}, {0x228, 1}, {0x229, 3}}, 0x227, 3, 0x317, 0x010, 0x02},
    {"C1Read", {{0x5D0, 0x5E}, {0x5D1, 1}, {0x5D2, 2}, {0x5D3, 1}, {0x5D4, 0xA5}}, 0x5D0, 5, 0x6C4, 0x011, 0x01},
    {"C1Write", {{0x5D0, 0x5F}, {0x5D1, 1}, {0x5D2, 2}, {0x5D3, 9}}, 0x5D0, 4, 0x6C4, 0x011, 0x01},
    {"C2Error", {{0x6D0, 0xDE}, {0x6D1, 0x80}, {0x6D2, 0xB2}, {0x6D3, 0}}, 0x6D0, 4, 0x7C4, 0x011, 0x02},
    {"C2Transport", {{0x6D0, 0x51}, {0x6D1, 1}, {0x6D2, 2}, {0x6D3, 1}, {0x6D4, 3}}, 0x6D0, 5, 0x7C4, 0x011, 0x02},
};

void PrintTo(const UserBlock& each, std::ostream* out) { *out << each.name; }

class CrcWritten : public testing::TestWithParam<UserBlock> {
 protected:
  void write(Board& board, unsigned spoil, bool flag_first) const {
    const UserBlock& block = GetParam();
    std::map<unsigned, unsigned> cells(block.bytes.begin(), block.bytes.end());
    const auto crc = checks::crc_over(static_cast<checks::Address>(block.first), block.count,
                                      [&cells](checks::Address at) { return static_cast<std::uint8_t>(cells[at]); });
    const auto announce = [&] {
      board.read(block.command, 0);
      board.write(block.command, block.flag);
    };
    in_hold(board, [&] {
      if (flag_first) announce();
      for (const auto& [address, value] : block.bytes) board.write(address, value);
      board.write(block.crc, *crc >> 8);
      board.write(block.crc + 1, (*crc & 0xFFU) ^ spoil);
      if (!flag_first) announce();
    });
  }
};

TEST_P(CrcWritten, RightOneIsSilentAndCounted) {
  for (const bool flag_first : {false, true}) {
    Board board;
    write(board, 0, flag_first);
    EXPECT_EQ(board.checks().record(Check::kCrcWritten).count, 1U);
    EXPECT_TRUE(board.violations.empty()) << board.violations.front().text;
  }
}

TEST_P(CrcWritten, WrongOneIsFound) {
  Board board;
  write(board, 0x01, false);
  EXPECT_EQ(board.checks().record(Check::kCrcWritten).violations, 1U);
  ASSERT_EQ(board.violations.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Checks, CrcWritten, testing::ValuesIn(kUserBlocks),
                         [](const auto& each) { return each.param.name; });

TEST(CrcOfBlocks, IsThatOfTheDatasheetsExample) {
  const auto crc =
      checks::crc_over(0, 2, [](checks::Address at) { return static_cast<std::uint8_t>(at == 0 ? 2 : 7); });
  EXPECT_EQ(crc, 0x1241);
}

TEST(CrcOfBlocks, BlockWithAnImpossibleLengthIsNotJudged) {
  Board board;
  in_hold(board, [&board] {
    board.write(0x130, 245);
    board.read(0x010, 0);
    board.write(0x010, 0x01);
  });
  EXPECT_EQ(board.checks().record(Check::kCrcWritten).count, 0U);
}

TEST(CrcOfBlocks, AnnouncementLeftStandingFromAnEarlierHoldIsNotJudgedAgain) {
  Board board;
  in_hold(board, [&board] {
    inputs(board, 0xFF);  // wrong
    board.release();
    board.ask();
    board.count();
    board.read(0x010, 0x01);
    board.write(0x010, 0x03);  // diagnosis: all zero, so its CRC is judged too
  });
  EXPECT_EQ(board.checks().record(Check::kCrcWritten).count, 2U);
}

}  // namespace
}  // namespace dsdpv1
