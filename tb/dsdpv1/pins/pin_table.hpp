#pragma once
// Table 1 as the bench has it: the number of a pin is its enumerator in dsdpv1::Pin.
#include "model/dsdpv1/pins.hpp"
#include "tb/pins/pins.hpp"

namespace tb {

const PinTable& dsdpv1_pins();

}  // namespace tb
