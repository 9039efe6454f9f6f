#pragma once
// The mailbox in the RAM of firmware that has one (board/firmware/mailbox.h): settings and commands in, counters and
// outputs out. The kind of chip knows what is in it.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tb/chip/user_cpu/program.hpp"

namespace dsdpv1::arm {

class Mailbox {
 public:
  virtual ~Mailbox() = default;
  virtual void post(const user_cpu::Command& command) = 0;
  /// True if look() would have an effect.
  virtual bool has_news() const = 0;
  /// To be called after each step of the processor: passes the next command when the firmware has finished the last,
  /// and fetches outputs and errors. Returns true if it passed one.
  virtual bool look(bus::Tick now, const std::function<void(const user_cpu::ProgramError&)>& on_error) = 0;
  /// The first invalid value that the firmware has written; empty: none.
  virtual const std::string& wrong() const = 0;

  /// State at the last look().
  virtual std::uint64_t outputs_received() const = 0;
  virtual const std::vector<std::uint8_t>& outputs() const = 0;
  virtual user_cpu::ProgramCounters counters() const = 0;
};

}  // namespace dsdpv1::arm
