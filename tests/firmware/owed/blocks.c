/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Blocks and their flags where the user holds the DPRAM: parallel port and SPI. */
#include "faults.h"
#include "port.h"

uint8_t news(unsigned command) { return cell(command); }

/* Returns the block's length, 0 where the CRC is wrong. */
static unsigned read_block(const struct area* from, uint8_t* bytes) {
  const int outputs = from->begin == 0x319u;
  if (outputs && HAS(LENGTH_UNREAD))
    bytes[0] = 2;
  else
    read_cells(from->begin, bytes, from->head);
  const int reads = from->head == 4u && bytes[0] == 0x5Eu; /* a request to read has no data */
  const unsigned length = from->head + (reads ? 0u : bytes[from->head - 1u]);
  if (length > from->head) read_cells(from->begin + from->head, bytes + from->head, length - from->head);
  if ((outputs && HAS(OUTPUT_CRC_UNREAD)) || (from->begin == 0x410u && HAS(PRM_CRC_UNREAD))) return length;
  return read_crc(from->crc) == crc16(bytes, length) || HAS(CRC_UNJUDGED) ? length : 0u;
}

unsigned fetch(const struct area* from, uint8_t* bytes) {
  const int outputs = from->begin == 0x319u;
  if (outputs && HAS(WRONG_FLAG)) {
    clear_bits(0x00F, from->flag);
    return 0;
  }
  if (outputs && HAS(CLEARED_UNREAD)) {
    clear_bits(from->command, from->flag);
    return 0;
  }
  unsigned length = 0;
  for (unsigned tries = 3; tries != 0u && length == 0u; --tries) length = read_block(from, bytes);
  if (outputs && HAS(OUTPUTS_LATE)) {
    give_back();
    pause_us(20);
    take();
  }
  if (!outputs || !HAS(NEVER_CLEARED)) clear_bits(from->command, from->flag);
  return length;
}

void post(const struct area* to, const uint8_t* bytes, unsigned count) {
  write_cells(to->begin, bytes, count);
  write_crc(to->crc, crc16(bytes, count));
  set_bits(to->command, to->flag);
}

static void post_wrongly(const struct area* to, const uint8_t* bytes, unsigned count) {
  static uint16_t last;
  const uint16_t crc = crc16(bytes, count);
  write_cells(to->begin, bytes, HAS(INPUTS_IN_TWO) ? count - 1u : count);
  if (HAS(INPUTS_IN_TWO)) {
    set_bits(to->command, to->flag);
    give_back();
    take();
    write_cells(to->begin + count - 1u, bytes + count - 1u, 1);
  }
  write_crc(to->crc, HAS(CRC_LATE) ? last : HAS(CRC_EXCHANGED) ? (uint16_t)(crc >> 8 | crc << 8) : crc);
  last = crc;
  if (HAS(CRC_LATE) || HAS(CRC_EXCHANGED)) set_bits(to->command, to->flag);
}

void swap(const uint8_t* inputs, unsigned count, uint8_t* outputs, int wants_outputs) {
  take();
  if (inputs != 0) {
    if (HAS(INPUTS_IN_TWO) || HAS(CRC_LATE) || HAS(CRC_EXCHANGED) || HAS(INPUT_FLAG_NEVER))
      post_wrongly(&area_inputs, inputs, count);
    else
      post(&area_inputs, inputs, count);
  }
  if (wants_outputs && (cell(0x00E) & area_outputs.flag) != 0u) (void)fetch(&area_outputs, outputs);
  give_back();
}
