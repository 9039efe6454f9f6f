// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A PROFIBUS master, class 1 or 2, as a bus functional model. Once started it works automatically: bus parameters, token, polling of its
// slaves, repetitions. Tasks are acyclic services; each returns with the answer. Bits are at their exact times, in ps rounded from the
// absolute count of 1/12 ns.
//
// `rxd_i` is the level that all other stations put on the line, `rxd_en_i` whether one of them drives it (profibus_segment has both; with a
// single chip its PBTXD and PBRTS). `txd_o` and `rts_o` are the master's driver.
//
// With SCENARIO it needs no task: the masters of that file (docs/scenarios.md), both classes, start at their times and execute the script's
// actions for masters. Slaves, their user CPUs, plugs, and expect are ignored and displayed once; a `when` that only a slave could evaluate
// is an error. Tasks then apply to the first master. The file's path is relative to the simulator's working folder.
//
// A task is called by one process at a time; two processes may wait in different tasks.
`include "dsdpv1_calls.svh"

module profibus_master #(
  parameter integer MASTER_CLASS = 1,
  parameter integer ADDRESS = 2,
  parameter integer BAUD = 0,     // 0: 12M ... 9: 9.6k
  parameter integer RING = 0,     // 1: shares the token with other masters; class 2 always does
  parameter OPTIONS = "",         // other members of dpsim_master_options (include/dsdpv1/master.h): "slot_bits=1000 gap_factor=-1"
  parameter SCENARIO = "",        // a scenario's file: its masters run automatically; the parameters above are ignored
  parameter SETTINGS = "",        // replaced keys of the scenario: "baud=1.5M;masters.0.start=1ms"
  parameter integer VERBOSE = 0   // 1: displays states of slaves, faults on the line, answers to the script
) (
  input  logic rxd_i,
  input  logic rxd_en_i,
  output logic txd_o,
  output logic rts_o
);
  /* verilator no_inline_module */  // its 5.006 scales the delays of an inlined module by the parent's time unit
  timeunit 1ps;
  timeprecision 1ps;
  import dsdpv1_pkg::*;

  int handle = 0;
  event ran;                // after each step
  longint planned = -1;     // the earliest pending wake-up
  int alarm = 0, plans = 0;

  task fail;
    $fatal(1, "%m: %0s", `DSDPV1(error)());
  endtask

  // Wake-ups cannot be cancelled; a needless one does no harm.
  task plan(input longint now, input longint wake);
    if (wake >= 0 && (planned <= now || wake < planned)) begin
      planned = wake;
      plans = plans + 1;
    end
  endtask
  always @(plans) alarm <= #(planned - $time) plans;

  // A task requests that everything up to the present time be simulated.
  int asked = 0;
  task run;
    asked = asked + 1;
    @(ran);
  endtask

  task step;
    int driver;
    longint now, wake;
    if (handle != 0) begin
      now = $time;
      driver = `DSDPV1(master_step)(handle, now, {31'd0, rxd_en_i === 1'b1}, {31'd0, rxd_i !== 1'b0}, wake);
      if (driver < 0) fail();
      txd_o <= driver[0];
      rts_o <= driver[1];
      plan(now, wake);
      if (VERBOSE != 0) tell();
      -> ran;
    end
  endtask

  task tell;
    `DSDPV1_TEXT text;
    text = `DSDPV1(message)(handle);
    while (text != "") begin
      $display("%0t ps %m: %0s", $time, text);
      text = `DSDPV1(message)(handle);
    end
  endtask

  initial begin
    string options;
    options = $sformatf("master_class=%0d address=%0d baud=%0d ring=%0d verbose=%0d %0s", MASTER_CLASS, ADDRESS, BAUD, RING, VERBOSE, OPTIONS);
    if (SCENARIO == "") handle = `DSDPV1(master_create)(options);
    else handle = `DSDPV1(master_load)(SCENARIO, SETTINGS, VERBOSE);
    if (handle == 0) fail();
    tell();  // the ignored parts of a scenario
  end
  always @(handle or asked or alarm or rxd_i or rxd_en_i) step();

  // Evaluates a command's result; the command takes effect at the present time.
  task commanded(input int status);
    if (status < 0) fail();
    run();
  endtask

  // ---- its slaves, its operation

  // Adds a slave by its GSD file; `modules` by name, separated by ';', "": those that the file presets. `options`: see add_slave.
  task add_gsd(input string path, input string modules, input int address, input string options);
    run();
    commanded(`DSDPV1(master_add_gsd)(handle, path, modules, address, options));
  endtask

  // Adds a slave by its numbers; `options`: "ident=0xC90F input_length=8 output_length=8 flags=8 wd_fact_1=10 wd_fact_2=10 min_tsdr=11
  // group_ident=1", see dpsim_slave in include/dsdpv1/gsd.h.
  task add_slave(input int address, input string options, input bytes_t prm, input int prm_size, input bytes_t cfg, input int cfg_size);
    run();
    commanded(`DSDPV1(master_add_slave)(handle, address, options, prm, prm_size, cfg, cfg_size));
  endtask

  task start;
    run();
    commanded(`DSDPV1(master_start)(handle));
  endtask

  task stop;
    run();
    commanded(`DSDPV1(master_stop)(handle));
  endtask

  task set_baud(input int baud);
    run();
    commanded(`DSDPV1(master_set_baud)(handle, baud));
  endtask

  // 1: Clear, 0: Operate
  task set_clear(input int clear);
    run();
    commanded(`DSDPV1(master_set_clear)(handle, clear));
  endtask

  task release_slave(input int address);
    run();
    commanded(`DSDPV1(master_release)(handle, address));
  endtask

  task activate_slave(input int address);
    run();
    commanded(`DSDPV1(master_activate)(handle, address));
  endtask

  // Sent from the next data exchange on.
  task set_outputs(input int address, input bytes_t data, input int count);
    run();
    commanded(`DSDPV1(master_set_outputs)(handle, address, data, count));
  endtask

  // Inputs of the last data exchange.
  task get_inputs(input int address, output bytes_t data, output int count);
    run();
    count = `DSDPV1(master_get_inputs)(handle, address, data);
    if (count < 0) fail();
  endtask

  // SLAVE_... of dsdpv1_pkg
  function int slave_state(input int address);
    slave_state = `DSDPV1(master_slave_state)(handle, address);
  endfunction

  // Number of data exchanges with this slave.
  function int exchanges(input int address);
    exchanges = `DSDPV1(master_exchanges)(handle, address);
  endfunction

  // Waits until the slave is in this state. `reached` 0: not within `limit_ps`.
  task wait_state(input int address, input int state, input longint limit_ps, output int reached);
    longint now, until_ps;
    now = $time;
    until_ps = now + limit_ps;
    run();
    while (slave_state(address) != state && now < until_ps) begin
      @(ran);
      now = $time;
    end
    reached = slave_state(address) == state ? 1 : 0;
  endtask

  // ---- acyclic services. `outcome`: ANSWERED, NO_ANSWER, ... of dsdpv1_pkg; `fc`: function code of the answer; `data`: its
  // ---- bytes without addresses, SAPs and frame

  task finish_request(input int id, output int outcome, output int codes, output bytes_t data, output int count);
    int done;
    if (id < 0) fail();
    run();
    done = 0;
    while (done == 0) begin
      done = `DSDPV1(master_done)(handle, id, outcome, codes, data, count);
      if (done < 0) fail();
      if (done == 0) @(ran);
    end
  endtask

  task ask(input int service, input int address, output int outcome, output int fc, output bytes_t data, output int count);
    run();
    finish_request(`DSDPV1(master_ask)(handle, service, address), outcome, fc, data, count);
  endtask

  task fdl_status(input int address, output int outcome, output int fc);
    bytes_t data;
    int count;
    ask(0, address, outcome, fc, data, count);
  endtask

  task slave_diag(input int address, output int outcome, output bytes_t data, output int count);
    int fc;
    ask(60, address, outcome, fc, data, count);
  endtask

  task get_cfg(input int address, output int outcome, output bytes_t data, output int count);
    int fc;
    ask(59, address, outcome, fc, data, count);
  endtask

  task read_inputs(input int address, output int outcome, output bytes_t data, output int count);
    int fc;
    ask(56, address, outcome, fc, data, count);
  endtask

  task read_outputs(input int address, output int outcome, output bytes_t data, output int count);
    int fc;
    ask(57, address, outcome, fc, data, count);
  endtask

  // Any SRD high; SAPs -1: none. The answer replaces the request's data.
  task request(input int address, input int dsap, input int ssap, inout bytes_t data, inout int count, output int outcome, output int fc);
    int id;
    run();
    id = `DSDPV1(master_request)(handle, address, dsap, ssap, data, count);
    finish_request(id, outcome, fc, data, count);
  endtask

  // `prm`: all data of Set_Prm, including its first 7 bytes (table 19)
  task set_prm(input int address, input bytes_t prm, input int prm_size, output int outcome, output int fc);
    bytes_t data;
    int count;
    data = prm;
    count = prm_size;
    request(address, 61, 62, data, count, outcome, fc);
  endtask

  task chk_cfg(input int address, input bytes_t cfg, input int cfg_size, output int outcome, output int fc);
    bytes_t data;
    int count;
    data = cfg;
    count = cfg_size;
    request(address, 62, 62, data, count, outcome, fc);
  endtask

  // `data` holds the outputs, then the inputs.
  task data_exchange(input int address, inout bytes_t data, inout int count, output int outcome, output int fc);
    request(address, -1, -1, data, count, outcome, fc);
  endtask

  // `command`: CONTROL_... of dsdpv1_pkg; to `address` (BROADCAST: all) and the groups of `group` (0: all)
  task global_control(input int command, input int group, input int address, output int outcome);
    bytes_t data;
    int codes, count;
    run();
    finish_request(`DSDPV1(master_global_control)(handle, command, group, address), outcome, codes, data, count);
  endtask

  // `lock` 1: forbids later changes
  task set_slave_address(input int address, input int new_address, input int ident, input int lock, output int outcome, output int fc);
    bytes_t data;
    int count;
    run();
    finish_request(`DSDPV1(master_set_slave_address)(handle, address, new_address, ident, lock), outcome, fc, data, count);
  endtask

  // ---- acyclic. `peer`: class 1 a slave's address, class 2 a connection. `outcome`: ACYCLIC_... of dsdpv1_pkg; `codes`: Error_Decode * 65536
  // ---- + Error_Code_1 * 256 + Error_Code_2

  task acyclic_read(input int peer, input int slot, input int index, input int most, output int outcome, output int codes, output bytes_t data,
                    output int count);
    run();
    finish_request(`DSDPV1(master_read)(handle, peer, slot, index, most), outcome, codes, data, count);
  endtask

  task acyclic_write(input int peer, input int slot, input int index, input bytes_t data, input int count, output int outcome,
                     output int codes);
    bytes_t answer;
    int answer_count;
    run();
    finish_request(`DSDPV1(master_write)(handle, peer, slot, index, data, count), outcome, codes, answer, answer_count);
  endtask

  // Class 2 only. The answer replaces the request's data.
  task acyclic_transport(input int peer, input int slot, input int index, inout bytes_t data, inout int count, output int outcome,
                         output int codes);
    int id;
    run();
    id = `DSDPV1(master_transport)(handle, peer, slot, index, data, count);
    finish_request(id, outcome, codes, data, count);
  endtask

  // Class 2: Initiate. `send_timeout` in 10 ms, 0: 100. `state`: CONNECTION_OPEN, or CONNECTION_CLOSED if refused.
  task initiate(input int slave, input int send_timeout, output int connection, output int state);
    run();
    connection = `DSDPV1(master_add_connection)(handle, slave, send_timeout);
    if (connection < 0) fail();
    commanded(`DSDPV1(master_connect)(handle, connection));
    state = CONNECTION_INITIATING;
    while (state == CONNECTION_INITIATING || state == CONNECTION_CONNECTING) begin
      @(ran);
      state = connection_state(connection);
    end
  endtask

  // Aborts the connection and waits until it is closed. `reason` 0: an ordinary end.
  task abort(input int connection, input int reason);
    run();
    commanded(`DSDPV1(master_abort)(handle, connection, reason));
    while (connection_state(connection) != CONNECTION_CLOSED) @(ran);
  endtask

  function int connection_state(input int connection);
    connection_state = `DSDPV1(master_connection_state)(handle, connection);
  endfunction
endmodule
