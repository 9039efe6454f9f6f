#pragma once
// The files that a campaign reads. Its runs read them at different times, so every run is checked for the same content.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lab/campaign/folder.hpp"

namespace dsdpv1::tb::campaign {

class Contents {
 public:
  /// When each file was last written, or replaced by another; changes even when the old content is restored.
  using Times = std::vector<std::vector<std::int64_t>>;

  explicit Contents(Kind kind) : kind_(std::move(kind)) {}
  /// Reads a file. Throws InputError for one that can be read only once, and when it cannot be read now.
  void add(const std::string& file);
  /// A scenario must be there: throws InputError when it cannot be read.
  void add_scenario(const std::string& file);

  /// Path and fingerprint of each; null for a missing file.
  const Json& all() const { return content_; }
  /// Checks files again. Throws InputError when the content of one has changed since the beginning.
  Times look(const std::vector<std::string>& files) const;

 private:
  [[noreturn]] void fail_changed(const std::string& file) const;

  Kind kind_;
  Json content_;
};

}  // namespace dsdpv1::tb::campaign
