#include "kinds/dsdpv1/checks/start_order.hpp"

#include <fmt/format.h>

#include <utility>

namespace dsdpv1::checks {
namespace {

/// What the port itself needs: the count of holds; over SPI and UART ownership, intervals.
constexpr bool belongs_to_port(unsigned address) {
  return address == regs::kAccessCount || (address >= regs::kOwnership && address < regs::kInit);
}

}  // namespace

void StartOrder::judge(const Access& access) {
  if (!access.write) {
    if (access.address == regs::kValidFlag && access.value == regs::kValidFlagValid) state_ = State::kSeen;
    return;
  }
  if (belongs_to_port(access.address)) return;
  const State before = std::exchange(state_, State::kJudged);
  recorder_.kept(Check::kReadyUnseen, access.at, before == State::kSeen, [&access] {
    return fmt::format("B{:03X} written, and B004 was not read as C5 before", access.address);
  });
}

/// Chapter 8: the user may initialise again what was refused, or when B006 says that the chip has not come.
void StartOrder::hold(const UserHold& hold, bool same) {
  if (hold.chip_came) chip_came_ = chip_came_.value_or(false) || *hold.chip_came;
  if (hold.initialised == false || chip_came_ == false) initialised_.reset();
  if (!hold.initialises()) return;
  if (initialised_ && same)
    recorder_.value(
        Check::kInitRepeated, hold.ended, hold.ended - *initialised_,
        [] { return std::string("B010.2 set again, B020 to B0F6 unchanged"); },
        Act::written(regs::kUserCommand1, hold.ended));
  initialised_ = hold.ended;
  chip_came_.reset();
}

}  // namespace dsdpv1::checks
