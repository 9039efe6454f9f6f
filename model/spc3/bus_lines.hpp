#pragma once
// The inputs of the CPU's bus, and the access that their levels are (M tables 2.1 and 6.1, clause 6.3). The straps
// XINT/MOT and MODE choose one of four buses, SERIAL of a VPC3+ the fifth.
#include <array>
#include <cstddef>
#include <utility>

#include "model/spc3/config.hpp"
#include "model/spc3/pins.hpp"

namespace dsdpv1::spc3 {

/// XINT/MOT in bit 1, MODE in bit 0; SPI (A59).
enum class Bus : std::uint8_t { kIntelAsync, kIntelSync, kMotorolaAsync, kMotorolaSync, kSpi };

constexpr bool is_motorola(Bus bus) { return bus == Bus::kMotorolaAsync || bus == Bus::kMotorolaSync; }
constexpr bool is_synchronous(Bus bus) { return bus == Bus::kIntelSync || bus == Bus::kMotorolaSync; }

/// The Intel order of an address of a Motorola CPU, and back (M tables 3.2, 3.3, clause 3.3).
constexpr Address swapped(Address address) {
  return address < regs::kDinSm || (address | 1U) == regs::kOrgUserWd + 1U ? address ^ 1U : address;
}

class BusLines {
 public:
  BusLines() : levels_() {
    for (int pin = 0; pin < kPinCount; ++pin) levels_[static_cast<std::size_t>(pin)] = kPinRows[pin].level;
  }

  /// Returns false if the pin has this level already.
  bool set(Pin pin, Level level) {
    if (std::exchange(levels_[number(pin)], level) == level) return false;
    if (pin == Pin::kAle && level == 0) latched_ = this->level(Pin::kDbIn);
    return true;
  }
  Level level(Pin pin) const { return levels_[number(pin)]; }
  bool is_high(Pin pin) const { return level(pin) != 0; }

  Bus bus() const {
    if (is_high(Pin::kSerial)) return Bus::kSpi;
    return static_cast<Bus>((is_high(Pin::kXIntMot) ? 2 : 0) + (is_high(Pin::kMode) ? 1 : 0));
  }
  bool reads() const {
    return is_motorola(bus()) ? strobes() && is_high(Pin::kXRd) : selected() && !is_high(Pin::kXRd);
  }
  bool writes() const {
    return is_motorola(bus()) ? strobes() && !is_high(Pin::kXRd) : selected() && !is_high(Pin::kXWr);
  }
  /// In Intel order; below 0: lines without levels.
  Level address() const {
    const Level low = level(Pin::kAb);
    if (low < 0 || level(Pin::kAb11) < 0) return kLevelX;
    const auto high = static_cast<Level>(level(Pin::kAb11) << 11);
    if (bus() == Bus::kIntelSync) return latched_ < 0 ? kLevelX : static_cast<Level>(high | (low & 7) << 8 | latched_);
    const auto ab = static_cast<Level>(high | low);
    return is_motorola(bus()) ? static_cast<Level>(swapped(static_cast<Address>(ab))) : ab;
  }

  template <class Archive>
  void store(Archive& archive) {
    auto& [levels, latched] = *this;
    for (Level& each : levels) archive.within(kLevelX, kHighestLevel, each);
    archive.within(kLevelX, Level{0xFF}, latched);
  }

 private:
  /// Intel: XCS, or the address itself (A45), also without levels (A58). SPI: never.
  bool selected() const {
    if (is_high(Pin::kSerial)) return false;
    return bus() == Bus::kIntelSync ? level(Pin::kAb) < 8 : !is_high(Pin::kXCs);
  }
  /// Motorola.
  bool strobes() const {
    return !is_high(Pin::kXCs) && (bus() == Bus::kMotorolaSync ? is_high(Pin::kXWr) : !is_high(Pin::kAle));
  }

  std::array<Level, kPinCount> levels_;
  Level latched_ = 0;  ///< DB at the last fall of ALE
};

}  // namespace dsdpv1::spc3
