// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The own address (S5, S33): of the initialisation or of Set_Slave_Address, and whether the latter may change it.
`include "profibus_types.svh"

module dp_address (
  `FAULT_PORT
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       init_i,           // an initialisation is committed
  input  logic [6:0] init_address_i,
  input  logic       set_i,            // Set_Slave_Address is executed
  input  logic [6:0] new_address_i,
  input  logic [7:0] no_add_chg_i,
  output logic [6:0] address_o,
  output logic       locked_o,         // No_Add_Chg
  output logic       delivery_o        // it was 126 an edge ago
);
  localparam logic [6:0] NO_ADDRESS = 7'h7F;
  localparam logic [6:0] DELIVERY_ADDRESS = 7'd126;

  logic [6:0] address_q;
  logic locked_q, locks;
  assign locks =
`ifdef SINGLE_FAULTS
      `FAULT(186) ? no_add_chg_i[0] :
`endif
      no_add_chg_i != 8'h00;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      address_q <= NO_ADDRESS;
      locked_q <= 1'b0;
    end else if (init_i) begin
      address_q <= init_address_i;
      locked_q <= 1'b0;
    end else if (set_i) begin
      address_q <= new_address_i;
      locked_q <= locks;
    end
  end

  logic delivery_q;
  always_ff @(posedge clk_i) delivery_q <= address_q == DELIVERY_ADDRESS && !`FAULT(125);

  assign address_o = address_q;
  assign locked_o = locked_q;
  assign delivery_o = delivery_q;
endmodule
