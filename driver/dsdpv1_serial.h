/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef DSDPV1_SERIAL_H
#define DSDPV1_SERIAL_H
/* Driver state common to the SPI and UART ports of a DSDPV1-RSU. Applications include dsdpv1_spi.h or dsdpv1_uart.h. */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include "dsdpv1.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DSDPV1_STATUS_CELLS 10u /* B00A..B013 */

/* The members are private to the driver. Zero before the port is opened. */
typedef struct dsdpv1_serial {
  uint8_t* bytes; /* the port's buffer in which telegrams are built and parsed */
  bool known;     /* `status` has been read in this hold */
  uint8_t status[DSDPV1_STATUS_CELLS];
  uint8_t error_code;   /* of the last refused telegram, 7.1.6 note 1: bit 0 CRC, 1 address, 2 length of the data, 3 of
                           the telegram */
  uint32_t repetitions; /* repeated telegrams since the port was opened */
} dsdpv1_serial;

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */

#endif /* DSDPV1_SERIAL_H */
