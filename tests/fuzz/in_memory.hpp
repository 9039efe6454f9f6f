#pragma once
// An input as a file for readers that need a path. One per process; leaves nothing.
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "tests/fuzz/input.hpp"

namespace dsdpv1::fuzz {

inline std::string file_of(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("input", MFD_CLOEXEC);
  const auto length = static_cast<off_t>(size);
  const bool written = ::ftruncate(file, 0) == 0 && ::pwrite(file, data, size, 0) == static_cast<ssize_t>(size);
  promise(written && ::ftruncate(file, length) == 0, "there is memory for a file");
  return "/proc/self/fd/" + std::to_string(file);
}

}  // namespace dsdpv1::fuzz
