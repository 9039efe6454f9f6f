/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The C API of the DSDPV1 model: libdsdpv1.so. C99, and C++.
 *
 * Each part has its own header; types.h has the common rules for errors, threads, callbacks and structs.
 * docs/c_api.md is the guide, examples/c_api.c a complete program.
 */
#ifndef DPSIM_DSDPV1_H
#define DPSIM_DSDPV1_H

#include "dsdpv1/bus.h"      /* the segment with chips and monitor */
#include "dsdpv1/checks.h"   /* rules of the user's side, from pins of any source */
#include "dsdpv1/chip.h"     /* kinds, pins, parameters; one chip pin by pin */
#include "dsdpv1/gsd.h"      /* GSD files */
#include "dsdpv1/master.h"   /* masters of class 1 and 2 */
#include "dsdpv1/run.h"      /* scenarios */
#include "dsdpv1/telegram.h" /* telegrams as fields, bytes, words */
#include "dsdpv1/types.h"    /* version, errors, time, levels */

#endif
