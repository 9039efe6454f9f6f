/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef CYCLIC_H
#define CYCLIC_H
/* Cyclic data: the inputs of the process to the master, the master's outputs to the process. */
#include <stdbool.h>

#include "driver/dsdpv1.h"

/* One exchange. True when parameters or configuration wait for judgement. */
bool cyclic_exchange(dsdpv1_device* chip);

/* The configuration that the master has sent says how long the inputs are. Also from the INTR0 handler. */
void cyclic_configured(uint8_t input_length);
/* The chip has been initialised for at most so many inputs; what the master configured before does not count. */
void cyclic_initialised(uint8_t max_input);

/* From now on the inputs are these bytes, with this length as it is; at most 244. */
void cyclic_set_inputs(const uint8_t* bytes, uint8_t length);
/* The next inputs are one byte longer than they ought to be, shorter where the chip takes no longer ones. */
void cyclic_mistake_length(void);

#endif /* CYCLIC_H */
