// Bound into host_reply: bytes of a reply.
initial assume (!rst_ni);
always @* assert (state_q <= CRC_LOW);
