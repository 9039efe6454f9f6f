#pragma once
// SPI1 or SPI2 of the STM32F103 as a full-duplex master (RM0008, chapter SPI): a buffer and a shift register in each
// direction; the next byte is lost when a byte is fetched too late. Times are cycles of HCLK. Assumed, as the manual
// is silent (p): a byte in the buffer goes to the idle shift register with the next cycle of PCLK, its first bit is out
// then, and SCK's first edge follows half a bit later.
#include <cstdint>
#include <limits>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

class Spi {
 public:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kSr = 0x08, kDr = 0x0C;
  static const RegisterTable kRegisters;

  /// Cycles of HCLK in a cycle of PCLK: 1, 2, 4, 8 or 16; in force from the next edge on.
  void set_divider(unsigned hclk_cycles) { divider_ = hclk_cycles; }

  /// read() of DR or SR has side effects (RXNE, OVR, MODF), peek() has none.
  std::uint32_t peek(std::uint32_t offset) const;
  std::uint32_t read(std::uint32_t offset);
  void write(std::uint32_t offset, std::uint32_t value, std::uint64_t now);
  /// As after a reset, except the clock and lost().
  void reset();

  /// The cycle of its next action, kNever when there is none.
  std::uint64_t next() const { return at_; }
  /// Acts at cycle next(). `miso`: the pin's level just before it.
  void run(bool miso);
  /// NSS as an input; low is a mode fault (MODF) of a master with SSM and SSOE 0.
  void set_nss(bool level);

  /// It drives SCK and MOSI: enabled as a master.
  bool drives() const { return (words_[kCr1] & (kSpe | kMstr)) == (kSpe | kMstr); }
  bool sck() const { return sck_; }
  bool mosi() const { return mosi_; }
  /// It drives NSS, low, while it is enabled (SSOE).
  bool selects() const { return drives() && (words_[kCr1] & kSsm) == 0 && (words_[kCr2] & kSsoe) != 0; }
  /// Asks for its interrupt.
  bool asks() const;
  /// Bytes that came while the previous one had not been fetched.
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr std::uint32_t kCpha = 1U << 0U, kCpol = 1U << 1U, kMstr = 1U << 2U, kSpe = 1U << 6U,
                                 kLsbFirst = 1U << 7U, kSsi = 1U << 8U, kSsm = 1U << 9U, kDff = 1U << 11U;
  static constexpr std::uint32_t kSsoe = 1U << 2U;
  static constexpr std::uint32_t kRxne = 1U << 0U, kTxe = 1U << 1U, kModf = 1U << 5U, kOvr = 1U << 6U, kBsy = 1U << 7U;

  unsigned bits() const { return (words_[kCr1] & kDff) != 0 ? 16 : 8; }
  std::uint64_t half_bit() const { return std::uint64_t{divider_} << (words_[kCr1] >> 3U & 7U); }
  bool sampling(unsigned edge) const { return (edge % 2 == 1) == ((words_[kCr1] & kCpha) == 0); }
  bool transfers() const { return edge_ > 0; }
  bool nss_is_low() const;
  void write_control(std::uint32_t value, std::uint64_t now);
  void check_mode();
  void load_soon(std::uint64_t now);
  void load();
  void end();
  void sample(bool miso);
  void put_out();
  void receive();

  unsigned divider_ = 1;
  RegisterWords<kRegisters, 9> words_;
  std::uint16_t tx_ = 0;                       ///< the transmit buffer of DR
  std::uint16_t out_ = 0, in_ = 0;             ///< the shift register
  unsigned edge_ = 0, bit_ = 0, sampled_ = 0;  ///< SCK's next edge, 0: no transfer; bits sent; bits sampled
  std::uint64_t at_ = kNever;
  bool sck_ = false, mosi_ = false, nss_ = true;
  bool ovr_read_ = false;   ///< DR has been read since OVR: a read of SR clears OVR
  bool modf_read_ = false;  ///< SR has been read since MODF: a write of CR1 clears MODF
  std::uint64_t lost_ = 0;
};

}  // namespace dsdpv1::arm
