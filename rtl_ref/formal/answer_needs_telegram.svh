// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into fdl (8.2). An answer is ordered only at the edge at which a telegram with an FCS is decided: right_fcs. Its kind has stood for three edges
// before: its last character is older (uart_rx_deadline). Nothing is decided in the first three edges after RESET.
wire with_fcs = sd_i == SD_SD1 || sd_i == SD_SD2 || sd_i == SD_SD3;
reg [2:0] before = 3'b000, ran = 3'b000;
always @(posedge clk_i) begin
  before <= {before[1:0], with_fcs};
  ran <= {ran[1:0], rst_ni};
end
initial assume (!rst_ni);
always @* begin
  if (decide_i) assume (rst_ni && ran == 3'b111 && before == {3{with_fcs}});
  if (send_o || sends) assert (decide_i && with_fcs);
end
