/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The UART port of the DSDPV1-RSU: USART2 at PA2 and PA3, 1.8 MBd. Telegrams: 000 7. No ownership. */
#include "faults.h"
#include "port.h"
#include "telegram.h"

#define PORTA_LOW 0x40010800u
#define PORTA_SET 0x40010810u
#define USART_SR 0x40004400u
#define USART_DR 0x40004404u
#define USART_BRR 0x40004408u
#define USART_CR1 0x4000440Cu
enum { kSwap = 0x40, kSwapHead = 5 };

static uint8_t last_inputs[3]; /* length 0 at first */

void port_start(void) {
  WORD(0x4002101Cu) |= 1u << 17; /* USART2 */
  /* TELLS(GPIO_UNCLOCKED) */
  WORD(PORTA_SET) = 1u << 3;
  WORD(PORTA_LOW) = 0x44448B44u;
  WORD(USART_BRR) = 20;
  WORD(USART_CR1) = 0x340C; /* UE, M, PCE, TE, RE */
}

void take(void) {}
void give_back(void) {}

static void send(unsigned count) {
  pause_us(2); /* the stop bit of the last reply */
  for (unsigned i = 0; i < count; ++i) {
    while ((WORD(USART_SR) & 0x80u) == 0u) {
    }
    /*
     * TELLS(TELEGRAM_CRC) TELLS(CHIPS_FLAG) TELLS(DIAGNOSIS_LONG) TELLS(C1_WRONG_SLOT) TELLS(C1_LONG)
     * TELLS(INIT_EARLY) TELLS(INIT_EACH_TURN) TELLS(VERDICT_ALWAYS) TELLS(CFG_ACCEPTED) TELLS(VERDICT_CACHED)
     * TELLS(IDENT_EXCHANGED)
     */
    WORD(USART_DR) = frame[i];
  }
  while ((WORD(USART_SR) & 0x40u) == 0u) {
  }
}

/* Up to `most` characters; 100 us without one end it. */
static unsigned receive(uint8_t* to, unsigned most) {
  unsigned count = 0;
  for (uint32_t since = now(); count < most && now() - since < 72u * 100u;) {
    if ((WORD(USART_SR) & 0x20u) == 0u) continue;
    if (HAS(OVERRUN) && count == 1u) pause_us(20);
    /* TELLS(OVERRUN) */
    to[count++] = (uint8_t)WORD(USART_DR);
    since = now();
  }
  return count;
}

void read_cells(unsigned from, uint8_t* bytes, unsigned count) {
  do send(seal(head(kRead, from, count)));
  while (!is_sealed(frame, receive(frame, count + 4u)));
  for (unsigned i = 0; i < count; ++i) bytes[i] = frame[2u + i];
}

void write_cells(unsigned to, const uint8_t* bytes, unsigned count) {
  do {
    unsigned n = head(kWrite, to, count);
    for (unsigned i = 0; i < count; ++i) frame[n++] = bytes[i];
    send(seal(n));
  } while (!is_sealed(frame, receive(frame, 4u)));
}

/* Function bytes of the reply to inputs (000 7.1.6): what came with it, whose flag is clear now. */
enum { kC1Came = 0x04, kC2Came = 0x08, kPrmCame = 0x10, kCfgCame = 0x20 };

static int exchange_once(unsigned address, const uint8_t* bytes, unsigned count) {
  const uint8_t begin[kSwapHead] = {kSwap | kAddress, address == 0x227u ? 2 : 0, (uint8_t)(address >> 8),
                                    (uint8_t)address, (uint8_t)count};
  unsigned n = 0;
  for (; n < kSwapHead; ++n) frame[n] = begin[n];
  for (unsigned i = 0; i < count; ++i) frame[n++] = bytes[i];
  send(seal(n));
  if (receive(frame, kSwapHead) < kSwapHead) return 0;
  return is_sealed(frame, kSwapHead + receive(frame + kSwapHead, frame[4] + 2u));
}

static uint8_t noted[2]; /* flags of B00E and B00F that a reply has cleared, and whose block is not fetched yet */

/* A lost reply to inputs may have had any news in it, parameters and configuration only after INTR0. */
static uint8_t exchange(unsigned address, const uint8_t* bytes, unsigned count) {
  while (!exchange_once(address, bytes, count)) {
    if (address != 0x130u) continue;
    if (intr0_fell) noted[0] |= 6;
    noted[1] |= 3;
  }
  return frame[1];
}

static void note(uint8_t function) {
  if ((function & kPrmCame) != 0u) noted[0] |= 2;
  if ((function & kCfgCame) != 0u) noted[0] |= 4;
  if ((function & kC1Came) != 0u && !HAS(REQUEST_DROPPED)) noted[1] |= 1;
  if ((function & kC2Came) != 0u) noted[1] |= 2;
}

uint8_t news(unsigned command) { return (uint8_t)(cell(command) | noted[command - 0x00Eu]); }

/* Flags of the chip fall with the reply that brings their block: inputs are exchanged until it comes. */
unsigned fetch(const struct area* from, uint8_t* bytes) {
  read_cells(from->begin, bytes, from->head);
  const unsigned length = from->head + (from->head < 4u ? bytes[from->head - 1u] : 0u);
  if (length > from->head) read_cells(from->begin + from->head, bytes + from->head, length - from->head);
  const int right = (from->begin == 0x410u && HAS(PRM_CRC_UNREAD)) || read_crc(from->crc) == crc16(bytes, length);
  while ((cell(from->command) & from->flag) != 0u) note(exchange(0x130, last_inputs, 1u + last_inputs[0]));
  noted[from->command - 0x00Eu] &= (uint8_t)~from->flag;
  return right ? length : 0u;
}

void post(const struct area* to, const uint8_t* bytes, unsigned count) { (void)exchange(to->begin, bytes, count); }

void swap(const uint8_t* inputs, unsigned count, uint8_t* outputs, int wants_outputs) {
  if (inputs != 0)
    for (unsigned i = 0; i < count; ++i) last_inputs[i] = inputs[i];
  if (!wants_outputs && inputs == 0) return;
  note(exchange(0x130, last_inputs, count));
  if (noted[0] != 0u) intr0_fell = 1;
  for (unsigned i = 0; i < frame[4]; ++i) outputs[i] = frame[kSwapHead + i];
}
