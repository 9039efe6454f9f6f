/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SPC3_PORT_H
#define SPC3_PORT_H
/* The driver's port: a byte of the chip at the memory bus; with SPC3_SPI bytes and arrays of a VPC3+S over SPI1. */
#include "driver/spc3/spc3.h"

/* After board_start. */
void port_start(void);
extern const spc3_port port_stm32;

#endif /* SPC3_PORT_H */
