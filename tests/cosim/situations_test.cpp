// The counts of random cases, and that a campaign resumes after an interruption.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "cosim/random/campaign_record.hpp"
#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "kinds/dsdpv1/random/situation_watch.hpp"
#include "kinds/dsdpv1/random/situations.hpp"

namespace dsdpv1::cosim {
namespace {

namespace fs = std::filesystem;
using profibus::Reason;
using testing::HasSubstr;

/// The connection of the user's host.
struct HostSide {
  Part part = Part::kDsdpv1;
  HostMode mode = HostMode::kParallel;
};
constexpr HostSide kSides[] = {{Part::kDsdpv1, HostMode::kParallel},
                               {Part::kRsu, HostMode::kParallel},
                               {Part::kRsu, HostMode::kSpi},
                               {Part::kRsu, HostMode::kUart}};

bool is_known(const Situation& situation, const HostSide& side = {}) {
  const std::vector<Situation> known = known_situations(side.part, side.mode);
  return std::find(known.begin(), known.end(), situation) != known.end();
}

TEST(Situations, AreKnownOnceAtEachPort) {
  for (const HostSide& side : kSides) {
    const std::vector<Situation> known = known_situations(side.part, side.mode);
    EXPECT_EQ(std::set<Situation>(known.begin(), known.end()).size(), known.size());
  }
}

TEST(Situations, OfAPortAreNotThoseOfAnother) {
  EXPECT_TRUE(is_known({"events", "HOST_TS"}));
  EXPECT_FALSE(is_known({"events", "SPI_BUSY 0"}));
  EXPECT_FALSE(is_known({"events", "STRAP_CHANGED 0"}));
  EXPECT_TRUE(is_known({"events", "STRAP_CHANGED 0"}, kSides[1]));
  EXPECT_TRUE(is_known({"events", "SPI_BUSY 0"}, kSides[2]));
  EXPECT_FALSE(is_known({"events", "HOST_TS"}, kSides[2]));
  EXPECT_FALSE(is_known({"events", "TELEGRAM_ADDRESS 2"}, kSides[2]));
  EXPECT_TRUE(is_known({"events", "TELEGRAM_ADDRESS 2"}, kSides[3]));
  EXPECT_FALSE(is_known({"events", "INPUT_CRC"}, kSides[3]));
  EXPECT_TRUE(is_known({"replies of exchanges", "C1 in DATA_EXCH"}, kSides[3]));
}

/// SPI's read and write names no address, and a read telegram is never too long (SP4, SP10).
TEST(Situations, OfATelegramAreTheErrorsThatItCanHave) {
  for (const HostSide& side : {kSides[2], kSides[3]}) {
    EXPECT_TRUE(is_known({"telegrams of the host", "write, code 06"}, side));
    EXPECT_TRUE(is_known({"telegrams of the host", "write, code 0C"}, side));
    EXPECT_TRUE(is_known({"telegrams of the host", "write, code 0E"}, side));
    EXPECT_FALSE(is_known({"telegrams of the host", "read, code 0C"}, side));
  }
  EXPECT_TRUE(is_known({"telegrams of the host", "exchange, code 0E"}, kSides[3]));
  EXPECT_FALSE(is_known({"telegrams of the host", "read and write, code 02"}, kSides[2]));
}

/// A configuration longer than 200 bytes, in the states in which Chk_Cfg is served (S14).
TEST(Situations, OfChkCfgIncludeThatItIsTooLong) {
  EXPECT_FALSE(is_known({"services", "Chk_Cfg in WAIT_PRM: RR"}));
  EXPECT_TRUE(is_known({"services", "Chk_Cfg in WAIT_CFG: RR"}));
  EXPECT_TRUE(is_known({"services", "Chk_Cfg in DATA_EXCH: RR"}));
}

TEST(Situations, OfAnEventAreWhatTheRulingTellsApart) {
  const auto item = [](Reason reason, std::uint16_t a, std::uint16_t b = 0, std::uint16_t c = 0) {
    return event_item({0, reason, a, b, c}, "WAIT_CFG");
  };
  EXPECT_EQ(item(Reason::kPrmIdent, 1), "PRM_IDENT");
  EXPECT_EQ(item(Reason::kSapState, 55, 2), "SAP_STATE SAP 55 in 2");
  EXPECT_EQ(item(Reason::kC2Request, 48 << 8 | 0x5E), "C2_REQUEST 5E on SAP 48");
  EXPECT_EQ(item(Reason::kC2Timeout, 47, 3), "C2_TIMEOUT timer 3 on SAP 47");
  EXPECT_EQ(item(Reason::kBaudLost, 2), "BAUD_LOST WAIT_CFG");
  EXPECT_EQ(item(Reason::kC1Answer, 0x77), "C1_ANSWER other");
}

TEST(Situations, ThatAreMissingAreNamed) {
  const std::vector<Situation> known = known_situations(Part::kDsdpv1, HostMode::kParallel);
  Situations some;
  some.count("DP states", "OFFLINE to WAIT_PRM");
  some.count("DP states", "OFFLINE to WAIT_PRM");
  EXPECT_THAT(text(some, known), HasSubstr("DP states             1 of 9; never seen: WAIT_PRM to OFFLINE, "));
  EXPECT_THAT(table(some, known), HasSubstr("DP states\tOFFLINE to WAIT_PRM\t2\nDP states\tWAIT_PRM to OFFLINE\t0\n"));
  Situations more;
  more.count("events", "C1_ANSWER other");
  some.add(more);
  EXPECT_THAT(table(some, known), HasSubstr("events\tC1_ANSWER other\t1\n"));  // unknown, but counted
}

/// Whether Sync and Freeze are in force, according to Global_Control and its answers (S4, S24, S27).
TEST(SituationWatch, FollowsSyncAndFreeze) {
  const tb::Dsdpv1Settings chip;
  Situations counted;
  SituationWatch watch(chip, counted);
  const auto control = [&](std::uint16_t command) { watch.event({0, Reason::kGlobalControl, command, 0, 2}); };
  control(0x20);
  control(0x08);
  control(0x30);  // Unsync wins
  control(0x20);
  watch.event({0, Reason::kGcSync, 1});  // not requested in Set_Prm
  control(0x04);
  watch.event({0, Reason::kDpState, 3, 1});
  control(0x02);
  const auto count = [&](const char* item) { return counted.of({"Sync and Freeze", item}); };
  EXPECT_EQ(count("nothing held: Sync"), 1U);
  EXPECT_EQ(count("Sync: Freeze"), 1U);
  EXPECT_EQ(count("Sync and Freeze: Unsync"), 1U);
  EXPECT_EQ(count("Freeze: Sync"), 1U);
  EXPECT_EQ(count("Freeze: Unfreeze"), 1U);
  EXPECT_EQ(count("nothing held: Clear_Data"), 1U);
  EXPECT_EQ(counted.of({"DP states", "DATA_EXCH to WAIT_PRM"}), 1U);
}

class Record : public testing::Test {
 public:
  Record() { fs::create_directories(folder_); }
  ~Record() override { fs::remove_all(folder_); }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

 protected:
  std::string wrong(std::uint64_t seed = 7) const {
    try {
      read_record(folder_, seed);
    } catch (const tb::InputError& error) {
      return error.what();
    }
    return "";
  }
  const std::string folder_ = testing::TempDir() + "record_" + std::to_string(::getpid());
};

CampaignResult some_cases() {
  CampaignResult result;
  result.cases = 3;
  result.counts = {1000, 20, 5};
  result.coverage.add(Reason::kPrmIdent, 4);
  result.coverage.add("Set_Prm", 6);
  result.situations.count("DP states", "OFFLINE to WAIT_PRM");
  return result;
}

TEST_F(Record, IsReadAsItWasWritten) {
  CampaignRecord record = new_record(7);
  CampaignRecord::add(record.ports[2], some_cases());
  CampaignRecord::add(record.ports[2], some_cases());
  write_record(folder_, record);
  const CampaignRecord read = read_record(folder_, 7);
  EXPECT_EQ(read.cycles(), 2000U);
  EXPECT_EQ(read.ports[2].cases, 6U);
  EXPECT_EQ(read.ports[2].coverage.count(Reason::kPrmIdent), 8U);
  EXPECT_EQ(read.ports[2].coverage.telegrams().at("Set_Prm"), 12U);
  EXPECT_EQ(table(read), table(record));
  EXPECT_THAT(table(read), HasSubstr("dsdpv1_rsu spi\tDP states\tOFFLINE to WAIT_PRM\t2\n"));
}

TEST_F(Record, OfAnEmptyFolderIsANewOne) { EXPECT_EQ(read_record(folder_, 7).cycles(), 0U); }

TEST_F(Record, OfAnotherSeedOrNoneIsOneLine) {
  write_record(folder_, new_record(8));
  EXPECT_THAT(wrong(), HasSubstr("campaign.json: this campaign has seed 8, expected --seed 8 or --state"));
  std::ofstream(fs::path(folder_) / kCampaignFile) << "{\"schema\": 1}";
  EXPECT_THAT(wrong(), HasSubstr("campaign.json: no record of a campaign of this program"));
  std::ofstream(fs::path(folder_) / kCampaignFile) << "half a f";
  EXPECT_THAT(wrong(), HasSubstr("campaign.json: no record of a campaign of this program"));
  EXPECT_EQ(wrong().find('\n'), std::string::npos);
}

TEST(CampaignRecord, GivesEachPortItsShare) {
  CampaignRecord record = new_record(1);
  constexpr std::uint64_t kGoal = 200'000;
  while (PortRecord* port = record.behind(kGoal)) port->counts.cycles += 1000;
  EXPECT_EQ(record.ports[0].counts.cycles, kGoal * 55 / 100);
  EXPECT_EQ(record.ports[3].counts.cycles, kGoal * 20 / 100);
  EXPECT_EQ(record.cycles(), kGoal);
}

/// The rows of a file of docs/trust.
std::vector<std::vector<std::string>> trust_rows(const char* name) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream file(fs::path(DSDPV1_SOURCE_DIR) / "docs" / "trust" / name);
  for (std::string line, cell; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, '\t')) rows.back().push_back(cell);
  }
  return rows;
}

/// A ruling that changes what is answered changes random_changed.tsv, until random.tsv is recorded again.
TEST(CampaignRecord, OfDocsTrustHasTheSituationsOfTodayButForTheChangedOnes) {
  std::map<std::string, std::set<Situation>> recorded;
  for (const auto& row : trust_rows("random.tsv")) recorded[row.at(0)].emplace(row.at(1), row.at(2));
  std::set<Situation> come, gone;
  for (const auto& row : trust_rows("random_changed.tsv"))
    (row.at(2) == "come" ? come : gone).emplace(row.at(0), row.at(1));
  for (const PortRecord& port : new_record(1).ports) {
    const std::set<Situation>& old = recorded.at(port.name());
    for (const Situation& each : port.known()) {
      const bool is_new = come.count(each) + come.count({each.first, "*"}) != 0;
      EXPECT_NE(old.count(each) != 0, is_new) << port.name() << ": " << each.first << ", " << each.second;
      EXPECT_EQ(gone.count(each), 0U) << port.name() << ": " << each.first << ", " << each.second;
    }
  }
}

TEST(CaseSettings, VaryTheLimitsOfTheSearchInSomeCases) {
  const RandomCases& cases = *tb::kind_of(Part::kDsdpv1).random();
  std::set<std::string> different;
  int changed = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const std::vector<std::string> settings = cases.case_settings(case_seed(1, number));
    EXPECT_EQ(settings, cases.case_settings(case_seed(1, number)));
    changed += settings.empty() ? 0 : 1;
    different.insert(settings.begin(), settings.end());
  }
  EXPECT_GT(changed, 150);  // fcb_rule in half of the cases
  EXPECT_LT(changed, 225);
  const auto count = [&](const std::string& key) {
    return std::count_if(different.begin(), different.end(),
                         [&](const std::string& each) { return each.rfind("chip." + key + "=", 0) == 0; });
  };
  EXPECT_EQ(count("search_window_ms"), 2);  // and the usual one
  EXPECT_GT(count("search_window_bits"), 50);
  EXPECT_EQ(count("baud_control_ms"), 3);
}

}  // namespace
}  // namespace dsdpv1::cosim
