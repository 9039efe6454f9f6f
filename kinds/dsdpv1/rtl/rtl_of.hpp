#pragma once
#include "cosim/rtl.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {

/// ChipKind::rtl() of the part.
const RtlOf& rtl_of(Part part);

}  // namespace dsdpv1::cosim
