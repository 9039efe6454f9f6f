/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Faults in telegrams. */
#include "examples/firmware/bench_telegrams.h"

#include <string.h>

#include "board/firmware/mailbox.h"
#include "examples/firmware/spi_port.h"
#include "examples/firmware/stm32f103.h"
#include "examples/firmware/straps.h"
#include "examples/firmware/uart_port.h"

enum { kFaultAt = 2 }; /* the byte to disturb */

static bool (*spi_exchange)(void* ctx, const uint8_t* out, uint8_t* in, uint16_t n);
static bool (*uart_send)(void* ctx, const uint8_t* bytes, uint16_t n);
static uint8_t fault;
static uint32_t spoilt;

void bench_spoil(uint8_t which, uint32_t times) {
  fault = which;
  spoilt = times;
}

static bool is_spoilt(void) {
  if (spoilt == 0u) return false;
  --spoilt;
  return true;
}

/* `out` and `in` are the same memory. */
static bool exchange(void* ctx, const uint8_t* out, uint8_t* in, uint16_t n) {
  if (!is_spoilt()) return spi_exchange(ctx, out, in, n);
  if (fault == DSDPV1_SPOIL_BIT) {
    in[kFaultAt] ^= 0x80u;
    return spi_exchange(ctx, in, in, n);
  }
  const bool done = spi_exchange(ctx, out, in, kFaultAt);
  memset(in + kFaultAt, 0xFF, (size_t)(n - kFaultAt));
  return done;
}

/* PS selects the parity; the character before has been sent when `uart_send` returns. */
static bool send_odd(void* ctx, const uint8_t* bytes, uint16_t n) {
  USART2->CR1 |= USART_CR1_PS;
  const bool sent = uart_send(ctx, bytes, n);
  USART2->CR1 &= ~USART_CR1_PS;
  return sent;
}

static bool send(void* ctx, const uint8_t* bytes, uint16_t n) {
  if (!is_spoilt()) return uart_send(ctx, bytes, n);
  const uint8_t flipped = bytes[kFaultAt] ^ 0x01u;
  const uint8_t* one = fault == DSDPV1_SPOIL_BIT ? &flipped : bytes + kFaultAt;
  const bool parity = fault == DSDPV1_SPOIL_PARITY;
  if (!uart_send(ctx, bytes, kFaultAt)) return false;
  if (fault == DSDPV1_SPOIL_CUT) return true;
  const bool sent = parity ? send_odd(ctx, one, 1) : uart_send(ctx, one, 1);
  return sent && uart_send(ctx, bytes + kFaultAt + 1, (uint16_t)(n - kFaultAt - 1u));
}

void bench_telegrams_start(void) {
  if (straps()->mode == kModeSpi) {
    spi_exchange = spi_port()->exchange;
    spi_port()->exchange = exchange;
  } else if (straps()->mode == kModeUart) {
    uart_send = uart_port()->send;
    uart_port()->send = send;
  }
}
