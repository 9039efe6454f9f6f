#pragma once
// The mode registers (M 4.1) and the two numbers beside them, as the user has written them.
#include "model/profibus/time.hpp"
#include "model/spc3/config.hpp"

namespace dsdpv1::spc3 {

struct ModeRegisters {
  std::uint16_t mode0 = 0;
  std::uint8_t mode1 = 0;  ///< the bits that stay: En_Change_Cfg, Res_User_Wd, Go_Offline until it is carried out
  std::uint8_t mode2 = regs::kMode2GcEach, mode3 = 0;
  std::uint8_t wd_baud_control = 0x1E, min_tsdr = 0;  ///< 0: MinTSDR is not written yet

  bool has0(std::uint16_t bits) const { return (mode0 & bits) != 0; }
  bool has1(std::uint8_t bits) const { return (mode1 & bits) != 0; }
  bool has2(std::uint8_t bits) const { return (mode2 & bits) != 0; }
  void set_mode0(bool high, std::uint8_t value) {
    mode0 = static_cast<std::uint16_t>(high ? (mode0 & 0x00FF) | value << 8 : (mode0 & 0xFF00) | value);
  }
  void set1(std::uint8_t bits) { mode1 = static_cast<std::uint8_t>(mode1 | bits); }
  void clear1(std::uint8_t bits) { mode1 = static_cast<std::uint8_t>(mode1 & ~bits); }

  /// A31.
  profibus::Cycle baud_control(const Config& config) const {
    constexpr profibus::Cycle kUnit = 10 * profibus::kCyclesPerMs;
    if (wd_baud_control == 0) return profibus::kNever;
    return kUnit * wd_baud_control * (config.baud_control == 0 ? wd_baud_control : 1);
  }
  /// A33: at RESET and at each begin of the search, in bit times.
  int default_min_tsdr(const Config& config) const {
    return has0(regs::kMode0Combi) ? static_cast<int>(config.tsdr_combi) : 11;
  }
  /// A13.
  profibus::Cycle eoi_gap(const Config& config) const {
    constexpr profibus::Cycle kMicrosecond = 48;
    return has0(regs::kMode0EoiTimeBase) ? profibus::Cycle{config.eoi_1ms} : kMicrosecond;
  }

  template <class Archive>
  void store(Archive& archive) {
    auto& [first, second, third, fourth, baud, tsdr] = *this;
    archive(first, second, third, fourth, baud, tsdr);
  }
};

}  // namespace dsdpv1::spc3
