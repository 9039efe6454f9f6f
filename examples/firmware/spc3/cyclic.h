/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SPC3_CYCLIC_H
#define SPC3_CYCLIC_H
/* Cyclic data: the inputs of the process to the master, the master's outputs to the process. */
#include "driver/spc3/spc3.h"

enum { kInputs = 2, kOutputs = 2 };

/* Hands over inputs: the last outputs. */
void cyclic_give(spc3_device* chip);
/* Fetches outputs. */
void cyclic_fetch(spc3_device* chip);

#endif /* SPC3_CYCLIC_H */
