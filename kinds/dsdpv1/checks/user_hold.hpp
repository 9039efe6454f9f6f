#pragma once
// The user's accesses to the DPRAM between taking and releasing it, summed up: flags seen, cleared and set, blocks
// read. Over the UART, which has no ownership, each telegram is a hold.
#include <array>
#include <cstdint>
#include <optional>

#include "kinds/dsdpv1/checks/blocks.hpp"
#include "kinds/dsdpv1/checks/port_timing.hpp"

namespace dsdpv1::checks {

/// Function_Num, slot, index, length of a request or answer on C1 or C2.
using AcyclicHeader = std::array<std::uint8_t, 4>;

/// A byte of flags in a hold.
struct FlagsInHold {
  std::optional<std::uint8_t> read;  ///< as the user first read it
  std::uint8_t before = 0;           ///< B00E, B00F: flags certainly set before; the user alone clears them
  std::uint8_t after = 0;            ///< as last read or written
  std::uint8_t taken = 0;            ///< cleared by the chip for the user, set or not (SP16, UA11)
  bool written = false;

  /// B00E, B00F: flags that the user cleared.
  std::uint8_t cleared() const { return static_cast<std::uint8_t>(before & ~after); }
  /// ... or the chip for the user: those of blocks that it has fetched.
  std::uint8_t fetched() const { return static_cast<std::uint8_t>(cleared() | taken); }
  bool looked_at() const { return read || written; }
  /// B010, B011: flags that the user set, certainly.
  std::uint8_t set() const { return written ? static_cast<std::uint8_t>(after & ~read.value_or(0)) : std::uint8_t{0}; }
};

/// Telegrams without ownership (SP14, UA6) may fetch a block before or after they clear its flag.
enum class HoldOf : std::uint8_t { kDpram, kTelegram };

struct UserHold {
  HoldOf what = HoldOf::kDpram;
  Tick began = 0, ended = 0;
  FlagsInHold chip_1, chip_2, user_1, user_2;  ///< B00E, B00F, B010, B011
  std::optional<bool> initialised;             ///< B00A.0 as read, unless the user has cleared it itself (chapter 8)
  std::optional<bool> chip_came;               ///< since the last hold: B006 was read as 1 (H3)
  bool told_news = false;                      ///< by the reply to inputs over the UART (UA10)

  bool initialises() const { return user_1.written && (user_1.after & regs::kUserCommand1Init) != 0; }
  const FlagsInHold& chip(const Block& block) const { return block.command == regs::kChipCommand1 ? chip_1 : chip_2; }
};

class UserHolds {
 public:
  /// RESET is low: all cells are 0 (H6).
  void reset() { *this = UserHolds(); }
  void began(Tick at);
  void accessed(const Access& access);
  /// The chip clears or sets a flag as part of the user's telegram.
  void taken(Address command, std::uint8_t flag);
  void announced(Address command, std::uint8_t flag);
  void told_news() { hold_.told_news = true; }
  const UserHold& ended(Tick at, HoldOf what);

  /// Whether the user has read length and bytes of a block since `forget_reads`; absent if a value was uncertain.
  std::optional<bool> read_all(const Block& block) const;
  /// Both bytes of its CRC, since then.
  bool has_read_crc(const Block& block) const { return has_read(block.crc, 2); }
  void forget_reads();
  /// A request as the user has read it since `forget_reads`; absent if it has not read all of it for certain.
  std::optional<AcyclicHeader> request_read(const Block& request) const;
  /// The answer on C1 (0) or C2 (1) as last written.
  const AcyclicHeader& answer_written(std::size_t channel) const { return answers_.at(channel); }
  /// No byte of the initialisation has changed since `initialised`.
  bool is_same_initialisation() const { return !init_changed_; }
  void initialised() { init_changed_ = cleared_initialised_ = false; }
  /// B02B, B02D as last written: the judging modes (D8).
  std::uint8_t prm_mode() const { return init_.at(regs::kPrmMode - regs::kInit); }
  std::uint8_t cfg_mode() const { return init_.at(regs::kCfgMode - regs::kInit); }

 private:
  static constexpr Address kFirst = regs::kOutput;  ///< the chip's blocks are behind it

  FlagsInHold* flags(Address address);
  void read(const Access& access);
  void wrote(const Access& access);
  void note_block(Address address, std::uint8_t value);
  bool has_read(unsigned first, unsigned count) const;

  UserHold hold_;
  std::array<std::uint8_t, regs::kDpramSize> values_{};  ///< read ones
  std::array<std::uint64_t, regs::kDpramSize / 64> read_{};
  bool any_read_ = false, uncertain_ = false;
  std::array<AcyclicHeader, 2> answers_{};
  std::array<std::uint8_t, regs::kInitSize> init_{};
  bool init_changed_ = true;
  bool cleared_initialised_ = false;  ///< B00A.0, by the user since its last initialisation
};

}  // namespace dsdpv1::checks
