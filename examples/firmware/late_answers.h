/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef LATE_ANSWERS_H
#define LATE_ANSWERS_H
/* Acyclic answers given some time after their request, as if the data had to be fetched first. */
#include <stdbool.h>
#include <stdint.h>

#include "driver/dsdpv1_acyclic.h"

/* Keeps an answer until board_now() has reached `due`. Returns false if too many are waiting. */
bool late_answers_put(uint64_t due, const dsdpv1_request* request, const dsdpv1_reply* reply, bool refuse);
/* Sends answers that are due at `now`; returns the first error. */
dsdpv1_error late_answers_send(dsdpv1_acyclic* acyclic, uint64_t now);

#endif /* LATE_ANSWERS_H */
