// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bound into serial_port. The two bytes of a telegram that were taken last against the CRC of those before them, as it stands at its judgement: where
// they differ, nothing is written, B014 stays, and the first byte of the reply, with UART's exchange the second, says that it is an error.
reg [15:0] taken = 16'd0;
reg wrong = 1'b0, second = 1'b0, frame = 1'b0;
wire is_spi = $anyconst;  // the straps, in force from R on
wire differs = judged ? taken != crc : wrong;
wire replies_first = gives && crc_give && crc_give_first;
wire is_exchange = uart_i && !reply_byte[7];
always @(posedge clk_i) begin
  if (take) taken <= {taken[7:0], request_byte};
  wrong <= rst_ni && differs;
  if (!rst_ni) second <= 1'b0;
  else if (gives) second <= replies_first && is_exchange;
  frame <= rst_ni && (frame || frame_begins) && !frame_ends;
end
initial assume (!rst_ni);
always @* begin
  assume (!(take && judged));  // a byte lasts more than a cycle
  assume (spi_i == is_spi && uart_i == !is_spi);
  assume (uart_i || !(uart_take || spoil || silence));                // by construction in host_uart
  assume (spi_i || !(spi_take || frame_begins || frame_ends));       // ... and in spi_port
  if (spi_i) assume (!(frame_begins && frame) && !(frame_begins && frame_ends) && (frame || !take));
  if (uart_i) assume (!(take && more) && (more || !next));  // half duplex
  if (judged && taken != crc) assert (judgement.refused && !judgement.commits && !judgement.owns);
  if (replies_first && differs && !is_exchange) assert (reply_byte[7:5] == 3'b111);
  if (second && gives && wrong) assert (reply_byte[7]);
end
