// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The next item of an access (9.2; H4): the first that is due, and its first move.
`include "dpram_types.svh"

module dpram_choice (
  `FAULT_PORT
  input  logic [ITEMS-1:0] candidates_i,  // due and after the item done last; the first lowest
  input  logic [6:0]  command_2_i,        // B011 as it was read, without bit 7
  input  dp_mail_t    mail_i,             // the first bytes of each item of mail; candidates_i tells which ones wait
  input  logic [7:0]  c1_function_i,
  input  logic [7:0]  c2_function_i,
  input  logic [15:0] count_i,            // B008, B009
  input  logic        status_1_i,         // B00A
  input  logic [7:0]  status_3_i,         // B012
  input  logic        status_4_i,         // B013
  output item_t       pick_o,
  output logic        we_o,
  output logic [10:0] addr_o,
  output logic [7:0]  wdata_o
);
  logic [7:0] count_high, count_low;
  assign {count_high, count_low} = count_i;
  logic [7:0] prm_length, cfg_first, output_length;
  assign prm_length = mail_i.parameters.length;
  assign cfg_first = `FAULT(52) ? mail_i.configuration.input_length : mail_i.configuration.output_length;
  assign output_length = mail_i.outputs.length;

  always_comb begin
    casez (candidates_i)
      20'b???????????????????1: pick_o = ITEM_INIT;
      20'b??????????????????10: pick_o = ITEM_VERDICT_PRM;
      20'b?????????????????100: pick_o = ITEM_VERDICT_CFG;
      20'b????????????????1000: pick_o = ITEM_HISTORY;
      20'b???????????????10000: pick_o = ITEM_INPUTS;
      20'b??????????????100000: pick_o = ITEM_DIAG;
      20'b?????????????1000000: pick_o = ITEM_C1_ANSWER;
      20'b????????????10000000: pick_o = ITEM_C2_ANSWER;
      20'b???????????100000000: pick_o = ITEM_PRM;
      20'b??????????1000000000: pick_o = ITEM_CFG;
      20'b?????????10000000000: pick_o = ITEM_OUTPUTS;
      20'b????????100000000000: pick_o = ITEM_C1_REQUEST;
      20'b???????1000000000000: pick_o = ITEM_C2_REQUEST;
      20'b??????10000000000000: pick_o = ITEM_VALID;
      20'b?????100000000000000: pick_o = ITEM_COUNT_HIGH;
      20'b????1000000000000000: pick_o = ITEM_COUNT_LOW;
      20'b???10000000000000000: pick_o = ITEM_STATUS_1;
      20'b??100000000000000000: pick_o = ITEM_STATUS_2;
      20'b?1000000000000000000: pick_o = ITEM_STATUS_3;
      20'b10000000000000000000: pick_o = ITEM_STATUS_4;
      default: pick_o = ITEM_NOTHING;
    endcase
  end

  always_comb begin
    we_o = 1'b0;
    addr_o = 11'd0;
    wdata_o = 8'h00;
    case (pick_o)
      ITEM_INIT: addr_o = DSDPV1_REG_INIT_LENGTH;
      ITEM_VERDICT_PRM, ITEM_VERDICT_CFG: addr_o = DSDPV1_REG_USER_STATUS_1;
      ITEM_HISTORY: begin
        we_o = !`FAULT(102);
        addr_o = DSDPV1_REG_USER_COMMAND_2;
        wdata_o = {1'b0, command_2_i};
      end
      ITEM_INPUTS: addr_o = DSDPV1_REG_INPUT_LENGTH;
      ITEM_DIAG: addr_o = DSDPV1_REG_DIAG_TYPE;
      ITEM_C1_ANSWER: addr_o = DSDPV1_REG_C1_FUNCTION_NUM;
      ITEM_C2_ANSWER: addr_o = DSDPV1_REG_C2_FUNCTION_NUM;
      ITEM_PRM: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_PRM_LENGTH;
        wdata_o = prm_length;
      end
      ITEM_CFG: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_CFG_OUTPUT_LENGTH;
        wdata_o = cfg_first;
      end
      ITEM_OUTPUTS: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_OUTPUT_LENGTH;
        wdata_o = output_length;
      end
      ITEM_C1_REQUEST: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_C1_FUNCTION_NUM;
        wdata_o = c1_function_i;
      end
      ITEM_C2_REQUEST: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_C2_FUNCTION_NUM;
        wdata_o = c2_function_i;
      end
      ITEM_VALID: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_VALID_FLAG;
        wdata_o = DSDPV1_REG_VALID_FLAG_VALID;
      end
      ITEM_COUNT_HIGH: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_OFFLINE_COUNT;
        wdata_o = count_high;
      end
      ITEM_COUNT_LOW: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_OFFLINE_COUNT + 11'd1;
        wdata_o = count_low;
      end
      ITEM_STATUS_1: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_CHIP_STATUS_1;
        wdata_o = {7'd0, status_1_i};
      end
      ITEM_STATUS_2: addr_o = DSDPV1_REG_CHIP_STATUS_2;
      ITEM_STATUS_3: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_CHIP_STATUS_3;
        wdata_o = status_3_i;
      end
      ITEM_STATUS_4: begin
        we_o = 1'b1;
        addr_o = DSDPV1_REG_CHIP_STATUS_4;
        wdata_o = {7'd0, status_4_i};
      end
      default: ;
    endcase
  end
endmodule
