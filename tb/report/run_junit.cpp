#include "tb/report/run_junit.hpp"

#include <fmt/format.h>

#include "bus/time_text.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/summary.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb {
namespace {

JunitCase case_of_run(const RunResult& result) {
  JunitCase made{result.file, fmt::format("run, engine {}, view {}", result.engine, result.view), result.wall_s,
                 std::nullopt, whole_summary(result)};
  if (result.interrupted) made.failure = "interrupted at " + bus::moment_text(result.simulated);
  if (verdict(result) == Verdict::kNothingJudged)
    made.failure = "nothing judged: no data exchange, and nothing was expected";
  return made;
}

std::string violations_text(const RunResult& result) {
  std::string text;
  for (const Repeated& each : result.violated)
    if (!each.allowed && each.judged)
      text += fmt::format("{} times {} {}{}{}, first at {}: {}\n", each.count, each.station, each.code,
                          each.place.empty() ? "" : " at ", each.place, bus::moment_text(each.first),
                          with_place(each.text, each.where));
  return text;
}

JunitCase case_of_violations(const RunResult& result) {
  JunitCase made{result.file, "no violation that the scenario does not allow", 0, std::nullopt, ""};
  if (const std::string text = violations_text(result); !text.empty()) made.failure = text;
  return made;
}

/// A check on one slave.
JunitCase case_of(const RunResult& result, const CheckResult& check) {
  JunitCase made{result.file, fmt::format("{}: {}", check.slave, check.rule->id), 0, std::nullopt, ""};
  const std::uint64_t count = check.record.violations - check.allowed;
  if (count == 0) return made;
  const std::string text =
      fmt::format("violated {} times, first at {}: {}\n{}\n", count, bus::moment_text(check.listed.front().at),
                  with_place(check.listed.front().text, check.listed.front().where), check.rule->rule);
  (result.checks_mode == ChecksMode::kFail ? made.failure.emplace() : made.output) = text;
  return made;
}

JunitCase case_of(const RunResult& result, const ExpectationResult& expectation) {
  JunitCase made{result.file, fmt::format("line {}: {}", expectation.line, expectation.text), 0, std::nullopt, ""};
  if (expectation.left_out)
    made.output = "left out: the firmware does not tell\n";
  else if (!expectation.passed)
    made.failure = "not met: " + expectation.text + "; seen: " + expectation.seen;
  return made;
}

JunitCase case_of(const RunResult& result, const LockstepResult& lockstep) {
  JunitCase made{result.file, "model and RTL are the same", 0, std::nullopt, ""};
  if (const auto& difference = lockstep.difference)
    made.failure = fmt::format("{} at {}: {}", difference->slave, bus::moment_text(difference->at), difference->what);
  return made;
}

}  // namespace

std::vector<JunitCase> run_cases(const RunResult& result) {
  std::vector<JunitCase> cases = {case_of_run(result), case_of_violations(result)};
  for (const CheckResult& each : result.checks) cases.push_back(case_of(result, each));
  for (const ExpectationResult& each : result.expectations) cases.push_back(case_of(result, each));
  if (result.lockstep) cases.push_back(case_of(result, *result.lockstep));
  return cases;
}

}  // namespace dsdpv1::tb
