/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef BOARD_H
#define BOARD_H
/*
 * The evaluation board: STM32F103ZE, crystal 8 MHz, HCLK 72 MHz.
 *
 *   PC6  out  R_REQ            PD14 PD15 PD0 PD1 PE7..PE10         D0..D7
 *   PC7  out  R_STA            PF0..PF5 PF12..PF15 PG0             A0..A10
 *   PC8  in   L_REQ            PD4 NOE -> RD, PD5 NWE -> WR, PD7 NE1 -> CSR
 *   PC9  in   L_STA            PG6  in   INTR0, falling edge, EXTI line 6
 *   PE4  out  RESET, low       PA9  USART1 TX;  PA0 in, key, high when pressed
 *
 * The same with a chip of the SPC3 family (BOARD_WIRING is spc3/wiring.h), without a handshake:
 *
 *   PD6  in   XREADY at NWAIT  PD4 NOE -> XRD, PD5 NWE -> XWR, PD7 NE1 -> XCS
 *   PE4  out  RESET, high      PG6 in  X/INT;  PG12 in XDATAEXCH
 *
 * With a DSDPV1-RSU, whose straps select the live port (straps.h):
 *
 *   PA4..PA7    XSS (output), SCK, MISO, MOSI of SPI1         PA2, PA3  TX, RX of USART2: the chip's RXD, TXD
 *   PB12..PB15  the same of SPI2: card 2, whose RESET and INTR0 are PE5 and PD12, EXTI line 12
 */
#include <stdbool.h>
#include <stdint.h>

#include "examples/firmware/stm32f103.h"

#define BOARD_HCLK_MHZ 72u

/* Starts clocks, memory bus, pins, SysTick, serial line. Afterwards the chip is held in reset and INTR0 is ignored. */
void board_start(void);

#define BOARD_APB1_MHZ 36u

/* Sets HCLK to 72 MHz: call it first after a reset, which leaves 8 MHz. Uses no variable. */
void board_start_clocks(void);

/* Ends RESET of the chip. A DSDPV1 works after 4096 of its cycles, 85 us (ruling D1); an SPC3 after two. */
void board_release_chip(void);

/* Stops after a fatal error: interrupts disabled, the chip back in reset, so that the master sees the station gone. */
void board_halt(void) __attribute__((noreturn));

/* Configures a pin: GPIO_ values of stm32f103.h. */
void board_pin(gpio_registers* port, unsigned pin, uint32_t function);

/* True while the key is pressed. */
bool board_key(void);

/* ------------------------------------------------------------------------------------------------------------- time */

/* HCLK cycles since board_start, without overflow. May be called from any context. */
uint64_t board_now(void);
/* Nanoseconds in cycles, rounded up. */
uint64_t board_cycles(uint64_t ns);
/* Waits at least so many cycles; interrupts are served meanwhile, and their time counts. */
void board_wait(uint64_t cycles);
/*
 * Sleeps at most until then. Interrupts end the sleep, even one just before it, and so does an external event: the
 * caller checks whether there is work.
 */
void board_sleep(uint64_t until);

/* ------------------------------------------------------------------------------------------------------- interrupts */

/* INTR0 is the chip's interrupt, of an SPC3 X/INT. Sets the function called from its handler. Drops earlier falls and
 * receives later ones. */
void board_on_intr0(void (*handler)(void));
/* Disables or enables the INTR0 handler; an INTR0 meanwhile is served when enabled. */
void board_enable_intr0(bool enabled);

/* Enables the interrupt of a serial port, with a higher priority than INTR0, whose handler uses the port. */
void board_enable_serial(unsigned irq);

/* Disables all interrupts; returns the argument for board_unlock. */
uint32_t board_lock(void);
void board_unlock(uint32_t before);

/* Completes all writes so far before anything that follows. */
static inline void board_barrier(void) { __asm__ volatile("dsb" ::: "memory"); }

#endif /* BOARD_H */
