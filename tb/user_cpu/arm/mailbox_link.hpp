#pragma once
// The bench's end of the mailbox (mailbox.h) in the firmware's RAM.
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "tb/user_cpu/arm/mailbox.h"
#include "tb/user_cpu/programs.hpp"

namespace arm {

class MailboxLink {
 public:
  /// `memory` is the mailbox in the processor's RAM; it is cleared and the settings filled in. Objects beyond DSDPV1_MAILBOX_OBJECTS
  /// are left out.
  MailboxLink(std::uint8_t* memory, const user_cpu::ProgramOptions& options);

  void post(const user_cpu::Command& command) { commands_.push_back(command); }
  /// Hands over the next command when the firmware is done with the last, and looks for errors: after each step of the processor.
  /// True when it has handed one over.
  bool look(bus::Tick now, const std::function<void(const user_cpu::DriverError&)>& on_error);

  std::uint64_t outputs_received() const { return box_.report.outputs_received; }
  std::vector<std::uint8_t> outputs() const;
  user_cpu::ProgramCounters counters() const;

 private:
  dsdpv1_mailbox& box_;
  std::deque<user_cpu::Command> commands_;
  std::uint32_t errors_seen_ = 0;
};

}  // namespace arm
