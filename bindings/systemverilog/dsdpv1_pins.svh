// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Inside of the modules that have all pins: the halves of a cycle of CLK, and the inputs as one number. Both are explained in
// bindings/simulator/simulator.h.
  longint half = 0;     // 2n since the rising edge n, 2n + 1 since the falling edge after it
  longint edge_ps = 0;  // when that was
  bit counts = 1'b0;    // the first rising edge has its number from its time, all others by counting

  task count_edge;
    edge_ps = $time;
    if (clk_i !== 1'b1) half = half | 1;
    else if (counts) half = (half | 1) + 1;
    else begin
      half = 2 * ((edge_ps * 6 + 62500) / 125000);
      counts = 1'b1;
    end
  endtask

  wire d_released = (^d_i) === 1'bx;
  // Of an X the level of rest, which is high for CSR, RD, WR and PBRXD.
  wire [26:0] inputs = {pbrxd_i !== 1'b0, d_released, d_released ? 8'h00 : d_i, (^a_i) === 1'bx ? 11'h000 : a_i, wr_i !== 1'b0, rd_i !== 1'b0,
                        csr_i !== 1'b0, r_sta_i === 1'b1, r_req_i === 1'b1, reset_i === 1'b1};
