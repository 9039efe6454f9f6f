#pragma once
// A program on a stack of its own, so that code written as one thread of control (the driver, its application) can be
// suspended inside of a call and go on later. The switch itself is Boost.Context's jump_fcontext: it exchanges
// registers and stack pointer without a system call, where POSIX swapcontext makes two for the signal mask. The layer
// is named `detail` because it does not unwind; that is done here, and so are the announcements of the stacks to
// AddressSanitizer, which Debian's Boost is built without.
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
  /// A body that has begun and not ended is unwound: its pending `suspend` throws, its objects are destroyed.
  ~Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;

  /// Runs the body until it suspends or ends. An exception that leaves the body is thrown here. Not from inside the
  /// body, and not after its end.
  void resume();
  /// From inside the body: returns to the caller of `resume` until it is called again.
  void suspend();
  bool ended() const { return ended_; }

 private:
  struct Unwind {};
  static void enter(boost::context::detail::transfer_t from);
  void run_body();
  void switch_in();
  void switch_out(bool last);

  std::function<void()> body_;
  std::size_t stack_bytes_;
  std::unique_ptr<unsigned char[]> stack_;
  boost::context::detail::fcontext_t inside_, outside_ = nullptr;  ///< where the two stacks go on
  std::exception_ptr failure_;
  bool begun_ = false, ended_ = false, unwinding_ = false;
  // AddressSanitizer's bookkeeping of the two stacks; unused without it.
  void* fake_inside_ = nullptr;
  void* fake_outside_ = nullptr;
  const void* outside_stack_ = nullptr;
  std::size_t outside_bytes_ = 0;
};

}  // namespace dsdpv1::user_cpu
