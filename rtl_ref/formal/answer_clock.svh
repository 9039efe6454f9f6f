// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into uart_rx (8.3). The answer's clock: at the edge after a character's C it stands at lead + 3 - half cycles, that is at the cycles since the request's end on the wire,
// with the two of the synchroniser taken back, and PBRTS's lead. Each edge adds one.
reg loaded = 1'b0, runs = 1'b0;
reg [3:0] rate_loaded = 4'd0;
reg [5:0] bits_before = 6'd0;
reg [12:0] phase_before = 13'd0, bit_before = 13'd4;
`ifdef TWIN
wire signed [19:0] len = 20'sd4;  // the shortest trace
`else
wire signed [19:0] len = $signed({7'd0, bit_cycles(rate_loaded)});
`endif
wire signed [19:0] bits = clock_bits_q == 6'd63 ? -20'sd1 : $signed({14'd0, clock_bits_q});
wire signed [19:0] phase = $signed({7'd0, clock_phase_q});
wire signed [19:0] ahead = $signed({14'd0, rts_lead_i}) + 20'sd3 - (len >>> 1);
always @(posedge clk_i) begin
  loaded <= rst_ni && complete;
  runs <= rst_ni && !complete;
  rate_loaded <= rate_i;
  bits_before <= clock_bits_q;
  phase_before <= clock_phase_q;
  bit_before <= bit_len;
end
wire [5:0] any_lead = $anyconst;
initial assume (!rst_ni);
always @* begin
  assume (rate_i <= RATE_LAST && rts_lead_i == any_lead && any_lead <= 6'd32);
`ifdef TWIN
  assume (rate_i == 4'd0 && any_lead == 6'd4 && run_i && !restart_rate_i && !restart_rts_i);
`endif
  if (rst_ni && loaded) assert (phase >= 20'sd0 && phase < len && bits * len + len - 20'sd1 - phase == ahead);
  if (rst_ni && runs && phase_before != 13'd0) assert (clock_bits_q == bits_before && clock_phase_q == phase_before - 13'd1);
  if (rst_ni && runs && phase_before == 13'd0) assert (clock_bits_q == bits_before + 6'd1 && clock_phase_q == bit_before - 13'd1);
end
