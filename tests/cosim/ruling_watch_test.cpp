// Situations of rulings that no event names: each occurs where its ruling is exercised, and not beside it.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "kinds/dsdpv1/kind.hpp"
#include "tests/cosim/played.hpp"

namespace dsdpv1::cosim {
namespace {

std::string stimulus_text(const std::string& name) {
  std::ifstream file(DSDPV1_SOURCE_DIR "/tests/cosim/stimuli/dsdpv1/" + name + ".stimulus");
  return {std::istreambuf_iterator<char>(file), {}};
}

Played played(const std::string& text, Part part = Part::kDsdpv1) {
  const tb::ChipKind& kind = tb::kind_of(part);
  return Played(parse_stimulus(text, "x", kind), quick_options(kind));
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

constexpr const char* kInitialised =
    "reset +0 low=6541\npin +600000 D_IN level=-1\nsync\ntake +0\n"
    "block +0 at=20 crc=F7 : 10 05 0C C9 0F 00 00 F4 F4 20 ED 00 C8 00 02 11 21\n"
    "write +0 at=5 value=1D\nwrite +0 at=10 value=4\ngive +0\npin +50000 D_IN level=-1\nsync\n";
constexpr const char* kStatus = "send +40000 rate=0 reply=270 : 10 05 02 49 50 16\n";
constexpr const char* kPoll = "send +18000000 rate=0 reply=270 : 68 05 05 68 85 82 6D 30 32 D6 16\n";
constexpr const char* kMilliseconds = "send +18000000 rate=0 reply=270 : 10 05 02 49 50 16\n";  // 1.5

TEST(RulingWatch, SeesWhatB00B2MeansAndItsClearing) {
  const Played history = played(stimulus_text("history"));
  for (const char* each : {"history: B011.7 falls", "history: B011.7 clears it", "history: B011.7 with a wrong block",
                           "history: a wrong block sets it", "history: a right block leaves it",
                           "present: B011.7 falls", "present: B011.7 leaves it"})
    EXPECT_GT(history.count("B00B.2 and B011", each), 0U) << each;
  const Played plain = played(stimulus_text("user_blocks"));
  for (const char* each : {"history: B011.7 falls", "history: a wrong block sets it", "present: B011.7 falls"})
    EXPECT_EQ(plain.count("B00B.2 and B011", each), 0U) << each;
}

TEST(RulingWatch, SeesAMinTsdrBeyondItsLimitsWhenAnAnswerFollows) {
  const std::string right = "68 0F 0F 68 85 82 6D 3D 3E 80 00 00 0B 0C C9 00 80 00 00 CF 16\n";
  const std::string up = std::string(kInitialised) + kStatus + "send +40000 rate=0 reply=270 : ";
  EXPECT_EQ(played(up + right).count("min_TSDR", "below 11"), 0U);
  const Played below = played(up + replaced(replaced(right, "0B 0C", "05 0C"), "CF 16", "C9 16"));
  EXPECT_EQ(below.count("min_TSDR", "below 11"), 1U);
  EXPECT_EQ(below.count("min_TSDR", "above max_TSDR"), 0U);
  // 3 Mbit/s: max_TSDR is 250.
  const std::string slow =
      std::string(kInitialised) + "repeat 60\nsend +200000 rate=2 reply=270 : 10 05 02 49 50 16\nend\n";
  const Played above =
      played(slow + "send +200000 rate=2 reply=600 : " + replaced(replaced(right, "0B 0C", "FF 0C"), "CF 16", "C3 16"));
  EXPECT_EQ(above.count("min_TSDR", "above max_TSDR"), 1U);
}

/// Asked for four bytes.
TEST(RulingWatch, SeesAnswersThatAreShorterOrLongerThanTheReadAsked) {
  const std::string turn = stimulus_text("c2_turn_timer_u"), answer = ": 5E 01 02 01 07\n";
  const Played shorter = played(turn);
  EXPECT_EQ(shorter.count("answers to reads", "C2 shorter"), 1U);
  EXPECT_EQ(shorter.count("answers to reads", "C2 longer"), 0U);
  EXPECT_EQ(played(replaced(turn, answer, ": 5E 01 02 05 07 08 09 0A 0B\n")).count("answers to reads", "C2 longer"),
            1U);
  const Played right = played(replaced(turn, answer, ": 5E 01 02 04 07 08 09 0A\n"));
  EXPECT_EQ(right.count("answers to reads", "C2 shorter") + right.count("answers to reads", "C2 longer"), 0U);
}

TEST(RulingWatch, SeesTimerUEndAfterARequestAndAfterATurn) {
  std::string more;
  for (int i = 0; i < 8; ++i) more += kMilliseconds;
  const Played turn = played(stimulus_text("c2_turn_timer_u") + more);
  EXPECT_EQ(turn.count("timer U", "ends after a turn"), 1U);
  EXPECT_EQ(turn.count("timer U", "ends after a request"), 0U);
  const std::string late =
      "sync\ntake +0\nblock +0 at=6D0 crc=7C4 : 5E 01 03 01 07\nwrite +0 at=11 value=2\ngive +0\n"
      "pin +75000 D_IN level=-1\n";
  EXPECT_EQ(played(stimulus_text("c2_turn_timer_u") + more + late).count("timer U", "an answer after it"), 1U);
  std::string alone = stimulus_text("c2_turn_timer_u");
  alone = alone.substr(0, alone.find("send +40000 rate=0 reply=270 : 68 09 09 68 85 83"));
  for (int i = 0; i < 8; ++i) alone += kPoll;
  EXPECT_EQ(played(alone).count("timer U", "ends after a request"), 1U);
}

TEST(RulingWatch, SeesAReservedCellThatIsWrittenAndRead) {
  const std::string up = std::string(kInitialised) + "take +0\n";
  EXPECT_EQ(
      played(up + "write +0 at=7 value=A5\nread +2000 at=7\ngive +0\n").count("reserved cells", "written and read"),
      1U);
  EXPECT_EQ(played(up + "write +0 at=8 value=A5\nread +2000 at=8\nread +2000 at=7\ngive +0\n")
                .count("reserved cells", "written and read"),
            0U);
}

/// A request of C2 comes while the user holds the DPRAM and has set B011.1.
TEST(RulingWatch, SeesARequestThatComesWhileAnAnswerWaits) {
  const std::string turn = stimulus_text("c2_turn_timer_u");
  const std::string up = turn.substr(0, turn.find("send +40000 rate=0 reply=270 : 68 09 09 68 85 82"));
  const std::string request = "send +40000 rate=0 reply=270 : 68 09 09 68 85 82 6D 30 32 5E 01 02 04 3B 16\nsync\n";
  const auto text = [&](const char* b011) {
    return up + "sync\ntake +0\nwrite +0 at=11 value=" + b011 + "\nsync\n" + request +
           "give +0\npin +75000 D_IN level=-1\n";
  };
  EXPECT_EQ(played(text("2"), Part::kR).count("requests before answers", "C2"), 1U);
  EXPECT_EQ(played(text("0"), Part::kR).count("requests before answers", "C2"), 0U);
}

}  // namespace
}  // namespace dsdpv1::cosim
