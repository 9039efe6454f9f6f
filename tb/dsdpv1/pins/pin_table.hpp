#pragma once
// Table 1 as the bench has it: the number of a pin is its enumerator in dsdpv1::Pin.
#include "model/dsdpv1/pins.hpp"
#include "tb/pins/pins.hpp"

namespace dsdpv1::tb {

const PinTable& dsdpv1_pins();
/// In the order in which viewers of waves show them.
const std::vector<PinGroup>& dsdpv1_pin_groups();

}  // namespace dsdpv1::tb
