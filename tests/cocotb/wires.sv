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
