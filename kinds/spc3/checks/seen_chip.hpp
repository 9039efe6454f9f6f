#pragma once
// The chip as its user's accesses show it: what the user has written and read, and what the answers of commands say
// about the owners of buffers.
#include <array>
#include <bitset>
#include <cstdint>
#include <optional>

#include "bus/time.hpp"
#include "model/spc3/variant.hpp"
#include "registers/spc3_regs.hpp"

namespace dsdpv1::spc3_checks {

namespace regs = spc3::regs;
using bus::Tick;
using regs::Address;

/// An access of the user CPU at the tick at which it acts; a read with its answer.
struct RegisterAccess {
  Tick at = 0;
  std::uint16_t address = 0;
  std::uint8_t value = 0;
  bool write = false;
};

constexpr std::uint8_t kMaxBlock = 244;

/// Bytes of the RAM.
struct Span {
  int begin = 0, end = 0;

  bool has(int address) const { return address >= begin && address < end; }
};

/// The events that a read of IRR or IR shows; absent: another access.
std::optional<std::uint16_t> events_in(const RegisterAccess& access);

class SeenChip {
 public:
  explicit SeenChip(spc3::Variant variant) : variant_(row(variant)) { reset(); }

  void reset();    ///< RESET; the RAM keeps its bytes (A9)
  void offline();  ///< A17, A18
  void accessed(const RegisterAccess& access);
  /// A data telegram at `at` has taken Res_User_Wd: true if it was set.
  bool takes_res_user_wd(Tick at);

  bool is_vpc3() const { return variant_.has_more_modes; }
  bool online() const { return online_; }
  bool starts(const RegisterAccess& access) const;
  int ram_end() const;
  int shift() const { return is_large() ? 4 : 3; }  ///< of a pointer
  /// As the user has written it; absent: not both bytes.
  std::optional<std::uint16_t> mode0() const;
  bool changes_cfg() const { return (mode1_ & regs::kMode1EnChangeCfg) != 0; }
  bool has_res_user_wd() const { return res_user_wd_.has_value(); }
  /// 0 without a write or read of it.
  std::uint8_t cell(int address) const { return cells_.at(inside(address)); }
  bool is_known(int address) const { return known_.test(inside(address)); }
  Span buffer(Address pointer, int length) const;
  int dout_user() const { return dout_user_; }
  int din_user() const { return din_user_; }
  int diag_user() const { return diag_user_; }     ///< 0: none
  bool has_inputs() const { return has_inputs_; }  ///< New_Din since OFFLINE

 private:
  bool is_large() const { return is_vpc3() && (mode2_ & regs::kMode2Ram4k) != 0; }
  std::size_t inside(int address) const;
  void start();
  void written(const RegisterAccess& access);
  void read(const RegisterAccess& access);
  void look_at_events(std::uint16_t events, Address address);
  void diag_is(int user);

  static constexpr int kStep = 0x400;  // A3

  const spc3::VariantRow& variant_;
  std::array<std::uint8_t, 0x1000> cells_{};
  std::bitset<0x1000> known_;
  std::array<std::optional<std::uint8_t>, 2> mode0_;
  std::uint8_t mode1_ = 0, mode2_ = 0;
  std::optional<Tick> res_user_wd_;  ///< when it was set; a data telegram takes it
  bool online_ = false;
  bool mac_reset_ = false;  ///< seen and not cleared
  int dout_user_ = 0, din_user_ = 0, diag_user_ = 0;
  int diag_next_ = 0;  ///< the one that comes after New_Diag's answer 0
  bool has_inputs_ = false;
};

}  // namespace dsdpv1::spc3_checks
