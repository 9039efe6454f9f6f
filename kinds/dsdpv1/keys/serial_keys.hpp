#pragma once
// Keys of a user CPU at a DSDPV1-RSU: its ends of SPI and UART.
#include "kinds/dsdpv1/keys/settings.hpp"

namespace dsdpv1::tb {

/// `spi` and `uart` of `user_cpu`.
void add_serial_ports(keys::ObjectOf<Dsdpv1User>& user);

}  // namespace dsdpv1::tb
