/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The SPI port of the DSDPV1-RSU, card 1: XSS at PA4, SPI1 at PA5 to PA7, 9 MHz. Telegrams: 000 6. */
#include "faults.h"
#include "port.h"
#include "telegram.h"

#define PORTA_LOW 0x40010800u
#define PORTA_SET 0x40010810u
#define SPI_CR1 0x40013000u
#define SPI_SR 0x40013008u
#define SPI_DR 0x4001300Cu
enum { kSpare = 3, kOwnership = 0x014 };

void port_start(void) {
  WORD(0x40021018u) |= 1u << 12; /* SPI1 */
  /* TELLS(GPIO_UNCLOCKED) */
  WORD(PORTA_SET) = 1u << 4;
  WORD(PORTA_LOW) = 0xB8B34444u;
  WORD(PORTA_SET) = 1u << 6;
  WORD(SPI_CR1) = 0x0354u; /* SSM, SSI, SPE, BR 8, MSTR */
}

static uint8_t character(uint8_t out) {
  /*
   * TELLS(CLEARED_UNREAD) TELLS(OUTPUTS_LATE) TELLS(LENGTH_UNREAD) TELLS(INIT_EARLY) TELLS(INIT_EACH_TURN)
   * TELLS(DIAGNOSIS_LONG) TELLS(VERDICT_ALWAYS) TELLS(C1_WRONG_SLOT) TELLS(C1_LONG) TELLS(CHIPS_FLAG)
   * TELLS(TELEGRAM_CRC) TELLS(CFG_ACCEPTED) TELLS(VERDICT_CACHED) TELLS(IDENT_EXCHANGED) TELLS(ANSWER_STALE)
   * TELLS(C2_FLAG_LOST) TELLS(CRC_UNJUDGED)
   */
  WORD(SPI_DR) = out;
  while ((WORD(SPI_SR) & 1u) == 0u) {
  }
  /* TELLS(OVERRUN) */
  return (uint8_t)WORD(SPI_DR);
}

/* Two bytes are sent before the first is fetched. */
static void too_late(uint8_t* bytes) {
  WORD(SPI_DR) = bytes[0];
  while ((WORD(SPI_SR) & 2u) == 0u) {
  }
  WORD(SPI_DR) = bytes[1];
  pause_us(5);
}

static void transfer(unsigned count) {
  WORD(PORTA_SET) = 1u << 20;
  unsigned first = 0;
  if (HAS(OVERRUN)) {
    too_late(frame);
    first = 2;
  }
  for (unsigned i = first; i < count; ++i) frame[i] = character(frame[i]);
  while ((WORD(SPI_SR) & 0x80u) != 0u) {
  }
  WORD(PORTA_SET) = 1u << 4;
  pause_us(3); /* 000 6.3.2: 2.7 us */
}

/* The reply begins right after the request, or up to kSpare bytes later; before it there is FF. */
static const uint8_t* exchange(unsigned request, unsigned reply) {
  for (unsigned i = 0; i < reply + kSpare; ++i) frame[request + i] = 0;
  transfer(request + reply + kSpare);
  unsigned first = request;
  while (first < request + kSpare && frame[first] == 0xFFu) ++first;
  return frame + first;
}

/* Returns 0 where the chip has the DPRAM. */
static int write_once(unsigned to, const uint8_t* bytes, unsigned count) {
  unsigned n = head(kWrite, to, count);
  for (unsigned i = 0; i < count; ++i) frame[n++] = bytes[i];
  return exchange(seal(n), 4u)[0] == (0x80u | kWrite | kAddress);
}

void take(void) {
  const uint8_t mine = 2;
  while (!write_once(kOwnership, &mine, 1)) {
  }
}

void give_back(void) {
  const uint8_t none = 0;
  (void)write_once(kOwnership, &none, 1);
}

void read_cells(unsigned from, uint8_t* bytes, unsigned count) {
  const uint8_t* reply = 0;
  do reply = exchange(seal(head(kRead, from, count)), count + 4u);
  while (!is_sealed(reply, count + 4u));
  for (unsigned i = 0; i < count; ++i) bytes[i] = reply[2u + i];
}

void write_cells(unsigned to, const uint8_t* bytes, unsigned count) { (void)write_once(to, bytes, count); }
