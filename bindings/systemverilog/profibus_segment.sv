// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The two wires of a segment: a station with an enabled driver (RTS) puts its TXD on them, low wins, 1 is idle. Connect a chip's PBRXD to
// line_o, and a profibus_master to the combined outputs of the others.
module profibus_segment #(
  parameter integer STATIONS = 2
) (
  input  logic [STATIONS-1:0] txd_i,
  input  logic [STATIONS-1:0] rts_i,
  output logic                line_o,
  output logic [STATIONS-1:0] others_o,     // the level that all other stations put on the line
  output logic [STATIONS-1:0] others_en_o   // whether one of them drives it
);
  timeunit 1ps;
  timeprecision 1ps;
  // An unknown RTS is off, an unknown TXD is idle: a chip before its reset.
  logic [STATIONS-1:0] low, on;
  integer i;
  always @* begin
    for (i = 0; i < STATIONS; i = i + 1) begin
      on[i] = rts_i[i] === 1'b1;
      low[i] = on[i] && txd_i[i] === 1'b0;
    end
    line_o = !(|low);
    for (i = 0; i < STATIONS; i = i + 1) begin
      others_o[i] = !(|(low & ~({{(STATIONS-1){1'b0}}, 1'b1} << i)));
      others_en_o[i] = |(on & ~({{(STATIONS-1){1'b0}}, 1'b1} << i));
    end
  end
endmodule
