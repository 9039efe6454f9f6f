#pragma once
// What the user has sent last at a serial port of a DSDPV1-RSU, read from its pins.
#include <cstdint>
#include <string>
#include <vector>

#include "model/dsdpv1/config.hpp"

namespace dsdpv1::tb {

/// A frame of SPI counts from XSS's fall, a telegram of the UART from its first start bit; characters belong to one as
/// long as fewer than seven half characters are between them (UA3's shortest). The rate is that of the strap UBR.
class LastTelegram {
 public:
  /// Every change of an input pin, in order of time.
  void pin(Tick at, Pin pin, Level level);
  /// When the last one began; -1: none.
  Tick begin() const { return begin_; }
  /// "SPI frame of 11 bytes from cycle 4000 (83.333 us): 01 00 14 01 18 CF FF FF FF FF FF".
  std::string words() const;

 private:
  void xss(Tick at, bool level);
  void sck(bool level);
  void rxd(Tick at, bool level);
  void sample_until(Tick at);
  void begin(Tick at, const char* what);
  Tick bit() const { return kUbrCycles.at(static_cast<std::size_t>(ubr_)) * profibus::kTicksPerCycle; }

  const char* what_ = "";
  Tick begin_ = -1;
  std::vector<std::uint8_t> bytes_;
  bool selected_ = false, mosi_ = false;  // SPI
  bool rxd_ = true;                       // UART
  Level ubr_ = 0;
  Tick character_ = 0;   ///< begin of the last character
  int sampled_ = kIdle;  ///< its bits so far
  unsigned shift_ = 0;   ///< of the byte that is coming; SPI: with a 1 before its bits
  static constexpr int kIdle = 11;
};

}  // namespace dsdpv1::tb
