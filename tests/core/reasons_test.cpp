// The tables of reasons, one per room, and a chip's words for those of every DP slave.
#include "model/dsdpv1/reasons.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace dsdpv1 {
namespace {

using profibus::Reason;
using profibus::Words;

/// The valid placeholders of events; a name that is not in words.inc is kept.
const std::regex kValue("\\{[abc](:(2x|3x|4x|ns|state|rate|sap|rm|high|low|low2x))?\\}");

std::string without_values(const std::string& text) { return std::regex_replace(text, kValue, ""); }

TEST(ReasonTables, EveryReasonOfTheChipHasACodeOfItsOwn) {
  std::set<std::string> codes;
  for (const Reason reason : dsdpv1::reasons()) EXPECT_TRUE(codes.insert(code(reason)).second) << code(reason);
  EXPECT_EQ(codes.count("HOST_TS") + codes.count("INIT_CRC") + codes.count("PRM_IDENT"), 3U) << "a room is missing";
}

TEST(ReasonTables, NoPlaceholderIsLeftInTheWordsOfTheChipNorInTheNeutralOnes) {
  for (const Reason reason : dsdpv1::reasons()) {
    EXPECT_EQ(without_values(dsdpv1::text_template(reason)).find('{'), std::string::npos) << code(reason);
    EXPECT_EQ(dsdpv1::advice(reason).find('{'), std::string::npos) << code(reason);
    EXPECT_EQ(without_values(profibus::text_template(reason, Words())).find('{'), std::string::npos) << code(reason);
    EXPECT_EQ(profibus::advice(reason, Words()).find('{'), std::string::npos) << code(reason);
  }
}

TEST(ReasonTables, ASlaveWithoutWordsOfItsOwnSpeaksOfNoRegister) {
  const std::regex cell("B[0-7][0-9A-F]{2}");
  for (const profibus::ReasonRow& row : profibus::reasons()) {
    EXPECT_FALSE(std::regex_search(profibus::text_template(Reason(row), Words()), cell)) << row.code;
    EXPECT_FALSE(std::regex_search(profibus::advice(Reason(row), Words()), cell)) << row.code;
  }
}

TEST(ReasonTables, AChipsWordStandsWhereTheTextNamesIt) {
  Words words;
  words.sync = "MODE_REG0.3";
  EXPECT_EQ(profibus::describe({0, Reason::kGcSync, 1}, words),
            "Sync ignored: not asked for in Set_Prm (MODE_REG0.3 = 1; 0: Not_Supported)");
  EXPECT_EQ(dsdpv1::describe({0, Reason::kGcSync, 1}),
            "Sync ignored: not asked for in Set_Prm (B024.2 = 1; 0: Not_Supported)");
}

TEST(ReasonTables, TicksAreWrittenAsTimes) {
  EXPECT_EQ(dsdpv1::describe({0, dsdpv1::Reason::kWriteLowTooShort, 0x006, 120}),
            "Ts: WR was low for 10.000 ns of at least 12.500 ns when B006 was written");
  EXPECT_EQ(dsdpv1::describe({0, dsdpv1::Reason::kSpiWriteGap, 11'999, 32'400, 1}),
            "a frame begins 999.917 ns of at least 2.700 us after a telegram that writes (not heard: 1)");
  EXPECT_EQ(dsdpv1::describe({0, dsdpv1::Reason::kSpiSckHigh, 0, 1}), "SCK was high for 0.000 ns of at least 0.083 ns");
}

}  // namespace
}  // namespace dsdpv1
