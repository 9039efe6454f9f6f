// A program with all commands and the chip of alarm_kind.hpp.
#include "apps/program.hpp"
#include "tests/kit/alarm_kind.hpp"

int main(int argc, char** argv) {
  return dsdpv1::app::program(
      argc, argv, "alarmer", [] { return dsdpv1::tb::ChipKinds{&dsdpv1::kit::alarm_kind()}; });
}
