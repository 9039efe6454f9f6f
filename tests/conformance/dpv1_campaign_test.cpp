// The random campaign of dpv1_campaign.hpp, 100 000 operations.
#include "tests/conformance/dpv1_campaign.hpp"

namespace dsdpv1::conformance {
namespace {

class LongCampaign : public Campaign, public testing::WithParamInterface<unsigned> {};

TEST_P(LongCampaign, LosesDoublesAndMixesNothing) { play(GetParam(), Engines::kSkipAlone, 25'000); }

INSTANTIATE_TEST_SUITE_P(Seeds, LongCampaign, testing::Range(11U, 15U));

}  // namespace
}  // namespace dsdpv1::conformance
