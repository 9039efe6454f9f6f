/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* The SPI port: telegrams in frames of XSS, ownership by B014 (SP1 to SP18). */
#include "dsdpv1_spi.h"

#include <string.h>

#include "dsdpv1_serial_internal.h"

enum { kIdle = 0xFF };

static void pass_time(const dsdpv1_device* device, uint32_t ns) {
  const dsdpv1_spi* port = device->port.spi;
  if (port->pause != NULL) port->pause(port->ctx, ns);
}

static void recover(const dsdpv1_device* device) { pass_time(device, 2700); /* SP9 */ }

/* Request and reply are one frame (SP7). Before the reply MISO gives FF, and no reply begins with it (SP6). */
static bool transfer(dsdpv1_device* device, uint16_t request, uint16_t most, dsdpv1_response* reply) {
  dsdpv1_spi* port = device->port.spi;
  const uint16_t n = (uint16_t)(request + most + port->spare);
  (void)memset(port->bytes + request, 0, (size_t)(n - request));
  if (!port->exchange(port->ctx, port->bytes, port->bytes, n)) return false;
  uint16_t first = request;
  while (first < n && port->bytes[first] == kIdle) ++first;
  reply->bytes = port->bytes + first;
  reply->length = (uint16_t)(n - first);
  return true;
}

static dsdpv1_wire wire_of(dsdpv1_device* device) {
  dsdpv1_spi* port = device->port.spi;
  const dsdpv1_wire wire = {&port->serial, port->address, transfer, recover};
  return wire;
}

static dsdpv1_error write_ownership(dsdpv1_device* device, uint8_t value) {
  const dsdpv1_wire wire = wire_of(device);
  const dsdpv1_span head = {&value, 1};
  const dsdpv1_span none = {NULL, 0};
  return dsdpv1_write_cells(device, &wire, DSDPV1_REG_OWNERSHIP, head, none);
}

static dsdpv1_error release(dsdpv1_device* device) { return write_ownership(device, 0); }

/*
 * SP12, SP13. Reading B014 before the claim would cost a telegram and prove nothing, since the chip may start after
 * it; the reply to the claim tells. If that reply is destroyed, the claim may still stand.
 */
static dsdpv1_error hold(dsdpv1_device* device) {
  dsdpv1_error error = DSDPV1_ERR_DPRAM_BUSY;
  device->port.spi->serial.known = false;
  for (uint32_t polls = device->tuning.acquire_polls; polls != 0u && error == DSDPV1_ERR_DPRAM_BUSY; --polls)
    error = write_ownership(device, DSDPV1_REG_OWNERSHIP_HOST);
  if (error == DSDPV1_ERR_REPLY) release(device);
  return error;
}

static dsdpv1_error get(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length) {
  const dsdpv1_wire wire = wire_of(device);
  return dsdpv1_serial_get(device, &wire, address, bytes, length);
}

static dsdpv1_error put(dsdpv1_device* device, uint16_t address, dsdpv1_span head, dsdpv1_span data) {
  const dsdpv1_wire wire = wire_of(device);
  return dsdpv1_write_cells(device, &wire, address, head, data);
}

/* SP16: sets B010.0, clears B00E.0. The outputs are new if B00E.0 was 1, because no other agent can access it in the
 * hold. */
static dsdpv1_error read_and_write(dsdpv1_device* device, const dsdpv1_block* inputs, dsdpv1_copy* outputs) {
  const dsdpv1_wire wire = wire_of(device);
  const dsdpv1_order order = {kStartBoth, 0, inputs->head, inputs->data, 0, (uint8_t)(device->max_output + 1u)};
  dsdpv1_span data = {NULL, 0};
  const dsdpv1_error error = dsdpv1_transact(device, &wire, &order, &data);
  if (error != DSDPV1_OK) return error;
  *dsdpv1_status_cell(wire.serial, DSDPV1_REG_USER_COMMAND_1) |= DSDPV1_REG_USER_COMMAND_1_INPUT;
  *dsdpv1_status_cell(wire.serial, DSDPV1_REG_CHIP_COMMAND_1) &= (uint8_t)~DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
  outputs->header[0] = data.bytes[0];
  outputs->crc = dsdpv1_crc(DSDPV1_CRC_START, data.bytes, data.length);
  if (data.bytes[0] <= outputs->capacity) (void)memcpy(outputs->data, data.bytes + 1, data.bytes[0]);
  return DSDPV1_OK;
}

static dsdpv1_error exchange(dsdpv1_device* device, const dsdpv1_block* inputs, dsdpv1_copy* outputs, bool* fetched) {
  const uint8_t command = dsdpv1_get(device, DSDPV1_REG_CHIP_COMMAND_1);
  *fetched = (command & DSDPV1_REG_CHIP_COMMAND_1_OUTPUT) != 0u;
  if (*fetched) {
    dsdpv1_put_crc(device, inputs);
    return device->fault != DSDPV1_OK ? device->fault : read_and_write(device, inputs, outputs);
  }
  const uint8_t waiting = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1);
  dsdpv1_put_block(device, inputs);
  dsdpv1_announce(device, DSDPV1_REG_USER_COMMAND_1, waiting, 0, DSDPV1_REG_USER_COMMAND_1_INPUT);
  return device->fault;
}

static const dsdpv1_link kSpi = {
    .pause = pass_time, .hold = hold, .release = release, .get = get, .put = put, .exchange = exchange};

dsdpv1_error dsdpv1_open_spi(dsdpv1_device* device, dsdpv1_spi* port, const dsdpv1_judge* judge) {
  if (device == NULL || port == NULL || port->exchange == NULL || port->address < 1u || port->address > 2u ||
      port->spare > DSDPV1_SPI_SPARE)
    return DSDPV1_ERR_ARGUMENT;
  dsdpv1_open_link(device, &kSpi, judge);
  (void)memset(&port->serial, 0, sizeof port->serial);
  port->serial.bytes = port->bytes;
  device->port.spi = port;
  device->block_crc = port->block_crc;
  return DSDPV1_OK;
}
