/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_ACYCLIC_INTERNAL_H
#define DSDPV1_ACYCLIC_INTERNAL_H
/* Shared by the driver's DPV1 files. Not for applications. */
#include "dsdpv1_acyclic.h"
#include "dsdpv1_internal.h"

enum { kChannels = 2, kIm0Slot = 0, kIm0Index = 255 };

/* DSDPV1_CLASS_ bit of channel 0 or 1. */
static inline uint8_t dsdpv1_class_of(unsigned channel) { return (uint8_t)(1u << channel); }

/* --------------------------------------------------------------------------------- finished answers (dsdpv1_answer.c)
 */

/*
 * Makes a positive answer from `length` bytes of the channel's data: a read is cut to the length requested, a write
 * has none. READY afterwards.
 */
void dsdpv1_answer_positive(dsdpv1_channel* channel, uint8_t length);
void dsdpv1_answer_negative(dsdpv1_channel* channel, uint8_t error_code_1, uint8_t error_code_2);
/*
 * If an answer is ready, writes and announces it (B011) in one hold; if B00F shows a newer request of its class, the
 * answer is dropped (V13). Updates `result`. Errors: those of a hold, the answers stay ready.
 */
dsdpv1_error dsdpv1_send_answers(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result);
/* Inside a hold: checks answers written earlier. Those with a wrong CRC are READY again. */
void dsdpv1_look_at_sent(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result);
/* Drops all requests and answers after a new initialisation of the chip. */
void dsdpv1_forget_old_requests(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result);

/* ----------------------------------------------------------------------------------- the table (dsdpv1_dispatch.c) */

dsdpv1_error dsdpv1_check_table(const dsdpv1_table* table);
/*
 * Answers (READY) or defers (OPEN) the request of channel `number`, 0 or 1. Errors: ANSWER_LENGTH, with the answer
 * ready.
 */
dsdpv1_error dsdpv1_dispatch(dsdpv1_acyclic* acyclic, unsigned number);

/* ------------------------------------------------------------------------------------------------ I&M0 (dsdpv1_im0.c)
 */

dsdpv1_error dsdpv1_check_im0(const dsdpv1_im0* im0);
/* Serves a request to slot 0, index 255. READY afterwards. */
void dsdpv1_serve_im0(const dsdpv1_im0* im0, dsdpv1_channel* channel);

#endif /* DSDPV1_ACYCLIC_INTERNAL_H */
