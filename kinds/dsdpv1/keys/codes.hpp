#pragma once
// The codes of the chip's events, of the driver's errors and of the ARM board, each with its advice.
#include <vector>

#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

const std::vector<CodeTable>& dsdpv1_codes();

}  // namespace dsdpv1::tb
