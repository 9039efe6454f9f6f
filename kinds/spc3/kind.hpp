#pragma once
// The SPC3 family as kinds of chips: apc3, spc3 and vpc3 (docs/spc3.md).
#include "model/spc3/variant.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

const ChipKind& kind_of(spc3::Variant variant);

}  // namespace dsdpv1::tb
