/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* A device maker writes this for their MCU. */
#include "examples/firmware/spc3/port.h"

#include <stddef.h>

#include "examples/firmware/board.h"
#include "examples/firmware/spc3/planted.h"
#include "examples/firmware/stm32f103.h"

#ifdef SPC3_SPI

/* SPI1 at 4.5 MHz, XSS by software. A frame keeps interrupts away: the handler of X/INT has frames, too. */
enum { kXssPin = 4, kSckPin, kMisoPin, kMosiPin }; /* port A */
enum { kWriteArray = 0x02, kReadArray = 0x03, kWriteByte = 0x12, kReadByte = 0x13 };

static void select(bool on) {
  GPIOA->BSRR = on ? 1u << (kXssPin + 16) : 1u << kXssPin;
  board_barrier();
}

static uint8_t exchange(uint8_t out) {
  SPI1->DR = out;
  while ((SPI1->SR & SPI_SR_RXNE) == 0u) {
  }
  return (uint8_t)SPI1->DR;
}

static uint32_t begin(uint8_t instruction, uint16_t address) {
  const uint32_t before = board_lock();
  select(true);
  (void)exchange(instruction);
  (void)exchange((uint8_t)(address >> 8));
  (void)exchange((uint8_t)(address & 0xFFu));
  return before;
}

/* The last bit's clock falls half a bit after RXNE: XSS waits for it (BSY). */
static void end(uint32_t before) {
  while ((SPI1->SR & SPI_SR_BSY) != 0u) {
  }
  select(false);
  board_unlock(before);
}

static uint8_t port_read(void* ctx, uint16_t address) {
  (void)ctx;
  const uint32_t before = begin(kReadByte, address);
  const uint8_t value = exchange(0);
  end(before);
  return value;
}

static void port_write(void* ctx, uint16_t address, uint8_t value) {
  (void)ctx;
  if (!planted_write(address, &value)) return;
  const uint32_t before = begin(kWriteByte, address);
  (void)exchange(value);
  end(before);
}

static void port_read_array(void* ctx, uint16_t address, uint8_t* bytes, uint8_t length) {
  (void)ctx;
  const uint32_t before = begin(kReadArray, address);
  for (uint8_t i = 0; i < length; ++i) bytes[i] = exchange(0);
  end(before);
}

static void port_write_array(void* ctx, uint16_t address, const uint8_t* bytes, uint8_t length) {
  (void)ctx;
  const uint32_t before = begin(kWriteArray, address);
  for (uint8_t i = 0; i < length; ++i) (void)exchange(bytes[i]);
  end(before);
}

void port_start(void) {
  select(false);
  board_pin(GPIOA, kXssPin, GPIO_OUTPUT_50MHZ);
  board_pin(GPIOA, kSckPin, GPIO_ALTERNATE_50MHZ);
  GPIOA->BSRR = 1u << kMisoPin; /* MISO is pulled up while it is not driven */
  board_pin(GPIOA, kMisoPin, GPIO_INPUT_PULL);
  board_pin(GPIOA, kMosiPin, GPIO_ALTERNATE_50MHZ);
  SPI1->CR1 = SPI_CR1_MSTR | SPI_CR1_SSM | SPI_CR1_SSI | SPI_CR1_BR_DIV16 | SPI_CR1_SPE;
}

const spc3_port port_stm32 = {NULL, port_read, port_write, port_read_array, port_write_array};

#else

static volatile uint8_t* cell(uint16_t address) { return (volatile uint8_t*)(FSMC_BANK1_NE1 + address); }

static uint8_t port_read(void* ctx, uint16_t address) {
  (void)ctx;
  return *cell(address);
}

static void port_write(void* ctx, uint16_t address, uint8_t value) {
  (void)ctx;
  if (planted_write(address, &value)) *cell(address) = value;
}

const spc3_port port_stm32 = {NULL, port_read, port_write, NULL, NULL};

void port_start(void) {}

#endif
