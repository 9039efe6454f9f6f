#include "apps/options/snapshots.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <iostream>

#include "apps/interrupt.hpp"

namespace dsdpv1::app {
namespace {

constexpr int kLookMs = 20;  // real time between two looks at a copy that is at work

/// A copy that is not needed ends here, without any destructor: what it holds belongs to its parent.
Window wait_for_order(int order) {
  Window window;
  ssize_t count = 0;
  do {
    count = ::read(order, &window, sizeof window);
  } while (count < 0 && errno == EINTR);
  if (count != sizeof window) ::_exit(0);
  ::close(order);
  return window;
}

int status_of(pid_t process) {
  int status = 0;
  bool told = false;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (interrupted() && !told) told = ::kill(process, SIGTERM) == 0;
    ::poll(nullptr, 0, kLookMs);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::optional<Window> Snapshots::take(bus::Tick now) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    possible_ = false;
    return std::nullopt;
  }
  tb::Descriptor order(ends[0]), to(ends[1]);
  std::cout << std::flush;
  const pid_t parent = ::getpid(), process = ::fork();
  if (process != 0) {
    possible_ = process > 0;
    if (possible_) all_.push_back({process, std::move(to), now});
    return std::nullopt;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // it has ended meanwhile
  all_.clear();
  to.reset();
  return wait_for_order(order.release());
}

void Snapshots::end(const Copy& copy) {
  ::kill(copy.process, SIGKILL);
  while (::waitpid(copy.process, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Snapshots::forget_before(bus::Tick at) {
  while (all_.size() > 1 && all_[1].at <= at) {
    end(all_.front());
    all_.erase(all_.begin());
  }
}

int Snapshots::wake(bus::Tick at, const Window& window) {
  const auto after = std::find_if(all_.begin() + 1, all_.end(), [at](const Copy& copy) { return copy.at > at; });
  Copy copy = std::move(*(after - 1));
  all_.erase(after - 1);
  const bool ordered = ::write(copy.order.get(), &window, sizeof window) == sizeof window;
  copy.order.reset();
  return ordered ? status_of(copy.process) : -1;
}

void Snapshots::clear() {
  for (const Copy& copy : all_) end(copy);
  all_.clear();
}

}  // namespace dsdpv1::app
