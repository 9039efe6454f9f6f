/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef UART_PORT_H
#define UART_PORT_H
/*
 * The driver's UART port: USART2 at the rate of the straps, 8 data bits, even parity. By polling, or with
 * BOARD_SERIAL_INTERRUPTS by interrupts, which fill a buffer.
 */
#include "driver/dsdpv1_uart.h"

/* For dsdpv1_open_uart; call board_start first. */
dsdpv1_uart* uart_port_start(void);
/* The same port, started. */
dsdpv1_uart* uart_port(void);

#endif /* UART_PORT_H */
