/* Firmware for the tests of the board's serial ports: one program for each way in which firmware uses them. The test
 * selects it with the word `program`. Results go to the chip's DPRAM, where the test reads them. */
#include <stdint.h>

#include "memory_bus.h"

enum {
  AFIO_MAPR = 0x40010004,
  AFIO_EXTICR2 = 0x4001000C,
  AFIO_EXTICR4 = 0x40010014,
  EXTI_IMR = 0x40010400,
  EXTI_EMR = 0x40010404,
  EXTI_RTSR = 0x40010408,
  EXTI_FTSR = 0x4001040C,
  EXTI_PR = 0x40010414,
  GPIOA_CRL = 0x40010800,
  GPIOA_IDR = 0x40010808,
  GPIOA_BSRR = 0x40010810,
  GPIOB_CRL = 0x40010C00,
  GPIOB_CRH = 0x40010C04,
  GPIOB_BSRR = 0x40010C10,
  GPIOD_IDR = 0x40011408,
  GPIOE_BSRR = 0x40011810,
  RCC_CFGR = 0x40021004,
  RCC_APB2RSTR = 0x4002100C,
  RCC_AHBENR = 0x40021014,
  RCC_APB2ENR = 0x40021018,
  RCC_APB1ENR = 0x4002101C,
  SPI1 = 0x40013000,
  SPI2 = 0x40003800,
  USART2 = 0x40004400
};
enum { CR1 = 0x00, CR2 = 0x04, SR = 0x08, DR = 0x0C }; /* of an SPI */
enum { USART_SR = 0x00, USART_DR = 0x04, USART_BRR = 0x08, USART_CR1 = 0x0C, USART_CR3 = 0x14 };
enum { RXNE = 1, TXE = 2, OVR = 0x40, BSY = 0x80 };
#define NVIC_ISER1 0xE000E104u

const volatile uint32_t program __attribute__((used)) = 0;
static volatile uint32_t heard;

static void clocks(void) {
  REG(RCC_APB2ENR) = 0x11FD;
  REG(RCC_APB1ENR) = 1u << 14 | 1u << 17;
  REG(RCC_AHBENR) |= 1u << 8;
  REG(RCC_CFGR) = 4u << 8; /* PCLK1 is half of HCLK */
}

/* XSS an output, high; SCK, MOSI alternate functions, MISO an input. */
static void pins_of_spi1(void) {
  REG(GPIOA_BSRR) = 1u << 4;
  REG(GPIOA_CRL) = 0xB4B34444;
}
static void pins_of_spi2(void) {
  REG(GPIOB_BSRR) = 1u << 12;
  REG(GPIOB_CRH) = 0xB4B34444;
}

static void wait(uint32_t address, uint32_t flags) {
  while ((REG(address) & flags) == 0) {
  }
}
static void wait_while(uint32_t address, uint32_t flags) {
  while ((REG(address) & flags) != 0) {
  }
}

static void frame(uint32_t spi) {
  REG(spi + CR1) = 0x0354; /* SSM, SSI, SPE, BR 8, MSTR */
  REG(spi == SPI1 ? GPIOA_BSRR : GPIOB_BSRR) = spi == SPI1 ? 1u << 20 : 1u << 28;
  REG(spi + DR) = 0x9A;
  wait(spi + SR, RXNE);
  CHIP(0) = (uint8_t)REG(spi + DR);
  wait_while(spi + SR, BSY);
  REG(spi == SPI1 ? GPIOA_BSRR : GPIOB_BSRR) = spi == SPI1 ? 1u << 4 : 1u << 12;
}

static void spi1(void) {
  pins_of_spi1();
  frame(SPI1);
}

static void spi2(void) {
  pins_of_spi2();
  frame(SPI2);
}

/* Three bytes, of which the first is not fetched before the last has arrived. */
static void overrun(void) {
  pins_of_spi1();
  REG(SPI1 + CR1) = 0x0354;
  for (int i = 0; i < 3; ++i) {
    wait(SPI1 + SR, TXE);
    REG(SPI1 + DR) = 0;
  }
  wait_while(SPI1 + SR, BSY);
  CHIP(0) = (uint8_t)REG(SPI1 + SR);
  CHIP(1) = (uint8_t)REG(SPI1 + DR);
  CHIP(2) = (uint8_t)REG(SPI1 + SR);
  CHIP(3) = (uint8_t)REG(SPI1 + SR);
}

static void spi_by_interrupt(void) {
  pins_of_spi1();
  REG(SPI1 + CR1) = 0x0354;
  REG(SPI1 + CR2) = 1u << 6;
  REG(NVIC_ISER1) = 1u << 3;
  REG(SPI1 + DR) = 0;
  for (;;) {
    __asm volatile("wfi");
    CHIP(8) = (uint8_t)heard;
  }
}

static void uart(void) {
  REG(GPIOA_CRL) = 0x44444BB4; /* TX, RTS */
  REG(USART2 + USART_BRR) = 20;
  REG(USART2 + USART_CR3) = 1u << 8;
  REG(USART2 + USART_CR1) = 0x340C | 1u << 5; /* UE, M, PCE, TE, RE, RXNEIE */
  REG(NVIC_ISER1) = 1u << 6;
  CHIP(4) = (uint8_t)(REG(GPIOA_IDR) & 0xEu);
  REG(USART2 + USART_DR) = 0x31;
  for (;;) {
    __asm volatile("wfi");
    CHIP(8) = (uint8_t)heard;
  }
}

/* A character that arrives before the previous one was fetched. */
static void uart_overrun(void) {
  REG(USART2 + USART_BRR) = 20;
  REG(USART2 + USART_CR1) = 0x340C;
  wait(USART2 + USART_SR, 1u << 3); /* ORE */
  CHIP(0) = (uint8_t)REG(USART2 + USART_SR);
  CHIP(1) = (uint8_t)REG(USART2 + USART_DR);
  CHIP(2) = (uint8_t)REG(USART2 + USART_SR);
}

/* PB5 is its own event: WFE ends with it. */
static void own_event(void) {
  REG(AFIO_EXTICR2) = 1u << 4;
  REG(EXTI_EMR) = 1u << 5;
  REG(EXTI_RTSR) = 1u << 5;
  REG(GPIOB_CRL) = 0x44344444;
  REG(GPIOB_BSRR) = 1u << 5;
  CHIP(0) = (uint8_t)REG(EXTI_PR);
  __asm volatile("wfe");
  CHIP(1) = 1;
  REG(GPIOB_BSRR) = 1u << 21; /* the fall does not count */
  __asm volatile("wfe");
  CHIP(2) = 1;
}

/* INTR0 and RESET of card 2. */
static void card2(void) {
  REG(GPIOE_CRL) = 0xB4144444;
  REG(GPIOE_BSRR) = 1u << 21;
  for (volatile int i = 0; i < 100; ++i) {
  }
  REG(GPIOE_BSRR) = 1u << 5;
  REG(AFIO_EXTICR4) = 3u;
  REG(EXTI_FTSR) = 1u << 12;
  REG(EXTI_IMR) = 1u << 12;
  REG(NVIC_ISER1) = 1u << 8;
  CHIP(0) = (uint8_t)(REG(GPIOD_IDR) >> 12 & 1u);
  __asm volatile("wfi");
  CHIP(1) = (uint8_t)(REG(GPIOD_IDR) >> 12 & 1u);
}

/* Two bits over SPI without SPI. */
static void by_hand(void) {
  REG(GPIOA_BSRR) = 1u << 4;
  REG(GPIOA_CRL) = 0x34334444;
  REG(GPIOA_BSRR) = 1u << 20;
  for (int i = 0; i < 2; ++i) {
    REG(GPIOA_BSRR) = 1u << (i == 0 ? 7 : 23);
    REG(GPIOA_BSRR) = 1u << 5;
    CHIP(i) = (uint8_t)(REG(GPIOA_IDR) >> 6 & 1u);
    REG(GPIOA_BSRR) = 1u << 21;
  }
  REG(GPIOA_BSRR) = 1u << 4;
}

/* Features that the board does not have or support. */
static void misused(void) {
  REG(SPI1 + CR1) = 0x0354 | 1u << 10; /* RXONLY */
  REG(RCC_APB2ENR) = 0xFD;
  REG(SPI1 + CR1) = 0; /* clock off */
  REG(RCC_APB2ENR) = 0x11FD;
  CHIP(1) = (uint8_t)REG(SPI1 + CR1);
  REG(USART2 + USART_CR3) = 1u << 3;
  REG(USART2 + USART_CR1) = 0x2000;
  REG(RCC_APB2RSTR) = 1u << 12;
  CHIP(0) = (uint8_t)REG(SPI1 + CR1);
  REG(RCC_APB2RSTR) = 0;
}

/* SPI1 on its other pins: those of the card do not change. */
static void remapped(void) {
  REG(AFIO_MAPR) = 1;
  spi1();
}

/* Two bytes back to back, four times; then SR right after the store of one more. */
static void quick(void) {
  pins_of_spi1();
  REG(SPI1 + CR1) = 0x0354;
  for (int i = 0; i < 4; ++i) {
    REG(SPI1 + DR) = 0x55;
    REG(SPI1 + DR) = 0x0F;
    wait_while(SPI1 + SR, BSY);
  }
  REG(SPI1 + DR) = 0;
  const uint32_t status = REG(SPI1 + SR);
  CHIP(0) = (uint8_t)status;
}

/* Neither asleep nor at a register when the interrupt comes. */
static void busy(void) {
  pins_of_spi1();
  REG(SPI1 + CR1) = 0x0354;
  REG(SPI1 + CR2) = 1u << 6;
  REG(NVIC_ISER1) = 1u << 3;
  REG(SPI1 + DR) = 0;
  while (heard == 0) {
  }
  CHIP(8) = 1;
}

static void unset_uart(void) {
  REG(USART2 + USART_BRR) = 20;
  REG(USART2 + USART_CR1) = 0x340C;
  REG(USART2 + USART_DR) = 0x31;
}

void SPI1_handler(void);
void SPI1_handler(void) {
  CHIP(0) = (uint8_t)REG(SPI1 + DR);
  ++heard;
}

void USART2_handler(void);
void USART2_handler(void) {
  CHIP(0) = (uint8_t)REG(USART2 + USART_SR);
  CHIP(5) = (uint8_t)(REG(GPIOA_IDR) & 0xEu);
  CHIP(1) = (uint8_t)REG(USART2 + USART_DR);
  ++heard;
}

void EXTI15_10_handler(void);
void EXTI15_10_handler(void) { REG(EXTI_PR) = 1u << 12; }

void run(void);
void run(void) {
  static void (*const programs[])(void) = {spi1,  spi2,    overrun, spi_by_interrupt, uart,  uart_overrun, own_event,
                                           card2, by_hand, misused, remapped,         quick, busy,         unset_uart};
  heard = 0;
  clocks();
  memory_bus();
  programs[program]();
  for (;;) __asm volatile("wfi");
}

/* Initial stack pointer, reset and IRQs 35, 38, 40 (ARMv7-M B1.5.3). */
extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[16 + 41] = {
    [0] = stack_top,
    [1] = (const void*)run,
    [16 + 35] = (const void*)SPI1_handler,
    [16 + 38] = (const void*)USART2_handler,
    [16 + 40] = (const void*)EXTI15_10_handler};
