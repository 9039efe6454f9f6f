// The directed stimuli required by coverage: model and RTL do not differ, and the model reports the intended situation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

struct Directed {
  const char* name;
  std::vector<std::string> told;  ///< events and their numbers, as rtl-random prints them
};

class DirectedStimulus : public testing::TestWithParam<Directed> {};
class DirectedRsuStimulus : public testing::TestWithParam<Directed> {};

void plays(const Directed& directed, const std::string& options) {
  const app_test::Called called =
      app_test::call("rtl-random " + options + directed.name + ".stimulus", DSDPV1_SOURCE_DIR);
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  for (const std::string& told : directed.told) EXPECT_THAT(called.out, testing::HasSubstr(" " + told + " "));
}

TEST_P(DirectedStimulus, DoesNotDifferAndReachesWhatItIsFor) {
  plays(GetParam(), "--replay tests/cosim/stimuli/dsdpv1/");
}

TEST_P(DirectedRsuStimulus, DoesNotDifferAndReachesWhatItIsFor) {
  plays(GetParam(), "--chip dsdpv1_rsu --replay tests/cosim/stimuli/dsdpv1_rsu/");
}

TEST(RepetitionStimulus, DoesNotDifferInEitherFormOfFcbRule) {
  const std::string replay = " --replay tests/cosim/stimuli/dsdpv1/";
  plays({"repetition", {"REPETITION 13", "FCB_NOT_TOGGLED 17"}}, "--set chip.fcb_rule=letter" + replay);
  plays({"repetition", {"REPETITION 14"}}, "--set chip.fcb_rule=content" + replay);
}

void PrintTo(const Directed& each, std::ostream* out) { *out << each.name; }

INSTANTIATE_TEST_SUITE_P(
    All, DirectedStimulus,
    testing::Values(
        Directed{"init_limits", {"INIT_LENGTH 3", "INIT_LIMIT 9", "INIT_CFG 3", "INITIALISED 1"}},
        Directed{"verdicts", {"PRM_USER 2", "CFG_USER 2", "PRM_OK 6", "CFG_OK 4", "VERDICT_UNEXPECTED 4"}},
        Directed{"verdict_in_search", {"PRM_OK 4", "BAUD_FOUND 7", "WD_ON 2", "WD_EXPIRED 2"}},
        Directed{"verdict_at_the_lock", {"PRM_OK 10", "BAUD_LOST 7", "WD_ON 10"}},
        Directed{"diagnosis", {"DIAG 9", "DIAG_LENGTH 1", "DIAG_TYPE 1"}},
        Directed{"service_lengths",
                 {"ADDRESS 2", "ADDRESS_TOO_LONG 1", "CFG_TOO_LONG 1", "DX_FAIL_SAFE 1", "DX_LENGTH 1", "SAP_DATA 7"}},
        Directed{"longest_blocks", {"PRM_OK 1", "CFG_OK 1", "DIAG 3", "Slave_Diag 3"}},
        Directed{"banks", {"Check_Cfg 19", "Global_Control 14", "CFG_OK 10"}},
        Directed{"bit_patterns",
                 {"PRM_OK 2", "WD_ON 2", "C1_REQUEST 4", "C2_INITIATE 7", "C2_REQUEST 24", "DPV1_REQUEST 4"}},
        Directed{"answer_rates", {"BAUD_FOUND 3", "FDL status 6"}},
        Directed{"max_tsdr", {"BAUD_FOUND 6", "FDL status 17", "PRM_MIN_TSDR 6"}},
        Directed{"max_tsdr_45k45", {"BAUD_FOUND 4", "FDL status 8", "WD_ON 2"}},
        Directed{"max_tsdr_19k2", {"BAUD_FOUND 2", "FDL status 4", "WD_ON 1"}},
        Directed{"max_tsdr_9k6", {"BAUD_FOUND 2", "FDL status 3", "WD_ON 1"}}, Directed{"interrupt", {"PRM_OK 12"}},
        Directed{"search_window", {"INITIALISED 4", "BAUD_FOUND 2"}},
        Directed{"c2_timer_restart", {"C2_INITIATE 2", "C2_CONNECTED 2", "C2_ANSWER 1"}},
        Directed{"offline_count", {"PRM_OK 257", "CFG_OK 257"}},
        Directed{"initialise_while_sending", {"INITIALISED 2", "BAUD_FOUND 2"}},
        Directed{"host_port", {"INIT_LENGTH 3", "PRM_OK 4", "HOST_NOT_OWNER 11"}}),
    [](const auto& each) { return std::string(each.param.name); });

INSTANTIATE_TEST_SUITE_P(
    All, DirectedRsuStimulus,
    testing::Values(Directed{"news",
                             {"PRM_OK 1", "CFG_OK 1", "C1_REQUEST 2", "C1_ANSWER 2", "C2_REQUEST 2", "C2_ANSWER 2"}},
                    Directed{"flags", {"SPI_CLAIMED 1", "SPI_RELEASED 1", "TELEGRAM_LENGTH 1", "VERDICT_UNEXPECTED 2"}},
                    Directed{"spi_blocks", {"SPI_CLAIMED 4", "PRM_OK 1", "CFG_OK 1", "C1_ANSWER 1", "C2_ANSWER 1"}},
                    Directed{"rates", {"TELEGRAM_CUT 15"}}, Directed{"parallel", {"READY_FLAG 1"}},
                    Directed{"u_timer", {"SPI_CLAIMED 2", "SPI_U_TIMER 2"}}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace dsdpv1
