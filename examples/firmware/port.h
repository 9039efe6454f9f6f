/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PORT_H
#define PORT_H
/* The driver on the port that the chip's straps have chosen. */
#include "driver/dsdpv1.h"

/* board_start first. `parallel`: the port for a chip that is on the memory bus. */
dsdpv1_error port_open(dsdpv1_device* chip, const dsdpv1_port* parallel, const dsdpv1_judge* judge);

/* Lets at least so much time pass, busy; for the ports. */
void port_pause(void* ctx, uint32_t ns);

/* Bytes that came while the one before them had not been fetched. */
uint32_t port_lost(void);
void port_note_lost(void);

#endif /* PORT_H */
