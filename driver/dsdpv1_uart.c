/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* The UART port: telegrams on a half duplex line, no ownership (UA1 to UA16). */
#include "dsdpv1_uart.h"

#include <string.h>

#include "dsdpv1_serial_internal.h"

enum { kInterval = 7, kTsdr = 11, kCharacterBits = 11, kDrains = 4 };

static uint32_t us_of(const dsdpv1_uart* port, uint32_t bits) { return bits * 1000000u / port->baud + 1u; }

static void pass_time(const dsdpv1_device* device, uint32_t ns) {
  const dsdpv1_uart* port = device->port.uart;
  if (port->pause != NULL) port->pause(port->ctx, ns);
}

/* From the request's end as `send` reports it (at most 12 bit times early) to the end of the reply's first
 * character, plus an access of the chip (UA4, UA6; its start-up takes 43 us). */
static uint32_t reply_timeout_us(const dsdpv1_uart* port) {
  const uint32_t tsdr = port->tsdr != 0u ? port->tsdr : (uint32_t)kTsdr;
  return us_of(port, tsdr + 12u + 2u * kCharacterBits) + 100u;
}

/* Waits out a possible reply, then for the silence that ends the chip's reception (UA3). */
static void recover(const dsdpv1_device* device) {
  dsdpv1_uart* port = device->port.uart;
  const uint32_t halves = port->interval != 0u ? port->interval : (uint32_t)kInterval;
  const uint32_t silence = us_of(port, (halves * kCharacterBits + 1u) / 2u + 2u * kCharacterBits);
  for (int i = 0; i < kDrains; ++i)
    if (port->receive(port->ctx, port->bytes, DSDPV1_UART_TELEGRAM, silence) == 0u) return;
}

/* `receive` returns in the middle of a reply's last stop bit; the chip receives again only after its end (UA16). */
static bool send_telegram(dsdpv1_device* device, uint16_t n) {
  dsdpv1_uart* port = device->port.uart;
  pass_time(device, 1000000000u / port->baud + 1u);
  return port->send(port->ctx, port->bytes, n);
}

static bool transfer(dsdpv1_device* device, uint16_t request, uint16_t most, dsdpv1_response* reply) {
  dsdpv1_uart* port = device->port.uart;
  if (!send_telegram(device, request)) return false;
  reply->bytes = port->bytes;
  reply->length = port->receive(port->ctx, port->bytes, most, reply_timeout_us(port));
  return true;
}

static dsdpv1_wire wire_of(dsdpv1_device* device) {
  dsdpv1_uart* port = device->port.uart;
  const dsdpv1_wire wire = {&port->serial, port->address, transfer, recover};
  return wire;
}

/* --------------------------------------------------------------------------------------------------------- exchanges
 */

enum { kExchangeHead = 5, kFunctionDiagnosis = 0x02, kFunctionDataExchange = 0x01, kFunctionError = 0x80 };

/* 7.1.6 note 3: the content of a reply, and the chip's flag for it, which the reply has cleared. */
typedef struct news {
  uint8_t function;
  uint16_t command;
  uint8_t flag;
} news;

static const news kNews[] = {{0x10, DSDPV1_REG_CHIP_COMMAND_1, DSDPV1_REG_CHIP_COMMAND_1_PRM},
                             {0x20, DSDPV1_REG_CHIP_COMMAND_1, DSDPV1_REG_CHIP_COMMAND_1_CFG},
                             {0x04, DSDPV1_REG_CHIP_COMMAND_2, DSDPV1_REG_CHIP_COMMAND_2_C1},
                             {0x08, DSDPV1_REG_CHIP_COMMAND_2, DSDPV1_REG_CHIP_COMMAND_2_C2}};
enum { kNewsKinds = 4 };
static const news kOutputsCome = {0, DSDPV1_REG_CHIP_COMMAND_1, DSDPV1_REG_CHIP_COMMAND_1_OUTPUT};

/* A reply to an exchange. */
typedef struct answer {
  uint8_t function;
  dsdpv1_span data;
} answer;

static const news* news_of(const answer* reply) {
  for (int i = 0; i < kNewsKinds; ++i)
    if ((reply->function & kNews[i].function) != 0u) return &kNews[i];
  return &kOutputsCome;
}

static uint8_t* noted(dsdpv1_uart* port, uint16_t command) { return &port->news[command - DSDPV1_REG_CHIP_COMMAND_1]; }

/* Puts target, function, address and length before `n` bytes of data already in the port's memory, and the CRC after
 * them. */
static uint16_t wrap(dsdpv1_uart* port, uint16_t address, uint8_t n) {
  const uint8_t head[kExchangeHead] = {(uint8_t)(kStartBoth | port->address),
                                       address == DSDPV1_REG_DIAG ? kFunctionDiagnosis : 0u, (uint8_t)(address >> 8),
                                       (uint8_t)(address & 0xFFu), n};
  (void)memcpy(port->bytes, head, sizeof head);
  return dsdpv1_seal(port->bytes, (uint16_t)(kExchangeHead + n));
}

static dsdpv1_error judge_refusal(dsdpv1_uart* port) {
  const dsdpv1_response reply = {port->bytes, kExchangeHead};
  if (!dsdpv1_sealed(&reply)) return DSDPV1_ERR_REPLY;
  port->serial.error_code = port->bytes[2];
  return DSDPV1_ERR_TELEGRAM;
}

/* The length of the data in the reply. The CRC tells whether the length byte is valid (UA12). */
static dsdpv1_error receive_answer(dsdpv1_uart* port, answer* reply) {
  uint8_t* bytes = port->bytes;
  const uint16_t head = port->receive(port->ctx, bytes, kExchangeHead, reply_timeout_us(port));
  if (head == 0u) return DSDPV1_ERR_NO_REPLY;
  if (head < kExchangeHead || bytes[0] != port->address) return DSDPV1_ERR_REPLY;
  if ((bytes[1] & kFunctionError) != 0u) return judge_refusal(port); /* UA13: five bytes */
  const uint16_t rest = (uint16_t)(bytes[4] + kTelegramCrc);
  if (kExchangeHead + rest > (int)DSDPV1_UART_TELEGRAM) return DSDPV1_ERR_REPLY;
  const uint16_t got = port->receive(port->ctx, bytes + kExchangeHead, rest, reply_timeout_us(port));
  const dsdpv1_response whole = {bytes, (uint16_t)(kExchangeHead + rest)};
  if (got < rest || !dsdpv1_sealed(&whole)) return DSDPV1_ERR_REPLY;
  reply->function = bytes[1];
  reply->data.bytes = bytes + kExchangeHead;
  reply->data.length = bytes[4];
  return DSDPV1_OK;
}

/*
 * If the reply to inputs is destroyed, the chip has still cleared the flag of its content (UA11). That flag is one
 * that was set before and is not set at the next read, or one of a block that has come since: INTR0 tells of parameters
 * and configuration, nothing of requests.
 */
static void note_destroyed(dsdpv1_device* device) {
  dsdpv1_uart* port = device->port.uart;
  for (unsigned i = 0; i < 2u; ++i)
    port->at_risk[i] |= *dsdpv1_status_cell(&port->serial, (uint16_t)(DSDPV1_REG_CHIP_COMMAND_1 + i));
  if (device->intr0_pending) port->at_risk[0] |= DSDPV1_REG_CHIP_COMMAND_1_PRM | DSDPV1_REG_CHIP_COMMAND_1_CFG;
  port->lost = true;
  port->serial.known = false;
}

/* An own answer has bit 7 set or is known. A read that is answered twice does no harm (V14). */
static bool is_request(const uint8_t* bytes, const uint8_t* answered) {
  bool differs = bytes[0] == DSDPV1_REG_FUNCTION_NUM_READ;
  for (unsigned i = 0; i < (unsigned)kAcyclicHeader; ++i) differs = differs || bytes[i] != answered[i];
  return differs && bytes[0] != 0u && (bytes[0] & 0x80u) == 0u;
}

static dsdpv1_error look_for_requests(dsdpv1_device* device) {
  static const uint16_t areas[2] = {DSDPV1_REG_C1, DSDPV1_REG_C2};
  dsdpv1_uart* port = device->port.uart;
  const dsdpv1_wire wire = wire_of(device);
  for (unsigned i = 0; i < 2u; ++i) {
    dsdpv1_span data = {NULL, 0};
    const dsdpv1_error error = dsdpv1_read_cells(device, &wire, areas[i], &data, kAcyclicHeader);
    if (error != DSDPV1_OK) return error;
    if (is_request(data.bytes, port->answered[i])) port->news[1] |= (uint8_t)(1u << i);
  }
  port->lost = false;
  return DSDPV1_OK;
}

static dsdpv1_error know(dsdpv1_device* device) {
  dsdpv1_uart* port = device->port.uart;
  const dsdpv1_wire wire = wire_of(device);
  if (port->serial.known) return DSDPV1_OK;
  dsdpv1_error error = port->lost ? look_for_requests(device) : DSDPV1_OK;
  if (error == DSDPV1_OK) error = dsdpv1_know_status(device, &wire);
  if (error != DSDPV1_OK) return error;
  for (unsigned i = 0; i < 2u; ++i) {
    const unsigned stands = *dsdpv1_status_cell(&port->serial, (uint16_t)(DSDPV1_REG_CHIP_COMMAND_1 + i));
    port->news[i] |= (uint8_t)(port->at_risk[i] & ~stands);
    port->at_risk[i] = 0;
  }
  return DSDPV1_OK;
}

/* The data to exchange. */
typedef struct source {
  uint16_t address;
  const dsdpv1_block* block; /* null: the inputs in the DPRAM */
} source;

/* Copies the inputs into the port's memory, after the head; returns their length. */
static dsdpv1_error present_inputs(dsdpv1_device* device, uint8_t* n) {
  const dsdpv1_wire wire = wire_of(device);
  dsdpv1_span data = {NULL, 0};
  dsdpv1_error error = dsdpv1_read_cells(device, &wire, DSDPV1_REG_INPUT_LENGTH, &data, 1);
  if (error != DSDPV1_OK) return error;
  *n = (uint8_t)((data.bytes[0] <= DSDPV1_MAX_IO ? data.bytes[0] : 0u) + 1u);
  error = dsdpv1_read_cells(device, &wire, DSDPV1_REG_INPUT_LENGTH, &data, *n);
  if (error == DSDPV1_OK) (void)memmove(device->port.uart->bytes + kExchangeHead, data.bytes, *n);
  return error;
}

static dsdpv1_error prepare(dsdpv1_device* device, const source* from, uint8_t* n) {
  if (from->block == NULL) return present_inputs(device, n);
  uint8_t* begin = device->port.uart->bytes + kExchangeHead;
  *n = (uint8_t)(dsdpv1_copy_spans(begin, from->block->head, from->block->data) - begin);
  return DSDPV1_OK;
}

static dsdpv1_error swap_once(dsdpv1_device* device, const source* from, answer* reply) {
  dsdpv1_uart* port = device->port.uart;
  uint8_t n = 0;
  const dsdpv1_error error = prepare(device, from, &n);
  if (error != DSDPV1_OK) return error;
  if (!send_telegram(device, wrap(port, from->address, n))) return DSDPV1_ERR_NO_REPLY;
  return receive_answer(port, reply);
}

/* One exchange, repeated as often as the tuning allows. */
static dsdpv1_error swap(dsdpv1_device* device, const source* from, answer* reply) {
  for (uint8_t retries = device->tuning.telegram_retries;; --retries) {
    const dsdpv1_error error = swap_once(device, from, reply);
    if (error != DSDPV1_OK && from->address == DSDPV1_REG_INPUT_LENGTH) note_destroyed(device);
    if (error == DSDPV1_OK || retries == 0u) return error;
    ++device->port.uart->serial.repetitions;
    recover(device);
  }
}

/* ---------------------------------------------------------------------------------------------------- inputs, outputs
 */

static void keep_outputs(const answer* reply, dsdpv1_copy* outputs, uint16_t crc) {
  const uint8_t length = reply->data.bytes[0];
  outputs->header[0] = length;
  outputs->crc = crc;
  if (length <= outputs->capacity) (void)memcpy(outputs->data, reply->data.bytes + 1, length);
}

/*
 * A reply with outputs clears B00E.0 but does not tell whether they were new. They are if the flag was set before or
 * if they differ from the last ones: then they arrived in between.
 */
static bool take_outputs(dsdpv1_device* device, const answer* reply, dsdpv1_copy* outputs) {
  dsdpv1_uart* port = device->port.uart;
  uint8_t* cell = dsdpv1_status_cell(&port->serial, DSDPV1_REG_CHIP_COMMAND_1);
  uint8_t* note = noted(port, DSDPV1_REG_CHIP_COMMAND_1);
  if (reply->data.length == 0u || reply->data.bytes[0] + 1u != reply->data.length) return false;
  const uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, reply->data.bytes, reply->data.length);
  const bool flagged = ((*cell | *note) & DSDPV1_REG_CHIP_COMMAND_1_OUTPUT) != 0u;
  const bool differ = (reply->function & kFunctionDataExchange) != 0u && crc != port->outputs_crc;
  *cell &= (uint8_t)~DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
  *note &= (uint8_t)~DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
  port->at_risk[0] &= (uint8_t)~DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
  if (!flagged && !differ) return false;
  port->outputs_crc = crc;
  if (outputs != NULL)
    keep_outputs(reply, outputs, crc);
  else
    *note |= DSDPV1_REG_CHIP_COMMAND_1_OUTPUT; /* they are in the DPRAM and have not been fetched */
  return true;
}

/* Exchanges inputs until a reply has no news except `until`, or has outputs. Notes the news of each reply. */
static dsdpv1_error swap_inputs(dsdpv1_device* device, const source* from, const news* until, dsdpv1_copy* outputs,
                                bool* fetched) {
  dsdpv1_uart* port = device->port.uart;
  for (int i = 0; i <= kNewsKinds; ++i) {
    answer reply = {0, {NULL, 0}};
    const dsdpv1_error error = swap(device, from, &reply);
    if (error != DSDPV1_OK) return error;
    const news* found = news_of(&reply);
    if (found == &kOutputsCome) {
      *fetched = take_outputs(device, &reply, outputs);
      break;
    }
    *noted(port, found->command) |= found->flag;
    *dsdpv1_status_cell(&port->serial, found->command) &= (uint8_t)~found->flag;
    if (until != NULL && found->command == until->command && found->flag == until->flag) break;
  }
  *dsdpv1_status_cell(&port->serial, DSDPV1_REG_USER_COMMAND_1) |= DSDPV1_REG_USER_COMMAND_1_INPUT;
  return DSDPV1_OK;
}

static dsdpv1_error exchange(dsdpv1_device* device, const dsdpv1_block* inputs, dsdpv1_copy* outputs, bool* fetched) {
  const source from = {DSDPV1_REG_INPUT_LENGTH, inputs};
  dsdpv1_put_crc(device, inputs);
  if (device->fault != DSDPV1_OK) return device->fault;
  return swap_inputs(device, &from, NULL, outputs, fetched);
}

/* ------------------------------------------------------------------------------------------------------------- flags
 */

static dsdpv1_error get(dsdpv1_device* device, uint16_t address, uint8_t* bytes, uint8_t length) {
  const dsdpv1_wire wire = wire_of(device);
  dsdpv1_error error = dsdpv1_status_cell(wire.serial, address) != NULL ? know(device) : DSDPV1_OK;
  if (error == DSDPV1_OK) error = dsdpv1_serial_get(device, &wire, address, bytes, length);
  const bool flags = address == DSDPV1_REG_CHIP_COMMAND_1 || address == DSDPV1_REG_CHIP_COMMAND_2;
  if (error == DSDPV1_OK && flags) *bytes |= *noted(device->port.uart, address);
  return error;
}

static dsdpv1_error put(dsdpv1_device* device, uint16_t address, dsdpv1_span head, dsdpv1_span data) {
  const dsdpv1_wire wire = wire_of(device);
  const bool flags = address == DSDPV1_REG_CHIP_COMMAND_1 || address == DSDPV1_REG_CHIP_COMMAND_2;
  if (flags) *noted(device->port.uart, address) &= head.bytes[0];
  return dsdpv1_write_cells(device, &wire, address, head, data);
}

static bool stands(dsdpv1_uart* port, const news* kind, uint16_t command, uint8_t flags) {
  return kind->command == command && (kind->flag & flags) != 0u &&
         (*dsdpv1_status_cell(&port->serial, command) & kind->flag) != 0u;
}

/*
 * Flags of B00E and B00F are cleared only by replies: a write telegram could clear one that the chip has just set.
 * So the inputs in the DPRAM are exchanged once more.
 */
static dsdpv1_error take_flags(dsdpv1_device* device, uint16_t command, uint8_t flags) {
  dsdpv1_uart* port = device->port.uart;
  const source from = {DSDPV1_REG_INPUT_LENGTH, NULL};
  dsdpv1_error error = know(device);
  bool fetched = false;
  for (int i = 0; i < kNewsKinds; ++i)
    if (error == DSDPV1_OK && stands(port, &kNews[i], command, flags))
      error = swap_inputs(device, &from, &kNews[i], NULL, &fetched);
  if (error == DSDPV1_OK && stands(port, &kOutputsCome, command, flags))
    error = swap_inputs(device, &from, NULL, NULL, &fetched);
  if (error == DSDPV1_OK) *noted(port, command) &= (uint8_t) ~(unsigned)flags;
  return error;
}

/*
 * The user sets flags of B010 and B011, and the chip clears them in an access, before the next telegram. A flag that
 * was still set when read could be set a second time, so wait for its fall first; B011.6 belongs to the user.
 */
static dsdpv1_error announce(dsdpv1_device* device, uint16_t command, uint8_t clear, uint8_t set) {
  const dsdpv1_wire wire = wire_of(device);
  const unsigned kept = command == DSDPV1_REG_USER_COMMAND_2 ? DSDPV1_REG_USER_COMMAND_2_INPUT_HISTORY : 0u;
  uint8_t value = 0;
  for (int looks = 4; looks != 0; --looks) {
    wire.serial->known = false;
    const dsdpv1_error error = get(device, command, &value, 1);
    if (error != DSDPV1_OK) return error;
    if ((value & ~kept) == 0u) break;
    pass_time(device, device->tuning.poll_pause_ns);
  }
  value = (uint8_t)((value & ~(unsigned)clear) | set);
  const dsdpv1_span head = {&value, 1};
  const dsdpv1_span none = {NULL, 0};
  return put(device, command, head, none);
}

/* Diagnosis and acyclic answers: the chip sets the flag with the block (UA9). Outputs in the reply are ignored. */
static dsdpv1_error post(dsdpv1_device* device, const dsdpv1_block* block) {
  const source from = {block->address, block};
  answer reply = {0, {NULL, 0}};
  dsdpv1_put_crc(device, block);
  if (device->fault != DSDPV1_OK) return device->fault;
  if (block->address != DSDPV1_REG_DIAG)
    (void)memcpy(device->port.uart->answered[block->address == DSDPV1_REG_C2 ? 1u : 0u], block->head.bytes,
                 kAcyclicHeader);
  device->port.uart->serial.known = false; /* the flag is set */
  return swap(device, &from, &reply);
}

/* -------------------------------------------------------------------------------------------------------------- link
 */

static dsdpv1_error hold(dsdpv1_device* device) {
  device->port.uart->serial.known = false;
  return DSDPV1_OK;
}

static dsdpv1_error release(dsdpv1_device* device) {
  (void)device;
  return DSDPV1_OK;
}

static const dsdpv1_link kUart = {.reads_crc = true,
                                  .pause = pass_time,
                                  .hold = hold,
                                  .release = release,
                                  .get = get,
                                  .put = put,
                                  .exchange = exchange,
                                  .post = post,
                                  .take_flags = take_flags,
                                  .announce = announce};

dsdpv1_error dsdpv1_open_uart(dsdpv1_device* device, dsdpv1_uart* port, const dsdpv1_judge* judge) {
  if (device == NULL || port == NULL || port->send == NULL || port->receive == NULL || port->address < 1u ||
      port->address > 2u || port->baud < 9600u || port->baud > 1843200u)
    return DSDPV1_ERR_ARGUMENT;
  dsdpv1_open_link(device, &kUart, judge);
  (void)memset(&port->serial, 0, sizeof port->serial);
  (void)memset(port->news, 0, sizeof port->news);
  (void)memset(port->at_risk, 0, sizeof port->at_risk);
  port->serial.bytes = port->bytes;
  port->outputs_crc = dsdpv1_crc_byte(DSDPV1_CRC_START, 0); /* of empty outputs */
  device->port.uart = port;
  device->block_crc = port->block_crc;
  return DSDPV1_OK;
}
