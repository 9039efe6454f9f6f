#pragma once
// The bench's table of pins, those of table 1 and of the DSDPV1-RSU: the number of a pin is its enumerator in
// dsdpv1::Pin.
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::tb {

const PinTable& pins_of(Part part);
inline const PinTable& dsdpv1_pins() { return pins_of({}); }
/// In the order for waveform viewers.
const std::vector<PinGroup>& pin_groups_of(Part part);

}  // namespace dsdpv1::tb
