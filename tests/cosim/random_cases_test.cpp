// The elements of random cases have their intended effect, in model and RTL: aimed edges, exceeded limits, the way to
// data exchange.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "cosim/random/campaign.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "kinds/dsdpv1/random/random_host.hpp"
#include "kinds/dsdpv1/random/random_user.hpp"
#include "tests/cosim/played.hpp"

namespace dsdpv1::cosim {
namespace {

/// A chip that is ready, its user with an initialisation of `cfg`, and `more`.
std::string from_power_on(const std::string& more) {
  return "reset +0 low=5000\nsync\npin +1050000 D_IN level=-1\ntake +0 poll=300\n"
         "block +0 at=20 crc=F7 xor=0 setup=200 low=600 hold=200 : 0F 05 0C C9 0F 00 00 02 02 20 ED 00 C8 00 01 31\n"
         "write +0 at=10 value=4 setup=200 low=600 hold=200\n" +
         more;
}

Stimulus parsed(const std::string& text) { return parse_stimulus(text, "x", tb::kind_of(Part::kDsdpv1)); }

/// While the user hands over the block, RESET waits for the chip to read it.
TEST(AimedEdge, FallsInThePartThatItIsAimedAt) {
  for (const int delay : {1, 249, 2000}) {
    const Played played(
        parsed(from_power_on(fmt::format("give +0\nreset +{} low=5000 during=initialisation:9000000\n", delay))));
    EXPECT_EQ(played.count("RESET falls in", "initialisation"), 1U) << delay;
    EXPECT_EQ(played.count("events", "INITIALISED"), 0U) << delay;
  }
  const Played host(parsed(from_power_on("give +0\npin +1 R_REQ level=1 during=initialisation:9000000\n")));
  EXPECT_EQ(host.count("R_REQ rises in", "initialisation"), 1U);
  EXPECT_EQ(host.count("events", "INITIALISED"), 1U);
}

/// ... and is executed anyway if that does not come in time.
TEST(AimedEdge, DoesNotWaitForEver) {
  constexpr Tick kWithin = 500'000;
  const std::string before = from_power_on("give +0\nsync\n");
  const Played without(parsed(before)),
      aimed(parsed(before + fmt::format("reset +0 low=100 during=C1_request:{}\n", kWithin)));
  EXPECT_EQ(aimed.count("RESET falls in", "C1 request"), 0U);
  EXPECT_EQ(aimed.count("RESET falls in", "-") + aimed.count("RESET falls in", "commands"), 1U);
  EXPECT_NEAR(static_cast<double>(aimed.end() - without.end()), static_cast<double>(kWithin), 500);
}

TEST(RandomUser, ExceedsEachLimitOfAnInitialisation) {
  Random random(1);
  cosim::Setup setup;
  Stimulus stimulus = parsed("reset +0 low=5000\nsync\npin +1050000 D_IN level=-1\n");
  const auto host = make_random_parallel(random, stimulus, Part::kDsdpv1);
  host->careful(true);
  RandomUser user(random, setup, *host);
  for (int i = 0; i < 120; ++i) user.initialise_wrong();
  const Played played(stimulus);
  for (const char* each :
       {"INIT_LENGTH", "INIT_ADDRESS", "INIT_CFG", "INIT_LIMIT B027", "INIT_LIMIT B028", "INIT_LIMIT B029",
        "INIT_LIMIT B02A", "INIT_LIMIT B02B", "INIT_LIMIT B02C", "INIT_LIMIT B02D", "INIT_LIMIT B02E"})
    EXPECT_GT(played.count("events", each), 0U) << each;
}

TEST(RandomCases, AtTheBeginOfACampaignHaveAFixedSubject) {
  for (std::uint64_t number = 0; number < 20; ++number)
    EXPECT_EQ(case_seed(9, number) % kLedCases, number < 7 ? number + 1 : 0) << number;
  EXPECT_NE(case_seed(9, 1) / kLedCases, case_seed(10, 1) / kLedCases);
}

/// In good order first, through the port that the straps choose: soon after power-on most cases are in data exchange.
TEST(RandomCases, BringTheSlaveUpBeforeTheyGoWild) {
  struct Port {
    Part part;
    std::vector<std::string> mode;
    int cases = 0;
    Tick cycles = 0;  ///< each: a host at the UART takes its time
  };
  for (const Port& port : {Port{Part::kDsdpv1, {}, 6, 70'000}, Port{Part::kRsu, {"chip.mode=spi"}, 6, 100'000},
                           Port{Part::kRsu, {"chip.mode=uart"}, 4, 150'000}}) {
    PlayOptions options = quick_options(tb::kind_of(port.part));
    set_parameters(options, port.mode);
    int up = 0;
    for (int number = 0; number < port.cases; ++number) {
      const std::uint64_t seed = case_seed(1, static_cast<std::uint64_t>(number));
      const Played played(random_case(seed, options), options, port.cycles * profibus::kTicksPerCycle);
      if (played.count("DP states", "WAIT_CFG to DATA_EXCH") > 0) ++up;
    }
    EXPECT_GE(2 * up, port.cases) << testing::PrintToString(port.mode);
  }
}

}  // namespace
}  // namespace dsdpv1::cosim
