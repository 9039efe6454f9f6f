/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SPC3_STATION_H
#define SPC3_STATION_H
/* The chip: bring-up, X/INT, judging of the master's blocks, diagnosis. */
#include <stdbool.h>

#include "driver/spc3/spc3.h"

/* Reads the switches (main.c), and opens the driver. */
spc3_device* station_open(void);
/* Initialises the chip, repeatedly until that succeeds, and starts it. By interrupt X/INT is served from now on. */
void station_bring_up(void);
/* True when the chip has gone OFFLINE: bring it up again. */
bool station_is_offline(void);
/* Polled: takes the events. By interrupt the handler has done so. */
void station_service(void);
/* External diagnosis while the key is pressed. From the main loop. */
void station_watch_key(void);

#endif /* SPC3_STATION_H */
