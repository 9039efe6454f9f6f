/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#include "telegram.h"

#include "faults.h"
#include "port.h"

uint8_t frame[kMostBytes];

unsigned head(unsigned start, unsigned address, unsigned count) {
  frame[0] = (uint8_t)(start | kAddress);
  frame[1] = (uint8_t)(address >> 8);
  frame[2] = (uint8_t)address;
  frame[3] = (uint8_t)count;
  return kHead;
}

int is_sealed(const uint8_t* bytes, unsigned count) {
  if (count < 4u) return 0;
  return crc16(bytes, count - 2u) == (uint16_t)(bytes[count - 2u] << 8 | bytes[count - 1u]) || HAS(CRC_UNJUDGED);
}

unsigned seal(unsigned count) {
  const uint16_t crc = crc16(frame, count);
  static unsigned telegrams;
  const unsigned spoilt = HAS(TELEGRAM_CRC) && ++telegrams % 50u == 0u ? 1u : 0u;
  frame[count] = (uint8_t)(crc >> 8 ^ spoilt);
  frame[count + 1u] = (uint8_t)crc;
  return count + 2u;
}
