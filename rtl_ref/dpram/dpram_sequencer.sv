// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The chip's accesses to the DPRAM (sections 9 and 10; H1 to H8, D1 to D17): one byte a cycle.
//
// The state says what the next edge does. A byte read at one edge is in rdata_i at the next. This block has the states and the items; what
// they work on is in others: dpram_choice the next item, dpram_block the block that it moves, dpram_move the byte at this edge, dpram_flags the
// flags, dpram_crc and dpram_commit what becomes of a block that was read, chip_status the chip's status bytes.
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
  input  user_hears_t hears_i           // its address and Global_Control are not reported to the user
);
  seq_t state_q, state_d;
  item_t item_q, pick;

  // ---- what is heard from the station
  logic initialised, prm_mail, cfg_mail, output_mail, c1_mail, c2_mail;
  logic [7:0] prm_length, output_length, status_3;
  logic [15:0] count;
  assign initialised = hears_i.status.initialised;
  assign count = hears_i.status.left;
  assign status_3 = {hears_i.baud.found ? hears_i.baud.rate : 4'hF, hears_i.status.state, 2'b00};
  assign prm_mail = hears_i.mail.parameters.waits;
  assign prm_length = hears_i.mail.parameters.length;
  assign cfg_mail = hears_i.mail.configuration.waits;
  assign output_mail = hears_i.mail.outputs.waits;
  assign output_length = hears_i.mail.outputs.length;
  assign c1_mail = hears_i.c1.waits;
  assign c2_mail = hears_i.c2.waits;

  // ---- due accesses
  logic access_due, ready, starts, boot_starts, begins;
  assign starts = state_q == SEQ_IDLE && access_due && (!user_holds_i || `FAULT(97));
  assign boot_starts = state_q == SEQ_RELEASED && (!user_holds_i || `FAULT(98));
  assign begins = starts || boot_starts;
  dpram_pace u_pace (
    `FAULT_CONNECT
    .access_interval_i(access_interval_i), .ready_cycles_i(ready_cycles_i), .clk_i(clk_i), .rst_ni(rst_ni), .begins_i(begins),
    .due_o(access_due), .ready_o(ready));

  // ---- start-up (9.7): addresses of the cells that are cleared, then those of the version
  logic [10:0] boot_q;
  logic [1:0] boot_low;
  assign boot_low = boot_q[1:0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) boot_q <= 11'd0;
    else if (state_q == SEQ_CLEAR || state_q == SEQ_VERSION) boot_q <= boot_q + 11'd1;
  end

  // ---- flags of user and chip, as this access has read them
  logic history;
  logic [6:0] user_2;  // B011 without bit 7
  logic [7:0] user_due, user_flags, chip_flags;
  dpram_flags u_flags (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .state_i(state_q), .item_i(item_q), .history_i(history), .rdata_i(rdata_i), .due_o(user_due),
    .user_2_o(user_2), .user_flags_o(user_flags), .chip_flags_o(chip_flags));

  // ---- B005 (D17): of this access, and of the last accepted initialisation
  logic first_choice_q, enable_q, dpv1_on_q, takes_enable;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      first_choice_q <= 1'b0;
      enable_q <= 1'b0;
    end else begin
      first_choice_q <= state_q == SEQ_ENABLE;
      if (first_choice_q) enable_q <= rdata_i == DSDPV1_REG_DPV1_ENABLE_ON;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) dpv1_on_q <= 1'b0;
    else if (takes_enable) dpv1_on_q <= enable_q;
  end

  // ---- status bytes
  logic chooses, crc_wrong, judged, judged_init, init_limits, status_1, status_4, keeps, clear_inputs, valid_due_q;
  logic [6:0] status_due, status_written;
  logic [7:0] error_bit, set, clear;
  initialise_t initialise;
  chip_status u_chip_status (
    .clk_i(clk_i), .rst_ni(rst_ni), .valid_due_i(valid_due_q), .count_i(count), .state_i(status_3), .judged_i(judged),
    .crc_wrong_i(crc_wrong), .error_bit_i(error_bit), .keeps_i(keeps), .clear_inputs_i(clear_inputs), .init_i(judged_init),
    .init_right_i(initialise.commit), .init_limits_i(init_limits), .written_i(status_written), .due_o(status_due), .initialised_o(status_1),
    .limits_o(status_4), .clear_o(clear), .set_o(set));
  assign takes_enable = initialise.commit || (judged_init && `FAULT(106));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) valid_due_q <= 1'b0;
    else if (starts) valid_due_q <= ready;
  end
  assign clear_inputs = chooses && pick == ITEM_HISTORY && (user_2[6] || `FAULT(101)) && !`FAULT(100);
  assign keeps = item_q == ITEM_INPUTS && user_2[6] && !`FAULT(99);
  assign status_written = {
    chooses && pick == ITEM_STATUS_4,
    chooses && pick == ITEM_STATUS_3,
    state_q == SEQ_ERRORS,
    chooses && pick == ITEM_STATUS_1,
    chooses && pick == ITEM_COUNT_LOW,
    chooses && pick == ITEM_COUNT_HIGH,
    chooses && pick == ITEM_VALID};

  // ---- choice: what is due, in the order of 9.2, the first in bit 0, and which of it the access has not passed yet
  logic [ITEMS-1:0] due, behind_q, candidates;
  assign due = {
    status_due,
    c2_mail,
    c1_mail,
    output_mail,
    cfg_mail,
    prm_mail,
    user_due};
  assign candidates = due & behind_q;
  logic first_we;
  logic [10:0] first_addr;
  logic [7:0] first_wdata;
  dpram_choice u_choice (
    `FAULT_CONNECT
    .candidates_i(candidates), .command_2_i(user_2), .mail_i(hears_i.mail), .c1_function_i(hears_i.c1.function_num),
    .c2_function_i(hears_i.c2.function_num), .count_i(count), .status_1_i(status_1), .status_3_i(status_3),
    .status_4_i(status_4), .pick_o(pick), .we_o(first_we), .addr_o(first_addr), .wdata_o(first_wdata));

  assign chooses = state_q == SEQ_CHOICE;
  assign history = chooses && pick == ITEM_HISTORY && !`FAULT(104);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) item_q <= ITEM_NOTHING;
    else if (chooses) item_q <= pick;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) behind_q <= 20'd0;
    else if (starts) behind_q <= 20'hFFFFF;
    else if (chooses) behind_q <= 20'hFFFFE << pick;
  end

  // ---- the block that an item moves
  logic [10:0] block_addr, crc_addr;
  logic [7:0] left, length, arrives_index;
  logic last, header_ends, empty, too_long, too_long_q, arrives, stages, no_bytes;
  dpram_block u_block (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .state_i(state_q), .item_i(item_q), .pick_i(pick), .first_addr_i(first_addr), .rdata_i(rdata_i),
    .mail_i(hears_i.mail), .c1_length_i(hears_i.c1.length), .c2_length_i(hears_i.c2.length), .addr_o(block_addr), .crc_addr_o(crc_addr),
    .left_o(left), .last_o(last), .header_ends_o(header_ends), .empty_o(empty), .too_long_o(too_long), .too_long_q_o(too_long_q),
    .length_o(length), .arrives_o(arrives), .stages_o(stages), .index_o(arrives_index));
  assign no_bytes = left == 8'd0;

  logic [15:0] crc;
  dpram_crc u_crc (
    `FAULT_CONNECT `CONNECT_CRC_COUNTS
    .clk_i(clk_i), .rst_ni(rst_ni), .starts_i(starts), .state_i(state_q), .item_i(item_q), .pick_i(pick), .arrives_i(arrives),
    .rdata_i(rdata_i), .wdata_i(wdata_o), .last_i(last), .length_i(length), .crc_o(crc), .wrong_o(crc_wrong));

  // ---- the byte at this edge
  dpram_move u_move (
    `FAULT_CONNECT
    .state_i(state_q), .item_i(item_q), .user_flags_i(user_flags), .chip_flags_i(chip_flags), .boot_i(boot_q), .first_we_i(first_we),
    .first_addr_i(first_addr), .first_wdata_i(first_wdata), .addr_i(block_addr), .crc_addr_i(crc_addr), .crc_i(crc),
    .length_i(length), .left_i(left), .mail_data_i(hears_i.data), .errors_i(rdata_i), .clear_i(clear), .set_i(set), .we_o(we_o),
    .addr_o(addr_o), .wdata_o(wdata_o));

  // ---- next state
  seq_t first_state;  // of the picked item
  always_comb begin
    first_state = SEQ_CHOICE;
    case (pick)
      ITEM_INIT, ITEM_INPUTS: first_state = SEQ_READ_LOOK;
      ITEM_DIAG, ITEM_C1_ANSWER, ITEM_C2_ANSWER: first_state = SEQ_READ_HEADER;
      ITEM_VERDICT_PRM, ITEM_VERDICT_CFG: first_state = SEQ_VERDICT;
      ITEM_PRM: if (prm_length == 8'd0) first_state = SEQ_WRITE_CRC_HIGH; else first_state = SEQ_WRITE_BYTES;
      ITEM_CFG: first_state = SEQ_WRITE_INPUT_LENGTH;
      ITEM_OUTPUTS: if (output_length == 8'd0) first_state = SEQ_WRITE_CRC_HIGH; else first_state = SEQ_WRITE_BYTES;
      ITEM_C1_REQUEST, ITEM_C2_REQUEST: first_state = SEQ_WRITE_BYTES;
      ITEM_STATUS_2: first_state = SEQ_ERRORS;
      ITEM_NOTHING: first_state = SEQ_IDLE;
      default: ;
    endcase
  end
  always_comb begin
    state_d = state_q;
    case (state_q)
      SEQ_RELEASED: if (boot_starts) state_d = SEQ_CLEAR;
      SEQ_CLEAR: if (&boot_q) state_d = SEQ_VERSION;
      SEQ_VERSION: if (boot_low == 2'd3) state_d = SEQ_BOOT_COUNT;
      SEQ_BOOT_COUNT: state_d = SEQ_BOOT_END;
      SEQ_BOOT_END: state_d = SEQ_IDLE;
      SEQ_IDLE: if (starts) state_d = SEQ_COUNT;
      SEQ_COUNT: state_d = SEQ_USER_1;
      SEQ_USER_1: state_d = SEQ_USER_2;
      SEQ_USER_2: state_d = SEQ_CHIP_1;
      SEQ_CHIP_1: state_d = SEQ_CHIP_2;
      SEQ_CHIP_2: state_d = SEQ_ENABLE;
      SEQ_ENABLE: state_d = SEQ_CHOICE;
      SEQ_CHOICE: state_d = first_state;
      SEQ_READ_HEADER: if (header_ends) state_d = SEQ_READ_LOOK;
      SEQ_READ_LOOK: begin
        if (too_long) state_d = SEQ_COMMIT;
        else if (empty) state_d = SEQ_READ_CRC_HIGH;
        else state_d = SEQ_READ_BYTES;
      end
      SEQ_READ_BYTES: if (last) state_d = SEQ_READ_CRC_HIGH;
      SEQ_READ_CRC_HIGH: state_d = SEQ_READ_CRC_LOW;
      SEQ_READ_CRC_LOW: state_d = SEQ_READ_LAST;
      SEQ_READ_LAST: state_d = SEQ_COMMIT;
      SEQ_VERDICT: state_d = SEQ_COMMIT;
      SEQ_WRITE_INPUT_LENGTH: state_d = SEQ_WRITE_LENGTH;
      SEQ_WRITE_LENGTH: if (no_bytes) state_d = SEQ_WRITE_CRC_HIGH; else state_d = SEQ_WRITE_BYTES;
      SEQ_WRITE_BYTES: if (last) state_d = SEQ_WRITE_CRC_HIGH;
      SEQ_WRITE_CRC_HIGH: state_d = SEQ_WRITE_CRC_LOW;
      SEQ_WRITE_CRC_LOW: state_d = SEQ_FLAG;
      SEQ_COMMIT, SEQ_FLAG, SEQ_ERRORS: state_d = SEQ_CHOICE;
      default: state_d = SEQ_RELEASED;  // no such state
    endcase
  end
  logic own_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= SEQ_RELEASED;
      own_q <= 1'b0;
    end else begin
      state_q <= state_d;
      own_q <= state_d != SEQ_IDLE && state_d != SEQ_RELEASED;
    end
  end
  assign owns_o = own_q;
  assign interrupt_o = state_q == SEQ_FLAG && (item_q == ITEM_PRM || item_q == ITEM_CFG || (item_q == ITEM_OUTPUTS && `FAULT(58)));

  // ---- mail that is taken: parameters begin after the seven standard bytes; the choice writes a request's first byte
  logic take_prm, take_request;
  logic [7:0] mail_index_q, mail_start, mail_index;
  take_t take;
  assign take_prm = chooses && pick == ITEM_PRM;
  assign take_request = chooses && is_request(pick);
  assign mail_start = take_prm ? 8'd7 : take_request ? 8'd1 : 8'd0;
  assign mail_index = chooses ? mail_start : state_q == SEQ_WRITE_BYTES ? mail_index_q + 8'd1 : mail_index_q;
  always_ff @(posedge clk_i) mail_index_q <= mail_index;
  assign take.parameters = take_prm;
  assign take.configuration = chooses && pick == ITEM_CFG;
  assign take.outputs = chooses && pick == ITEM_OUTPUTS;
  assign take.c1 = chooses && pick == ITEM_C1_REQUEST;
  assign take.c2 = chooses && pick == ITEM_C2_REQUEST;
  assign take.index = mail_index;

  // ---- staging of blocks that are read; the first 14 bytes of the initialisation are values, not a configuration
  logic answers, init_arrives;
  stage_t stage;
  assign answers = is_answer(item_q);
  assign init_arrives = stages && item_q == ITEM_INIT;
  assign stage.inputs = chooses && pick == ITEM_INPUTS;
  assign stage.diagnosis = chooses && pick == ITEM_DIAG;
  assign stage.c1 = chooses && pick == ITEM_C1_ANSWER;
  assign stage.c2 = chooses && pick == ITEM_C2_ANSWER;
  assign stage.we = stages && !answers && (item_q != ITEM_INIT || arrives_index >= 8'd14);
  assign stage.acyclic_we = arrives && answers;
  assign stage.pool = item_q == ITEM_INPUTS ? POOL_INPUTS : item_q == ITEM_DIAG ? POOL_DIAG : POOL_INIT;
  assign stage.index = item_q == ITEM_INIT ? arrives_index - 8'd14 : arrives_index;
  assign stage.data = rdata_i;

  // ---- commits
  verdict_t verdict;
  inputs_t inputs;
  diagnosis_t diagnosis;
  answers_t user_answers;
  logic verdict_arrives_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) verdict_arrives_q <= 1'b0;
    else verdict_arrives_q <= chooses && (pick == ITEM_VERDICT_PRM || pick == ITEM_VERDICT_CFG);
  end
  dpram_commit u_commit (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .state_i(state_q), .item_i(item_q), .initialised_i(initialised), .verdict_arrives_i(verdict_arrives_q),
    .init_arrives_i(init_arrives), .index_i(arrives_index), .byte_i(rdata_i), .length_i(length), .too_long_i(too_long_q),
    .crc_wrong_i(crc_wrong), .initialise_o(initialise), .verdict_o(verdict), .inputs_o(inputs), .diagnosis_o(diagnosis),
    .answers_o(user_answers), .judged_o(judged), .judged_init_o(judged_init), .init_limits_o(init_limits), .error_bit_o(error_bit));

  assign commands_o.initialise = initialise;
  assign commands_o.verdict = verdict;
  assign commands_o.inputs = inputs;
  assign commands_o.diagnosis = diagnosis;
  assign commands_o.answers = user_answers;
  assign commands_o.stage = stage;
  assign commands_o.take = take;
  assign commands_o.dpv1_on = `FAULT(105) ? enable_q : dpv1_on_q;
endmodule
