/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Counters and errors. */
#include "examples/firmware/report.h"

#include <string.h>

#include "examples/firmware/board.h"
#include "examples/firmware/console.h"
#include "examples/firmware/port.h"

static uint32_t printed, printed_lost; /* errors; bytes */

dsdpv1_mailbox_report* report(void) { return &dsdpv1_bench.report; }

/* The INTR0 handler may interrupt the main loop here. */
bool report_check(dsdpv1_error error, uint8_t during) {
  if (error == DSDPV1_OK) return true;
  const uint32_t before = board_lock();
  const uint32_t place = report()->error_count % DSDPV1_MAILBOX_ERRORS;
  report()->errors[place].error = (uint8_t)error;
  report()->errors[place].during = during;
  board_barrier(); /* the count announces the entry written before it */
  ++report()->error_count;
  board_unlock(before);
  return false;
}

void report_outputs(const uint8_t* bytes, uint8_t length) {
  memcpy(report()->outputs, bytes, length);
  report()->output_length = length;
  board_barrier();
  ++report()->outputs_received;
}

void report_print_device(void) {
  const dsdpv1_mailbox_station* station = &settings()->station;
  console_text("DSDPV1 example firmware, station ");
  console_decimal(station->address);
  console_text(", ident ");
  console_hex(station->ident, 4);
  console_text(settings_from_bench() ? ", settings of the bench\r\n" : ", own settings\r\n");
}

static void print_error(uint32_t number) {
  static const char* const kDuring[] = {"wait_ready",    "initialise",   "exchange",     "service",
                                        "set_diagnosis", "send_verdict", "acyclic_open", "acyclic_poll"};
  const uint32_t place = number % DSDPV1_MAILBOX_ERRORS;
  console_text(kDuring[report()->errors[place].during]);
  console_text(": ");
  console_text(dsdpv1_error_text((dsdpv1_error)report()->errors[place].error));
  console_text("\r\n");
}

static void print_lost(uint32_t count) {
  console_text("serial port: ");
  console_decimal(count);
  console_text(" bytes lost, the ones before were fetched too late\r\n");
}

void report_print_errors(void) {
  const uint32_t lost = port_lost();
  if (lost != printed_lost) print_lost(lost);
  printed_lost = lost;
  const uint32_t count = report()->error_count;
  if (count - printed > DSDPV1_MAILBOX_ERRORS) printed = count - DSDPV1_MAILBOX_ERRORS; /* older ones are overwritten */
  while (printed != count) print_error(printed++);
}
