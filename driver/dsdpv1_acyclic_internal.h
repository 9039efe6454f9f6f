/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_ACYCLIC_INTERNAL_H
#define DSDPV1_ACYCLIC_INTERNAL_H
/* What the driver's DPV1 files share. Not for applications. */
#include "dsdpv1_acyclic.h"
#include "dsdpv1_internal.h"

enum { kChannels = 2, kIm0Slot = 0, kIm0Index = 255 };

/* DSDPV1_CLASS_ bit of channel 0 or 1. */
static inline uint8_t dsdpv1_class_of(unsigned channel) { return (uint8_t)(1u << channel); }

/* --------------------------------------------------------------------------------- finished answers (dsdpv1_answer.c)
 */

/*
 * The positive answer with `length` bytes of the channel's data; more than a read asked for are cut, a write has none.
 * READY afterwards.
 */
void dsdpv1_answer_positive(dsdpv1_channel* channel, uint8_t length);
void dsdpv1_answer_negative(dsdpv1_channel* channel, uint8_t error_code_1, uint8_t error_code_2);
/*
 * One hold, when an answer is ready: writes it and announces it in B011; one whose class has a newer request in B00F is
 * dropped (V13). Notes in `result`. Errors: those of a hold, the answers stay ready.
 */
dsdpv1_error dsdpv1_send_answers(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result);
/* Inside a hold: what has become of answers written earlier. Those with a wrong CRC are READY again. */
void dsdpv1_look_at_sent(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result);
/* Drops everything when the chip has been initialised anew. */
void dsdpv1_forget_old_requests(dsdpv1_acyclic* acyclic, dsdpv1_acyclic_result* result);

/* ----------------------------------------------------------------------------------- the table (dsdpv1_dispatch.c) */

dsdpv1_error dsdpv1_check_table(const dsdpv1_table* table);
/*
 * The request of channel `number`, 0 or 1, is answered (READY) or deferred (OPEN). Errors: ANSWER_LENGTH, with the
 * answer ready.
 */
dsdpv1_error dsdpv1_dispatch(dsdpv1_acyclic* acyclic, unsigned number);

/* ------------------------------------------------------------------------------------------------ I&M0 (dsdpv1_im0.c)
 */

dsdpv1_error dsdpv1_check_im0(const dsdpv1_im0* im0);
/* A request to slot 0, index 255. READY afterwards. */
void dsdpv1_serve_im0(const dsdpv1_im0* im0, dsdpv1_channel* channel);

#endif /* DSDPV1_ACYCLIC_INTERNAL_H */
