// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The DPRAM of 2 KB (4.1, P4). Four block RAMs with one write port each, interleaved by the low address bits: the chip moves along
// ascending addresses, so a user who writes without owning the DPRAM (P12) finds a free port at once or a cycle or two later. Until
// then that write is in a queue that reads check: it counts as made in the cycle in which it settled.
`include "dpram_types.svh"

module dpram (
`ifdef SINGLE_FAULTS
  `FAULT_PORT
`endif
  input  logic        clk_i,
  input  logic        rst_ni,
  // the user's writes and reads
  input  logic        user_we_i,
  input  logic [10:0] user_waddr_i,
  input  logic [7:0]  user_wdata_i,
  input  logic [10:0] user_raddr_i,
  // the chip: one byte a cycle
  input  logic        chip_owns_i,
  input  logic        chip_we_i,
  input  logic [10:0] chip_addr_i,
  input  logic [7:0]  chip_wdata_i,
  output logic [7:0]  rdata_o
);
  // Queue of the user's writes: the one that settles at this edge, and two older ones
  logic first_valid_q, second_valid_q;
  logic [18:0] first_q, second_q, settling, head;
  logic head_valid, head_overwritten, head_blocked, head_goes, settles;
  logic [10:0] head_addr, first_addr, second_addr;
  logic [7:0] head_data;
  assign settling = {user_waddr_i, user_wdata_i};
  assign first_addr = first_q[18:8];
  assign second_addr = second_q[18:8];
  assign head_valid = first_valid_q || user_we_i;
  assign head = first_valid_q ? first_q : settling;
  assign head_addr = head[18:8];
  assign head_data = head[7:0];
  // At the same edge the chip's write comes after the user's: it hides an equal address
  assign head_overwritten = chip_we_i && head_addr == chip_addr_i;
  assign head_blocked = chip_we_i && head_addr[1:0] == chip_addr_i[1:0] && !head_overwritten;
  assign head_goes =
`ifdef SINGLE_FAULTS
      (`FAULT(205) && head_valid) ||
`endif
      head_valid && !head_blocked;
  assign settles = user_we_i && !(chip_we_i && user_waddr_i == chip_addr_i);

  logic first_stays, second_stays;
  assign first_stays = first_valid_q && !head_goes;
  assign second_stays = second_valid_q && !(chip_we_i && second_addr == chip_addr_i);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      first_valid_q <= 1'b0;
      second_valid_q <= 1'b0;
      first_q <= 19'd0;
      second_q <= 19'd0;
    end else if (first_stays) begin
      if (!second_stays) begin
        second_valid_q <= settles;
        second_q <= settling;
      end
    end else begin
      first_valid_q <= second_stays || (settles && (first_valid_q || !head_goes));
      first_q <= second_stays ? second_q : settling;
      second_valid_q <= second_stays && settles;
      second_q <= settling;
    end
  end

  // The newest write that has settled and is not yet in the RAM
  logic [10:0] raddr;
  logic [7:0] newest_q;
  logic from_queue_q, hit_settling, hit_first, hit_second;
  assign raddr = chip_owns_i ? chip_addr_i : user_raddr_i;
  assign hit_settling = user_we_i && user_waddr_i == raddr;
  assign hit_second = second_valid_q && second_addr == raddr;
  assign hit_first = first_valid_q && first_addr == raddr;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      from_queue_q <= 1'b0;
      newest_q <= 8'd0;
    end else begin
      from_queue_q <= hit_settling || hit_second || hit_first;
      newest_q <= hit_settling ? user_wdata_i : hit_second ? second_q[7:0] : first_q[7:0];
    end
  end

  logic [3:0] we;
  logic [35:0] waddr;
  logic [31:0] wdata, rdata;
  logic [1:0] lane_q;
  genvar lane;
  generate
    for (lane = 0; lane < 4; lane = lane + 1) begin : g_lane
      logic chip_here, user_here;
      assign chip_here = chip_we_i && chip_addr_i[1:0] == lane;
      assign user_here = head_goes && !head_overwritten && head_addr[1:0] == lane;
      assign we[lane] = chip_here || user_here;
      assign waddr[lane*9+:9] = chip_here ? chip_addr_i[10:2] : head_addr[10:2];
      assign wdata[lane*8+:8] = chip_here ? chip_wdata_i : head_data;
      buffer_ram #(.ADDRESS_BITS(9), .BYTES(512)) u_ram (
        .clk_i(clk_i), .we_i(we[lane]), .waddr_i(waddr[lane*9+:9]), .wdata_i(wdata[lane*8+:8]),
        .raddr_i(raddr[10:2]), .rdata_o(rdata[lane*8+:8]));
    end
  endgenerate

  always_ff @(posedge clk_i) lane_q <= raddr[1:0];

  logic [7:0] ram_data, lane0, lane1, lane2, lane3;
  assign {lane3, lane2, lane1, lane0} = rdata;
  always_comb begin
    case (lane_q)
      2'd0: ram_data = lane0;
      2'd1: ram_data = lane1;
      2'd2: ram_data = lane2;
      default: ram_data = lane3;
    endcase
  end
  assign rdata_o = from_queue_q ? newest_q : ram_data;
endmodule
