/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STATION_H
#define STATION_H
/* The chip: bring-up, INTR0, judging of what the master sends, diagnosis. */
#include <stdbool.h>

#include "board/firmware/mailbox.h"
#include "driver/dsdpv1.h"

/* Opens the driver with the port of the chip's straps; `parallel` is the board's, or another one that the bench puts
 * before it. */
dsdpv1_device* station_open(const dsdpv1_port* parallel);
/* Waits for the chip and initialises it, again and again until that succeeds; then INTR0 is heard. */
void station_bring_up(void);
/* Once. In operation the chip goes through OFFLINE with the new values. False: it goes on with those it had. */
bool station_initialise(const dsdpv1_mailbox_station* station);

/* Judges what the master has sent. */
void station_service(void);
/* The same when INTR0 fell and the handler could not do it, or does not judge. */
void station_service_if_pending(void);
/* While paused the handler only notes INTR0. */
void station_pause(bool paused);

/* Hands diagnosis to the chip; `bytes`: what follows the six standard ones. */
void station_set_diagnosis(dsdpv1_diag_type type, const uint8_t* bytes, uint8_t length);
/* A verdict that the judge kept back; `which`: DSDPV1_VERDICT_PRM or _CFG. */
void station_send_verdict(uint8_t which, bool refuse);

#endif /* STATION_H */
