#include "apps/data_folder.hpp"

#include <filesystem>

namespace dsdpv1::app {

namespace fs = std::filesystem;

namespace {

// A build's own program, or a test, looks into the source tree; where that is from the build does not change when both
// are moved.
fs::path source_tree(fs::path folder) {
  while (folder.has_relative_path() && !fs::exists(folder / "CMakeCache.txt")) folder = folder.parent_path();
  return (folder / DSDPV1_SOURCE_FROM_BUILD).lexically_normal();
}

}  // namespace

std::string data_folder() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  // dsdpv1-sim is in bin/, dsdpv1-board in libexec/dsdpv1/.
  for (const fs::path& prefix : {folder.parent_path(), folder.parent_path().parent_path()})
    if (fs::path data = prefix / DSDPV1_DATADIR; fs::is_directory(data / "scenarios")) return data;
  return source_tree(folder);
}

}  // namespace dsdpv1::app
