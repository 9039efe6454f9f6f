#include "apps/data_folder.hpp"

#include <filesystem>

namespace dsdpv1::app {

namespace fs = std::filesystem;

std::string data_folder() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  // dsdpv1-sim is in bin/, dsdpv1-board in libexec/dsdpv1/.
  for (const fs::path& prefix : {folder.parent_path(), folder.parent_path().parent_path()})
    if (fs::path data = prefix / DSDPV1_DATADIR; fs::is_directory(data / "scenarios")) return data;
  return DSDPV1_SOURCE_DIR;
}

}  // namespace dsdpv1::app
