#pragma once
// The keys of the ARM board under `user_cpu`, for any kind of chip.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "board/stm32/fsmc_timing.hpp"
#include "io/keys/keys.hpp"

namespace dsdpv1::tb {

struct Fsmc : user_cpu::FsmcOverride {
  int line = 0;
};
const keys::ObjectOf<Fsmc>& fsmc_keys();

/// Treatment of scenario parts that need firmware with a mailbox.
enum class WithoutMailbox : std::uint8_t { kRefuse, kLeaveOut };

struct BoardKeys {
  keys::Name elf;
  WithoutMailbox without_mailbox = WithoutMailbox::kRefuse;
  std::vector<keys::Name> switches;  ///< "PA0=low"
  std::optional<double> cpi;         ///< cycles of HCLK per instruction
  std::optional<Fsmc> fsmc;
};

/// A switch of an ARM board that holds an input pin.
struct Switch {
  unsigned port = 0, pin = 0;  ///< port A is 0
  bool high = false;
};
/// "PA0=low"; nullopt for other text, and for pins of ports beyond G.
std::optional<Switch> parse_switch(const std::string& text);

/// For `o.word("kind", ...)` of a kind's user CPU.
constexpr const char* kArmText = "the firmware `elf` on a board with an STM32F103 (docs/arm_board.md)";

template <class U>
void add_elf_key(keys::ObjectOf<U>& o) {
  o.file("elf", &U::elf,
         "Firmware of the ARM board, relative to the scenario's folder; on the command line relative to the current "
         "folder.");
}

template <class U>
void add_without_mailbox_key(keys::ObjectOf<U>& o) {
  o.word("without_mailbox", &U::without_mailbox,
         std::vector<keys::WordFor<WithoutMailbox>>{
             {WithoutMailbox::kRefuse, "refuse",
              "the first of them is reported in one line, and the scenario does not run"},
             {WithoutMailbox::kLeaveOut, "leave_out",
              "actions are not carried out, expectations not judged, and each is listed at the end"}},
         "For firmware without a mailbox: the treatment of actions for the user CPU, of expectations of outputs or of "
         "errors of the driver, and of settings for its program beside `elf` (docs/arm_board.md).");
}

template <class U>
void add_processor_keys(keys::ObjectOf<U>& o) {
  o.names("switches", &U::switches, {0, 112},
          "Switches on input pins of the ARM board, like [PA0=low, PB5=high]: PA0 to PG15 except those that the board "
          "wires to the chip. Pins without a switch have only their pull-up or pull-down.");
  o.number(
      "cpi", &U::cpi, {1, 10}, "HCLK",
      "Cycles of every instruction of the ARM board (default: each instruction's own time, with flash wait states).");
}

/// Pins by port that the board wires to a kind of chip.
using WiredPins = std::array<std::uint16_t, 7>;

/// Throws InputError for keys of an ARM board that are wrong, missing, or there without one; `line`: of the slave.
void check_board_keys(const BoardKeys& board, bool arm, const WiredPins& wired, const std::string& file,
                      const std::string& slave, int line);

}  // namespace dsdpv1::tb
