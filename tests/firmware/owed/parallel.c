/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The parallel port: FSMC, R_REQ and R_STA at PC6 and PC7, L_REQ and L_STA at PC8 and PC9. */
#include "faults.h"
#include "port.h"

#if PLANTED_NOT_VOLATILE
#define CELLS ((uint8_t*)0x60000000u)
#else
#define CELLS ((volatile uint8_t*)0x60000000u)
#endif

#define PORTC_LOW 0x40011000u
#define PORTC_IN 0x40011008u
#define PORTC_SET 0x40011010u
#define PORTC_CLEAR 0x40011014u
#define R_REQ (1u << 6)
#define R_STA (1u << 7)
#define LINES (3u << 8) /* L_REQ, L_STA */

static void start_fsmc(void) {
  if (!HAS(FSMC_UNCLOCKED)) WORD(0x40021014u) |= 1u << 8;
  if (!HAS(FSMC_FLOATING)) {
    WORD(0x40011400u) = 0xB4BB44BBu;                                     /* PD: D2 D3 NOE NWE NE1 */
    WORD(0x40011404u) = 0xBB444444u;                                     /* D0 D1 */
    WORD(0x40011800u) = (WORD(0x40011800u) & 0x0FFFFFFFu) | 0xB0000000u; /* PE: D4 */
    WORD(0x40011804u) = 0x44444BBBu;
    WORD(0x40011C00u) = 0x44BBBBBBu; /* PF: A0..A9 */
    WORD(0x40011C04u) = 0xBBBB4444u;
    WORD(0x40012000u) = 0x4444444Bu; /* PG: A10 */
  }
  const uint32_t control = HAS(FSMC_MULTIPLEXED) ? 0x108Bu : HAS(FSMC_WIDE) ? 0x1091u : 0x1081u;
  /* TELLS(FSMC_UNCLOCKED) */
  WORD(0xA0000004u) = 1u | 5u << 8;
  WORD(0xA0000000u) = control;
}

void port_start(void) {
  /* TELLS(GPIO_UNCLOCKED) */
  WORD(PORTC_CLEAR) = R_REQ | R_STA;
  const uint32_t pins = HAS(OPEN_DRAIN) ? 0x77u : HAS(ALTERNATE) ? 0xBBu : 0x33u;
  WORD(PORTC_LOW) = pins << 24 | 0x444444u;
  /* TELLS(DRIVES_L) */
  if (HAS(DRIVES_L)) WORD(PORTC_LOW + 4u) = 0x44444433u;
  start_fsmc();
}

static int chip_is_away(void) { return (WORD(PORTC_IN) & LINES) == 0u; }

static void wait_for_chip(void) {
  if (HAS(STA_UNLOOKED) || HAS(LOOK_EARLY)) return;
  const uint32_t since = now();
  while (now() - since < 12u) { /* 170 ns */
  }
  while (!chip_is_away() || !chip_is_away()) {
  }
}

void take(void) {
  /* TELLS(ALTERNATE) TELLS(OPEN_DRAIN) */
  WORD(PORTC_SET) = R_REQ;
  /* TELLS(LOOK_EARLY) */
  if (HAS(LOOK_EARLY)) (void)WORD(PORTC_IN);
  wait_for_chip();
  /* TELLS(STA_UNLOOKED) */
  WORD(PORTC_SET) = R_STA;
  /* TELLS(FSMC_FLOATING) TELLS(FSMC_WIDE) TELLS(FSMC_MULTIPLEXED) TELLS(NOT_VOLATILE) */
  if (!HAS(UNCOUNTED)) CELLS[0x006] = (uint8_t)(CELLS[0x006] + 1u);
}

void give_back(void) {
  WORD(PORTC_CLEAR) = R_STA;
  /* TELLS(RELEASE_EARLY) */
  if (HAS(RELEASE_EARLY)) CELLS[0x011] = CELLS[0x011];
  /* TELLS(UNCOUNTED) */
  WORD(PORTC_CLEAR) = R_REQ;
}

void read_cells(unsigned from, uint8_t* bytes, unsigned count) {
  for (unsigned i = 0; i < count; ++i) bytes[i] = CELLS[from + i];
}

void write_cells(unsigned to, const uint8_t* bytes, unsigned count) {
  /*
   * TELLS(CLEARED_UNREAD) TELLS(OUTPUTS_LATE) TELLS(LENGTH_UNREAD) TELLS(INIT_EARLY) TELLS(INIT_EACH_TURN)
   * TELLS(DIAGNOSIS_LONG) TELLS(VERDICT_ALWAYS) TELLS(C1_WRONG_SLOT) TELLS(C1_LONG) TELLS(CHIPS_FLAG)
   * TELLS(OUTPUT_CRC_UNREAD) TELLS(PRM_CRC_UNREAD) TELLS(CRC_LATE) TELLS(CRC_EXCHANGED) TELLS(INPUTS_IN_TWO)
   * TELLS(CFG_ACCEPTED) TELLS(VERDICT_CACHED) TELLS(IDENT_EXCHANGED) TELLS(ANSWER_STALE) TELLS(C2_FLAG_LOST)
   * TELLS(CRC_UNJUDGED)
   */
  for (unsigned i = 0; i < count; ++i) CELLS[to + i] = bytes[i];
}
