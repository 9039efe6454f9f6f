/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef OBJECTS_H
#define OBJECTS_H
/* DPV1: what masters reach by slot and index, and the nameplate (I&M0). */
#include <stdint.h>

#include "driver/dsdpv1.h"

/* Makes the driver's table of the settings; nothing at all when they have no objects and no nameplate. */
void objects_open(dsdpv1_device* chip);
/* Fetches requests and answers what is due. From the main loop. */
void objects_poll(void);
/* How requests are answered from now on: DSDPV1_SAY_. */
void objects_answer(uint8_t answering);

#endif /* OBJECTS_H */
