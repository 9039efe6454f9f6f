/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PORT_H
#define PORT_H
/* The driver on the port selected by the chip's straps. */
#include "driver/dsdpv1.h"

/* Call board_start first. `parallel`: the port for a chip on the memory bus. */
dsdpv1_error port_open(dsdpv1_device* chip, const dsdpv1_port* parallel, const dsdpv1_judge* judge);

/* Busy-waits at least so long; for the ports. */
void port_pause(void* ctx, uint32_t ns);

/* Bytes that arrived before the previous one was fetched. */
uint32_t port_lost(void);
void port_note_lost(void);

#endif /* PORT_H */
