#pragma once
// The result of one point of a sweep, from the result file of its run.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dsdpv1::tb::sweep {

/// One check of the run; of several slaves the worst.
struct CheckSeen {
  std::string id;
  std::int64_t count = 0, violations = 0;  ///< violations that the scenario does not allow
  std::optional<double> margin_ns;         ///< the worst; negative: violated
};

struct FirstViolation {
  double at_ns = 0;
  std::string station, code, text;
};

struct Point {
  int exit = 0;       ///< of the run: 0 passed, 1 failed, 2 the scenario cannot be run like this, 3 nothing was
                      ///< judged, above 128 killed
  std::string error;  ///< the run's error line then
  std::int64_t violations = 0, bad_reads = 0;
  std::vector<CheckSeen> checks;
  std::optional<FirstViolation> first;
  std::string unmet;  ///< the first expectation that was not met

  bool possible() const { return exit != 2; }
  /// The run passed, and nothing of its timing was violated.
  bool holds() const;
  /// The check with this id, null when the run has none.
  const CheckSeen* check(const std::string& id) const;
  /// The check with the least margin; null without any.
  const CheckSeen* worst() const;
  /// A short reason why it does not hold; empty when it does.
  std::string reason() const;
};

/// `run` is the result file of the run, null when there is none.
Point point_of(int exit, const std::string& error, const nlohmann::json& run);

}  // namespace dsdpv1::tb::sweep
