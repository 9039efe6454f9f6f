#include "lab/campaign/contents.hpp"

#include <sys/stat.h>

#include <optional>

#include "io/input/input_error.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::campaign {
namespace {

Json fingerprint_json(const std::string& file) {
  const std::optional<std::string> found = fingerprint_of_file(file);
  return found ? Json(*found) : Json();
}

/// Empty for a missing file.
std::vector<std::int64_t> times_of(const std::string& file) {
  struct stat seen {};
  if (stat(file.c_str(), &seen) != 0) return {};
  return {static_cast<std::int64_t>(seen.st_dev),
          static_cast<std::int64_t>(seen.st_ino),
          seen.st_size,
          seen.st_mtim.tv_sec,
          seen.st_mtim.tv_nsec,
          seen.st_ctim.tv_sec,  // cannot be reset by the user
          seen.st_ctim.tv_nsec};
}

}  // namespace

void Contents::add(const std::string& file) {
  if (!content_.contains(file)) content_[file] = fingerprint_json(file);
}

void Contents::add_scenario(const std::string& file) {
  if (content_.contains(file)) return;
  content_[file] = fingerprint(scenario::read_file(file));
  if (content_[file] != fingerprint_json(file)) fail_changed(file);
}

/// The times are taken first: a later write shows at the next check.
Contents::Times Contents::look(const std::vector<std::string>& files) const {
  Times times;
  for (const std::string& file : files) {
    times.push_back(times_of(file));
    if (fingerprint_json(file) != content_.at(file)) fail_changed(file);
  }
  return times;
}

void Contents::fail_changed(const std::string& file) const {
  throw InputError(
      file, 0, "was changed while the " + kind_.word + " ran, expected the same content for all of its " + kind_.items);
}

}  // namespace dsdpv1::tb::campaign
