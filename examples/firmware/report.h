/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef REPORT_H
#define REPORT_H
/* What has happened so far: counters and errors, for the bench or the debugger, and in words on the serial line. */
#include <stdbool.h>

#include "examples/firmware/settings.h"

/* The counters; who counts writes them. */
dsdpv1_mailbox_report* report(void);
/* Notes an error of the driver; `during`: DSDPV1_DURING_. True when there is none. Also from the INTR0 handler. */
bool report_check(dsdpv1_error error, uint8_t during);
/* The outputs that the master has sent, for the bench. */
void report_outputs(const uint8_t* bytes, uint8_t length);
/* Who this is. */
void report_print_device(void);
/* Errors and bytes lost that came since the last call, in words. From the main loop. */
void report_print_errors(void);

#endif /* REPORT_H */
