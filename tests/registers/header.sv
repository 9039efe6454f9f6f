// Uses one constant of each kind of registers/dsdpv1_regs.svh; included twice, for its guard.
`include "registers/dsdpv1_regs.svh"
`include "registers/dsdpv1_regs.svh"

module header (
    input  logic [10:0] a_i,
    output logic        init_o,
    output logic [ 7:0] value_o,
    output logic [ 2:0] shift_o,
    output logic [11:0] size_o
);
  assign init_o  = (a_i >= DSDPV1_REG_INIT) && (a_i < DSDPV1_REG_INIT_CRC);
  assign value_o = init_o ? DSDPV1_REG_USER_COMMAND_1_INIT : DSDPV1_REG_VALID_FLAG_VALID;
  assign shift_o = DSDPV1_REG_CHIP_STATUS_3_DP_STATE_SHIFT;
  assign size_o  = DSDPV1_REG_DPRAM_SIZE;
endmodule
