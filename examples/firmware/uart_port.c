/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Characters over USART2. */
#include "examples/firmware/uart_port.h"

#include "examples/firmware/board.h"
#include "examples/firmware/interrupts.h"
#include "examples/firmware/port.h"
#include "examples/firmware/straps.h"

enum { kTxPin = 2, kRxPin = 3 }; /* port A */

static const uint32_t rates[] = {9600u, 19200u, 38400u, 57600u, 115200u, 230400u, 460800u, 1843200u}; /* UBR */

/* SR, read before DR, describes the character in DR. Returns whether it is right; counts one that was lost before
 * it. */
static bool fetch(uint32_t status, uint8_t* to) {
  *to = (uint8_t)USART2->DR;
  if ((status & USART_SR_ORE) != 0u) port_note_lost();
  return (status & (USART_SR_PE | USART_SR_FE)) == 0u;
}

#ifdef BOARD_SERIAL_INTERRUPTS

enum { kBufferSize = 512 }; /* more than the longest telegram */

static volatile uint8_t received[kBufferSize];
static volatile uint16_t head, tail; /* put in and taken out so far, modulo the size */
static const uint8_t* volatile next_out;
static volatile uint16_t left;
static volatile bool sending;

static void take_in(uint32_t status) {
  uint8_t character = 0;
  if (!fetch(status, &character)) return;
  received[head] = character;
  head = (uint16_t)((head + 1u) % kBufferSize);
}

/* TXEIE requests the next character; after the last one TCIE waits for its end. */
static void give_out(void) {
  if (left != 0u) {
    USART2->DR = *next_out++;
    if (--left == 0u) USART2->CR1 = (USART2->CR1 & ~USART_CR1_TXEIE) | USART_CR1_TCIE;
  } else {
    USART2->CR1 &= ~USART_CR1_TCIE;
    sending = false;
  }
}

void usart2_handler(void) {
  const uint32_t status = USART2->SR;
  const uint32_t enabled = USART2->CR1;
  if ((status & (USART_SR_RXNE | USART_SR_ORE)) != 0u) take_in(status);
  if ((status & enabled & (USART_SR_TXE | USART_SR_TC)) != 0u)
    give_out(); /* the enable bits have the same positions as the flags */
}

static bool send(void* ctx, const uint8_t* bytes, uint16_t n) {
  (void)ctx;
  next_out = bytes;
  left = n;
  sending = true;
  USART2->CR1 |= USART_CR1_TXEIE;
  while (sending) {
  }
  return true;
}

static bool next_character(uint8_t* to) {
  if (tail == head) return false;
  *to = received[tail];
  tail = (uint16_t)((tail + 1u) % kBufferSize);
  return true;
}

/* TIM2 ends the wait for the first character, TIM3 that for the next one: after 3.5 characters. */
static volatile bool over;

static void expire(timer_registers* timer) {
  if ((timer->SR & TIM_SR_UIF) == 0u) return; /* it was reset meanwhile */
  timer->SR = ~TIM_SR_UIF;
  over = true;
}

void tim2_handler(void) { expire(TIM2); }
void tim3_handler(void) { expire(TIM3); }

static void stop_timers(void) {
  RCC->APB1RSTR |= RCC_APB1_TIM2 | RCC_APB1_TIM3;
  RCC->APB1RSTR &= ~(RCC_APB1_TIM2 | RCC_APB1_TIM3);
}

/* Their clock is twice PCLK1. UG loads PSC, and sets UIF. */
static void start_timer(timer_registers* timer, uint32_t steps, uint32_t us_of_step) {
  stop_timers();
  over = false;
  timer->PSC = us_of_step * 2u * BOARD_APB1_MHZ - 1u;
  timer->ARR = steps; /* with 0 it stands still */
  timer->EGR = TIM_EGR_UG;
  timer->SR = 0;
  timer->DIER = TIM_DIER_UIE;
  timer->CR1 = TIM_CR1_OPM | TIM_CR1_CEN;
}

static uint16_t receive(void* ctx, uint8_t* bytes, uint16_t n, uint32_t timeout_us) {
  (void)ctx;
  const uint32_t silence_us = 38500000u / uart_port()->baud + 1u; /* a character has 11 bits */
  uint16_t count = 0;
  start_timer(TIM2, timeout_us / 10u + 1u, 10);
  while (count < n && !over)
    if (next_character(&bytes[count])) {
      ++count;
      start_timer(TIM3, silence_us, 1);
    }
  stop_timers();
  return count;
}

static void prepare(void) {
  RCC->APB1ENR |= RCC_APB1_TIM2 | RCC_APB1_TIM3;
  board_enable_serial(kIrqTim2);
  board_enable_serial(kIrqTim3);
  USART2->CR1 |= USART_CR1_RXNEIE;
  board_enable_serial(kIrqUsart2);
}

#else

#ifdef DSDPV1_PLANTED_LATE_READ

/* A deliberate mistake for the tests of the bench: waits longer than two characters at 1.8432 Mbit/s before fetching
 * the first of them. */
static void dawdle(void) {
  enum { kDawdle = 1000 };
  const uint32_t since = DWT->CYCCNT;
  while (DWT->CYCCNT - since < (uint32_t)kDawdle) {
  }
}

#else

static void dawdle(void) {}

#endif

static bool send(void* ctx, const uint8_t* bytes, uint16_t n) {
  (void)ctx;
  for (uint16_t i = 0; i < n; ++i) {
    while ((USART2->SR & USART_SR_TXE) == 0u) {
    }
    USART2->DR = bytes[i];
  }
  while ((USART2->SR & USART_SR_TC) == 0u) {
  }
  return true;
}

static bool next_character(uint8_t* to) {
  if ((USART2->SR & USART_SR_RXNE) == 0u) return false;
  dawdle();
  return fetch(USART2->SR, to);
}

static uint16_t receive(void* ctx, uint8_t* bytes, uint16_t n, uint32_t timeout_us) {
  (void)ctx;
  uint16_t count = 0;
  for (uint32_t since = DWT->CYCCNT; count < n && DWT->CYCCNT - since < timeout_us * BOARD_HCLK_MHZ;)
    if (next_character(&bytes[count])) {
      ++count;
      since = DWT->CYCCNT;
    }
  return count;
}

static void prepare(void) {}
void usart2_handler(void) {} /* not enabled */

#endif

/* Half characters by the code of UIV (ruling UA3). */
static const uint16_t intervals[] = {7, 2, 4, 10, 20, 40, 100, 200};

static dsdpv1_uart port = {.send = send, .receive = receive, .pause = port_pause};

dsdpv1_uart* uart_port(void) { return &port; }

dsdpv1_uart* uart_port_start(void) {
  port.address = straps()->address;
  port.baud = rates[straps()->rate];
  port.interval = intervals[straps()->interval];
  board_pin(GPIOA, kTxPin, GPIO_ALTERNATE_50MHZ);
  GPIOA->BSRR = 1u << kRxPin; /* pull-up */
  board_pin(GPIOA, kRxPin, GPIO_INPUT_PULL);
  USART2->BRR = (BOARD_APB1_MHZ * 1000000u + port.baud / 2u) / port.baud;
  USART2->CR1 = USART_CR1_UE | USART_CR1_M | USART_CR1_PCE | USART_CR1_TE | USART_CR1_RE;
  prepare();
  return &port;
}
