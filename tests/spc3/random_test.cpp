// Random users and masters: step and skip agree, states may be saved at any moment, and whatever the user writes, the
// chip keeps its own rules.
#include "tests/spc3/random_user.hpp"

namespace dsdpv1::spc3_test {
namespace {

class RandomRuns : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomRuns, testing::Range(0U, 12U));

TEST_P(RandomRuns, StepAndSkipAgreeAndStatesContinue) {
  RandomUser user(GetParam(), Engines::kStepAndSkip);
  user.play(1000);
  EXPECT_TRUE(user.has_exchanged());
}

// With other seeds than above, and each with its own parameters.
TEST(RandomCampaign, TheRulesHoldForTenMillionAccesses) {
  constexpr int kAccesses = 10'000'000, kActsOfASeed = 100'000;
  int accesses = 0;
  for (unsigned seed = 100; accesses < kAccesses && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomUser user(seed, Engines::kSkipAlone);
    user.play(kActsOfASeed);
    EXPECT_TRUE(user.has_exchanged());
    accesses += user.accesses();
  }
}

}  // namespace
}  // namespace dsdpv1::spc3_test
