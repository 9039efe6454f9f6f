// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// INTR0 (section 13, P7): low for low_i cycles after a flag of parameters or configuration, and high for at least gap_i cycles between
// two pulses.
`include "dsdpv1_types.svh"

module interrupt (
  `FAULT_PORT
  input  logic [13:0] low_i,    // both at least 1
  input  logic [13:0] gap_i,
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        flag_i,   // at this edge
  output logic        intr0_o
);
  logic waiting_q, low_q, falls, rises;
  logic [13:0] count_q;  // cycles until the pulse, or the gap after it, may end

  assign falls = waiting_q && !low_q && (count_q == 14'd0 || `FAULT(45));
  assign rises = low_q && count_q == 14'd0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      waiting_q <= 1'b0;
      low_q <= 1'b0;
      count_q <= 14'd0;
    end else begin
      waiting_q <= (waiting_q || flag_i) && !falls;
`ifdef SINGLE_FAULTS
      if (`FAULT(171) && !low_q && count_q != 14'd0) waiting_q <= waiting_q;
`endif
      if (falls) begin
        low_q <= 1'b1;
        count_q <= low_i - (`FAULT(46) ? 14'd2 : 14'd1);
      end else if (rises) begin
        low_q <= 1'b0;
        count_q <= gap_i - 14'd1;
`ifdef SINGLE_FAULTS
        if (`FAULT(209) && gap_i != 14'd1) count_q <= gap_i - 14'd2;
`endif
      end else if (count_q != 14'd0) begin
        count_q <= count_q - 14'd1;
      end
    end
  end

  // A separate register: 1 in reset
  logic intr0_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) intr0_q <= 1'b1;
    else if (falls) intr0_q <= 1'b0;
    else if (rises) intr0_q <= 1'b1;
  end
  assign intr0_o = intr0_q;
endmodule
