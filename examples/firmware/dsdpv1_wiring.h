/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The lines of a DSDPV1; a part of board.c. */
#include "examples/firmware/straps.h"

enum { kRReqPin = 6, kRStaPin = 7, kLReqPin = 8, kLStaPin = 9 }; /* port C */

static const card_pins cards[] = {{GPIOG, AFIO_EXTICR_PORT_G, 6, kIrqExti9To5, 4},
                                  {GPIOD, AFIO_EXTICR_PORT_D, 12, kIrqExti15To10, 5}};

static const card_pins* card(void) { return &cards[straps()->card - 1u]; }

static void hold_reset(void) { GPIOE->BRR = 1u << card()->reset; }
static void release_reset(void) { GPIOE->BSRR = 1u << card()->reset; }

/* R_REQ and R_STA are low outputs before the chip leaves its reset. L_REQ and L_STA of a missing chip read as high:
 * it never releases the DPRAM, and the driver reports that. */
static void configure_wiring(void) {
  straps_read();
  hold_reset();
  board_pin(GPIOE, card()->reset, GPIO_OUTPUT_50MHZ);
  GPIOC->BRR = 1u << kRReqPin | 1u << kRStaPin;
  configure_all(GPIOC, 1u << kRReqPin | 1u << kRStaPin, GPIO_OUTPUT_50MHZ);
  GPIOC->BSRR = 1u << kLReqPin | 1u << kLStaPin; /* pull-up */
  configure_all(GPIOC, 1u << kLReqPin | 1u << kLStaPin, GPIO_INPUT_PULL);
}

/*
 * Mode 1, asynchronous, 8 bits. Address phase (ADDSET + 1) 27.8 ns, WR low DATAST 69.4 ns followed by one HCLK, 13.9
 * ns, of hold, RD low one HCLK longer: keeps the limits of table 15 (Ts and Td 12.5 ns, Tw 31.25 ns) with margin.
 */
#define kBtr (1u << FSMC_BTR_ADDSET_SHIFT | 5u << FSMC_BTR_DATAST_SHIFT)
#define kBcr (FSMC_BCR_MBKEN | FSMC_BCR_RESERVED_7 | FSMC_BCR_WREN)
