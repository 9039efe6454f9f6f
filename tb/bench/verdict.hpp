#pragma once
// The verdict of a run: one word and one number, the same in all interfaces (commands, C API, Python, cocotb).
#include <cstdint>
#include <string>

#include "tb/bench/record.hpp"

namespace dsdpv1::tb {

enum class Verdict : std::uint8_t {
  kPassed,
  kFailed,         ///< an expectation was not met, a violation is not allowed, or RTL differed
  kNothingJudged,  ///< no data exchange and no expectation; in serve: no host sent a telegram
  kInterrupted,
};

Verdict verdict(const RunResult& result);
/// For `verdict`: 0, 1, 3, 130.
int exit_code(Verdict verdict);
/// Stable, in result files: "passed", "failed", "nothing_judged", "interrupted".
const char* name(Verdict verdict);
/// As text: "PASSED, 140 violations not judged", "FAILED: 1 expectation not met". Includes findings that were not
/// judged.
std::string words(const RunResult& result);
/// The part of `words` after the verdict: ", 140 violations not judged"; empty if everything was judged.
std::string not_judged(const RunResult& result);

/// Violations found by checks, not allowed by the scenario and left unjudged by ChecksMode::kReport.
std::uint64_t violations_not_judged(const RunResult& result);

}  // namespace dsdpv1::tb
