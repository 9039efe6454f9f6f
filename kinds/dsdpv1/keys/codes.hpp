#pragma once
// The codes of the chip's events, of the driver's errors and of the ARM board, with what to do about each.
#include <vector>

#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

const std::vector<CodeTable>& dsdpv1_codes();

}  // namespace dsdpv1::tb
