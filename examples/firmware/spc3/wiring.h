/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The lines of a chip of the SPC3 family (board.h); a part of board.c. */

enum { kNwaitPin = 6 }; /* port D */

static const card_pins the_card = {GPIOG, AFIO_EXTICR_PORT_G, 6, kIrqExti9To5, 4};

static const card_pins* card(void) { return &the_card; }

/* High-active. */
static void hold_reset(void) { GPIOE->BSRR = 1u << card()->reset; }
static void release_reset(void) { GPIOE->BRR = 1u << card()->reset; }

static void configure_wiring(void) {
  hold_reset();
  board_pin(GPIOE, card()->reset, GPIO_OUTPUT_50MHZ);
  board_pin(GPIOD, kNwaitPin, GPIO_INPUT_FLOATING);
}

#ifdef SPC3_SPI
/* The chip is at SPI1 (port.c): the memory bus stays off. */
#define kBtr 0u
#define kBcr 0u
#else
/*
 * Mode 1, asynchronous, 8 bits. The chip ends each access: XREADY, low when it is done, is at NWAIT, so NWAIT is active
 * while high. DATAST has the four HCLK that the FSMC needs to see it (RM0008 21.5.4), and one more: the XREADY of the
 * access before is over by then.
 */
#define kBtr (1u << FSMC_BTR_ADDSET_SHIFT | 5u << FSMC_BTR_DATAST_SHIFT)
#define kBcr (FSMC_BCR_MBKEN | FSMC_BCR_RESERVED_7 | FSMC_BCR_WREN | FSMC_BCR_WAITPOL | FSMC_BCR_ASYNCWAIT)
#endif
