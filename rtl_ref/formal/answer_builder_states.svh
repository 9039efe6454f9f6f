// Bound into answer_builder.
initial assume (!rst_ni);
always @* assert (state_q <= ED);
