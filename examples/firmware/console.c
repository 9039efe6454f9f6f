/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Text on USART1. */
#include "examples/firmware/console.h"

#include "examples/firmware/board.h"
#include "examples/firmware/stm32f103.h"

enum { kBaud = 115200, kBufferSize = 512 };

static char buffer[kBufferSize];
static unsigned head, tail; /* written and sent so far, modulo the size */

/* USART1 is clocked with HCLK: 72 MHz / 115200 = 625. */
void console_start(void) {
  USART1->BRR = BOARD_HCLK_MHZ * 1000000u / kBaud;
  USART1->CR1 = USART_CR1_UE | USART_CR1_TE;
}

static void put(char character) {
  const unsigned next = (head + 1u) % kBufferSize;
  if (next != tail) {
    buffer[head] = character;
    head = next;
  }
}

void console_text(const char* text) {
  for (; *text != '\0'; ++text) put(*text);
}

void console_decimal(uint32_t value) {
  char digits[10];
  unsigned count = 0;
  do {
    digits[count++] = (char)('0' + value % 10u);
    value /= 10u;
  } while (value != 0u);
  while (count != 0u) put(digits[--count]);
}

void console_hex(uint32_t value, unsigned digits) {
  while (digits-- != 0u) put("0123456789ABCDEF"[value >> (4u * digits) & 0xFu]);
}

bool console_busy(void) { return head != tail; }

void console_poll(void) {
  if (console_busy() && (USART1->SR & USART_SR_TXE) != 0u) {
    USART1->DR = (uint8_t)buffer[tail];
    tail = (tail + 1u) % kBufferSize;
  }
}
