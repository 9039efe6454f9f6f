#pragma once
// The internal signals of a DSDPV1, shown in waves beside the pins.
#include <array>
#include <string>
#include <vector>

#include "bus/time.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/chip/chip_view.hpp"

namespace dsdpv1::tb {

/// Compares a chip's state after each of its rising edges and reports changes.
class InsideWatch {
 public:
  static const std::vector<InnerSignal>& signals();
  /// Reports in the order of `signals()`; `number`: of the chip.
  void look(bus::Tick at, const dsdpv1::Chip& chip, std::size_t number, ChipListener& listener);

 private:
  /// The source of the signals; cheap to compare, because that happens in every cycle.
  struct Seen {
    dsdpv1::Inside inside;
    bool chip_owns = false, user_owns = false, offline = false;
    std::array<std::uint8_t, 4> flags{};  ///< B00E, B00F, B010, B011
  };
  static Seen see(const dsdpv1::Chip& chip);
  static bool same(const Seen& a, const Seen& b);
  struct Value {
    Level level = kLevelZ;
    std::string word;
  };
  static std::vector<Value> values(const Seen& seen);

  Seen last_;
  std::vector<Value> told_;
};

}  // namespace dsdpv1::tb
