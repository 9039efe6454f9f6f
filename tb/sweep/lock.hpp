#pragma once
// One process at a time has a folder.
#include <filesystem>
#include <string>

namespace tb::sweep {

/// Held by an open file, so that the system frees it when the process dies, however it does.
class Lock {
 public:
  static constexpr const char* kName = ".sweep.lock";

  /// Makes the folder when there is none. Throws InputError when another process has it, with its id, and when the
  /// system refuses.
  explicit Lock(const std::filesystem::path& folder);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  bool take();

  std::string folder_, path_;
  int file_ = -1;
};

}  // namespace tb::sweep
