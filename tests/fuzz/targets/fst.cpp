// A wave in FST. Its library may crash on a damaged file, in a separate process; the reader may not.
#include <pthread.h>
#include <unistd.h>

#include <csignal>

#include "tests/fuzz/wave_events.hpp"

// From the sanitizers; null without them.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());  // NOLINT

namespace dsdpv1 {
namespace {

/// Disables the exit actions of libFuzzer and the sanitizers in that process.
void be_somebody_else() {
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(nullptr);
  for (const int each : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) std::signal(each, SIG_DFL);
}

const int kAtFork = ::pthread_atfork(nullptr, nullptr, be_somebody_else);

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::promise(kAtFork == 0, "a process can be told what to do at a fork");
  if (size == 0 || (data[0] != 0 && data[0] != 254)) return 0;
  fuzz::read_wave(data, size);
  return 0;
}

}  // namespace dsdpv1
