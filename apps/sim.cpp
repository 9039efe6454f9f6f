// dsdpv1-sim: the main function, from the command line to the exit code.

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>

#include "apps/command_line.hpp"
#include "apps/exit_codes.hpp"
#include "apps/printable_output.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "io/output/standard_output.hpp"
#include "kinds/dsdpv1/board/arm_user.hpp"
#include "kinds/spc3/board/arm_user.hpp"

namespace dsdpv1 {
namespace {

constexpr rlim_t kNeeded = 512 * 1024;

/// Exceptions and stdio take 8 KB and more.
void tell(rlim_t given) {
  std::array<char, 128> line{};
  const int size =
      std::snprintf(line.data(), line.size(), "dsdpv1-sim: the stack is limited to %llu KB, expected %llu KB or more\n",
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
bool ensure_stack() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kNeeded) return true;
  const rlim_t given = limit.rlim_cur;
  limit.rlim_cur = kNeeded;
  // For the first thread the limit applies when the stack grows, not when the program begins.
  if (limit.rlim_max >= kNeeded && setrlimit(RLIMIT_STACK, &limit) == 0) {
    give_threads_as_much();
    return true;
  }
  tell(given);
  return false;
}

int carry_out(int argc, char** argv) {
  app::PrintableOutput output;
  try {
    return app::command_line(argc, argv, output);
  } catch (const tb::InputError& error) {
    std::fprintf(stderr, "%s\n", bus::printable(error.what()).c_str());
    return app::kWrongInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dsdpv1-sim: internal error: %s\n", bus::printable(error.what()).c_str());
    return app::kFailed;
  }
}

/// As if the program had been stopped when its reader went away; only that its files are complete.
void end_as_by_sigpipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

/// Lost output is a separate error.
int judge_output(int status, int error) {
  if (error == 0) return status;
  if (status == app::kInterrupted) return status;
  if (error == EPIPE) end_as_by_sigpipe();
  std::fprintf(stderr, "dsdpv1-sim: standard output cannot be written: %s\n", std::strerror(error));
  return app::kWrongInput;
}

/// Formerly a separate program, for the ARM board (docs/install.md, Versions).
void tell_former_name(const char* name) {
  if (std::filesystem::path(name).filename() != "dsdpv1-board") return;
  std::fprintf(stderr, "dsdpv1-board is deprecated and goes with 0.5: use dsdpv1-sim, which it is\n");
}

int program(int argc, char** argv) {
  if (!ensure_stack()) return app::kWrongInput;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large shows at the write
  tb::fill_closed_channels();
  tell_former_name(argv[0]);
#ifdef DSDPV1_WITH_ARM_BOARD
  tb::add_arm_board();
  tb::add_spc3_arm_board();
#endif
  tb::StandardOutput output;
  const int status = carry_out(argc, argv);
  return judge_output(status, output.finish());
}

}  // namespace
}  // namespace dsdpv1

int main(int argc, char** argv) { return dsdpv1::program(argc, argv); }
