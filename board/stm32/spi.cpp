#include "board/stm32/spi.hpp"

#include <utility>

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kSr = 0x08, kDr = 0x0C;
constexpr std::uint32_t kRxOnly = 1U << 10U, kCrcEn = 1U << 13U, kBidi = 1U << 15U;
constexpr std::uint32_t kDma = 3U << 0U, kErrIe = 1U << 5U, kRxneIe = 1U << 6U, kTxeIe = 1U << 7U;

}  // namespace

// ---------------------------------------------------------------------------------------------------------- registers

std::uint32_t Spi::peek(std::uint32_t offset) const {
  switch (offset) {
    case kCr1: return cr1_;
    case kCr2: return cr2_;
    case kSr: return sr_ | ((cr1_ & kSpe) != 0 && (transfers() || (sr_ & kTxe) == 0) ? kBsy : 0);
    case kDr: return rx_;
    default: return 0;
  }
}

std::uint32_t Spi::read(std::uint32_t offset) {
  const std::uint32_t value = peek(offset);
  if (offset == kDr) {
    sr_ &= ~kRxne;
    ovr_read_ = (sr_ & kOvr) != 0;
  } else if (offset == kSr) {
    if (std::exchange(ovr_read_, false)) sr_ &= ~kOvr;
    modf_read_ = (sr_ & kModf) != 0;
  }
  return value;
}

void Spi::write(std::uint32_t offset, std::uint32_t value, std::uint64_t now) {
  switch (offset) {
    case kCr1: return write_control(value & 0xFFFFU, now);
    case kCr2: cr2_ = value & 0xE7U; return check_mode();
    case kDr:
      tx_ = static_cast<std::uint16_t>(value);
      sr_ &= ~kTxe;
      return load_soon(now);
    default: return;
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
  if (std::exchange(modf_read_, false)) sr_ &= ~kModf;
  cr1_ = value;
  check_mode();
  load_soon(now);
}

/// What follows from the control registers and NSS: whether it is a master, and how SCK idles.
void Spi::check_mode() {
  if ((cr1_ & kMstr) != 0 && nss_is_low()) {
    cr1_ &= ~(kMstr | kSpe);
    sr_ |= kModf;
  }
  if (!drives()) {
    edge_ = 0;  // a transfer under way is cut off
    at_ = kNever;
  }
  if (!transfers()) sck_ = (cr1_ & kCpol) != 0;
}

/// SSI in its place (SSM), nothing when NSS is an output (SSOE).
bool Spi::nss_is_low() const {
  if ((cr1_ & kSsm) != 0) return (cr1_ & kSsi) == 0;
  return (cr1_ & kSpe) != 0 && (cr2_ & kSsoe) == 0 && !nss_;
}

void Spi::set_nss(bool level) {
  nss_ = level;
  check_mode();
}

bool Spi::asks() const {
  return ((cr2_ & kTxeIe) != 0 && (sr_ & kTxe) != 0) || ((cr2_ & kRxneIe) != 0 && (sr_ & kRxne) != 0) ||
         ((cr2_ & kErrIe) != 0 && (sr_ & (kOvr | kModf)) != 0);
}

const char* Spi::missing() const {
  if ((cr1_ & kSpe) == 0) return nullptr;
  if ((cr1_ & kMstr) == 0 && (sr_ & kModf) == 0) return "slave mode (MSTR = 0)";
  if ((cr1_ & kBidi) != 0) return "BIDIMODE";
  if ((cr1_ & kRxOnly) != 0) return "RXONLY";
  if ((cr1_ & kCrcEn) != 0) return "CRCEN";
  return (cr2_ & kDma) != 0 ? "DMA" : nullptr;
}

// ----------------------------------------------------------------------------------------------------------- transfer

void Spi::load_soon(std::uint64_t now) {
  if (drives() && (sr_ & kTxe) == 0 && at_ == kNever) at_ = (now / divider_ + 1) * divider_;
}

/// Edge 0 is the load, 1 to twice the number of bits are SCK's; with the last one the transfer is over.
void Spi::run(bool miso) {
  if (!transfers()) return load();
  const unsigned edge = edge_++;
  sck_ = (edge % 2 == 1) != ((cr1_ & kCpol) != 0);
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
  sr_ |= kTxe;
  bit_ = sampled_ = 0;
  in_ = 0;
  edge_ = 1;
  at_ += half_bit();
  if (sampling(1)) put_out();  // CPHA = 0: before SCK's first edge
}

void Spi::end() {
  edge_ = 0;
  at_ -= half_bit();
  if ((sr_ & kTxe) == 0) return load();  // without a gap
  at_ = kNever;
}

void Spi::put_out() {
  if (bit_ == bits()) return;
  const unsigned place = (cr1_ & kLsbFirst) != 0 ? bit_ : bits() - 1 - bit_;
  mosi_ = (out_ >> place & 1U) != 0;
  ++bit_;
}

void Spi::sample(bool miso) {
  const unsigned place = (cr1_ & kLsbFirst) != 0 ? sampled_ : bits() - 1 - sampled_;
  in_ = static_cast<std::uint16_t>(in_ | static_cast<unsigned>(miso) << place);
  if (++sampled_ == bits()) receive();
}

/// With the last sampling edge. What comes while RXNE or OVR stands is lost (overrun flag).
void Spi::receive() {
  if ((sr_ & (kRxne | kOvr)) != 0) {
    sr_ |= kOvr;
    ++lost_;
    return;
  }
  rx_ = in_;
  sr_ |= kRxne;
}

}  // namespace dsdpv1::arm
