// A user's RTL: the example of docs/tutorials/own_rtl.md, and the errors if it cannot be built.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/waves/wave_reader.hpp"
#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using testing::HasSubstr;

constexpr const char* kSource = DSDPV1_SOURCE_DIR;

/// examples/own_rtl in the folder of the test.
void copy_example(const app_test::Folder& folder) {
  std::filesystem::copy(kSource + std::string("/examples/own_rtl"), folder.file("own_rtl"));
}

std::string example(const app_test::Folder& folder, const std::string& pins) {
  return "cosim --rtl examples/own_rtl --top board_chip --pins " + pins + " --build '" + folder.file("build") +
         "' --difference '" + folder.file("both.vcd") + "' scenarios/two_slaves.yaml";
}

/// examples/own_rtl/pins.yaml with other lines at its end, in the folder of the test.
std::string pins_with(const app_test::Folder& folder, const std::string& lines) {
  std::ofstream(folder.file("pins.yaml"))
      << app_test::read(kSource + std::string("/examples/own_rtl/pins.yaml")) << lines;
  return "'" + folder.file("pins.yaml") + "'";
}

TEST(RtlRandom, ProgressIsOneLineWrittenOverItself) {
  const app_test::Folder folder;
  const app_test::Called called =
      call("reasons prm_ident >/dev/null && script -qec \"'" DSDPV1_SIM "' rtl-random --cycles 20000\" /dev/null",
           folder.path());
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, testing::ContainsRegex("\r[0-9]+ cases, "));
  EXPECT_THAT(called.out, testing::Not(HasSubstr("\\r")));
}

/// Unchanged, in a folder outside this project.
TEST(Cosim, CopiedExampleBuildsUnchangedAndHasAnUnknownPin) {
  const app_test::Folder folder;
  copy_example(folder);
  const app_test::Called called = call("cosim --rtl own_rtl --top board_chip --pins own_rtl/pins.yaml '" +
                                           std::string(kSource) + "/scenarios/two_slaves.yaml'",
                                       folder.path());
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_THAT(called.out, HasSubstr("pin INTR0: model 1, RTL X"));
  EXPECT_THAT(called.out, HasSubstr("first difference  cycle 0 "));
}

TEST(Cosim, ExampleWithAResetValueHasTooShortAPulse) {
  const app_test::Folder folder;
  const app_test::Called called = call(example(folder, pins_with(folder, "parameters: {RESET_VALUE: 1}\n")), kSource);
  EXPECT_EQ(called.status, 1) << called.err;
  EXPECT_THAT(called.out, HasSubstr("pin INTR0: model no such change within the tolerance, RTL 1"));
  EXPECT_THAT(app_test::read(folder.file("both.vcd")), HasSubstr("module rtl"));
}

TEST(Cosim, MendedExampleIsTheSameWithinItsTolerance) {
  const app_test::Folder folder;
  const app_test::Called called =
      call(example(folder, pins_with(folder, "parameters: {RESET_VALUE: 1, PULSE: 64}\n")), kSource);
  EXPECT_EQ(called.status, 0) << called.out << called.err;
  EXPECT_THAT(called.out, HasSubstr("of model and RTL are the same"));
}

TEST(Cosim, RtlThatVerilatorRefusesIsNamedWithItsLine) {
  const app_test::Folder folder;
  std::ofstream(folder.file("chip.sv")) << "module chip (input logic clk_i);\n  assign = clk_i;\nendmodule\n";
  const app_test::Called called =
      call("cosim --rtl . --top chip '" + std::string(kSource) + "/scenarios/two_slaves.yaml'", folder.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.out, "");
  EXPECT_THAT(called.err, HasSubstr("chip.sv:2:"));
  EXPECT_THAT(called.err, HasSubstr("syntax error"));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1);
}

TEST(Cosim, PortThatTheTopDoesNotHaveIsNamed) {
  const app_test::Folder folder;
  std::ofstream(folder.file("chip.sv")) << "module chip (input logic clk_i);\nendmodule\n";
  const app_test::Called called =
      call("cosim --rtl . --top chip '" + std::string(kSource) + "/scenarios/two_slaves.yaml'", folder.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_THAT(called.err, HasSubstr("chip has no port"));
  EXPECT_THAT(called.err, HasSubstr("--pins"));
}

TEST(Cosim, FolderWithoutRtlIsNamed) {
  const app_test::Folder folder;
  const app_test::Called called =
      call("cosim --rtl . --top chip '" + std::string(kSource) + "/scenarios/two_slaves.yaml'", folder.path());
  EXPECT_EQ(called.status, 2);
  EXPECT_EQ(called.err, ".: holds no RTL, expected .sv and .v files\n");
}

/// A wave's changes by the names of the signals.
struct Wave {
  using Changes = std::vector<std::pair<std::uint64_t, std::string>>;
  std::map<std::string, Changes> signals;

  explicit Wave(const std::string& path) {
    const auto reader = tb::read_wave(path);
    const tb::WaveDeclarations& declared = reader->declarations();
    std::vector<Changes> changes(declared.signals.size());
    for (tb::WaveEvent event; reader->next(event);) changes[event.signal].emplace_back(event.time, event.value);
    for (const tb::WaveVariable& each : declared.variables)
      signals[declared.scopes[each.scope] + "." + each.name] = changes[each.signal];
  }
  bool has(const std::string& name) const { return signals.count(name) != 0; }
};

std::string line_with(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? "none" : text.substr(at, text.find('\n', at) - at);
}

/// The CRC that the chip writes is of no use to its user: nothing else than a reading user sees it at pins.
TEST(NoDpram, SwappedCrcIsFoundWhereItIsReadBack) {
  const app_test::Folder folder;
  const std::string fault =
      " --fault 166 --replay '" + std::string(kSource) + "/tests/cosim/stimuli/dsdpv1/set_prm.stimulus'";
  const app_test::Called images = call("rtl-random" + fault, folder.path());
  EXPECT_THAT(images.out, HasSubstr("DPRAM B4FE: model "));
  const app_test::Called pins = call("rtl-random --no-dpram" + fault, folder.path());
  EXPECT_EQ(pins.status, 1) << pins.out;
  EXPECT_THAT(pins.out, HasSubstr("pin D_OUT: model "));
  EXPECT_THAT(pins.out, HasSubstr("last access       read B4FE"));
}

/// In the libraries of the reference RTL the parameters of a top are inputs, here they are parameters, which the map
/// names.
TEST(OwnRtl, OfTheDsdpv1WithOtherParametersIsTheSame) {
  const app_test::Folder folder;
  std::ofstream(folder.file("pins.yaml"))
      << "reference: true\nchip: {rts_lead: RTS_LEAD, rts_trail: RTS_TRAIL, search_window_ms: SEARCH_WINDOW_MS}\n";
  const app_test::Called called = call(
      "rtl-random --set chip.rts_lead=0 --set chip.rts_trail=32 --set chip.search_window_ms=3 --rtl "
      "rtl_ref/dsdpv1 --top dsdpv1 --pins '" +
          folder.file("pins.yaml") + "' --build '" + folder.file("build") + "' --cycles 5000000 --stimulus '" +
          folder.file("case") + "' --difference '" + folder.file("both.vcd") + "'",
      kSource);
  EXPECT_EQ(called.status, 0) << called.out << called.err;
}

/// One build for everything: the pulse of INTR0 is 60 cycles long, P7 requires 64.
TEST(OwnRtl, DefectIsFoundAtRandomShownFromInsideAndPlayedAgainExactly) {
  const app_test::Folder folder;
  copy_example(folder);
  std::ofstream(folder.file("own_rtl/pins.yaml"), std::ios::app) << "parameters: {RESET_VALUE: 1}\n";
  const std::string rtl =
      " --rtl own_rtl --top board_chip --pins own_rtl/pins.yaml --set chip.search_window_ms=1 --wave inside.fst ";

  const app_test::Called found =
      call("rtl-random" + rtl + "--seed 3 --stimulus short.stimulus --log case.log --result found.json", folder.path());
  EXPECT_EQ(found.status, 1) << found.err;
  EXPECT_THAT(found.out, HasSubstr("dsdpv1-sim rtl-random --rtl own_rtl --top board_chip --pins own_rtl/pins.yaml "
                                   "--set chip.search_window_ms=1 --seed 3 --replay short.stimulus\n"));
  const auto json = nlohmann::json::parse(app_test::read(folder.file("found.json")));
  EXPECT_EQ(json["verdict"], "different");
  EXPECT_EQ(json["difference"]["what"], "pin INTR0: model no such change within the tolerance, RTL 1");
  const std::uint64_t cycle = json["difference"]["cycle"], picoseconds = (cycle * 125'000 + 3) / 6;
  EXPECT_THAT(app_test::read(folder.file("case.log")), HasSubstr("lockstep     difference pin INTR0"));

  const Wave wave(folder.file("inside.fst"));
  for (const char* name : {"bus.telegram", "chip.INTR0", "chip.inside.owner", "chip.rtl.board_chip.count_q",
                           "chip.rtl.board_chip.u_chip.clk_i"})
    EXPECT_TRUE(wave.has(name)) << name;
  const Wave::Changes& marker = wave.signals.at("lockstep.difference");
  EXPECT_EQ(marker.back().first, picoseconds);
  const Wave::Changes& interrupt = wave.signals.at("chip.rtl.irq");
  EXPECT_THAT(interrupt, testing::Contains(std::make_pair(picoseconds, std::string("0"))));

  const app_test::Called again =
      call("rtl-random" + rtl + "--replay short.stimulus --result again.json", folder.path());
  EXPECT_EQ(again.status, 1) << again.err;
  EXPECT_EQ(line_with(again.out, "first difference"), line_with(found.out, "first difference"));
  EXPECT_EQ(nlohmann::json::parse(app_test::read(folder.file("again.json")))["difference"], json["difference"]);

  const app_test::Called third = call("cosim" + rtl + "--replay short.stimulus --result third.json", folder.path());
  EXPECT_EQ(third.status, 1) << third.err;
  EXPECT_EQ(app_test::read(folder.file("third.json")), app_test::read(folder.file("again.json")));

  const app_test::Called run = call(
      "cosim" + rtl + "--log run.log --result run.json '" + kSource + "/scenarios/two_slaves.yaml'", folder.path());
  EXPECT_EQ(run.status, 1) << run.err;
  const auto result = nlohmann::json::parse(app_test::read(folder.file("run.json")));
  EXPECT_FALSE(result["passed"]);
  EXPECT_EQ(result["lockstep"]["difference"]["slave"], "large");
  EXPECT_LT(result["simulated_ns"], result["lockstep"]["difference"]["at_ns"].get<double>() + 1e4);
  EXPECT_THAT(app_test::read(folder.file("run.log")), testing::Not(HasSubstr("FAILED")));
  const Wave both(folder.file("inside.fst"));
  for (const char* name : {"bus.line", "io.dp_state", "io.inside.item", "io.rtl.irq", "large.rtl.board_chip.count_q",
                           "lockstep.difference"})
    EXPECT_TRUE(both.has(name)) << name;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("build/cosim")))
    EXPECT_EQ(entry.path().filename(), "traced") << "a part of a wave is left";
}

}  // namespace
}  // namespace dsdpv1
