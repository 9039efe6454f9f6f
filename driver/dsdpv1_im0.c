/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/*
 * I&M0, the nameplate: a call (write) to slot 0, index 255 selects the subindex, and the next read fetches it
 * (software manual chapter 1; Profile Guidelines part 1, IEC 61158-6 CALL).
 */
#include <string.h>

#include "dsdpv1_acyclic_internal.h"

enum {
  kCallHeader = 4,
  kCall = 0x08,        /* Extended_Function_Num */
  kIm0SubIndex = 65000 /* FI_Index of I&M0 */
};

/* --------------------------------------------------------------------------------------------------------- nameplate
 */

enum { kOrderLength = 20, kSerialLength = 16 };

static bool fits(const char* text, size_t room) { return text != NULL && strlen(text) <= room; }

dsdpv1_error dsdpv1_check_im0(const dsdpv1_im0* im0) {
  return fits(im0->order_id, kOrderLength) && fits(im0->serial_number, kSerialLength) ? DSDPV1_OK : DSDPV1_ERR_IM0;
}

/* Each returns where the next field begins. */
static uint8_t* put_bytes(uint8_t* to, const uint8_t* bytes, size_t length) {
  (void)memcpy(to, bytes, length);
  return to + length;
}

static uint8_t* put_word(uint8_t* to, uint16_t value) {
  const uint8_t bytes[2] = {(uint8_t)(value >> 8), (uint8_t)(value & 0xFFu)};
  return put_bytes(to, bytes, sizeof bytes);
}

static uint8_t* put_text(uint8_t* to, const char* text, size_t room) {
  for (size_t i = 0; i < room; ++i) to[i] = (uint8_t)(*text != '\0' ? *text++ : ' ');
  return to + room;
}

/* Call header and nameplate, 68 bytes; returns their number. */
static uint8_t build_answer(uint8_t* data, const dsdpv1_im0* im0) {
  const uint8_t software_type = (uint8_t)im0->software_type;
  const uint8_t version[2] = {im0->version_major, im0->version_minor};
  const uint8_t call[2] = {kCall, 0};
  uint8_t* to = put_bytes(data, call, sizeof call);
  to = put_word(to, kIm0SubIndex);
  to = put_bytes(to, im0->header, sizeof im0->header);
  to = put_word(to, im0->manufacturer_id);
  to = put_text(to, im0->order_id, kOrderLength);
  to = put_text(to, im0->serial_number, kSerialLength);
  to = put_word(to, im0->hardware_revision);
  to = put_bytes(to, &software_type, 1);
  to = put_bytes(to, im0->software_revision, sizeof im0->software_revision);
  to = put_word(to, im0->revision_counter);
  to = put_word(to, im0->profile_id);
  to = put_word(to, im0->profile_specific_type);
  to = put_bytes(to, version, sizeof version);
  to = put_word(to, im0->supported);
  return (uint8_t)(to - data);
}

/* ---------------------------------------------------------------------------------------------------- call and read */

/* Returns Error_Code_1, 0 if the call is right. */
static uint8_t judge_call(const uint8_t* data, uint8_t length) {
  if (length < kCallHeader) return DSDPV1_EC_WRITE_LENGTH;
  if (data[0] != kCall) return DSDPV1_EC_FEATURE_NOT_SUPPORTED;
  if (data[1] != 0u) return DSDPV1_EC_INVALID_PARAMETER;
  if (((unsigned)data[2] << 8 | data[3]) != kIm0SubIndex) return DSDPV1_EC_INVALID_INDEX;
  return length > kCallHeader ? DSDPV1_EC_ACCESS_DENIED : 0u; /* data after the header: I&M0 is read-only */
}

static void serve_call(dsdpv1_channel* channel) {
  const uint8_t code = judge_call(channel->data, channel->request[3]);
  channel->im0_called = code == 0u;
  if (channel->im0_called)
    dsdpv1_answer_positive(channel, 0);
  else
    dsdpv1_answer_negative(channel, code, 0);
}

static void serve_read(const dsdpv1_im0* im0, dsdpv1_channel* channel) {
  if (!channel->im0_called) {
    dsdpv1_answer_negative(channel, DSDPV1_EC_STATE_CONFLICT, 0);
    return;
  }
  channel->im0_called = false; /* each read needs a call before it */
  dsdpv1_answer_positive(channel, build_answer(channel->data, im0));
}

void dsdpv1_serve_im0(const dsdpv1_im0* im0, dsdpv1_channel* channel) {
  switch (channel->request[0]) {
    case DSDPV1_DS_WRITE: serve_call(channel); break;
    case DSDPV1_DS_READ: serve_read(im0, channel); break;
    default: dsdpv1_answer_negative(channel, DSDPV1_EC_FEATURE_NOT_SUPPORTED, 0); break;
  }
}
