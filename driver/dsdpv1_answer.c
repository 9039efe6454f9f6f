/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* DPV1: finished answers and their way into the DPRAM (7.2, 7.3; rulings V5, V6, V13, V14). */
#include "dsdpv1_acyclic_internal.h"

/* Destination of an answer, and its CRC bit in B00B. */
typedef struct answer_area {
  uint16_t address, crc;
  uint8_t error_bit;
} answer_area;

static const answer_area kAnswers[kChannels] = {{DSDPV1_REG_C1, DSDPV1_REG_C1_CRC, DSDPV1_REG_CHIP_STATUS_2_C1_CRC},
                                                {DSDPV1_REG_C2, DSDPV1_REG_C2_CRC, DSDPV1_REG_CHIP_STATUS_2_C2_CRC}};

enum { kErrorBit = 0x80 }; /* of Function_Num (tables 27, 32) */

static void note(uint8_t* bits, unsigned channel) { *bits = (uint8_t)(*bits | dsdpv1_class_of(channel)); }

static void make_ready(dsdpv1_channel* channel, uint8_t length) {
  channel->answer_length = length;
  const uint16_t header = dsdpv1_crc(DSDPV1_CRC_START, channel->answer, kAcyclicHeader);
  channel->answer_crc = dsdpv1_crc(header, channel->data, length); /* D3 */
  channel->state = DSDPV1_CHANNEL_READY;
}

void dsdpv1_answer_positive(dsdpv1_channel* channel, uint8_t length) {
  const uint8_t function = channel->request[0];
  const uint8_t asked = channel->request[3];
  const bool too_long = function == DSDPV1_DS_READ && length > asked;
  const uint8_t given = too_long ? asked : length;
  for (unsigned i = 0; i < kAcyclicHeader; ++i)
    channel->answer[i] = channel->request[i]; /* V6; a write answers with the length written (V5) */
  if (function == DSDPV1_DS_WRITE) {
    make_ready(channel, 0);
    return;
  }
  channel->answer[3] = given;
  make_ready(channel, given);
}

void dsdpv1_answer_negative(dsdpv1_channel* channel, uint8_t error_code_1, uint8_t error_code_2) {
  channel->answer[0] = (uint8_t)(channel->request[0] | kErrorBit);
  channel->answer[1] = DSDPV1_ERROR_DECODE;
  channel->answer[2] = error_code_1;
  channel->answer[3] = error_code_2;
  make_ready(channel, 0);
}

/* ----------------------------------------------------------------------------------------------------- into the DPRAM
 */

static bool any_in(const dsdpv1_acyclic* acyclic, dsdpv1_channel_state state) {
  return acyclic->channels[0].state == state || acyclic->channels[1].state == state;
}

/* Inside a hold. An answer that did not reach the chip in a disturbed hold stays ready. */
static void write_answer(dsdpv1_acyclic* acyclic, unsigned i, dsdpv1_acyclic_result* result) {
  dsdpv1_device* device = acyclic->device;
  dsdpv1_channel* channel = &acyclic->channels[i];
  const dsdpv1_block block = {kAnswers[i].address,
                              {channel->answer, kAcyclicHeader},
                              {channel->data, channel->answer_length},
                              kAnswers[i].crc,
                              channel->answer_crc};
  if (device->link->post == NULL)
    dsdpv1_put_block(device, &block);
  else if (device->fault == DSDPV1_OK)
    device->fault = device->link->post(device, &block);
  if (device->fault != DSDPV1_OK) return;
  channel->state = DSDPV1_CHANNEL_SENT;
  note(&result->answered, i);
  if ((channel->answer[0] & kErrorBit) != 0u) note(&result->refused, i);
}

/* Inside a hold. Writes ready answers and returns the bits for B011. */
static unsigned write_answers(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result) {
  const unsigned newer = dsdpv1_get(acyclic->device, DSDPV1_REG_CHIP_COMMAND_2);
  unsigned written = 0;
  for (unsigned i = 0; i < kChannels; ++i) {
    dsdpv1_channel* channel = &acyclic->channels[i];
    if (channel->state != DSDPV1_CHANNEL_READY) continue;
    if ((newer & dsdpv1_class_of(i)) != 0u) { /* writing would destroy the newer request */
      channel->state = DSDPV1_CHANNEL_IDLE;
      note(&result->dropped, i);
    } else {
      write_answer(acyclic, i, result);
      written |= dsdpv1_class_of(i);
    }
  }
  return written;
}

/* A disturbed hold may not have announced these answers: write them again. */
static void take_back(dsdpv1_acyclic* acyclic, unsigned written, dsdpv1_acyclic_result* result) {
  for (unsigned i = 0; i < kChannels; ++i)
    if ((written & dsdpv1_class_of(i)) != 0u) acyclic->channels[i].state = DSDPV1_CHANNEL_READY;
  result->answered = (uint8_t)(result->answered & ~written);
  result->refused = (uint8_t)(result->refused & ~written);
}

dsdpv1_error dsdpv1_send_answers(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result) {
  if (!any_in(acyclic, DSDPV1_CHANNEL_READY)) return DSDPV1_OK;
  dsdpv1_device* device = acyclic->device;
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  const unsigned written = write_answers(acyclic, result);
  if (written != 0u && device->link->post == NULL) {
    const uint8_t command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_2);
    dsdpv1_announce(device, DSDPV1_REG_USER_COMMAND_2, command, 0, (uint8_t)written);
  }
  const dsdpv1_error fault = dsdpv1_release(device);
  if (fault != DSDPV1_OK && device->link->post == NULL) take_back(acyclic, written, result);
  return fault;
}

void dsdpv1_look_at_sent(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result) {
  if (!any_in(acyclic, DSDPV1_CHANNEL_SENT)) return;
  const unsigned waiting = dsdpv1_get(acyclic->device, DSDPV1_REG_USER_COMMAND_2);
  const unsigned wrong = dsdpv1_get(acyclic->device, DSDPV1_REG_CHIP_STATUS_2);
  for (unsigned i = 0; i < kChannels; ++i) {
    dsdpv1_channel* channel = &acyclic->channels[i];
    if (channel->state != DSDPV1_CHANNEL_SENT || (waiting & dsdpv1_class_of(i)) != 0u) continue;
    const bool refused = (wrong & kAnswers[i].error_bit) != 0u;
    channel->state = refused ? DSDPV1_CHANNEL_READY : DSDPV1_CHANNEL_IDLE;
    if (refused) note(&result->repeated, i);
  }
}

static void forget(dsdpv1_channel* channel) {
  channel->state = DSDPV1_CHANNEL_IDLE;
  channel->unread = false;
  channel->im0_called = false;
  channel->ticket = (uint16_t)(channel->ticket + 2u); /* tickets handed out before are stale */
}

void dsdpv1_forget_old_requests(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result) {
  if (acyclic->generation == acyclic->device->generation) return;
  acyclic->generation = acyclic->device->generation;
  for (unsigned i = 0; i < kChannels; ++i) {
    dsdpv1_channel* channel = &acyclic->channels[i];
    if (channel->state == DSDPV1_CHANNEL_OPEN || channel->state == DSDPV1_CHANNEL_READY) note(&result->dropped, i);
    forget(channel);
  }
}
