// The chip's accesses to the DPRAM (sections 9 and 10; H1 to H8, D1 to D17): one byte a cycle.
//
// The state says what the next edge does. A byte read at one edge is in rdata_i at the next.
`include "dsdpv1_types.svh"

module dpram_sequencer (
  `FAULT_PORT
  input  logic [12:0] access_interval_i,  // H1
  input  logic [20:0] ready_cycles_i,     // D1
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        r_req_i,          // each after its synchroniser
  input  logic        r_sta_i,
  output logic        l_req_o,
  output logic        l_sta_o,
  output logic        interrupt_o,      // a flag of parameters or configuration is written at this edge
  // DPRAM
  output logic        we_o,
  output logic [10:0] addr_o,
  output logic [7:0]  wdata_o,
  input  logic [7:0]  rdata_i,
  // commits, at this edge
  output logic        init_o,
  output logic [6:0]  init_address_o,
  output logic [15:0] init_ident_o,
  output logic [3:0]  init_command_o,
  output logic [7:0]  init_max_input_o,
  output logic [7:0]  init_max_output_o,
  output logic [7:0]  init_max_diag_o,
  output logic [7:0]  init_max_prm_o,
  output logic [1:0]  init_prm_mode_o,
  output logic [7:0]  init_max_cfg_o,
  output logic [1:0]  init_cfg_mode_o,
  output logic [7:0]  init_cfg_length_o,
  output logic [7:0]  init_input_length_o,
  output logic [7:0]  init_output_length_o,
  output logic        inputs_o,
  output logic        diag_o,
  output logic [7:0]  block_length_o,
  output logic [7:0]  diag_type_o,
  output logic        verdict_prm_o,
  output logic        verdict_cfg_o,
  output logic        verdict_wrong_o,
  output logic        c1_answer_o,      // with right CRC
  output logic        c2_answer_o,
  output logic        dpv1_on_o,        // as B005 said at the initialisation (D17)
  output logic        stage_inputs_o,
  output logic        stage_diag_o,
  output logic        stage_c1_o,
  output logic        stage_c2_o,
  output logic        stage_we_o,
  output logic        stage_msac_we_o,
  output logic [1:0]  stage_pool_o,
  output logic [7:0]  stage_index_o,
  output logic [7:0]  stage_data_o,
  // station
  input  logic        initialised_i,
  input  logic [7:0]  status_i,
  input  logic [15:0] count_i,
  input  logic        prm_mail_i,
  input  logic        cfg_mail_i,
  input  logic        output_mail_i,
  input  logic        c1_mail_i,
  input  logic        c2_mail_i,
  input  logic [7:0]  prm_length_i,
  input  logic [7:0]  cfg_length_i,
  input  logic [7:0]  cfg_input_length_i,
  input  logic [7:0]  cfg_output_length_i,
  input  logic [7:0]  output_length_i,
  input  logic [7:0]  c1_function_i,
  input  logic [7:0]  c2_function_i,
  input  logic [7:0]  c1_length_i,
  input  logic [7:0]  c2_length_i,
  output logic        take_prm_o,
  output logic        take_cfg_o,
  output logic        take_output_o,
  output logic        take_c1_o,
  output logic        take_c2_o,
  output logic [7:0]  transfer_index_o,
  input  logic [7:0]  transfer_data_i
);
  // States
  localparam logic [4:0] RELEASED = 5'd0;    // from cycle R until the start-up access begins (H6)
  localparam logic [4:0] CLEAR = 5'd1;
  localparam logic [4:0] VERSION = 5'd2;
  localparam logic [4:0] BOOT_COUNT = 5'd3;
  localparam logic [4:0] BOOT_END = 5'd4;
  localparam logic [4:0] IDLE = 5'd5;
  localparam logic [4:0] COUNT = 5'd6;       // 9.1: s+1
  localparam logic [4:0] FLAGS_U = 5'd7;
  localparam logic [4:0] FLAGS_U2 = 5'd8;
  localparam logic [4:0] FLAGS_E = 5'd9;
  localparam logic [4:0] FLAGS_E2 = 5'd10;
  localparam logic [4:0] ENABLE = 5'd11;
  localparam logic [4:0] CHOICE = 5'd12;
  localparam logic [4:0] READ_HEADER = 5'd13;  // 9.3: from the second byte on
  localparam logic [4:0] READ_LOOK = 5'd14;
  localparam logic [4:0] READ_BYTES = 5'd15;
  localparam logic [4:0] READ_CRC_HIGH = 5'd16;
  localparam logic [4:0] READ_CRC_LOW = 5'd17;
  localparam logic [4:0] READ_LAST = 5'd18;
  localparam logic [4:0] COMMIT = 5'd19;
  localparam logic [4:0] VERDICT = 5'd20;
  localparam logic [4:0] WRITE_INPUT_LENGTH = 5'd21;  // 9.5: header of the configuration
  localparam logic [4:0] WRITE_LENGTH = 5'd22;
  localparam logic [4:0] WRITE_BYTES = 5'd23;
  localparam logic [4:0] WRITE_CRC_HIGH = 5'd24;
  localparam logic [4:0] WRITE_CRC_LOW = 5'd25;
  localparam logic [4:0] FLAG = 5'd26;
  localparam logic [4:0] ERRORS = 5'd27;       // second cycle of B00B

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

  // ---- due accesses
  logic access_due, starts, boot_starts;
  assign access_due = since_q >= access_interval_i + (`FAULT(48) ? 13'd1 : 13'd0);
  assign starts = state_q == IDLE && access_due && (!r_req_i || `FAULT(49)) && (!r_sta_i || `FAULT(95));
  assign boot_starts = state_q == RELEASED && (!r_req_i || `FAULT(97)) && (!r_sta_i || `FAULT(98));

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
    .clk_i(clk_i), .rst_ni(rst_ni), .valid_due_i(valid_due_q), .count_i(count_i), .state_i(status_i), .judged_i(judged),
    .crc_wrong_i(crc_wrong_q), .error_bit_i(error_bit), .keeps_i(keeps), .clear_inputs_i(clear_inputs), .init_i(judged_init), .init_right_i(init_o),
    .init_limits_i(init_limits), .written_i(status_written), .due_o(status_due), .initialised_o(status_1),
    .limits_o(status_4), .clear_o(clear), .set_o(set));

  logic [15:0] crc_q;
  logic [7:0] crc_high, crc_low;
  logic [1:0] boot_low;
  assign {crc_high, crc_low} = crc_q;
  assign boot_low = boot_q[1:0];

  // In the order of 9.2, the first lowest
  assign due = {
    status_due,
    c2_mail_i,
    c1_mail_i,
    output_mail_i,
    cfg_mail_i,
    prm_mail_i,
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
    .candidates_i(candidates), .command_2_i(w_q[6:0]), .prm_length_i(prm_length_i), .cfg_input_length_i(cfg_input_length_i),
    .cfg_output_length_i(cfg_output_length_i), .output_length_i(output_length_i), .c1_function_i(c1_function_i),
    .c2_function_i(c2_function_i), .count_i(count_i), .status_1_i(status_1), .status_3_i(status_i), .status_4_i(status_4),
    .pick_o(pick), .we_o(first_we), .addr_o(first_addr), .wdata_o(first_wdata));

  assign chooses = state_q == CHOICE;
  assign take_prm_o = chooses && pick == ITEM_PRM;
  assign take_cfg_o = chooses && pick == ITEM_CFG;
  assign take_output_o = chooses && pick == ITEM_OUTPUTS;
  assign take_c1_o = chooses && pick == ITEM_C1_REQUEST;
  assign take_c2_o = chooses && pick == ITEM_C2_REQUEST;
  assign clear_inputs = chooses && pick == ITEM_HISTORY && (w_q[6] || `FAULT(101)) && !`FAULT(100);
  assign keeps = item_q == ITEM_INPUTS && w_q[6] && !`FAULT(99);
  assign stage_inputs_o = chooses && pick == ITEM_INPUTS;
  assign stage_diag_o = chooses && pick == ITEM_DIAG;
  assign stage_c1_o = chooses && pick == ITEM_C1_ANSWER;
  assign stage_c2_o = chooses && pick == ITEM_C2_ANSWER;
  assign status_written = {
    chooses && pick == ITEM_STATUS_4,
    chooses && pick == ITEM_STATUS_3,
    state_q == ERRORS,
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
      default: limit = MSAC_MAX_DATA;
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

  // The choice looks it up, so that it is a register where it is used; behind the high byte it is that of the low byte
  always_ff @(posedge clk_i) begin
    if (chooses) crc_address_q <= crc_address;
    else if (state_q == READ_CRC_HIGH || state_q == WRITE_CRC_HIGH) crc_address_q <= crc_address_q + 11'd1;
  end

  // A C1 or C2 answer has data behind its four bytes only where its Function_Num says so (V14)
  logic answer_item, no_data_q;
  logic [7:0] block_length;
  assign answer_item = item_q == ITEM_C1_ANSWER || item_q == ITEM_C2_ANSWER;
  assign block_length = no_data_q ? 8'd0 : rdata_i;
  assign too_long = rdata_i > limit && !no_data_q && !`FAULT(50);

  // ---- moves
  logic [7:0] u_without, w_without, e_with, v_with, version;
  logic request_item, c2_flag;
  assign request_item = item_q == ITEM_C1_REQUEST || item_q == ITEM_C2_REQUEST;
  assign c2_flag = item_q == ITEM_C2_REQUEST || `FAULT(88);
  assign w_without = w_q & (item_q == ITEM_C1_ANSWER ? 8'hFE : 8'hFD);
  assign v_with = v_q | (c2_flag ? DSDPV1_REG_CHIP_COMMAND_2_C2 : DSDPV1_REG_CHIP_COMMAND_2_C1);
  always_comb begin
    case (item_q)
      ITEM_INIT: u_without = u_q & 8'hFB;
      ITEM_VERDICT_PRM: u_without = u_q & 8'h7F;
      ITEM_VERDICT_CFG: u_without = u_q & 8'hBF;
      ITEM_INPUTS: u_without = u_q & 8'hFE;
      default: u_without = u_q & 8'hFD;
    endcase
    case (item_q)
      ITEM_PRM: e_with = e_q | DSDPV1_REG_CHIP_COMMAND_1_PRM;
      ITEM_CFG: e_with = e_q | DSDPV1_REG_CHIP_COMMAND_1_CFG;
      default: e_with = e_q | DSDPV1_REG_CHIP_COMMAND_1_OUTPUT;
    endcase
    case (boot_low)
      2'd0: version = DSDPV1_REG_VERSION_RESET;
      2'd1: version = DSDPV1_REG_VERSION_YEAR_RESET;
      2'd2: version = DSDPV1_REG_VERSION_MONTH_RESET;
      default: version = DSDPV1_REG_VERSION_DAY_RESET;
    endcase
  end

  logic errors_both;
  logic [7:0] last_cleared;
  assign errors_both = `FAULT(51);
  assign last_cleared = `FAULT(103) ? clear : 8'h00;
  always_comb begin
    we_o = 1'b0;
    addr_o = address_q;
    wdata_o = 8'h00;
    case (state_q)
      CLEAR: begin
        we_o = 1'b1;
        addr_o = boot_q;
      end
      VERSION: begin
        we_o = 1'b1;
        addr_o = boot_q;
        wdata_o = version;
      end
      BOOT_COUNT, COUNT: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_ACCESS_COUNT;
        wdata_o = 8'h01;
      end
      FLAGS_U: addr_o = DSDPV1_REG_USER_COMMAND_1;
      FLAGS_U2: addr_o = DSDPV1_REG_USER_COMMAND_2;
      FLAGS_E: addr_o = DSDPV1_REG_CHIP_COMMAND_1;
      FLAGS_E2: addr_o = DSDPV1_REG_CHIP_COMMAND_2;
      ENABLE: addr_o = DSDPV1_REG_DPV1_ENABLE;
      CHOICE: begin
        we_o = first_we;
        addr_o = first_addr;
        wdata_o = first_wdata;
      end
      COMMIT: begin
        we_o = !`FAULT(53);
        addr_o = answer_item ? DSDPV1_REG_USER_COMMAND_2 : DSDPV1_REG_USER_COMMAND_1;
        wdata_o = answer_item ? w_without : u_without;
      end
      WRITE_INPUT_LENGTH, WRITE_LENGTH: begin
        we_o = 1'b1;
        wdata_o = state_q == WRITE_INPUT_LENGTH ? taken_q : left_q;
      end
      WRITE_BYTES: begin
        we_o = 1'b1;
        wdata_o = transfer_data_i;
      end
      WRITE_CRC_HIGH: begin
        we_o = 1'b1;
        addr_o = crc_address_q;
        wdata_o = crc_high;
      end
      WRITE_CRC_LOW: begin
        we_o = !`FAULT(54);
        addr_o = crc_address_q;
        wdata_o = crc_low;
      end
      READ_CRC_HIGH, READ_CRC_LOW: addr_o = crc_address_q;
      FLAG: begin
        we_o = 1'b1;
        addr_o = request_item ? DSDPV1_REG_CHIP_COMMAND_2 : DSDPV1_REG_CHIP_COMMAND_1;
        wdata_o = request_item ? v_with : e_with;
      end
      ERRORS: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_CHIP_STATUS_2;
        wdata_o = ((errors_both ? 8'd0 : rdata_i & ~clear) | set) & ~last_cleared;
      end
      default: ;
    endcase
  end

  // ---- next state
  logic no_bytes, header_ends;
  logic [1:0] header_q;  // bytes of the header behind the next one
  assign no_bytes = left_q == 8'd0;
  assign header_ends = header_q == 2'd0;
  always_comb begin
    state_d = state_q;
    case (state_q)
      RELEASED: if (boot_starts) state_d = CLEAR;
      CLEAR: if (&boot_q) state_d = VERSION;
      VERSION: if (boot_low == 2'd3) state_d = BOOT_COUNT;
      BOOT_COUNT: state_d = BOOT_END;
      BOOT_END: state_d = IDLE;
      IDLE: if (starts) state_d = COUNT;
      CHOICE: begin
        case (pick)
          ITEM_INIT, ITEM_INPUTS: state_d = READ_LOOK;
          ITEM_DIAG, ITEM_C1_ANSWER, ITEM_C2_ANSWER: state_d = READ_HEADER;
          ITEM_VERDICT_PRM, ITEM_VERDICT_CFG: state_d = VERDICT;
          ITEM_PRM: state_d = prm_length_i == 8'd0 ? WRITE_CRC_HIGH : WRITE_BYTES;
          ITEM_CFG: state_d = WRITE_INPUT_LENGTH;
          ITEM_OUTPUTS: state_d = output_length_i == 8'd0 ? WRITE_CRC_HIGH : WRITE_BYTES;
          ITEM_C1_REQUEST, ITEM_C2_REQUEST: state_d = WRITE_BYTES;
          ITEM_STATUS_2: state_d = ERRORS;
          ITEM_NOTHING: state_d = IDLE;
          default: state_d = CHOICE;
        endcase
      end
      READ_HEADER: if (header_ends) state_d = READ_LOOK;
      READ_LOOK: state_d = too_long ? COMMIT : block_length == 8'd0 ? READ_CRC_HIGH : READ_BYTES;
      READ_BYTES: if (left_q == 8'd1) state_d = READ_CRC_HIGH;
      READ_CRC_HIGH: state_d = READ_CRC_LOW;
      READ_CRC_LOW: state_d = READ_LAST;
      READ_LAST: state_d = COMMIT;
      VERDICT: state_d = COMMIT;
      WRITE_INPUT_LENGTH: state_d = WRITE_LENGTH;
      WRITE_LENGTH: state_d = no_bytes ? WRITE_CRC_HIGH : WRITE_BYTES;
      WRITE_BYTES: if (left_q == 8'd1) state_d = WRITE_CRC_HIGH;
      WRITE_CRC_HIGH: state_d = WRITE_CRC_LOW;
      WRITE_CRC_LOW: state_d = FLAG;
      COMMIT, FLAG, ERRORS: state_d = CHOICE;
      default: state_d = state_q + 5'd1;  // 9.1: s+1 .. s+6
    endcase
  end

  // ---- bytes on their way: read ones arrive one edge later
  logic arrives_q, stages_q, arrives_high_q, arrives_verdict_q;
  logic [7:0] arrives_index_q;
  assign crc_byte = arrives_q ? rdata_i : wdata_o;
  crc16 u_crc (.crc_i(crc_q), .byte_i(crc_byte), .crc_o(crc_next));

  logic writes_covered, reads_covered, last_dropped;
  assign last_dropped = state_q == WRITE_BYTES && item_q == ITEM_C2_REQUEST && left_q == 8'd1 && `FAULT(89);
  assign writes_covered = (state_q == WRITE_INPUT_LENGTH || state_q == WRITE_LENGTH || state_q == WRITE_BYTES) && !last_dropped;
  assign reads_covered = (chooses && (pick == ITEM_INIT || pick == ITEM_INPUTS || pick == ITEM_DIAG || pick == ITEM_C1_ANSWER || pick == ITEM_C2_ANSWER)) ||
                         state_q == READ_HEADER || state_q == READ_BYTES;

  logic [15:0] crc_start;
  assign crc_start = `FAULT(55) ? 16'h0000 : 16'hFFFF;

  // The CRC of a written block begins with the byte of the choice itself
  logic [15:0] crc_first;
  crc16 u_crc_first (.crc_i(crc_start), .byte_i(wdata_o), .crc_o(crc_first));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= RELEASED;
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
      own_q <= state_d != IDLE && state_d != RELEASED;

      // start-up (9.7)
      if (state_q == CLEAR) boot_q <= boot_q + 11'd1;
      if (state_q == VERSION) boot_q <= boot_q + 11'd1;

      // frame (9.1)
      if (starts) begin
        behind_q <= 20'hFFFFF;
        valid_due_q <= up_q == ready_cycles_i;
      end
      if (state_q == FLAGS_U2) u_q <= rdata_i;
      if (state_q == FLAGS_E) w_q <= rdata_i;
      if (state_q == FLAGS_E2) e_q <= rdata_i;
      if (state_q == ENABLE) v_q <= rdata_i;
      first_choice_q <= state_q == ENABLE;
      if (first_choice_q) read_on_q <= rdata_i == DSDPV1_REG_DPV1_ENABLE_ON;
      if (init_o || (judged_init && `FAULT(106))) dpv1_on_q <= read_on_q;

      // choice (9.2)
      if (chooses) begin
        item_q <= pick;
        behind_q <= 20'hFFFFE << pick;
        if (pick == ITEM_HISTORY && !`FAULT(104)) w_q[7] <= 1'b0;
        too_long_q <= 1'b0;
        crc_wrong_q <= 1'b0;
        address_q <= addr_o + 11'd1;
        case (pick)
          ITEM_PRM: left_q <= prm_length_i;
          ITEM_CFG: left_q <= cfg_length_i;
          ITEM_C1_REQUEST: left_q <= c1_length_i - 8'd1;
          ITEM_C2_REQUEST: left_q <= c2_length_i - 8'd1;
          default: left_q <= output_length_i;
        endcase
        header_q <= pick == ITEM_DIAG ? 2'd0 : 2'd2;
        no_data_q <= 1'b0;
        taken_q <= cfg_input_length_i;
      end else begin
        address_q <= address_q + (state_q == READ_LOOK ? 11'd0 : 11'd1);
      end

      // lengths
      if (state_q == READ_HEADER) begin
        header_q <= header_q - 2'd1;
        if (header_q == 2'd2)
          no_data_q <= rdata_i != DSDPV1_REG_FUNCTION_NUM_READ && rdata_i != DSDPV1_REG_FUNCTION_NUM_TRANSPORT && !`FAULT(90);
      end
      if (state_q == READ_LOOK) begin
        left_q <= block_length;
        taken_q <= block_length;
        too_long_q <= too_long;
      end
      if (state_q == READ_BYTES || state_q == WRITE_BYTES) left_q <= left_q - 8'd1;

      // bytes
      arrives_q <= reads_covered;
      stages_q <= state_q == READ_BYTES;
      if (chooses) arrives_index_q <= 8'd0;
      else if (state_q == READ_HEADER && answer_item) arrives_index_q <= arrives_index_q + 8'd1;
      else if (state_q == READ_BYTES) arrives_index_q <= stages_q || answer_item ? arrives_index_q + 8'd1 : 8'd0;
      arrives_high_q <= state_q == READ_CRC_HIGH;
      arrives_verdict_q <= chooses && (pick == ITEM_VERDICT_PRM || pick == ITEM_VERDICT_CFG);

      if (chooses) crc_q <= reads_covered ? crc_start : crc_first;
      else if (arrives_q || (writes_covered && !`FAULT(56))) crc_q <= crc_next;

      // the CRC read is compared as it arrives
      if (arrives_high_q && rdata_i != crc_high) crc_wrong_q <= 1'b1;
      if (state_q == READ_LAST && rdata_i != crc_low && !`FAULT(57)) crc_wrong_q <= 1'b1;

      if (state_q == COMMIT && !answer_item) u_q <= u_without;
      if (state_q == COMMIT && answer_item) w_q <= w_without;
      if (state_q == FLAG && !request_item) e_q <= e_with;
      if (state_q == FLAG && request_item) v_q <= v_with;
    end
  end

  assign dpv1_on_o = `FAULT(105) ? read_on_q : dpv1_on_q;
  assign interrupt_o = state_q == FLAG && (item_q == ITEM_PRM || item_q == ITEM_CFG || (item_q == ITEM_OUTPUTS && `FAULT(58)));
  assign l_req_o = own_q;
  assign l_sta_o = own_q;

  // ---- transfer from the station: parameters begin behind the seven standard bytes; of a request the choice writes the first
  logic [7:0] transfer_q, transfer_start;
  assign transfer_start = take_prm_o ? 8'd7 : take_c1_o || take_c2_o ? 8'd1 : 8'd0;
  assign transfer_index_o = chooses ? transfer_start : state_q == WRITE_BYTES ? transfer_q + 8'd1 : transfer_q;
  always_ff @(posedge clk_i) transfer_q <= transfer_index_o;

  // ---- staging of blocks read
  assign stage_we_o = stages_q && !answer_item && (item_q != ITEM_INIT || arrives_index_q >= 8'd14);
  assign stage_msac_we_o = arrives_q && answer_item;
  assign stage_pool_o = item_q == ITEM_INPUTS ? POOL_INPUTS : item_q == ITEM_DIAG ? POOL_DIAG : POOL_INIT;
  assign stage_index_o = item_q == ITEM_INIT ? arrives_index_q - 8'd14 : arrives_index_q;
  assign stage_data_o = rdata_i;
  assign block_length_o = taken_q;

  logic verdict_wrong_q;
  logic [7:0] type_q;
  logic [1:0] verdict_bits;
  assign verdict_bits = rdata_i[1:0];
  always_ff @(posedge clk_i) begin
    if (arrives_verdict_q) verdict_wrong_q <= item_q == ITEM_VERDICT_PRM || `FAULT(59) ? verdict_bits[0] : verdict_bits[1];
    if (state_q == READ_HEADER) type_q <= rdata_i;  // of the diagnosis
  end
  assign diag_type_o = type_q;
  assign verdict_wrong_o = verdict_wrong_q;

  // ---- initialisation
  logic init_look, init_valid, init_last, limits_wrong;
  assign init_look = state_q == READ_LOOK && item_q == ITEM_INIT;
  assign init_valid = stages_q && item_q == ITEM_INIT;
  assign init_last = state_q == READ_LAST && item_q == ITEM_INIT;
  init_block u_init_block (
    `FAULT_CONNECT
    .clk_i(clk_i), .rst_ni(rst_ni), .look_i(init_look), .valid_i(init_valid), .index_i(arrives_index_q), .byte_i(rdata_i),
    .last_i(init_last), .wrong_o(limits_wrong), .address_o(init_address_o), .ident_o(init_ident_o),
    .command_o(init_command_o), .max_input_o(init_max_input_o), .max_output_o(init_max_output_o),
    .max_diag_o(init_max_diag_o), .max_prm_o(init_max_prm_o), .prm_mode_o(init_prm_mode_o), .max_cfg_o(init_max_cfg_o),
    .cfg_mode_o(init_cfg_mode_o), .cfg_length_o(init_cfg_length_o), .input_length_o(init_input_length_o),
    .output_length_o(init_output_length_o));

  // ---- commits (section 10)
  // What the commit is about is known an edge ahead
  logic commits, readable, commit_init_q, commit_inputs_q, commit_diag_q, commit_c1_q, commit_c2_q;
  logic verdict_prm_q, verdict_cfg_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {commit_init_q, commit_inputs_q, commit_diag_q, commit_c1_q, commit_c2_q, verdict_prm_q, verdict_cfg_q} <= 7'd0;
    end else begin
      commit_init_q <= state_q == READ_LAST && item_q == ITEM_INIT;
      commit_inputs_q <= state_q == READ_LAST && item_q == ITEM_INPUTS && initialised_i;
      commit_diag_q <= state_q == READ_LAST && item_q == ITEM_DIAG && initialised_i;
      commit_c1_q <= state_q == READ_LAST && item_q == ITEM_C1_ANSWER && initialised_i;
      commit_c2_q <= state_q == READ_LAST && item_q == ITEM_C2_ANSWER && initialised_i;
      verdict_prm_q <= state_q == VERDICT && item_q == ITEM_VERDICT_PRM;
      verdict_cfg_q <= state_q == VERDICT && item_q == ITEM_VERDICT_CFG;
    end
  end
  assign commits = state_q == COMMIT;
  assign readable = commits && !too_long_q;
  assign init_o = commit_init_q && !crc_wrong_q && !limits_wrong;
  assign inputs_o = commit_inputs_q && !crc_wrong_q;
  assign diag_o = commit_diag_q && !crc_wrong_q;
  assign c1_answer_o = commit_c1_q && !crc_wrong_q;
  assign c2_answer_o = commit_c2_q && !crc_wrong_q;
  assign verdict_prm_o = verdict_prm_q;
  assign verdict_cfg_o = verdict_cfg_q;

  logic judges;
  assign judges = item_q == ITEM_INPUTS || item_q == ITEM_DIAG || answer_item;
  assign judged = readable && (item_q == ITEM_INIT || (judges && initialised_i));
  assign judged_init = commits && item_q == ITEM_INIT;
  assign init_limits = too_long_q || !crc_wrong_q;
  always_comb begin
    case (item_q)
      ITEM_INIT: error_bit = DSDPV1_REG_CHIP_STATUS_2_INIT_CRC;
      ITEM_INPUTS: error_bit = DSDPV1_REG_CHIP_STATUS_2_INPUT_CRC;
      ITEM_DIAG: error_bit = DSDPV1_REG_CHIP_STATUS_2_DIAG_CRC;
      ITEM_C1_ANSWER: error_bit = `FAULT(91) ? DSDPV1_REG_CHIP_STATUS_2_C2_CRC : DSDPV1_REG_CHIP_STATUS_2_C1_CRC;
      default: error_bit = DSDPV1_REG_CHIP_STATUS_2_C2_CRC;
    endcase
  end
endmodule
