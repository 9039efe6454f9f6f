#include "tb/chip/user_cpu/fiber.hpp"

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

namespace dsdpv1::user_cpu {

namespace {

using boost::context::detail::jump_fcontext;
using boost::context::detail::make_fcontext;
using boost::context::detail::transfer_t;

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
    : body_(std::move(body)),
      stack_bytes_(stack_bytes),
      stack_(new unsigned char[stack_bytes]),
      inside_(make_fcontext(stack_.get() + stack_bytes_, stack_bytes_, &Fiber::enter)) {}

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
  if (unwinding_) return;  // a destructor may still call during unwinding; there will be no resume
  switch_out(false);
  if (unwinding_) throw Unwind{};
}

void Fiber::switch_in() {
  start_switch(&fake_outside_, stack_.get(), stack_bytes_);
  inside_ = jump_fcontext(inside_, this).fctx;
  finish_switch(fake_outside_, nullptr, nullptr);
}

void Fiber::switch_out(bool last) {
  // A null pointer tells the sanitizer that this stack will not be used again.
  start_switch(last ? nullptr : &fake_inside_, outside_stack_, outside_bytes_);
  outside_ = jump_fcontext(outside_, nullptr).fctx;
  finish_switch(fake_inside_, &outside_stack_, &outside_bytes_);
}

void Fiber::enter(transfer_t from) {
  auto* const self = static_cast<Fiber*>(from.data);
  self->outside_ = from.fctx;
  self->run_body();
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

}  // namespace dsdpv1::user_cpu
