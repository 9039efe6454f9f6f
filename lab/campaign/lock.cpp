#include "lab/campaign/lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::campaign {
namespace {

namespace fs = std::filesystem;

/// "with process id 123 ", or empty while its owner has not written it yet.
std::string owner_of(int file) {
  std::array<char, 16> text{};
  const ssize_t count = pread(file, text.data(), text.size(), 0);
  const std::string id(text.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  const bool number = !id.empty() && std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isdigit(c); });
  return number ? "with process id " + id + " " : "";
}

/// The previous owner may have removed the file after it was opened here; then the lock would have no effect.
bool is_at(const std::string& path, int file) {
  struct stat there {};
  struct stat opened {};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &there) == 0 && there.st_dev == opened.st_dev &&
         there.st_ino == opened.st_ino;
}

}  // namespace

Lock::Lock(const fs::path& folder, const std::string& word)
    : folder_(folder.string()), word_(word), path_((folder / name(word)).string()) {
  fs::create_directories(folder);
  while (!take()) {
  }
  const std::string id = std::to_string(getpid());
  // Without it (a full disk) the lock still holds, but its owner is unknown.
  if (ftruncate(file_, 0) == 0 && pwrite(file_, id.data(), id.size(), 0) < 0) return;
}

/// False when the file was removed meanwhile.
bool Lock::take() {
  // O_CLOEXEC: a child process that outlives this process must not hold the folder.
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) {
    if (is_at(path_, file_)) return true;
    close(file_);
    return false;
  }
  const int error = errno;
  const std::string owner = file_ >= 0 ? owner_of(file_) : "";
  if (file_ >= 0) close(file_);
  if (error == EWOULDBLOCK)
    throw InputError(folder_, 0, "a " + word_ + " " + owner + "is using it, expected one " + word_ + " at a time");
  throw InputError(folder_, 0, "cannot be used for a " + word_ + ": " + std::strerror(error));
}

Lock::~Lock() {
  unlink(path_.c_str());
  close(file_);
}

}  // namespace dsdpv1::tb::campaign
