/* Typical compiler output: loops, calls, tables of branches, division, bytes, halfwords, 64 bits, bit fields. Ends
 * at BKPT with a sum of all results in r0; the results are in RAM. */
#include <stdint.h>

#define COUNT 256u

static uint32_t random_state = 1;
static uint32_t next_random(void) {
  random_state ^= random_state << 13;
  random_state ^= random_state >> 17;
  random_state ^= random_state << 5;
  return random_state;
}

static uint16_t crc16(const uint8_t* bytes, uint32_t size) {
  uint16_t crc = 0xFFFF;
  for (uint32_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (uint16_t)((crc & 1) ? (crc >> 1) ^ 0xA001 : crc >> 1);
  }
  return crc;
}

static void sort(int32_t* values, int32_t first, int32_t last) {
  if (first >= last) return;
  int32_t pivot = values[(first + last) / 2], i = first, j = last;
  while (i <= j) {
    while (values[i] < pivot) ++i;
    while (values[j] > pivot) --j;
    if (i > j) break;
    int32_t other = values[i];
    values[i++] = values[j];
    values[j--] = other;
  }
  sort(values, first, j);
  sort(values, i, last);
}

static int64_t choose(uint32_t what, int64_t a, int64_t b) {
  switch (what % 12) {
    case 0: return a + b;
    case 1: return a - b;
    case 2: return a * b;
    case 3: return (int64_t)((uint64_t)a << (b & 63));
    case 4: return a >> (b & 63);
    case 5: return (int32_t)a / ((int32_t)b | 1);
    case 6: return (uint32_t)a % ((uint32_t)b | 1);
    case 7: return a < b ? a : b;
    case 8: return (int16_t)a * (int8_t)b;
    case 9: return (a ^ b) & ~(a | 0x5A5A);
    case 10: return a == b ? 1 : -a;
    default: return (uint8_t)(a >> 8) | (uint16_t)b << 4;
  }
}

struct fields {
  unsigned a : 3, b : 9, c : 20;
  int d : 5, e : 27;
};

static uint8_t bytes[COUNT];
static int32_t words[COUNT];
static int16_t halves[COUNT];
static int64_t results[COUNT];
static struct fields records[COUNT / 4];

static uint32_t work(void) {
  uint32_t sum = 0;
  for (uint32_t i = 0; i < COUNT; ++i) {
    bytes[i] = (uint8_t)next_random();
    words[i] = (int32_t)next_random();
    halves[i] = (int16_t)(words[i] >> (i % 17));
  }
  sort(words, 0, COUNT - 1);
  int64_t value = 0x123456789ABCDEF;
  for (uint32_t i = 0; i < COUNT; ++i) {
    value = choose(next_random(), value, words[i] + halves[i]);
    results[i] = value;
    struct fields* record = &records[i % (COUNT / 4)];
    record->a += (unsigned)value & 7u;
    record->b ^= bytes[i];
    record->c += record->a * record->b;
    record->d = (int)(value >> 3) - record->d;
    record->e = record->d * (int)record->c;
    sum = sum * 31 + (uint32_t)value + (uint32_t)record->e;
  }
  return sum + crc16(bytes, COUNT) + crc16((const uint8_t*)results, sizeof results);
}

/* RAM holds random bytes when it begins. */
__attribute__((section(".first"), naked)) void begin(void) { __asm volatile("bl run\n bkpt 0"); }

__attribute__((used)) uint32_t run(void) {
  random_state = 1;
  for (uint32_t i = 0; i < COUNT / 4; ++i) records[i] = (struct fields){0, 0, 0, 0, 0};
  uint32_t sum = 0;
  for (int pass = 0; pass < 20; ++pass) sum += work();
  return sum;
}
