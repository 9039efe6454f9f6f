// Each assertion fails if its rule is broken: pins are moved directly, +broken=NAME selects the rule to break; without it all are kept.
module assertions;
  timeunit 1ps;
  timeprecision 1ps;
  logic reset_i = 1'b0, clk_i = 1'b0, pbtxd_o = 1'b1, pbrts_o = 1'b0, r_req_i = 1'b0, r_sta_i = 1'b0, l_req_o = 1'b0, l_sta_o = 1'b0, d_oe_o = 1'b0,
        csr_i = 1'b1, rd_i = 1'b1, intr0_o = 1'b1, pbf_o = 1'b1, br_o = 1'b0, ready_o = 1'b0;
  dsdpv1_assertions u_assertions (.*);
  always #10000 clk_i = !clk_i;

  string broken;
  int low, gap, lead;
  task cycles(input int count);
    int i;
    for (i = 0; i < count; i = i + 1) @(negedge clk_i);
  endtask

  task pulse;
    intr0_o = 1'b0;
    cycles(low);
    intr0_o = 1'b1;
    cycles(gap);
  endtask

  initial begin
    if (!$value$plusargs("broken=%s", broken)) broken = "";
    low = broken == "intr0_not_longer" ? 65 : broken == "intr0_not_shorter" ? 63 : 64;
    gap = broken == "intr0_gap" ? 63 : 64;
    lead = broken == "rts_leads" ? 3 : 4;
    cycles(6);
    if (broken == "outputs_in_reset") begin
      pbf_o = 1'b0;
      cycles(2);
    end
    if (broken == "d_released_in_reset") begin
      {csr_i, rd_i, d_oe_o} = 3'b001;
      cycles(2);
    end
    reset_i = 1'b1;
    cycles(3);
    if (broken == "br_after_ready") br_o = 1'b1;
    if (broken == "exchange_after_ready") pbf_o = 1'b0;
    cycles(2);
    ready_o = 1'b1;
    br_o = 1'b1;
    pbf_o = 1'b0;
    l_req_o = 1'b1;
    l_sta_o = broken != "l_req_is_l_sta";
    cycles(2);
    l_req_o = 1'b0;
    l_sta_o = 1'b0;
    r_req_i = 1'b1;
    r_sta_i = 1'b1;
    cycles(2);
    csr_i = 1'b0;
    rd_i = 1'b0;
    d_oe_o = 1'b1;
    cycles(2);
    csr_i = 1'b1;
    rd_i = 1'b1;
    d_oe_o = broken == "d_driven_in_reads_only";
    l_req_o = broken == "one_owner";
    l_sta_o = broken == "one_owner";
    cycles(2);
    pulse;
    pulse;
    pbrts_o = broken != "txd_idle_without_rts";
    cycles(lead);
    pbtxd_o = 1'b0;
    cycles(4);
    pbtxd_o = 1'b1;
    cycles(8);
    pbrts_o = 1'b0;
    ready_o = broken != "ready_stays";
    br_o = 1'b0;
    pbf_o = 1'b1;
    cycles(4);
    $display("passed");
    $finish;
  end
endmodule
