/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* The parallel port: one byte per access, ownership by the handshake pins (5.1). */
#include "dsdpv1_internal.h"

static const dsdpv1_port* port_of(const dsdpv1_device* device) { return &device->port.parallel; }

static void pass_time(const dsdpv1_device* device, uint32_t ns) {
  const dsdpv1_port* port = port_of(device);
  if (port->pause != NULL) port->pause(port->ctx, ns);
}

static bool chip_is_away(const dsdpv1_port* port) {
  const bool req = port->get_l_req(port->ctx);
  const bool sta = port->get_l_sta(port->ctx);
  return !req && !sta;
}

/*
 * Releases the DPRAM: R_REQ = 0 and R_STA = 0 (5.1), in any order (H1). The pause lets the chip's synchronisers see
 * the gap before the next hold. */
static dsdpv1_error lower_lines(dsdpv1_device* device) {
  const dsdpv1_port* port = port_of(device);
  port->set_r_sta(port->ctx, false);
  port->set_r_req(port->ctx, false);
  pass_time(device, DSDPV1_SYNC_WINDOW_NS);
  return DSDPV1_OK;
}

/*
 * H2: the chip may start an access until 3 cycles after R_REQ rose (R_STA has been low since the last release), so
 * one sample of its lines proves nothing. The second sample, or the pause before the first, is later than that.
 */
static bool acquire(dsdpv1_device* device) {
  const dsdpv1_port* port = port_of(device);
  port->set_r_req(port->ctx, true);
  pass_time(device, DSDPV1_SYNC_WINDOW_NS);
  for (uint32_t polls = device->tuning.acquire_polls; polls != 0u; --polls) {
    const bool first = chip_is_away(port);
    if (first && chip_is_away(port)) {
      port->set_r_sta(port->ctx, true);
      return true;
    }
  }
  (void)lower_lines(device);
  return false;
}

/*
 * Note 1 under table 2: the chip sets B006 to 1 at each access, the user adds 1 at each of theirs. A 1 that came
 * from our own count wrapping round is not a sign of the chip.
 */
static void count_access(dsdpv1_device* device) {
  const dsdpv1_port* port = port_of(device);
  const uint8_t count = port->read(port->ctx, DSDPV1_REG_ACCESS_COUNT);
  if (count == 1u && device->last_count != 1u)
    device->absent_holds = 0;
  else if (device->absent_holds < UINT8_MAX)
    ++device->absent_holds;
  device->last_count = (uint8_t)(count + 1u);
  port->write(port->ctx, DSDPV1_REG_ACCESS_COUNT, device->last_count);
}

static dsdpv1_error hold(dsdpv1_device* device) {
  if (!acquire(device)) return DSDPV1_ERR_DPRAM_BUSY;
  count_access(device);
  return DSDPV1_OK;
}

static dsdpv1_error get(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length) {
  const dsdpv1_port* port = port_of(device);
  for (uint8_t i = 0; i < length; ++i) bytes[i] = port->read(port->ctx, (uint16_t)(address + i));
  return DSDPV1_OK;
}

static void put_span(const dsdpv1_port* port, uint16_t address, dsdpv1_span span) {
  for (uint8_t i = 0; i < span.length; ++i) port->write(port->ctx, (uint16_t)(address + i), span.bytes[i]);
}

static dsdpv1_error put(dsdpv1_device* device, uint16_t address, dsdpv1_span head, dsdpv1_span data) {
  put_span(port_of(device), address, head);
  put_span(port_of(device), (uint16_t)(address + head.length), data);
  return DSDPV1_OK;
}

static const dsdpv1_link kParallel = {
    .reads_crc = true, .pause = pass_time, .hold = hold, .release = lower_lines, .get = get, .put = put};

static bool port_is_complete(const dsdpv1_port* port) {
  return port->read != NULL && port->write != NULL && port->set_r_req != NULL && port->set_r_sta != NULL &&
         port->get_l_req != NULL && port->get_l_sta != NULL;
}

dsdpv1_error dsdpv1_open(dsdpv1_device* device, const dsdpv1_port* port, const dsdpv1_judge* judge) {
  if (device == NULL || port == NULL || !port_is_complete(port)) return DSDPV1_ERR_ARGUMENT;
  dsdpv1_open_link(device, &kParallel, judge);
  device->port.parallel = *port;
  device->block_crc = true;
  return DSDPV1_OK;
}
