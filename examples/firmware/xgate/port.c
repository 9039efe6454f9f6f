/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* A device maker writes this for their MCU. */
#include "examples/firmware/xgate/port.h"

#include <stddef.h>

#include "examples/firmware/board.h"
#include "examples/firmware/stm32f103.h"

static uint64_t deadline_of(uint16_t ms) { return board_now() + board_cycles((uint64_t)ms * 1000000u); }

#ifdef XGATE_SPI

/* SPI1 at 4.5 MHz, mode 0 as the module stands; NSS by software, one byte at a time (X14). */
enum { kNssPin = 4, kSckPin, kMisoPin, kMosiPin }; /* port A */
enum { kIntPin = 6 };                              /* port G */
enum { kIdle = 0xFF };

static bool answer_begun;

static void select(bool on) {
  GPIOA->BSRR = on ? 1u << (kNssPin + 16) : 1u << kNssPin;
  board_barrier();
}

/* The last bit's clock falls half a bit after RXNE: NSS waits for it (BSY). */
static uint8_t exchange(uint8_t out) {
  select(true);
  SPI1->DR = out;
  while ((SPI1->SR & SPI_SR_RXNE) == 0u) {
  }
  const uint8_t in = (uint8_t)SPI1->DR;
  while ((SPI1->SR & SPI_SR_BSY) != 0u) {
  }
  select(false);
  return in;
}

static void send(void* context, const uint8_t* bytes, uint16_t length) {
  (void)context;
  answer_begun = false;
  for (uint16_t i = 0; i < length; ++i) (void)exchange(bytes[i]);
}

/* /INT is low while there is an answer. */
static bool wait_for_int(uint64_t deadline) {
  while ((GPIOG->IDR & 1u << kIntPin) != 0u)
    if (board_now() >= deadline) return false;
  return true;
}

static int receive(void* context, uint16_t ms) {
  (void)context;
  if (!answer_begun && !wait_for_int(deadline_of(ms))) return -1;
  const uint8_t byte = exchange(kIdle);
  answer_begun = answer_begun || byte != (uint8_t)kIdle;
  return byte;
}

void port_start(void) {
  select(false);
  board_pin(GPIOA, kNssPin, GPIO_OUTPUT_50MHZ);
  board_pin(GPIOA, kSckPin, GPIO_ALTERNATE_50MHZ);
  GPIOA->BSRR = 1u << kMisoPin; /* pulled up while it is not driven */
  board_pin(GPIOA, kMisoPin, GPIO_INPUT_PULL);
  board_pin(GPIOA, kMosiPin, GPIO_ALTERNATE_50MHZ);
  SPI1->CR1 = SPI_CR1_MSTR | SPI_CR1_SSM | SPI_CR1_SSI | SPI_CR1_BR_DIV16 | SPI_CR1_SPE;
}

#else

/* USART2, 115200 bit/s, 8 bits, no parity. */
enum { kTxPin = 2, kRxPin = 3, kBaud = 115200 }; /* port A */

static void send(void* context, const uint8_t* bytes, uint16_t length) {
  (void)context;
  for (uint16_t i = 0; i < length; ++i) {
    while ((USART2->SR & USART_SR_TXE) == 0u) {
    }
    USART2->DR = bytes[i];
  }
}

static int receive(void* context, uint16_t ms) {
  const uint64_t deadline = deadline_of(ms);
  (void)context;
  while ((USART2->SR & USART_SR_RXNE) == 0u)
    if (board_now() >= deadline) return -1;
  return (int)(USART2->DR & 0xFFu);
}

void port_start(void) {
  board_pin(GPIOA, kTxPin, GPIO_ALTERNATE_50MHZ);
  GPIOA->BSRR = 1u << kRxPin; /* pull-up */
  board_pin(GPIOA, kRxPin, GPIO_INPUT_PULL);
  USART2->BRR = (BOARD_APB1_MHZ * 1000000u + kBaud / 2u) / kBaud;
  USART2->CR1 = USART_CR1_UE | USART_CR1_TE | USART_CR1_RE;
}

#endif

const xgate_port port_stm32 = {NULL, send, receive};
