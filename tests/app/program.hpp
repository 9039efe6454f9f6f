#pragma once
// Calls the built dsdpv1-sim, or the one that DSDPV1_SIM of the environment names, as ./run faults does.
#include <filesystem>
#include <string>
#include <vector>

namespace dsdpv1::app_test {

struct Called {
  int status = 0;  ///< exit code, 128 + signal when it was killed
  std::string out, err;
};

/// The program that call() runs.
std::string simulator();

/// Runs the program with `arguments` (shell words) in `folder`; `program`: another one than the built dsdpv1-sim.
Called call(const std::string& arguments, const std::filesystem::path& folder, const std::string& program = "");

std::string read(const std::filesystem::path& path);

/// The names of scenarios/*.yaml, in order.
std::vector<std::string> shipped_scenarios();

/// A folder for one test, removed at its end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace dsdpv1::app_test
