#pragma once
// The internal signals of a chip of the SPC3 family, shown in waves beside the pins: its machines, in words.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bus/time.hpp"
#include "model/spc3/chip.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/chip/chip_view.hpp"

namespace dsdpv1::tb {

/// Compares the registers after each of the chip's rising edges and reports changes.
class Spc3Inside {
 public:
  static const std::vector<InnerSignal>& signals();
  /// Reports in the order of `signals()`; `number`: of the chip.
  void look(bus::Tick at, const spc3::Chip& chip, std::size_t number, ChipListener& listener);

 private:
  std::array<std::uint8_t, 9> last_{};  ///< the registers
  std::vector<std::string> told_;
};

}  // namespace dsdpv1::tb
