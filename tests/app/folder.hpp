#pragma once
// Folders of tests, and the contents of their files.
#include <filesystem>
#include <string>

namespace dsdpv1::app_test {

std::string read(const std::filesystem::path& path);

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
