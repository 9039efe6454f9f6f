// Where loads and stores outside of flash and RAM go: bit-band (ARMv7-M, B3.1; Cortex-M3 reference manual, 3.7), the
// private peripheral bus (B3.2), the System.
#include <cstring>

#include "board/cpu/cortex_m3.hpp"

namespace dsdpv1::arm {

namespace {

constexpr std::uint32_t kRamAlias = 0x22000000, kPeripheralAlias = 0x42000000, kAliasBytes = 0x02000000;
constexpr std::uint32_t kAliasToBand = 0x02000000;  // the band begins this far below its alias
constexpr std::uint32_t kPrivate = 0xE0000000, kPrivateBytes = 0x00100000;

constexpr std::uint32_t kDwt = 0xE0001000, kControlSpace = 0xE000E000, kPage = 0x1000;
// Offsets in the system control space.
constexpr std::uint32_t kIctr = 0x004, kSysTickFirst = 0x010, kSysTickEnd = 0x020, kNvicFirst = 0x100, kNvicEnd = 0xD00,
                        kStir = 0xF00;
constexpr std::uint32_t kInterruptBits = 0x1FF;
constexpr std::uint32_t kInterruptLines = (Nvic::kInterrupts - 1) / 32;

bool within(std::uint32_t address, std::uint32_t start, std::uint32_t size) { return address - start < size; }
bool bit_band(std::uint32_t address) {
  return within(address, kRamAlias, kAliasBytes) || within(address, kPeripheralAlias, kAliasBytes);
}

// The bit that a word of the alias stands for, found as an access of the same width meets it.
struct BandBit {
  std::uint32_t address;
  unsigned bit;
};
BandBit band_bit(std::uint32_t alias, unsigned bytes) {
  const std::uint32_t start = (alias & ~(kAliasBytes - 1)) - kAliasToBand;
  const std::uint32_t offset = alias & (kAliasBytes - 1);
  const std::uint32_t byte = start + offset / 32;
  return {byte & ~(bytes - 1), offset / 4 % 8 + 8 * (byte & (bytes - 1))};
}

std::uint32_t mask_of(unsigned bytes) { return bytes == 4 ? ~0U : (1U << 8 * bytes) - 1; }

}  // namespace

std::uint32_t CortexM3::load_outside(std::uint32_t address, unsigned bytes) {
  if (within(address, kPrivate, kPrivateBytes)) return load_private(address, bytes);
  return bit_band(address) ? load_bit(address, bytes) : system_.load(address, bytes);
}

void CortexM3::store_outside(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (within(address, kPrivate, kPrivateBytes))
    store_private(address, bytes, value);
  else if (bit_band(address))
    store_bit(address, bytes, (value & 1U) != 0);
  else
    system_.store(address, bytes, value);
}

std::uint32_t CortexM3::load_band(std::uint32_t address, unsigned bytes) {
  if (address >= kPeripheralAlias - kAliasToBand) return system_.load(address, bytes);
  if (!in_ram(address, bytes)) {
    bus_error();
    return 0;
  }
  std::uint32_t value = 0;
  std::memcpy(&value, ram_ + (address - map_.ram_base), bytes);
  return value;
}

void CortexM3::store_band(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (address >= kPeripheralAlias - kAliasToBand)
    system_.store(address, bytes, value);
  else if (in_ram(address, bytes))
    std::memcpy(ram_ + (address - map_.ram_base), &value, bytes);
}

std::uint32_t CortexM3::load_bit(std::uint32_t alias, unsigned bytes) {
  const BandBit at = band_bit(alias, bytes);
  return load_band(at.address, bytes) >> at.bit & 1U;
}

void CortexM3::store_bit(std::uint32_t alias, unsigned bytes, bool value) {
  const BandBit at = band_bit(alias, bytes);
  const std::uint32_t others = load_band(at.address, bytes) & ~(1U << at.bit);
  if (!engine_.access_failed()) store_band(at.address, bytes, others | (value ? 1U : 0U) << at.bit);
}

// The system control space is for privileged code (B3.2.1).
std::uint32_t CortexM3::load_private(std::uint32_t address, unsigned bytes) {
  if (!engine_.privileged()) {
    bus_error();
    return 0;
  }
  const unsigned shift = 8 * (address & 3U);
  if (within(address, kControlSpace, kPage))
    return load_control_word((address - kControlSpace) & ~3U) >> shift & mask_of(bytes);
  if (within(address, kDwt, kPage)) return scb_.load_dwt((address - kDwt) & ~3U, cycles()) >> shift & mask_of(bytes);
  return system_.load(address, bytes);
}

void CortexM3::store_private(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (!engine_.privileged()) {
    bus_error();
    return;
  }
  const unsigned shift = 8 * (address & 3U);
  if (within(address, kControlSpace, kPage)) {
    store_control_word((address - kControlSpace) & ~3U, value << shift, mask_of(bytes) << shift);
    attend_soon();  // whatever was written may let an exception in
  } else if (within(address, kDwt, kPage)) {
    scb_.store_dwt((address - kDwt) & ~3U, value << shift, cycles());
  } else {
    system_.store(address, bytes, value);
  }
}

std::uint32_t CortexM3::load_control_word(std::uint32_t offset) {
  if (offset >= kSysTickFirst && offset < kSysTickEnd) {
    catch_up_systick();
    return systick_.load(offset, cycles());
  }
  if (offset >= kNvicFirst && offset < kNvicEnd) return nvic_.load(offset);
  return offset == kIctr ? kInterruptLines : scb_.load(offset, nvic_, handler());
}

void CortexM3::store_control_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  if (offset >= kSysTickFirst && offset < kSysTickEnd) {
    catch_up_systick();
    systick_.store(offset, value, cycles());
  } else if (offset >= kNvicFirst && offset < kNvicEnd) {
    nvic_.store(offset, value, lanes);
  } else if (offset == kStir) {
    if ((value & kInterruptBits) < Nvic::kInterrupts) set_interrupt(value & kInterruptBits);
  } else {
    scb_.store(offset, value, lanes, nvic_);
    reset_requested_ = scb_.take_reset_request() || reset_requested_;
  }
}

}  // namespace dsdpv1::arm
