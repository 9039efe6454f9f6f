#include "tests/app/program.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

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

std::vector<std::string> shipped_scenarios() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(DSDPV1_SOURCE_DIR "/scenarios"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace dsdpv1::app_test
