#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bus/gsd/report.hpp"
#include "files.hpp"

namespace dsdpv1 {
namespace {

using gsd_test::files_of;
using testing::HasSubstr;

struct Ran {
  int code;
  std::string out, err;
};

Ran run(const std::string& path, const std::vector<std::string>& modules, bus::GsdFormat format) {
  std::ostringstream out, err;
  std::ifstream in(path);
  const int code = bus::gsd_command(in, path, {{modules, {}}, format}, out, err);
  return {code, out.str(), err.str()};
}

std::string sample_path(const std::string& name) { return std::string(GSD_SAMPLES) + "/" + name + ".gsd"; }

TEST(GsdReport, TellsWhatAMasterSends) {
  const Ran ran = run(GSD_CHIP, {"8 bytes in, 8 bytes out", "2 words in, filtered"}, bus::GsdFormat::kText);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("Ident_Number           0x0CC9\n"));
  EXPECT_THAT(ran.out, HasSubstr("  45.45                  250\n"));
  EXPECT_THAT(ran.out, HasSubstr("Set_Prm (SAP 61), 12 bytes: 88 0A 0A 0B 0C C9 00 00 00 00 00 0A\n"));
  EXPECT_THAT(ran.out, HasSubstr("module 2 \"2 words in, filtered\": Filter time = 10\n"));
  EXPECT_THAT(ran.out, HasSubstr("Chk_Cfg (SAP 62), 5 bytes: 37 42 41 01 02\n"));
  EXPECT_THAT(ran.out, HasSubstr("Data exchange: 8 bytes output to the slave, 12 bytes input from it\n"));
}

TEST(GsdReport, JsonHoldsTheSame) {
  const Ran ran = run(GSD_CHIP, {"8 bytes in, 8 bytes out", "2 words in, filtered"}, bus::GsdFormat::kJson);
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["ident"], 0x0CC9);
  EXPECT_EQ(report["bauds"].size(), 10U);
  EXPECT_EQ(report["bauds"][9]["max_tsdr_bits"], 800);
  EXPECT_EQ(report["features"]["Freeze_Mode_supp"], true);
  EXPECT_EQ(report["limits"]["Max_Input_Len"], 244);
  EXPECT_EQ(report["selection"]["set_prm"]["bytes"], "88 0A 0A 0B 0C C9 00 00 00 00 00 0A");
  EXPECT_EQ(report["selection"]["input_bytes"], 12);
  EXPECT_EQ(report["warnings"].size(), 0U);
}

TEST(GsdReport, BothFormatsKnowEverySample) {
  for (const auto& path : files_of(GSD_SAMPLES)) {
    EXPECT_EQ(run(path.string(), {}, bus::GsdFormat::kText).code, 0) << path;
    const Ran json = run(path.string(), {}, bus::GsdFormat::kJson);
    EXPECT_TRUE(nlohmann::json::accept(json.out)) << path;
  }
}

TEST(GsdReport, WarningsDoNotMakeItFail) {
  const Ran ran = run(sample_path("manual_habits"), {}, bus::GsdFormat::kText);
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err, "");
  EXPECT_THAT(ran.out, HasSubstr("manual_habits.gsd:20: warning: MaxTcdr_9.6 is read as MaxTsdr_9.6\n"));
}

TEST(GsdReport, SaysHowToChooseWhenNothingIsPreset) {
  const Ran ran = run(sample_path("rev2_modular"), {}, bus::GsdFormat::kText);
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("No module is preset"));
}

TEST(GsdReport, WrongChoiceIsOneLineAndExitTwo) {
  const Ran ran = run(sample_path("rev2_modular"), {"9 DI"}, bus::GsdFormat::kText);
  EXPECT_EQ(ran.code, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err,
            sample_path("rev2_modular") +
                ": module \"9 DI\" is unknown, \"8 DI\", \"8 DO\", \"2 AI\", \"Counter\", \"Counter\" are allowed\n");
}

}  // namespace
}  // namespace dsdpv1
