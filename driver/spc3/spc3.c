/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Bytes and words of the chip, and the calls that are no more than one of them. */
#include "spc3_internal.h"

const char* spc3_error_text(spc3_error error) {
#define SPC3_ERROR_CASE(name, value, text) \
  case name: return text;
  switch (error) {
    SPC3_ERROR_TABLE(SPC3_ERROR_CASE)
    default: return "unknown error";
  }
#undef SPC3_ERROR_CASE
}

spc3_error spc3_open(spc3_device* device, const spc3_port* port, const spc3_application* application) {
  static const spc3_device closed = {0};
  if (device == NULL || port == NULL || port->read == NULL || port->write == NULL) return SPC3_ERR_ARGUMENT;
  *device = closed;
  device->port = *port;
  if (application != NULL) device->application = *application;
  return SPC3_OK;
}

uint8_t spc3_get(const spc3_device* device, uint16_t address) { return device->port.read(device->port.ctx, address); }

void spc3_put(const spc3_device* device, uint16_t address, uint8_t value) {
  device->port.write(device->port.ctx, address, value);
}

uint16_t spc3_get_word(const spc3_device* device, uint16_t address) {
  const uint16_t swapped = device->motorola ? 1u : 0u;
  const uint16_t low = spc3_get(device, (uint16_t)(address + swapped));
  const uint16_t high = spc3_get(device, (uint16_t)(address + 1u - swapped));
  return (uint16_t)((high << 8) | low);
}

void spc3_put_word(const spc3_device* device, uint16_t address, uint16_t value) {
  const uint16_t swapped = device->motorola ? 1u : 0u;
  spc3_put(device, (uint16_t)(address + swapped), (uint8_t)(value & 0xFFu));
  spc3_put(device, (uint16_t)(address + 1u - swapped), (uint8_t)(value >> 8));
}

uint16_t spc3_buffer(const spc3_device* device, uint16_t pointer) {
  return (uint16_t)((uint16_t)spc3_get(device, pointer) << SPC3_SEGMENT_BITS);
}

void spc3_get_bytes(const spc3_device* device, uint16_t address, uint8_t* bytes, uint8_t length) {
  if (device->port.read_array != NULL && length != 0u) {
    device->port.read_array(device->port.ctx, address, bytes, length);
    return;
  }
  for (uint8_t i = 0; i < length; ++i) bytes[i] = spc3_get(device, (uint16_t)(address + i));
}

void spc3_put_bytes(const spc3_device* device, uint16_t address, const uint8_t* bytes, uint8_t length) {
  if (device->port.write_array != NULL && length != 0u) {
    device->port.write_array(device->port.ctx, address, bytes, length);
    return;
  }
  for (uint8_t i = 0; i < length; ++i) spc3_put(device, (uint16_t)(address + i), bytes[i]);
}

void spc3_fill(const spc3_device* device, uint16_t address, uint16_t end, uint8_t value) {
  uint8_t bytes[SPC3_PIECE];
  for (uint8_t i = 0; i < SPC3_PIECE; ++i) bytes[i] = value;
  for (uint16_t each = address; each < end; each = (uint16_t)(each + SPC3_PIECE))
    spc3_put_bytes(device, each, bytes, spc3_piece(each, end));
}

uint8_t spc3_piece(uint16_t address, uint16_t end) {
  const uint16_t left = (uint16_t)(end - address);
  return left < SPC3_PIECE ? (uint8_t)left : (uint8_t)SPC3_PIECE;
}

uint16_t spc3_status(const spc3_device* device) { return spc3_get_word(device, SPC3_REG_STATUS); }

void spc3_serve_watchdog(spc3_device* device) { spc3_put(device, SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_RES_USER_WD); }

void spc3_leave_master(spc3_device* device) { spc3_put(device, SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_USER_LEAVE_MASTER); }

void spc3_go_offline(spc3_device* device) { spc3_put(device, SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_GO_OFFLINE); }
