/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Inputs and outputs. */
#include "examples/firmware/cyclic.h"

#include <string.h>

#include "examples/firmware/report.h"
#include "examples/firmware/settings.h"

enum { kUnknown = -1 };

static volatile int16_t configured_length = kUnknown; /* of the inputs; the INTR0 handler writes it */
static uint8_t outputs[DSDPV1_MAX_IO], output_length; /* as the process has them */
static uint8_t commanded[DSDPV1_MAX_IO], commanded_length;
static bool is_commanded;
static uint8_t exchanges; /* modulo 256: the value for DSDPV1_INPUTS_COUNT */
static uint8_t longest;   /* input length that the chip accepts */
static bool wrong_length; /* of the next inputs */

void cyclic_configured(uint8_t input_length) { configured_length = input_length; }

void cyclic_initialised(uint8_t max_input) {
  longest = max_input;
  configured_length = kUnknown;
}

void cyclic_mistake_length(void) { wrong_length = true; }

void cyclic_set_inputs(const uint8_t* bytes, uint8_t length) {
  commanded_length = length < DSDPV1_MAX_IO ? length : (uint8_t)DSDPV1_MAX_IO;
  memcpy(commanded, bytes, commanded_length);
  is_commanded = true;
}

/* ----------------------------------------------------------------------------------------------------------- inputs */

typedef struct inputs {
  uint8_t length, bytes[DSDPV1_MAX_IO];
} inputs;

/* The first bytes of `source`, followed by zeros. */
static void take(inputs* target, const uint8_t* source, uint8_t length) {
  const uint8_t taken = length < target->length ? length : target->length;
  memcpy(target->bytes, source, taken);
  memset(target->bytes + taken, 0, (size_t)(target->length - taken));
}

/* Samples the process: here the last outputs, a count, or bytes from the settings. */
static void sample(inputs* target) {
  const dsdpv1_mailbox_settings* device = settings();
  switch (device->inputs) {
    case DSDPV1_INPUTS_COUNT: memset(target->bytes, exchanges++, target->length); break;
    case DSDPV1_INPUTS_LOOP_BACK: take(target, outputs, output_length); break;
    default: take(target, device->constant, device->constant_length); break;
  }
}

static void make_length_wrong(inputs* target) {
  if (target->length < longest)
    target->bytes[target->length++] = 0;
  else if (target->length != 0u)
    --target->length;
}

static void next_inputs(inputs* target, int16_t length) {
  if (is_commanded) {
    target->length = commanded_length;
    memcpy(target->bytes, commanded, commanded_length);
  } else {
    target->length = length == kUnknown ? 0u : (uint8_t)length;
    sample(target);
  }
  if (wrong_length) {
    wrong_length = false;
    make_length_wrong(target);
  }
}

/* Before the master has sent a configuration the length of the inputs is unknown (D10). */
static bool are_known(int16_t length) {
  return is_commanded || (length != kUnknown && settings()->inputs != DSDPV1_INPUTS_IDLE);
}

/* --------------------------------------------------------------------------------------------------------- exchange */

/* The process gets a copy: the exchange's buffer is only valid with new outputs. */
static void drive_process(const uint8_t* bytes, uint8_t length) {
  memcpy(outputs, bytes, length);
  output_length = length;
  report_outputs(bytes, length);
}

bool cyclic_exchange(dsdpv1_device* chip) {
  uint8_t received[DSDPV1_MAX_IO];
  dsdpv1_exchange_result result = {.outputs = received, .capacity = sizeof received};
  const int16_t length = configured_length; /* read once: the INTR0 handler may change it */
  inputs next;
  next_inputs(&next, length);
  const dsdpv1_input_policy policy =
      settings()->overwrite_inputs != 0u ? DSDPV1_INPUT_NEWEST : DSDPV1_INPUT_WHEN_CONSUMED;
  ++report()->exchanges;
  report_check(dsdpv1_exchange(chip, policy, are_known(length) ? next.bytes : NULL, next.length, &result),
               DSDPV1_DURING_EXCHANGE);
  if (result.inputs_written) ++report()->inputs_written;
  if (result.outputs_new) drive_process(received, result.length);
  return result.intr0_missed;
}
