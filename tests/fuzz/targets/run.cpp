// Runs a scenario for its first 2 ms, in step and in skip: both must give the same telegrams, events and verdicts.
#include "tb/bench/bench.hpp"

#include "io/input/input_error.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/summary.hpp"
#include "tb/scenario/scenario.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

constexpr bus::Tick kLongest = 2 * bus::kTicksPerMs;

/// So that no file of this machine has a part in it.
bool names_other_files(const tb::scenario::Scenario& scenario) {
  for (const std::string& file : scenario.files)
    if (file != DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd") return true;
  return false;
}

/// The result, without the parts that differ between runs.
std::string run(const tb::scenario::Scenario& scenario, tb::Engine engine) {
  tb::RunOptions options;
  options.engine = engine;
  options.checks = tb::ChecksMode::kReport;
  tb::Bench bench(scenario, options, tb::make_pin_execution());
  tb::RunResult result = bench.run([](tb::Tick) { return true; });
  fuzz::promise(!tb::summary(result).empty(), "a run has a summary");
  result.wall_s = 0;
  return tb::result_json(result);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    tb::scenario::Scenario scenario = tb::scenario::parse(text, DSDPV1_SOURCE_DIR "/scenarios/a.yaml");
    if (names_other_files(scenario)) return 0;
    scenario.end = std::min(scenario.end, kLongest);
    fuzz::promise(run(scenario, tb::Engine::kStep) == run(scenario, tb::Engine::kSkip), "step and skip do the same");
  } catch (const tb::InputError& error) {
    fuzz::promise(*error.what() != '\0', "an error has words");
  }
  return 0;
}

}  // namespace dsdpv1
