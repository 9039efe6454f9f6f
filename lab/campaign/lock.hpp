#pragma once
// One process at a time has a folder.
#include <filesystem>
#include <string>

namespace dsdpv1::tb::campaign {

/// Held by an open file, so the system frees it when the process ends in any way.
class Lock {
 public:
  /// The name for a kind of campaign: ".sweep.lock".
  static std::string name(const std::string& word) { return "." + word + ".lock"; }

  /// Creates a missing folder. Throws InputError when another process has it, with its id, and when the system refuses
  /// it.
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
