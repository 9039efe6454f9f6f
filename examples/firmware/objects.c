/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Objects by slot and index. */
#include "examples/firmware/objects.h"

#include <stddef.h>
#include <string.h>

#include "driver/dsdpv1_acyclic.h"
#include "examples/firmware/board.h"
#include "examples/firmware/late_answers.h"
#include "examples/firmware/report.h"
#include "examples/firmware/settings.h"

static dsdpv1_acyclic acyclic;
static dsdpv1_object table[DSDPV1_MAILBOX_OBJECTS];
static dsdpv1_im0 im0;
static bool is_open;
static uint64_t polled_at; /* the present poll: an answer's delay starts there */

void objects_answer(uint8_t answering) { settings()->answering = answering; }

/* ----------------------------------------------------------------------------------------------------------- serving
 */

/*
 * A read returns the object's bytes, a write replaces its first ones, a transport writes and returns the previous
 * bytes. Request and reply share their memory, so the request is copied first.
 */
static void carry_out(dsdpv1_mailbox_object* object, const dsdpv1_request* request, uint8_t* data, uint8_t* length) {
  uint8_t before[DSDPV1_MAX_ACYCLIC];
  memcpy(before, object->data, object->length);
  if (request->function != DSDPV1_DS_READ) memcpy(object->data, request->data, request->length);
  if (request->function != DSDPV1_DS_WRITE) {
    memcpy(data, before, object->length);
    *length = object->length;
  }
}

static dsdpv1_outcome serve(void* ctx, const dsdpv1_request* request, dsdpv1_reply* reply) {
  const dsdpv1_mailbox_settings* device = settings();
  if (device->answering == DSDPV1_SAY_NOTHING) return DSDPV1_DEFERRED;
  const bool refuse = device->answering == DSDPV1_SAY_NO;
  if (!refuse) carry_out(ctx, request, reply->data, &reply->length);
  reply->error_code_1 = device->error_code_1;
  reply->error_code_2 = device->error_code_2;
  if (settings_in_cycles()->answer_delay != 0u &&
      late_answers_put(polled_at + settings_in_cycles()->answer_delay, request, reply, refuse))
    return DSDPV1_DEFERRED;
  return refuse ? DSDPV1_FAILED : DSDPV1_DONE;
}

void objects_poll(void) {
  if (!is_open) return;
  polled_at = board_now();
  const dsdpv1_error late = late_answers_send(&acyclic, polled_at);
  const dsdpv1_error polled = dsdpv1_acyclic_poll(&acyclic, NULL);
  report_check(late != DSDPV1_OK ? late : polled, DSDPV1_DURING_ACYCLIC_POLL);
}

/* ----------------------------------------------------------------------------------------------------------- opening
 */

static dsdpv1_object table_line(dsdpv1_mailbox_object* object) {
  const dsdpv1_object line = {
      .slot = object->slot,
      .index = object->index,
      .services = object->services,
      .classes = object->classes,
      .min_length = object->min_length,
      .max_length = object->length,
      .read = serve,
      .write = serve,
      .transport = serve,
      .ctx = object,
  };
  return line;
}

static dsdpv1_im0 nameplate(const dsdpv1_mailbox_nameplate* plate) {
  dsdpv1_im0 result = {
      .manufacturer_id = plate->manufacturer_id,
      .order_id = plate->order_id,
      .serial_number = plate->serial_number,
      .hardware_revision = plate->hardware_revision,
      .software_type = 'V',
      .profile_id = plate->profile_id,
      .version_major = 1,
      .version_minor = 1,
  };
  memcpy(result.software_revision, plate->software_revision, sizeof result.software_revision);
  return result;
}

void objects_open(dsdpv1_device* chip) {
  dsdpv1_mailbox_settings* device = settings();
  if (device->object_count == 0u && device->im0.present == 0u) return;
  for (unsigned i = 0; i < device->object_count; ++i) table[i] = table_line(&device->objects[i]);
  im0 = nameplate(&device->im0);
  const dsdpv1_table lines = {table, device->object_count, device->im0.present != 0u ? &im0 : NULL};
  is_open = report_check(dsdpv1_acyclic_open(&acyclic, chip, &lines), DSDPV1_DURING_ACYCLIC_OPEN);
}
