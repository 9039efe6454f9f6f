// dsdpv1-sim, the one command-line program.
#include <cstdio>
#include <exception>

#include "apps/command_line.hpp"
#include "tb/scenario/input_error.hpp"

int main(int argc, char** argv) {
  try {
    return app::command_line(argc, argv);
  } catch (const tb::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return app::kWrongInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dsdpv1-sim: internal error: %s\n", error.what());
    return app::kFailed;
  }
}
