#include "board/stm32/spi.hpp"

#include <utility>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kErrIe = 1U << 5U, kRxneIe = 1U << 6U, kTxeIe = 1U << 7U;
constexpr std::uint32_t kI2scfgr = 0x1C;
constexpr RegisterList kSpiRegisters = {  // I2S also for SPI1: drivers switch it off
    {Spi::kCr1, "CR1", 0, 0xFFFF},
    {Spi::kCr2, "CR2", 0, 0xE7},
    {Spi::kSr, "SR", 0x02},
    {Spi::kDr, "DR"},
    {0x10, "CRCPR", 7, 0xFFFF},
    {0x14, "RXCRCR"},
    {0x18, "TXCRCR"},
    {kI2scfgr, "I2SCFGR", 0, 0xFBF},
    {0x20, "I2SPR", 2, 0x3FF}};
constexpr TagList kTags = {  // MSTR counts with SPE
    {Spi::kCr1, 2, 1, "MSTR", 1, 1U << 6U},
    {Spi::kCr1, 10, 1, "RXONLY"},
    {Spi::kCr1, 13, 1, "CRCEN"},
    {Spi::kCr1, 15, 1, "BIDIMODE"},
    {Spi::kCr2, 0, 1, "RXDMAEN"},
    {Spi::kCr2, 1, 1, "TXDMAEN"},
    {kI2scfgr, 11, 1, "I2SMOD"}};

}  // namespace

constexpr RegisterTable Spi::kRegisters{kSpiRegisters, kTags};

// ---------------------------------------------------------------------------------------------------------- registers

std::uint32_t Spi::peek(std::uint32_t offset) const {
  const bool busy = offset == kSr && (words_[kCr1] & kSpe) != 0 && (transfers() || (words_[kSr] & kTxe) == 0);
  return words_.read(offset) | (busy ? kBsy : 0);
}

std::uint32_t Spi::read(std::uint32_t offset) {
  const std::uint32_t value = peek(offset);
  if (offset == kDr) {
    words_[kSr] &= ~kRxne;
    ovr_read_ = (words_[kSr] & kOvr) != 0;
  } else if (offset == kSr) {
    if (std::exchange(ovr_read_, false)) words_[kSr] &= ~kOvr;
    modf_read_ = (words_[kSr] & kModf) != 0;
  }
  return value;
}

void Spi::write(std::uint32_t offset, std::uint32_t value, std::uint64_t now) {
  switch (offset) {
    case kCr1: return write_control(value, now);
    case kDr:
      tx_ = static_cast<std::uint16_t>(value);
      words_[kSr] &= ~kTxe;
      return load_soon(now);
    default: words_.write(offset, value); return check_mode();
  }
}

void Spi::reset() {
  const unsigned divider = divider_;
  const bool nss = nss_;
  const std::uint64_t lost = lost_;
  *this = Spi();
  divider_ = divider;
  lost_ = lost;
  nss_ = nss;
}

void Spi::write_control(std::uint32_t value, std::uint64_t now) {
  if (std::exchange(modf_read_, false)) words_[kSr] &= ~kModf;
  words_.write(kCr1, value);
  check_mode();
  load_soon(now);
}

/// Applies the control registers and NSS: whether it is a master, and how SCK idles.
void Spi::check_mode() {
  if ((words_[kCr1] & kMstr) != 0 && nss_is_low()) {
    words_[kCr1] &= ~(kMstr | kSpe);
    words_[kSr] |= kModf;
  }
  if (!drives()) {
    edge_ = 0;  // a transfer under way is cut off
    at_ = kNever;
  }
  if (!transfers()) sck_ = (words_[kCr1] & kCpol) != 0;
}

/// With SSM the level is SSI; with SSOE NSS is an output and does not count.
bool Spi::nss_is_low() const {
  if ((words_[kCr1] & kSsm) != 0) return (words_[kCr1] & kSsi) == 0;
  return (words_[kCr1] & kSpe) != 0 && (words_[kCr2] & kSsoe) == 0 && !nss_;
}

void Spi::set_nss(bool level) {
  nss_ = level;
  check_mode();
}

bool Spi::asks() const {
  return ((words_[kCr2] & kTxeIe) != 0 && (words_[kSr] & kTxe) != 0) ||
         ((words_[kCr2] & kRxneIe) != 0 && (words_[kSr] & kRxne) != 0) ||
         ((words_[kCr2] & kErrIe) != 0 && (words_[kSr] & (kOvr | kModf)) != 0);
}

// ----------------------------------------------------------------------------------------------------------- transfer

void Spi::load_soon(std::uint64_t now) {
  if (drives() && (words_[kSr] & kTxe) == 0 && at_ == kNever) at_ = (now / divider_ + 1) * divider_;
}

/// Edge 0 is the load, 1 to twice the number of bits are SCK's; with the last one the transfer is over.
void Spi::run(bool miso) {
  if (!transfers()) return load();
  const unsigned edge = edge_++;
  sck_ = (edge % 2 == 1) != ((words_[kCr1] & kCpol) != 0);
  if (sampling(edge))
    sample(miso);
  else
    put_out();
  at_ += half_bit();
  if (edge == 2 * bits()) end();
}

/// The buffer is empty from here on (TXE), and what was in it goes out.
void Spi::load() {
  out_ = tx_;
  words_[kSr] |= kTxe;
  bit_ = sampled_ = 0;
  in_ = 0;
  edge_ = 1;
  at_ += half_bit();
  if (sampling(1)) put_out();  // CPHA = 0: before SCK's first edge
}

void Spi::end() {
  edge_ = 0;
  at_ -= half_bit();
  if ((words_[kSr] & kTxe) == 0) return load();  // without a gap
  at_ = kNever;
}

void Spi::put_out() {
  if (bit_ == bits()) return;
  const unsigned place = (words_[kCr1] & kLsbFirst) != 0 ? bit_ : bits() - 1 - bit_;
  mosi_ = (out_ >> place & 1U) != 0;
  ++bit_;
}

void Spi::sample(bool miso) {
  const unsigned place = (words_[kCr1] & kLsbFirst) != 0 ? sampled_ : bits() - 1 - sampled_;
  in_ = static_cast<std::uint16_t>(in_ | static_cast<unsigned>(miso) << place);
  if (++sampled_ == bits()) receive();
}

/// With the last sampling edge. What comes while RXNE or OVR stands is lost (overrun flag).
void Spi::receive() {
  if ((words_[kSr] & (kRxne | kOvr)) != 0) {
    words_[kSr] |= kOvr;
    ++lost_;
    return;
  }
  words_[kDr] = in_;
  words_[kSr] |= kRxne;
}

}  // namespace dsdpv1::arm
