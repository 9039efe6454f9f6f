// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into user_banks (S4, D14). A commit belongs to the block that began last. From there to the commit the bank that it is read into is not in use,
// and no bank that an answer is being read from while it is built (fdl).
reg reads_inputs = 1'b0, reads_diag = 1'b0, sent_inputs = 1'b0, sent_diag = 1'b0;
always @(posedge clk_i) begin
  reads_inputs <= rst_ni && (begin_inputs_i || (reads_inputs && !commit_inputs_i));
  reads_diag <= rst_ni && (begin_diag_i || (reads_diag && !commit_diag_i));
  sent_inputs <= rst_ni && sends_inputs_i && begin_inputs_i;
  sent_diag <= rst_ni && sends_diag_i && begin_diag_i;
end
initial assume (!rst_ni);
always @* begin
  if (commit_inputs_i) assume (reads_inputs && !begin_inputs_i);
  if (commit_diag_i) assume (reads_diag && !begin_diag_i);
  if (rst_ni && reads_inputs) assert (stage_inputs_q != in1_q && stage_inputs_q != in2_q);
  if (rst_ni && reads_diag) assert (stage_diag_q != diag_q);
end
reg [1:0] sent_before = 2'd0;
always @(posedge clk_i) sent_before <= sent_i;
always @* begin
  if (rst_ni && sent_inputs) assert (stage_inputs_q != sent_before);
  if (rst_ni && sent_diag) assert (stage_diag_q != sent_before);
end
