#pragma once
#include <fcntl.h>
#include <unistd.h>

#include "io/input/descriptor.hpp"

namespace dsdpv1::tb {

/// Discards all later output to `descriptor`. Returns false, with errno, when that fails.
inline bool send_nowhere(int descriptor) {
  const Descriptor nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  return nowhere && ::dup2(nowhere.get(), descriptor) >= 0;
}

}  // namespace dsdpv1::tb
