/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Bring-up: waiting for the chip and initialising it (chapter 8, figure 12). */
#include <string.h>

#include "dsdpv1_internal.h"

enum { kHeadLength = DSDPV1_REG_INIT_CFG - DSDPV1_REG_INIT }; /* B020..B02E, before the configuration bytes */

dsdpv1_error dsdpv1_wait_ready(dsdpv1_device* device) {
  if (device == NULL) return DSDPV1_ERR_ARGUMENT;
  dsdpv1_error error = DSDPV1_OK;
  dsdpv1_sync_pause(device); /* H6: a request that is high as the chip leaves its reset prevents its start-up */
  for (uint32_t polls = device->tuning.ready_polls; polls != 0u; --polls) {
    error = dsdpv1_hold_unjudged(device);
    uint8_t flag = 0;
    if (error == DSDPV1_OK) {
      flag = dsdpv1_get(device, DSDPV1_REG_VALID_FLAG);
      error = dsdpv1_release(device);
    }
    if (error != DSDPV1_OK && error != DSDPV1_ERR_NO_REPLY) return error; /* a chip in reset receives nothing */
    if (error == DSDPV1_OK && flag == DSDPV1_REG_VALID_FLAG_VALID) {
      device->absent_holds = 0; /* holds before the chip's start do not count */
      return DSDPV1_OK;
    }
    dsdpv1_poll_pause(device);
  }
  return error != DSDPV1_OK ? error : DSDPV1_ERR_CHIP_NOT_READY;
}

static dsdpv1_error check_sizes(const dsdpv1_config* config) { /* D7 */
  if (config->max_input > DSDPV1_MAX_IO) return DSDPV1_ERR_CONFIG_INPUT;
  if (config->max_output > DSDPV1_MAX_IO) return DSDPV1_ERR_CONFIG_OUTPUT;
  if (config->max_diag > DSDPV1_MAX_DIAG) return DSDPV1_ERR_CONFIG_DIAG;
  if (config->max_prm > DSDPV1_MAX_PRM) return DSDPV1_ERR_CONFIG_PRM;
  if (config->max_cfg == 0u || config->max_cfg > DSDPV1_MAX_CFG) return DSDPV1_ERR_CONFIG_CFG;
  if (config->cfg == NULL || config->cfg_length == 0u || config->cfg_length > config->max_cfg)
    return DSDPV1_ERR_CONFIG_CFG_LENGTH;
  return DSDPV1_OK;
}

static dsdpv1_error check_config(const dsdpv1_config* config) {
  if (config->address > DSDPV1_MAX_ADDRESS) return DSDPV1_ERR_CONFIG_ADDRESS;
  if (config->prm_mode > DSDPV1_REG_PRM_MODE_USER) return DSDPV1_ERR_CONFIG_PRM_MODE;
  if (config->cfg_mode > DSDPV1_REG_CFG_MODE_USER) return DSDPV1_ERR_CONFIG_CFG_MODE;
  return check_sizes(config);
}

static uint8_t command_byte(const dsdpv1_config* config) { /* table 12 */
  unsigned command = 0;
  command |= config->address_change ? DSDPV1_REG_INIT_COMMAND_ADDRESS_CHANGE : 0u;
  command |= config->freeze ? DSDPV1_REG_INIT_COMMAND_FREEZE : 0u;
  command |= config->sync ? DSDPV1_REG_INIT_COMMAND_SYNC : 0u;
  command |= config->fail_safe ? DSDPV1_REG_INIT_COMMAND_FAIL_SAFE : 0u;
  return (uint8_t)command;
}

static void build_head(uint8_t head[kHeadLength], const dsdpv1_config* config) {
  const uint8_t values[kHeadLength] = {
      (uint8_t)(kHeadLength - 1 + config->cfg_length), /* B020 counts what follows it */
      config->address,
      (uint8_t)(config->ident >> 8),
      (uint8_t)(config->ident & 0xFFu),
      command_byte(config),
      0, /* B025, B026 reserved */
      0,
      config->max_input,
      config->max_output,
      config->max_diag,
      config->max_prm,
      config->prm_mode,
      config->max_cfg,
      config->cfg_mode,
      config->cfg_length,
  };
  for (size_t i = 0; i < kHeadLength; ++i) head[i] = values[i];
}

/* Inside a hold: moves the flags at `address` to `aside` and clears them. */
static void set_aside(dsdpv1_device* device, uint16_t address, uint8_t* aside) {
  *aside = (uint8_t)(*aside | dsdpv1_get(device, address));
  dsdpv1_put(device, address, 0);
}

/*
 * Inside a hold. Flags of the earlier operation are set aside on both sides: if the chip accepts the new
 * configuration, their data belong to the old one; if it refuses, they still count (D11). Verdicts stay, because the
 * chip discards those that it does not await (H7). An old B00A.0 must fall, or it would be taken for the success of
 * this initialisation.
 */
static void write_init(dsdpv1_device* device, const dsdpv1_config* config, const uint8_t head[kHeadLength],
                       uint16_t crc) {
  dsdpv1_put(device, DSDPV1_REG_DPV1_ENABLE, config->dpv1 ? DSDPV1_REG_DPV1_ENABLE_ON : 0u);
  const dsdpv1_block block = {
      DSDPV1_REG_INIT, {head, kHeadLength}, {config->cfg, config->cfg_length}, DSDPV1_REG_INIT_CRC, crc};
  dsdpv1_put_block(device, &block);
  if ((dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_1) & DSDPV1_REG_CHIP_STATUS_1_INITIALISED) != 0u)
    dsdpv1_put(device, DSDPV1_REG_CHIP_STATUS_1, 0);
  set_aside(device, DSDPV1_REG_CHIP_COMMAND_1, &device->aside.chip_command[0]);
  set_aside(device, DSDPV1_REG_CHIP_COMMAND_2, &device->aside.chip_command[1]);
  const unsigned verdicts = DSDPV1_REG_USER_COMMAND_1_PRM_VERDICT | DSDPV1_REG_USER_COMMAND_1_CFG_VERDICT;
  const unsigned command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1);
  const unsigned blocks = DSDPV1_REG_USER_COMMAND_1_INPUT | DSDPV1_REG_USER_COMMAND_1_DIAG;
  device->aside.user_command_1 = (uint8_t)(device->aside.user_command_1 | (command & blocks));
  dsdpv1_put(device, DSDPV1_REG_USER_COMMAND_1, (uint8_t)((command & verdicts) | DSDPV1_REG_USER_COMMAND_1_INIT));
}

static dsdpv1_error hand_over(dsdpv1_device* device, const dsdpv1_config* config) {
  uint8_t head[kHeadLength];
  build_head(head, config);
  const uint16_t crc =
      dsdpv1_crc(dsdpv1_crc(DSDPV1_CRC_START, head, kHeadLength), config->cfg, config->cfg_length); /* D3 */
  dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  const bool ready = dsdpv1_get(device, DSDPV1_REG_VALID_FLAG) == DSDPV1_REG_VALID_FLAG_VALID;
  if (ready) write_init(device, config, head, crc);
  error = dsdpv1_release(device);
  return error != DSDPV1_OK || ready ? error : DSDPV1_ERR_CHIP_NOT_READY;
}

/* Inside a hold: why B00A.0 is or is not set. The CRC is checked first (D11). */
static dsdpv1_error read_answer(dsdpv1_device* device) {
  if ((dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_1) & DSDPV1_REG_CHIP_STATUS_1_INITIALISED) != 0u) {
    dsdpv1_put(device, DSDPV1_REG_CHIP_STATUS_1, 0);
    return DSDPV1_OK;
  }
  if ((dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_2) & DSDPV1_REG_CHIP_STATUS_2_INIT_CRC) != 0u)
    return DSDPV1_ERR_INIT_CRC;
  if ((dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_4) & DSDPV1_REG_CHIP_STATUS_4_INIT_LIMIT) != 0u)
    return DSDPV1_ERR_INIT_LIMIT;
  return DSDPV1_ERR_INIT_REFUSED;
}

/* Inside the hold in which the initialisation was refused: the chip keeps its old values (D11), and so do the flags. */
static void resume(dsdpv1_device* device) {
  const unsigned command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1);
  dsdpv1_put(device, DSDPV1_REG_USER_COMMAND_1, (uint8_t)(command | device->aside.user_command_1));
  if (device->fault == DSDPV1_OK) device->aside.user_command_1 = 0;
}

/* Inside the hold in which it was accepted, so that an INTR0 handler sees the new modes. */
static void remember(dsdpv1_device* device, const dsdpv1_config* config) {
  (void)memset(&device->aside, 0, sizeof device->aside);
  device->user_status_2 = 0;
  dsdpv1_put(device, DSDPV1_REG_USER_STATUS_2, 0);
  device->verdicts_due = 0;
  device->unread = 0;
  ++device->generation;
  device->max_input = config->max_input;
  device->max_output = config->max_output;
  device->max_diag = config->max_diag;
  device->prm_mode = config->prm_mode;
  device->cfg_mode = config->cfg_mode;
  device->initialised = true;
}

dsdpv1_error dsdpv1_initialise(dsdpv1_device* device, const dsdpv1_config* config) {
  if (device == NULL || config == NULL) return DSDPV1_ERR_ARGUMENT;
  dsdpv1_error error = check_config(config);
  if (error == DSDPV1_OK) error = hand_over(device, config);
  if (error == DSDPV1_OK)
    error = dsdpv1_hold_when_taken(device, DSDPV1_REG_USER_COMMAND_1_INIT, DSDPV1_ERR_INIT_TIMEOUT);
  if (error != DSDPV1_OK) return error;
  error = read_answer(device);
  if (device->fault == DSDPV1_OK && error == DSDPV1_OK)
    remember(device, config);
  else
    resume(device);
  const dsdpv1_error fault = dsdpv1_release(device);
  return fault != DSDPV1_OK ? fault : error;
}
