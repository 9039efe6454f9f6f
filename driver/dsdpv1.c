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

static bool port_is_complete(const dsdpv1_port* port) {
  return port->read != NULL && port->write != NULL && port->set_r_req != NULL && port->set_r_sta != NULL &&
         port->get_l_req != NULL && port->get_l_sta != NULL;
}

dsdpv1_error dsdpv1_open(dsdpv1_device* device, const dsdpv1_port* port, const dsdpv1_judge* judge) {
  if (device == NULL || port == NULL || !port_is_complete(port)) return DSDPV1_ERR_ARGUMENT;
  memset(device, 0, sizeof *device);
  device->port = *port;
  if (judge != NULL) device->judge = *judge;
  device->tuning.acquire_polls = 10000;
  device->tuning.ready_polls = 1000;
  device->tuning.init_polls = 1000;
  device->tuning.poll_pause_ns = 10000;
  device->tuning.crc_retries = 2;
  device->tuning.silent_holds = 8;
  return DSDPV1_OK;
}

/* ------------------------------------------------------------------------------------------------------------ DPRAM */

uint8_t dsdpv1_get(const dsdpv1_device* device, uint16_t address) {
  return device->port.read(device->port.ctx, address);
}

void dsdpv1_put(const dsdpv1_device* device, uint16_t address, uint8_t value) {
  device->port.write(device->port.ctx, address, value);
}

void dsdpv1_get_block(const dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length) {
  for (uint8_t i = 0; i < length; ++i) bytes[i] = dsdpv1_get(device, (uint16_t)(address + i));
}

void dsdpv1_put_block(const dsdpv1_device* device, uint16_t address, const uint8_t* bytes, uint8_t length) {
  for (uint8_t i = 0; i < length; ++i) dsdpv1_put(device, (uint16_t)(address + i), bytes[i]);
}

uint16_t dsdpv1_get_word(const dsdpv1_device* device, uint16_t address) {
  const unsigned high = dsdpv1_get(device, address);
  const unsigned low = dsdpv1_get(device, (uint16_t)(address + 1u));
  return (uint16_t)(high << 8 | low);
}

void dsdpv1_put_word(const dsdpv1_device* device, uint16_t address, uint16_t value) {
  dsdpv1_put(device, address, (uint8_t)(value >> 8));
  dsdpv1_put(device, (uint16_t)(address + 1u), (uint8_t)(value & 0xFFu));
}

/* ------------------------------------------------------------------------------------------------------------ holds */

static void pass_time(const dsdpv1_device* device, uint32_t ns) {
  if (device->port.pause != NULL) device->port.pause(device->port.ctx, ns);
}

void dsdpv1_poll_pause(const dsdpv1_device* device) { pass_time(device, device->tuning.poll_pause_ns); }

void dsdpv1_sync_pause(const dsdpv1_device* device) { pass_time(device, DSDPV1_SYNC_WINDOW_NS); }

static bool chip_is_away(const dsdpv1_port* port) {
  const bool req = port->get_l_req(port->ctx);
  const bool sta = port->get_l_sta(port->ctx);
  return !req && !sta;
}

/*
 * Releases both lines. Released is R_REQ = 0 and R_STA = 0 (5.1), the order does not matter (H1). The pause lets the
 * chip, whose synchronisers need as long, see the gap before the next hold.
 */
static void lower_lines(const dsdpv1_device* device) {
  device->port.set_r_sta(device->port.ctx, false);
  device->port.set_r_req(device->port.ctx, false);
  dsdpv1_sync_pause(device);
}

/*
 * H2: the chip may start an access until 3 cycles after R_REQ rose (R_STA has been low since the last release), so one
 * look at its lines proves nothing: the second look, or the pause before the first, is later than that.
 */
static bool acquire(const dsdpv1_device* device) {
  const dsdpv1_port* port = &device->port;
  port->set_r_req(port->ctx, true);
  dsdpv1_sync_pause(device);
  for (uint32_t polls = device->tuning.acquire_polls; polls != 0u; --polls) {
    const bool first = chip_is_away(port);
    if (first && chip_is_away(port)) {
      port->set_r_sta(port->ctx, true);
      return true;
    }
  }
  lower_lines(device);
  return false;
}

/*
 * Note 1 under table 2: the chip sets B006 to 1 at each access, the user adds 1 at each of his. A 1 that is our own
 * (the count wrapped round) does not speak for the chip.
 */
static void count_access(dsdpv1_device* device) {
  const uint8_t count = dsdpv1_get(device, DSDPV1_REG_ACCESS_COUNT);
  if (count == 1u && device->last_count != 1u)
    device->absent_holds = 0;
  else if (device->absent_holds < UINT8_MAX)
    ++device->absent_holds;
  device->last_count = (uint8_t)(count + 1u);
  dsdpv1_put(device, DSDPV1_REG_ACCESS_COUNT, device->last_count);
}

dsdpv1_error dsdpv1_hold_unjudged(dsdpv1_device* device) {
  if (device->held) return DSDPV1_ERR_NESTED;
  device->held = true;
  if (!acquire(device)) {
    device->held = false;
    return DSDPV1_ERR_DPRAM_BUSY;
  }
  count_access(device);
  return DSDPV1_OK;
}

dsdpv1_error dsdpv1_hold(dsdpv1_device* device) {
  const dsdpv1_error error = dsdpv1_hold_unjudged(device);
  if (error != DSDPV1_OK) return error;
  if (device->absent_holds > device->tuning.silent_holds) {
    dsdpv1_release(device);
    return DSDPV1_ERR_CHIP_SILENT;
  }
  return DSDPV1_OK;
}

void dsdpv1_release(dsdpv1_device* device) {
  lower_lines(device);
  device->held = false;
}

dsdpv1_error dsdpv1_hold_when_taken(dsdpv1_device* device, uint8_t flag, dsdpv1_error timeout) {
  for (uint32_t polls = device->tuning.init_polls; polls != 0u; --polls) {
    const dsdpv1_error error = dsdpv1_hold(device);
    if (error != DSDPV1_OK) return error;
    if ((dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1) & flag) == 0u) return DSDPV1_OK;
    dsdpv1_release(device);
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
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  dsdpv1_get_block(device, DSDPV1_REG_VERSION, status->version, sizeof status->version);
  status->offline_count = dsdpv1_get_word(device, DSDPV1_REG_OFFLINE_COUNT);
  status->crc_errors = dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_2);
  const uint8_t state = dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_3);
  dsdpv1_release(device);
  status->state =
      (dsdpv1_dp_state)((state & DSDPV1_REG_CHIP_STATUS_3_DP_STATE) >> DSDPV1_REG_CHIP_STATUS_3_DP_STATE_SHIFT);
  status->baud = bit_rate((uint8_t)(state >> DSDPV1_REG_CHIP_STATUS_3_BAUD_RATE_SHIFT));
  return DSDPV1_OK;
}
