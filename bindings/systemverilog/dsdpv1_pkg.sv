// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The functions of libdsdpv1_dpi.so and the numbers that benches need. bindings/simulator/simulator.h has each one's meaning, units and
// ranges.
package dsdpv1_pkg;
  timeunit 1ps;
  timeprecision 1ps;

  // Bytes: the first one is [0].
  typedef bit [255:0][7:0] bytes_t;

  // Rates (B012), as `baud` has them.
  localparam int BAUD_12M = 0, BAUD_6M = 1, BAUD_3M = 2, BAUD_1M5 = 3, BAUD_500K = 4, BAUD_187K5 = 5, BAUD_93K75 = 6, BAUD_45K45 = 7,
                 BAUD_19K2 = 8, BAUD_9K6 = 9;
  // States of a slave at its master.
  localparam int SLAVE_OFFLINE = 0, SLAVE_DIAGNOSE = 1, SLAVE_CLEAR = 2, SLAVE_SET_PRM = 3, SLAVE_CHK_CFG = 4, SLAVE_AWAIT_READY = 5,
                 SLAVE_DATA_EXCHANGE = 6, SLAVE_RELEASING = 7, SLAVE_RELEASED = 8;
  // Outcome of a request ...
  localparam int SENT = 0, ANSWERED = 1, NO_ANSWER = 2, BAD_ANSWER = 3, ABORTED = 4;
  // ... and of an acyclic one.
  localparam int ACYCLIC_POSITIVE = 0, ACYCLIC_NEGATIVE = 1, ACYCLIC_TIMEOUT = 2, ACYCLIC_REFUSED = 3, ACYCLIC_NO_ANSWER = 4,
                 ACYCLIC_WRONG_ANSWER = 5, ACYCLIC_LOST = 6;
  // States of a connection of class 2.
  localparam int CONNECTION_CLOSED = 0, CONNECTION_INITIATING = 1, CONNECTION_CONNECTING = 2, CONNECTION_OPEN = 3, CONNECTION_BUSY = 4,
                 CONNECTION_ABORTING = 5;
  // Bits of Control_Command (table 23).
  localparam int CONTROL_CLEAR_DATA = 'h02, CONTROL_UNFREEZE = 'h04, CONTROL_FREEZE = 'h08, CONTROL_UNSYNC = 'h10, CONTROL_SYNC = 'h20;
  localparam int BROADCAST = 127;
  // Function_Num of an acyclic request at the user CPU (tables 26, 31), and error codes for its refusal (table 29).
  localparam int DS_TRANSPORT = 'h51, DS_READ = 'h5E, DS_WRITE = 'h5F;
  localparam int ACCESS_INVALID_INDEX = 'hB0, ACCESS_WRITE_LENGTH = 'hB1, ACCESS_INVALID_SLOT = 'hB2, ACCESS_DENIED = 'hB6,
                 ACCESS_INVALID_RANGE = 'hB7, ACCESS_INVALID_PARAMETER = 'hB8;

`ifndef DSDPV1_VPI
  import "DPI-C" function string dsdpv1_error();
  import "DPI-C" function string dsdpv1_message(input int handle);
  import "DPI-C" function int dsdpv1_close(input int handle);

  import "DPI-C" function int dsdpv1_model_create(input string options);
  import "DPI-C" function longint dsdpv1_model_step(input int handle, input longint half, input longint ps, input longint inputs, output longint next);

  import "DPI-C" function int dsdpv1_scoreboard_create(input string options, input longint tolerance_ps);
  import "DPI-C" function int dsdpv1_scoreboard_step(input int handle, input longint half, input longint ps, input longint inputs, input longint outputs,
                                                     output longint next);
  import "DPI-C" function int dsdpv1_scoreboard_matched(input int handle);

  import "DPI-C" function int dsdpv1_checker_create(input string options, input int baud);
  import "DPI-C" function int dsdpv1_checker_step(input int handle, input longint half, input longint ps, input longint inputs, input longint outputs);
  import "DPI-C" function int dsdpv1_checker_finish(input int handle);
  import "DPI-C" function int dsdpv1_checker_applied(input int handle);

  import "DPI-C" function int dsdpv1_master_create(input string options);
  import "DPI-C" function int dsdpv1_master_load(input string scenario, input string settings, input int verbose);
  import "DPI-C" function int dsdpv1_master_step(input int handle, input longint ps, input int enabled, input int level, output longint wake);
  import "DPI-C" function int dsdpv1_master_add_gsd(input int handle, input string path, input string modules, input int address,
                                                    input string options);
  import "DPI-C" function int dsdpv1_master_add_slave(input int handle, input int address, input string options, input bytes_t prm,
                                                      input int prm_size, input bytes_t cfg, input int cfg_size);
  import "DPI-C" function int dsdpv1_master_start(input int handle);
  import "DPI-C" function int dsdpv1_master_stop(input int handle);
  import "DPI-C" function int dsdpv1_master_set_baud(input int handle, input int baud);
  import "DPI-C" function int dsdpv1_master_set_clear(input int handle, input int clear);
  import "DPI-C" function int dsdpv1_master_release(input int handle, input int address);
  import "DPI-C" function int dsdpv1_master_activate(input int handle, input int address);
  import "DPI-C" function int dsdpv1_master_set_outputs(input int handle, input int address, input bytes_t data, input int count);
  import "DPI-C" function int dsdpv1_master_get_inputs(input int handle, input int address, output bytes_t data);
  import "DPI-C" function int dsdpv1_master_slave_state(input int handle, input int address);
  import "DPI-C" function int dsdpv1_master_exchanges(input int handle, input int address);
  import "DPI-C" function int dsdpv1_master_ask(input int handle, input int service, input int address);
  import "DPI-C" function int dsdpv1_master_request(input int handle, input int address, input int dsap, input int ssap, input bytes_t data,
                                                    input int count);
  import "DPI-C" function int dsdpv1_master_global_control(input int handle, input int command, input int group, input int address);
  import "DPI-C" function int dsdpv1_master_set_slave_address(input int handle, input int address, input int new_address, input int ident,
                                                              input int lock);
  import "DPI-C" function int dsdpv1_master_read(input int handle, input int peer, input int slot, input int index, input int count);
  import "DPI-C" function int dsdpv1_master_write(input int handle, input int peer, input int slot, input int index, input bytes_t data,
                                                  input int count);
  import "DPI-C" function int dsdpv1_master_transport(input int handle, input int peer, input int slot, input int index, input bytes_t data,
                                                      input int count);
  import "DPI-C" function int dsdpv1_master_done(input int handle, input int id, output int outcome, output int codes, output bytes_t data,
                                                 output int count);
  import "DPI-C" function int dsdpv1_master_add_connection(input int handle, input int slave, input int send_timeout);
  import "DPI-C" function int dsdpv1_master_connect(input int handle, input int connection);
  import "DPI-C" function int dsdpv1_master_abort(input int handle, input int connection, input int reason);
  import "DPI-C" function int dsdpv1_master_connection_state(input int handle, input int connection);
`endif
endpackage
