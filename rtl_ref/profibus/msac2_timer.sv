// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// A timer of a C2 channel (15.2; V3, V12): units x 480 000 cycles from its start. It is loaded one edge after the start, and its end
// is seen one edge ahead, so that neither lengthens the path through a decision.
`include "profibus_types.svh"

module msac2_timer (
`ifdef SINGLE_FAULTS
  `FAULT_PORT
`endif
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        start_i,  // at this edge, also when it runs
  input  logic        stop_i,
  input  logic [15:0] units_i,  // of 10 ms, not 0; at the edge after the start
  input  logic        late_i,   // one cycle more, at the same edge: for faults
  output logic        end_o     // it ends at this edge
);
  localparam logic [18:0] UNIT_LAST = 19'd479999;

  logic [18:0] base_q;
  logic [15:0] units_q;
  logic running_q, load_q, last_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      base_q <= 19'd0;
      units_q <= 16'd0;
      {running_q, load_q, last_q} <= 3'b000;
    end else begin
      running_q <= start_i || (running_q && !stop_i);
      load_q <= start_i;
      last_q <= running_q && !start_i && !stop_i && !load_q && base_q == 19'd1 && units_q == 16'd0;
      if (load_q) begin
        base_q <= late_i ? UNIT_LAST : UNIT_LAST - 19'd1;
        units_q <= units_i - 16'd1;
`ifdef SINGLE_FAULTS
        if (`FAULT(173)) units_q <= {8'h00, units_i[7:0] - 8'd1};
`endif
      end else if (base_q == 19'd0) begin
        base_q <= UNIT_LAST;
        units_q <= units_q - 16'd1;
      end else begin
        base_q <= base_q - 19'd1;
      end
    end
  end

  assign end_o = last_q;
endmodule
