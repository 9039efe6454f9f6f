/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef INTERRUPTS_H
#define INTERRUPTS_H
/* The handlers that the vector table (startup.c) points to. */

void reset_handler(void);
/* Every millisecond (board.c). */
void systick_handler(void);
/* EXTI lines 5 to 9 and 10 to 15, of which only INTR0's, line 6 or 12, is enabled (board.c). */
void exti9_5_handler(void);
void exti15_10_handler(void);
/* A byte was received over SPI (spi_port.c). */
void spi_handler(void);
/* A character was received or sent (uart_port.c). */
void usart2_handler(void);
/* The wait for a character is over (uart_port.c). */
void tim2_handler(void);
void tim3_handler(void);

#endif /* INTERRUPTS_H */
