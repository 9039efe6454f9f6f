/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Reads the chip's blocks with their CRC (4.2, table 7). */
#include "dsdpv1_internal.h"

uint8_t dsdpv1_copy_length(const dsdpv1_area* area, const dsdpv1_copy* copy) {
  const bool read_request = area->header == kAcyclicHeader && copy->header[0] == DSDPV1_REG_FUNCTION_NUM_READ;
  return read_request ? 0u : copy->header[area->header - 1u];
}

static bool fits(const dsdpv1_area* area, const dsdpv1_copy* copy) {
  return dsdpv1_copy_length(area, copy) <= copy->capacity;
}

static uint16_t crc_of(const dsdpv1_area* area, const dsdpv1_copy* copy) {
  const uint16_t header = dsdpv1_crc(DSDPV1_CRC_START, copy->header, area->header);
  return dsdpv1_crc(header, copy->data, dsdpv1_copy_length(area, copy));
}

void dsdpv1_fetch(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy) {
  dsdpv1_get_block(device, area->address, copy->header, area->header);
  if (!fits(area, copy)) return; /* no CRC can make an impossible length right */
  dsdpv1_get_block(device, (uint16_t)(area->address + area->header), copy->data, dsdpv1_copy_length(area, copy));
  copy->crc = device->link->reads_crc ? dsdpv1_get_word(device, area->crc_address) : crc_of(area, copy);
}

static bool is_right(const dsdpv1_area* area, const dsdpv1_copy* copy) { return crc_of(area, copy) == copy->crc; }

/* Inside a hold: reports in B00D how the user found the chip's blocks. */
static void put_user_status(dsdpv1_device* device, uint8_t value) {
  device->user_status_2 = value;
  dsdpv1_put(device, DSDPV1_REG_USER_STATUS_2, value);
}

/* Takes a hold only after an earlier error. */
static dsdpv1_error clear_error(dsdpv1_device* device, const dsdpv1_area* area) {
  if ((device->user_status_2 & area->error_bit) == 0u) return DSDPV1_OK;
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  put_user_status(device, (uint8_t)(device->user_status_2 & ~(unsigned)area->error_bit));
  return dsdpv1_release(device);
}

static dsdpv1_error tell_and_fetch_again(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy) {
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  put_user_status(device, (uint8_t)(device->user_status_2 | area->error_bit));
  dsdpv1_before_fetch(device, area->command, area->flag);
  dsdpv1_fetch(device, area, copy);
  dsdpv1_after_fetch(device, area->command, dsdpv1_get(device, area->command), area->flag);
  return dsdpv1_release(device);
}

dsdpv1_error dsdpv1_confirm(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy) {
  for (uint8_t retries = device->tuning.crc_retries;; --retries) {
    if (!fits(area, copy)) return area->length_error;
    if (is_right(area, copy)) return clear_error(device, area);
    if (retries == 0u) return area->crc_error;
    const dsdpv1_error error = tell_and_fetch_again(device, area, copy);
    if (error != DSDPV1_OK) return error;
  }
}
