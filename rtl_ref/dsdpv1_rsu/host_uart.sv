// The UART port (6.1, 6.2, 6.5; UA1 to UA4, UA16): characters to and from the host, half duplex, and the two waits that begin with a
// character's end: for the silence that ends a telegram, and for the first start bit of the reply.
`include "dsdpv1_rsu_types.svh"

module host_uart (
  `FAULT_PORT
  /* verilator lint_off UNUSEDSIGNAL */  // the upper bits of each
  input  logic [127:0] gaps_i,      // UA3: half characters by code, 16 bits each, code 0 lowest; 1 to 1000
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic [7:0]   min_tsdr_i,  // UA4: bit times
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         on_i,        // the mode is UART
  input  logic         begins_i,    // edge R
  input  logic [2:0]   ubr_i,
  input  logic [2:0]   uiv_i,
  input  logic         rxd_i,
  output logic         txd_o,
  input  logic [2:0]   interval_i,  // B019, 0 when it is no code
  input  logic [7:0]   tsdr_i,      // B01A
  // at this edge
  output logic         take_o,      // a right character
  output logic         spoil_o,     // a wrong one
  output logic         silence_o,
  output logic [7:0]   byte_o,
  input  logic         waits_i,     // the telegram waits for its first character
  input  logic         last_i,      // this one is the last of a telegram for this card
  // reply
  input  logic         judged_i,    // a telegram that is replied to, at this edge
  input  logic         busy_i,      // its commit was not done before this edge
  output logic         next_o,      // a character begins at this edge
  input  logic [7:0]   byte_i,
  input  logic         more_i
);
  function automatic logic [12:0] bit_of(input logic [2:0] code);
    case (code)
      3'd0: bit_of = 13'd5000;
      3'd1: bit_of = 13'd2500;
      3'd2: bit_of = 13'd1250;
      3'd3: bit_of = 13'd833;
      3'd4: bit_of = 13'd417;
      3'd5: bit_of = 13'd208;
      3'd6: bit_of = 13'd104;
      default: bit_of = 13'd26;
    endcase
  endfunction

  // Half characters as whole bit times; an odd number has half a bit besides
  function automatic logic [12:0] bits_of(input logic [9:0] halves);
    bits_of = {4'd0, halves[9:1]} * 13'd11 + (halves[0] ? 13'd5 : 13'd0);
  endfunction

  logic [12:0] bit_len, half;
  assign bit_len = bit_of(ubr_i);
  assign half = {1'b0, bit_len[12:1]};
  logic rxd;
  synchroniser #(.POWER_ON(1'b1)) u_rxd (.clk_i(clk_i), .d_i(rxd_i), .q_o(rxd));

  // ---- receiver
  localparam logic [1:0] IDLE = 2'd0;
  localparam logic [1:0] RECEIVING = 2'd1;
  localparam logic [1:0] BREAK = 2'd2;
  logic [1:0] state_q, state_d;
  logic [12:0] timer_q;
  logic [3:0] sample_q;  // of the next sample: 0 start bit, 1..8 data, 9 parity, 10 stop
  logic [8:0] shift_q;
  logic odd_q, answers_q, run, starts, samples, glitch, complete, break_ends, restarts, all_sent;
  assign run = on_i && (!answers_q || `FAULT(150));
  assign restarts = (on_i && begins_i) || all_sent;
  assign starts = run && state_q == IDLE && !rxd;
  assign samples = run && state_q == RECEIVING && timer_q == 13'd0;
  assign glitch = samples && sample_q == 4'd0 && rxd;
  assign complete = samples && sample_q == 4'd10;
  assign break_ends = run && state_q == BREAK && rxd;
  always_comb begin
    state_d = state_q;
    if (starts) state_d = RECEIVING;
    else if (glitch || break_ends) state_d = IDLE;
    else if (complete) state_d = rxd ? IDLE : BREAK;
    if (restarts) state_d = rxd ? IDLE : BREAK;
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= IDLE;
      timer_q <= 13'd0;
      sample_q <= 4'd0;
      shift_q <= 9'd0;
      odd_q <= 1'b0;
    end else begin
      state_q <= state_d;
      timer_q <= starts ? half - 13'd1 : samples ? bit_len - 13'd1 : timer_q - 13'd1;
      if (starts) begin
        sample_q <= 4'd0;
        odd_q <= 1'b0;
      end else if (samples) begin
        sample_q <= sample_q + 4'd1;
        if (sample_q != 4'd0 && !complete) begin
          shift_q <= {rxd, shift_q[8:1]};
          odd_q <= odd_q ^ rxd;
        end
      end
    end
  end
  assign take_o = complete && !odd_q && rxd;
  assign spoil_o = complete && !take_o;
  assign byte_o = shift_q[7:0];

  // ---- the wait from the character's end on, bit - half cycles after its last sample (or from where a break ends): the rest of a bit,
  // then whole ones. While the chip sends it counts the bits sent.
  logic [2:0] code_q, code;
  logic [12:0] interval_bits, phase_q, bits_q, first, bits;
  logic [103:0] bits_by_code;
  logic [7:0] odd_by_code;
  logic interval_odd, expired, sends_q, fires, bit_ends, starts_char;
  logic [7:0] tsdr;
  assign code = !waits_i ? code_q : interval_i != 3'd0 ? interval_i : uiv_i;
  assign bits_by_code = {
    bits_of(gaps_i[121:112]), bits_of(gaps_i[105:96]), bits_of(gaps_i[89:80]), bits_of(gaps_i[73:64]),
    bits_of(gaps_i[57:48]), bits_of(gaps_i[41:32]), bits_of(gaps_i[25:16]), bits_of(gaps_i[9:0])};
  assign odd_by_code = {gaps_i[112], gaps_i[96], gaps_i[80], gaps_i[64], gaps_i[48], gaps_i[32], gaps_i[16], gaps_i[0]};
  assign interval_bits = bits_by_code[{4'd0, code} * 7'd13+:13];
  assign interval_odd = odd_by_code[code];
  assign tsdr = tsdr_i > min_tsdr_i && !`FAULT(149) ? tsdr_i : min_tsdr_i;
  always_comb begin
    bits = interval_bits;
    if (last_i) begin
      first = bit_len - half - 13'd3;  // the synchroniser's two cycles are taken back
      bits = {5'd0, tsdr};
    end else if (break_ends) begin
      first = interval_odd ? half : 13'd0;
    end else begin
      first = interval_odd ? bit_len : bit_len - half;
    end
    if (`FAULT(148) && !last_i) first = first - 13'd1;
  end
  assign expired = phase_q == 13'd0 && bits_q == 13'd0;
  assign silence_o = run && expired && state_d == IDLE && !complete && !break_ends && !waits_i;

  // ---- transmitter
  logic [9:0] out_q;
  logic [3:0] bit_q;
  logic txd_q, parity;
  assign fires = answers_q && !sends_q && expired && !busy_i;
  assign bit_ends = sends_q && phase_q == 13'd0;
  assign starts_char = fires || (bit_ends && bit_q == 4'd10 && more_i);
  assign all_sent = bit_ends && bit_q == 4'd10 && !more_i;
  assign next_o = starts_char;
  assign parity = ^byte_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      code_q <= 3'd0;
      {phase_q, bits_q} <= 26'd0;
      {answers_q, sends_q} <= 2'b00;
      out_q <= 10'h3FF;
      bit_q <= 4'd0;
      txd_q <= 1'b1;
    end else begin
      if (complete) code_q <= code;
      if (complete || break_ends) begin
        phase_q <= first;
        bits_q <= bits;
      end else if (fires || bit_ends) begin
        phase_q <= bit_len - 13'd1;
      end else if (phase_q != 13'd0) begin
        phase_q <= phase_q - 13'd1;
      end else if (bits_q != 13'd0) begin
        phase_q <= bit_len - 13'd1;
        bits_q <= bits_q - 13'd1;
      end

      if (judged_i) answers_q <= 1'b1;
      else if (all_sent) answers_q <= 1'b0;
      if (fires) sends_q <= 1'b1;
      else if (all_sent) sends_q <= 1'b0;
      if (starts_char) begin
        bit_q <= 4'd0;
        out_q <= {1'b1, parity, byte_i};
        txd_q <= 1'b0;
      end else if (all_sent) begin
        txd_q <= 1'b1;
      end else if (bit_ends) begin
        bit_q <= bit_q + 4'd1;
        out_q <= {1'b1, out_q[9:1]};
        txd_q <= out_q[0];
      end
    end
  end
  assign txd_o = txd_q;
endmodule
