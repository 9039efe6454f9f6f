// Bound into serial_port. ... and reads nothing.
always @* begin
  assume (uart_i || !(uart_take || spoil || silence));  // by construction in host_uart
  assert (!(commit_reads && owns_i));
end
