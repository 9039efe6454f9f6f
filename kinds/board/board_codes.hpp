#pragma once
// What firmware does on the ARM board and a real board would not forgive: the codes of these violations. Numbers are
// sections of RM0008 (rev. 21).
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

struct BoardCode {
  const char *code, *text, *advice;
};

namespace board_code {

constexpr BoardCode kClockOff = {
    "BOARD_CLOCK_OFF",
    "firmware uses a peripheral whose clock is off: it reads 0 and takes no writes; an access through the FSMC is a "
    "bus fault",
    "Set its bit in RCC_AHBENR, RCC_APB1ENR or RCC_APB2ENR before the first access (7.3.6 to 7.3.8)."};
constexpr BoardCode kClockFast = {
    "BOARD_CLOCK_FAST", "HCLK is above 72 MHz, or PCLK1 above 36 MHz",
    "Choose the PLL's factor and the dividers HPRE and PPRE1 of RCC_CFGR before the switch to the PLL (7.2)."};
constexpr BoardCode kFlashLatency = {
    "BOARD_FLASH_LATENCY", "flash has fewer wait states than SYSCLK needs: instructions may be read wrongly",
    "Write FLASH_ACR.LATENCY before the switch of the clock: 0 up to 24 MHz, 1 up to 48 MHz, 2 up to 72 MHz (3.3.3)."};
constexpr BoardCode kPinMode = {
    "BOARD_PIN_MODE", "firmware uses a pin that GPIOx_CRL or GPIOx_CRH sets up for something else",
    "R_REQ, R_STA, RESET and XSS are outputs (R_REQ and R_STA push-pull); FSMC, SCK, MOSI and TX are alternate "
    "functions, push-pull (9.1.11, 9.2.1, 9.2.2). The port needs its clock for that."};
constexpr BoardCode kPinConflict = {"BOARD_PIN_CONFLICT", "firmware drives a line that the chip drives, too",
                                    "Make the pin an input (9.2.1, 9.2.2)."};
constexpr BoardCode kFsmcMode = {
    "BOARD_FSMC_MODE",
    "the FSMC is set to 16 bits or to multiplexed lines; the chip has 8 data lines and its own address "
    "lines",
    "Write FSMC_BCR1 with MWID = 00 and MUXEN = 0: both are otherwise after a reset (21.5.6)."};
constexpr BoardCode kNotMapped = {
    "BOARD_NOT_MAPPED", "firmware accesses an address at which an STM32F103xE has nothing",
    "Look for a wrong base address, an index out of its range, or a pointer that was not set (3.3)."};
constexpr BoardCode kWatchdog = {
    "BOARD_WATCHDOG", "the independent watchdog resets the processor",
    "Write AAAA to IWDG_KR more often, or find what keeps the firmware from it; IWDG_PR and IWDG_RLR set the time "
    "(chapter 19)."};
constexpr BoardCode kOverrun = {
    "BOARD_OVERRUN", "a byte over SPI or the UART was lost, as the one before it had not been fetched (OVR, ORE)",
    "Read DR after each byte, or from an interrupt with a high priority (25.3.10, 27.3.3)."};
constexpr BoardCode kIrqStorm = {
    "BOARD_IRQ_STORM", "a handler returns again and again without the end of its interrupt: nothing else is executed",
    "Clear the flag in the handler (EXTI_PR by 1, TIMx_SR by 0, USART and SPI by DR), or disable the interrupt."};
constexpr BoardCode kStuck = {
    "STUCK",
    "firmware computes for 100 ms or more without an access to the chip or to a peripheral, and does not sleep",
    "Look at the loop that is named: what ends it? Give waits a limit, and let an idle processor sleep (WFI, WFE)."};

}  // namespace board_code

/// All of them.
constexpr BoardCode kBoardCodes[] = {board_code::kClockOff,  board_code::kClockFast,   board_code::kFlashLatency,
                                     board_code::kPinMode,   board_code::kPinConflict, board_code::kFsmcMode,
                                     board_code::kNotMapped, board_code::kWatchdog,    board_code::kOverrun,
                                     board_code::kIrqStorm,  board_code::kStuck};

/// For ChipKind::codes of a kind that has the board.
CodeTable board_codes();

}  // namespace dsdpv1::tb
