/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Events of the chip: parameters, configuration, address, Global_Control (4.3, 5.2). */
#include "spc3_internal.h"

/* Limits a call while the master keeps sending. The rest raises the interrupt again, or the next poll sees it. */
enum { kRounds = 4 };

enum { kPrmTsdr = 3 }; /* min_TSDR in Set_Prm */

static unsigned dp_state(const spc3_device* device) {
  return ((unsigned)spc3_status(device) & SPC3_REG_STATUS_DP_STATE) >> SPC3_REG_STATUS_DP_STATE_SHIFT;
}

static uint8_t answer(const spc3_device* device, uint16_t command) {
  return spc3_get(device, command) & SPC3_REG_VERDICT_ANSWER;
}

/* Copies the block of the length and pointer cells. The pointer is another after each telegram (A22). */
static uint8_t fetch(spc3_device* device, uint16_t length_cell, uint16_t pointer) {
  uint8_t length = spc3_get(device, length_cell);
  if (length > SPC3_MAX_BLOCK) length = SPC3_MAX_BLOCK;
  spc3_get_bytes(device, spc3_buffer(device, pointer), device->block, length);
  return length;
}

/* A conflict is a newer Set_Prm in the buffer: its event stays set, and the next round judges it (A14). */
static void judge_prm(spc3_device* device) {
  const spc3_application* app = &device->application;
  const uint8_t length = fetch(device, SPC3_REG_ORG_PRM_LENGTH, SPC3_REG_ORG_PRM_POINTER);
  const bool right = app->prm == NULL || app->prm(app->ctx, device->block, length);
  if (right && length >= SPC3_MIN_PRM) device->prm_tsdr = device->block[kPrmTsdr];
  (void)answer(device, right ? SPC3_REG_PRM_OK : SPC3_REG_PRM_NOT_OK);
}

static bool is_read_cfg(const spc3_device* device, const spc3_cfg* cfg) {
  if (cfg->length != spc3_get(device, SPC3_REG_ORG_READ_CFG_LENGTH)) return false;
  const uint16_t expected = spc3_buffer(device, SPC3_REG_ORG_READ_CFG_POINTER);
  for (uint8_t i = 0; i < cfg->length; ++i)
    if (cfg->bytes[i] != spc3_get(device, (uint16_t)(expected + i))) return false;
  return true;
}

static bool lengths_fit(const spc3_device* device, const spc3_cfg* cfg) {
  if (cfg->output_length > device->max_output || cfg->input_length > device->max_input) return false;
  return dp_state(device) != SPC3_REG_DP_STATE_DATA_EX ||
         (cfg->output_length == spc3_get(device, SPC3_REG_ORG_DOUT_LENGTH) &&
          cfg->input_length == spc3_get(device, SPC3_REG_ORG_DIN_LENGTH));
}

static bool judge(spc3_device* device, spc3_cfg* cfg) {
  const spc3_application* app = &device->application;
  return (app->cfg == NULL ? is_read_cfg(device, cfg) : app->cfg(app->ctx, cfg)) && lengths_fit(device, cfg);
}

/* Longer buffers may have old outputs at their end, which the chip does not clear (A27). */
static void clear_growth(const spc3_device* device, uint8_t before, uint8_t now) {
  for (uint16_t i = 0; i < SPC3_REG_ORG_DOUT_POINTER_SIZE; ++i) {
    const uint16_t buffer = spc3_buffer(device, (uint16_t)(SPC3_REG_ORG_DOUT_POINTER + i));
    spc3_fill(device, (uint16_t)(buffer + before), (uint16_t)(buffer + now), 0);
  }
}

/* In DATA_EX they do not change (lengths_fit), and the cells are not written (A5). */
static void set_lengths(const spc3_device* device, const spc3_cfg* cfg) {
  if (dp_state(device) == SPC3_REG_DP_STATE_DATA_EX) return;
  clear_growth(device, spc3_get(device, SPC3_REG_ORG_DOUT_LENGTH), cfg->output_length);
  spc3_put(device, SPC3_REG_ORG_DOUT_LENGTH, cfg->output_length);
  spc3_put(device, SPC3_REG_ORG_DIN_LENGTH, cfg->input_length);
}

/* With En_Change_Cfg this Cfg buffer becomes the one of Get_Cfg, whose length the user writes before (A26). */
static void accept_cfg(const spc3_device* device, const spc3_cfg* cfg) {
  const uint8_t shown = spc3_get(device, SPC3_REG_ORG_READ_CFG_LENGTH);
  set_lengths(device, cfg);
  if (device->change_cfg) spc3_put(device, SPC3_REG_ORG_READ_CFG_LENGTH, cfg->length);
  const bool finished = answer(device, SPC3_REG_CFG_OK) == SPC3_REG_VERDICT_FINISHED;
  if (device->change_cfg && !finished)
    spc3_put(device, SPC3_REG_ORG_READ_CFG_LENGTH, shown); /* nothing was exchanged */
}

static void judge_cfg(spc3_device* device) {
  const uint8_t length = fetch(device, SPC3_REG_ORG_CFG_LENGTH, SPC3_REG_ORG_CFG_POINTER);
  spc3_cfg cfg = {device->block, length, device->max_output, device->max_input};
  if (judge(device, &cfg))
    accept_cfg(device, &cfg);
  else
    (void)answer(device, SPC3_REG_CFG_NOT_OK);
}

/* The chip has taken the address already (A23); SSA_Free lets the next telegram come. */
static void take_address(spc3_device* device) {
  const spc3_application* app = &device->application;
  const uint8_t length = fetch(device, SPC3_REG_ORG_SSA_LENGTH, SPC3_REG_ORG_SSA_POINTER);
  if (app->address != NULL && length >= SPC3_MIN_SSA)
    app->address(app->ctx, device->block[0], device->block[3] != 0u, &device->block[SPC3_MIN_SSA],
                 (uint8_t)(length - SPC3_MIN_SSA));
  (void)spc3_get(device, SPC3_REG_SSA_FREE);
}

static void tell_control(const spc3_device* device) {
  const spc3_application* app = &device->application;
  const uint8_t command = spc3_get(device, SPC3_REG_ORG_GC_COMMAND);
  if (app->control != NULL) app->control(app->ctx, command);
}

/* The search has put min_TSDR back to its default; a master that continues expects that of its Set_Prm (A33). */
static void restore_tsdr(const spc3_device* device) {
  const bool continues = dp_state(device) != SPC3_REG_DP_STATE_WAIT_PRM && device->prm_tsdr != 0u;
  const uint8_t value = continues ? device->prm_tsdr : device->min_tsdr;
  if (value != 0u) spc3_put(device, SPC3_REG_MIN_TSDR, value);
}

static void take(spc3_device* device, uint16_t events) {
  if ((events & SPC3_REG_EVENT_BAUD_DETECT) != 0u) restore_tsdr(device);
  if ((events & SPC3_REG_EVENT_NEW_PRM) != 0u) judge_prm(device);
  if ((events & SPC3_REG_EVENT_NEW_CFG) != 0u) judge_cfg(device);
  if ((events & SPC3_REG_EVENT_NEW_SSA) != 0u) take_address(device);
  if ((events & SPC3_REG_EVENT_NEW_GC) != 0u) tell_control(device);
}

uint16_t spc3_service(spc3_device* device) {
  uint16_t seen = 0;
  uint16_t events = spc3_get_word(device, SPC3_REG_IRR);
  for (uint8_t round = 0; round < (uint8_t)kRounds && events != 0u; ++round) {
    spc3_put_word(device, SPC3_REG_IAR, events); /* before the work: what comes meanwhile counts again */
    take(device, events);
    seen |= events;
    events = spc3_get_word(device, SPC3_REG_IRR);
  }
  spc3_put(device, SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_EOI);
  return seen;
}
