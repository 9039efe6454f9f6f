#pragma once
// Accesses of the user and of the chip to the DPRAM, derived from the pins.
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "cosim/rtl.hpp"
#include "kinds/dsdpv1/port/last_access.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {

class AccessWatch : public MemoryWatch {
 public:
  explicit AccessWatch(Part part);
  /// D is the user's level.
  void change(Tick at, PinNumber changed, Level to) override;
  std::optional<Tick> take_end() override { return std::exchange(end_, std::nullopt); }
  bool worth_a_look(Tick end) override;
  void compared(Tick end) override;
  std::string last_of_user() const override { return user_.words(); }
  std::string last_of_chip() const override;

 private:
  Level& level(Pin pin) { return levels_.at(number(pin)); }
  void serial_change(Tick at, Pin pin);

  const Part part_;
  std::array<Level, dsdpv1::kRsuPinCount> levels_{};
  tb::LastAccess user_;
  Tick chip_start_ = -1, chip_end_ = -1;
  std::optional<Tick> end_;
  Tick last_write_ = -1;
  Tick image_at_ = 0;       ///< with a serial port
  bool serial_ = false;     ///< the live port
  bool user_wrote_ = true;  ///< since the DPRAM was compared
  unsigned unseen_ = 0;     ///< accesses without effect
};

}  // namespace dsdpv1::cosim
