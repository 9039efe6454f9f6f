#pragma once
// Rules for the user's accesses to DPRAM cells: B006, the CRCs, the flags, the chip's own cells. Derived from the
// user's accesses only.
#include <array>
#include <bitset>
#include <cstdint>
#include <optional>

#include "kinds/dsdpv1/checks/blocks.hpp"
#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/port_timing.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

/// A hold runs from R_STA's rise until R_REQ and R_STA are both low again. Changes made by the chip before it are
/// unknown until the user reads them.
class CellRules {
 public:
  explicit CellRules(Recorder& recorder);

  /// RESET is low: then every cell that only the user writes is 0 (H6).
  void reset();
  void hold_began();
  void hold_ended(Tick at);
  void accessed(const Access& access);

 private:
  /// B00A..B011: bytes whose bits belong to one side or the other.
  static constexpr Address kFirstFlags = dsdpv1::regs::kChipStatus1, kLastFlags = dsdpv1::regs::kUserCommand2;
  static constexpr std::size_t kFlagBytes = kLastFlags - kFirstFlags + 1;

  /// The user's actions in the present hold.
  struct Hold {
    std::uint64_t accesses = 0;
    std::optional<std::uint8_t> count;  ///< B006 as last read by the user
    bool counted_unknown = false;       ///< ... with an uncertain result
    unsigned increments = 0;            ///< right ones
    unsigned wrong_counts = 0;
    std::bitset<kFlagBytes> flags_seen;         ///< read or written
    std::bitset<kUserBlocks.size()> announced;  ///< flag set
    std::bitset<kUserBlocks.size()> written;    ///< a byte of the block or its CRC
    std::bitset<2> verdicts;                    ///< on parameters, on configuration
    std::bitset<kChipBlocks.size()> header_read, data_read, crc_high_read, crc_low_read, flag_cleared;
  };

  void read(const Access& access);
  void wrote(const Access& access);
  void check_whose_cell(const Access& access);
  void count_read(const Access& access);
  void count_written(const Access& access);
  void note_read_of_block(Address address);
  void check_what_chip_did(const Access& access);
  void check_what_user_did(const Access& access, std::uint8_t before);
  void note_announcements(const Access& access, std::optional<std::uint8_t> before);
  void check_count(Tick at);
  void check_crcs_written(Tick at);
  void check_crc_written(const Block& block, Tick at);
  void check_crcs_fetched(Tick at);
  void note_verdicts(std::uint8_t now, std::uint8_t before);
  void note_fetched(std::uint8_t now, const std::optional<std::uint8_t>& before);
  void check_verdicts(Tick at);
  std::optional<bool> stands_unfetched(std::size_t verdict) const;
  std::optional<std::uint8_t> look(Address address) const;
  void learn(Address address, const std::optional<std::uint8_t>& value);

  Recorder& recorder_;
  std::array<std::uint8_t, dsdpv1::regs::kDpramSize> cells_{};
  std::bitset<dsdpv1::regs::kDpramSize> known_, chip_writes_, only_chip_writes_;
  Hold hold_;
  std::optional<std::uint8_t> count_left_;             ///< B006 as last written by the user
  std::array<std::uint8_t, kFlagBytes> flags_left_{};  ///< B00A.. as last known to the user
  std::bitset<2> fetched_;                             ///< the user cleared B00E.1, B00E.2 since the last verdict
};

}  // namespace dsdpv1::checks
