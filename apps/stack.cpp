#include "apps/stack.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdio>

namespace dsdpv1::app {
namespace {

constexpr rlim_t kNeeded = 512 * 1024;

/// Exceptions and stdio take 8 KB and more.
void tell(rlim_t given) {
  std::array<char, 128> line{};
  const int size = std::snprintf(
      line.data(), line.size(), "dsdpv1-sim: the stack is limited to %llu KB, allowed are %llu KB and more\n",
      static_cast<unsigned long long>(given / 1024), static_cast<unsigned long long>(kNeeded / 1024));
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), static_cast<std::size_t>(size));
}

/// Theirs was taken from the limit when the program began.
void give_threads_as_much() {
  pthread_attr_t attributes;
  if (pthread_getattr_default_np(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, kNeeded);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

}  // namespace

bool ensure_stack() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kNeeded) return true;
  const rlim_t given = limit.rlim_cur;
  limit.rlim_cur = kNeeded;
  // Of the first thread the limit counts when the stack grows, not when the program begins.
  if (limit.rlim_max >= kNeeded && setrlimit(RLIMIT_STACK, &limit) == 0) {
    give_threads_as_much();
    return true;
  }
  tell(given);
  return false;
}

}  // namespace dsdpv1::app
