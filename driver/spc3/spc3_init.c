/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Bring-up: the place of each buffer, and the order of what is written (chapters 3 to 5). */
#include "spc3_internal.h"

enum { kVpc3End = 0x7F8 }; /* its last eight bytes hold its error counters */

static spc3_error check_config(const spc3_config* config) {
  if (config->address > SPC3_REG_ORG_ADDRESS_LIMIT) return SPC3_ERR_CONFIG_ADDRESS;
  if (config->max_output > SPC3_MAX_BLOCK || config->max_input > SPC3_MAX_BLOCK || config->max_diag > SPC3_MAX_DIAG ||
      config->max_prm < SPC3_MIN_PRM || config->max_prm > SPC3_MAX_BLOCK || config->max_cfg == 0u ||
      config->max_cfg > SPC3_MAX_BLOCK || config->max_ssa > SPC3_MAX_BLOCK ||
      (config->max_ssa != 0u && config->max_ssa < SPC3_MIN_SSA))
    return SPC3_ERR_CONFIG_LENGTH;
  if (config->cfg == NULL || config->cfg_length == 0u || config->cfg_length > config->max_cfg)
    return SPC3_ERR_CONFIG_CFG;
  return SPC3_OK;
}

/* --------------------------------------------------------------------------------------------------------- layout */

/* Lengths of the two Aux buffers and of all that are exchanged with them (5.1). */
typedef struct groups {
  uint8_t first;  /* Chk_Cfg, Set_Slave_Address; and Set_Prm if there is no second */
  uint8_t second; /* Set_Prm; 0: none */
} groups;

/* A buffer of each kind in the order of its pointer cell. */
typedef struct place {
  uint16_t pointer;
  uint8_t length;
} place;

static uint8_t larger(uint8_t a, uint8_t b) { return a > b ? a : b; }

static uint16_t segments(unsigned length) { return (uint16_t)((length + 7u) >> SPC3_SEGMENT_BITS); }

/* One Aux for all, or one for Set_Prm alone: whichever needs less. With two, neither keeps the other waiting (A57). */
static groups choose_groups(const spc3_config* config) {
  unsigned ssa = 0;
  if (config->max_ssa != 0u) ssa = 1;
  const groups two = {larger(config->max_cfg, config->max_ssa), config->max_prm};
  const groups one = {larger(two.first, two.second), 0u};
  const uint16_t with_two = (uint16_t)(((3u + ssa) * segments(two.first)) + (2u * segments(two.second)));
  return ((4u + ssa) * segments(one.first)) < with_two ? one : two;
}

enum { kPlaces = 15 };

/* Writes nothing when `device` is null: the end of the last buffer is what counts. */
static uint16_t place_buffers(const spc3_device* device, const spc3_config* config) {
  const groups aux = choose_groups(config);
  const uint8_t prm = aux.second != 0u ? aux.second : aux.first;
  const uint8_t diag = (uint8_t)(config->max_diag + kDiagHead);
  const place places[kPlaces] = {
      {SPC3_REG_ORG_DOUT_POINTER, config->max_output},
      {SPC3_REG_ORG_DOUT_POINTER + 1u, config->max_output},
      {SPC3_REG_ORG_DOUT_POINTER + 2u, config->max_output},
      {SPC3_REG_ORG_DIN_POINTER, config->max_input},
      {SPC3_REG_ORG_DIN_POINTER + 1u, config->max_input},
      {SPC3_REG_ORG_DIN_POINTER + 2u, config->max_input},
      {SPC3_REG_ORG_DIAG_POINTER, diag},
      {SPC3_REG_ORG_DIAG_POINTER + 1u, diag},
      {SPC3_REG_ORG_AUX_POINTER, aux.first},
      {SPC3_REG_ORG_AUX_POINTER + 1u, aux.second},
      {SPC3_REG_ORG_SSA_POINTER, config->max_ssa != 0u ? aux.first : 0u},
      {SPC3_REG_ORG_PRM_POINTER, prm},
      {SPC3_REG_ORG_CFG_POINTER, aux.first},
      {SPC3_REG_ORG_READ_CFG_POINTER, aux.first},
      {SPC3_REG_ORG_SAP_POINTER, 1u},
  };
  uint16_t next = SPC3_REG_BUFFERS >> SPC3_SEGMENT_BITS;
  for (uint8_t i = 0; i < (uint8_t)kPlaces; ++i) { /* a buffer without a byte keeps the pointer 00 (A4) */
    if (device != NULL && places[i].length != 0u) spc3_put(device, places[i].pointer, (uint8_t)next);
    next = (uint16_t)(next + segments(places[i].length));
  }
  if (device != NULL) {
    spc3_put(device, SPC3_REG_ORG_AUX_LENGTH, aux.first);
    spc3_put(device, SPC3_REG_ORG_AUX_LENGTH + 1u, aux.second);
    spc3_put(device, SPC3_REG_ORG_AUX_SELECT, (uint8_t)(aux.second != 0u ? SPC3_REG_ORG_AUX_SELECT_PRM : 0u));
  }
  return (uint16_t)(next << SPC3_SEGMENT_BITS);
}

/* ------------------------------------------------------------------------------------------------------ registers */

static uint16_t ram_end(const spc3_config* config) { return config->vpc3 ? (uint16_t)kVpc3End : SPC3_REG_RAM_SIZE; }

/* Each byte holds another value than its neighbours and those at a distance of a power of two. Leaves zeros. */
static uint8_t test_value(uint16_t address) { return (uint8_t)((address ^ (address >> 8)) & 0xFFu); }

static bool test_ram(const spc3_device* device, uint16_t end) {
  uint8_t bytes[SPC3_PIECE];
  for (uint16_t each = SPC3_REG_ORG; each < end; each = (uint16_t)(each + SPC3_PIECE)) {
    const uint8_t size = spc3_piece(each, end);
    for (uint8_t i = 0; i < size; ++i) bytes[i] = test_value((uint16_t)(each + i));
    spc3_put_bytes(device, each, bytes, size);
  }
  for (uint16_t each = SPC3_REG_ORG; each < end; each = (uint16_t)(each + SPC3_PIECE)) {
    const uint8_t size = spc3_piece(each, end);
    spc3_get_bytes(device, each, bytes, size);
    for (uint8_t i = 0; i < size; ++i)
      if (bytes[i] != test_value((uint16_t)(each + i))) return false;
  }
  spc3_fill(device, SPC3_REG_ORG, end, 0);
  return true;
}

static uint16_t mode_0(const spc3_config* config) {
  uint16_t mode = SPC3_REG_MODE_0_DP_MODE;
  mode |= config->combined ? SPC3_REG_MODE_0_COMBI : 0u;
  mode |= config->int_active_high ? SPC3_REG_MODE_0_INT_POL : 0u;
  mode |= config->sync ? SPC3_REG_MODE_0_SYNC_SUPPORTED : 0u;
  mode |= config->freeze ? SPC3_REG_MODE_0_FREEZE_SUPPORTED : 0u;
  mode |= config->int_pause_1ms ? SPC3_REG_MODE_0_EOI_TIME_BASE : 0u;
  mode |= config->clear_by_empty ? SPC3_REG_MODE_0_SPEC_CLEAR : 0u;
  return mode;
}

static void write_organisation(const spc3_device* device, const spc3_config* config) {
  const uint8_t locked = config->address_locked ? SPC3_REG_ADDRESS_CHANGE_LOCKED : 0u;
  spc3_put(device, SPC3_REG_ORG_ADDRESS, config->address);
  spc3_put(device, SPC3_REG_ORG_NO_ADDRESS_CHANGE, locked);
  spc3_put(device, SPC3_REG_ORG_IDENT_LOW, (uint8_t)(config->ident & 0xFFu));
  spc3_put(device, SPC3_REG_ORG_IDENT_HIGH, (uint8_t)(config->ident >> 8));
  spc3_put_word(device, SPC3_REG_ORG_USER_WD, config->user_wd);
  spc3_put(device, SPC3_REG_ORG_DOUT_LENGTH, config->max_output);
  spc3_put(device, SPC3_REG_ORG_DIN_LENGTH, config->max_input);
  spc3_put(device, SPC3_REG_ORG_DIAG_LENGTH, kDiagHead);
  spc3_put(device, SPC3_REG_ORG_DIAG_LENGTH + 1u, kDiagHead);
  (void)place_buffers(device, config);
  spc3_put(device, spc3_buffer(device, SPC3_REG_ORG_SAP_POINTER), 0xFF); /* an empty list of SAPs (clause 3.3) */
  spc3_put(device, SPC3_REG_ORG_READ_CFG_LENGTH, config->cfg_length);
  spc3_put_bytes(device, spc3_buffer(device, SPC3_REG_ORG_READ_CFG_POINTER), config->cfg, config->cfg_length);
}

/* Events of an earlier operation, and its interrupt. OFFLINE, an answer does no more than clear its event (A14). */
static void drop_events(const spc3_device* device) {
  const uint16_t events = spc3_get_word(device, SPC3_REG_IRR);
  if ((events & SPC3_REG_EVENT_NEW_PRM) != 0u) (void)spc3_get(device, SPC3_REG_PRM_NOT_OK);
  if ((events & SPC3_REG_EVENT_NEW_CFG) != 0u) (void)spc3_get(device, SPC3_REG_CFG_NOT_OK);
  spc3_put_word(device, SPC3_REG_IAR, 0xFFFF);
  spc3_put(device, SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_EOI);
}

static void write_registers(const spc3_device* device, const spc3_config* config) {
  drop_events(device);
  spc3_put_word(device, SPC3_REG_MODE_0, mode_0(config));
  spc3_put(device, SPC3_REG_MODE_1_R, SPC3_REG_MODE_1_EN_CHANGE_CFG);
  if (config->change_cfg) spc3_put(device, SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_EN_CHANGE_CFG);
  spc3_put(device, SPC3_REG_WD_BAUD_CONTROL,
           config->baud_control != 0u ? config->baud_control : SPC3_REG_WD_BAUD_CONTROL_RESET);
  if (config->min_tsdr != 0u) spc3_put(device, SPC3_REG_MIN_TSDR, config->min_tsdr);
  spc3_put_word(device, SPC3_REG_IMR, (uint16_t)~config->interrupts);
}

static void keep(spc3_device* device, const spc3_config* config) {
  device->max_output = config->max_output;
  device->max_input = config->max_input;
  device->max_diag = config->max_diag;
  device->min_tsdr = config->min_tsdr;
  device->prm_tsdr = 0;
  device->change_cfg = config->change_cfg;
}

spc3_error spc3_initialise(spc3_device* device, const spc3_config* config) {
  if (device == NULL || config == NULL) return SPC3_ERR_ARGUMENT;
  const spc3_error error = check_config(config);
  if (error != SPC3_OK) return error;
  if (place_buffers(NULL, config) > ram_end(config)) return SPC3_ERR_CONFIG_FIT;
  device->motorola = config->motorola;
  spc3_put_word(device, SPC3_REG_IMR, 0xFFFF);
  if ((spc3_status(device) & SPC3_REG_STATUS_PASSIVE_IDLE) != 0u) {
    spc3_go_offline(device);
    return SPC3_ERR_NOT_OFFLINE;
  }
  if (!test_ram(device, ram_end(config))) return SPC3_ERR_RAM;
  keep(device, config);
  write_organisation(device, config);
  write_registers(device, config);
  return SPC3_OK;
}

void spc3_start(spc3_device* device) {
  spc3_serve_watchdog(device);
  spc3_put(device, SPC3_REG_MODE_1_S, SPC3_REG_MODE_1_START);
}
