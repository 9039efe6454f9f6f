/* Firmware for the evaluation board as written outside the project: only from the datasheet and ST's manuals. It
 * includes nothing of the project, has no mailbox and follows no scenario. A separate station: address from seven
 * switches at PA0 to PA6 (closed: 0; all open: address 5), ident 0CC9, parameters and configuration judged here,
 * inputs are the last outputs. */
#include <stdint.h>

#define WORD(address) (*(volatile uint32_t*)(address))
#define SHARED(offset) (((volatile uint8_t*)0x60000000u)[offset])

enum { kOwnAddress = 5, kMost = 244 };

/* ---- board ---- */

#define RCC_CR 0x40021000u
#define RCC_CFGR 0x40021004u
#define FLASH_LATENCY 0x40022000u
#define PORTA 0x40010800u
#define PORTC 0x40011000u
#define PORTD 0x40011400u
#define PORTE 0x40011800u
#define PORTF 0x40011C00u
#define PORTG 0x40012000u
#define LOW 0x00u
#define HIGH 0x04u
#define IN 0x08u
#define SET 0x10u
#define CLEAR 0x14u

static void start_72_mhz(void) {
  WORD(RCC_CR) |= 1u << 16;
  while ((WORD(RCC_CR) & 1u << 17) == 0u) {
  }
  WORD(FLASH_LATENCY) = 0x12;
  WORD(RCC_CFGR) = 7u << 18 | 1u << 16 | 4u << 8; /* PLL: crystal x 9; APB1 half of it */
  WORD(RCC_CR) |= 1u << 24;
  while ((WORD(RCC_CR) & 1u << 25) == 0u) {
  }
  WORD(RCC_CFGR) |= 2u;
  while ((WORD(RCC_CFGR) & 0xCu) != 0x8u) {
  }
}

static void start_pins(void) {
  WORD(0x40021014u) |= 1u << 8;    /* FSMC */
  WORD(0x40021018u) |= 0x1FDu;     /* AFIO, ports A to G */
  WORD(PORTE + CLEAR) = 1u << 4;   /* the chip stays in reset */
  WORD(PORTE + LOW) = 0xB4434444u; /* D4; PE4 */
  WORD(PORTE + HIGH) = 0x44444BBBu;
  WORD(PORTA + SET) = 0x7F;
  WORD(PORTA + LOW) = 0x48888888u; /* pulled up */
  WORD(PORTC + CLEAR) = 3u << 6;
  WORD(PORTC + LOW) = 0x33444444u;
  WORD(PORTD + LOW) = 0xB4BB44BBu;
  WORD(PORTD + HIGH) = 0xBB444444u;
  WORD(PORTF + LOW) = 0x44BBBBBBu;
  WORD(PORTF + HIGH) = 0xBBBB4444u;
  WORD(PORTG + LOW) = 0x4444444Bu;
  WORD(0xA0000004u) = 1u | 5u << 8;
  WORD(0xA0000000u) = 0x1081u;
  WORD(PORTE + SET) = 1u << 4;
}

static uint8_t address_of_switches(void) {
  const uint32_t switches = WORD(PORTA + IN) & 0x7Fu;
  return switches > 125u ? (uint8_t)kOwnAddress : (uint8_t)switches;
}

static void pause(unsigned loops) {
  for (volatile unsigned i = 0; i < loops; ++i) {
  }
}

/* ---- shared memory ---- */

static void take(void) {
  for (;;) {
    WORD(PORTC + SET) = 1u << 6;
    pause(4);
    if ((WORD(PORTC + IN) & 3u << 8) == 0u) break;
    WORD(PORTC + CLEAR) = 1u << 6;
    pause(4);
  }
  WORD(PORTC + SET) = 1u << 7;
  SHARED(0x006) = (uint8_t)(SHARED(0x006) + 1u);
}

static void give_back(void) {
  WORD(PORTC + CLEAR) = 1u << 7;
  WORD(PORTC + CLEAR) = 1u << 6;
}

static uint16_t checksum(uint16_t crc, const uint8_t* bytes, unsigned count) {
  while (count-- != 0u) {
    crc ^= *bytes++;
    for (unsigned i = 0; i < 8u; ++i) crc = (uint16_t)((crc & 1u) != 0u ? crc >> 1 ^ 0xA001u : crc >> 1);
  }
  return crc;
}

static void write(unsigned to, const uint8_t* bytes, unsigned count) {
  for (unsigned i = 0; i < count; ++i) SHARED(to + i) = bytes[i];
}

static void read(uint8_t* bytes, unsigned from, unsigned count) {
  for (unsigned i = 0; i < count; ++i) bytes[i] = SHARED(from + i);
}

static void write_checksum(unsigned to, uint16_t crc) {
  SHARED(to) = (uint8_t)(crc >> 8);
  SHARED(to + 1u) = (uint8_t)crc;
}

/* ---- station ---- */

static uint8_t data[1 + kMost];        /* length, bytes: in the format of inputs and outputs in the memory */
static uint8_t block[3 + 237], sum[2]; /* from the master; checksums are not verified */
static uint8_t inputs;                 /* their number, from the configuration */

static int chip_works(void) {
  take();
  const int works = SHARED(0x004) == 0xC5u;
  give_back();
  return works;
}

static int chip_has_begun(void) {
  take();
  const int taken = (SHARED(0x010) & 4u) == 0u;
  give_back();
  return taken;
}

static void initialise(void) {
  uint8_t init[16] = {15, 0, 0x0C, 0xC9, 7, 0, 0, kMost, kMost, 16, 237, 2, 200, 2, 1, 0x37};
  init[1] = address_of_switches();
  const uint16_t crc = checksum(0xFFFF, init, sizeof init);
  take();
  SHARED(0x005) = 0;
  write(0x020, init, sizeof init);
  write_checksum(0x0F7, crc);
  SHARED(0x010) = 4;
  give_back();
  while (!chip_has_begun()) pause(50);
}

/* Checks what the master sent, accepts it, and reads the lengths from the configuration. */
static void judge(uint8_t news) {
  if ((news & 2u) != 0u) {
    read(block, 0x410, 1);
    read(block + 1, 0x411, block[0] <= 237u ? block[0] : 0u);
    read(sum, 0x4FE, 2);
    SHARED(0x00E) = (uint8_t)(SHARED(0x00E) & ~2u);
    SHARED(0x00C) = (uint8_t)(SHARED(0x00C) & ~1u);
    SHARED(0x010) = (uint8_t)(SHARED(0x010) | 0x80u);
  }
  if ((news & 4u) != 0u) {
    read(block, 0x500, 3);
    inputs = block[1];
    read(block + 3, 0x503, block[2] <= 200u ? block[2] : 0u);
    read(sum, 0x5CB, 2);
    SHARED(0x00E) = (uint8_t)(SHARED(0x00E) & ~4u);
    SHARED(0x00C) = (uint8_t)(SHARED(0x00C) & ~2u);
    SHARED(0x010) = (uint8_t)(SHARED(0x010) | 0x40u);
  }
}

static void fetch_outputs(void) {
  const uint8_t length = SHARED(0x319);
  if (length <= kMost) read(data + 1, 0x31A, length);
  read(sum, 0x40E, 2);
  SHARED(0x00E) = (uint8_t)(SHARED(0x00E) & ~1u);
}

static void exchange(void) {
  data[0] = inputs;
  const uint16_t crc = checksum(0xFFFF, data, 1u + inputs);
  take();
  const uint8_t news = SHARED(0x00E);
  judge(news);
  if (inputs != 0u && inputs == data[0]) {
    write(0x130, data, 1u + inputs);
    write_checksum(0x225, crc);
    SHARED(0x010) = (uint8_t)(SHARED(0x010) | 1u);
  }
  if ((news & 1u) != 0u) fetch_outputs();
  give_back();
}

void run(void);
void run(void) {
  inputs = 0;
  for (unsigned i = 0; i < sizeof data; ++i) data[i] = 0;
  start_72_mhz();
  start_pins();
  while (!chip_works()) pause(100);
  initialise();
  for (;;) {
    exchange();
    pause(100);
  }
}

extern char stack_top[];
__attribute__((section(".vectors"), used)) static const void* const vectors[16] = {
    [0] = stack_top, [1] = (const void*)run};
