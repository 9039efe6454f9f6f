// Global_Control (6.2.6, table 23, rulings S4, S24, S27).
#include "model/profibus/dp_slave.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr std::uint8_t kSync = 0x20, kUnsync = 0x10, kFreeze = 0x08, kUnfreeze = 0x04, kClearData = 0x02,
                       kReserved = 0xC1;
constexpr int kSize = 2;

}  // namespace

void DpSlave::global_control(Cycle now, const Request& request) {
  const unsigned command = request.size > 0 ? request.data[0] : 0U, group = request.size > 1 ? request.data[1] : 0U;
  if (request.size != kSize || (command & kReserved) != 0 || state_ != DpState::kDataExch || master_ != request.sa) {
    log_.at_cycle(now, Reason::kGcIgnored, command, group, request.sa);
    return;
  }
  if (group != 0 && (group & prm_.group) == 0) {
    log_.at_cycle(now, Reason::kGcOtherGroup, command, group, prm_.group);
    return;
  }
  log_.at_cycle(now, Reason::kGlobalControl, command, group, request.sa);
  mail_.control = {{now}, static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(group), request.sa};
  if ((command & kClearData) != 0) clear_outputs(now);
  sync_command(now, static_cast<std::uint8_t>(command));
  freeze_command(now, static_cast<std::uint8_t>(command));
}

void DpSlave::sync_command(Cycle now, std::uint8_t command) {
  if ((command & (kSync | kUnsync)) == 0) return;
  if ((command & kUnsync) != 0) {
    if (!outputs_.held()) return;
    outputs_.release();
  } else if (prm_.sync) {
    outputs_.hold();
    outputs_.pass();
  } else {
    log_.at_cycle(now, Reason::kGcSync, config_.sync_supported);
    if (!config_.sync_supported) diagnosis_.not_supported();  // S24
    return;
  }
  hand_outputs(now);
}

void DpSlave::freeze_command(Cycle now, std::uint8_t command) {
  if ((command & kUnfreeze) != 0) {
    inputs_.release();
  } else if ((command & kFreeze) != 0 && prm_.freeze) {
    inputs_.hold();
    inputs_.pass();
  } else if ((command & kFreeze) != 0) {
    log_.at_cycle(now, Reason::kGcFreeze, config_.freeze_supported);
    if (!config_.freeze_supported) diagnosis_.not_supported();
  }
}

}  // namespace dsdpv1::profibus
