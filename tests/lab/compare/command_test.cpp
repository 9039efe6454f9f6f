// compare as a whole: this program's waves, and all of its output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/app/program.hpp"
#include "tests/lab/compare/waves.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using testing::HasSubstr;

/// A run up to the first telegrams, as VCD and once more in another execution and format.
class OwnWaves : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    waves_ = new compare_test::Waves;
    waves_->write("short.yaml",
                  "name: short\nbaud: 12M\nend: 1300us\nslaves:\n  - {name: io, address: 5, gsd: " DSDPV1_SOURCE_DIR
                  "/scenarios/dsdpv1.gsd, modules: [\"8 bytes in, 8 bytes out\"], user_cpu: {behaviour: loop_back, "
                  "cycle: 40us}, release_reset: 20us}\nmasters:\n  - {name: plc, address: 2, start: 150us, slaves: "
                  "[{slave: io}]}\nexpect: [{slave: io, dp_state: wait_prm}]\n");
    for (const char* run : {"a.vcd", "b.fst --engine step"})
      ASSERT_EQ(call(std::string("run short.yaml -q --wave ") + run, waves_->folder()).status, 0) << run;
  }
  static void TearDownTestSuite() {
    delete waves_;
    waves_ = nullptr;
  }
  static Called compare(const std::string& arguments) { return call("compare " + arguments, waves_->folder()); }
  /// a.vcd with one pin at the other level from its first change after this time on, up to its next.
  static std::uint64_t plant(const std::string& pin, std::uint64_t after, const std::string& name) {
    std::istringstream in(app_test::read(waves_->path("a.vcd")));
    std::string text, code;
    std::uint64_t now = 0, planted = 0;
    for (std::string line; std::getline(in, line); text += line + "\n") {
      const bool declared = line.rfind("$var", 0) == 0 && line.find(" " + pin + " $end") != std::string::npos;
      if (declared) code = line.substr(12, line.find(' ', 12) - 12);
      if (line[0] == '#') now = std::stoull(line.substr(1));
      if (planted != 0 || now <= after || code.empty() || line.substr(1) != code) continue;
      line[0] = line[0] == '0' ? '1' : '0';
      planted = now;
    }
    waves_->write(name, text);
    return planted;
  }
  static compare_test::Waves* waves_;
};
compare_test::Waves* OwnWaves::waves_ = nullptr;

TEST_F(OwnWaves, TwoExecutionsInTwoFormatsAreEqual) {
  const Called called = compare("a.vcd b.fst --to 1300us");
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, HasSubstr("io.PBRXD"));
  EXPECT_THAT(called.out, HasSubstr("\nEQUAL\n"));
}

TEST_F(OwnWaves, APlantedDifferenceIsNamedWithTimeCycleValuesAndWhatHappenedThen) {
  const std::uint64_t at = plant("L_REQ", 1'200'000'000, "planted.vcd");
  ASSERT_GT(at, 1'200'000'000U);
  const Called called = compare("b.fst planted.vcd --json r.json --junit r.xml");
  EXPECT_EQ(called.status, 1);
  const auto result = nlohmann::json::parse(app_test::read(waves_->path("r.json")));
  EXPECT_EQ(result["equal"], false);
  EXPECT_EQ(result["first"]["signal"], "io.L_REQ");
  EXPECT_EQ(result["first"]["ps"], at);
  EXPECT_EQ(result["first"]["time"], std::to_string(at) + " ps");
  EXPECT_EQ(result["first"]["cycle"], (at * 6 + 62'500) / 125'000);
  EXPECT_NE(result["first"]["a"], result["first"]["b"]);
  EXPECT_THAT(std::string(result["first"]["then"]["last access"]), HasSubstr(" B0"));
  EXPECT_THAT(std::string(result["first"]["then"]["last telegram"]), HasSubstr("began at cycle"));
  EXPECT_THAT(called.out, HasSubstr(std::to_string(at) + " ps\n                  io.L_REQ: A "));
  const std::string xml = app_test::read(waves_->path("r.xml"));
  EXPECT_THAT(xml, HasSubstr("failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("io.L_REQ"));
}

TEST_F(OwnWaves, TheWaveOfBothSidesShowsWhereTheyDiffer) {
  const std::uint64_t at = plant("L_REQ", 1'200'000'000, "planted.vcd");
  for (const char* name : {"both.vcd", "both.fst"})
    EXPECT_EQ(compare(std::string("a.vcd planted.vcd -q --wave ") + name).status, 1);
  EXPECT_EQ(compare("both.vcd both.fst").status, 0) << "in either format";
  EXPECT_EQ(
      compare("both.vcd a.vcd --scope-a a --signal io.D=io.D --signal io.A=io.A --signal bus.telegram=telegram").status,
      0);
  const Called called = compare("both.fst both.fst --signal a.io.L_REQ=b.io.L_REQ --json r.json -q");
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_EQ(nlohmann::json::parse(app_test::read(waves_->path("r.json")))["first"]["ps"], at);
  EXPECT_EQ(compare("both.fst both.fst --signal a.io.L_REQ=b.io.L_REQ --mask differs.any=1 -q").status, 0)
      << "the marker covers all of it";
}

TEST_F(OwnWaves, AFifoIsAWave) {
  const std::string pipe = waves_->path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&pipe] { std::ofstream(pipe, std::ios::binary) << app_test::read(waves_->path("a.vcd")); });
  EXPECT_EQ(compare("b.fst pipe -q").status, 0);
  writer.join();
  std::thread again([&pipe] { std::ofstream(pipe, std::ios::binary) << app_test::read(waves_->path("a.vcd")); });
  const Called called = compare("pipe b.fst --clock io.PBRXD");
  again.join();
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("pipe: has the clock and is no regular file"));
}

}  // namespace
}  // namespace dsdpv1
