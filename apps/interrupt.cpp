#include "apps/interrupt.hpp"

#include <csignal>
#include <ctime>
#include <initializer_list>

namespace app {
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

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

bool interrupted() { return ended != 0; }

}  // namespace app
