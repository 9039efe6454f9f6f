/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* DPV1: the table of slots and indexes, access rights, handlers (7.2; tables 26 to 29, 31, 32). */
#include <string.h>

#include "dsdpv1_acyclic_internal.h"

/* Error_Code_1 for an admitted request; table 29 has no class 0. */
enum { kAdmitted = 0 };

/* ---------------------------------------------------------------------------------------------------------- checking
 */

static bool may(const dsdpv1_object* object, unsigned service) { return (object->services & service) != 0u; }

static bool has_means(const dsdpv1_object* object) {
  const bool data = object->data != NULL;
  return (!may(object, DSDPV1_MAY_READ) || data || object->read != NULL) &&
         (!may(object, DSDPV1_MAY_WRITE) || data || object->write != NULL) &&
         (!may(object, DSDPV1_MAY_TRANSPORT) ||
          (object->transport != NULL && (object->classes & DSDPV1_CLASS_2) != 0u));
}

static bool object_is_right(const dsdpv1_object* object) {
  const unsigned services = DSDPV1_MAY_READ | DSDPV1_MAY_WRITE | DSDPV1_MAY_TRANSPORT;
  return object->services != 0u && (object->services & ~services) == 0u && object->classes != 0u &&
         (object->classes & ~DSDPV1_CLASS_BOTH) == 0u && object->min_length <= object->max_length &&
         object->max_length <= DSDPV1_MAX_ACYCLIC && has_means(object);
}

static bool same_place(const dsdpv1_object* object, uint8_t slot, uint8_t index) {
  return object->slot == slot && object->index == index;
}

static bool stands_before(const dsdpv1_table* table, size_t place) {
  const dsdpv1_object* object = &table->objects[place];
  for (size_t i = 0; i < place; ++i)
    if (same_place(&table->objects[i], object->slot, object->index)) return true;
  return table->im0 != NULL && same_place(object, kIm0Slot, kIm0Index);
}

dsdpv1_error dsdpv1_check_table(const dsdpv1_table* table) {
  for (size_t i = 0; i < table->count; ++i)
    if (!object_is_right(&table->objects[i]) || stands_before(table, i)) return DSDPV1_ERR_TABLE;
  return table->im0 != NULL ? dsdpv1_check_im0(table->im0) : DSDPV1_OK;
}

/* --------------------------------------------------------------------------------------------------------- admitting
 */

/* Null if there is none; `code` then says what is unknown. */
static const dsdpv1_object* find(const dsdpv1_table* table, uint8_t slot, uint8_t index, uint8_t* code) {
  bool slot_known = table->im0 != NULL && slot == kIm0Slot;
  for (size_t i = 0; i < table->count; ++i) {
    if (same_place(&table->objects[i], slot, index)) return &table->objects[i];
    slot_known = slot_known || table->objects[i].slot == slot;
  }
  *code = slot_known ? DSDPV1_EC_INVALID_INDEX : DSDPV1_EC_INVALID_SLOT;
  return NULL;
}

static uint8_t admit_read(const dsdpv1_object* object, uint8_t length) {
  if (!may(object, DSDPV1_MAY_READ)) return DSDPV1_EC_ACCESS_DENIED;
  return length < object->min_length ? DSDPV1_EC_INVALID_PARAMETER : kAdmitted;
}

static uint8_t admit_data(const dsdpv1_object* object, uint8_t length) {
  return length < object->min_length || length > object->max_length ? DSDPV1_EC_WRITE_LENGTH : kAdmitted;
}

static uint8_t admit(const dsdpv1_object* object, uint8_t master_class, uint8_t function, uint8_t length) {
  if ((object->classes & master_class) == 0u) return DSDPV1_EC_ACCESS_DENIED;
  switch (function) {
    case DSDPV1_DS_READ: return admit_read(object, length);
    case DSDPV1_DS_WRITE: return may(object, DSDPV1_MAY_WRITE) ? admit_data(object, length) : DSDPV1_EC_ACCESS_DENIED;
    case DSDPV1_DS_TRANSPORT:
      return may(object, DSDPV1_MAY_TRANSPORT) ? admit_data(object, length) : DSDPV1_EC_FEATURE_NOT_SUPPORTED;
    default: return DSDPV1_EC_FEATURE_NOT_SUPPORTED;
  }
}

/* A handler serves one request at a time: it is busy until it has answered the other class. */
static bool is_busy(const dsdpv1_channel* other, const dsdpv1_object* object) {
  return other->state == DSDPV1_CHANNEL_OPEN && other->object == object;
}

/* ------------------------------------------------------------------------------------------------------ carrying out
 */

static dsdpv1_handler handler_of(const dsdpv1_object* object, uint8_t function) {
  switch (function) {
    case DSDPV1_DS_READ: return object->read;
    case DSDPV1_DS_WRITE: return object->write;
    default: return object->transport;
  }
}

static uint8_t usual_error(uint8_t function) {
  switch (function) {
    case DSDPV1_DS_READ: return DSDPV1_EC_READ_ERROR;
    case DSDPV1_DS_WRITE: return DSDPV1_EC_WRITE_ERROR;
    default: return DSDPV1_EC_MODULE_FAILURE;
  }
}

static void use_plain_data(dsdpv1_channel* channel, const dsdpv1_object* object) {
  if (channel->request[0] == DSDPV1_DS_READ) {
    (void)memcpy(channel->data, object->data, object->max_length);
    dsdpv1_answer_positive(channel, object->max_length);
  } else {
    (void)memcpy(object->data, channel->data, channel->request[3]);
    dsdpv1_answer_positive(channel, 0);
  }
}

static dsdpv1_error conclude(dsdpv1_channel* channel, dsdpv1_outcome outcome, const dsdpv1_reply* reply) {
  if (outcome == DSDPV1_DEFERRED) {
    channel->state = DSDPV1_CHANNEL_OPEN;
    return DSDPV1_OK;
  }
  if (outcome != DSDPV1_DONE) {
    dsdpv1_answer_negative(channel, reply->error_code_1, reply->error_code_2);
    return DSDPV1_OK;
  }
  if (reply->length > DSDPV1_MAX_ACYCLIC) {
    dsdpv1_answer_negative(channel, usual_error(channel->request[0]), 0);
    return DSDPV1_ERR_ANSWER_LENGTH;
  }
  dsdpv1_answer_positive(channel, reply->length);
  return DSDPV1_OK;
}

static dsdpv1_error carry_out(dsdpv1_channel* channel, uint8_t master_class, const dsdpv1_object* object) {
  const uint8_t* header = channel->request;
  const dsdpv1_handler handler = handler_of(object, header[0]);
  channel->object = object;
  if (handler == NULL) {
    use_plain_data(channel, object);
    return DSDPV1_OK;
  }
  const dsdpv1_request request = {channel->ticket, master_class, header[0],    header[1],
                                  header[2],       header[3],    channel->data};
  dsdpv1_reply reply = {channel->data, 0, usual_error(header[0]), 0};
  const dsdpv1_outcome outcome = handler(object->ctx, &request, &reply);
  return conclude(channel, outcome, &reply);
}

dsdpv1_error dsdpv1_dispatch(dsdpv1_acyclic* acyclic, unsigned number) {
  dsdpv1_channel* channel = &acyclic->channels[number];
  const uint8_t* header = channel->request;
  const dsdpv1_table* table = &acyclic->table;
  if (header[0] == DSDPV1_DS_READ && header[3] > DSDPV1_MAX_ACYCLIC) { /* V9: the chip passes it on */
    dsdpv1_answer_negative(channel, DSDPV1_EC_INVALID_RANGE, 0);
    return DSDPV1_OK;
  }
  if (table->im0 != NULL && header[1] == kIm0Slot && header[2] == kIm0Index) {
    dsdpv1_serve_im0(table->im0, channel);
    return DSDPV1_OK;
  }
  uint8_t code = kAdmitted;
  const dsdpv1_object* object = find(table, header[1], header[2], &code);
  if (object != NULL) code = admit(object, dsdpv1_class_of(number), header[0], header[3]);
  if (code == kAdmitted && is_busy(&acyclic->channels[1u - number], object)) code = DSDPV1_EC_RESOURCE_BUSY;
  if (object == NULL || code != kAdmitted) {
    dsdpv1_answer_negative(channel, code, 0);
    return DSDPV1_OK;
  }
  return carry_out(channel, dsdpv1_class_of(number), object);
}
