#pragma once
// The DSDPV1 and its sisters as kinds of chips.
#include "model/dsdpv1/part.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

const ChipKind& kind_of(Part part);
/// Its part. Throws InputError, which begins with `what`: it is a kind of another chip.
Part part_of(const ChipKind& kind, const char* what);

}  // namespace dsdpv1::tb
