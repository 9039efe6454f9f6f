#include "apps/program.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "apps/command_line.hpp"
#include "apps/exit_codes.hpp"
#include "apps/printable_output.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "io/output/standard_output.hpp"

namespace dsdpv1::app {
namespace {

constexpr rlim_t kNeeded = 512 * 1024;

/// Exceptions and stdio take 8 KB and more.
void tell(const char* name, rlim_t given) {
  std::array<char, 160> line{};
  const int size = std::snprintf(
      line.data(), line.size(), "%.32s: the stack is limited to %llu KB, expected %llu KB or more\n", name,
      static_cast<unsigned long long>(given / 1024), static_cast<unsigned long long>(kNeeded / 1024));
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), static_cast<std::size_t>(size));
}

/// Theirs was taken from the limit when the program began.
void give_threads_as_much() {
  pthread_attr_t attributes;
  if (pthread_getattr_default_np(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, kNeeded);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

/// The program needs 512 KB of stack: where less is allowed it allows itself more. False when it may not, with a line
/// on the error channel. The first thing of all: the reader of line tables (libdw) puts up to 160 KB of them on the
/// stack at once.
bool ensure_stack(const char* name) {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kNeeded) return true;
  const rlim_t given = limit.rlim_cur;
  limit.rlim_cur = kNeeded;
  // For the first thread the limit applies when the stack grows, not when the program begins.
  if (limit.rlim_max >= kNeeded && setrlimit(RLIMIT_STACK, &limit) == 0) {
    give_threads_as_much();
    return true;
  }
  tell(name, given);
  return false;
}

int carry_out(int argc, char** argv, const char* name) {
  PrintableOutput output(name);
  try {
    return command_line(argc, argv, output);
  } catch (const tb::InputError& error) {
    std::cerr << bus::printable(error.what()) << std::endl;
    return kWrongInput;
  } catch (const std::exception& error) {
    std::cerr << name << ": internal error: " << bus::printable(error.what()) << std::endl;
    return kFailed;
  }
}

/// As if the program had been stopped when its reader went away; only that its files are complete.
void end_as_by_sigpipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

/// Lost output is a separate error.
int judge_output(const char* name, int status, int error) {
  if (error == 0) return status;
  if (status == kInterrupted) return status;
  if (error == EPIPE) end_as_by_sigpipe();
  std::fprintf(stderr, "%s: standard output cannot be written: %s\n", name, std::strerror(error));
  return kWrongInput;
}

}  // namespace

int program(int argc, char** argv, const char* name, const std::function<tb::ChipKinds()>& make) {
  try {
    return program(argc, argv, name, make());
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return kWrongInput;
  }
}

int program(int argc, char** argv, const char* name, const tb::ChipKinds& kinds) {
  if (!ensure_stack(name)) return kWrongInput;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large shows at the write
  tb::fill_closed_channels();
  for (const tb::ChipKind* kind : kinds) tb::add_chip_kind(*kind);
  tb::StandardOutput output;
  const int status = carry_out(argc, argv, name);
  return judge_output(name, status, output.finish());
}

}  // namespace dsdpv1::app
