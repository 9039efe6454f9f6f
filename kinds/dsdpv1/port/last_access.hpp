#pragma once
// The user's last action at the host port as text, derived from the chip's inputs: an access, or a telegram.
#include <string>
#include <vector>

#include "kinds/dsdpv1/port/spi_frame_reader.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

/// A read counts from the fall of RD, a write from the rise of WR, both while CSR is low. A frame of SPI counts from
/// XSS's fall, a telegram of the UART from its first start bit; characters belong to one telegram if fewer than seven
/// half characters are between them (UA3's minimum). The strap UBR gives the rate.
class LastAccess : public AccessReader, private RsuFrameReader {
 public:
  void pin(Tick at, PinNumber pin, Level level) override;
  /// "read B410 at cycle 84795 + 122 ticks (1766.573 us)", "write B011 := 01 at ...", "none"; "SPI frame of 11 bytes
  /// from cycle 4000 (83.333 us): 01 00 14 01 18 CF FF FF FF FF FF".
  std::string words() const override;

 private:
  void strobe(Tick at, bool write);
  void frame_began(Tick at) override { begin(at, "SPI frame"); }
  void byte(Tick /*at*/, std::uint8_t mosi, std::uint8_t /*miso*/) override { bytes_.push_back(mosi); }
  void rxd(Tick at, bool level);
  void sample_until(Tick at);
  void begin(Tick at, const char* what);
  std::string telegram_words() const;
  Tick bit() const;

  Tick access_ = -1, telegram_ = -1;  ///< begin; -1: none
  bool write_ = false;
  Level address_ = 0, data_ = 0;                   ///< of the access
  Level csr_ = 1, a_ = 0, d_ = kLevelZ, ubr_ = 0;  ///< at the pins
  const char* what_ = "";                          ///< kind of telegram
  std::vector<std::uint8_t> bytes_;
  // UART
  bool rxd_ = true;
  Tick character_ = 0;   ///< begin of the last one
  int sampled_ = kBits;  ///< its bits so far
  unsigned shift_ = 0;
  static constexpr int kBits = 11;
};

}  // namespace dsdpv1::tb
