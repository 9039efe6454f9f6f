/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Opening, holds, status, errors, CRC. */
#include "dsdpv1.h"

#include <string.h>

#include "dsdpv1_internal.h"

/* ----------------------------------------------------------------------------------------------------------- errors */

const char* dsdpv1_error_text(dsdpv1_error error) {
  switch (error) {
#define DSDPV1_ERROR_CASE(name, value, text) \
  case name: return text;
    DSDPV1_ERROR_TABLE(DSDPV1_ERROR_CASE)
#undef DSDPV1_ERROR_CASE
    default: return "unknown error";
  }
}

/* -------------------------------------------------------------------------------------------------------------- CRC */

uint16_t dsdpv1_crc_byte(uint16_t crc, uint8_t byte) {
  unsigned value = (unsigned)crc ^ byte;
  for (int bit = 0; bit < 8; ++bit) value = (value & 1u) != 0u ? (value >> 1) ^ 0xA001u : value >> 1;
  return (uint16_t)value;
}

uint16_t dsdpv1_crc(uint16_t crc, const uint8_t* bytes, size_t length) {
  for (size_t i = 0; i < length; ++i) crc = dsdpv1_crc_byte(crc, bytes[i]);
  return crc;
}

/* ---------------------------------------------------------------------------------------------------------- opening */

void dsdpv1_open_link(dsdpv1_device* device, const dsdpv1_link* link, const dsdpv1_judge* judge) {
  (void)memset(device, 0, sizeof *device);
  device->link = link;
  if (judge != NULL) device->judge = *judge;
  device->tuning.acquire_polls = 10000;
  device->tuning.ready_polls = 1000;
  device->tuning.init_polls = 1000;
  device->tuning.poll_pause_ns = 10000;
  device->tuning.crc_retries = 2;
  device->tuning.silent_holds = 8;
  device->tuning.telegram_retries = 2;
}

/* ------------------------------------------------------------------------------------------------------------ DPRAM */

static void put_spans(dsdpv1_device* device, uint16_t address, dsdpv1_span head, dsdpv1_span data) {
  if (device->fault == DSDPV1_OK) device->fault = device->link->put(device, address, head, data);
}

static void put_bytes(dsdpv1_device* device, uint16_t address, const uint8_t* bytes, uint8_t length) {
  const dsdpv1_span head = {bytes, length};
  const dsdpv1_span none = {NULL, 0};
  put_spans(device, address, head, none);
}

static bool is_of_chip(uint16_t address) {
  return address == DSDPV1_REG_CHIP_COMMAND_1 || address == DSDPV1_REG_CHIP_COMMAND_2;
}

static uint8_t* aside_of(dsdpv1_device* device, uint16_t command) {
  return &device->aside.chip_command[command - DSDPV1_REG_CHIP_COMMAND_1];
}

uint8_t dsdpv1_get(dsdpv1_device* device, uint16_t address) {
  uint8_t value = 0;
  dsdpv1_get_block(device, address, &value, 1);
  if (is_of_chip(address) && device->fault == DSDPV1_OK) value = (uint8_t)(value | *aside_of(device, address));
  return value;
}

void dsdpv1_put(dsdpv1_device* device, uint16_t address, uint8_t value) { put_bytes(device, address, &value, 1); }

void dsdpv1_get_block(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length) {
  if (length == 0u) return;
  if (device->fault == DSDPV1_OK) device->fault = device->link->get(device, address, bytes, length);
  if (device->fault != DSDPV1_OK) (void)memset(bytes, 0, length);
}

void dsdpv1_put_block(dsdpv1_device* device, const dsdpv1_block* block) {
  put_spans(device, block->address, block->head, block->data);
  dsdpv1_put_crc(device, block);
}

void dsdpv1_put_crc(dsdpv1_device* device, const dsdpv1_block* block) {
  if (!device->block_crc) return;
  const uint8_t crc[2] = {(uint8_t)(block->crc >> 8), (uint8_t)(block->crc & 0xFFu)};
  put_bytes(device, block->crc_address, crc, sizeof crc);
}

uint16_t dsdpv1_get_word(dsdpv1_device* device, uint16_t address) {
  uint8_t word[2] = {0, 0};
  dsdpv1_get_block(device, address, word, sizeof word);
  return (uint16_t)((unsigned)word[0] << 8 | word[1]);
}

void dsdpv1_before_fetch(dsdpv1_device* device, uint16_t command, uint8_t flags) {
  const dsdpv1_link* link = device->link;
  if (link->take_flags != NULL && device->fault == DSDPV1_OK) device->fault = link->take_flags(device, command, flags);
}

void dsdpv1_after_fetch(dsdpv1_device* device, uint16_t command, uint8_t seen, uint8_t flags) {
  uint8_t* aside = aside_of(device, command);
  if (device->link->take_flags == NULL) dsdpv1_put(device, command, (uint8_t)(seen & ~((unsigned)flags | *aside)));
  if (device->fault == DSDPV1_OK) *aside = (uint8_t)(*aside & ~(unsigned)flags);
}

void dsdpv1_announce(dsdpv1_device* device, uint16_t command, uint8_t seen, uint8_t clear, uint8_t set) {
  const dsdpv1_link* link = device->link;
  if (link->announce == NULL)
    dsdpv1_put(device, command, (uint8_t)((seen & ~(unsigned)clear) | set));
  else if (device->fault == DSDPV1_OK)
    device->fault = link->announce(device, command, clear, set);
}

/* ------------------------------------------------------------------------------------------------------------ holds */

void dsdpv1_poll_pause(const dsdpv1_device* device) { device->link->pause(device, device->tuning.poll_pause_ns); }

void dsdpv1_sync_pause(const dsdpv1_device* device) { device->link->pause(device, DSDPV1_SYNC_WINDOW_NS); }

dsdpv1_error dsdpv1_hold_unjudged(dsdpv1_device* device) {
  if (device->held) return DSDPV1_ERR_NESTED;
  device->held = true;
  device->fault = DSDPV1_OK;
  const dsdpv1_error error = device->link->hold(device);
  if (error != DSDPV1_OK) device->held = false;
  return error;
}

dsdpv1_error dsdpv1_hold(dsdpv1_device* device) {
  const dsdpv1_error error = dsdpv1_hold_unjudged(device);
  if (error != DSDPV1_OK) return error;
  if (device->absent_holds > device->tuning.silent_holds) {
    (void)dsdpv1_release(device);
    return DSDPV1_ERR_CHIP_SILENT;
  }
  return DSDPV1_OK;
}

dsdpv1_error dsdpv1_release(dsdpv1_device* device) {
  const dsdpv1_error fault = device->fault;
  const dsdpv1_error error = device->link->release(device);
  device->held = false;
  return fault != DSDPV1_OK ? fault : error;
}

dsdpv1_error dsdpv1_hold_when_taken(dsdpv1_device* device, uint8_t flag, dsdpv1_error timeout) {
  for (uint32_t polls = device->tuning.init_polls; polls != 0u; --polls) {
    const dsdpv1_error error = dsdpv1_hold(device);
    if (error != DSDPV1_OK) return error;
    const uint8_t command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1);
    if (device->fault == DSDPV1_OK && (command & flag) == 0u) return DSDPV1_OK;
    const dsdpv1_error fault = dsdpv1_release(device);
    if (fault != DSDPV1_OK) return fault;
    dsdpv1_poll_pause(device);
  }
  return timeout;
}

/* ----------------------------------------------------------------------------------------------------------- status */

static uint32_t bit_rate(uint8_t code) { /* table 5 */
  static const uint32_t rates[] = {12000000u, 6000000u, 3000000u, 1500000u, 500000u,
                                   187500u,   93750u,   45450u,   19200u,   9600u};
  return code < sizeof rates / sizeof rates[0] ? rates[code] : 0u;
}

dsdpv1_error dsdpv1_get_status(dsdpv1_device* device, dsdpv1_status* status) {
  if (device == NULL || status == NULL) return DSDPV1_ERR_ARGUMENT;
  dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  dsdpv1_get_block(device, DSDPV1_REG_VERSION, status->version, sizeof status->version);
  status->offline_count = dsdpv1_get_word(device, DSDPV1_REG_OFFLINE_COUNT);
  status->crc_errors = dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_2);
  const uint8_t state = dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_3);
  error = dsdpv1_release(device);
  if (error != DSDPV1_OK) return error;
  status->state =
      (dsdpv1_dp_state)((state & DSDPV1_REG_CHIP_STATUS_3_DP_STATE) >> DSDPV1_REG_CHIP_STATUS_3_DP_STATE_SHIFT);
  status->baud = bit_rate((uint8_t)(state >> DSDPV1_REG_CHIP_STATUS_3_BAUD_RATE_SHIFT));
  return DSDPV1_OK;
}
