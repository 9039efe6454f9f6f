#pragma once
// The files that a campaign reads. Its runs read them at different times, so each run is held against one content.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lab/campaign/folder.hpp"

namespace dsdpv1::tb::campaign {

class Contents {
 public:
  /// When each file was last written, or replaced by another; changes even when the content comes back to what it was.
  using Times = std::vector<std::vector<std::int64_t>>;

  explicit Contents(Kind kind) : kind_(std::move(kind)) {}
  /// Reads a file. Throws InputError for one that can be read only once, and when the machine refuses to read it now.
  void add(const std::string& file);
  /// A scenario must be there: throws InputError when it cannot be read.
  void add_scenario(const std::string& file);

  /// Path and fingerprint of each; null where there is nothing to read.
  const Json& all() const { return content_; }
  /// Looks at files again. Throws InputError when one has other content than in the beginning.
  Times look(const std::vector<std::string>& files) const;

 private:
  [[noreturn]] void fail_changed(const std::string& file) const;

  Kind kind_;
  Json content_;
};

}  // namespace dsdpv1::tb::campaign
