#include "tb/user_cpu/fiber.hpp"

#include <cstdint>
#include <system_error>
#include <utility>

#if defined(__SANITIZE_ADDRESS__)
#define USER_CPU_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define USER_CPU_ASAN 1
#endif
#endif
#ifdef USER_CPU_ASAN
#include <sanitizer/common_interface_defs.h>
#endif

namespace user_cpu {

namespace {

void start_switch([[maybe_unused]] void** save, [[maybe_unused]] const void* stack,
                  [[maybe_unused]] std::size_t bytes) {
#ifdef USER_CPU_ASAN
  __sanitizer_start_switch_fiber(save, stack, bytes);
#endif
}

void finish_switch([[maybe_unused]] void* fake, [[maybe_unused]] const void** stack,
                   [[maybe_unused]] std::size_t* bytes) {
#ifdef USER_CPU_ASAN
  __sanitizer_finish_switch_fiber(fake, stack, bytes);
#endif
}

}  // namespace

Fiber::Fiber(std::function<void()> body, std::size_t stack_bytes)
    : body_(std::move(body)), stack_bytes_(stack_bytes), stack_(new unsigned char[stack_bytes]) {
  if (getcontext(&inside_) != 0) throw std::system_error(errno, std::generic_category(), "getcontext");
  inside_.uc_stack.ss_sp = stack_.get();
  inside_.uc_stack.ss_size = stack_bytes_;
  inside_.uc_link = nullptr;  // the body leaves through switch_out
  const auto self = reinterpret_cast<std::uintptr_t>(this);
  // makecontext passes ints only.
  makecontext(&inside_, reinterpret_cast<void (*)()>(&Fiber::enter), 2, static_cast<unsigned>(self >> 32),
              static_cast<unsigned>(self & 0xFFFFFFFFU));
}

Fiber::~Fiber() {
  if (begun_ && !ended_) {
    unwinding_ = true;
    switch_in();
  }
}

void Fiber::resume() {
  begun_ = true;
  switch_in();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Fiber::suspend() {
  if (unwinding_) return;  // a destructor on its way out may still call; nobody is going to resume
  switch_out(false);
  if (unwinding_) throw Unwind{};
}

void Fiber::switch_in() {
  start_switch(&fake_outside_, stack_.get(), stack_bytes_);
  swapcontext(&outside_, &inside_);
  finish_switch(fake_outside_, nullptr, nullptr);
}

void Fiber::switch_out(bool last) {
  // A null pointer tells the sanitizer that this stack is left for good.
  start_switch(last ? nullptr : &fake_inside_, outside_stack_, outside_bytes_);
  swapcontext(&inside_, &outside_);
  finish_switch(fake_inside_, &outside_stack_, &outside_bytes_);
}

void Fiber::enter(unsigned high, unsigned low) {
  const auto self = static_cast<std::uintptr_t>(high) << 32 | low;
  reinterpret_cast<Fiber*>(self)->run_body();
}

void Fiber::run_body() {
  finish_switch(nullptr, &outside_stack_, &outside_bytes_);
  try {
    body_();
  } catch (const Unwind&) {
    // the owner is being destroyed
  } catch (...) {
    failure_ = std::current_exception();
  }
  ended_ = true;
  switch_out(true);
}

}  // namespace user_cpu
