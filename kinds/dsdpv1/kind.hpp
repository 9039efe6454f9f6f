#pragma once
// The DSDPV1 and its sisters as kinds of chips.
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

const ChipKind& dsdpv1_kind();
const ChipKind& dsdpv1_r_kind();
const ChipKind& dsdpv1_rsu_kind();
/// Whether it is the DSDPV1, under whichever name: the DSDPV1-R is (R1).
bool is_dsdpv1(const ChipKind& kind);

}  // namespace dsdpv1::tb
