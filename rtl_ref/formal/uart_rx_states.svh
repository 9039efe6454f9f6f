// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into uart_rx.
initial assume (!rst_ni);
always @* begin
  assert (state_q <= BREAK);
  assert (sample_q <= 4'd11);
  if (state_q == RECEIVING) begin
    assert (sample_q <= 4'd10);
    assert (start_bit_q == (sample_q == 4'd0));
    assert (stop_bit_q == (sample_q == 4'd10));
  end
end
