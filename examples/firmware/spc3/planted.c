/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Mistakes; the numbers are those of tests/kinds/spc3/board/planted_test.py. */
#include "examples/firmware/spc3/planted.h"

#ifdef SPC3_PLANTED

#include "examples/firmware/board.h"
#include "examples/firmware/spc3/port.h"
#include "registers/spc3_regs.h"

enum {
  kNone,
  kStartMode,
  kStartStation,
  kStartPointer,
  kStartLength,
  kStartPreset,
  kStartOutputs,
  kUseOrganisation,
  kUseRam,
  kUseData,
  kUseDiag,
  kUseBlock,
  kAckTime,
  kAckFounded,
  kAckSweep,
  kIrqEoi,
  kIrqSeen,
  kIrqMask,
  kIrqIdle,
  kLiveOutputs,
  kLiveInputs,
  kLiveWatchdog,
  kLiveFirst,
  kBusReady,
  kBusData
};

static unsigned mistake;
static uint32_t turns; /* since START */

void planted_start(void) {
  enum { kFirst = 8, kCount = 5 };
  for (unsigned pin = kFirst; pin < (unsigned)kFirst + (unsigned)kCount; ++pin) {
    GPIOD->BRR = 1u << pin;
    board_pin(GPIOD, pin, GPIO_INPUT_PULL);
  }
  mistake = GPIOD->IDR >> kFirst & ((1u << kCount) - 1u);
}

static uint8_t get(uint16_t address) { return port_stm32.read(port_stm32.ctx, address); }
static void put(uint16_t address, uint8_t value) { port_stm32.write(port_stm32.ctx, address, value); }
static uint16_t buffer(uint16_t pointer) { return (uint16_t)((uint16_t)get(pointer) << 3); }

/* ------------------------------------------------------------------------------------- what the driver would write */

/* The test of the RAM writes its low half to each of these cells. */
static bool is_setting(uint16_t cell, uint16_t address, uint8_t value) { return address == cell && value != cell; }

bool planted_write(uint16_t address, uint8_t* value) {
  static uint8_t ssa; /* the pointer of that buffer */
  const bool online = (turns != 0u);
  if (is_setting(SPC3_REG_ORG_SSA_POINTER, address, *value) && *value != 0u) ssa = *value;
  switch (mistake) {
    case kStartMode:
      if (address == SPC3_REG_MODE_0 + 1u) *value = 0;
      return true;
    case kStartStation:
      if (is_setting(SPC3_REG_ORG_IDENT_LOW, address, *value)) *value = 0;
      if (is_setting(SPC3_REG_ORG_IDENT_HIGH, address, *value)) *value = 0;
      return true;
    case kStartPointer:
      if (is_setting(SPC3_REG_ORG_CFG_POINTER, address, *value) && *value != 0u) *value = ssa;
      return true;
    case kStartLength:
      if (address == SPC3_REG_ORG_DIAG_LENGTH + 1u && *value == 6u) *value = 5;
      return true;
    case kStartPreset: return online || address != SPC3_REG_MODE_1_S || *value != SPC3_REG_MODE_1_RES_USER_WD;
    case kIrqEoi: return address != SPC3_REG_MODE_1_S || *value != SPC3_REG_MODE_1_EOI;
    case kLiveWatchdog: return !online || address != SPC3_REG_MODE_1_S || *value != SPC3_REG_MODE_1_RES_USER_WD;
    default: return true;
  }
}

uint16_t planted_user_wd(uint16_t usual) { return mistake == kLiveWatchdog ? 5u : usual; }

/* -------------------------------------------------------------------------------------------------------- in its place
 */

bool planted_first_inputs(void) {
  turns = 0;
  return mistake != kLiveFirst;
}

void planted_before_start(spc3_device* chip) {
  (void)chip;
  if (mistake == kStartOutputs) put(buffer(SPC3_REG_ORG_DOUT_POINTER + 1u), 0x55);
}

void planted_judging(void) {
  if (mistake == kAckTime) board_wait(board_cycles(3000000));
}

bool planted_fetches(void) { return mistake != kLiveOutputs; }
bool planted_gives(void) { return mistake != kLiveFirst && (mistake != kLiveInputs || turns == 0u); }

/* The pointer of the first of the three buffers, from `pointer` on, that is not the user's by `machine`. */
static uint16_t not_the_users(uint16_t pointer, uint16_t machine) {
  const unsigned user = (get(machine) & SPC3_REG_SM_U) >> SPC3_REG_SM_U_SHIFT;
  return (uint16_t)(user == 1u ? pointer + 1u : pointer);
}

static uint16_t diag_of_the_chip(void) {
  const bool first = (get(SPC3_REG_DIAG_SM) & SPC3_REG_DIAG_SM_FIRST) == 1u;
  return (uint16_t)(SPC3_REG_ORG_DIAG_POINTER + (first ? 1u : 0u));
}

static void read_all_registers(void) {
  for (uint16_t each = 0; each < SPC3_REG_ORG; ++each) (void)get(each);
}

/* Sees the events that stand, DX_OUT among them, and lets them raise X/INT. */
static void open_mask(void) {
  (void)get(SPC3_REG_IRR + 1u);
  put(SPC3_REG_IMR + 1u, 0x00);
}

/* An access that does not wait for XREADY. */
static void hurry(bool write) {
  const uint32_t before = board_lock(), usual = FSMC_BANK1->NE[0].BTR;
  FSMC_BANK1->NE[0].BTR = 1u << FSMC_BTR_DATAST_SHIFT;
  if (write)
    put(SPC3_REG_MODE_1_S, 0);
  else
    (void)get(SPC3_REG_STATUS);
  board_barrier();
  FSMC_BANK1->NE[0].BTR = usual;
  board_unlock(before);
}

static void err(void) {
  switch (mistake) {
    case kUseOrganisation: put(SPC3_REG_MODE_0, 0); break;
    case kUseRam: (void)get(SPC3_REG_RAM_SIZE); break;
    case kUseData: (void)get(buffer(not_the_users(SPC3_REG_ORG_DOUT_POINTER, SPC3_REG_DOUT_SM))); break;
    case kUseDiag: put(buffer(diag_of_the_chip()), 0); break;
    case kUseBlock: (void)get(buffer(SPC3_REG_ORG_PRM_POINTER)); break;
    case kAckFounded: (void)get(SPC3_REG_PRM_OK); break;
    case kAckSweep: read_all_registers(); break;
    case kIrqSeen: put(SPC3_REG_IAR + 1u, 0xFF); break;
    case kIrqMask: open_mask(); break;
    case kBusReady: hurry(false); break;
    case kBusData: hurry(true); break;
    default: break;
  }
}

void planted_turn(spc3_device* chip) {
  enum { kWhen = 100 }; /* in DATA_EX */
  (void)chip;
  ++turns;
  if (turns == (uint32_t)kWhen) err();
  if (mistake == kIrqIdle) put(SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_EOI);
}

#endif
