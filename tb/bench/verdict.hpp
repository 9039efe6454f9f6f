#pragma once
// What a run comes to: one word and one number, the same at every entrance (commands, C API, Python, cocotb).
#include <cstdint>
#include <string>

#include "tb/bench/record.hpp"

namespace dsdpv1::tb {

enum class Verdict : std::uint8_t {
  kPassed,
  kFailed,         ///< an expectation was not met, something was violated that is not allowed, or RTL differed
  kNothingJudged,  ///< nobody exchanged data, and nothing was expected; in serve: no host sent a telegram
  kInterrupted,
};

Verdict verdict(const RunResult& result);
/// Of `verdict`: 0, 1, 3, 130.
int exit_code(Verdict verdict);
/// Stable, in result files: "passed", "failed", "nothing_judged", "interrupted".
const char* name(Verdict verdict);
/// For people: "PASSED, 140 violations not judged", "FAILED: 1 expectation not met". Whatever was found and not judged
/// is said.
std::string words(const RunResult& result);
/// What `words` says beside the verdict: ", 140 violations not judged"; empty when all was judged.
std::string not_judged(const RunResult& result);

/// Violations that checks found, that the scenario does not allow and that ChecksMode::kReport leaves unjudged.
std::uint64_t violations_not_judged(const RunResult& result);

}  // namespace dsdpv1::tb
