// Takes the chip out of reset and waits until it says that it works (D1).
#include "model/dsdpv1/chip.hpp"
#include "registers/dsdpv1_regs.hpp"

int main() {
  constexpr dsdpv1::Tick kCycle = 250;
  dsdpv1::Chip chip;
  chip.set(20 * kCycle, dsdpv1::Pin::kReset, 1);
  chip.advance(10'000 * kCycle);
  return chip.peek(dsdpv1::regs::kValidFlag) == dsdpv1::regs::kValidFlagValid ? 0 : 1;
}
