// Every code is explained, and docs/reasons.md equals the program's output.
#include <gtest/gtest.h>

#include <algorithm>

#include "tb/scenario/event_codes.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::read;

TEST(Reasons, DocumentIsWhatTheProgramPrints) {
  const app_test::Called printed = call("reasons --markdown", DSDPV1_SOURCE_DIR);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_TRUE(printed.out == read(DSDPV1_SOURCE_DIR "/docs/reasons.md")) << "docs/reasons.md is stale: ./run generate";
}

TEST(Reasons, EveryCodeOfScenariosAndLogsHasATextAnAdviceAndARulingOrClause) {
  const std::string document = read(DSDPV1_SOURCE_DIR "/docs/reasons.md");
  const std::string checks = read(DSDPV1_SOURCE_DIR "/docs/checks.md");
  for (const tb::ChipKind* kind : tb::chip_kinds())
    for (const std::string& code : tb::scenario::all_codes(*kind)) {
      if (checks.find("\n### " + code + "\n") != std::string::npos) continue;  // on a separate page
      const std::size_t row = document.find("</a>`" + code + "` |");
      ASSERT_NE(row, std::string::npos) << code;
      const std::string line = document.substr(row, document.find('\n', row) - row);
      EXPECT_EQ(line.find("|  |"), std::string::npos) << "an empty cell: " << line;
      EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 5) << line;
    }
}

TEST(Reasons, OneCodeIsPrintedAlone) {
  const app_test::Called printed = call("reasons PRM_IDENT", DSDPV1_SOURCE_DIR);
  EXPECT_EQ(printed.status, 0) << printed.err;
  EXPECT_EQ(std::count(printed.out.begin(), printed.out.end(), '\n'), 6);
  EXPECT_NE(printed.out.find("    see S6 (docs/chip.md#s6), T19-4 (docs/conformance.md#t19-4)\n"), std::string::npos)
      << printed.out;
  EXPECT_EQ(printed.out.rfind(
                "PRM_IDENT (refusal)\n    such as: Prm_Fault: ident 0CC9, this slave is 1234\n    Use the GSD", 0),
            0U)
      << printed.out;
}

TEST(Reasons, OneCodeHasTheAdviceOfEachKindOfChip) {
  EXPECT_NE(
      call("reasons PRM_IDENT", DSDPV1_SOURCE_DIR)
          .out.find("\n    apc3, spc3, vpc3: Use the GSD file of this device, or initialise with the ident number of "
                    "the GSD file (3AH, 3BH).\n"),
      std::string::npos);
}

TEST(Reasons, NothingIsLeftToBeFilledIn) {
  EXPECT_EQ(call("reasons", DSDPV1_SOURCE_DIR).out.find('{'), std::string::npos);
}

TEST(Reasons, TheCaseOfACodeDoesNotMatter) {
  const app_test::Called upper = call("reasons PRM_IDENT", DSDPV1_SOURCE_DIR);
  for (const char* code : {"prm_ident", "Prm_Ident"}) {
    const app_test::Called printed = call(std::string("reasons ") + code, DSDPV1_SOURCE_DIR);
    EXPECT_EQ(printed.status, 0) << printed.err;
    EXPECT_EQ(printed.out, upper.out) << code;
  }
  EXPECT_EQ(call("reasons prm_idnt", DSDPV1_SOURCE_DIR).err,
            "dsdpv1-sim reasons: unknown code prm_idnt (did you mean PRM_IDENT?), expected those that `dsdpv1-sim "
            "reasons` prints\n");
}

TEST(Reasons, AnUnknownCodeIsRefusedInOneLine) {
  const app_test::Called printed = call("reasons PRM_IDNT", DSDPV1_SOURCE_DIR);
  EXPECT_EQ(printed.status, 2);
  EXPECT_EQ(printed.err,
            "dsdpv1-sim reasons: unknown code PRM_IDNT (did you mean PRM_IDENT?), expected those that `dsdpv1-sim "
            "reasons` prints\n");
}

}  // namespace
}  // namespace dsdpv1
