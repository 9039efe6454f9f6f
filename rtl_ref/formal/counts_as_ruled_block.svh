// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into dpram_block, for counts_as_ruled. A block lies between B020 and B7E0, whatever its length byte says; 0 left are 256.
`ifndef TWIN
wire [11:0] block_end = {1'b0, addr_q} + (left_q == 8'd0 ? 12'd256 : {4'd0, left_q});
always @* begin
  if (state_i == SEQ_READ_HEADER) assert (header_q <= 2'd2 && addr_q > 11'h020 && addr_q + header_q <= 11'h6D3);
  if (state_i == SEQ_READ_LOOK) assert (addr_q > 11'h020 && addr_q <= 11'h6D4);
  if (state_i == SEQ_WRITE_INPUT_LENGTH) assert (addr_q == DSDPV1_REG_CFG_OUTPUT_LENGTH + 11'd1);
  if (state_i == SEQ_WRITE_LENGTH) assert (addr_q == DSDPV1_REG_CFG_OUTPUT_LENGTH + 11'd2);
  if (data_moves) assert (addr_q > 11'h020 && block_end <= 12'h7E0);
  if (state_i > SEQ_CHOICE && state_i != SEQ_READ_CRC_LOW && state_i != SEQ_WRITE_CRC_LOW && state_i != SEQ_READ_LAST && state_i != SEQ_FLAG && state_i != SEQ_COMMIT && state_i != SEQ_ERRORS &&
      state_i != SEQ_VERDICT)
    assert (crc_addr_q >= DSDPV1_REG_INIT_CRC && crc_addr_q <= DSDPV1_REG_C2_CRC);
  if (state_i == SEQ_READ_CRC_LOW || state_i == SEQ_WRITE_CRC_LOW) assert (crc_addr_q > DSDPV1_REG_INIT_CRC && crc_addr_q <= DSDPV1_REG_C2_CRC + 11'd1);
end
`endif
