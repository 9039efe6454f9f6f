// Bound into dpram_sequencer: states, and the items that each may work on.
wire reads = state_q == READ_LOOK || state_q == READ_BYTES || state_q == READ_CRC_HIGH || state_q == READ_CRC_LOW ||
             state_q == READ_LAST;
wire writes = state_q == WRITE_BYTES || state_q == WRITE_CRC_HIGH || state_q == WRITE_CRC_LOW || state_q == FLAG;
initial assume (!rst_ni);
always @* begin
  assert (state_q <= ERRORS);
  assert (own_q == (state_q != IDLE && state_q != RELEASED));
  if (reads) assert (item_q == INIT || item_q == INPUTS || item_q == DIAG);
  if (state_q == READ_HEADER) assert (item_q == DIAG);
  if (state_q == VERDICT) assert (item_q == VERDICT_PRM || item_q == VERDICT_CFG);
  if (state_q == COMMIT) assert (item_q <= DIAG);
  if (state_q == WRITE_INPUT_LENGTH || state_q == WRITE_LENGTH) assert (item_q == CFG);
  if (writes) assert (item_q == PRM || item_q == CFG || item_q == OUTPUTS);
  if (state_q == ERRORS) assert (item_q == STATUS_2);
end
