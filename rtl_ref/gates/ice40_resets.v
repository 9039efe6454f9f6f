// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The iCE40's flip-flops with asynchronous reset or set, in place of those of Yosys's cells_sim.v: those take it at its rise only, those of the device
// for as long as it is high. They begin unknown. A level that is there from power-on on counts from the next edge on, or from its own end.

module ice40_reset_by_level #(parameter [0:0] VALUE = 1'b0) (output reg q_o, input c_i, input e_i, input r_i, input d_i);
  reg was_high = 1'b0;
  always_latch if (r_i) was_high = 1'b1;
  always @(posedge c_i, posedge r_i) if (r_i) q_o <= VALUE; else if (e_i) q_o <= d_i;
  always @(negedge r_i) if (was_high) q_o <= VALUE;
endmodule

module SB_DFFR(output Q, input C, R, D);
  ice40_reset_by_level #(1'b0) u_q (.q_o(Q), .c_i(C), .e_i(1'b1), .r_i(R), .d_i(D));
endmodule
module SB_DFFS(output Q, input C, S, D);
  ice40_reset_by_level #(1'b1) u_q (.q_o(Q), .c_i(C), .e_i(1'b1), .r_i(S), .d_i(D));
endmodule
module SB_DFFER(output Q, input C, E, R, D);
  ice40_reset_by_level #(1'b0) u_q (.q_o(Q), .c_i(C), .e_i(E), .r_i(R), .d_i(D));
endmodule
module SB_DFFES(output Q, input C, E, S, D);
  ice40_reset_by_level #(1'b1) u_q (.q_o(Q), .c_i(C), .e_i(E), .r_i(S), .d_i(D));
endmodule
module SB_DFFNR(output Q, input C, R, D);
  ice40_reset_by_level #(1'b0) u_q (.q_o(Q), .c_i(~C), .e_i(1'b1), .r_i(R), .d_i(D));
endmodule
module SB_DFFNS(output Q, input C, S, D);
  ice40_reset_by_level #(1'b1) u_q (.q_o(Q), .c_i(~C), .e_i(1'b1), .r_i(S), .d_i(D));
endmodule
module SB_DFFNER(output Q, input C, E, R, D);
  ice40_reset_by_level #(1'b0) u_q (.q_o(Q), .c_i(~C), .e_i(E), .r_i(R), .d_i(D));
endmodule
module SB_DFFNES(output Q, input C, E, S, D);
  ice40_reset_by_level #(1'b1) u_q (.q_o(Q), .c_i(~C), .e_i(E), .r_i(S), .d_i(D));
endmodule
