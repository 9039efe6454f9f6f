/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A station without the project's driver: an STM32F103 that initialises the chip, judges parameters and configuration,
 * exchanges two bytes each way, gives diagnosis, and answers acyclic reads of both classes. Right, unless a fault of
 * faults.h is built in.
 */
#include "faults.h"
#include "port.h"

enum { kInputs = 2, kPrmLimit = 237, kCfgLimit = 200, kDiagLimit = 6, kMHz = 72 };
enum { kOutput = 1, kPrm = 2, kCfg = 4, kInit = 4, kInput = 1, kDiag = 2, kCfgVerdict = 0x40, kPrmVerdict = 0x80 };

/* ------------------------------------------------------------------------------------------------------------- board
 */

#define CYCCNT 0xE0001004u
#define EXTI 0x40010400u

uint32_t now(void) { return WORD(CYCCNT); }

void pause_us(uint32_t us) {
  const uint32_t since = now();
  while (now() - since < us * kMHz) {
  }
}

static void start_clocks(void) {
  WORD(0x40021000u) |= 1u << 16; /* HSE */
  while ((WORD(0x40021000u) & 1u << 17) == 0u) {
  }
  if (!HAS(NO_WAIT_STATES)) WORD(0x40022000u) = 0x12;
  WORD(0x40021004u) = 7u << 18 | 1u << 16 | 4u << 8; /* PLL: 9 x HSE; APB1 half of it */
  WORD(0x40021000u) |= 1u << 24;
  while ((WORD(0x40021000u) & 1u << 25) == 0u) {
  }
  WORD(0x40021004u) |= 2u; /* TELLS(NO_WAIT_STATES) */
  while ((WORD(0x40021004u) & 0xCu) != 0x8u) {
  }
  WORD(0xE000EDFCu) |= 1u << 24; /* TRCENA */
  WORD(CYCCNT - 4u) |= 1u;
}

static void start_ports(void) { WORD(0x40021018u) |= HAS(GPIO_UNCLOCKED) ? 0x1E9u : 0x1FDu; }

/* RESET at PE4: low for 100 us. */
static void reset_chip(void) {
  WORD(0x40011814u) = 1u << 4; /* TELLS(RESET_UNDRIVEN) */
  if (!HAS(RESET_UNDRIVEN)) WORD(0x40011800u) = (WORD(0x40011800u) & 0xFFF0FFFFu) | 0x30000u;
  port_start();
  if (!HAS(RESET_SHORT)) pause_us(100);
  if (HAS(RESET_SHORT)) { /* again, after the start-up of the chip */
    WORD(0x40011810u) = 1u << 4;
    pause_us(200);
    WORD(0x40011814u) = 1u << 4;
  }
  WORD(0x40011810u) = 1u << 4; /* TELLS(RESET_SHORT) */
}

static volatile int intr0_fell;

/* INTR0 at PG6: EXTI line 6, IRQ 23. */
static void start_intr0(void) {
  WORD(0x40012010u) = 1u << 6; /* pull-up */
  WORD(0x40012000u) = (WORD(0x40012000u) & 0xF0FFFFFFu) | 0x08000000u;
  WORD(0x4001000Cu) = (WORD(0x4001000Cu) & 0xFFFFF0FFu) | 6u << 8;
  if (!HAS(EDGE_UNSET)) WORD(EXTI + 0x0Cu) |= 1u << 6;
  WORD(EXTI) |= 1u << 6;
  if (!HAS(INTR0_BY_LEVEL) && !HAS(INTR0_IGNORED)) WORD(0xE000E100u) = 1u << 23;
}

void intr0_handler(void);
void intr0_handler(void) {
  if (!HAS(UNACKNOWLEDGED)) WORD(EXTI + 0x14u) = 1u << 6; /* TELLS(UNACKNOWLEDGED) */
  intr0_fell = 1;                                         /* INTR0 may have fallen before it was enabled */
}

static void look_at_level(void) {
  if ((WORD(0x40012008u) & 1u << 6) == 0u) intr0_fell = 1;
}

/* ------------------------------------------------------------------------------------------------------------- cells
 */

uint8_t cell(unsigned address) {
  uint8_t value = 0;
  read_cells(address, &value, 1);
  return value;
}

void set_cell(unsigned address, uint8_t value) { write_cells(address, &value, 1); }

static uint16_t crc_on(uint16_t crc, const uint8_t* bytes, unsigned count) {
  while (count-- != 0u) {
    crc ^= *bytes++;
    for (unsigned i = 0; i < 8u; ++i) crc = (uint16_t)((crc & 1u) != 0u ? crc >> 1 ^ 0xA001u : crc >> 1);
  }
  return crc;
}

uint16_t crc16(const uint8_t* bytes, unsigned count) { return crc_on(0xFFFF, bytes, count); }

static void write_crc(unsigned to, uint16_t crc) {
  const uint8_t bytes[2] = {(uint8_t)(crc >> 8), (uint8_t)crc};
  write_cells(to, bytes, 2);
}

static uint16_t read_crc(unsigned from) {
  uint8_t bytes[2];
  read_cells(from, bytes, 2);
  return (uint16_t)(bytes[0] << 8 | bytes[1]);
}

static void set_bits(unsigned address, uint8_t bits) { set_cell(address, (uint8_t)(cell(address) | bits)); }
static void clear_bits(unsigned address, uint8_t bits) { set_cell(address, (uint8_t)(cell(address) & ~bits)); }

/* ---------------------------------------------------------------------------------------------------- initialisation
 */

static int chip_works(void) {
  take();
  const int works = cell(0x004) == 0xC5u;
  give_back();
  return works;
}

static void write_init(void) {
  uint8_t init[17] = {16, 5, 0x0C, 0xC9, 6, 0, 0, 244, 244, kDiagLimit, kPrmLimit, 2, kCfgLimit, 2, 2, 0x11, 0x21};
  if (HAS(IDENT_EXCHANGED)) {
    init[2] = 0xC9;
    init[3] = 0x0C;
  }
  set_cell(0x005, 0x1D); /* TELLS(INIT_EARLY) */
  write_cells(0x020, init, sizeof init);
  write_crc(0x0F7, crc16(init, sizeof init));
  set_bits(0x010, kInit); /* TELLS(INIT_EACH_TURN) */
}

static int init_taken(void) {
  take();
  const int taken = (cell(0x010) & kInit) == 0u;
  if (taken) clear_bits(0x00A, 1);
  give_back();
  return taken;
}

static void initialise(void) {
  if (!HAS(INIT_EARLY))
    while (!chip_works()) pause_us(10);
  if (HAS(INIT_EARLY)) pause_us(90);
  take();
  write_init();
  give_back();
  while (!init_taken()) pause_us(10);
}

/* ------------------------------------------------------------------------------------------------------------ verdicts
 */

static uint8_t block[3 + 237];
static int cfg_is_right;

static void give_verdict(uint8_t refused_bit, int right, uint8_t verdict) {
  if (right)
    clear_bits(0x00C, refused_bit);
  else
    set_bits(0x00C, refused_bit);
  set_bits(0x010, verdict);
}

static void judge_prm(void) {
  read_cells(0x410, block, 1);
  const unsigned length = block[0];
  read_cells(0x411, block + 1, length);
  const int right = HAS(PRM_CRC_UNREAD) || read_crc(0x4FE) == crc16(block, 1u + length);
  clear_bits(0x00E, kPrm);
  if (HAS(NO_VERDICT) || !right) return;
  give_verdict(1, 1, kPrmVerdict);
}

static int is_mine(const uint8_t* cfg, unsigned length) {
  return HAS(CFG_ACCEPTED) || (length == 2u && cfg[0] == 0x11u && cfg[1] == 0x21u);
}

static void judge_cfg(void) {
  read_cells(0x500, block, 3);
  const unsigned length = block[2];
  read_cells(0x503, block + 3, length);
  const int right = read_crc(0x5CB) == crc16(block, 3u + length);
  clear_bits(0x00E, kCfg);
  if (!right) return;
  cfg_is_right = is_mine(block + 3, length);
  give_verdict(2, cfg_is_right, kCfgVerdict);
}

static void judge_late(void) {
  if (HAS(VERDICT_LATE)) pause_us(150000);
}

static void judge(void) {
  if (HAS(VERDICT_ALWAYS) || HAS(VERDICT_CACHED)) {
    static unsigned turns;
    const uint8_t news = cell(0x00E);
    if (HAS(VERDICT_CACHED) && (news & kPrm) != 0u) judge_prm();
    if (HAS(VERDICT_CACHED) && (news & kCfg) != 0u && turns++ != 0u) {
      set_bits(0x010, kCfgVerdict);
      return;
    }
    if (HAS(VERDICT_ALWAYS)) set_bits(0x010, kPrmVerdict | kCfgVerdict);
  }
  const uint8_t news = cell(0x00E);
  if ((news & kPrm) != 0u) judge_prm();
  if ((news & kCfg) != 0u) judge_cfg();
}

/* ------------------------------------------------------------------------------------------------------- cyclic data
 */

static uint8_t inputs[1 + kInputs], outputs[1 + 244];
static unsigned turns;

static void write_inputs(void) {
  inputs[1] = (uint8_t)turns;
  inputs[2] = (uint8_t)(turns >> 8);
  const uint16_t crc = crc16(inputs, sizeof inputs);
  static uint16_t last_crc;
  if (HAS(INPUTS_IN_TWO)) {
    write_cells(0x130, inputs, 2);
    set_bits(0x010, kInput);
    give_back();
    take();
    write_cells(0x132, inputs + 2, 1);
    write_crc(0x225, crc);
    return;
  }
  write_cells(0x130, inputs, sizeof inputs);
  write_crc(0x225, HAS(CRC_LATE) ? last_crc : HAS(CRC_EXCHANGED) ? (uint16_t)(crc >> 8 | crc << 8) : crc);
  last_crc = crc;
  if (!HAS(INPUT_FLAG_NEVER)) set_bits(0x010, kInput);
}

static void fetch_outputs(void) {
  if (HAS(WRONG_FLAG)) {
    clear_bits(0x00F, kOutput);
    return;
  }
  if (HAS(CLEARED_UNREAD)) {
    clear_bits(0x00E, kOutput);
    return;
  }
  outputs[0] = HAS(LENGTH_UNREAD) ? 2u : cell(0x319);
  read_cells(0x31A, outputs + 1, outputs[0]);
  if (HAS(OUTPUTS_LATE)) {
    (void)read_crc(0x40E);
    give_back();
    pause_us(20);
    take();
  }
  if (!HAS(OUTPUT_CRC_UNREAD) && read_crc(0x40E) != crc16(outputs, 1u + outputs[0])) set_bits(0x00D, 4);
  if (!HAS(NEVER_CLEARED)) clear_bits(0x00E, kOutput);
}

static int wants_outputs(void) {
  if (HAS(OUTPUTS_NEVER)) return 0;
  return !HAS(OUTPUTS_RARELY) || turns % 40u == 0u;
}

static void exchange(void) {
  take();
  if (!HAS(INPUTS_ONCE) || turns == 30u) write_inputs();
  if (wants_outputs() && (cell(0x00E) & kOutput) != 0u) fetch_outputs();
  give_back();
}

/* ----------------------------------------------------------------------------------------------------------- acyclic
 */

/* Answers a read of slot 1, index 1 with four bytes, else refuses: B2, invalid slot. */
static void answer(unsigned area, uint8_t flag) {
  uint8_t request[4];
  read_cells(area, request, 4);
  (void)read_crc(area + 0xF4u);
  clear_bits(0x00F, flag);
  uint8_t reply[8] = {request[0], request[1], request[2], 4, 0xA0, 0xA1, 0xA2, 0xA3};
  unsigned length = 8;
  if (request[3] < 4u && !HAS(C1_LONG)) length = 4u + request[3];
  reply[3] = (uint8_t)(length - 4u);
  if (HAS(C1_WRONG_SLOT)) reply[1] = (uint8_t)(request[1] + 1u);
  if (request[0] != 0x5Eu || request[1] != 1u) {
    reply[0] = (uint8_t)(request[0] | 0x80u);
    reply[1] = 0x80;
    reply[2] = 0xB2;
    reply[3] = 0;
    length = 4;
  }
  write_cells(area, reply, length);
  write_crc(area + 0xF4u, crc16(reply, length));
  set_bits(0x011, flag); /* TELLS(C1_WRONG_SLOT) TELLS(C1_LONG) */
}

static void poll_requests(void) {
  take();
  const uint8_t news = cell(0x00F);
  if ((news & 1u) != 0u && !HAS(C1_UNPOLLED)) answer(0x5D0, 1);
  if (HAS(C2_FLAG_LOST) && (news & 2u) != 0u)
    clear_bits(0x00F, 3);
  else if ((news & 2u) != 0u)
    answer(0x6D0, 2);
  give_back();
}

/* --------------------------------------------------------------------------------------------------------- diagnosis
 */

static void set_diagnosis(uint8_t type, const uint8_t* bytes, uint8_t length) {
  uint8_t diagnosis[2 + 8] = {type, length};
  for (unsigned i = 0; i < length; ++i) diagnosis[2u + i] = bytes[i];
  take();
  write_cells(0x227, diagnosis, 2u + length);
  write_crc(0x317, crc16(diagnosis, 2u + length));
  set_bits(0x010, kDiag); /* TELLS(DIAGNOSIS_LONG) */
  give_back();
}

/* In some turns a fault comes and goes. */
static void diagnose(void) {
  static const uint8_t external[8] = {0x03, 0xA5, 0x5A};
  if (turns == 300u) set_diagnosis(0x81, external, HAS(DIAGNOSIS_LONG) ? kDiagLimit + 1u : 3u);
  if (turns == 320u) set_diagnosis(0x01, external, 0);
  if (turns == 340u) set_diagnosis(0x82, external, 3);
  if (turns == 360u && !HAS(STATIC_STAYS)) set_diagnosis(0x02, external, 0);
}

/* -------------------------------------------------------------------------------------------------------------- main
 */

static void idle(void) { pause_us(HAS(HELD_ALWAYS) ? 2 : 100); } /* TELLS: NO_VERDICT and other omissions */

static uint32_t* volatile settings; /* null */

static void remember(void) { settings[4] = turns; /* TELLS(STRAY_STORE) */ }

static void other_faults(void) {
  if (HAS(REQ_LEFT_UP) && turns == 200u) {
    take();
    pause_us(12000);
    give_back();
  }
  if (HAS(HELD_ALWAYS)) {
    take();
    pause_us(2000);
    give_back();
  }
  if (HAS(INTERRUPTS_OFF) && turns == 200u) {
    __asm__ volatile("cpsid i");
    pause_us(150000);
    __asm__ volatile("cpsie i");
  }
  if (HAS(LOOP_DEAD) && turns == 100u)
    for (;;) {
    }
  if (HAS(INIT_EACH_TURN) && turns > 100u) {
    take();
    set_bits(0x010, kInit);
    give_back();
  }
  if (HAS(STRAY_STORE) && turns == 100u) remember();
  if (HAS(CHIPS_FLAG) && turns == 100u) {
    take();
    set_cell(0x012, 0x0C);
    give_back();
  }
}

static void turn(void) {
  if (HAS(INTR0_BY_LEVEL)) look_at_level();
  if (intr0_fell || HAS(VERDICT_ALWAYS) || HAS(VERDICT_CACHED)) {
    intr0_fell = 0;
    judge_late();
    take();
    judge();
    give_back();
  }
  if (turns > 20u) exchange();
  poll_requests();
  diagnose();
  other_faults();
  ++turns;
  idle();
}

extern uint32_t bss_begin[], bss_end[];

void run(void);
void run(void) {
  for (uint32_t* word = bss_begin; word < bss_end; ++word) *word = 0;
  start_clocks();
  intr0_fell = 1; /* INTR0 may have fallen before it was enabled */
  inputs[0] = kInputs;
  cfg_is_right = 1;
  start_ports();
  reset_chip();
  initialise();
  start_intr0();
  for (;;) turn();
}

static void stop(void) {
  for (;;) {
  }
}

extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[16 + 60] = {
    [0] = stack_top,         [1] = (const void*)run,  [2] = (const void*)stop, [3] = (const void*)stop,
    [4] = (const void*)stop, [5] = (const void*)stop, [6] = (const void*)stop, [16 + 23] = (const void*)intr0_handler};
