#pragma once
// The module's UART at its pins (4.7.2): 8 bits, no parity, one stop bit, from and to whole bytes. All is at edges of
// the clock.
#include <algorithm>
#include <cstdint>
#include <optional>

#include "model/profibus/time.hpp"

namespace dsdpv1::xgate {

using profibus::Cycle;

/// `halves` half bits at a rate in bit/s, in cycles.
constexpr Cycle half_bits(int halves, std::uint32_t rate) {
  return halves * (1000 * profibus::kCyclesPerMs) / (2 * static_cast<Cycle>(rate));
}

/// TXD.
class UartOut {
 public:
  void reset() { *this = UartOut(); }
  void begin(Cycle now, std::uint8_t byte, std::uint32_t rate) {
    begins_ = now;
    rate_ = rate;
    bits_ = byte * 2U | kStop;
    bit_ = 0;
  }
  /// The level from the edge `now` on.
  bool level(Cycle now) {
    while (bit_ < kBits - 1 && now >= edge(bit_ + 1)) ++bit_;
    return (bits_ >> bit_ & 1U) != 0;
  }
  Cycle next() const { return bit_ < kBits - 1 ? edge(bit_ + 1) : profibus::kNever; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [begins, rate, bits, bit] = *this;
    archive.cycles(begins);
    archive.within(1200U, 3'000'000U, rate);
    archive.within(0U, 0x3FFU, bits);
    archive.within(0, kBits - 1, bit);
  }

 private:
  static constexpr int kBits = 10;
  static constexpr unsigned kStop = 0x200;
  Cycle edge(int bit) const { return begins_ + half_bits(2 * bit, rate_); }

  Cycle begins_ = 0;
  std::uint32_t rate_ = 1200;
  unsigned bits_ = kStop;
  int bit_ = kBits - 1;  ///< on the line
};

/// RXD: each bit is sampled in its middle, counted from the edge that sees the start bit. A start bit that is high in
/// its middle is none; a byte with a low stop bit is lost (X29).
class UartIn {
 public:
  void reset() { *this = UartIn(); }
  /// RXD has fallen, and `sees` is the first edge that sees it.
  void fell(Cycle sees, std::uint32_t rate) {
    if (bit_ >= 0) return;
    begins_ = sees;
    rate_ = rate;
    bit_ = 0;
  }
  struct Heard {
    std::optional<std::uint8_t> byte;  ///< its stop bit has ended
    bool broken = false;               ///< its stop bit is low
  };
  Heard eval(Cycle now, bool level) {
    Heard heard;
    if (bit_ >= 0 && now >= middle()) heard.broken = sample(level);
    if (now < ends_) return heard;
    ends_ = profibus::kNever;
    heard.byte = byte_;
    return heard;
  }
  Cycle next() const { return bit_ >= 0 ? std::min(middle(), ends_) : ends_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [begins, ends, rate, bits, bit, byte] = *this;
    archive.cycles(begins, ends);
    archive.within(1200U, 3'000'000U, rate);
    archive.within(0U, 255U, bits);
    archive.within(-1, kStopBit, bit);
    archive(byte);
  }

 private:
  static constexpr int kStopBit = 9;
  Cycle middle() const { return begins_ + half_bits(2 * bit_ + 1, rate_); }
  /// True: a byte has a low stop bit.
  bool sample(bool level) {
    if (bit_ == 0 && level) {
      bit_ = -1;
    } else if (bit_ < kStopBit) {
      bits_ = bits_ >> 1 | (level ? 0x80U : 0U);
      ++bit_;
    } else {
      bit_ = -1;
      byte_ = static_cast<std::uint8_t>(bits_);
      if (level) ends_ = begins_ + half_bits(2 * (kStopBit + 1), rate_);
      return !level;
    }
    return false;
  }

  Cycle begins_ = 0, ends_ = profibus::kNever;
  std::uint32_t rate_ = 1200;
  unsigned bits_ = 0;
  int bit_ = -1;  ///< that is sampled next; -1: none has begun
  std::uint8_t byte_ = 0;
};

}  // namespace dsdpv1::xgate
