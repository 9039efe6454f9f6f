#pragma once
// Settings of a DSDPV1-RSU that the checks of SPI and UART need.
#include "bus/baud.hpp"
#include "kinds/dsdpv1/port/serial_settings.hpp"

namespace dsdpv1::checks {

using bus::kTicksPerCycle;
using bus::Tick;
using tb::SerialSettings;

}  // namespace dsdpv1::checks
