/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Inputs and outputs. */
#include "examples/firmware/spc3/cyclic.h"

static uint8_t process[kOutputs]; /* what the process has */

void cyclic_give(spc3_device* chip) { (void)spc3_set_inputs(chip, process, kInputs); }

void cyclic_fetch(spc3_device* chip) {
  spc3_outputs outputs = {.bytes = process, .capacity = sizeof process};
  (void)spc3_get_outputs(chip, &outputs); /* cleared outputs are zeros: this process has no other safe state */
}
