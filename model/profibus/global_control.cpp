// Global_Control (6.2.6, table 23, rulings S4, S24, S27).
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/user_side.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr std::uint8_t kSync = 0x20, kUnsync = 0x10, kFreeze = 0x08, kUnfreeze = 0x04, kClearData = 0x02;
constexpr int kSize = 2;

}  // namespace

void DpSlave::global_control(Cycle now, const Request& request) {
  const unsigned command = request.size > 0 ? request.data[0] : 0U, group = request.size > 1 ? request.data[1] : 0U;
  if (request.size != kSize || (command & rules_.control_reserved) != 0 || state_ != DpState::kDataExch ||
      master_ != request.sa) {
    log_.at_cycle(now, Reason::kGcIgnored, command, group, request.sa);
    return;
  }
  if (group != 0 && (group & prm_.group) == 0) {
    log_.at_cycle(now, Reason::kGcOtherGroup, command, group, prm_.group);
    return;
  }
  log_.at_cycle(now, Reason::kGlobalControl, command, group, request.sa);
  const Gate outputs = sync_command(now, command), inputs = freeze_command(now, command);
  store_.control(now, {static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(group), request.sa,
                       (command & kClearData) != 0, outputs, inputs});
}

Gate DpSlave::sync_command(Cycle now, unsigned command) {
  if ((command & kUnsync) != 0) return Gate::kOpens;
  if ((command & kSync) == 0) return Gate::kStays;
  if (prm_.sync) return Gate::kCloses;
  log_.at_cycle(now, Reason::kGcSync, config_.sync_supported);
  if (!config_.sync_supported) diagnosis_.not_supported();  // S24
  return Gate::kStays;
}

Gate DpSlave::freeze_command(Cycle now, unsigned command) {
  if ((command & kUnfreeze) != 0) return Gate::kOpens;
  if ((command & kFreeze) == 0) return Gate::kStays;
  if (prm_.freeze) return Gate::kCloses;
  log_.at_cycle(now, Reason::kGcFreeze, config_.freeze_supported);
  if (!config_.freeze_supported) diagnosis_.not_supported();
  return Gate::kStays;
}

// --- the user's side -------------------------------------------------------------------------------------------------

void UserSide::control(Cycle now, const Control& control) {
  mail_.control = {{now}, control.command, control.group, control.master};
  if (control.clears) clear_outputs(now);
  sync(now, control.outputs);
  freeze(control.inputs);
}

void UserSide::sync(Cycle now, Gate gate) {
  if (gate == Gate::kStays) return;
  if (gate == Gate::kOpens) {
    if (!outputs_.held()) return;
    outputs_.release();
  } else {
    outputs_.hold();
    outputs_.pass();
  }
  hand_outputs(now);
}

void UserSide::freeze(Gate gate) {
  if (gate == Gate::kOpens) {
    inputs_.release();
  } else if (gate == Gate::kCloses) {
    inputs_.hold();
    inputs_.pass();
  }
}

}  // namespace dsdpv1::profibus
