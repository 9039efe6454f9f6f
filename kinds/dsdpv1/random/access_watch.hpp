#pragma once
// The user's last access and the chip's, as the pins show them.
#include <array>
#include <string>

#include "kinds/dsdpv1/port/last_access.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {

/// A level in words: "1", "3F", "Z", "X".
std::string level_text(Pin pin, Level level);

class AccessWatch {
 public:
  AccessWatch();
  /// A pin has a new level; in order of time. D is what the user drives.
  void change(Tick at, Pin pin, Level to);
  /// When the chip's last access began, -1: there was none yet.
  Tick chip_access_start() const { return chip_start_; }
  std::string user_text() const { return user_.words(); }
  std::string chip_text() const;

 private:
  Level& level(Pin pin) { return levels_.at(static_cast<std::size_t>(pin)); }

  std::array<Level, dsdpv1::kRsuPinCount> levels_{};
  tb::LastAccess user_;
  Tick chip_start_ = -1, chip_end_ = -1;
};

}  // namespace dsdpv1::cosim
