#include <gtest/gtest.h>

#include <csignal>
#include <memory>
#include <stdexcept>
#include <string>

#include "tb/chip/user_cpu/fiber.hpp"

namespace dsdpv1 {
namespace {

using user_cpu::Fiber;

/// A fiber's body needs the fiber to suspend.
struct Coroutine {
  template <typename Body>
  explicit Coroutine(const Body& body) : fiber([this, body] { body(fiber); }) {}
  Fiber fiber;
};

TEST(Fiber, AlternatesWithItsOwner) {
  std::string trace;
  Coroutine co([&](Fiber& fiber) {
    trace += 'a';
    fiber.suspend();
    trace += 'b';
    fiber.suspend();
    trace += 'c';
  });
  co.fiber.resume();
  trace += '1';
  co.fiber.resume();
  trace += '2';
  EXPECT_FALSE(co.fiber.ended());
  co.fiber.resume();
  EXPECT_TRUE(co.fiber.ended());
  EXPECT_EQ(trace, "a1b2c");
}

TEST(Fiber, SuspendsInTheDepthOfCalls) {
  int depth = 0;
  Coroutine co([&](Fiber& fiber) {
    std::function<void(int)> descend = [&](int levels) {
      volatile char stack[512] = {};
      stack[0] = 1;
      if (levels == 0)
        fiber.suspend();
      else
        descend(levels - 1);
      depth += stack[0];
    };
    descend(50);
  });
  co.fiber.resume();
  EXPECT_EQ(depth, 0);
  co.fiber.resume();
  EXPECT_EQ(depth, 51);
}

TEST(Fiber, TwoFibersKeepTheirOwnLocals) {
  auto count = [](int& total) {
    return [&total](Fiber& fiber) {
      for (int i = 1; i <= 3; ++i) {
        total += i;
        fiber.suspend();
      }
    };
  };
  int first = 0;
  int second = 0;
  Coroutine one(count(first));
  Coroutine two(count(second));
  one.fiber.resume();
  two.fiber.resume();
  one.fiber.resume();
  EXPECT_EQ(first, 3);
  EXPECT_EQ(second, 1);
}

TEST(Fiber, ExceptionOfTheBodyReachesTheOwner) {
  Coroutine co([](Fiber& fiber) {
    fiber.suspend();
    throw std::runtime_error("broken");
  });
  co.fiber.resume();
  EXPECT_THROW(co.fiber.resume(), std::runtime_error);
  EXPECT_TRUE(co.fiber.ended());
}

/// So it makes no system call.
TEST(Fiber, ASwitchLeavesTheSignalMaskAlone) {
  sigset_t mask;
  sigemptyset(&mask);
  sigaddset(&mask, SIGUSR1);
  Coroutine co([&](Fiber& fiber) {
    sigprocmask(SIG_BLOCK, &mask, nullptr);
    fiber.suspend();
    sigset_t inside;
    sigprocmask(SIG_BLOCK, nullptr, &inside);
    EXPECT_EQ(sigismember(&inside, SIGUSR1), 0);
  });
  co.fiber.resume();
  sigset_t outside;
  sigprocmask(SIG_BLOCK, nullptr, &outside);
  EXPECT_EQ(sigismember(&outside, SIGUSR1), 1);
  sigprocmask(SIG_UNBLOCK, &mask, nullptr);
  co.fiber.resume();
}

TEST(Fiber, AbandonedBodyIsUnwound) {
  auto held = std::make_shared<int>(1);
  struct SuspendsOnTheWayOut {
    Fiber& fiber;
    ~SuspendsOnTheWayOut() { fiber.suspend(); }
  };
  {
    Coroutine co([held](Fiber& fiber) {
      const auto copy = held;  // NOLINT(performance-unnecessary-copy-initialization): unwinding has to destroy it
      const SuspendsOnTheWayOut guard{fiber};
      fiber.suspend();
      FAIL() << "nobody resumes";
    });
    co.fiber.resume();
    EXPECT_GT(held.use_count(), 2);
  }
  EXPECT_EQ(held.use_count(), 1);
}

TEST(Fiber, BodyThatNeverBeganIsDropped) {
  bool ran = false;
  {
    Coroutine co([&](Fiber&) { ran = true; });
  }
  EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace dsdpv1
