// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The user's asynchronous port (section 12; 5.2, P5, P8, P11, P12).
//
// Writes go through a FIFO of four that WR clocks, with a Gray pointer through two flip-flops. Reads take A at the first rising edge
// of CLK after RD's fall and drive D from its falling edge on. The document's X is a definite value here.
`include "dsdpv1_types.svh"

module host_port (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        csr_i,
  input  logic        rd_i,
  input  logic        wr_i,
  input  logic [10:0] a_i,
  input  logic [7:0]  d_i,
  output logic [7:0]  d_o,
  output logic        d_oe_o,
  output logic        we_o,      // a write settles at this edge
  output logic [10:0] waddr_o,
  output logic [7:0]  wdata_o,
  output logic [10:0] raddr_o,
  input  logic [7:0]  rdata_i
);
  // The port listens after R, the first edge without reset (section 12)
  logic listens_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) listens_q <= 1'b0;
    else listens_q <= 1'b1;
  end

  // ---- clocked by WR
  logic [18:0] entry0_q, entry1_q, entry2_q, entry3_q;
  logic [2:0] head_q, head_next, head_gray_q;
  logic [18:0] entry;
  assign head_next = head_q + 3'd1;
  assign entry = {a_i, d_i};
  logic takes;
  assign takes = listens_q && (!csr_i || `FAULT(47));

  always_ff @(posedge wr_i or negedge rst_ni) begin
    if (!rst_ni) begin
      head_q <= 3'd0;
      head_gray_q <= 3'd0;
    end else if (takes) begin
      head_q <= head_next;
      head_gray_q <= head_next ^ {1'b0, head_next[2:1]};
    end
  end

  always_ff @(posedge wr_i) begin
    if (takes) begin
      case (head_q[1:0])
        2'd0: entry0_q <= entry;
        2'd1: entry1_q <= entry;
        2'd2: entry2_q <= entry;
        default: entry3_q <= entry;
      endcase
`ifdef SINGLE_FAULTS
      if (`FAULT(207) && head_q[1:0] == 2'd2) entry0_q <= entry;
      if (`FAULT(207) && head_q[1:0] == 2'd3) entry1_q <= entry;
`endif
    end
  end

  // ---- clocked by CLK
  logic [2:0] gray_first_q, gray_q, tail_q, tail_gray;
  assign tail_gray = tail_q ^ {1'b0, tail_q[2:1]};
  assign we_o = gray_q != tail_gray;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      gray_first_q <= 3'd0;
      gray_q <= 3'd0;
      tail_q <= 3'd0;
    end else begin
      gray_first_q <= head_gray_q;
      gray_q <= gray_first_q;
      if (we_o) tail_q <= tail_q + 3'd1;
    end
  end

  logic [18:0] oldest;
  logic [1:0] tail_low;
  assign tail_low =
`ifdef SINGLE_FAULTS
      `FAULT(207) ? {1'b0, tail_q[0]} :
`endif
      tail_q[1:0];
  always_comb begin
    case (tail_low)
      2'd0: oldest = entry0_q;
      2'd1: oldest = entry1_q;
      2'd2: oldest = entry2_q;
      default: oldest = entry3_q;
    endcase
  end
  assign waddr_o = oldest[18:8];
  assign wdata_o = oldest[7:0];

  // ---- reads
  logic reads, open_q, taken_q, driven_q;
  logic [7:0] d_q;
  assign reads = !rd_i && !csr_i;
  assign raddr_o = a_i;

  // An access that begins before R is none, until RD or CSR has risen. Its beginning is the clock, so that no edge of CLK changes the drivers of D.
  always_ff @(posedge reads or negedge rst_ni) begin
    if (!rst_ni) open_q <= 1'b0;
    else open_q <= listens_q;
  end

  // RD and CSR fall at any time: taken_q may be undecided for half a cycle, so it has one reader, driven_q. D loads until then, whatever taken_q is.
  always_ff @(posedge clk_i or negedge reads) begin
    if (!reads) taken_q <= 1'b0;
    else taken_q <= 1'b1;
  end

  always_ff @(negedge clk_i or negedge reads) begin
    if (!reads) driven_q <= 1'b0;
    else driven_q <= taken_q;
  end

  always_ff @(negedge clk_i) begin
    if (!driven_q) d_q <= rdata_i;
`ifdef SINGLE_FAULTS
    if (`FAULT(208) && taken_q) d_q <= rdata_i;
`endif
  end

  assign d_o = d_q;
  assign d_oe_o = reads && open_q;
endmodule
