// The random campaign of dpv1_campaign.hpp with both engines, short.
#include "tests/conformance/dpv1_campaign.hpp"

namespace dsdpv1::conformance {
namespace {

class TwinCampaign : public Campaign, public testing::WithParamInterface<unsigned> {};

TEST_P(TwinCampaign, StepAndSkipAnswerAlike) { play(GetParam(), Engines::kStepAndSkip, 600); }

INSTANTIATE_TEST_SUITE_P(Seeds, TwinCampaign, testing::Range(1U, 5U));

}  // namespace
}  // namespace dsdpv1::conformance
