#pragma once
// Diag_Buffer_SM: two buffers, the user's and the chip's, and Diag_Flag (M 5.2.4; A18, A19). While the chip sends its
// buffer an exchange waits.
#include <cstdint>
#include <utility>

namespace dsdpv1::spc3 {

class DiagBuffers {
 public:
  void reset() { *this = DiagBuffers(); }

  /// New_Diag_Cmd. True: exchange() now; false: it is remembered.
  bool request() {
    requested_ = sending_;
    return !sending_;
  }
  /// The user's buffer becomes the chip's, and is to be sent; `flags`: bits 2..0 of its byte 0.
  void exchange(std::uint8_t flags) {
    user_ = chips();
    flags_ = flags & 7U;
    flag_ = true;
    requested_ = false;
  }
  /// The answer that has the chip's buffer; `ends_flag`: it is read by whom Diag_Flag waits for (A51).
  void send(bool ends_flag) {
    sending_ = true;
    ends_flag_ = ends_flag;
  }
  bool sending() const { return sending_; }
  /// That answer is over. True if an exchange has waited for it.
  bool sent() {
    sending_ = false;
    if (std::exchange(ends_flag_, false) && !stat_diag()) flag_ = false;
    return requested_;
  }

  std::uint8_t user() const { return user_; }                                   ///< 1 or 2
  std::uint8_t chips() const { return static_cast<std::uint8_t>(3U - user_); }  ///< the other one
  bool ext_diag() const { return (flags_ & 1U) != 0; }
  bool stat_diag() const { return (flags_ & 2U) != 0; }
  bool overflow() const { return (flags_ & 4U) != 0; }
  bool flag() const { return flag_; }
  /// The register's byte.
  std::uint8_t code() const {
    constexpr unsigned kUser = 1, kChip = 2, kSends = 3;
    const unsigned of_user = requested_ ? kChip : kUser, of_chip = sending_ ? kSends : kChip;
    return static_cast<std::uint8_t>(user_ == 1 ? of_user | of_chip << 2 : of_chip | of_user << 2);
  }

  template <class Archive>
  void store(Archive& archive) {
    auto& [user, flags, flag, sending, requested, ends_flag] = *this;
    archive.within(1, 2, user);
    archive.within(0, 7, flags);
    archive(flag, sending, requested, ends_flag);
  }

 private:
  std::uint8_t user_ = 1, flags_ = 0;
  bool flag_ = false, sending_ = false, requested_ = false, ends_flag_ = false;
};

}  // namespace dsdpv1::spc3
