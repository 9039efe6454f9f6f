/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef CYCLIC_H
#define CYCLIC_H
/* Cyclic data: the inputs of the process to the master, the master's outputs to the process. */
#include <stdbool.h>

#include "driver/dsdpv1.h"

/* One exchange. Returns true if parameters or configuration wait for judgement. */
bool cyclic_exchange(dsdpv1_device* chip);

/* The length of the inputs in the master's configuration. Also from the INTR0 handler. */
void cyclic_configured(uint8_t input_length);
/* The chip has been initialised for at most so many inputs; an earlier configuration of the master no longer counts. */
void cyclic_initialised(uint8_t max_input);

/* Sets the inputs from now on to these bytes with exactly this length; at most 244. */
void cyclic_set_inputs(const uint8_t* bytes, uint8_t length);
/* Makes the next inputs one byte too long, or too short if the chip takes no longer ones. */
void cyclic_mistake_length(void);

#endif /* CYCLIC_H */
