#pragma once
// Wrong bits on their way from the chip's pins to the user CPU, as on a bad board: each must be seen by a CRC (4.2,
// R15).
#include <array>
#include <cstdint>

#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::user_cpu {

class ReadSpoiler {
 public:
  /// From now on: once in each block that the chip writes, or in every second of some long replies of a serial port.
  void arm() {
    blocks_.fill(true);
    replies_ = kReplies;
  }

  /// Parallel: the user reads this cell; returns the bits that are wrong.
  std::uint8_t wrong_bits(regs::Address cell) {
    for (std::size_t i = 0; i < kSpoilt.size(); ++i)
      if (cell == kSpoilt.at(i) && blocks_.at(i)) {
        blocks_.at(i) = false;
        return 1;
      }
    return 0;
  }

  /// XSS falls, or RXD changes: what follows is a reply.
  void request_begins() { place_ = 0; }

  /// SPI: a rise of SCK. Bits count from MISO's first 0, the second or third of a reply; the reply to a write, 101
  /// (SP4), is let through.
  void sck_rises(bool miso) {
    if (place_ == 0 && miso) return;
    if (++place_ == 2 && miso) place_ = kMisoEnd + 1;
    if (place_ == kMisoEnd && replies_ != 0) --replies_;
  }
  bool inverts_miso() const { return spoils() && place_ >= kMisoBegin && place_ < kMisoEnd; }
  bool begins_to_invert() const { return spoils() && place_ == kMisoBegin; }

  /// UART: a fall of TXD; returns true if the user does not see it.
  bool hides_fall() {
    constexpr unsigned kFirst = 8, kSpread = 12;  // the third to about the sixth character
    if (++place_ != kFirst + replies_ * 5 % kSpread || replies_ == 0) return false;
    const bool hides = spoils();
    --replies_;
    return hides;
  }

 private:
  /// Bytes that tell blocks apart: first data, of requests the slot.
  static constexpr std::array<regs::Address, 5> kSpoilt = {regs::kOutputData, regs::kPrmData, regs::kCfgData,
                                                           static_cast<regs::Address>(regs::kC1 + 1),
                                                           static_cast<regs::Address>(regs::kC2 + 1)};
  static constexpr unsigned kMisoBegin = 17, kMisoEnd = 19;  ///< in the first byte of data
  /// Which of the next replies are wrong: few, so that each may be asked for again, and no hold becomes much longer.
  static constexpr unsigned kReplies = 16, kWrong = 0x2104;

  bool spoils() const { return (kWrong >> replies_ & 1U) != 0; }

  std::array<bool, kSpoilt.size()> blocks_{};
  unsigned replies_ = 0;  ///< to come
  unsigned place_ = 0;    ///< in a reply: bits of MISO, falls of TXD
};

}  // namespace dsdpv1::user_cpu
