#pragma once
// Frames of SPI and telegrams of the UART, sent by a host at the serial ports of a DSDPV1-RSU, as edges of the pins.
// For user CPUs of the bench and for adapters that turn transactions into pins.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1 {

/// A change of a serial pin. Ticks count from the begin of the frame or telegram.
struct SerialEdge {
  Tick at = 0;
  Pin pin = Pin::kXss;  ///< kMiso: MISO is sampled, at its level strictly before this tick
  bool level = true;
};

// ----------------------------------------------------------------------------------------------------------------- SPI

/// In ticks of 1/12 ns. The defaults are 9 MHz (000 1.2), and an XSS moved by software.
struct SpiTiming {
  Tick high = 667, low = 666;  ///< of SCK
  Tick lead = 2400;            ///< XSS falls, SCK rises: 200 ns
  Tick lag = 2400;             ///< SCK falls, XSS rises
  Tick gap = 6000;             ///< minimum high time of XSS between two frames: 500 ns
  Tick byte_gap = 0;           ///< additional low time of SCK between two bytes
  Tick mosi_delay = 0;         ///< from SCK's fall (first bit: XSS's) to MOSI's change; at most `low`
  unsigned mode = 0;           ///< of SCK: bit 1 high at rest (CPOL), bit 0 MOSI is taken by its second edge (CPHA)
};

/// One frame of XSS, MSB first; a DSDPV1-RSU has mode 0 (SP1). MOSI changes `mosi_delay` after SCK's fall, for the
/// first bit after XSS's fall, but not after SCK's first rise or XSS's rise. With CPHA it changes after SCK's first
/// edge, at most `high` later. CPOL inverts SCK.
class SpiFrame {
 public:
  SpiFrame() = default;  ///< no edges
  /// `bits`: XSS rises after so many bits, within the bytes; else after all.
  SpiFrame(std::vector<std::uint8_t> out, const SpiTiming& timing, std::optional<std::size_t> bits = {});

  std::size_t size() const { return size_; }
  SerialEdge operator[](std::size_t number) const;
  /// From XSS's fall to its rise.
  Tick duration() const { return size_ == 0 ? 0 : (*this)[size_ - 1].at; }
  /// Reports the level found at the frame's next sampling edge.
  void sampled(bool miso);
  /// One for each byte sent; bytes cut off by XSS, and bits not sampled, are 1.
  const std::vector<std::uint8_t>& received() const { return in_; }

 private:
  Tick rise(std::size_t bit) const;
  SerialEdge late_edge(std::size_t bit, std::size_t part) const;
  bool mosi(std::size_t bit) const;
  Tick mosi_delay(std::size_t bit) const;  ///< after this bit

  SpiTiming timing_;
  std::vector<std::uint8_t> out_, in_;
  std::size_t bits_ = 0, size_ = 0, sampled_ = 0;
};

// ---------------------------------------------------------------------------------------------------------------- UART

struct UartTiming {
  std::int64_t baud = 1'843'200;  ///< bit/s; the k-th bit of a character ends k/baud after its begin, rounded to a tick
  Tick gap = 0;                   ///< idle between two characters of a telegram
  bool parity = true;             ///< even; without it a character has ten bits

  std::size_t bits() const { return parity ? 11 : 10; }
};

/// Faults to inject into a telegram on RXD. Numbers count characters from 0.
struct UartFaults {
  std::optional<std::size_t> wrong_parity;
  std::optional<std::size_t> break_at;      ///< RXD is low for the whole of this character
  std::optional<std::size_t> pause_before;  ///< everything from this character on is `pause` ticks later
  Tick pause = 0;
};

/// `count` half bits in ticks, rounded once.
Tick half_bits(const UartTiming& timing, std::int64_t count);

/// Characters on RXD: start, 8 bits LSB first, even parity unless there is none, stop (UA1).
class UartTelegram {
 public:
  UartTelegram() = default;  ///< no edges
  UartTelegram(std::vector<std::uint8_t> bytes, const UartTiming& timing, const UartFaults& faults = {})
      : timing_(timing), bytes_(std::move(bytes)), faults_(faults) {}

  /// One for each bit, even if RXD does not change, and one for the end of the last.
  std::size_t size() const { return bytes_.empty() ? 0 : timing_.bits() * bytes_.size() + 1; }
  SerialEdge operator[](std::size_t number) const { return {tick_of(number), Pin::kRxd, level_of(number)}; }
  /// To the end of the last stop bit.
  Tick duration() const { return size() == 0 ? 0 : tick_of(size() - 1); }

 private:
  Tick tick_of(std::size_t bit) const;
  bool level_of(std::size_t bit) const;

  UartTiming timing_;
  std::vector<std::uint8_t> bytes_;
  UartFaults faults_;
};

}  // namespace dsdpv1
