#include "tb/bench/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dsdpv1::tb {
namespace {

bool is_missed(const ExpectationResult& each) { return !each.passed && !each.left_out; }

bool failed(const RunResult& result) {
  return result.violations != 0 || std::any_of(result.expectations.begin(), result.expectations.end(), is_missed) ||
         (result.lockstep && result.lockstep->difference);
}

bool judged(const RunResult& result) {
  if (result.pacing && result.pacing->line.telegrams != 0) return true;
  const auto is_judged = [](const ExpectationResult& each) { return !each.left_out || each.implied; };
  const auto exchanges = [](const SlaveResult& each) { return each.status.data_exchanges != 0; };
  return std::any_of(result.expectations.begin(), result.expectations.end(), is_judged) ||
         std::any_of(result.slaves.begin(), result.slaves.end(), exchanges);
}

std::uint64_t allowed(const RunResult& result) {
  std::uint64_t count = result.allowed;
  for (const CheckResult& each : result.checks) count += each.allowed;
  return count;
}

std::string counted(std::uint64_t count, const char* one, const char* what) {
  const std::string after = *what == '\0' ? "" : std::string(" ") + what;
  return count == 0 ? "" : fmt::format(", {} {}{}{}", count, one, count == 1 ? "" : "s", after);
}

std::string faults(const RunResult& result) {
  const auto unmet =
      static_cast<std::uint64_t>(std::count_if(result.expectations.begin(), result.expectations.end(), is_missed));
  const std::string text = counted(unmet, "expectation", "not met") + counted(result.violations, "violation", "") +
                           (result.lockstep && result.lockstep->difference ? ", model and RTL differ" : "");
  return text.substr(2);
}

}  // namespace

Verdict verdict(const RunResult& result) {
  if (result.interrupted) return Verdict::kInterrupted;
  if (failed(result)) return Verdict::kFailed;
  return judged(result) ? Verdict::kPassed : Verdict::kNothingJudged;
}

int exit_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPassed: return 0;
    case Verdict::kFailed: return 1;
    case Verdict::kNothingJudged: return 3;
    case Verdict::kInterrupted: break;
  }
  return 130;
}

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPassed: return "passed";
    case Verdict::kFailed: return "failed";
    case Verdict::kNothingJudged: return "nothing_judged";
    case Verdict::kInterrupted: break;
  }
  return "interrupted";
}

std::uint64_t violations_not_judged(const RunResult& result) {
  std::uint64_t count = result.unjudged;
  if (result.checks_mode != ChecksMode::kReport) return count;
  for (const CheckResult& each : result.checks) count += each.record.violations - each.allowed;
  return count;
}

std::string not_judged(const RunResult& result) {
  const auto left_out = std::count_if(result.expectations.begin(), result.expectations.end(),
                                      [](const ExpectationResult& each) { return each.left_out; });
  return counted(violations_not_judged(result), "violation", "not judged") +
         counted(static_cast<std::uint64_t>(left_out), "expectation", "not judged") +
         counted(allowed(result), "violation", "allowed") +
         counted(result.pacing ? result.pacing->line.held_back : 0, "telegram", "of the host held back") +
         (result.expects_exchange ? "" : ", data exchange not expected") +
         (result.checks_mode == ChecksMode::kOff ? ", checks off" : counted(result.checks_off, "check", "off"));
}

std::string words(const RunResult& result) {
  const Verdict it = verdict(result);
  if (it == Verdict::kFailed) return "FAILED: " + faults(result);
  if (it == Verdict::kNothingJudged) return "NOTHING JUDGED: no data exchange, and nothing was expected";
  return (it == Verdict::kPassed ? "PASSED" : "INTERRUPTED") + not_judged(result);
}

}  // namespace dsdpv1::tb
