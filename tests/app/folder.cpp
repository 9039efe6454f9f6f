#include "tests/app/folder.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>

namespace dsdpv1::app_test {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Folder::Folder() {
  static int count = 0;
  path_ = fs::temp_directory_path() / ("dsdpv1_app_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
  fs::remove_all(path_);  // of a killed process that had this id
  fs::create_directories(path_);
}

Folder::~Folder() { fs::remove_all(path_); }

}  // namespace dsdpv1::app_test
