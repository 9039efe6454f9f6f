#pragma once
#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

/// ChipKind::rtl() of the SPC3 family: RTL of the user's, since there is no reference RTL.
const RtlOf& spc3_rtl();

}  // namespace dsdpv1::cosim
