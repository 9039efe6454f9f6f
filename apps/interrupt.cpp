#include "apps/interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <ctime>
#include <initializer_list>

#include "apps/exit_codes.hpp"
#include "io/output/part_file.hpp"

namespace dsdpv1::app {
namespace {

volatile std::sig_atomic_t ended = 0;
volatile std::sig_atomic_t ended_at = 0;  ///< seconds of the monotonic clock

void on_signal(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (ended == 0) {
    ended_at = static_cast<std::sig_atomic_t>(now.tv_sec);
    ended = 1;
  } else if (now.tv_sec > ended_at + 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

void leave_nothing(int /*signal*/) {
  tb::remove_parts();
  _exit(kInterrupted);
}

bool ignored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

/// A write that waits (on a full FIFO) continues after the signal: an error would cost the run all of its files.
void handle_with(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  if (!ignored(SIGHUP)) sigaction(SIGHUP, &action, nullptr);  // nohup
}

}  // namespace

void leave_nothing_on_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  handle_with(leave_nothing);
}

void catch_signals() { handle_with(on_signal); }

bool interrupted() { return ended != 0; }

}  // namespace dsdpv1::app
