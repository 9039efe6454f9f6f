// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into host_port (P5, P8), with both clocks as signals. A step is 25/6 ns, a fifth of a cycle of CLK. WR rises at any step, six steps (25 ns) after its last rise or more: 12.5 ns low are Ts
// of table 15, 12.5 ns high an assumption, as in the constraints. Any one write is followed: its data leave after those of the writes before it and no others, once, at the third edge of CLK after
// the rise. RESET falls at any step and is released by CLK. Bit 0 of the data stands for all bits of A and D: the pointers alone steer each of them.
wire picks = $anyseq;
reg [2:0] phase = 3'd0, since = 3'd6, made = 3'd0, made_at = 3'd0, left = 3'd0;
reg [1:0] edges = 2'd0;
reg clk_before = 1'b0, wr_before = 1'b0, rst_before = 1'b0, takes_before = 1'b0, we_before = 1'b0, d_before = 1'b0, data_before = 1'b0, picked = 1'b0, followed = 1'b0;
wire clk_rises = clk_i && !clk_before, wr_rises = wr_i && !wr_before;
wire up = rst_ni && rst_before;
wire writes = wr_rises && takes_before && up, settles = clk_rises && we_before && up;
wire here = settles && picked && left == made_at;
always @($global_clock) begin
  phase <= phase == 3'd4 ? 3'd0 : phase + 3'd1;
  since <= wr_rises ? 3'd1 : since == 3'd6 ? 3'd6 : since + 3'd1;
  clk_before <= clk_i;
  wr_before <= wr_i;
  rst_before <= rst_ni;
  takes_before <= listens_q && !csr_i;
  we_before <= we_o;
  d_before <= d_i[0];
  data_before <= wdata_o[0];
  if (!rst_ni) {made, left, picked} <= 7'd0;
  else begin
    if (writes) made <= made + 3'd1;
    if (settles) left <= left + 3'd1;
    if (here) picked <= 1'b0;
    else if (picked && clk_rises) edges <= edges + 2'd1;
    if (writes && picks && !picked) begin
      picked <= 1'b1;
      made_at <= made;
      followed <= d_before;
      edges <= 2'd0;
    end
  end
end
initial assume (!rst_ni);
always @* begin
  assume (clk_i == (phase < 3'd2));
  if (wr_rises) assume (since == 3'd6);
  if (rst_ni && !rst_before) assume (clk_rises);
  if (up) begin
    if (settles) assert (left != made);
    if (here) assert (data_before == followed && edges == 2'd2);
    if (picked && clk_rises && edges == 2'd2) assert (here);
  end
end
