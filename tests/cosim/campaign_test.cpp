// Random campaigns on the reference RTL: a fault is found, shrunk to some lines and seen again; the result does not
// depend on threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "cosim/random/campaign.hpp"
#include "cosim/random/faults.hpp"
#include "cosim/random/play_options.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using app_test::call;
using testing::ContainsRegex;
using testing::HasSubstr;

cosim::MakeTop faulty(unsigned fault) { return cosim::reference_top(cosim::quick_options(), fault, 1); }

std::string told(const cosim::CampaignResult& result) {
  return result.coverage.text(tb::kind_of(Part::kDsdpv1).reasons());
}

TEST(Campaign, ReachesDataExchangeAndIsTheSameWithOneThreadAndWithThree) {
  constexpr std::uint64_t kCycles = 3'000'000;
  const auto one = cosim::run_campaign({9, kCycles, 1}, faulty(0)),
             three = cosim::run_campaign({9, kCycles, 3}, faulty(0));
  EXPECT_FALSE(one.difference);
  EXPECT_GE(one.counts.cycles, kCycles);
  EXPECT_EQ(one.counts.cycles, three.counts.cycles);
  EXPECT_EQ(one.counts.pin_changes, three.counts.pin_changes);
  EXPECT_EQ(one.cases, three.cases);
  EXPECT_EQ(told(one), told(three));
  // Data exchange and refusals are reached.
  EXPECT_GT(one.coverage.telegrams().at("Data_Exchange"), 100U);
  EXPECT_GT(one.coverage.count(profibus::Reason::kCfgAccepted), 10U);
  EXPECT_THAT(told(one), HasSubstr("T_SYN"));
}

TEST(RtlRandom, ShrinksAFaultToAFewLinesThatShowItAgain) {
  const app_test::Folder folder;
  const app_test::Called found =
      call("rtl-random --fault 46 --seed 2 --stimulus short.stimulus --difference both.vcd", folder.path());
  EXPECT_EQ(found.status, 1);
  EXPECT_THAT(found.out, HasSubstr("dsdpv1-sim rtl-random --fault 46 --seed 2 --replay short.stimulus"));
  EXPECT_THAT(found.out, HasSubstr("pin INTR0: model 0, RTL 1"));
  EXPECT_THAT(app_test::read(folder.file("both.vcd")), HasSubstr("module rtl"));
  const std::string text = app_test::read(folder.file("short.stimulus"));
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 20) << text;

  const app_test::Called again = call("rtl-random --fault 46 --seed 2 --replay short.stimulus", folder.path());
  EXPECT_EQ(again.status, 1);
  EXPECT_THAT(again.out, HasSubstr("pin INTR0: model 0, RTL 1"));
  const app_test::Called healthy = call("rtl-random --replay short.stimulus", folder.path());
  EXPECT_EQ(healthy.status, 0) << healthy.out;
}

TEST(RtlFaults, OneThatCannotBeFoundIsCountedAndExitIs1) {
  const app_test::Folder folder;
  std::ofstream(folder.file("faults.txt"))
      << "# no such fault in the RTL\n255 uart_rx - nothing is wrong\n46 interrupt - INTR0 is low for 63 cycles\n";
  const app_test::Called called =
      call("rtl-faults --list faults.txt --directed . --cycles 3000000 --tsv kills.tsv", folder.path());
  EXPECT_EQ(called.status, 1);
  EXPECT_THAT(called.out, HasSubstr("ALIVE"));
  EXPECT_THAT(called.out, HasSubstr("1 of 2 faults found\n"));
  EXPECT_THAT(app_test::read(folder.file("kills.tsv")), HasSubstr("46\tinterrupt\tINTR0 is low for 63 cycles\tyes\t"));
}

TEST(RtlFaults, StimulusThatAFaultNamesIsPlayedFirst) {
  const app_test::Folder folder;
  for (const std::string name : {"c1", "check_cfg"})
    fs::copy(DSDPV1_SOURCE_DIR "/tests/cosim/stimuli/dsdpv1/" + name + ".stimulus", folder.file(name + ".stimulus"));
  std::ofstream(folder.file("faults.txt")) << "46 interrupt c1 INTR0 is low for 63 cycles\n"
                                           << "46 interrupt check_cfg INTR0 is low for 63 cycles\n";
  const app_test::Called called = call("rtl-faults --list faults.txt --directed . --cycles 10000", folder.path());
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, ContainsRegex(" c1: pin INTR0.*\n.* check_cfg: pin INTR0"));
}

TEST(RtlFaults, StimuliOfTheListsAreThere) {
  const std::string source = DSDPV1_SOURCE_DIR;
  for (const Part part : {Part::kDsdpv1, Part::kRsu}) {
    const std::string rtl = row(part).rtl;
    const std::vector<cosim::NamedStimulus> stimuli =
        cosim::read_stimuli(source + "/tests/cosim/stimuli/" + rtl, tb::kind_of(part));
    for (const cosim::Fault& fault : cosim::read_faults(source + "/rtl_ref/" + rtl + "/faults.txt")) {
      const auto named = [&fault](const cosim::NamedStimulus& each) { return each.name == fault.stimulus; };
      EXPECT_TRUE(std::any_of(stimuli.begin(), stimuli.end(), named)) << fault.number << " names " << fault.stimulus;
    }
  }
}

}  // namespace
}  // namespace dsdpv1
