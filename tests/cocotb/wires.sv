// Wires for a test of the testbench: outputs follow inputs.
module wires (
  input  logic clk_i,
  input  logic line_i,
  output logic line_o
);
  assign line_o = line_i;
endmodule

// A chip that answers nothing, with other port names; inverted L_REQ and L_STA show that the DPRAM is free.
module pins_only (
  input  logic        rst,
  input  logic        user_req,
  input  logic        user_sta,
  input  logic        cs_n,
  input  logic        rd_n,
  input  logic        wr_n,
  input  logic [10:0] addr,
  input  logic [7:0]  data_in,
  input  logic        rx,
  output logic        chip_req_n,
  output logic        chip_sta_n,
  output logic [7:0]  data_out,
  output logic        data_en_n,
  output logic        irq_n,
  output logic        tx,
  output logic        rts,
  output logic        pbf,
  output logic        br,
  output logic        ready
);
  assign {chip_req_n, chip_sta_n, irq_n, tx, pbf} = 5'b11111;  // as after a reset
  assign {rts, br, ready} = 3'b000;
  assign data_en_n = cs_n || rd_n;
  assign data_out = addr[7:0];
endmodule

// A chip of the SPC3 family that never changes an output, with the port names of the rule.
module spc3_pins_only (
  input  logic        clk_i,
  input  logic        reset_i,
  input  logic        xint_mot_i,
  input  logic        mode_i,
  input  logic        divider_i,
  input  logic        xtest0_i,
  input  logic        xtest1_i,
  input  logic        xcs_i,
  input  logic        xrd_r_w_i,
  input  logic        xwr_e_clock_i,
  input  logic        ale_as_i,
  input  logic [10:0] ab_i,
  input  logic [7:0]  db_i,
  input  logic        rxd_i,
  input  logic        xcts_i,
  output logic        xready_xdtack_o,
  output logic [7:0]  db_o,
  output logic        db_oe_o,
  output logic        x_int_o,
  output logic        xdataexch_o,
  output logic        txd_o,
  output logic        rts_o,
  output logic        clkout2_4_o
);
  assign {xready_xdtack_o, x_int_o, xdataexch_o, txd_o} = 4'b1111;
  assign {rts_o, clkout2_4_o, db_oe_o} = 3'b000;
  assign db_o = 8'h00;
endmodule
