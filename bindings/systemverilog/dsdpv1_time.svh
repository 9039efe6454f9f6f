// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Shared by the modules with a chip's pins: the halves of a cycle of CLK, see bindings/simulator/simulator.h, and wake-ups at a time.
  longint half = 0;     // 2n since the rising edge n, 2n + 1 since the falling edge after it
  longint edge_ps = 0;  // when that was
  bit counts = 1'b0;    // the first rising edge has its number from its time, all others by counting

  task count_edge;
    edge_ps = $time;
    if (clk_i !== 1'b1) half = half | 1;
    else if (counts) half = (half | 1) + 1;
    else begin
      half = 2 * ((edge_ps * 6 + 62500) / 125000);
      counts = 1'b1;
    end
  endtask

  // The earliest pending wake-up. It cannot be cancelled; a needless one does no harm.
  longint planned = -1;
  int plans = 0;
  int alarm = 0;
  task plan(input longint at);
    longint now;
    now = $time;
    if (planned <= now || at < planned) begin
      planned = at;
      plans = plans + 1;
    end
  endtask
  always @(plans) alarm <= #(planned - $time) plans;

  // MISO, which CLK does not move, changes between two of its edges: `next` is then negative.
  task plan_between(input longint next);
    longint now;
    now = $time;
    if (next < 0) plan(edge_ps - next > now ? edge_ps - next : now + 1);
  endtask
