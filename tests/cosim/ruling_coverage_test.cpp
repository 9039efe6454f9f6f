// Which rulings runs have exercised.
#include "cosim/random/ruling_coverage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "cosim/random/play_options.hpp"
#include "cosim/random/random_cases.hpp"
#include "tb/bench/ruling_place.hpp"

namespace dsdpv1 {
namespace {

using cosim::RulingCoverage;
using cosim::Seen;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kDocuments = {DSDPV1_SOURCE_DIR "/docs/chip.md", DSDPV1_SOURCE_DIR "/docs/chip_rsu.md"};

RulingCoverage coverage_of(const char* kind) { return {*tb::find_chip_kind(kind), kDocuments}; }

const RulingCoverage::Ruling& ruling(const RulingCoverage& coverage, const std::string& name) {
  const auto& all = coverage.rulings();
  return *std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
}

std::string line_of(const std::string& file, int number) {
  std::ifstream text(file);
  std::string line;
  for (int i = 0; i < number; ++i) std::getline(text, line);
  return line;
}

TEST(RulingCoverage, HasAllRulingsOfTheDocumentsWithTheirLines) {
  const RulingCoverage coverage = coverage_of("dsdpv1");
  EXPECT_EQ(coverage.rulings().size(), 147U);
  for (const RulingCoverage::Ruling& each : coverage.rulings())
    EXPECT_THAT(line_of(each.document, each.line), HasSubstr("- **" + each.name + "**"));
  EXPECT_THAT(ruling(coverage, "S9").title, HasSubstr("The telegram that ends the baud search only locks the rate"));
}

TEST(RulingCoverage, SituationsNameRulingsThatExist) {
  const RulingCoverage coverage = coverage_of("dsdpv1_rsu");
  for (const char* kind : {"dsdpv1", "dsdpv1_r", "dsdpv1_rsu"}) {
    const cosim::RandomCases& cases = *tb::find_chip_kind(kind)->random();
    for (const cosim::HostPort& port : cases.words().ports) {
      cosim::PlayOptions options = cosim::usual_options(*tb::find_chip_kind(kind));
      cosim::set_parameters(options, port.set);
      for (const cosim::Situation& each : cases.known_situations(*options.chip)) {
        const std::string rulings = cases.rulings_of(each, *options.chip);
        if (each.first != "events" && each.first != "written and read")
          EXPECT_NE(rulings, "") << each.first << ": " << each.second;
        for (const std::string& name : tb::names_of(rulings))
          if (each.first != "events")  // which name clauses as well
            EXPECT_TRUE(std::any_of(coverage.rulings().begin(), coverage.rulings().end(), [&](const auto& one) {
              return one.name == name;
            })) << name;
      }
    }
  }
}

TEST(RulingCoverage, EventsAndSituationsCountForTheirRulings) {
  RulingCoverage coverage = coverage_of("dsdpv1");
  Seen first, second;
  first.codes = {{"PRM_IDENT", 2}, {"NO_SUCH_CODE", 5}};
  second.codes = {{"PRM_IDENT", 1}};
  second.situations.add({"Sync and Freeze", "Sync: Freeze"}, 4);
  coverage.add(0, first);
  coverage.add(3, second);
  const RulingCoverage::Ruling& ident = ruling(coverage, "S6");
  EXPECT_EQ(ident.items.at("event PRM_IDENT"), 3U);
  EXPECT_EQ(ident.runs, (std::set<std::size_t>{0, 3}));
  EXPECT_EQ(ruling(coverage, "S27").items.at("Sync and Freeze: Sync: Freeze"), 4U);
  EXPECT_EQ(ruling(coverage, "S27").runs, (std::set<std::size_t>{3}));
  EXPECT_EQ(ruling(coverage, "S4").count(), 4U);
  EXPECT_EQ(ruling(coverage, "S24").count(), 0U);
}

TEST(RulingCoverage, AChangeOfStateCountsForItsStatesWhereTheyAreKnown) {
  RulingCoverage coverage = coverage_of("dsdpv1");
  Seen seen;
  seen.codes = {{"DP_STATE", 2}};
  seen.situations.add({"DP states", "OFFLINE to WAIT_PRM"}, 2);
  coverage.add(0, seen);
  EXPECT_EQ(ruling(coverage, "D7").count(), 2U);
  EXPECT_EQ(ruling(coverage, "S18").count(), 0U);
  seen.situations.add({"DP states", "DATA_EXCH to WAIT_PRM"}, 1);
  coverage.add(1, seen);
  EXPECT_EQ(ruling(coverage, "S18").runs, (std::set<std::size_t>{1}));
  Seen scenario;
  scenario.codes = {{"DP_STATE", 1}};
  coverage.add(2, scenario);
  EXPECT_EQ(ruling(coverage, "S18").items.at("event DP_STATE"), 1U);
}

/// Every access reads the commands, and a reset is followed by a start-up.
TEST(RulingCoverage, AnAccessWithoutATransferDoesNotExerciseTheOrderOfTransfers) {
  RulingCoverage coverage = coverage_of("dsdpv1");
  Seen seen;
  seen.situations.add({"transfers", "commands"}, 5);
  seen.situations.add({"transfers", "start-up"}, 1);
  coverage.add(0, seen);
  EXPECT_EQ(ruling(coverage, "H3").count(), 5U);
  EXPECT_EQ(ruling(coverage, "H4").count(), 0U);
  EXPECT_EQ(ruling(coverage, "H6").count(), 1U);
}

TEST(RulingCoverage, APortHasItsOwnRulings) {
  RulingCoverage coverage = coverage_of("dsdpv1_rsu");
  Seen seen;
  seen.mode = "uart";
  seen.situations.add({"telegrams of the host", "write, code 00"}, 1);
  coverage.add(0, seen);
  EXPECT_EQ(ruling(coverage, "UA5").count(), 1U);
  EXPECT_EQ(ruling(coverage, "SP9").count(), 0U);
  EXPECT_FALSE(ruling(coverage, "SP9").items.empty()) << "but it can be";
  EXPECT_TRUE(ruling(coverage_of("dsdpv1"), "SP9").items.empty()) << "not in this chip";
}

TEST(RulingCoverage, TablesNameWhatWasNeverSeen) {
  RulingCoverage coverage = coverage_of("dsdpv1");
  EXPECT_THAT(summary(coverage), HasSubstr("0 of "));
  Seen seen;
  seen.codes = {{"PRM_IDENT", 7}};
  coverage.add(0, seen);
  const std::string table = tsv(coverage);
  EXPECT_THAT(table, HasSubstr("\nS6\tchip.md#s6\texercised\t7\t1\t1\t"));
  EXPECT_THAT(table, HasSubstr("\nS27\tchip.md#s27\tnever\t0\t0\t0\t"));
  EXPECT_THAT(table, HasSubstr("Sync and Freeze: Sync: Freeze"));
  EXPECT_THAT(table, HasSubstr("\nP2\tchip.md#p2\tby pins alone\t0\t0\t0\t0\tPBRTS\t"));
  EXPECT_THAT(table, HasSubstr("\nD18\tchip.md#d18\tnothing shows it\t"));
  EXPECT_THAT(html(coverage, {"a<b>.yaml"}), HasSubstr("a&lt;b&gt;.yaml"));
  const std::string tracefile = lcov(coverage.files());
  EXPECT_THAT(tracefile, HasSubstr("SF:" DSDPV1_SOURCE_DIR "/docs/chip.md\n"));
  EXPECT_THAT(tracefile, HasSubstr("FNDA:7,event PRM_IDENT"));
  EXPECT_THAT(tracefile, HasSubstr("DA:" + std::to_string(ruling(coverage, "S6").line) + ",7\n"));
  EXPECT_THAT(tracefile, Not(HasSubstr("DA:" + std::to_string(ruling(coverage, "P2").line) + ",")));
}

}  // namespace
}  // namespace dsdpv1
