// Stimulus files: written text is read back, and wrong lines are named.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "cosim/random/faults.hpp"
#include "cosim/random/random_cases.hpp"
#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/kind.hpp"

namespace dsdpv1 {
namespace {

cosim::Stimulus parse_stimulus(const std::string& text, const std::string& file, Part part) {
  return cosim::parse_stimulus(text, file, tb::kind_of(part));
}
std::string to_text(const cosim::Stimulus& stimulus, Part part = Part::kDsdpv1) {
  return cosim::to_text(stimulus, tb::kind_of(part));
}
/// `mode`: text of --set.
cosim::Stimulus random_rsu_case(std::uint64_t seed, const char* mode) {
  cosim::PlayOptions options = cosim::quick_options(tb::kind_of(Part::kRsu));
  cosim::set_parameters(options, {mode});
  return cosim::random_case(seed, options);
}
std::string random_text(std::uint64_t seed) { return to_text(cosim::random_case(seed, cosim::quick_options())); }
constexpr const char* kModes[] = {"chip.mode=parallel", "chip.mode=spi", "chip.mode=uart"};

std::string error_of(const std::string& text, Part part = Part::kDsdpv1) {
  try {
    parse_stimulus(text, "my.stimulus", part);
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Stimulus, RandomCasesAreReadBackAsTheyWereWritten) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 77U}) {
    const std::string text = random_text(seed);
    EXPECT_EQ(to_text(parse_stimulus(text, "again", Part::kDsdpv1)), text) << seed;
  }
}

TEST(Stimulus, RandomCasesAreTheSameForTheSameSeed) {
  EXPECT_EQ(random_text(5), random_text(5));
  EXPECT_NE(random_text(5), random_text(6));
}

TEST(Stimulus, RandomCasesOfEachPortAreReadBackAsTheyWereWritten) {
  for (const char* mode : kModes) {
    const std::string text = to_text(random_rsu_case(4, mode), Part::kRsu);
    EXPECT_EQ(to_text(parse_stimulus(text, "again", Part::kRsu), Part::kRsu), text);
  }
}

TEST(Stimulus, AnActionOfUserOrBoardIsAimedAtAPartOfAnAccess) {
  const std::string text =
      "reset +12 low=5 during=C1_request:7000\nspi +1 setup=1 high=1 low=1 lead=1 lag=1 pause=0 bits=0 "
      "during=start-up:0 : 00\n";
  const cosim::Stimulus stimulus = parse_stimulus(text, "x", Part::kRsu);
  EXPECT_STREQ(stimulus[0].during, "C1 request");
  EXPECT_EQ(stimulus[0].within, 7000);
  EXPECT_EQ(to_text(stimulus, Part::kRsu), to_text({}) + text);
  EXPECT_EQ(parse_stimulus("reset +12 low=5\n", "x", Part::kDsdpv1)[0].during, nullptr);
}

/// For RESET and the host's first edges, at each port; random coincidences are not counted.
TEST(RandomAims, AimAtEachPartOfAnAccess) {
  const std::size_t parts = tb::kind_of(Part::kRsu).random()->words().access_parts.size();
  for (const char* mode : kModes) {
    std::set<const char*> reset, host;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
      for (const cosim::Action& each : random_rsu_case(seed * cosim::kLedCases, mode))
        (each.verb == cosim::Verb::kReset ? reset : host).insert(each.during);
    EXPECT_EQ(reset.size(), parts + 1) << mode;
    EXPECT_EQ(host.size(), parts + 1) << mode;
  }
}

TEST(Stimulus, EmptyLinesAndCommentsAreSkipped) {
  EXPECT_EQ(parse_stimulus("# a comment\n\nsync\n  # another\ngive +12\n", "x", Part::kDsdpv1).size(), 2U);
}

TEST(Stimulus, LinesBetweenRepeatAndEndCountAsOftenAsSaid) {
  const std::string once = "give +1\nsync\n";
  EXPECT_EQ(to_text(parse_stimulus("take +7\nrepeat 3\n" + once + "end\ngive +9\n", "x", Part::kDsdpv1)),
            to_text(parse_stimulus("take +7\n" + once + once + once + "give +9\n", "x", Part::kDsdpv1)));
}

TEST(Stimulus, FilesWithTheShortestDelaysArePlayedFirst) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "stimuli_in_order";
  fs::create_directories(folder);
  std::ofstream(folder / "a.stimulus") << "reset +500 low=1\nsync\ngive +501\n";
  std::ofstream(folder / "b.stimulus") << "give +1000\n";
  std::ofstream(folder / "c.stimulus") << "give +30\n";
  std::ofstream(folder / "d.txt") << "no stimulus\n";
  std::string order;
  for (const cosim::NamedStimulus& each : cosim::read_stimuli(folder.string(), tb::kind_of(Part::kDsdpv1)))
    order += each.name;
  fs::remove_all(folder);
  EXPECT_EQ(order, "cba");
}

TEST(Stimulus, ActionsAndPinsOfTheRsuAreForTheRsu) {
  EXPECT_EQ(error_of("spi +0 : 01\nuart +0 rate=7 : 01\npin +0 MODE level=1\n", Part::kRsu), "none");
  EXPECT_NE(error_of("fly +1\n", Part::kRsu).find("block, pin, spi, uart, reset"), std::string::npos);
}

TEST(Stimulus, AShortFileMakesNoMoreThanAMillionActions) {
  std::string thousand;
  for (int i = 0; i < 1000; ++i) thousand += "sync\n";
  EXPECT_EQ(error_of("sync\nrepeat 1000\n" + thousand + "end\n"),
            "my.stimulus:2: too many actions, allowed: 1000000 in all");
  EXPECT_EQ(error_of("sync\nrepeat 999\n" + thousand + "end\n"), "none");
}

struct Wrong {
  const char *text, *error;
};

class WrongLine : public testing::TestWithParam<Wrong> {};

TEST_P(WrongLine, IsNamedWithWhatIsAllowed) { EXPECT_EQ(error_of(GetParam().text), GetParam().error); }

INSTANTIATE_TEST_SUITE_P(
    Cases, WrongLine,
    testing::Values(
        Wrong{"sync\nfly +1\n",
              "my.stimulus:2: unknown action fly, allowed: send, spike, take, give, write, read, block, pin, reset, "
              "sync, alone, set, repeat, end"},
        Wrong{"sync\nspi +0 : 01\n",
              "my.stimulus:2: spi is an action of the DSDPV1-RSU's host, allowed: --chip dsdpv1_rsu"},
        Wrong{"uart +0 rate=7 : 01\n",
              "my.stimulus:1: uart is an action of the DSDPV1-RSU's host, allowed: --chip dsdpv1_rsu"},
        Wrong{"pin +0 MODE level=1\n",
              "my.stimulus:1: unknown word MODE, allowed: +DELAY, KEY=VALUE, : BYTES, and the name of an input pin "
              "behind pin"},
        Wrong{"write +0 at=800 value=1\n", "my.stimulus:1: wrong number 800, allowed: 0 to 7FF, hexadecimal"},
        Wrong{"write +0 to=1\n",
              "my.stimulus:1: unknown argument to, allowed: +DELAY, at=, value=, setup=, low=, hold=, during="},
        Wrong{"take +0 during=lunch:1\n",
              "my.stimulus:1: unknown part of an access lunch, allowed: start-up, commands, choice, initialisation, "
              "Set_Prm_verdict, Chk_Cfg_verdict, inputs, diagnosis, C1_answer, C2_answer, Set_Prm, Chk_Cfg, outputs, "
              "C1_request, C2_request, status_B00B"},
        Wrong{"take +0 during=inputs\n", "my.stimulus:1: no time in inputs, allowed: PART:TICKS"},
        Wrong{"take +0 during=inputs:x\n", "my.stimulus:1: wrong number x, allowed: 0 to 1099511627776"},
        Wrong{"spike +0 during=inputs:1\n", "my.stimulus:1: unknown argument during, allowed: +DELAY, low="},
        Wrong{"reset +x\n", "my.stimulus:1: wrong number x, allowed: 0 to 1099511627776"},
        Wrong{"pin +0 PBTXD level=1\n",
              "my.stimulus:1: unknown word PBTXD, allowed: +DELAY, KEY=VALUE, : BYTES, and the name of an input pin "
              "behind pin"},
        Wrong{"send +0 rate=0 gap=1 : 10\n", "my.stimulus:1: wrong fault 1, allowed: 2 numbers with : between them"},
        Wrong{"send +0 : 10 GG\n", "my.stimulus:1: wrong number GG, allowed: 0 to FF, hexadecimal"},
        Wrong{"repeat\n", "my.stimulus:1: wrong count , allowed: repeat 1 to repeat 1000"},
        Wrong{"repeat 2 3\n", "my.stimulus:1: wrong count 2 3, allowed: repeat 1 to repeat 1000"},
        Wrong{"repeat 1001\n", "my.stimulus:1: wrong count 1001, allowed: repeat 1 to repeat 1000"},
        Wrong{"sync\nrepeat 2\nsync\n",
              "my.stimulus:2: repeat without its end, allowed: end behind the lines that are repeated"},
        Wrong{"repeat 2\nrepeat 2\n", "my.stimulus:2: repeat within repeat, allowed: end first, of line 1"},
        Wrong{"sync\nend\n", "my.stimulus:2: end without repeat, allowed: repeat COUNT before it"},
        Wrong{"repeat 2\nsync\nend 2\n", "my.stimulus:3: unknown word 2, allowed: end alone"}));

}  // namespace
}  // namespace dsdpv1
