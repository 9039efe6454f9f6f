#pragma once
// The result of one run of a regression.
#include <string>
#include <vector>

#include "lab/campaign/children.hpp"
#include "lab/campaign/folder.hpp"

namespace dsdpv1::tb::regress {

enum class Verdict : std::uint8_t {
  kPassed,         ///< exit code 0
  kFailed,         ///< a check or expectation failed, or RTL and model differ
  kNothingJudged,  ///< exit code 3
  kRefused,        ///< exit code 2: the scenario, a file of it or the settings are wrong
  kCrashed,        ///< ended by a signal
  kHung,           ///< killed at its time limit
  kNotRun          ///< only listed, with the reason
};

/// "passed", "failed", "nothing_judged", "refused", "crashed", "hung", "not_run".
const char* name(Verdict verdict);

struct Outcome {
  Verdict verdict = Verdict::kPassed;
  int exit = 0;
  double seconds = 0;
  std::string reason;              ///< the first failing check or expectation in words; empty when it passed
  std::string output;              ///< the end of the output of a run that did not pass
  std::string log;                 ///< and the last lines of its log
  std::vector<std::string> files;  ///< the kept files

  bool passed() const { return verdict == Verdict::kPassed; }
  bool was_run() const { return verdict != Verdict::kNotRun; }
  /// It was not ended by something else, and its input was right.
  bool ran_through() const { return passed() || verdict == Verdict::kFailed || verdict == Verdict::kNothingJudged; }
};

/// Of a run that is only listed.
Outcome not_run(const std::string& reason);

/// `result` is the result file of the run, null when there is none.
Outcome outcome_of(const campaign::Ended& ended, const campaign::Json& result);

/// Events and situations of the run's model, from its result: {"codes": {CODE: count}, "situations": {GROUP: {NAME:
/// count}}}, without those that did not occur. Null when there is no result.
campaign::Json seen_of(const campaign::Json& result);

campaign::Json json_of(const Outcome& outcome);
/// Throws nlohmann::json::exception for any other JSON.
Outcome outcome_of(const campaign::Json& json);

}  // namespace dsdpv1::tb::regress
