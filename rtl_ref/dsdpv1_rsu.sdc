# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Constraints of the top dsdpv1_rsu, in ns: those of its serial ports. Read dsdpv1.sdc first, whose lines hold for this top, too.
if {![info exists h]} {set h /}

# ---- SCK (SP2): high and low for 50 ns or more; MOSI stands 12.5 ns before and after its rise
create_clock -name SCK -period 100 -waveform {0 50} [get_ports sck_i]
set_input_delay -clock SCK -max 87.5 [get_ports mosi_i]
set_input_delay -clock SCK -min 12.5 [get_ports mosi_i]
# MISO's next bit is out spi_miso_delay = 10 ns after SCK's fall: 40 ns before the rise
set_output_delay -clock SCK -max 40 [get_ports miso_o]
# TXD is from a register of CLK
set_output_delay -clock CLK 0 [get_ports txd_o]
# MISO's driver is that of XSS, not of an edge
set_false_path -to [get_ports miso_oe_o]

# ---- pins that no clock takes
# two flip-flops behind each (SP2, UA2)
set_false_path -from [get_ports {xss_i rxd_i}]
# straps are wired; the edge R alone reads them (R11)
set_false_path -from [get_ports {mode_i* adr_i* ubr_i* uiv_i*}]

# ---- from CLK to WR, to reads and to SCK
# The straps change at R alone, as listens_q does
set_false_path -from [get_cells u_straps${h}straps_q*] -to [get_cells [list u_host_port${h}entry*_q* u_host_port${h}head_q* u_host_port${h}head_gray_q* u_host_port${h}open_q*]]
# listening_q rises 41.7 ns after a fall of XSS at the latest, and SCK 50 ns after it or later (SP2)
set_max_delay 8.3 -from [get_cells u_serial_port${h}u_spi${h}listening_q*] -to [get_cells [list u_serial_port${h}u_spi${h}u_shift${h}bits_q* u_serial_port${h}u_spi${h}u_shift${h}any_q* u_serial_port${h}u_spi${h}u_shift${h}miso_q*]]
# The release of reset: flip_q changes at the eighth rise of a frame, and frames are counted from R on
set_false_path -from [get_cells release_q*] -to [get_cells u_serial_port${h}u_spi${h}u_shift${h}flip_q*]
# The registers of the reply are loaded 3.2 cycles = 66 ns or more before their use (5.4)
set_max_delay 66 -from [get_cells u_serial_port${h}u_spi${h}tx*_q*] -to [get_cells u_serial_port${h}u_spi${h}u_shift${h}miso_q*]

# ---- from SCK to CLK
# two flip-flops
set_false_path -from [get_cells u_serial_port${h}u_spi${h}u_shift${h}flip_q*] -to [get_cells u_serial_port${h}u_spi${h}flip_first_q*]
# The byte is bundled with flip_q: it is taken two edges later and stands for eight SCK
set_max_delay 41.667 -from [get_cells u_serial_port${h}u_spi${h}u_shift${h}byte_q*] -to [get_cells [list u_serial_port${h}u_buffer${h}* u_serial_port${h}u_crc${h}* u_serial_port${h}u_telegram${h}*]]
