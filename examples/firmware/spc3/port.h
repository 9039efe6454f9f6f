/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef SPC3_PORT_H
#define SPC3_PORT_H
/* The driver's port: a byte of the chip at the memory bus. */
#include "driver/spc3/spc3.h"

extern const spc3_port port_stm32;

#endif /* SPC3_PORT_H */
