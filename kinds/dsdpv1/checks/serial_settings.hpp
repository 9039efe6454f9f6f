#pragma once
// What the checks of SPI and UART have to know of a DSDPV1-RSU.
#include "bus/baud.hpp"
#include "kinds/dsdpv1/port/serial_settings.hpp"

namespace dsdpv1::checks {

using bus::kTicksPerCycle;
using bus::Tick;
using tb::SerialSettings;

}  // namespace dsdpv1::checks
