#pragma once
#include <fcntl.h>
#include <unistd.h>

#include "io/input/descriptor.hpp"

namespace dsdpv1::tb {

/// What is written to `descriptor` from now on is lost. False, with errno, when that cannot be had.
inline bool send_nowhere(int descriptor) {
  const Descriptor nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  return nowhere && ::dup2(nowhere.get(), descriptor) >= 0;
}

}  // namespace dsdpv1::tb
