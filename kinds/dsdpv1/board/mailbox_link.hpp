#pragma once
// The bench's end of the mailbox (mailbox.h) in the RAM of a DSDPV1's firmware.
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "board/firmware/mailbox.h"
#include "kinds/board/mailbox.hpp"
#include "kinds/dsdpv1/user_cpu/orders.hpp"

namespace dsdpv1::arm {

class MailboxLink : public Mailbox {
 public:
  /// `memory` is the mailbox in the processor's RAM; the constructor clears it and writes the settings. At most
  /// DSDPV1_MAILBOX_OBJECTS objects.
  MailboxLink(std::uint8_t* memory, const user_cpu::ProgramOptions& options);

  void post(const user_cpu::Command& command) override { commands_.push_back(user_cpu::driver_command(command)); }
  bool has_news() const override {
    return (!commands_.empty() && is_done()) || outputs_received_ != box_.report.outputs_received ||
           errors_seen_ != box_.report.error_count || !done_is_right();
  }
  /// Values from the firmware are validated before use, see wrong().
  bool look(bus::Tick now, const std::function<void(const user_cpu::ProgramError&)>& on_error) override;

  /// The first invalid value in the mailbox: "report.output_length is 250, expected 0 to 244". Empty: none. After
  /// one, look() does nothing.
  const std::string& wrong() const override { return wrong_; }

  std::uint64_t outputs_received() const override { return outputs_received_; }
  const std::vector<std::uint8_t>& outputs() const override { return outputs_; }
  user_cpu::ProgramCounters counters() const override;

 private:
  bool is_done() const { return box_.posted == box_.done; }
  bool done_is_right() const { return box_.posted - box_.done <= 1; }
  bool hand_over();
  void fetch_outputs();
  void fetch_errors(bus::Tick now, const std::function<void(const user_cpu::ProgramError&)>& on_error);
  bool is_right(const std::string& field, unsigned value, bool right, const char* allowed);

  dsdpv1_mailbox& box_;
  std::deque<user_cpu::DriverCommand> commands_;
  std::uint32_t errors_seen_ = 0, outputs_received_ = 0;
  std::vector<std::uint8_t> outputs_;
  std::string wrong_;
};

}  // namespace dsdpv1::arm
