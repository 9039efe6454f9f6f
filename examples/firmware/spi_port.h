/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SPI_PORT_H
#define SPI_PORT_H
/*
 * The driver's SPI port: SPI1 at 9 MHz for card 1, SPI2 at 4.5 MHz for card 2, XSS by software. By polling, or with
 * BOARD_SERIAL_INTERRUPTS by interrupts. A byte is sent when the previous one has been fetched, so that no interrupt
 * can cause a loss (OVR).
 */
#include "driver/dsdpv1_spi.h"

/* For dsdpv1_open_spi; call board_start first. */
dsdpv1_spi* spi_port_start(void);
/* The same port, started. */
dsdpv1_spi* spi_port(void);

#endif /* SPI_PORT_H */
