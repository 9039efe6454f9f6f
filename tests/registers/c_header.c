/* The C header as a C99 compiler reads it. */
#include "registers/dsdpv1_regs.h"
#include "registers/spc3_regs.h"

unsigned c_user_command_1_init(void) { return DSDPV1_REG_USER_COMMAND_1_INIT; }
unsigned c_init_crc(void) { return DSDPV1_REG_INIT_CRC; }
unsigned c_dpram_size(void) { return DSDPV1_REG_DPRAM_SIZE; }
unsigned c_baud_searching(void) { return DSDPV1_REG_BAUD_SEARCHING; }
unsigned c_spc3_imr(void) { return SPC3_REG_IMR; }
unsigned c_spc3_imr_reset(void) { return SPC3_REG_IMR_RESET; }
unsigned c_spc3_new_prm(void) { return SPC3_REG_EVENT_NEW_PRM; }
