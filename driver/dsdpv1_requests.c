/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* DPV1: fetching requests, and the application's calls (7.2, 7.3). */
#include "dsdpv1_acyclic.h"

#include <string.h>

#include "dsdpv1_acyclic_internal.h"

static const dsdpv1_area kAreas[kChannels] = {
    {DSDPV1_REG_C1, kAcyclicHeader, DSDPV1_REG_C1_CRC, DSDPV1_REG_USER_STATUS_2_C1_CRC, DSDPV1_ERR_C1_LENGTH,
     DSDPV1_ERR_C1_CRC, DSDPV1_REG_CHIP_COMMAND_2, DSDPV1_REG_CHIP_COMMAND_2_C1},
    {DSDPV1_REG_C2, kAcyclicHeader, DSDPV1_REG_C2_CRC, DSDPV1_REG_USER_STATUS_2_C2_CRC, DSDPV1_ERR_C2_LENGTH,
     DSDPV1_ERR_C2_CRC, DSDPV1_REG_CHIP_COMMAND_2, DSDPV1_REG_CHIP_COMMAND_2_C2}};

/* Limits the rounds per call, so that a call stays bounded when masters keep withdrawing and asking. */
enum { kRounds = 3 };

dsdpv1_error dsdpv1_acyclic_open(dsdpv1_acyclic* acyclic, dsdpv1_device* device, const dsdpv1_table* table) {
  if (acyclic == NULL || device == NULL || table == NULL || (table->objects == NULL && table->count != 0u))
    return DSDPV1_ERR_ARGUMENT;
  const dsdpv1_error error = dsdpv1_check_table(table);
  if (error != DSDPV1_OK) return error;
  (void)memset(acyclic, 0, sizeof *acyclic);
  acyclic->device = device;
  acyclic->table = *table;
  acyclic->generation = device->generation;
  acyclic->channels[1].ticket = 1;
  return DSDPV1_OK;
}

/* ----------------------------------------------------------------------------------------------------------- polling
 */

static unsigned unread_requests(const dsdpv1_acyclic* acyclic) {
  unsigned unread = 0;
  for (unsigned i = 0; i < kChannels; ++i) unread |= acyclic->channels[i].unread ? dsdpv1_class_of(i) : 0u;
  return unread;
}

/* A newer request ends the earlier one, in whatever state its answer is (V13). */
static void begin_request(dsdpv1_channel* channel, uint8_t bit, dsdpv1_acyclic_result* result) {
  if (channel->state == DSDPV1_CHANNEL_OPEN || channel->state == DSDPV1_CHANNEL_READY)
    result->dropped = (uint8_t)(result->dropped | bit);
  channel->state = DSDPV1_CHANNEL_IDLE;
  channel->ticket = (uint16_t)(channel->ticket + 2u);
}

static void fetch_request(dsdpv1_acyclic* acyclic, unsigned i, dsdpv1_copy* copy, dsdpv1_acyclic_result* result) {
  dsdpv1_channel* channel = &acyclic->channels[i];
  begin_request(channel, dsdpv1_class_of(i), result);
  copy->data = channel->data;
  copy->capacity = DSDPV1_MAX_ACYCLIC;
  dsdpv1_fetch(acyclic->device, &kAreas[i], copy);
}

/* Inside a hold. */
static void copy_requests(dsdpv1_acyclic* acyclic, dsdpv1_copy copies[kChannels], unsigned flags, unsigned fresh,
                          dsdpv1_acyclic_result* result) {
  dsdpv1_device* device = acyclic->device;
  if ((flags & DSDPV1_CLASS_BOTH) != 0u)
    dsdpv1_before_fetch(device, DSDPV1_REG_CHIP_COMMAND_2, (uint8_t)(flags & DSDPV1_CLASS_BOTH));
  for (unsigned i = 0; i < kChannels; ++i)
    if ((fresh & dsdpv1_class_of(i)) != 0u) fetch_request(acyclic, i, &copies[i], result);
  if ((flags & DSDPV1_CLASS_BOTH) != 0u)
    dsdpv1_after_fetch(device, DSDPV1_REG_CHIP_COMMAND_2, (uint8_t)flags, DSDPV1_CLASS_BOTH);
}

/* Requests left unread by a disturbed hold must be read next time: their flags may be gone. */
static void keep_unread(dsdpv1_acyclic* acyclic, unsigned fresh) {
  for (unsigned i = 0; i < kChannels; ++i)
    if ((fresh & dsdpv1_class_of(i)) != 0u) acyclic->channels[i].unread = true;
}

/* One hold: copies new requests and clears their flags, so that a flag set later means a newer one. */
static dsdpv1_error take_requests(dsdpv1_acyclic* acyclic, dsdpv1_copy copies[kChannels], unsigned* fresh,
                                  dsdpv1_acyclic_result* result) {
  dsdpv1_device* device = acyclic->device;
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  const unsigned flags = dsdpv1_get(device, DSDPV1_REG_CHIP_COMMAND_2);
  *fresh = (flags & DSDPV1_CLASS_BOTH) | unread_requests(acyclic);
  copy_requests(acyclic, copies, flags, *fresh, result);
  if (device->fault == DSDPV1_OK) dsdpv1_look_at_sent(acyclic, result);
  const dsdpv1_error fault = dsdpv1_release(device);
  if (fault != DSDPV1_OK) keep_unread(acyclic, *fresh);
  return fault;
}

/* Called outside a hold. A request that fails its CRC remains pending in the chip and is read again. */
static dsdpv1_error serve(dsdpv1_acyclic* acyclic, unsigned i, dsdpv1_copy* copy, dsdpv1_acyclic_result* result) {
  dsdpv1_channel* channel = &acyclic->channels[i];
  const dsdpv1_error error = dsdpv1_confirm(acyclic->device, &kAreas[i], copy);
  channel->unread = error != DSDPV1_OK;
  if (error != DSDPV1_OK) return error;
  result->received = (uint8_t)(result->received | dsdpv1_class_of(i));
  (void)memcpy(channel->request, copy->header, sizeof channel->request);
  return dsdpv1_dispatch(acyclic, i);
}

/* One round: take, dispatch, answer. `fresh` is not 0 if there may be more to do. */
static dsdpv1_error poll_round(dsdpv1_acyclic* acyclic, unsigned* fresh, dsdpv1_acyclic_result* result) {
  dsdpv1_copy copies[kChannels];
  unsigned taken = 0;
  dsdpv1_error error = take_requests(acyclic, copies, &taken, result);
  *fresh = 0;
  if (error != DSDPV1_OK) return error;
  for (unsigned i = 0; i < kChannels; ++i) {
    if ((taken & dsdpv1_class_of(i)) != 0u) {
      const dsdpv1_error own = serve(acyclic, i, &copies[i], result);
      error = error != DSDPV1_OK ? error : own;
    }
  }
  const uint8_t dropped_before = result->dropped;
  result->dropped = 0;
  const dsdpv1_error send_error = dsdpv1_send_answers(acyclic, result);
  *fresh = result->dropped;
  result->dropped = (uint8_t)(result->dropped | dropped_before);
  return error != DSDPV1_OK ? error : send_error;
}

static unsigned open_requests(const dsdpv1_acyclic* acyclic) {
  unsigned open = 0;
  for (unsigned i = 0; i < kChannels; ++i)
    open |= acyclic->channels[i].state == DSDPV1_CHANNEL_OPEN ? dsdpv1_class_of(i) : 0u;
  return open;
}

dsdpv1_error dsdpv1_acyclic_poll(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result) {
  if (acyclic == NULL || acyclic->device == NULL) return DSDPV1_ERR_ARGUMENT;
  if (!acyclic->device->initialised) return DSDPV1_ERR_NOT_INITIALISED;
  if (acyclic->device->held || acyclic->polling) return DSDPV1_ERR_NESTED;
  dsdpv1_acyclic_result done = {0, 0, 0, 0, 0, 0};
  acyclic->polling = true;
  dsdpv1_forget_old_requests(acyclic, &done);
  unsigned fresh = 1;
  dsdpv1_error error = DSDPV1_OK;
  for (int round = 0; round < kRounds && fresh != 0u && error == DSDPV1_OK; ++round)
    error = poll_round(acyclic, &fresh, &done);
  done.open = (uint8_t)open_requests(acyclic);
  acyclic->polling = false;
  if (result != NULL) *result = done;
  return error;
}

/* ------------------------------------------------------------------------------------------------------ late answers
 */

/* Checks that `ticket` names a request that waits for the application. */
static dsdpv1_error check_ticket(dsdpv1_acyclic* acyclic, uint16_t ticket) {
  if (acyclic->device->held || acyclic->polling) return DSDPV1_ERR_NESTED;
  dsdpv1_acyclic_result ignored = {0, 0, 0, 0, 0, 0};
  dsdpv1_forget_old_requests(acyclic, &ignored);
  const dsdpv1_channel* channel = &acyclic->channels[ticket & 1u];
  if (channel->ticket != ticket) return DSDPV1_ERR_ANSWER_STALE;
  return channel->state == DSDPV1_CHANNEL_OPEN ? DSDPV1_OK : DSDPV1_ERR_NO_REQUEST_OPEN;
}

/* Sends the answer that is ready on the ticket's channel. */
static dsdpv1_error send_late(dsdpv1_acyclic* acyclic, uint16_t ticket) {
  dsdpv1_acyclic_result done = {0, 0, 0, 0, 0, 0};
  acyclic->polling = true;
  const dsdpv1_error error = dsdpv1_send_answers(acyclic, &done);
  acyclic->polling = false;
  if (error != DSDPV1_OK) return error;
  return (done.dropped & dsdpv1_class_of(ticket & 1u)) != 0u ? DSDPV1_ERR_ANSWER_STALE : DSDPV1_OK;
}

dsdpv1_error dsdpv1_acyclic_answer(dsdpv1_acyclic* acyclic, uint16_t ticket, const uint8_t* data, uint8_t length) {
  if (acyclic == NULL || acyclic->device == NULL || (data == NULL && length != 0u)) return DSDPV1_ERR_ARGUMENT;
  if (length > DSDPV1_MAX_ACYCLIC) return DSDPV1_ERR_ANSWER_LENGTH;
  const dsdpv1_error error = check_ticket(acyclic, ticket);
  if (error != DSDPV1_OK) return error;
  dsdpv1_channel* channel = &acyclic->channels[ticket & 1u];
  if (length != 0u) (void)memmove(channel->data, data, length); /* `data` may be the request's */
  dsdpv1_answer_positive(channel, length);
  return send_late(acyclic, ticket);
}

dsdpv1_error dsdpv1_acyclic_refuse(dsdpv1_acyclic* acyclic, uint16_t ticket, uint8_t error_code_1,
                                   uint8_t error_code_2) {
  if (acyclic == NULL || acyclic->device == NULL) return DSDPV1_ERR_ARGUMENT;
  const dsdpv1_error error = check_ticket(acyclic, ticket);
  if (error != DSDPV1_OK) return error;
  dsdpv1_answer_negative(&acyclic->channels[ticket & 1u], error_code_1, error_code_2);
  return send_late(acyclic, ticket);
}
