# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Constraints of the top dsdpv1, in ns: clocks, what the documents say of pins, and what every crossing of clocks needs (docs/rtl.md, Crossings).
# Names are those of the RTL: registers by the variable of the source, with $h between the levels ("/" in a tool that keeps the hierarchy, "." in
# a flat netlist of Yosys). constraints.py checks that each is there, and that no crossing is without a line here.
if {![info exists h]} {set h /}

# ---- clocks. Both edges of CLK are used: the DPRAM reads at the rising one, D's register takes its byte at the falling one (figure 6), so that the
# path from the RAM to D has half a cycle, and that from taken_q to driven_q, too. The duty cycle is half; another one goes into the uncertainty.
create_clock -name CLK -period 20.833 -waveform {0 10.416} [get_ports clk_i]
# Table 15: WR is low for Ts = 12.5 ns or more. Its high time is in no document: 12.5 ns, as A and D stand for Td after the rise, are assumed.
create_clock -name WR -period 25 -waveform {12.5 25} [get_ports wr_i]
# RD and CSR low, the clock of open_q: no less than Tw = 31.25 ns (table 15); no document says how long RD is high between two reads, a cycle is taken.
create_clock -name reads -period 52.083 -waveform {0 31.25} [get_nets u_host_port${h}reads]

# ---- pins that WR takes. Table 15, Td: A and D stand 12.5 ns before and after its rise
set_input_delay -clock WR -max 12.5 [get_ports {a_i* d_i*}]
set_input_delay -clock WR -min 12.5 [get_ports {a_i* d_i*}]
# CSR is low at WR's rise (P5); Ts = 12.5 ns before it is assumed, no document says how long
set_input_delay -clock WR -max 12.5 [get_ports csr_i]
set_input_delay -clock WR -min 0 [get_ports csr_i]

# ---- pins that CLK makes: each from a register, seen by the board before the next edge; D, from the falling edge, in half a cycle
set_output_delay -clock CLK 0 [get_ports {pbtxd_o pbrts_o l_req_o l_sta_o d_o* intr0_o pbf_o br_o ready_o}]
# D_OE is that of the pins RD and CSR, not of an edge; open_q changes only where RD and CSR fall (D_OE, docs/rtl.md)
set_false_path -to [get_ports d_oe_o]

# ---- pins that no clock takes
# RESET: asserted at any time; its release passes both registers of release_q, whose first has a constant as data
set_false_path -from [get_ports reset_i]
# two flip-flops behind each (P9)
set_false_path -from [get_ports {pbrxd_i r_req_i r_sta_i}]
# RD and CSR clear taken_q and driven_q at any time; the release passes both, and D is sampled Tw later (table 15)
set_false_path -from [get_ports {rd_i csr_i}] -to [get_cells [list u_host_port${h}taken_q* u_host_port${h}driven_q*]]
# RD and CSR as the clock of open_q
set_false_path -from [get_ports {rd_i csr_i}] -to [get_cells u_host_port${h}open_q*]
# A stands from RD's fall on (table 15, Tc): it must reach the RAM as soon as RD's fall reaches taken_q, and half a cycle bounds both
set_max_delay 10.416 -from [get_ports a_i*] -to [get_cells [list u_dpram${h}*]]

# ---- from WR to CLK
# The Gray pointer: WR's rises are more than a cycle apart, so bits that differ by less than a cycle keep the code
set_max_delay 20.833 -from [get_cells u_host_port${h}head_gray_q*] -to [get_cells u_host_port${h}gray_first_q*]
# ... its hold is that of an asynchronous signal
set_false_path -hold -from [get_cells u_host_port${h}head_gray_q*] -to [get_cells u_host_port${h}gray_first_q*]
# The entries are bundled with it: they stand before the pointer changes and are taken at the third edge, two whole cycles later
set_max_delay 41.667 -from [get_cells u_host_port${h}entry*_q*] -to [get_cells [list u_dpram${h}*]]
# ... and a fifth write, which changes one, would come 100 ns later
set_false_path -hold -from [get_cells u_host_port${h}entry*_q*] -to [get_cells [list u_dpram${h}*]]

# ---- from CLK to WR and to reads
# listens_q rises at R alone; a user who asks after R owns the DPRAM later (H6)
set_false_path -from [get_cells u_host_port${h}listens_q*] -to [get_cells [list u_host_port${h}entry*_q* u_host_port${h}head_q* u_host_port${h}head_gray_q*]]
# ... nor does RD fall there; if it does, that one access drives D or does not
set_false_path -from [get_cells u_host_port${h}listens_q*] -to [get_cells u_host_port${h}open_q*]
# The release of reset: these registers have their reset value at their data input at that time
set_false_path -from [get_cells release_q*] -to [get_cells [list u_host_port${h}head_q* u_host_port${h}head_gray_q* u_host_port${h}open_q*]]
