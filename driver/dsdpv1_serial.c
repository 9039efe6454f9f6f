/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Telegrams that read and write cells (6.2, 6.3, 7.1.4). */
#include <string.h>

#include "dsdpv1_serial_internal.h"

/* --------------------------------------------------------------------------------------------------------- telegrams
 */

uint16_t dsdpv1_seal(uint8_t* bytes, uint16_t n) {
  const uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, bytes, n);
  bytes[n] = (uint8_t)(crc >> 8);
  bytes[n + 1u] = (uint8_t)(crc & 0xFFu);
  return (uint16_t)(n + kTelegramCrc);
}

bool dsdpv1_sealed(const dsdpv1_response* reply) {
  if (reply->length < kShortReply) return false;
  const size_t n = reply->length - (size_t)kTelegramCrc;
  const unsigned crc = (unsigned)reply->bytes[n] << 8 | reply->bytes[n + 1u];
  return dsdpv1_crc(DSDPV1_CRC_START, reply->bytes, n) == crc;
}

uint8_t* dsdpv1_copy_spans(uint8_t* to, dsdpv1_span head, dsdpv1_span data) {
  if (head.length != 0u) (void)memcpy(to, head.bytes, head.length);
  to += head.length;
  if (data.length != 0u) (void)memcpy(to, data.bytes, data.length);
  return to + data.length;
}

static uint16_t put_together(const dsdpv1_wire* wire, const dsdpv1_order* order) {
  uint8_t* bytes = wire->serial->bytes; /* NOLINT(clang-analyzer-core.NullDereference): every wire has a port */
  uint8_t* to = bytes;
  *to++ = (uint8_t)(order->start | wire->address);
  if (order->start != kStartBoth) { /* SPI's read and write has neither address nor length */
    *to++ = (uint8_t)(order->address >> 8);
    *to++ = (uint8_t)(order->address & 0xFFu);
    *to++ = order->start == kStartRead ? order->length : (uint8_t)(order->head.length + order->data.length);
  }
  to = dsdpv1_copy_spans(to, order->head, order->data);
  return dsdpv1_seal(bytes, (uint16_t)(to - bytes));
}

static dsdpv1_error judge_refusal(const dsdpv1_wire* wire, const dsdpv1_response* received) {
  const dsdpv1_response reply = {received->bytes, kShortReply};
  if (received->length < kShortReply || !dsdpv1_sealed(&reply)) return DSDPV1_ERR_REPLY;
  wire->serial->error_code = reply.bytes[1];
  return reply.bytes[1] == 0u ? DSDPV1_ERR_DPRAM_BUSY : DSDPV1_ERR_TELEGRAM;
}

/* Data bytes in the reply: for a read the number requested, for read and write the count in its first byte. */
static uint16_t data_length(const dsdpv1_order* order, const dsdpv1_response* reply) {
  if (order->start == kStartBoth) return reply->length > 2u ? (uint16_t)(reply->bytes[2] + 1u) : 1u;
  return order->start == kStartRead ? order->length : 0u;
}

static dsdpv1_error judge(const dsdpv1_wire* wire, const dsdpv1_order* order, const dsdpv1_response* received,
                          dsdpv1_span* data) {
  if (received->length == 0u) return DSDPV1_ERR_NO_REPLY;
  if (received->bytes[0] == (kStartError | wire->address)) return judge_refusal(wire, received);
  const uint16_t count = data_length(order, received);
  const dsdpv1_response reply = {received->bytes, (uint16_t)(kShortReply + count)};
  const bool right = received->length >= reply.length && count <= UINT8_MAX &&
                     reply.bytes[0] == (order->start | kReplyBit | wire->address) && reply.bytes[1] == 0u &&
                     dsdpv1_sealed(&reply);
  if (!right) return DSDPV1_ERR_REPLY;
  data->bytes = reply.bytes + 2;
  data->length = (uint8_t)count;
  return DSDPV1_OK;
}

static dsdpv1_error send_once(dsdpv1_device* device, const dsdpv1_wire* wire, const dsdpv1_order* order,
                              dsdpv1_span* data) {
  dsdpv1_response reply = {NULL, 0};
  const uint16_t most = (uint16_t)(kShortReply + order->most);
  if (!wire->transfer(device, put_together(wire, order), most, &reply)) return DSDPV1_ERR_NO_REPLY;
  return judge(wire, order, &reply, data);
}

dsdpv1_error dsdpv1_transact(dsdpv1_device* device, const dsdpv1_wire* wire, const dsdpv1_order* order,
                             dsdpv1_span* data) {
  for (uint8_t retries = device->tuning.telegram_retries;; --retries) {
    const dsdpv1_error error = send_once(device, wire, order, data);
    if (error == DSDPV1_OK || error == DSDPV1_ERR_DPRAM_BUSY || retries == 0u) return error;
    ++wire->serial->repetitions;
    wire->recover(device);
  }
}

/* ------------------------------------------------------------------------------------------------------------- cells
 */

dsdpv1_error dsdpv1_read_cells(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, dsdpv1_span* data,
                               uint8_t length) {
  const dsdpv1_order order = {kStartRead, address, {NULL, 0}, {NULL, 0}, length, length};
  return dsdpv1_transact(device, wire, &order, data);
}

dsdpv1_error dsdpv1_write_cells(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, dsdpv1_span head,
                                dsdpv1_span data) {
  const dsdpv1_order order = {kStartWrite, address, head, data, 0, 0};
  dsdpv1_span none = {NULL, 0};
  const dsdpv1_error error = dsdpv1_transact(device, wire, &order, &none);
  uint8_t* cell = dsdpv1_status_cell(wire->serial, address);
  if (cell != NULL && head.length == 1u) *cell = head.bytes[0];
  return error;
}

uint8_t* dsdpv1_status_cell(dsdpv1_serial* serial, uint16_t address) {
  const unsigned offset = (unsigned)address - DSDPV1_REG_CHIP_STATUS_1;
  return address < DSDPV1_REG_CHIP_STATUS_1 || offset >= DSDPV1_STATUS_CELLS ? NULL : &serial->status[offset];
}

dsdpv1_error dsdpv1_know_status(dsdpv1_device* device, const dsdpv1_wire* wire) {
  if (wire->serial->known) return DSDPV1_OK;
  dsdpv1_span data = {NULL, 0};
  const dsdpv1_error error = dsdpv1_read_cells(device, wire, DSDPV1_REG_CHIP_STATUS_1, &data, DSDPV1_STATUS_CELLS);
  if (error != DSDPV1_OK) return error;
  /* NOLINTNEXTLINE(clang-analyzer-core.NonNullParamChecker): a refusal is never judged as OK */
  (void)memcpy(wire->serial->status, data.bytes, DSDPV1_STATUS_CELLS);
  wire->serial->known = true;
  return DSDPV1_OK;
}

dsdpv1_error dsdpv1_serial_get(dsdpv1_device* device, const dsdpv1_wire* wire, uint16_t address, uint8_t* bytes,
                               uint8_t length) {
  const uint8_t* cell = dsdpv1_status_cell(wire->serial, address);
  if (cell != NULL && length == 1u) {
    const dsdpv1_error error = dsdpv1_know_status(device, wire);
    if (error == DSDPV1_OK) *bytes = *cell;
    return error;
  }
  dsdpv1_span data = {NULL, 0};
  const dsdpv1_error error = dsdpv1_read_cells(device, wire, address, &data, length);
  if (error == DSDPV1_OK) (void)memcpy(bytes, data.bytes, length);
  return error;
}
