/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef REPORT_H
#define REPORT_H
/* Counters and errors so far, for the bench or the debugger, and as text on the serial line. */
#include <stdbool.h>

#include "examples/firmware/settings.h"

/* The counters; each is updated where it is counted. */
dsdpv1_mailbox_report* report(void);
/* Notes an error of the driver; `during`: DSDPV1_DURING_. Returns true without an error. Also from the INTR0
 * handler. */
bool report_check(dsdpv1_error error, uint8_t during);
/* The master's outputs, for the bench. */
void report_outputs(const uint8_t* bytes, uint8_t length);
/* Prints the device's name. */
void report_print_device(void);
/* Prints errors and lost bytes since the last call. From the main loop. */
void report_print_errors(void);

#endif /* REPORT_H */
