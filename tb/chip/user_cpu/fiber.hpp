#pragma once
// A program on a separate stack, so that code written as one thread of control (the driver, its application) can be
// suspended inside a call and resumed later. The switch is Boost.Context's jump_fcontext: it exchanges registers and
// stack pointer without a system call, while POSIX swapcontext makes two for the signal mask. The layer is named
// `detail` because it does not unwind; this class does that, and announces the stacks to AddressSanitizer, for which
// Debian's Boost is not built.
#include <boost/context/detail/fcontext.hpp>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>

namespace dsdpv1::user_cpu {

/// Neither copied nor moved; used from one thread.
class Fiber {
 public:
  explicit Fiber(std::function<void()> body, std::size_t stack_bytes = 256 * 1024);
  /// Unwinds a body that has begun and not ended: its pending `suspend` throws, its objects are destroyed.
  ~Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;

  /// Runs the body until it suspends or ends. Rethrows an exception of the body. Not from inside the body, and not
  /// after its end.
  void resume();
  /// From inside the body: returns to the caller of `resume` until it is called again.
  void suspend();
  bool ended() const { return ended_; }
  /// Destroyed before its end: `suspend` returns at once.
  bool unwinding() const { return unwinding_; }

 private:
  struct Unwind {};
  static void enter(boost::context::detail::transfer_t from);
  void run_body();
  void switch_in();
  void switch_out(bool last);

  std::function<void()> body_;
  std::size_t stack_bytes_;
  std::unique_ptr<unsigned char[]> stack_;
  boost::context::detail::fcontext_t inside_, outside_ = nullptr;  ///< resume points of the two stacks
  std::exception_ptr failure_;
  bool begun_ = false, ended_ = false, unwinding_ = false;
  // AddressSanitizer's bookkeeping of the two stacks; unused without it.
  void* fake_inside_ = nullptr;
  void* fake_outside_ = nullptr;
  const void* outside_stack_ = nullptr;
  std::size_t outside_bytes_ = 0;
};

}  // namespace dsdpv1::user_cpu
