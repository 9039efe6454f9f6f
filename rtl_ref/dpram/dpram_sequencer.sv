// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The chip's accesses to the DPRAM (sections 9 and 10; H1 to H8, D1 to D17): one byte a cycle.
//
// The state says what the next edge does. A byte read at one edge is in rdata_i at the next.
`include "dpram_types.svh"

module dpram_sequencer (
  `FAULT_PORT `CRC_COUNTS_PORT
  input  logic [12:0] access_interval_i,  // H1
  input  logic [20:0] ready_cycles_i,     // D1
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        user_holds_i,     // or requests the DPRAM, by any port; synchronous to clk_i
  output logic        owns_o,           // from the cycle after the start to the last of an access
  output logic        interrupt_o,      // a flag of parameters or configuration is written at this edge
  // DPRAM
  output logic        we_o,
  output logic [10:0] addr_o,
  output logic [7:0]  wdata_o,
  input  logic [7:0]  rdata_i,
  // station
  output user_commands_t commands_o,
  /* verilator lint_off UNUSEDSIGNAL */
  input  user_hears_t hears_i           // its address and Global_Control are not reported to the user
  /* verilator lint_on UNUSEDSIGNAL */
);
  logic [4:0] state_q, state_d;
  logic [4:0] item_q, pick;
  logic [ITEMS-1:0] due, behind_q;
  logic own_q;
  logic first_choice_q;
  logic [7:0] u_q, w_q, e_q, v_q;
  logic read_on_q, dpv1_on_q;  // D17: B005 of this access, and of the initialisation
  logic [10:0] boot_q;
  logic [12:0] since_q;
  logic [20:0] up_q;
  logic valid_due_q;
  initialise_t initialise;
  verdict_t verdict;
  inputs_t inputs;
  diagnosis_t diagnosis;
  answers_t answers;
  stage_t stage;
  take_t take;

  // ---- what is heard from the station
  logic initialised, prm_mail, cfg_mail, output_mail, c1_mail, c2_mail;
  logic [7:0] prm_length, cfg_length, cfg_input_length, output_length, c1_length, c2_length, status_3;
  logic [15:0] count;
  assign initialised = hears_i.status.initialised;
  assign count = hears_i.status.left;
  assign status_3 = {hears_i.baud.found ? hears_i.baud.rate : 4'hF, hears_i.status.state, 2'b00};
  assign prm_mail = hears_i.mail.parameters.waits;
  assign prm_length = hears_i.mail.parameters.length;
  assign cfg_mail = hears_i.mail.configuration.waits;
  assign cfg_length = hears_i.mail.configuration.length;
  assign cfg_input_length = hears_i.mail.configuration.input_length;
  assign output_mail = hears_i.mail.outputs.waits;
  assign output_length = hears_i.mail.outputs.length;
  assign c1_mail = hears_i.c1.waits;
  assign c1_length = hears_i.c1.length;
  assign c2_mail = hears_i.c2.waits;
  assign c2_length = hears_i.c2.length;

  // ---- due accesses
  logic access_due, starts, boot_starts;
  assign access_due = since_q >= access_interval_i + (`FAULT(48) ? 13'd1 : 13'd0);
  assign starts = state_q == SEQ_IDLE && access_due && (!user_holds_i || `FAULT(97));
  assign boot_starts = state_q == SEQ_RELEASED && (!user_holds_i || `FAULT(98));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      since_q <= 13'd0;
      up_q <= 21'd0;
    end else begin
      if (starts || boot_starts) since_q <= 13'd1;
      else if (!(&since_q)) since_q <= since_q + 13'd1;
      if (up_q != ready_cycles_i) up_q <= up_q + 21'd1;
    end
  end

  // ---- status bytes
  logic chooses, crc_wrong_q, judged, judged_init, init_limits, status_1, status_4, keeps, clear_inputs;
  logic [6:0] status_due, status_written;
  logic [7:0] error_bit, set, clear;
  chip_status u_chip_status (
    .clk_i(clk_i), .rst_ni(rst_ni), .valid_due_i(valid_due_q), .count_i(count), .state_i(status_3), .judged_i(judged),
    .crc_wrong_i(crc_wrong_q), .error_bit_i(error_bit), .keeps_i(keeps), .clear_inputs_i(clear_inputs), .init_i(judged_init),
    .init_right_i(initialise.commit), .init_limits_i(init_limits), .written_i(status_written), .due_o(status_due), .initialised_o(status_1),
    .limits_o(status_4), .clear_o(clear), .set_o(set));

  logic [15:0] crc_q;
  logic [7:0] crc_high, crc_low;
  logic [1:0] boot_low;
  assign {crc_high, crc_low} = crc_q;
  assign boot_low = boot_q[1:0];

  // In the order of 9.2, the first in bit 0
  assign due = {
    status_due,
    c2_mail,
    c1_mail,
    output_mail,
    cfg_mail,
    prm_mail,
    w_q[1],
    w_q[0],
    u_q[1],
    u_q[0],
    w_q[7],
    u_q[6],
    u_q[7],
    u_q[2]};

  logic [ITEMS-1:0] candidates;
  assign candidates = due & behind_q;
  logic first_we;
  logic [10:0] first_addr;
  logic [7:0] first_wdata;
  dpram_choice u_choice (
    `FAULT_CONNECT
    .candidates_i(candidates), .command_2_i(w_q[6:0]), .mail_i(hears_i.mail), .c1_function_i(hears_i.c1.function_num),
    .c2_function_i(hears_i.c2.function_num), .count_i(count), .status_1_i(status_1), .status_3_i(status_3),
    .status_4_i(status_4), .pick_o(pick), .we_o(first_we), .addr_o(first_addr), .wdata_o(first_wdata));

  assign chooses = state_q == SEQ_CHOICE;
  logic take_prm, take_request;
  assign take_prm = chooses && pick == ITEM_PRM;
  assign take_request = chooses && (pick == ITEM_C1_REQUEST || pick == ITEM_C2_REQUEST);
  assign take.parameters = take_prm;
  assign take.configuration = chooses && pick == ITEM_CFG;
  assign take.outputs = chooses && pick == ITEM_OUTPUTS;
  assign take.c1 = chooses && pick == ITEM_C1_REQUEST;
  assign take.c2 = chooses && pick == ITEM_C2_REQUEST;
  assign clear_inputs = chooses && pick == ITEM_HISTORY && (w_q[6] || `FAULT(101)) && !`FAULT(100);
  assign keeps = item_q == ITEM_INPUTS && w_q[6] && !`FAULT(99);
  assign stage.inputs = chooses && pick == ITEM_INPUTS;
  assign stage.diagnosis = chooses && pick == ITEM_DIAG;
  assign stage.c1 = chooses && pick == ITEM_C1_ANSWER;
  assign stage.c2 = chooses && pick == ITEM_C2_ANSWER;
  assign status_written = {
    chooses && pick == ITEM_STATUS_4,
    chooses && pick == ITEM_STATUS_3,
    state_q == SEQ_ERRORS,
    chooses && pick == ITEM_STATUS_1,
    chooses && pick == ITEM_COUNT_LOW,
    chooses && pick == ITEM_COUNT_HIGH,
    chooses && pick == ITEM_VALID};

  // ---- blocks: base address, area of the CRC, limit
  logic [10:0] address_q, crc_address, crc_address_q;
  logic [7:0] limit, left_q, taken_q;
  logic [15:0] crc_next;
  logic [7:0] crc_byte;
  logic too_long, too_long_q;
  always_comb begin
    case (item_q)
      ITEM_INIT: limit = 8'd214;
      ITEM_INPUTS: limit = 8'd244;
      ITEM_DIAG: limit = 8'd238;
      default: limit = 8'd240;
    endcase
    case (pick)
      ITEM_INIT: crc_address = DSDPV1_REG_INIT_CRC;
      ITEM_INPUTS: crc_address = DSDPV1_REG_INPUT_CRC;
      ITEM_DIAG: crc_address = DSDPV1_REG_DIAG_CRC;
      ITEM_C1_ANSWER, ITEM_C1_REQUEST: crc_address = DSDPV1_REG_C1_CRC;
      ITEM_C2_ANSWER, ITEM_C2_REQUEST: crc_address = DSDPV1_REG_C2_CRC;
      ITEM_PRM: crc_address = DSDPV1_REG_PRM_CRC;
      ITEM_CFG: crc_address = DSDPV1_REG_CFG_CRC;
      default: crc_address = DSDPV1_REG_OUTPUT_CRC;
    endcase
  end

  // Looked up at the choice, so that later states read a register; after the CRC's high byte the address of its low byte
  always_ff @(posedge clk_i) begin
    if (chooses) crc_address_q <= crc_address;
    else if (state_q == SEQ_READ_CRC_HIGH || state_q == SEQ_WRITE_CRC_HIGH) crc_address_q <= crc_address_q + 11'd1;
  end

  // A C1 or C2 answer has data after its four bytes only for some values of its Function_Num (V14)
  logic answer_item, no_data_q;
  logic [7:0] block_length;
  assign answer_item = item_q == ITEM_C1_ANSWER || item_q == ITEM_C2_ANSWER;
  assign block_length = no_data_q ? 8'd0 : rdata_i;
  assign too_long = rdata_i > limit && !no_data_q && !`FAULT(50);

  logic [7:0] u_without, w_without, e_with, v_with;
  logic request_item;
  assign request_item = item_q == ITEM_C1_REQUEST || item_q == ITEM_C2_REQUEST;
  dpram_move u_move (
    `FAULT_CONNECT
    .state_i(state_q), .item_i(item_q), .u_i(u_q), .w_i(w_q), .e_i(e_q), .v_i(v_q), .boot_i(boot_q), .first_we_i(first_we),
    .first_addr_i(first_addr), .first_wdata_i(first_wdata), .addr_i(address_q), .crc_addr_i(crc_address_q), .crc_i(crc_q),
    .length_i(taken_q), .left_i(left_q), .mail_data_i(hears_i.data), .errors_i(rdata_i), .clear_i(clear), .set_i(set),
    .u_without_o(u_without), .w_without_o(w_without), .e_with_o(e_with), .v_with_o(v_with), .we_o(we_o), .addr_o(addr_o),
    .wdata_o(wdata_o));

  // ---- next state
  logic no_bytes, header_ends;
  logic [1:0] header_q;  // bytes of the header after the next one
  assign no_bytes = left_q == 8'd0;
  assign header_ends = header_q == 2'd0;
  always_comb begin
    state_d = state_q;
    case (state_q)
      SEQ_RELEASED: if (boot_starts) state_d = SEQ_CLEAR;
      SEQ_CLEAR: if (&boot_q) state_d = SEQ_VERSION;
      SEQ_VERSION: if (boot_low == 2'd3) state_d = SEQ_BOOT_COUNT;
      SEQ_BOOT_COUNT: state_d = SEQ_BOOT_END;
      SEQ_BOOT_END: state_d = SEQ_IDLE;
      SEQ_IDLE: if (starts) state_d = SEQ_COUNT;
      SEQ_CHOICE: begin
        case (pick)
          ITEM_INIT, ITEM_INPUTS: state_d = SEQ_READ_LOOK;
          ITEM_DIAG, ITEM_C1_ANSWER, ITEM_C2_ANSWER: state_d = SEQ_READ_HEADER;
          ITEM_VERDICT_PRM, ITEM_VERDICT_CFG: state_d = SEQ_VERDICT;
          ITEM_PRM: state_d = prm_length == 8'd0 ? SEQ_WRITE_CRC_HIGH : SEQ_WRITE_BYTES;
          ITEM_CFG: state_d = SEQ_WRITE_INPUT_LENGTH;
          ITEM_OUTPUTS: state_d = output_length == 8'd0 ? SEQ_WRITE_CRC_HIGH : SEQ_WRITE_BYTES;
          ITEM_C1_REQUEST, ITEM_C2_REQUEST: state_d = SEQ_WRITE_BYTES;
          ITEM_STATUS_2: state_d = SEQ_ERRORS;
          ITEM_NOTHING: state_d = SEQ_IDLE;
          default: state_d = SEQ_CHOICE;
        endcase
      end
      SEQ_READ_HEADER: if (header_ends) state_d = SEQ_READ_LOOK;
      SEQ_READ_LOOK: state_d = too_long ? SEQ_COMMIT : block_length == 8'd0 ? SEQ_READ_CRC_HIGH : SEQ_READ_BYTES;
      SEQ_READ_BYTES: if (left_q == 8'd1) state_d = SEQ_READ_CRC_HIGH;
      SEQ_READ_CRC_HIGH: state_d = SEQ_READ_CRC_LOW;
      SEQ_READ_CRC_LOW: state_d = SEQ_READ_LAST;
      SEQ_READ_LAST: state_d = SEQ_COMMIT;
      SEQ_VERDICT: state_d = SEQ_COMMIT;
      SEQ_WRITE_INPUT_LENGTH: state_d = SEQ_WRITE_LENGTH;
      SEQ_WRITE_LENGTH: state_d = no_bytes ? SEQ_WRITE_CRC_HIGH : SEQ_WRITE_BYTES;
      SEQ_WRITE_BYTES: if (left_q == 8'd1) state_d = SEQ_WRITE_CRC_HIGH;
      SEQ_WRITE_CRC_HIGH: state_d = SEQ_WRITE_CRC_LOW;
      SEQ_WRITE_CRC_LOW: state_d = SEQ_FLAG;
      SEQ_COMMIT, SEQ_FLAG, SEQ_ERRORS: state_d = SEQ_CHOICE;
      default: state_d = state_q + 5'd1;  // 9.1: s+1 .. s+6
    endcase
  end

  // ---- bytes on their way: read ones arrive one edge later
  logic arrives_q, stages_q, arrives_high_q, arrives_verdict_q;
  logic [7:0] arrives_index_q;
  assign crc_byte = arrives_q ? rdata_i : wdata_o;
  crc16 u_crc (.crc_i(crc_q), .byte_i(crc_byte), .crc_o(crc_next));

  logic writes_covered, begins_read, reads_covered, last_dropped;
  assign last_dropped = state_q == SEQ_WRITE_BYTES && item_q == ITEM_C2_REQUEST && left_q == 8'd1 && `FAULT(89);
  assign writes_covered = (state_q == SEQ_WRITE_INPUT_LENGTH || state_q == SEQ_WRITE_LENGTH || state_q == SEQ_WRITE_BYTES) && !last_dropped;
  assign begins_read = chooses && (pick == ITEM_INIT || pick == ITEM_INPUTS || pick == ITEM_DIAG || pick == ITEM_C1_ANSWER ||
                                   pick == ITEM_C2_ANSWER);
  assign reads_covered = begins_read || state_q == SEQ_READ_HEADER || state_q == SEQ_READ_BYTES;

  logic [15:0] crc_start;
  assign crc_start =
`ifdef SINGLE_FAULTS
      `FAULT(170) && pick == ITEM_C2_REQUEST ? 16'h0000 :
`endif
      `FAULT(55) ? 16'h0000 : 16'hFFFF;

  // The CRC of a written block begins with the byte that the choice writes
  logic [15:0] crc_first;
  crc16 u_crc_first (.crc_i(crc_start), .byte_i(wdata_o), .crc_o(crc_first));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= SEQ_RELEASED;
      item_q <= ITEM_NOTHING;
      behind_q <= 20'd0;
      own_q <= 1'b0;
      first_choice_q <= 1'b0;
      {u_q, w_q, e_q, v_q, read_on_q, dpv1_on_q} <= 34'd0;
      header_q <= 2'd0;
      no_data_q <= 1'b0;
      boot_q <= 11'd0;
      valid_due_q <= 1'b0;
      address_q <= 11'd0;
      {left_q, taken_q} <= 16'd0;
      crc_q <= 16'd0;
      {too_long_q, crc_wrong_q} <= 2'b00;
      {arrives_q, stages_q, arrives_high_q, arrives_verdict_q} <= 4'd0;
      arrives_index_q <= 8'd0;
    end else begin
      state_q <= state_d;
      own_q <= state_d != SEQ_IDLE && state_d != SEQ_RELEASED;

      // start-up (9.7)
      if (state_q == SEQ_CLEAR) boot_q <= boot_q + 11'd1;
      if (state_q == SEQ_VERSION) boot_q <= boot_q + 11'd1;

      // frame (9.1)
      if (starts) begin
        behind_q <= 20'hFFFFF;
        valid_due_q <= up_q == ready_cycles_i;
`ifdef SINGLE_FAULTS
        if (`FAULT(201)) crc_wrong_q <= 1'b0;
`endif
      end
      if (state_q == SEQ_FLAGS_U2) u_q <= rdata_i;
      if (state_q == SEQ_FLAGS_E) w_q <= rdata_i;
      if (state_q == SEQ_FLAGS_E2) e_q <= rdata_i;
      if (state_q == SEQ_ENABLE) v_q <= rdata_i;
      first_choice_q <= state_q == SEQ_ENABLE;
      if (first_choice_q) read_on_q <= rdata_i == DSDPV1_REG_DPV1_ENABLE_ON;
      if (initialise.commit || (judged_init && `FAULT(106))) dpv1_on_q <= read_on_q;

      // choice (9.2)
      if (chooses) begin
        item_q <= pick;
        behind_q <= 20'hFFFFE << pick;
        if (pick == ITEM_HISTORY && !`FAULT(104)) w_q[7] <= 1'b0;
        too_long_q <= 1'b0;
        crc_wrong_q <= 1'b0;
`ifdef SINGLE_FAULTS
        if (`FAULT(201)) crc_wrong_q <= crc_wrong_q;
`endif
        address_q <= addr_o + 11'd1;
        case (pick)
          ITEM_PRM: left_q <= prm_length;
          ITEM_CFG: left_q <= cfg_length;
          ITEM_C1_REQUEST: left_q <= c1_length - 8'd1;
          ITEM_C2_REQUEST: left_q <= c2_length - 8'd1;
          default: left_q <= output_length;
        endcase
        header_q <= pick == ITEM_DIAG ? 2'd0 : 2'd2;
        no_data_q <= 1'b0;
        taken_q <= cfg_input_length;
      end else begin
        address_q <= address_q + (state_q == SEQ_READ_LOOK ? 11'd0 : 11'd1);
      end

      // lengths
      if (state_q == SEQ_READ_HEADER) begin
        header_q <= header_q - 2'd1;
        if (header_q == 2'd2)
          no_data_q <= rdata_i != MSAC_READ && rdata_i != MSAC_TRANSPORT && !`FAULT(90);
      end
      if (state_q == SEQ_READ_LOOK) begin
        left_q <= block_length;
        taken_q <= block_length;
        too_long_q <= too_long;
      end
      if (state_q == SEQ_READ_BYTES || state_q == SEQ_WRITE_BYTES) left_q <= left_q - 8'd1;

      // bytes
      arrives_q <= reads_covered;
      stages_q <= state_q == SEQ_READ_BYTES;
      if (chooses) arrives_index_q <= 8'd0;
      else if (state_q == SEQ_READ_HEADER && answer_item) arrives_index_q <= arrives_index_q + 8'd1;
      else if (state_q == SEQ_READ_BYTES) arrives_index_q <= stages_q || answer_item ? arrives_index_q + 8'd1 : 8'd0;
      arrives_high_q <= state_q == SEQ_READ_CRC_HIGH;
      arrives_verdict_q <= chooses && (pick == ITEM_VERDICT_PRM || pick == ITEM_VERDICT_CFG);

      if (chooses) crc_q <= reads_covered ? crc_start : crc_first;
      else if (arrives_q || (writes_covered && !`FAULT(56))) crc_q <= crc_next;

      // the CRC read is compared as it arrives
      if (arrives_high_q && rdata_i != crc_high `AND_CRC_COUNTS) crc_wrong_q <= 1'b1;
      if (state_q == SEQ_READ_LAST && rdata_i != crc_low && !`FAULT(57) `AND_CRC_COUNTS) crc_wrong_q <= 1'b1;
`ifdef SINGLE_FAULTS
      if (`FAULT(203) && (arrives_high_q || state_q == SEQ_READ_LAST) && taken_q == 8'd0) crc_wrong_q <= 1'b0;
`endif

      if (state_q == SEQ_COMMIT && !answer_item) u_q <= u_without;
      if (state_q == SEQ_COMMIT && answer_item) w_q <= w_without;
      if (state_q == SEQ_FLAG && !request_item) e_q <= e_with;
      if (state_q == SEQ_FLAG && request_item) v_q <= v_with;
`ifdef SINGLE_FAULTS
      if (`FAULT(202) && state_q == SEQ_FLAG) {e_q, v_q} <= {e_q, v_q};
`endif
    end
  end

  assign interrupt_o = state_q == SEQ_FLAG && (item_q == ITEM_PRM || item_q == ITEM_CFG || (item_q == ITEM_OUTPUTS && `FAULT(58)));
  assign owns_o = own_q;

  // ---- transfer from the station: parameters begin after the seven standard bytes; the choice writes a request's first byte
  logic [7:0] transfer_q, transfer_start, transfer_index;
  assign transfer_start = take_prm ? 8'd7 : take_request ? 8'd1 : 8'd0;
  assign transfer_index = chooses ? transfer_start : state_q == SEQ_WRITE_BYTES ? transfer_q + 8'd1 : transfer_q;
  assign take.index = transfer_index;
  always_ff @(posedge clk_i) transfer_q <= transfer_index;

  // ---- staging of blocks read
  logic init_arrives;
  assign init_arrives = stages_q && item_q == ITEM_INIT;
  assign stage.we = stages_q && !answer_item && (item_q != ITEM_INIT || arrives_index_q >= 8'd14);
  assign stage.acyclic_we = arrives_q && answer_item;
  assign stage.pool = item_q == ITEM_INPUTS ? POOL_INPUTS : item_q == ITEM_DIAG ? POOL_DIAG : POOL_INIT;
  assign stage.index = item_q == ITEM_INIT ? arrives_index_q - 8'd14 : arrives_index_q;
  assign stage.data = rdata_i;

  // ---- commits
  dpram_commit u_commit (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .state_i(state_q), .item_i(item_q), .initialised_i(initialised), .verdict_arrives_i(arrives_verdict_q),
    .init_arrives_i(init_arrives), .index_i(arrives_index_q), .byte_i(rdata_i), .length_i(taken_q), .too_long_i(too_long_q),
    .crc_wrong_i(crc_wrong_q), .initialise_o(initialise), .verdict_o(verdict), .inputs_o(inputs), .diagnosis_o(diagnosis),
    .answers_o(answers), .judged_o(judged), .judged_init_o(judged_init), .init_limits_o(init_limits), .error_bit_o(error_bit));

  assign commands_o.initialise = initialise;
  assign commands_o.verdict = verdict;
  assign commands_o.inputs = inputs;
  assign commands_o.diagnosis = diagnosis;
  assign commands_o.answers = answers;
  assign commands_o.stage = stage;
  assign commands_o.take = take;
  assign commands_o.dpv1_on = `FAULT(105) ? read_on_q : dpv1_on_q;
endmodule
