/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STATION_H
#define STATION_H
/* The chip: bring-up, INTR0, judging of the master's blocks, diagnosis. */
#include <stdbool.h>

#include "board/firmware/mailbox.h"
#include "driver/dsdpv1.h"

/* Opens the driver with the port of the chip's straps; `parallel` is the board's, or the bench's wrapper of it. */
dsdpv1_device* station_open(const dsdpv1_port* parallel);
/* Waits for the chip and initialises it, repeatedly until that succeeds; then enables INTR0. */
void station_bring_up(void);
/* One attempt. In operation the chip goes through OFFLINE with the new values. Returns false if it keeps the old
 * ones. */
bool station_initialise(const dsdpv1_mailbox_station* station);

/* Judges the master's blocks. */
void station_service(void);
/* As above, if INTR0 fell and the handler could not judge, or does not. */
void station_service_if_pending(void);
/* While paused the handler only notes INTR0. */
void station_pause(bool paused);

/* Passes diagnosis to the chip; `bytes`: those after the six standard bytes. */
void station_set_diagnosis(dsdpv1_diag_type type, const uint8_t* bytes, uint8_t length);
/* Sends a verdict that the judge deferred; `which`: DSDPV1_VERDICT_PRM or _CFG. */
void station_send_verdict(uint8_t which, bool refuse);

#endif /* STATION_H */
