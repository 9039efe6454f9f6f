// Takes the chip out of reset, waits until it reports that it works (D1), and prints its events.
#include <string>

#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "registers/dsdpv1_regs.hpp"

int main() {
  constexpr dsdpv1::Tick kCycle = 250;
  std::string words;
  dsdpv1::Chip chip;
  chip.on_event({[](void* self, const dsdpv1::profibus::Event& event) {
                   if (event.reason == dsdpv1::dpram::Reason::kReadyFlag)
                     *static_cast<std::string*>(self) = dsdpv1::describe(event);
                 },
                 &words});
  chip.set(20 * kCycle, dsdpv1::Pin::kReset, 1);
  chip.advance(10'000 * kCycle);
  const bool works = chip.peek(dsdpv1::regs::kValidFlag) == dsdpv1::regs::kValidFlagValid;
  return works && words == "start-up finished: B004 = 0xC5" ? 0 : 1;
}
