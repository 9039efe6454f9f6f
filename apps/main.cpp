// dsdpv1-sim, the one command-line program.
#include <cstdio>
#include <exception>

#include "apps/command_line.hpp"
#include "apps/printable_output.hpp"
#include "apps/stack.hpp"
#include "bus/printable.hpp"
#include "tb/scenario/input_error.hpp"

int main(int argc, char** argv) {
  if (!app::ensure_stack()) return app::kWrongInput;
  const app::PrintableOutput printable;
  try {
    return app::command_line(argc, argv);
  } catch (const tb::InputError& error) {
    std::fprintf(stderr, "%s\n", bus::printable(error.what()).c_str());
    return app::kWrongInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dsdpv1-sim: internal error: %s\n", bus::printable(error.what()).c_str());
    return app::kFailed;
  }
}
