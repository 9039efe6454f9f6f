/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Parameters and configuration from the master, and the user's verdicts on them (4.1.6, 6.2.2, 6.2.3). */
#include "dsdpv1_internal.h"

static const dsdpv1_area kPrm = {DSDPV1_REG_PRM,
                                 1,
                                 DSDPV1_REG_PRM_CRC,
                                 DSDPV1_REG_USER_STATUS_2_PRM_CRC,
                                 DSDPV1_ERR_PRM_LENGTH,
                                 DSDPV1_ERR_PRM_CRC,
                                 DSDPV1_REG_CHIP_COMMAND_1,
                                 DSDPV1_REG_CHIP_COMMAND_1_PRM};
static const dsdpv1_area kCfg = {DSDPV1_REG_CFG,
                                 3,
                                 DSDPV1_REG_CFG_CRC,
                                 DSDPV1_REG_USER_STATUS_2_CFG_CRC,
                                 DSDPV1_ERR_CFG_LENGTH,
                                 DSDPV1_ERR_CFG_CRC,
                                 DSDPV1_REG_CHIP_COMMAND_1,
                                 DSDPV1_REG_CHIP_COMMAND_1_CFG};

/* Limits the rounds per call, so that a call stays bounded when the master keeps sending new blocks. */
enum { kRounds = 3 };

/* Verdicts reached in one round, as DSDPV1_VERDICT_ bits. */
typedef struct verdicts {
  unsigned given, wrong;
} verdicts;

static unsigned fresh_blocks(uint8_t command) {
  unsigned fresh = 0;
  fresh |= (command & DSDPV1_REG_CHIP_COMMAND_1_PRM) != 0u ? DSDPV1_VERDICT_PRM : 0u;
  fresh |= (command & DSDPV1_REG_CHIP_COMMAND_1_CFG) != 0u ? DSDPV1_VERDICT_CFG : 0u;
  return fresh;
}

static unsigned user_judged(const dsdpv1_device* device) {
  unsigned kinds = 0;
  kinds |= device->prm_mode == DSDPV1_REG_PRM_MODE_USER ? DSDPV1_VERDICT_PRM : 0u;
  kinds |= device->cfg_mode == DSDPV1_REG_CFG_MODE_USER ? DSDPV1_VERDICT_CFG : 0u;
  return kinds;
}

static dsdpv1_copy prm_copy(dsdpv1_device* device) {
  const dsdpv1_copy copy = {{0}, device->prm, (uint8_t)DSDPV1_MAX_PRM, 0};
  return copy;
}

static dsdpv1_copy cfg_copy(dsdpv1_device* device) {
  const dsdpv1_copy copy = {{0}, device->cfg, (uint8_t)DSDPV1_MAX_CFG, 0};
  return copy;
}

static uint8_t flags_of(unsigned kinds) {
  unsigned flags = 0;
  flags |= (kinds & DSDPV1_VERDICT_PRM) != 0u ? DSDPV1_REG_CHIP_COMMAND_1_PRM : 0u;
  flags |= (kinds & DSDPV1_VERDICT_CFG) != 0u ? DSDPV1_REG_CHIP_COMMAND_1_CFG : 0u;
  return (uint8_t)flags;
}

/* Inside a hold. A block left unread by a disturbed hold must be read next time: its flag may be gone. */
static void copy_blocks(dsdpv1_device* device, uint8_t command, unsigned fresh, dsdpv1_copy* prm, dsdpv1_copy* cfg) {
  dsdpv1_before_fetch(device, DSDPV1_REG_CHIP_COMMAND_1, flags_of(fresh));
  if ((fresh & DSDPV1_VERDICT_PRM) != 0u) dsdpv1_fetch(device, &kPrm, prm);
  if ((fresh & DSDPV1_VERDICT_CFG) != 0u) dsdpv1_fetch(device, &kCfg, cfg);
  dsdpv1_after_fetch(device, DSDPV1_REG_CHIP_COMMAND_1, command,
                     DSDPV1_REG_CHIP_COMMAND_1_PRM | DSDPV1_REG_CHIP_COMMAND_1_CFG);
  device->unread = device->fault == DSDPV1_OK ? 0u : (uint8_t)fresh;
  if (device->fault == DSDPV1_OK) device->verdicts_due = (uint8_t)(device->verdicts_due & ~fresh);
}

/* One hold: copies new blocks and clears their flags, so that a flag set later means a newer block. */
static dsdpv1_error take_blocks(dsdpv1_device* device, unsigned* fresh, dsdpv1_copy* prm, dsdpv1_copy* cfg) {
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  const uint8_t command = dsdpv1_get(device, DSDPV1_REG_CHIP_COMMAND_1);
  *fresh = fresh_blocks(command) | device->unread;
  if (*fresh != 0u) copy_blocks(device, command, *fresh, prm, cfg);
  return dsdpv1_release(device);
}

static void note(dsdpv1_device* device, verdicts* reached, unsigned kind, dsdpv1_verdict verdict) {
  if ((user_judged(device) & kind) == 0u) return; /* modes 0 and 1: the chip has judged */
  if (verdict == DSDPV1_LATER) {
    device->verdicts_due = (uint8_t)(device->verdicts_due | kind);
    return;
  }
  reached->given |= kind;
  reached->wrong |= verdict == DSDPV1_REFUSE ? kind : 0u;
}

/* If no hold was available to read a block again, it stays due: its flag is gone already. */
static dsdpv1_error confirm(dsdpv1_device* device, const dsdpv1_area* area, dsdpv1_copy* copy, unsigned kind) {
  const dsdpv1_error error = dsdpv1_confirm(device, area, copy);
  if (error != DSDPV1_OK && error != area->length_error && error != area->crc_error)
    device->unread = (uint8_t)(device->unread | kind);
  return error;
}

static dsdpv1_error judge_prm(dsdpv1_device* device, dsdpv1_copy* copy, verdicts* reached) {
  const dsdpv1_error error = confirm(device, &kPrm, copy, DSDPV1_VERDICT_PRM);
  if (error != DSDPV1_OK) return error;
  device->prm_length = dsdpv1_copy_length(&kPrm, copy);
  const dsdpv1_verdict verdict =
      device->judge.prm == NULL ? DSDPV1_ACCEPT : device->judge.prm(device->judge.ctx, device->prm, device->prm_length);
  note(device, reached, DSDPV1_VERDICT_PRM, verdict);
  return DSDPV1_OK;
}

static dsdpv1_error judge_cfg(dsdpv1_device* device, dsdpv1_copy* copy, verdicts* reached) {
  const dsdpv1_error error = confirm(device, &kCfg, copy, DSDPV1_VERDICT_CFG);
  if (error != DSDPV1_OK) return error;
  device->cfg_output_length = copy->header[0];
  device->cfg_input_length = copy->header[1];
  device->cfg_length = dsdpv1_copy_length(&kCfg, copy);
  const dsdpv1_cfg_block block = {device->cfg, device->cfg_length, device->cfg_input_length, device->cfg_output_length};
  const dsdpv1_verdict verdict =
      device->judge.cfg == NULL ? DSDPV1_ACCEPT : device->judge.cfg(device->judge.ctx, &block);
  note(device, reached, DSDPV1_VERDICT_CFG, verdict);
  return DSDPV1_OK;
}

/* Inside a hold: B00C and the flags of B010 for the verdicts (D4). */
static void write_verdicts(dsdpv1_device* device, const verdicts* reached) {
  unsigned status = 0;
  status |= (reached->wrong & DSDPV1_VERDICT_PRM) != 0u ? DSDPV1_REG_USER_STATUS_1_PRM_WRONG : 0u;
  status |= (reached->wrong & DSDPV1_VERDICT_CFG) != 0u ? DSDPV1_REG_USER_STATUS_1_CFG_WRONG : 0u;
  const uint8_t command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1);
  unsigned given = 0;
  given |= (reached->given & DSDPV1_VERDICT_PRM) != 0u ? DSDPV1_REG_USER_COMMAND_1_PRM_VERDICT : 0u;
  given |= (reached->given & DSDPV1_VERDICT_CFG) != 0u ? DSDPV1_REG_USER_COMMAND_1_CFG_VERDICT : 0u;
  dsdpv1_put(device, DSDPV1_REG_USER_STATUS_1, (uint8_t)status);
  dsdpv1_announce(device, DSDPV1_REG_USER_COMMAND_1, command, 0, (uint8_t)given);
}

/* One hold. Does not send verdicts on blocks that the master has replaced meanwhile (H7); `fresh` reports those
 * blocks. */
static dsdpv1_error hand_over(dsdpv1_device* device, const verdicts* reached, unsigned* fresh) {
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  *fresh = fresh_blocks(dsdpv1_get(device, DSDPV1_REG_CHIP_COMMAND_1));
  const verdicts current = {reached->given & ~*fresh, reached->wrong & ~*fresh};
  if (current.given != 0u) {
    write_verdicts(device, &current);
    /* a verdict that did not reach the chip in a disturbed hold stays due */
    device->verdicts_due = (uint8_t)(device->fault == DSDPV1_OK ? device->verdicts_due & ~current.given
                                                                : device->verdicts_due | current.given);
  }
  return dsdpv1_release(device);
}

/* One round: take, judge, answer. `fresh` is not 0 if the master has sent something newer meanwhile. */
static dsdpv1_error service_round(dsdpv1_device* device, unsigned* fresh) {
  dsdpv1_copy prm = prm_copy(device);
  dsdpv1_copy cfg = cfg_copy(device);
  verdicts reached = {0, 0};
  dsdpv1_error prm_error = DSDPV1_OK;
  dsdpv1_error cfg_error = DSDPV1_OK;
  unsigned taken = 0;
  dsdpv1_error error = take_blocks(device, &taken, &prm, &cfg);
  *fresh = 0;
  if (error != DSDPV1_OK) return error;
  if ((taken & DSDPV1_VERDICT_PRM) != 0u) prm_error = judge_prm(device, &prm, &reached);
  if ((taken & DSDPV1_VERDICT_CFG) != 0u) cfg_error = judge_cfg(device, &cfg, &reached);
  if (reached.given != 0u) error = hand_over(device, &reached, fresh);
  if (error != DSDPV1_OK) return error;
  return prm_error != DSDPV1_OK ? prm_error : cfg_error;
}

void dsdpv1_on_intr0(dsdpv1_device* device) { device->intr0_pending = true; }

bool dsdpv1_intr0_pending(const dsdpv1_device* device) { return device->intr0_pending; }

dsdpv1_error dsdpv1_service(dsdpv1_device* device) {
  if (device == NULL) return DSDPV1_ERR_ARGUMENT;
  if (!device->initialised) return DSDPV1_ERR_NOT_INITIALISED;
  if (device->held || device->servicing) {
    device->intr0_pending = true; /* left to the interrupted program */
    return DSDPV1_ERR_NESTED;
  }
  device->servicing = true;
  device->intr0_pending = false; /* cleared before reading: a later INTR0 counts again */
  unsigned fresh = 1;
  dsdpv1_error error = DSDPV1_OK;
  for (int round = 0; round < kRounds && fresh != 0u && error == DSDPV1_OK; ++round)
    error = service_round(device, &fresh);
  if (fresh != 0u || error == DSDPV1_ERR_DPRAM_BUSY || error == DSDPV1_ERR_CHIP_SILENT) device->intr0_pending = true;
  device->servicing = false;
  return error;
}

dsdpv1_error dsdpv1_send_verdict(dsdpv1_device* device, uint8_t which, uint8_t wrong) {
  if (device == NULL || which == 0u || (which & ~(DSDPV1_VERDICT_PRM | DSDPV1_VERDICT_CFG)) != 0u ||
      (wrong & ~(unsigned)which) != 0u)
    return DSDPV1_ERR_ARGUMENT;
  if ((which & ~(unsigned)device->verdicts_due) != 0u) return DSDPV1_ERR_NO_VERDICT_DUE;
  const verdicts late = {which, wrong};
  unsigned fresh = 0;
  const dsdpv1_error error = hand_over(device, &late, &fresh);
  if (error != DSDPV1_OK) return error;
  return (fresh & which) != 0u ? DSDPV1_ERR_VERDICT_STALE : DSDPV1_OK;
}
