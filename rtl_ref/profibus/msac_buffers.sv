// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bytes of DPV1 (section 15, section 3 on mail): requests and Initiates as they came, the user's answers, and the answer that the
// builder fetches after the decision.
//
// Nothing is copied at a decision. Every telegram's bytes go into the spare one of four banks; where they become a request, that bank
// and the requester's change places. A block of the user is read into its requester's answer, but only while that one has a request with the
// user: neither an answer that waits nor one that is being sent can change.
`include "profibus_types.svh"

module msac_buffers (
  `FAULT_PORT
  input  logic        clk_i,
  input  logic        rst_ni,
  // bytes from the bus
  input  logic        data_valid_i,
  input  logic [7:0]  data_index_i,
  input  logic [7:0]  data_i,
  input  logic [2:0]  accept_i,        // they are the request of C1, of channel 30, 2F
  // requests on their way to the user
  input  logic        take_c1_i,
  input  logic        take_c2_i,
  input  logic        owner_2f_i,
  input  logic [7:0]  transfer_index_i,
  output logic [7:0]  transfer_data_o,
  // bytes from the user
  input  logic        stage_i,         // a block begins
  input  logic        stage_taken_i,   // its request is with the user
  input  logic        stage_c2_i,
  input  logic        stage_we_i,
  input  logic [7:0]  stage_index_i,
  input  logic [7:0]  stage_data_i,
  // the answer to the telegram decided at this edge
  input  logic        reply_i,
  input  logic [1:0]  requester_i,     // MSAC_C1, _30, _2F
  input  logic        user_i,          // the user's answer, else
  input  logic [31:0] head_i,          // these four bytes, and after eight the Add_Addr
  input  logic        long_i,          // form of Add_Addr
  input  logic [7:0]  s_length_i,
  input  logic [7:0]  d_length_i,
  input  logic [7:0]  index_i,         // byte that is needed at the next edge
  output logic [7:0]  data_o
);
  // ---- banks of requests
  logic [1:0] c1_q, c30_q, c2f_q, spare_q, transfer_q, transfer_bank;
  assign transfer_bank =
`ifdef SINGLE_FAULTS
      `FAULT(197) && take_c2_i ? c30_q :
`endif
      take_c1_i ? c1_q : take_c2_i ? (owner_2f_i ? c2f_q : c30_q) : transfer_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      c1_q <= 2'd0;
      c30_q <= 2'd1;
      c2f_q <= 2'd2;
      spare_q <= 2'd3;
      transfer_q <= 2'd0;
    end else begin
      transfer_q <= transfer_bank;
      if (accept_i[0]) begin
        c1_q <= spare_q;
        spare_q <= c1_q;
      end
      if (accept_i[1]) begin
        c30_q <= spare_q;
        spare_q <= c30_q;
      end
      if (accept_i[2]) begin
        c2f_q <= spare_q;
        spare_q <= c2f_q;
      end
    end
  end

  logic [9:0] request_write, transfer_read;
  assign request_write = {spare_q, data_index_i};
  assign transfer_read = {transfer_bank, transfer_index_i};
  buffer_ram #(.ADDRESS_BITS(10), .BYTES(1024)) u_transfer (
    .clk_i(clk_i), .we_i(data_valid_i), .waddr_i(request_write), .wdata_i(data_i),
    .raddr_i(transfer_read), .rdata_o(transfer_data_o));

  // ---- answers of the user
  logic staged_q;
  logic [1:0] staged_bank_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      staged_q <= 1'b0;
      staged_bank_q <= MSAC_C1;
    end else if (stage_i) begin
      staged_q <= stage_taken_i;
      staged_bank_q <= !stage_c2_i ? MSAC_C1 : owner_2f_i ? MSAC_2F : MSAC_30;
    end
  end

  // ---- the answer that is being built
  logic user_q, long_q;
  logic [1:0] requester_q, initiate_bank_q;
  logic [7:0] from_d_q, from_s_q, s_begins_q, index_q, user_data, initiate_data, initiate_index, head_byte;
  logic [31:0] head_q;
  always_ff @(posedge clk_i) begin
    index_q <= index_i;
    if (reply_i) begin
      user_q <= user_i;
      requester_q <= requester_i;
      initiate_bank_q <= requester_i == MSAC_2F ? c2f_q : c30_q;
      head_q <= head_i;
      long_q <= long_i;
      s_begins_q <= 8'd12 + d_length_i;
      from_d_q <= 8'd4 + s_length_i;
      from_s_q <= 8'd4 - d_length_i;
    end
  end

  // Where the bytes of the answer's Add_Addr stand in Initiate, which has four bytes more in front of them (V2, V10): source and
  // destination exchanged, first of the types and lengths or the two bytes, then of the addresses
  logic [7:0] straight, exchanged;
  logic behind_head;
  assign straight = index_i + 8'd4;
  assign exchanged = straight ^ (long_q ? 8'd2 : `FAULT(72) ? 8'd0 : 8'd1);
  assign behind_head = index_i >= 8'd12 && !`FAULT(73);
  assign initiate_index = !behind_head ? exchanged : index_i + (index_i < s_begins_q ? from_d_q : from_s_q);

  logic [9:0] user_write, user_read, initiate_read;
  logic user_we;
  assign user_we = stage_we_i && staged_q;
  assign user_write = {staged_bank_q, stage_index_i};
  assign user_read = {requester_q, index_i};
  assign initiate_read = {initiate_bank_q, initiate_index};
  buffer_ram #(.ADDRESS_BITS(10), .BYTES(768)) u_user (
    .clk_i(clk_i), .we_i(user_we), .waddr_i(user_write), .wdata_i(stage_data_i), .raddr_i(user_read), .rdata_o(user_data));
  buffer_ram #(.ADDRESS_BITS(10), .BYTES(1024)) u_initiate (
    .clk_i(clk_i), .we_i(data_valid_i), .waddr_i(request_write), .wdata_i(data_i),
    .raddr_i(initiate_read), .rdata_o(initiate_data));

  logic [7:0] head_0, head_1, head_2, head_3;
  logic [1:0] head_index;
  assign {head_3, head_2, head_1, head_0} = head_q;
  assign head_index = index_q[1:0];
  always_comb begin
    case (head_index)
      2'd0: head_byte = head_0;
      2'd1: head_byte = head_1;
      2'd2: head_byte = head_2;
      default: head_byte = head_3;
    endcase
  end
  assign data_o = user_q ? user_data : index_q < 8'd4 ? head_byte : index_q < 8'd8 ? 8'h00 : initiate_data;
endmodule
