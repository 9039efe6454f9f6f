/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* The device that this firmware implements on the board. */
#include "examples/firmware/settings.h"

#include <string.h>

#include "driver/dsdpv1_acyclic.h"
#include "examples/firmware/board.h"

dsdpv1_mailbox dsdpv1_bench __attribute__((section(".noinit")));

static bool from_bench;
static settings_times times;

/* --------------------------------------------------------------------------------------- a device without a bench */

/* Two bytes in, two bytes out, for which scenarios/dsdpv1.gsd has modules; the master's outputs come back as inputs. */
static const dsdpv1_mailbox_station own_station = {
    .ident = 0x0CC9,
    .address = 3,
    .address_change = 1,
    .freeze = 1,
    .sync = 1,
    .fail_safe = 1,
    .dpv1 = 1,
    .max_input = DSDPV1_MAX_IO,
    .max_output = DSDPV1_MAX_IO,
    .max_diag = DSDPV1_MAX_DIAG,
    .max_prm = DSDPV1_MAX_PRM,
    .max_cfg = DSDPV1_MAX_CFG,
    .prm_mode = 0,
    .cfg_mode = 1, /* exactly .cfg */
    .cfg_length = 2,
    .cfg = {0x11, 0x21},
};

static const dsdpv1_mailbox_nameplate own_nameplate = {
    .manufacturer_id = 0,
    .hardware_revision = 1,
    .profile_id = 0xF600, /* generic device */
    .present = 1,
    .software_revision = {1, 0, 0},
    .order_id = "DSDPV1-EVAL",
    .serial_number = "000001",
};

static const struct {
  uint8_t slot, index, services, length;
} own_objects[] = {
    {1, 10, DSDPV1_MAY_READ | DSDPV1_MAY_WRITE, 4}, /* limits of the process */
    {1, 11, DSDPV1_MAY_READ, 2},                    /* a measured value */
};

static void fill_own_objects(dsdpv1_mailbox_settings* own) {
  own->object_count = (uint8_t)(sizeof own_objects / sizeof own_objects[0]);
  for (unsigned i = 0; i < own->object_count; ++i) {
    dsdpv1_mailbox_object* object = &own->objects[i];
    object->slot = own_objects[i].slot;
    object->index = own_objects[i].index;
    object->services = own_objects[i].services;
    object->classes = DSDPV1_CLASS_BOTH;
    object->length = own_objects[i].length;
  }
}

static void fill_own(dsdpv1_mailbox_settings* own) {
  own->period_ns = 100000;
  own->retry_delay_ns = 1000000;
  own->inputs = DSDPV1_INPUTS_LOOP_BACK;
  own->overwrite_inputs = 1;
  own->judge_in_handler = 1;
  own->im0 = own_nameplate;
  own->station = own_station;
  fill_own_objects(own);
}

/* ---------------------------------------------------------------------------------------------------------- loading */

static bool filled_by_bench(void) {
  return dsdpv1_bench.magic == DSDPV1_MAILBOX_MAGIC && dsdpv1_bench.version == DSDPV1_MAILBOX_VERSION &&
         dsdpv1_bench.size == sizeof dsdpv1_bench;
}

static void compute_times(void) {
  const dsdpv1_mailbox_settings* loaded = settings();
  times.start_delay = board_cycles(loaded->start_delay_ns);
  times.period = board_cycles(loaded->period_ns);
  times.judge_delay = board_cycles(loaded->judge_delay_ns);
  times.retry_delay = board_cycles(loaded->retry_delay_ns);
  times.answer_delay = board_cycles(loaded->answer_delay_ns);
}

/* Without a bench the mailbox has the RAM's power-on content: its report is cleared here. */
void settings_load(void) {
  from_bench = filled_by_bench();
  if (!from_bench) {
    memset(&dsdpv1_bench, 0, sizeof dsdpv1_bench);
    fill_own(&dsdpv1_bench.settings);
  }
  compute_times();
}

bool settings_from_bench(void) { return from_bench; }

dsdpv1_mailbox_settings* settings(void) { return &dsdpv1_bench.settings; }

const settings_times* settings_in_cycles(void) { return &times; }

dsdpv1_config settings_config(const dsdpv1_mailbox_station* station) {
  const dsdpv1_config config = {
      .address = station->address,
      .ident = station->ident,
      .address_change = station->address_change != 0u,
      .freeze = station->freeze != 0u,
      .sync = station->sync != 0u,
      .fail_safe = station->fail_safe != 0u,
      .dpv1 = station->dpv1 != 0u,
      .max_input = station->max_input,
      .max_output = station->max_output,
      .max_diag = station->max_diag,
      .max_prm = station->max_prm,
      .max_cfg = station->max_cfg,
      .prm_mode = station->prm_mode,
      .cfg_mode = station->cfg_mode,
      .cfg = station->cfg,
      .cfg_length = station->cfg_length,
  };
  return config;
}
