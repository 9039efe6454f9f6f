#include "io/output/output_place.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <climits>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <initializer_list>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb {
namespace {

constexpr int kMostLinks = 40;  // the kernel's limit

/// N of /dev/fd/N and /proc/self/fd/N. Opening such a name again would start at the beginning of a file that others
/// append to.
std::optional<int> named_descriptor(const std::string& path) {
  for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (path.compare(0, folder.size(), folder) != 0) continue;
    const std::string digits = path.substr(folder.size());
    const bool number = !digits.empty() && digits.size() < 8 && std::all_of(digits.begin(), digits.end(), [](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) != 0;
    });
    if (number) return std::stoi(digits);
  }
  return std::nullopt;
}

std::string target_of_link(const std::string& path) {
  std::array<char, PATH_MAX> text{};
  const ssize_t length = ::readlink(path.c_str(), text.data(), text.size());
  if (length < 0) refuse_output(path, errno);
  const std::string target(text.data(), static_cast<std::size_t>(length));
  return !target.empty() && target.front() == '/' ? target : folder_of(path) + "/" + target;
}

std::string identity_of(const struct stat& status) {
  return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

void look_at_target(OutputPlace& place) {
  struct stat status {};
  if (::stat(place.target.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse_output(place.wanted, errno);
    return;  // a new file
  }
  if (S_ISDIR(status.st_mode)) refuse_output(place.wanted, EISDIR);
  // Renaming over a file needs no permission to write it, so the permission is checked here.
  if (::faccessat(AT_FDCWD, place.target.c_str(), W_OK, AT_EACCESS) != 0) refuse_output(place.wanted, errno);
  place.direct = !S_ISREG(status.st_mode);
  place.replaced = status;
}

}  // namespace

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

void refuse_output(const std::string& path, int error) {
  throw InputError(path, 0, std::string("cannot be written: ") + std::strerror(error));
}

OutputPlace find_place(const std::string& path) {
  OutputPlace place{path, path};
  for (int links = 0; links <= kMostLinks; ++links) {
    if (const std::optional<int> descriptor = named_descriptor(place.target)) {
      place.descriptor = *descriptor;
      place.direct = true;
      return place;
    }
    struct stat status {};
    if (::lstat(place.target.c_str(), &status) != 0 && errno != ENOENT) refuse_output(path, errno);
    if (!S_ISLNK(status.st_mode)) {
      look_at_target(place);
      return place;
    }
    place.target = target_of_link(place.target);
  }
  refuse_output(path, ELOOP);
}

std::optional<std::string> file_identity(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return identity_of(status);
}

std::optional<std::string> input_identity(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return identity_of(status);
}

std::optional<std::string> output_identity(const std::string& path) {
  OutputPlace place;
  try {
    place = find_place(path);
  } catch (const InputError&) {
    place.target = path;  // refused when it is opened
  }
  if (place.descriptor >= 0) return std::nullopt;  // several options may name standard output
  struct stat status {};
  if (::stat(place.target.c_str(), &status) == 0)
    return S_ISREG(status.st_mode) ? std::optional(identity_of(status)) : std::nullopt;
  if (::stat(folder_of(place.target).c_str(), &status) != 0) return std::nullopt;
  return identity_of(status) + "/" + name_of(place.target);
}

}  // namespace dsdpv1::tb
