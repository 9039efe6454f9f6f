#pragma once
// The DSDPV1 as a kind of chip.
#include "tb/bench/chip_maker.hpp"

namespace tb {

const ChipMaker& dsdpv1_kind();

}  // namespace tb
