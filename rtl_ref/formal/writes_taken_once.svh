// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into host_port (P5, P8). A step is a cycle of CLK. WR rises once in a cycle at most, as its rises are 25 ns apart (table 15), at any time of it; CSR says
// whether it is a write: with CSR low and after R it is. Any one write is followed: its A and D leave after those of the writes before it and no others, once, and
// at the third edge. RESET falls at any time.
wire writes = listens_q && !csr_i;
wire picks = $anyseq;
reg picked = 1'b0;
reg [18:0] followed = 19'd0;
reg [2:0] made = 3'd0, made_at = 3'd0, left = 3'd0;
reg [1:0] waits = 2'd0;
always @(posedge clk_i) begin
  if (!rst_ni) begin
    made <= 3'd0;
    left <= 3'd0;
    picked <= 1'b0;
  end else begin
    if (writes) made <= made + 3'd1;
    if (we_o) left <= left + 3'd1;
    if (writes && picks && !picked) begin
      picked <= 1'b1;
      made_at <= made;
      followed <= {a_i, d_i};
    end else if (we_o && left == made_at) picked <= 1'b0;
  end
  waits <= !rst_ni || left == made || we_o ? 2'd0 : waits + 2'd1;
end
initial assume (!rst_ni);
always @* if (rst_ni) begin
  if (we_o) assert (left != made);
  if (we_o && picked && left == made_at) assert ({waddr_o, wdata_o} == followed);
  assert (waits <= 2'd2);
end
