#include "apps/program.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "apps/command_line.hpp"
#include "apps/exit_codes.hpp"
#include "apps/hand_over.hpp"
#include "apps/printable_output.hpp"
#include "apps/stack.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "io/output/standard_output.hpp"

namespace dsdpv1 {
namespace {

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

/// What should have been said and was not, is an error of its own.
int judge_output(int status, int error) {
  if (error == 0) return status;
  if (status == app::kInterrupted) return status;
  if (error == EPIPE) end_as_by_sigpipe();
  std::fprintf(stderr, "dsdpv1-sim: standard output cannot be written: %s\n", std::strerror(error));
  return app::kWrongInput;
}

int carry_out_or_hand_over(int argc, char** argv) {
  tb::StandardOutput output;
  try {
    const int status = carry_out(argc, argv);
    return judge_output(status, output.finish());
  } catch (const app::HandOver& other) {
    output.finish();
    return app::become(other, argv);
  }
}

}  // namespace

namespace app {

int program(int argc, char** argv) {
  if (!ensure_stack()) return kWrongInput;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large shows at the write
  tb::fill_closed_channels();
  return carry_out_or_hand_over(argc, argv);
}

}  // namespace app
}  // namespace dsdpv1
