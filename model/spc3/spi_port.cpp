#include "model/spc3/spi_port.hpp"

#include <utility>

#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

using profibus::first_edge_after;

constexpr std::uint8_t kWriteArray = 0x02, kReadArray = 0x03, kWriteByte = 0x12, kReadByte = 0x13;
constexpr std::uint8_t kRest = 0xFF;  // on MISO without data
constexpr std::uint16_t kMapEnd = 0x1000;

constexpr bool is_array(std::uint8_t instruction) { return instruction == kWriteArray || instruction == kReadArray; }

}  // namespace

void SpiPort::reset() {
  enabled_ = false;
  part_ = Part::kNone;
  miso_ = kLevelZ;
}

void SpiPort::release() {
  enabled_ = true;
  if (part_ != Part::kNone) miso_ = 1;
}

// --- frames ----------------------------------------------------------------------------------------------------------

void SpiPort::xss(Tick at, bool level, bool sck) { level ? end(at) : begin(at, sck); }

void SpiPort::begin(Tick at, bool sck) {
  const bool rest = (config_.spi_mode & 2U) != 0;
  if (sck != rest) log_.at_tick(at, Reason::kSpiRest, sck ? 1 : 0, config_.spi_mode);
  part_ = Part::kInstruction;
  bits_ = bytes_ = 0;
  out_ = kRest;
  told_ = false;
  if (enabled_) miso_ = 1;
}

void SpiPort::end(Tick at) {
  constexpr unsigned kHead = 3;
  const bool whole = part_ == Part::kEnded || part_ == Part::kIgnored || (part_ == Part::kData && bytes_ > kHead) ||
                     (part_ == Part::kInstruction && bytes_ == 0);
  if (part_ != Part::kNone && (!whole || bits_ != 0)) log_.at_tick(at, Reason::kSpiCut, bytes_, bits_);
  part_ = Part::kNone;
  miso_ = kLevelZ;
}

// A59: one edge of SCK takes MOSI, the other changes MISO.
void SpiPort::sck(Tick at, bool level, bool mosi) {
  if (part_ == Part::kNone) return;
  if (!enabled_) return ignore(at);
  const bool first = level != ((config_.spi_mode & 2U) != 0), takes_first = (config_.spi_mode & 1U) == 0;
  if (first == takes_first) return take_bit(at, mosi);
  miso_ = static_cast<Level>(out_ >> (7 - bits_) & 1);
}

// In reset.
void SpiPort::ignore(Tick at) {
  part_ = Part::kNone;
  log_.at_tick(at, Reason::kSpiInReset);
}

void SpiPort::take_bit(Tick at, bool level) {
  if (bits_ == 0) begin_byte(at);
  shift_ = static_cast<std::uint8_t>(shift_ << 1 | (level ? 1 : 0));
  if (++bits_ < 8) return;
  bits_ = 0;
  if (bytes_ < kMostBytes) ++bytes_;
  out_ = kRest;
  take_byte(at);
}

void SpiPort::take_byte(Tick at) {
  switch (part_) {
    case Part::kInstruction: return take_instruction(at);
    case Part::kAddressHigh:
      address_ = static_cast<std::uint16_t>(shift_ << 8);
      part_ = Part::kAddressLow;
      return;
    case Part::kAddressLow:
      address_ = static_cast<std::uint16_t>(address_ | shift_);
      part_ = Part::kData;
      return prepare(at);
    case Part::kData: return take_data(at);
    case Part::kEnded:
      if (!std::exchange(told_, true)) log_.at_tick(at, Reason::kSpiMore, instruction_);
      return;
    default: return;
  }
}

void SpiPort::take_instruction(Tick at) {
  instruction_ = shift_;
  part_ = Part::kAddressHigh;
  if (is_array(shift_) || shift_ == kWriteByte || shift_ == kReadByte) return;
  part_ = Part::kIgnored;
  log_.at_tick(at, Reason::kSpiInstruction, shift_);
}

// --- data ------------------------------------------------------------------------------------------------------------

void SpiPort::take_data(Tick at) {
  if (!reads()) {
    check_address(at);
    map_.write(first_edge_after(at), static_cast<Address>(address_), shift_);
  }
  if (!is_array(instruction_)) {
    part_ = Part::kEnded;
    told_ = false;
    return;
  }
  if (!reads() || config_.spi_fetch == 0) ++address_;
  prepare(at);
}

// A60: the next byte of a read. Bit 7 of a command's answer is 0, so it may act with its first bit.
void SpiPort::prepare(Tick at) {
  if (!reads()) return;
  out_ = config_.spi_fetch == 0 ? map_.peek(static_cast<Address>(address_)) : read(at);
  if (config_.spi_fetch != 0) ++address_;
}

void SpiPort::begin_byte(Tick at) {
  if (part_ != Part::kData || !reads() || config_.spi_fetch != 0) return;
  const std::uint8_t value = read(at);
  if (AddressMap::is_command(static_cast<Address>(address_ % kMapEnd))) out_ = value;
}

std::uint8_t SpiPort::read(Tick at) {
  check_address(at);
  return map_.read(first_edge_after(at), static_cast<Address>(address_));
}

void SpiPort::check_address(Tick at) {
  if (address_ < kMapEnd || std::exchange(told_, true)) return;
  log_.at_tick(at, Reason::kSpiAddress, address_, address_ % kMapEnd);
}

}  // namespace dsdpv1::spc3
