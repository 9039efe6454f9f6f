/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STM32F103_H
#define STM32F103_H
/*
 * The registers of the STM32F103xE that this firmware uses, named as in ST's reference manual RM0008, and those of
 * the Cortex-M3 core, named as in ARM's architecture manual. Only those in use: add bits when needed.
 */
#include <stdint.h>

typedef volatile uint32_t reg32;

/* ------------------------------------------------------------------------------------------------------------- core */

typedef struct {
  reg32 CTRL, LOAD, VAL, CALIB;
} systick_registers;
#define SYST ((systick_registers*)0xE000E010u)
#define SYST_CTRL_ENABLE (1u << 0)
#define SYST_CTRL_TICKINT (1u << 1)
#define SYST_CTRL_CLKSOURCE (1u << 2) /* HCLK, not HCLK / 8 */

typedef struct {
  reg32 ISER[32], ICER[32], ISPR[32], ICPR[32], IABR[64];
  volatile uint8_t IPR[240];
} nvic_registers;
#define NVIC ((nvic_registers*)0xE000E100u)

typedef struct {
  reg32 CPUID, ICSR, VTOR, AIRCR, SCR, CCR;
  volatile uint8_t SHPR[12];
  reg32 SHCSR, CFSR, HFSR;
} scb_registers;
#define SCB ((scb_registers*)0xE000ED00u)
#define SCB_CCR_DIV_0_TRP (1u << 4)
#define SCB_SHPR_SYSTICK 11u /* SHPR3, bits 31:24 */

typedef struct {
  reg32 CTRL, CYCCNT;
} dwt_registers;
#define DWT ((dwt_registers*)0xE0001000u)
#define DWT_CTRL_CYCCNTENA (1u << 0)

#define DEMCR (*(reg32*)0xE000EDFCu)
#define DEMCR_TRCENA (1u << 24)

#define DBGMCU_CR (*(reg32*)0xE0042004u)
#define DBGMCU_CR_DBG_SLEEP (1u << 0) /* HCLK continues in sleep, and with it CYCCNT */

/* --------------------------------------------------------------------------------------------- reset and clock control
 */

typedef struct {
  reg32 CR, CFGR, CIR, APB2RSTR, APB1RSTR, AHBENR, APB2ENR, APB1ENR, BDCR, CSR;
} rcc_registers;
#define RCC ((rcc_registers*)0x40021000u)
#define RCC_CR_HSEON (1u << 16)
#define RCC_CR_HSERDY (1u << 17)
#define RCC_CR_PLLON (1u << 24)
#define RCC_CR_PLLRDY (1u << 25)
#define RCC_CFGR_SW (3u << 0)
#define RCC_CFGR_SW_PLL (2u << 0)
#define RCC_CFGR_SWS (3u << 2)
#define RCC_CFGR_SWS_PLL (2u << 2)
#define RCC_CFGR_PPRE1_DIV2 (4u << 8)
#define RCC_CFGR_PLLSRC_HSE (1u << 16)
#define RCC_CFGR_PLLMUL9 (7u << 18)
#define RCC_AHBENR_SRAMEN (1u << 2)
#define RCC_AHBENR_FLITFEN (1u << 4)
#define RCC_AHBENR_FSMCEN (1u << 8)
#define RCC_APB2ENR_AFIOEN (1u << 0)
#define RCC_APB2ENR_IOPAEN (1u << 2)
#define RCC_APB2ENR_IOPBEN (1u << 3)
#define RCC_APB2ENR_IOPCEN (1u << 4)
#define RCC_APB2ENR_IOPDEN (1u << 5)
#define RCC_APB2ENR_IOPEEN (1u << 6)
#define RCC_APB2ENR_IOPFEN (1u << 7)
#define RCC_APB2ENR_IOPGEN (1u << 8)
#define RCC_APB2ENR_SPI1EN (1u << 12)
#define RCC_APB2ENR_USART1EN (1u << 14)
#define RCC_APB1_TIM2 (1u << 0) /* in APB1ENR and in APB1RSTR */
#define RCC_APB1_TIM3 (1u << 1)
#define RCC_APB1ENR_SPI2EN (1u << 14)
#define RCC_APB1ENR_USART2EN (1u << 17)

#define FLASH_ACR (*(reg32*)0x40022000u)
#define FLASH_ACR_LATENCY_2 (2u << 0) /* 48 MHz < SYSCLK <= 72 MHz */
#define FLASH_ACR_PRFTBE (1u << 4)

/* --------------------------------------------------------------------------------------------------------------- pins
 */

typedef struct {
  reg32 CRL, CRH, IDR, ODR, BSRR, BRR, LCKR;
} gpio_registers;
#define GPIOA ((gpio_registers*)0x40010800u)
#define GPIOB ((gpio_registers*)0x40010C00u)
#define GPIOC ((gpio_registers*)0x40011000u)
#define GPIOD ((gpio_registers*)0x40011400u)
#define GPIOE ((gpio_registers*)0x40011800u)
#define GPIOF ((gpio_registers*)0x40011C00u)
#define GPIOG ((gpio_registers*)0x40012000u)

/* Four bits for each pin in CRL (0..7) and CRH (8..15). */
#define GPIO_INPUT_FLOATING 0x4u
#define GPIO_INPUT_PULL 0x8u      /* up when ODR is 1, down when it is 0 */
#define GPIO_OUTPUT_50MHZ 0x3u    /* push-pull */
#define GPIO_ALTERNATE_50MHZ 0xBu /* push-pull */

typedef struct {
  reg32 EVCR, MAPR, EXTICR[4];
} afio_registers;
#define AFIO ((afio_registers*)0x40010000u)
/* Four bits for each line in EXTICR[line / 4]: the port, A is 0. */
#define AFIO_EXTICR_PORT_D 0x3u
#define AFIO_EXTICR_PORT_G 0x6u

typedef struct {
  reg32 IMR, EMR, RTSR, FTSR, SWIER, PR;
} exti_registers;
#define EXTI ((exti_registers*)0x40010400u)

/* -------------------------------------------------------------------------------------------------------- memory bus
 */

/* Bank 1, chip selects NE1 to NE4: control and timing of each. */
typedef struct {
  struct {
    reg32 BCR, BTR;
  } NE[4];
} fsmc_bank1_registers;
#define FSMC_BANK1 ((fsmc_bank1_registers*)0xA0000000u)
#define FSMC_BANK1_NE1 0x60000000u
#define FSMC_BCR_MBKEN (1u << 0)
#define FSMC_BCR_RESERVED_7 (1u << 7) /* always 1 */
#define FSMC_BCR_WAITPOL (1u << 9)    /* NWAIT is active while high */
#define FSMC_BCR_WREN (1u << 12)      /* bits 0 for SRAM, width 8 */
#define FSMC_BCR_ASYNCWAIT (1u << 15)
#define FSMC_BTR_ADDSET_SHIFT 0u
#define FSMC_BTR_DATAST_SHIFT 8u
#define FSMC_BTR_BUSTURN_SHIFT 16u

/* ------------------------------------------------------------------------------------------------------------- serial
 */

typedef struct {
  reg32 SR, DR, BRR, CR1, CR2, CR3, GTPR;
} usart_registers;
#define USART1 ((usart_registers*)0x40013800u)
#define USART2 ((usart_registers*)0x40004400u)
#define USART_SR_PE (1u << 0)
#define USART_SR_FE (1u << 1)
#define USART_SR_ORE (1u << 3)
#define USART_SR_RXNE (1u << 5)
#define USART_SR_TC (1u << 6)
#define USART_SR_TXE (1u << 7)
#define USART_CR1_RE (1u << 2)
#define USART_CR1_TE (1u << 3)
#define USART_CR1_RXNEIE (1u << 5)
#define USART_CR1_TCIE (1u << 6)
#define USART_CR1_TXEIE (1u << 7)
#define USART_CR1_PS (1u << 9) /* odd */
#define USART_CR1_PCE (1u << 10)
#define USART_CR1_M (1u << 12) /* 9 bits, including the parity */
#define USART_CR1_UE (1u << 13)

typedef struct {
  reg32 CR1, CR2, SR, DR, CRCPR, RXCRCR, TXCRCR, I2SCFGR, I2SPR;
} spi_registers;
#define SPI1 ((spi_registers*)0x40013000u)
#define SPI2 ((spi_registers*)0x40003800u)
#define SPI_CR1_MSTR (1u << 2)
#define SPI_CR1_BR_DIV8 (2u << 3)
#define SPI_CR1_BR_DIV16 (3u << 3)
#define SPI_CR1_SPE (1u << 6)
#define SPI_CR1_SSI (1u << 8)
#define SPI_CR1_SSM (1u << 9)
#define SPI_CR2_RXNEIE (1u << 6)
#define SPI_SR_RXNE (1u << 0)
#define SPI_SR_TXE (1u << 1)
#define SPI_SR_OVR (1u << 6)
#define SPI_SR_BSY (1u << 7)

/* ------------------------------------------------------------------------------------------------------------- timers
 */

typedef struct {
  reg32 CR1, CR2, SMCR, DIER, SR, EGR, CCMR[2], CCER, CNT, PSC, ARR;
} timer_registers;
#define TIM2 ((timer_registers*)0x40000000u)
#define TIM3 ((timer_registers*)0x40000400u)
#define TIM_CR1_CEN (1u << 0)
#define TIM_CR1_OPM (1u << 3)
#define TIM_DIER_UIE (1u << 0)
#define TIM_SR_UIF (1u << 0)
#define TIM_EGR_UG (1u << 0)

/* --------------------------------------------------------------------------------------------------------- interrupts
 */

enum {
  kIrqExti9To5 = 23,
  kIrqTim2 = 28,
  kIrqTim3,
  kIrqSpi1 = 35,
  kIrqSpi2 = 36,
  kIrqUsart2 = 38,
  kIrqExti15To10 = 40,
  kIrqCount = 60
};

#endif /* STM32F103_H */
