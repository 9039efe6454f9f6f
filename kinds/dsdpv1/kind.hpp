#pragma once
// The DSDPV1 and its sister chips as kinds of chips.
#include "model/dsdpv1/part.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

const ChipKind& kind_of(Part part);

}  // namespace dsdpv1::tb
