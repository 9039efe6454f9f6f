/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* A ring of answers in order of their times. */
#include "examples/firmware/late_answers.h"

#include <string.h>

/*
 * Two requests can be open, one of each class. A withdrawn one keeps its place until its time, and a master may ask
 * again meanwhile.
 */
enum { kPlaces = 8 };

typedef struct late_answer {
  uint64_t due;
  uint16_t ticket;
  bool refuse;
  uint8_t error_code_1, error_code_2;
  uint8_t length, data[DSDPV1_MAX_ACYCLIC];
} late_answer;

static late_answer answers[kPlaces];
static unsigned first, count;

static uint8_t lesser(uint8_t a, uint8_t b) { return a < b ? a : b; }

bool late_answers_put(uint64_t due, const dsdpv1_request* request, const dsdpv1_reply* reply, bool refuse) {
  if (count == kPlaces) return false;
  late_answer* answer = &answers[(first + count++) % kPlaces];
  answer->due = due;
  answer->ticket = request->ticket;
  answer->refuse = refuse;
  answer->error_code_1 = reply->error_code_1;
  answer->error_code_2 = reply->error_code_2;
  answer->length = request->function == DSDPV1_DS_READ ? lesser(reply->length, request->length) : reply->length;
  memcpy(answer->data, reply->data, answer->length);
  return true;
}

static dsdpv1_error send(dsdpv1_acyclic* acyclic, const late_answer* answer) {
  return answer->refuse ? dsdpv1_acyclic_refuse(acyclic, answer->ticket, answer->error_code_1, answer->error_code_2)
                        : dsdpv1_acyclic_answer(acyclic, answer->ticket, answer->data, answer->length);
}

dsdpv1_error late_answers_send(dsdpv1_acyclic* acyclic, uint64_t now) {
  dsdpv1_error result = DSDPV1_OK;
  while (count != 0u && answers[first].due <= now) {
    const dsdpv1_error error = send(acyclic, &answers[first]);
    first = (first + 1u) % kPlaces;
    --count;
    result = result != DSDPV1_OK ? result : error;
  }
  return result;
}
