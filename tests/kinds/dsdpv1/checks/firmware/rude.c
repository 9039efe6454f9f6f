/* Firmware that breaks one rule of the DPRAM, chosen by -DRUDE_...; without any of them it keeps all. For the checks
   that the driver cannot break. Board, port and driver are those of examples/firmware. */
#include <stddef.h>

#include "driver/dsdpv1.h"
#include "examples/firmware/board.h"
#include "examples/firmware/dsdpv1_port_stm32.h"
#include "registers/dsdpv1_regs.h"

static dsdpv1_device chip;

static void pins(bool r_req, bool r_sta) {
  port_stm32.set_r_req(NULL, r_req);
  port_stm32.set_r_sta(NULL, r_sta);
}

static void take(void) {
  port_stm32.set_r_req(NULL, true);
  board_wait(board_cycles(100));
  while (port_stm32.get_l_req(NULL) || port_stm32.get_l_sta(NULL)) {
  }
  board_wait(board_cycles(100));
  port_stm32.set_r_sta(NULL, true);
  port_dpram_write(DSDPV1_REG_ACCESS_COUNT, (uint8_t)(port_dpram_read(DSDPV1_REG_ACCESS_COUNT) + 1u));
}

static void release(void) {
  port_stm32.set_r_sta(NULL, false);
  port_stm32.set_r_req(NULL, false);
}

static void break_a_rule(void) {
#if defined RUDE_NO_REQUEST
  while (!port_stm32.get_l_sta(NULL)) {
  }
  while (port_stm32.get_l_sta(NULL)) { /* the chip has just finished, so it is not a collision */
  }
  port_stm32.set_r_sta(NULL, true);
  port_stm32.set_r_sta(NULL, false);
#elif defined RUDE_NOT_OWNER
  (void)port_dpram_read(DSDPV1_REG_CHIP_STATUS_3);
#elif defined RUDE_CELL_OF_CHIP
  take();
  port_dpram_write(DSDPV1_REG_VERSION, DSDPV1_REG_VERSION_RESET);
  release();
#elif defined RUDE_SETS_STATUS_BIT
  take();
  const uint8_t status = port_dpram_read(DSDPV1_REG_CHIP_STATUS_2);
  port_dpram_write(DSDPV1_REG_CHIP_STATUS_2, status | 0x80u);
  release();
#elif defined RUDE_FLAG_BY_USER
  take();
  const uint8_t flags = port_dpram_read(DSDPV1_REG_CHIP_COMMAND_2);
  port_dpram_write(DSDPV1_REG_CHIP_COMMAND_2, flags | DSDPV1_REG_CHIP_COMMAND_2_C1);
  release();
#elif defined RUDE_USER_REFUSED
  static const uint8_t diagnosis[] = {0x55, 0}; /* no type of table 22 */
  const uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, diagnosis, sizeof diagnosis);
  take();
  port_dpram_write(DSDPV1_REG_DIAG, diagnosis[0]);
  port_dpram_write(DSDPV1_REG_DIAG + 1u, diagnosis[1]);
  port_dpram_write(DSDPV1_REG_DIAG_CRC, (uint8_t)(crc >> 8));
  port_dpram_write(DSDPV1_REG_DIAG_CRC + 1u, (uint8_t)(crc & 0xFFu));
  const uint8_t command = port_dpram_read(DSDPV1_REG_USER_COMMAND_1);
  port_dpram_write(DSDPV1_REG_USER_COMMAND_1, command | DSDPV1_REG_USER_COMMAND_1_DIAG);
  release();
#endif
}

static void start_too_soon(void) {
#if defined RUDE_READY_UNSEEN
  board_wait(board_cycles(200000));
  take();
  port_dpram_write(DSDPV1_REG_DPV1_ENABLE, 0);
  release();
#endif
}

/* The parameters sent by the master, with or without their CRC; or a verdict on a block that was not fetched. */
static bool fetch_parameters(void) {
  take();
  const uint8_t flags = port_dpram_read(DSDPV1_REG_CHIP_COMMAND_1);
  const bool there = (flags & DSDPV1_REG_CHIP_COMMAND_1_PRM) != 0;
#if defined RUDE_VERDICT_UNFETCHED
  if (there) {
    const uint8_t command = port_dpram_read(DSDPV1_REG_USER_COMMAND_1);
    port_dpram_write(DSDPV1_REG_USER_COMMAND_1, command | DSDPV1_REG_USER_COMMAND_1_PRM_VERDICT);
  }
#else
  if (there) {
#ifndef RUDE_BLOCK_WHOLE
    const uint8_t length = port_dpram_read(DSDPV1_REG_PRM_LENGTH);
    for (uint16_t i = 0; i < length; ++i) (void)port_dpram_read((uint16_t)(DSDPV1_REG_PRM_LENGTH + 1u + i));
#endif
#ifndef RUDE_CRC_FETCHED
    (void)port_dpram_read(DSDPV1_REG_PRM_CRC);
    (void)port_dpram_read(DSDPV1_REG_PRM_CRC + 1u);
#endif
    port_dpram_write(DSDPV1_REG_CHIP_COMMAND_1, (uint8_t)(flags & ~DSDPV1_REG_CHIP_COMMAND_1_PRM));
  }
#endif
  release();
  return there;
}

int main(void) {
  static const uint8_t cfg[] = {0x31};
  dsdpv1_config config = {0};
  config.address = 5;
  config.ident = 1;
  config.max_input = config.max_output = 2;
  config.max_prm = config.max_cfg = 10;
  config.prm_mode = config.cfg_mode = 2;
  config.cfg = cfg;
  config.cfg_length = sizeof cfg;
  board_start();
  board_release_chip();
  pins(false, false);
  start_too_soon();
  if (dsdpv1_open(&chip, &port_stm32, NULL) != DSDPV1_OK || dsdpv1_wait_ready(&chip) != DSDPV1_OK ||
      dsdpv1_initialise(&chip, &config) != DSDPV1_OK)
    return 1;
  break_a_rule();
  while (!fetch_parameters()) board_wait(board_cycles(50000));
  for (;;) board_wait(board_cycles(1000000));
}
