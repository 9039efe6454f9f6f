#include "model/systemc/main_stack.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define DSDPV1_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DSDPV1_ASAN 1
#endif
#endif

#ifdef DSDPV1_ASAN

#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include <cstddef>
#include <cstdint>

namespace dsdpv1::systemc {
namespace {

struct Stack {
  void* bottom = nullptr;
  std::size_t bytes = 0;
};

/// As the operating system created it, whichever stack is in use now.
Stack stack_of_this_thread() {
  Stack stack;
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return stack;
  pthread_attr_getstack(&attributes, &stack.bottom, &stack.bytes);
  pthread_attr_destroy(&attributes);
  return stack;
}

bool runs_on(const Stack& stack) {
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  return here - reinterpret_cast<std::uintptr_t>(stack.bottom) < stack.bytes;
}

struct AtExit {
  ~AtExit() { announce_main_stack(); }
};

}  // namespace

void announce_main_stack() {
  const Stack stack = stack_of_this_thread();
  if (!runs_on(stack)) return;
  void* fake_stack = nullptr;
  __sanitizer_start_switch_fiber(&fake_stack, stack.bottom, stack.bytes);
  __sanitizer_finish_switch_fiber(fake_stack, nullptr, nullptr);
}

void announce_main_stack_at_exit() { static const AtExit at_exit; }

}  // namespace dsdpv1::systemc

#else

void dsdpv1::systemc::announce_main_stack() {}
void dsdpv1::systemc::announce_main_stack_at_exit() {}

#endif
