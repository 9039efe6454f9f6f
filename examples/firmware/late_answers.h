/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef LATE_ANSWERS_H
#define LATE_ANSWERS_H
/* Acyclic answers that are given some time after their request, as if the data had to be fetched from somewhere. */
#include <stdbool.h>
#include <stdint.h>

#include "driver/dsdpv1_acyclic.h"

/* Keeps an answer until board_now() has reached `due`. False when too many wait already. */
bool late_answers_put(uint64_t due, const dsdpv1_request* request, const dsdpv1_reply* reply, bool refuse);
/* Sends what is due at `now`; the first error. */
dsdpv1_error late_answers_send(dsdpv1_acyclic* acyclic, uint64_t now);

#endif /* LATE_ANSWERS_H */
