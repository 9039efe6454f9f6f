/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef XGATE_PORT_H
#define XGATE_PORT_H
/* The line to the module: USART2 at PA2, PA3; with XGATE_SPI SPI1 at PA4 to PA7, and /INT at PG6. */
#include "driver/xgate/xgate.h"

extern const xgate_port port_stm32;

void port_start(void);

#endif /* XGATE_PORT_H */
