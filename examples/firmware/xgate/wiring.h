/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The lines of an XGate-DPS10 (board.h); a part of board.c. Its UART is at USART2, its SPI at SPI1: port.c. */

static const card_pins the_card = {GPIOG, AFIO_EXTICR_PORT_G, 6, kIrqExti9To5, 4};

static const card_pins* card(void) { return &the_card; }

/* Low-active. */
static void hold_reset(void) { GPIOE->BRR = 1u << card()->reset; }
static void release_reset(void) { GPIOE->BSRR = 1u << card()->reset; }

static void configure_wiring(void) {
  hold_reset();
  board_pin(GPIOE, card()->reset, GPIO_OUTPUT_50MHZ);
}

/* The memory bus stays off. */
#define kBtr 0u
#define kBcr 0u
