/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef OBJECTS_H
#define OBJECTS_H
/* DPV1: the objects that masters access by slot and index, and the nameplate (I&M0). */
#include <stdint.h>

#include "driver/dsdpv1.h"

/* Builds the driver's table from the settings; does nothing without objects and nameplate. */
void objects_open(dsdpv1_device* chip);
/* Fetches requests and sends due answers. From the main loop. */
void objects_poll(void);
/* Sets how requests are answered from now on: DSDPV1_SAY_. */
void objects_answer(uint8_t answering);

#endif /* OBJECTS_H */
