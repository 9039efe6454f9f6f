// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dpram_sequencer: states, and the items that each may work on.
wire reads = state_q == SEQ_READ_LOOK || state_q == SEQ_READ_BYTES || state_q == SEQ_READ_CRC_HIGH || state_q == SEQ_READ_CRC_LOW ||
             state_q == SEQ_READ_LAST;
wire writes = state_q == SEQ_WRITE_BYTES || state_q == SEQ_WRITE_CRC_HIGH || state_q == SEQ_WRITE_CRC_LOW || state_q == SEQ_FLAG;
wire long_header = item_q == ITEM_DIAG || item_q == ITEM_C1_ANSWER || item_q == ITEM_C2_ANSWER;
initial assume (!rst_ni);
always @* begin
  assert (state_q <= SEQ_ERRORS);
  assert (own_q == (state_q != SEQ_IDLE && state_q != SEQ_RELEASED));
  if (reads) assert (item_q == ITEM_INIT || item_q == ITEM_INPUTS || long_header);
  if (state_q == SEQ_READ_HEADER) assert (long_header);
  if (state_q == SEQ_VERDICT) assert (item_q == ITEM_VERDICT_PRM || item_q == ITEM_VERDICT_CFG);
  if (state_q == SEQ_COMMIT) assert (item_q <= ITEM_C2_ANSWER);
  if (state_q == SEQ_WRITE_INPUT_LENGTH || state_q == SEQ_WRITE_LENGTH) assert (item_q == ITEM_CFG);
  if (writes) assert (item_q >= ITEM_PRM && item_q <= ITEM_C2_REQUEST);
  if (state_q == SEQ_ERRORS) assert (item_q == ITEM_STATUS_2);
end
