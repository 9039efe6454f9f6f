/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A station without the project's driver: an STM32F103 that initialises the chip, judges parameters and configuration,
 * exchanges two bytes each way, gives diagnosis, and answers acyclic reads of both classes. Right, unless a fault of
 * faults.h is built in.
 */
#include "faults.h"
#include "port.h"

enum { kInputs = 2, kPrmLimit = 237, kCfgLimit = 200, kDiagLimit = 6 };
enum { kPrm = 2, kCfg = 4, kInit = 4, kCfgVerdict = 0x40, kPrmVerdict = 0x80 };

const struct area area_inputs = {0x130, 1, 0x225, 0x010, 1};
const struct area area_outputs = {0x319, 1, 0x40E, 0x00E, 1};
static const struct area diagnosis = {0x227, 2, 0x317, 0x010, 2};
static const struct area prm = {0x410, 1, 0x4FE, 0x00E, kPrm};
static const struct area cfg = {0x500, 3, 0x5CB, 0x00E, kCfg};
static const struct area requests[] = {{0x5D0, 4, 0x6C4, 0x00F, 1}, {0x6D0, 4, 0x7C4, 0x00F, 2}};
static const struct area answers[] = {{0x5D0, 4, 0x6C4, 0x011, 1}, {0x6D0, 4, 0x7C4, 0x011, 2}};

static uint8_t block[3 + 244];
static unsigned turns; /* since a right configuration */
static int configured;

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
  set_cell(0x005, 0x1D);
  write_cells(0x020, init, sizeof init);
  write_crc(0x0F7, crc16(init, sizeof init));
  set_bits(0x010, kInit);
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

static void give_verdict(uint8_t refused_bit, int right, uint8_t verdict) {
  if (right)
    clear_bits(0x00C, refused_bit);
  else
    set_bits(0x00C, refused_bit);
  set_bits(0x010, verdict);
}

static void judge_prm(void) {
  if (fetch(&prm, block) != 0u && !HAS(NO_VERDICT)) give_verdict(1, 1, kPrmVerdict);
}

static int is_mine(const uint8_t* bytes, unsigned length) {
  return HAS(CFG_ACCEPTED) || (length == 2u && bytes[0] == 0x11u && bytes[1] == 0x21u);
}

static void judge_cfg(void) {
  static int judged, last;
  if (fetch(&cfg, block) == 0u) return;
  if (!HAS(VERDICT_CACHED) || !judged) last = is_mine(block + 3, block[2]);
  judged = 1;
  if (last) configured = 1;
  give_verdict(2, last, kCfgVerdict);
}

static void judge(void) {
  const uint8_t flags = news(0x00E);
  if ((flags & kPrm) != 0u) judge_prm();
  if ((flags & kCfg) != 0u) judge_cfg();
}

static void service(void) {
  if (HAS(VERDICT_LATE)) pause_us(150000);
  take();
  judge();
  give_back();
}

static void give_verdicts(void) {
  take();
  set_bits(0x010, kPrmVerdict | kCfgVerdict);
  give_back();
}

/* ------------------------------------------------------------------------------------------------------- cyclic data
 */

static void exchange(void) {
  static uint8_t inputs[1 + kInputs], outputs[1 + 244];
  inputs[0] = kInputs;
  inputs[1] = (uint8_t)turns;
  inputs[2] = (uint8_t)(turns >> 8);
  const int wants_outputs = !HAS(OUTPUTS_NEVER) && (!HAS(OUTPUTS_RARELY) || turns % 40u == 0u);
  const int renews = !HAS(INPUTS_ONCE) || turns == 30u;
  swap(renews ? inputs : 0, sizeof inputs, outputs, wants_outputs);
}

/* ----------------------------------------------------------------------------------------------------------- acyclic
 */

/* An answer that comes 20 ms later. */
static struct {
  uint32_t since;
  unsigned class, count;
  uint8_t bytes[8];
} late;

static void give_answer(unsigned class, const uint8_t* bytes, unsigned count) {
  if (!HAS(ANSWER_STALE)) {
    post(&answers[class], bytes, count);
    return;
  }
  for (unsigned i = 0; i < count; ++i) late.bytes[i] = bytes[i];
  late.class = class;
  late.count = count;
  late.since = now();
}

static void give_late_answer(void) {
  if (now() - late.since < 72u * 20000u) return;
  post(&answers[late.class], late.bytes, late.count);
  late.count = 0;
}

/* Answers a read of slot 1 with four bytes, else refuses: B2, invalid slot. */
static void answer(unsigned class) {
  uint8_t request[244];
  if (fetch(&requests[class], request) == 0u) return;
  uint8_t reply[8] = {request[0], request[1], request[2], 4, 0xA0, 0xA1, 0xA2, 0xA3};
  if (request[3] < 4u && !HAS(C1_LONG)) reply[3] = request[3];
  if (HAS(C1_WRONG_SLOT)) reply[1] = (uint8_t)(request[1] + 1u);
  if (request[0] != 0x5Eu || request[1] != 1u) {
    const uint8_t refused[4] = {(uint8_t)(request[0] | 0x80u), 0x80, 0xB2, 0};
    give_answer(class, refused, 4);
    return;
  }
  give_answer(class, reply, 4u + reply[3]);
}

static void poll_requests(void) {
  take();
  if (late.count != 0u) {
    give_late_answer();
    give_back();
    return;
  }
  const uint8_t flags = news(0x00F);
  if ((flags & 1u) != 0u && !HAS(C1_UNPOLLED)) answer(0);
  if ((flags & 2u) != 0u && HAS(C2_FLAG_LOST)) clear_bits(0x00F, 3);
  if ((flags & 2u) != 0u && !HAS(C2_FLAG_LOST)) answer(1);
  give_back();
}

/* --------------------------------------------------------------------------------------------------------- diagnosis
 */

static void set_diagnosis(uint8_t type, uint8_t length) {
  const uint8_t bytes[2 + kDiagLimit + 1] = {type, length, length, 0xA5, 0x5A};
  take();
  post(&diagnosis, bytes, 2u + length);
  give_back();
}

/* In some turns a fault comes and goes. */
static void diagnose(void) {
  if (turns == 300u) set_diagnosis(0x81, HAS(DIAGNOSIS_LONG) ? kDiagLimit + 1u : 3u);
  if (turns == 320u) set_diagnosis(0x01, 0);
  if (turns == 340u) set_diagnosis(0x82, 3);
  if (turns == 360u && !HAS(STATIC_STAYS)) set_diagnosis(0x02, 0);
}

/* -------------------------------------------------------------------------------------------------------------- main
 */

static void idle(void) { pause_us(HAS(HELD_ALWAYS) ? 2 : 100); }

static uint32_t* volatile settings; /* null */

/* TELLS(STRAY_STORE) */
static void remember(void) { settings[4] = turns; }

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
  if (HAS(VERDICT_ALWAYS)) give_verdicts();
  if (intr0_fell) {
    intr0_fell = 0;
    service();
  }
  if (turns > 20u) exchange();
  poll_requests();
  diagnose();
  other_faults();
  if (configured) ++turns;
  idle();
}

extern uint32_t bss_begin[], bss_end[];

void run(void) {
  for (uint32_t* word = bss_begin; word < bss_end; ++word) *word = 0;
  start_clocks();
  intr0_fell = 1; /* INTR0 may have fallen before it was enabled */
  start_ports();
  reset_chip();
  initialise();
  start_intr0();
  for (;;) turn();
}
