// Bound into telegram_rx.
initial assume (!rst_ni);
always @* begin
  assert (state_q <= COMPLETE);
  assert (field_q <= ED);
  assert (sd_q <= SD_SC);
end
