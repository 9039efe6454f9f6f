#pragma once
#include <memory>

#include "cosim/rtl.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {

/// ChipKind::rtl() of the part.
std::unique_ptr<const RtlOf> make_rtl_of(Part part);

}  // namespace dsdpv1::cosim
