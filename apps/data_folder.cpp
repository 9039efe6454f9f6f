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
  const fs::path installed = folder.parent_path() / DSDPV1_DATADIR;
  if (fs::is_directory(installed / "scenarios")) return installed;
  const fs::path tree = source_tree(folder);
  return fs::is_directory(tree / "scenarios") ? tree : installed;  // a user's program has neither
}

std::string golden_folder() { return fs::path(data_folder()) / "traces"; }

std::vector<std::string> ruling_documents(const std::string& chip) {
  const fs::path docs = fs::path(data_folder()) / "docs";
  if (chip == "dsdpv1") return {docs / "chip.md"};
  return {docs / "chip.md", docs / "chip_rsu.md"};
}

}  // namespace dsdpv1::app
