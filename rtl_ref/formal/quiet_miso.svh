// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into spi_port.
reg loaded = 1'b0;  // another byte than FF, in this frame
always @(posedge clk_i) loaded <= rst_ni && !ends_o && (loaded || (load_i && load_byte_i != 8'hFF));
initial assume (!rst_ni);
always @* begin
  assert (!(miso_oe_o && xss_i));
  assert (!(miso_oe_o && !rst_ni));
  if (!loaded) assert (tx0_q == 8'hFF && tx1_q == 8'hFF);
end
