#pragma once
// User_Watchdog_Timer (M 5.2.5.3; A34): counts data telegrams, not time, that pass without Res_User_Wd.
#include <cstdint>

namespace dsdpv1::spc3 {

class UserWatchdog {
 public:
  void reset() { *this = UserWatchdog(); }

  void restart(unsigned value) { count_ = static_cast<std::uint16_t>(value); }
  /// A data telegram. Returns true if the count ends; 0 counts 65536.
  bool count() { return --count_ == 0; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [count] = *this;
    archive(count);
  }

 private:
  std::uint16_t count_ = 0;
};

}  // namespace dsdpv1::spc3
