#include "tests/app/program.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace dsdpv1::app_test {

namespace fs = std::filesystem;

std::string simulator() {
  const char* other = std::getenv("DSDPV1_SIM");
  return other != nullptr ? other : DSDPV1_SIM;
}

Called call(const std::string& arguments, const fs::path& folder, const std::string& program) {
  const Folder outputs;
  const std::string command = "cd '" + folder.string() + "' && '" + (program.empty() ? simulator() : program) + "' " +
                              arguments + " >'" + outputs.file("out") + "' 2>'" + outputs.file("err") + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(outputs.file("out")),
          read(outputs.file("err"))};
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> shipped_scenarios() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(DSDPV1_SOURCE_DIR "/scenarios"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Folder::Folder() {
  static int count = 0;
  path_ = fs::temp_directory_path() / ("dsdpv1_app_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
  fs::create_directories(path_);
}

Folder::~Folder() { fs::remove_all(path_); }

}  // namespace dsdpv1::app_test
