// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into telegram_rx (section 7). A telegram that is decided, SC and SD4 aside, was received with ED as its last character, before it the sum of those
// before without the header, and each had a right parity and stop bit.
reg [7:0] sum = 8'd0, sum_1 = 8'd0, sum_2 = 8'd0, last_1 = 8'd0, last_2 = 8'd0;
reg [1:0] header = 2'd0;
reg wrong = 1'b1;
wire with_fcs = sd_o == SD_SD1 || sd_o == SD_SD2 || sd_o == SD_SD3;
always @(posedge clk_i) begin
  if (valid_i) begin
    sum_2 <= sum_1;
    sum_1 <= begin_o ? 8'd0 : sum;
    sum <= begin_o || header != 2'd0 ? 8'd0 : sum + char_i;
    last_1 <= char_i;
    last_2 <= last_1;
    header <= begin_o ? (char_i == 8'h68 ? 2'd3 : 2'd0) : header == 2'd0 ? 2'd0 : header - 2'd1;
    wrong <= !ok_i || (wrong && !begin_o);
  end
end
initial assume (!rst_ni);
always @* begin
  if (rst_ni && decide_o && with_fcs) assert (!wrong && last_1 == 8'h16 && last_2 == sum_2);
`ifndef TWIN  // what makes this inductive
  assert (state_q <= COMPLETE);
  if (rst_ni && state_q != NONE) assert (!wrong);
  if (rst_ni && state_q == COMPLETE && with_fcs) assert (last_1 == 8'h16 && last_2 == sum_2);
  if (rst_ni && state_q == RECEIVING) begin
    assert (field_q <= ED);
    assert (header == (field_q == LE ? 2'd3 : field_q == LER ? 2'd2 : field_q == SD2 ? 2'd1 : 2'd0));
    if (field_q >= DA && field_q <= FCS) assert (sum == sum_q);
    if (field_q == ED && fcs_ok_q) assert (last_1 == sum_1);
    if (field_q <= SD2) assert (sum_q == 8'd0 && sum == 8'd0);
  end
`endif
end
