// dsdpv1-sim.
#include <cstdio>
#include <filesystem>

#include "apps/program.hpp"
#include "kinds/dsdpv1/board/arm_user.hpp"
#include "kinds/spc3/board/arm_user.hpp"
#include "kinds/xgate/board/arm_user.hpp"

namespace {

/// Formerly a separate program, for the ARM board (docs/install.md, Versions).
void tell_former_name(const char* name) {
  if (std::filesystem::path(name).filename() != "dsdpv1-board") return;
  std::fprintf(stderr, "dsdpv1-board is deprecated and goes with 0.5: use dsdpv1-sim, which it is\n");
}

}  // namespace

int main(int argc, char** argv) {
  tell_former_name(argv[0]);
#ifdef DSDPV1_WITH_ARM_BOARD
  dsdpv1::tb::add_arm_board();
  dsdpv1::tb::add_spc3_arm_board();
  dsdpv1::xgate::add_arm_board();
#endif
  return dsdpv1::app::program(argc, argv, "dsdpv1-sim");
}
