// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Judgement of a telegram (5.3, 6.3; SP10 to SP13, SP16, UA13): error code, refusal, and what it causes. No registers.
`include "dsdpv1_rsu_types.svh"

module host_judgement (
  `FAULT_PORT
  input  logic       spi_i,
  input  logic       judged_i,    // a telegram, at this edge
  input  logic       replies_i,   // SPI: its frame continues after this edge
  /* verilator lint_off UNUSEDSIGNAL */  // data of a commit are host_commit's
  input  telegram_t  telegram_i,
  /* verilator lint_on UNUSEDSIGNAL */
  input  logic       owns_i,      // the chip was in an access before this edge
  input  logic       busy_i,      // an earlier commit was not done before this edge
  output judgement_t judgement_o
);
  logic wrong, changes, claims, exchanges, refused;
  assign wrong = telegram_i.crc_wrong || telegram_i.address_wrong || telegram_i.data_wrong || telegram_i.length_wrong;
  assign changes = telegram_i.ask != ASK_READ;
  assign claims = telegram_i.ask == ASK_WRITE && telegram_i.covers && telegram_i.claims && !`FAULT(139);
  assign exchanges = telegram_i.ask == ASK_EXCHANGE && !`FAULT(140);
  assign refused = spi_i && ((changes && busy_i) || ((claims || exchanges) && owns_i));

  logic carried_out;
  assign carried_out = judged_i && !wrong && !refused;
  assign judgement_o.replies = judged_i && replies_i;
  assign judgement_o.refused = wrong || refused;
  assign judgement_o.code =
`ifdef SINGLE_FAULTS
      `FAULT(219) && telegram_i.crc_wrong ? {telegram_i.length_wrong, telegram_i.data_wrong, telegram_i.address_wrong, 1'b1} :
`endif
      telegram_i.crc_wrong ? 4'b0001 :
                            {telegram_i.length_wrong, telegram_i.data_wrong, telegram_i.address_wrong, 1'b0};
  assign judgement_o.crc_right = judged_i && !telegram_i.crc_wrong;
  assign judgement_o.commits = carried_out && (changes || !spi_i);
  assign judgement_o.owns = carried_out && telegram_i.ask == ASK_WRITE && telegram_i.covers;
endmodule
