// dsdpv1-board: what dsdpv1-sim hands scenarios with an ARM board over to. It has the board's emulator, which is
// GPL-2.0-only, and therefore no SystemC.
#include "apps/program.hpp"
#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/board/arm_user.hpp"

namespace dsdpv1::app {

int in_tlm_view(const std::function<int(std::unique_ptr<tb::Execution>)>& /*body*/) {
  throw tb::InputError(
      "dsdpv1-sim run: --view tlm is in SystemC, which is never in one program with an ARM board (docs/licences.md), "
      "allowed with kind: arm is --view pins");
}

}  // namespace dsdpv1::app

int main(int argc, char** argv) {
  dsdpv1::tb::add_arm_board();
  return dsdpv1::app::program(argc, argv);
}
