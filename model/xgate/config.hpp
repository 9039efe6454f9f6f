#pragma once
// The choices and times of a module that its data sheet leaves open (docs/xgate.md). The module is functional: times on
// the host's side are parameters, none is measured.
#include <array>
#include <cstdint>

#include "model/profibus/time.hpp"

namespace dsdpv1::xgate {

using profibus::Cycle;

enum class Port : std::uint8_t { kUart, kSpi };              ///< clause 4.6
enum class ErrorForm : std::uint8_t { kFlag, kPrinted };     ///< X3: 03H and special bit 7, or 83H as clause 4.5.1
enum class MailboxForm : std::uint8_t { kSpecial, kShort };  ///< X6: with the byte `special`, or without
enum class WatchdogUse : std::uint8_t { kStored, kHost };    ///< X12
enum class StepAnswer : std::uint8_t { kTable, kExample };   ///< X15: command 13 is answered with 13, or with 04
using Words = std::array<std::uint8_t, 12>;                  ///< serial number, name

struct Config {
  Port port = Port::kUart;
  ErrorForm errors = ErrorForm::kFlag;
  MailboxForm mailboxes = MailboxForm::kSpecial;
  WatchdogUse watchdog = WatchdogUse::kStored;
  StepAnswer step_answer = StepAnswer::kTable;
  std::uint32_t rate = 115'200;                             ///< bit/s of the UART, 1200 to 3 000 000 (X18)
  std::uint32_t answer_delay = profibus::kCyclesPerMs / 2;  ///< cycles from a command to its answer (X2)
  std::uint32_t frame_gap = 2 * profibus::kCyclesPerMs;     ///< cycles, at least 10 characters (X4)
  std::uint32_t power_up = 10 * profibus::kCyclesPerMs;     ///< cycles from /Rst to the first frame (X18)
  std::uint32_t rate_hold = profibus::kCyclesPerMs;         ///< cycles from 03's answer to the new rate (X13)
  std::uint32_t host_shown = 500 * profibus::kCyclesPerMs;  ///< cycles for which LED2 shows a command (X26)
  std::uint32_t most_cfg = 24;                              ///< bytes of configuration in command 04 (X5)
  std::uint32_t c1_id = 1, c2_id = 2, mailbox_special = 0;  ///< bytes of mailboxes (X6, X7)
  std::uint32_t vendor = 1, device = 1, hardware = 0x100, software = 0x100;  ///< 16 bits each (X27)
  Words serial{}, name{'X', 'G', 'a', 't', 'e', '-', 'D', 'P', 'S', '1', '0'};

  /// Each number with its name, for saved states.
  template <class Tell>
  void each_parameter(const Tell& tell) {
    auto& [on, form, boxes, dog, step, baud, delay, gap, power, hold, shown, cfg, first_id, second_id, special, maker,
           product, board, program, number, label] = *this;
    const auto choice = [&](const char* key, auto& value) {
      auto word = static_cast<std::uint32_t>(value);
      tell(key, word);
    };
    choice("port", on);
    choice("errors", form);
    choice("mailboxes", boxes);
    choice("watchdog", dog);
    choice("step_answer", step);
    tell("rate", baud);
    tell("answer_delay", delay);
    tell("frame_gap", gap);
    tell("power_up", power);
    tell("rate_hold", hold);
    tell("host_shown", shown);
    tell("most_cfg", cfg);
    tell("c1_id", first_id);
    tell("c2_id", second_id);
    tell("mailbox_special", special);
    tell("vendor", maker);
    tell("device", product);
    tell("hardware", board);
    tell("software", program);
    static_cast<void>(number);  // commands may change them: part of the state
    static_cast<void>(label);
  }
};

}  // namespace dsdpv1::xgate
