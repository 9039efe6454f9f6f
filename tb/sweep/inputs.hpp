#pragma once
// The files that a sweep reads. Its runs read them at different times, so each run is held against one content.
#include <sys/stat.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tb/sweep/plan.hpp"

namespace tb::sweep {

class Inputs {
 public:
  /// When each file was last written, or replaced by another; changes even when the content comes back to what it was.
  using Times = std::vector<std::vector<std::int64_t>>;

  /// Reads the scenario, the files that it names and those that settings and parameters name. Throws InputError for a
  /// scenario that cannot be read.
  explicit Inputs(const Plan& plan);

  /// Path and fingerprint of each; null where there is nothing to read.
  const nlohmann::ordered_json& content() const { return content_; }
  /// Looks at the files of a point again. Throws InputError when one has other content than in the beginning.
  Times look(std::size_t point) const;

 private:
  std::vector<std::string> files_of(std::size_t point) const;

  const Plan& plan_;
  std::vector<std::string> common_;  ///< of every point
  nlohmann::ordered_json content_;
};

}  // namespace tb::sweep
