#pragma once
// One process at a time has a folder.
#include <filesystem>
#include <string>

namespace dsdpv1::tb::campaign {

/// Held by an open file, so that the system frees it when the process dies, however it does.
class Lock {
 public:
  /// Of a campaign of this kind: ".sweep.lock".
  static std::string name(const std::string& word) { return "." + word + ".lock"; }

  /// Makes the folder when there is none. Throws InputError when another process has it, with its id, and when the
  /// system refuses.
  Lock(const std::filesystem::path& folder, const std::string& word);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  bool take();

  std::string folder_, word_, path_;
  int file_ = -1;
};

}  // namespace dsdpv1::tb::campaign
