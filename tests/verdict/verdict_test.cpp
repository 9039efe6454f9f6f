// The verdict of a run: the word and the number, and the text about parts not judged.
#include "tb/bench/verdict.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace dsdpv1 {
namespace {

using tb::ChecksMode;
using tb::ExpectationResult;
using tb::RunResult;

const checks::Rule kRule = {"TIMING_TS", checks::Bound::kMin, 150, 0, "", "", "", "", ""};

constexpr const char* kNothing = "NOTHING JUDGED: no data exchange, and nothing was expected";

struct Case {
  const char* name;
  std::function<void(RunResult& result)> make;
  int exit_code;
  const char* word;
  const char* words;
};

void exchange(RunResult& result) {
  result.slaves.emplace_back();
  result.slaves.back().status.data_exchanges = 1;
}

void violated_check(RunResult& result, ChecksMode mode, std::uint64_t count, std::uint64_t allowed) {
  exchange(result);
  result.checks_mode = mode;
  result.checks.emplace_back();
  result.checks.back().rule = &kRule;
  result.checks.back().record.violations = count;
  result.checks.back().allowed = allowed;
  if (mode == ChecksMode::kFail) result.violations = count - allowed;
}

ExpectationResult expectation(bool passed, bool left_out = false) { return {"", 1, passed, "", left_out}; }

const Case kCases[] = {
    {"Nothing", [](RunResult&) {}, 3, "nothing_judged", kNothing},
    {"DataExchange", exchange, 0, "passed", "PASSED"},
    {"ExpectationMet", [](RunResult& r) { r.expectations = {expectation(true)}; }, 0, "passed", "PASSED"},
    {"ExpectationNotMet",
     [](RunResult& r) {
       r.expectations = {expectation(true), expectation(false)};
     },
     1, "failed", "FAILED: 1 expectation not met"},
    {"OnlyLeftOut", [](RunResult& r) { r.expectations = {expectation(false, true)}; }, 3, "nothing_judged", kNothing},
    {"Violation",
     [](RunResult& r) {
       exchange(r);
       r.violations = 2;
     },
     1, "failed", "FAILED: 2 violations"},
    {"AllowedViolation",
     [](RunResult& r) {
       exchange(r);
       r.allowed = 2;
     },
     0, "passed", "PASSED, 2 violations allowed"},
    {"CheckViolated", [](RunResult& r) { violated_check(r, ChecksMode::kFail, 140, 0); }, 1, "failed",
     "FAILED: 140 violations"},
    {"CheckAllowed", [](RunResult& r) { violated_check(r, ChecksMode::kFail, 140, 140); }, 0, "passed",
     "PASSED, 140 violations allowed"},
    {"CheckReported", [](RunResult& r) { violated_check(r, ChecksMode::kReport, 141, 1); }, 0, "passed",
     "PASSED, 140 violations not judged, 1 violation allowed"},
    {"ChecksOff",
     [](RunResult& r) {
       exchange(r);
       r.checks_mode = ChecksMode::kOff;
     },
     0, "passed", "PASSED, checks off"},
    {"NothingExpected",
     [](RunResult& r) {
       exchange(r);
       r.expects_exchange = false;
     },
     0, "passed", "PASSED, data exchange not expected"},
    {"OneCheckOff",
     [](RunResult& r) {
       exchange(r);
       r.checks_off = 1;
     },
     0, "passed", "PASSED, 1 check off"},
    {"ModelAndRtlDiffer",
     [](RunResult& r) {
       exchange(r);
       r.lockstep.emplace();
       r.lockstep->difference = tb::LockstepDifference{};
     },
     1, "failed", "FAILED: model and RTL differ"},
    {"ModelAndRtlAreTheSame", [](RunResult& r) { r.lockstep.emplace(); }, 3, "nothing_judged", kNothing},
    {"ServeWithoutATelegram", [](RunResult& r) { r.pacing.emplace(); }, 3, "nothing_judged", kNothing},
    {"ServeWithATelegram",
     [](RunResult& r) {
       r.pacing.emplace();
       r.pacing->line.telegrams = 1;
     },
     0, "passed", "PASSED"},
    {"ServeWithAHostThatWasTooEarly",
     [](RunResult& r) {
       r.pacing.emplace();
       r.pacing->line.telegrams = 3;
       r.pacing->line.held_back = 2;
       r.unjudged = 1;
     },
     0, "passed", "PASSED, 1 violation not judged, 2 telegrams of the host held back"},
    {"Interrupted",
     [](RunResult& r) {
       exchange(r);
       r.violations = 1;
       r.interrupted = true;
     },
     130, "interrupted", "INTERRUPTED"},
};

class Verdicts : public testing::TestWithParam<Case> {};

TEST_P(Verdicts, WordAndNumber) {
  RunResult result;
  GetParam().make(result);
  const tb::Verdict verdict = tb::verdict(result);
  EXPECT_EQ(tb::exit_code(verdict), GetParam().exit_code);
  EXPECT_STREQ(tb::name(verdict), GetParam().word);
  EXPECT_EQ(tb::words(result), GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(All, Verdicts, testing::ValuesIn(kCases), [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace dsdpv1
