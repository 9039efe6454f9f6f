/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* A frame to the module and its answer (tables 4.3 to 4.5). */
#include "driver/xgate/xgate.h"

enum { kStart = 0x7E, kHead = 4, kErrorFlag = 0x80, kPrintedError = 0x83, kErrorLength = 3, kMostSkipped = 4096 };

static uint8_t xor_of(uint8_t sum, const uint8_t* bytes, uint16_t length) {
  uint16_t i;
  for (i = 0; i < length; ++i) sum = (uint8_t)(sum ^ bytes[i]);
  return sum;
}

static bool receive(xgate_module* module, uint16_t ms, uint8_t* byte) {
  const int got = module->port.receive(module->port.context, ms);
  *byte = (uint8_t)got;
  return got >= 0;
}

/* Skips what comes before the start of an answer. */
static bool receive_start(xgate_module* module) {
  uint16_t skipped;
  uint8_t byte = 0;
  for (skipped = 0; skipped < (uint16_t)kMostSkipped; ++skipped) {
    if (!receive(module, module->settings.answer_ms, &byte)) return false;
    if (byte == (uint8_t)kStart) return true;
  }
  return false;
}

static bool receive_bytes(xgate_module* module, uint8_t* bytes, uint16_t length) {
  uint16_t i;
  for (i = 0; i < length; ++i)
    if (!receive(module, module->settings.byte_ms, &bytes[i])) return false;
  return true;
}

/* Reads class, code, spare byte and XOR of an error in the printed form; else the same bytes are data. */
static bool printed_error(xgate_module* module, const uint8_t* head, bool* complete) {
  xgate_frame* answer = &module->answer;
  uint8_t check = 0;
  *complete = receive_bytes(module, answer->data, kErrorLength) && receive_bytes(module, &check, 1u);
  answer->data[kErrorLength] = check;
  return *complete && (answer->data[0] >= 1u) && (answer->data[0] <= 4u) &&
         (check == xor_of(xor_of(0u, head, kHead), answer->data, kErrorLength));
}

static bool receive_answer(xgate_module* module) {
  xgate_frame* answer = &module->answer;
  uint8_t head[4] = {kStart, 0, 0, 0};
  uint8_t check = 0;
  uint16_t read = 0;
  if (!receive_start(module) || !receive_bytes(module, &head[1], 3u)) return false;
  answer->command = head[1];
  answer->length = head[2];
  answer->special = head[3];
  if (module->settings.printed_errors && (head[2] == (uint8_t)kPrintedError)) {
    bool complete = false;
    if (printed_error(module, head, &complete)) {
      answer->length = kErrorLength;
      answer->special |= (uint8_t)kErrorFlag;
      return true;
    }
    if (!complete) return false;
    read = kErrorLength + 1;
  }
  if (!receive_bytes(module, &answer->data[read], (uint16_t)(answer->length - read)) ||
      !receive_bytes(module, &check, 1u))
    return false;
  return check == xor_of(xor_of(0u, head, kHead), answer->data, answer->length);
}

/* After a damaged answer: what still comes of it. */
static void drain(xgate_module* module) {
  uint16_t left = XGATE_MAX_DATA + 5u;
  uint8_t byte = 0;
  while ((left > 0u) && receive(module, module->settings.byte_ms, &byte)) --left;
}

bool xgate_transfer(xgate_module* module) {
  const xgate_frame* command = &module->command;
  const uint8_t head[4] = {kStart, command->command, command->length, command->special};
  const uint8_t check = xor_of(xor_of(0u, head, kHead), command->data, command->length);
  void* const context = module->port.context;
  module->port.send(context, head, kHead);
  if (command->length > 0u) module->port.send(context, command->data, command->length);
  module->port.send(context, &check, 1u);
  if (receive_answer(module)) return true;
  drain(module);
  return false;
}
