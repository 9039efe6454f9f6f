/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Frames over SPI. */
#include "examples/firmware/spi_port.h"

#include "examples/firmware/board.h"
#include "examples/firmware/interrupts.h"
#include "examples/firmware/port.h"
#include "examples/firmware/straps.h"

typedef struct wiring {
  spi_registers* spi;
  gpio_registers* port;
  unsigned xss; /* SCK, MISO and MOSI are the next pins */
  unsigned irq;
} wiring;

static const wiring cards[] = {{SPI1, GPIOA, 4, kIrqSpi1}, {SPI2, GPIOB, 12, kIrqSpi2}};
static const wiring* card;

static void select(bool on) {
  card->port->BSRR = on ? 1u << (card->xss + 16u) : 1u << card->xss;
  board_barrier();
}

#ifdef BOARD_SERIAL_INTERRUPTS

/* The frame in progress: owned by the handler from its begin until `left` is 0. */
static const uint8_t* volatile next_out;
static uint8_t* volatile next_in;
static volatile uint16_t left;

void spi_handler(void) {
  *next_in++ = (uint8_t)card->spi->DR;
  const uint16_t rest = --left;
  if (rest != 0u) card->spi->DR = *next_out++;
}

static bool transfer(const uint8_t* out, uint8_t* in, uint16_t n) {
  next_out = out + 1;
  next_in = in;
  left = n;
  card->spi->DR = out[0];
  while (left != 0u) {
  }
  return true;
}

static void prepare(void) {
  card->spi->CR2 = SPI_CR2_RXNEIE;
  board_enable_serial(card->irq);
}

#elif defined DSDPV1_PLANTED_LATE_READ

/*
 * A deliberate mistake for the tests of the bench: the next byte is sent before the last one has been fetched, and
 * then something takes longer than a byte. It works at a slower clock, and only OVR shows it.
 */
enum { kDawdle = 150 }; /* cycles; a byte has 64 at 9 MHz */

static bool fetch(uint8_t* to) {
  while ((card->spi->SR & (SPI_SR_RXNE | SPI_SR_OVR)) == 0u) {
  }
  const uint32_t since = DWT->CYCCNT;
  while (DWT->CYCCNT - since < (uint32_t)kDawdle) {
  }
  *to = (uint8_t)card->spi->DR;
  if ((card->spi->SR & SPI_SR_OVR) == 0u) return true; /* reading it after DR clears it */
  port_note_lost();
  return false;
}

static bool transfer(const uint8_t* out, uint8_t* in, uint16_t n) {
  card->spi->DR = out[0];
  for (uint16_t i = 0; i < n; ++i) {
    while ((card->spi->SR & SPI_SR_TXE) == 0u) {
    }
    if (i + 1u < n) card->spi->DR = out[i + 1u];
    if (!fetch(&in[i])) return false;
  }
  return true;
}

static void prepare(void) {}
void spi_handler(void) {}

#else

static bool transfer(const uint8_t* out, uint8_t* in, uint16_t n) {
  for (uint16_t i = 0; i < n; ++i) {
    card->spi->DR = out[i];
    while ((card->spi->SR & SPI_SR_RXNE) == 0u) {
    }
    in[i] = (uint8_t)card->spi->DR;
  }
  return true;
}

static void prepare(void) {}
void spi_handler(void) {} /* not enabled */

#endif

/* The last bit's clock falls half a bit after RXNE: wait with XSS for it (BSY). */
static bool frame(void* ctx, const uint8_t* out, uint8_t* in, uint16_t n) {
  (void)ctx;
  select(true);
  const bool done = transfer(out, in, n);
  while ((card->spi->SR & SPI_SR_BSY) != 0u) {
  }
  select(false);
  return done;
}

/* A card's time until its reply is not specified: two bytes, as in the vendor's firmware. */
static dsdpv1_spi port = {.exchange = frame, .pause = port_pause, .spare = 2};

dsdpv1_spi* spi_port(void) { return &port; }

dsdpv1_spi* spi_port_start(void) {
  card = &cards[straps()->card - 1u];
  select(false);
  board_pin(card->port, card->xss, GPIO_OUTPUT_50MHZ);
  board_pin(card->port, card->xss + 1u, GPIO_ALTERNATE_50MHZ);
  card->port->BSRR = 1u << (card->xss + 2u); /* MISO is pulled up while it is not driven */
  board_pin(card->port, card->xss + 2u, GPIO_INPUT_PULL);
  board_pin(card->port, card->xss + 3u, GPIO_ALTERNATE_50MHZ);
  card->spi->CR1 = SPI_CR1_MSTR | SPI_CR1_SSM | SPI_CR1_SSI | SPI_CR1_BR_DIV8 | SPI_CR1_SPE;
  prepare();
  port.address = straps()->address;
  return &port;
}
