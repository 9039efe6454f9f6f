/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef FAULT_KEY_H
#define FAULT_KEY_H
/* The board's key simulates a fault of the process: diagnosis comes and goes with it. */

/* From the main loop. */
void fault_key_watch(void);

#endif /* FAULT_KEY_H */
