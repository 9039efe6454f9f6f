// dsdpv1-sim: the command-line program, with SystemC. Scenarios with an ARM board are handed over to dsdpv1-board.
#include "apps/program.hpp"
#include "kinds/dsdpv1/tlm/tlm_execution.hpp"

namespace dsdpv1::app {

int in_tlm_view(const std::function<int(std::unique_ptr<tb::Execution>)>& body) {
  return tb::inside_systemc([&body] { return body(tb::make_tlm_execution()); });
}

}  // namespace dsdpv1::app

int main(int argc, char** argv) { return dsdpv1::app::program(argc, argv); }
