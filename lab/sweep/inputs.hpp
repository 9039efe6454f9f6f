#pragma once
// The files that each point of a sweep reads.
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lab/campaign/contents.hpp"
#include "lab/sweep/plan.hpp"

namespace dsdpv1::tb::sweep {

class Inputs {
 public:
  using Times = campaign::Contents::Times;

  /// Reads the scenario, the files that it names and those that settings and parameters name. Throws InputError for a
  /// scenario that cannot be read.
  explicit Inputs(const Plan& plan);

  /// Path and fingerprint of each; null for a missing file.
  const nlohmann::ordered_json& content() const { return contents_.all(); }
  /// Checks the files of a point again. Throws InputError when the content of one has changed since the beginning.
  Times look(std::size_t point) const { return contents_.look(files_of(point)); }

 private:
  std::vector<std::string> files_of(std::size_t point) const;

  const Plan& plan_;
  std::vector<std::string> common_;  ///< of every point
  campaign::Contents contents_;
};

}  // namespace dsdpv1::tb::sweep
