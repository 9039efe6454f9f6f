/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Operation of the chip. */
#include "examples/firmware/station.h"

#include <stddef.h>

#include "examples/firmware/board.h"
#include "examples/firmware/console.h"
#include "examples/firmware/cyclic.h"
#include "examples/firmware/port.h"
#include "examples/firmware/report.h"
#include "examples/firmware/settings.h"

static dsdpv1_device chip;
static volatile bool paused;

/* ----------------------------------------------------------------------------------------------------------- judging
 */

/* A product checks the bytes here. Called from dsdpv1_service, so from the INTR0 handler or the main loop. */
static dsdpv1_verdict judge(uint8_t judgement) {
  ++report()->judgements;
  board_wait(settings_in_cycles()->judge_delay);
  switch (judgement) {
    case DSDPV1_SAY_YES: return DSDPV1_ACCEPT;
    case DSDPV1_SAY_NO: return DSDPV1_REFUSE;
    default: return DSDPV1_LATER;
  }
}

static dsdpv1_verdict judge_prm(void* ctx, const uint8_t* bytes, uint8_t length) {
  (void)ctx;
  (void)bytes;
  (void)length;
  return judge(settings()->prm_judgement);
}

static dsdpv1_verdict judge_cfg(void* ctx, const dsdpv1_cfg_block* cfg) {
  (void)ctx;
  cyclic_configured(cfg->input_length);
  return judge(settings()->cfg_judgement);
}

void station_service(void) {
  const dsdpv1_error error = dsdpv1_service(&chip);
  if (error != DSDPV1_ERR_NESTED) /* not a failure: the interrupted main loop does it */
    report_check(error, DSDPV1_DURING_SERVICE);
}

void station_service_if_pending(void) {
  if (dsdpv1_intr0_pending(&chip)) station_service();
}

static void on_intr0(void) {
  if (settings()->judge_in_handler != 0u && !paused)
    station_service();
  else
    dsdpv1_on_intr0(&chip);
}

void station_pause(bool pause) { paused = pause; }

void station_send_verdict(uint8_t which, bool refuse) {
  report_check(dsdpv1_send_verdict(&chip, which, refuse ? which : 0u), DSDPV1_DURING_SEND_VERDICT);
}

/* ---------------------------------------------------------------------------------------------------------- bring-up
 */

dsdpv1_device* station_open(const dsdpv1_port* parallel) {
  const dsdpv1_judge judges = {NULL, judge_prm, judge_cfg};
  if (port_open(&chip, parallel, &judges) != DSDPV1_OK) board_halt(); /* straps without a card: ADR 0 or 3 */
  return &chip;
}

bool station_initialise(const dsdpv1_mailbox_station* station) {
  const dsdpv1_config config = settings_config(station);
  if (!report_check(dsdpv1_initialise(&chip, &config), DSDPV1_DURING_INITIALISE)) return false;
  ++report()->initialisations;
  cyclic_initialised(station->max_input);
  return true;
}

/* The main loop, which prints errors, has not begun. */
static void wait_for_retry(void) {
  for (const uint64_t end = board_now() + settings_in_cycles()->retry_delay; board_now() < end;) {
    report_print_errors();
    console_poll();
  }
}

void station_bring_up(void) {
  while (!report_check(dsdpv1_wait_ready(&chip), DSDPV1_DURING_WAIT_READY) || !station_initialise(&settings()->station))
    wait_for_retry();
  board_on_intr0(on_intr0);
  station_service(); /* serves events between the initialisation and the line above */
}

/* --------------------------------------------------------------------------------------------------------- diagnosis
 */

void station_set_diagnosis(dsdpv1_diag_type type, const uint8_t* bytes, uint8_t length) {
  report_check(dsdpv1_set_diagnosis(&chip, type, bytes, length), DSDPV1_DURING_SET_DIAGNOSIS);
}
