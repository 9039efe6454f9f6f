#pragma once
// The DSDPV1 as a kind of chip.
#include "tb/bench/chip_maker.hpp"

namespace dsdpv1::tb {

const ChipMaker& dsdpv1_kind();

}  // namespace dsdpv1::tb
