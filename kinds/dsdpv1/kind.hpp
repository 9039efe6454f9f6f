#pragma once
// The DSDPV1 and its sisters as kinds of chips.
#include "tb/bench/chip_maker.hpp"

namespace dsdpv1::tb {

const ChipMaker& dsdpv1_kind();
const ChipMaker& dsdpv1_r_kind();
const ChipMaker& dsdpv1_rsu_kind();
/// Whether it is the DSDPV1, under whichever name: the DSDPV1-R is (R1).
bool is_dsdpv1(const ChipMaker& kind);

}  // namespace dsdpv1::tb
