// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The area that an exchange replies (6.4): the first of which the chip has news, else the outputs.
`include "dsdpv1_rsu_types.svh"

module host_choice (
  `FAULT_PORT
  input  logic        news_i,      // news are asked for
  input  logic        prm_i,       // B00E.1
  input  logic        cfg_i,       // B00E.2
  input  logic        c1_i,        // B00F.0
  input  logic        c2_i,        // B00F.1
  output area_t       area_o,
  output logic [10:0] base_o,      // its first byte
  output logic [1:0]  header_o     // bytes of its header after the first
);
  area_t news;
  logic some;
  assign some = news_i && (prm_i || cfg_i || c1_i || c2_i);
  always_comb begin
    if (cfg_i && `FAULT(144)) news = AREA_CONFIGURATION;
    else if (prm_i) news = AREA_PARAMETERS;
    else if (cfg_i) news = AREA_CONFIGURATION;
    else if (c1_i) news = AREA_C1;
    else news = AREA_C2;
  end
  always_comb begin
    area_o = AREA_OUTPUTS;
    if (some) area_o = news;
  end
  always_comb begin
    case (area_o)
      AREA_PARAMETERS: {base_o, header_o} = {DSDPV1_REG_PRM, 2'd0};
      AREA_CONFIGURATION: {base_o, header_o} = {DSDPV1_REG_CFG, 2'd2};
      AREA_C1: {base_o, header_o} = {DSDPV1_REG_C1, 2'd3};
      AREA_C2: {base_o, header_o} = {DSDPV1_REG_C2, 2'd3};
      default: {base_o, header_o} = {DSDPV1_REG_OUTPUT, 2'd0};
    endcase
  end
endmodule
