# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""The proofs: what is bound where, what is cut away, and the defects of the twins."""
import dataclasses

CHIP = "dsdpv1/dsdpv1.sv"
HANDSHAKE = "dsdpv1/handshake.sv"
SEQUENCER = "dpram/dpram_sequencer.sv"
ANY_PARAMETERS = ("DSDPV1_RUN_TIME_LIMITS",)


@dataclasses.dataclass(frozen=True)
class Proof:
    name: str
    title: str
    top: str
    bind: dict = dataclasses.field(default_factory=dict)  # source file: properties
    asserts: tuple = ()      # names of assertions of bindings/systemverilog/dsdpv1_assertions.sv, bound to the chip
    cut_cells: tuple = ()    # instances whose outputs become free
    cut_wires: tuple = ()    # wires that become free
    defines: tuple = ()
    engine: str = "pdr"      # or "induction", "miter"
    depth: int = 0           # of the induction
    twin_depth: int = 0      # cycles in which the twin's violation is looked for; 0: abc looks for it, without a limit
    faults: tuple = ()       # the defects, a twin each: of dsdpv1/faults.txt or dsdpv1_rsu/faults.txt,
    edit: tuple = ()         # and file, old text, new text
    second: tuple = ()       # another such edit
    chip: str = "dsdpv1"     # whose files
    two_clocks: bool = False  # clocks are signals, and a step is a part of a cycle
    excepted: tuple = ()     # registers that are equal in both copies of a miter


def states(block, file, edit, **more):
    """No state machine of a block leaves its legal states, whatever its inputs do."""
    return Proof(name=f"{block}_states", title=f"{block}: legal states only", top=more.pop("top", block),
                 bind={file: f"{block}_states", **more.pop("more_binds", {})}, edit=(file, *edit), **more)


ALWAYS = "1'b1"


def recovers(name, file, legal, event, edit):
    """An illegal code of a register is left at each edge with this event, whatever else an upset has changed."""
    folder, block = file.removesuffix(".sv").split("/")
    return Proof(name=f"{name}_recovers", title=f"{name}: an illegal code is left", top=block, bind={file: "recovers"},
                 defines=(f"LEGAL={legal}", f"EVENT={event}"), edit=(file, *edit), chip="dsdpv1_rsu" if folder == "dsdpv1_rsu" else "dsdpv1")


def serial(name, title, top, bind, **more):
    """For DSDPV1-RSU's serial ports."""
    return Proof(name=name, title=title, top=top, bind={f"dsdpv1_rsu/{block}.sv": properties for block, properties in bind.items()},
                 chip="dsdpv1_rsu", **more)


def assertions(name, title, names, **more):
    """The assertions that simulators bind (docs/systemverilog.md), for a user that keeps H2."""
    return Proof(name=f"assertions_{name}", title=title, top="dsdpv1", asserts=names, defines=("DSDPV1_IMMEDIATE", "DSDPV1_ASSUME_USER"), **more)


HALF_OF_STATION = ("*station*/c:u_uart_rx", "*station*/c:u_telegram_rx", "fdl/c:u_builder", "fdl/c:u_answers", "*dp_slave*/c:u_buffers",
                   "*dp_slave*/c:u_set_prm", "*dp_slave*/c:u_check_cfg", "dp_service/c:u_global_control", "*dp_slave*/c:u_diagnosis")
SLOW_OF_STATION = ("w:u_station.u_baud_search.window_of_rate", "w:u_station.u_watchdog.last_q")

# Registers without reset that keep their value until they are loaded, and the bytes that RAMs give
NOT_RESET = (
    "u_host_port.d_q", "u_host_port.entry?_q", "u_sequencer.mail_index_q", "u_sequencer.u_block.crc_addr_q", "u_sequencer.u_commit.type_q",
    "u_sequencer.u_commit.verdict_wrong_q", "u_station.msac_built_q", "u_station.msac_mail_q", "u_station.u_msac.error_q",
    "u_station.u_msac.*_same_q", "u_station.u_msac.staged_c2_q", "u_station.u_msac.u_buffers.from_?_q", "u_station.u_msac.u_buffers.head_q",
    "u_station.u_msac.u_buffers.initiate_bank_q", "u_station.u_msac.u_buffers.long_q", "u_station.u_msac.u_buffers.requester_q",
    "u_station.u_msac.u_buffers.s_begins_q", "u_station.u_msac.u_buffers.user_q", "u_station.u_msac.u_initiate_check.?_length_q",
    "u_station.u_telegram_rx.head_q", "*rdata_o")
NOT_RESET_RSU = ("u_serial_port.u_spi.u_shift.shift_q", "u_serial_port.u_spi.u_shift.byte_q")

PROOFS = (
    assertions("ownership", "the bound assertions of the handshake", ("l_req_is_l_sta", "one_owner"),
               cut_cells=("c:u_station", "c:u_dpram", "c:u_host_port", "c:u_interrupt"), cut_wires=("w:u_sequencer.boot_q",), faults=(49, 97),
               edit=(HANDSHAKE, "assign l_req_o = owns_i;", "assign l_req_o = owns_i && !user_holds_o;")),
    assertions("intr0", "the bound assertions of INTR0", ("intr0_not_longer", "intr0_not_shorter", "intr0_gap"),
               cut_cells=("c:u_station", "c:u_dpram", "c:u_host_port", "c:u_sequencer"), faults=(45, 46)),
    assertions("line", "the bound assertions of PBTXD and PBRTS", ("txd_idle_without_rts", "rts_leads"),
               cut_cells=("c:u_dpram", "c:u_host_port", "c:u_interrupt", "c:u_sequencer", "*station*/c:u_dp_slave", "*station*/c:u_baud_search",
                          "*station*/c:u_watchdog", "*station*/c:u_fdl", "*station*/c:u_uart_rx", "*station*/c:u_telegram_rx"),
               edit=(CHIP, ".rts_lead_i(rts_lead[5:0])", ".rts_lead_i(rts_lead[5:0] - 6'd1)")),
    assertions("states", "the bound assertions of READY, BR, PBF and D", ("ready_stays", "br_after_ready", "exchange_after_ready", "d_driven_in_reads_only",
                                                                          "d_released_in_reset"),
               cut_cells=("c:u_dpram", "c:u_interrupt", "c:u_sequencer", "*station*/c:u_uart_tx", *HALF_OF_STATION), cut_wires=SLOW_OF_STATION,
               edit=("profibus/station.sv", "assign ready_o = initialised;", "assign ready_o = initialised && !searching;")),
    assertions("reset", "the bound assertion of the levels in reset", ("outputs_in_reset",),
               cut_cells=("c:u_dpram", "c:u_host_port", "dpram_sequencer/c:u_*", "*station*/c:u_fdl", *(each for each in HALF_OF_STATION if "fdl/" not in each)),
               cut_wires=(*SLOW_OF_STATION, "w:u_sequencer.boot_q"),
               edit=("profibus/baud_search.sv", "searching_q <= 1'b1;\n      br_q <= 1'b0;\n      rate_q", "searching_q <= 1'b1;\n      br_q <= 1'b1;\n      rate_q")),
    Proof(
        name="ownership",
        title="never both sides own the DPRAM, for a user that keeps H2; any RESET",
        top="dsdpv1",
        bind={CHIP: "ownership"},
        cut_cells=("c:u_station", "c:u_dpram", "c:u_host_port", "c:u_interrupt"),
        cut_wires=("w:u_sequencer.boot_q",),
        defines=ANY_PARAMETERS,
        faults=(49, 95, 97, 98),
    ),
    Proof(
        name="uart_rx_idle",
        title="the receiver is IDLE 10.5 bit times after the release of PBRXD",
        top="uart_rx",
        bind={"profibus/uart_rx.sv": "uart_rx_idle"},
        cut_wires=("w:start", "w:syn", "w:gap"),
        engine="induction",
        depth=2,
        twin_depth=100,
        edit=("profibus/uart_rx.sv", "else if (run_i && state_q == BREAK && rxd_i) state_d = IDLE;", ""),
    ),
    Proof(
        name="nothing_decided_while_sending",
        title="no telegram is decided while PBRTS is high",
        top="station",
        bind={"profibus/station.sv": "nothing_decided_while_sending"},
        cut_cells=("c:u_dp_slave", "c:u_baud_search", "c:u_watchdog", "c:u_fdl", "c:u_uart_tx"),
        cut_wires=("w:u_uart_rx.start",),
        edit=("profibus/telegram_rx.sv", "else if (restart_i || risen_i) begin", "else if (restart_i) begin"),
    ),
    states("uart_rx", "profibus/uart_rx.sv", ("stop_bit_q <= sample_q == 4'd9;", "stop_bit_q <= sample_q == 4'd10;")),
    states("uart_tx", "profibus/uart_tx.sv",
           ("assign all_sent = state_q == SEND && bit_ends && bit_q == 4'd10",
            "assign all_sent = state_q == SEND && bit_ends && bit_q == 4'd9")),
    states("telegram_rx", "profibus/telegram_rx.sv",
           ("field_q <= sd_q == SD_SD1 ? FCS : DATA;", "field_q <= field_q + 4'd4;")),
    states("baud_search", "profibus/baud_search.sv", ("rate_q >= RATE_LAST - ", "rate_q >= RATE_LAST + 4'd1 - "),
           cut_wires=("w:window_of_rate",)),
    states("watchdog", "profibus/watchdog.sv", ("state_d = WD_OFF;", "state_d = state_q + 2'd2;"),
           cut_wires=("w:baud_control",)),
    states("answer_builder", "profibus/answer_builder.sv",
           ("value = 8'h16;\n        state_d = IDLE;", "value = 8'h16;\n        state_d = state_q + 4'd1;")),
    states("cfg_identifier", "profibus/cfg_identifier.sv",
           ("byte_i[3:0] == 4'd15 ? 4'd0 : byte_i[3:0]", "byte_i[3:0]")),
    states("dpram_sequencer", SEQUENCER, ("SEQ_COMMIT, SEQ_FLAG, SEQ_ERRORS: state_d = SEQ_CHOICE;", "SEQ_COMMIT, SEQ_FLAG: state_d = SEQ_CHOICE;\n      SEQ_ERRORS: state_d = state_q + 5'd1;"),
           more_binds={"dpram/dpram_block.sv": "dpram_block_states"}, cut_wires=("w:boot_q",)),
    states("dp_slave", "profibus/dp_slave.sv", ("&& !gc_unsync && !leave;", "&& !gc_unsync;"),
           top="station", more_binds={"profibus/station.sv": "every_request_answered"},
           cut_cells=("c:u_uart_rx", "c:u_uart_tx", "c:u_telegram_rx", "fdl/c:u_builder", "fdl/c:u_answers",
                      "*dp_slave*/c:u_buffers", "*dp_slave*/c:u_set_prm", "*dp_slave*/c:u_check_cfg",
                      "dp_service/c:u_global_control", "*dp_slave*/c:u_diagnosis"),
           cut_wires=("w:u_baud_search.window_of_rate", "w:u_watchdog.last_q"), faults=(84, 153)),
    states("msac1", "profibus/msac1.sv",
           ("state_b == ANSWERED && !`FAULT(66)) state_d = IDLE;", "state_b == ANSWERED) state_d = state_b + 2'd1;")),
    states("msac2_channel", "profibus/msac2_channel.sv",
           ("default: if (polls || requests) state_d = C2_FREE;", "default: if (polls || requests) state_d = state_b + 3'd1;"), cut_cells=("c:u_watch", "c:u_user")),
    states("msac2", "profibus/msac2.sv", ("busy[0] ? 2'b01 : busy[1] ? 2'b10 : 2'b00;", "busy;"),
           cut_cells=("c:*u_channel",)),
    serial("serial_ownership", "SPI: B014.1 is never 1 while the chip is in an access", "dsdpv1_rsu", {"dsdpv1_rsu": "serial_ownership"},
           cut_cells=("c:u_station", "c:u_dpram", "c:u_host_port", "c:u_interrupt", *(f"serial_port/c:u_{block}" for block in (
               "spi", "uart", "crc", "reply", "copy", "buffer"))),
           cut_wires=("w:u_sequencer.boot_q",), defines=ANY_PARAMETERS, faults=(139,)),
    serial("serial_moves", "SPI, UART: no commit moves a byte while the chip is in an access", "dsdpv1_rsu",
           {"dsdpv1_rsu": "serial_moves", "serial_port": "serial_moves_port"},
           cut_cells=("c:u_station", "c:u_dpram", "c:u_host_port", "c:u_interrupt", *(f"serial_port/c:u_{block}" for block in (
               "spi", "uart", "crc", "reply", "copy", "buffer"))),
           cut_wires=("w:u_sequencer.boot_q",), defines=ANY_PARAMETERS, faults=(142,)),
    serial("right_crc", "SPI, UART: a telegram whose CRC is wrong has no other reply than the error, and changes nothing", "serial_port",
           {"serial_port": "right_crc"},
           cut_cells=tuple(f"c:u_{block}" for block in ("spi", "uart", "ownership", "copy", "buffer")), faults=(133,)),
    serial("quiet_reply", "SPI: but for a reply nothing but FF is loaded for MISO", "serial_port", {"serial_port": "quiet_reply"},
           cut_cells=tuple(f"c:u_{block}" for block in ("spi", "uart", "ownership", "copy", "buffer", "crc", "commit")),
           edit=("dsdpv1_rsu/host_reply.sv", "if (ends_i) state_d = OFF;", "")),
    serial("quiet_miso", "SPI: MISO is Z but with XSS low, and what it shifts out FF unless other bytes were loaded in this frame", "spi_port",
           {"spi_port": "quiet_miso"}, faults=(132,)),
    serial("quiet_txd", "UART: TXD is high but from a telegram's judgement to its reply's end", "host_uart", {"host_uart": "quiet_txd"},
           edit=("dsdpv1_rsu/host_uart.sv", "assign fires = answers_q && !sends_q", "assign fires = !sends_q")),
    *(states(block, f"dsdpv1_rsu/{block}.sv", edit, chip="dsdpv1_rsu") for block, edit in (
        ("host_telegram", ("default: field_d = field_q + 4'd1;", "default: field_d = field_q + 4'd3;")),
        ("host_commit", ("FLAG: if (spi_i) state_d = CLEAR; else state_d = CHOICE;", "FLAG: if (spi_i) state_d = CLEAR; else state_d = CHOICE | CLEAR;")),
        ("host_reply", ("LENGTH: state_d = no_length ? CRC_HIGH : DATA;", "LENGTH: state_d = no_length ? CRC_HIGH : state + 4'd5;")),
        ("host_uart", ("assign complete = samples && sample_q == 4'd10;", "assign complete = samples && sample_q == 4'd11;")),
    )),
    # ---- illegal codes
    *(recovers(name, file, legal, event, edit) for name, file, legal, event, edit in (
        ("uart_rx", "profibus/uart_rx.sv", "state_q<=BREAK", ALWAYS, ("state_d = state_q >= BREAK ? BREAK : state_q;", "state_d = state_q;")),
        ("uart_tx", "profibus/uart_tx.sv", "state_q<=TRAIL&&(!rts_q||state_q>=LEAD)", "!(send_i&&rts_q)", (" || (rts_q && state_q < LEAD));", ");")),
        ("watchdog", "profibus/watchdog.sv", "state_q<=WD_DP_CONTROL", ALWAYS, ("state_d = dp_control_o ? WD_DP_CONTROL : state_q;", "state_d = state_q;")),
        ("answer_builder", "profibus/answer_builder.sv", "state_q<=ED", ALWAYS, ("default: state_d = IDLE;", "default: ;")),
        ("msac1", "profibus/msac1.sv", "state_q<=ANSWERED", ALWAYS, (" || state_q > ANSWERED) state_d", ") state_d")),
        ("msac2", "profibus/msac2.sv", "owner_q!=2'b11", ALWAYS, (" || owner_q == 2'b11;", ";")),
        ("dpram_sequencer", SEQUENCER, "state_q<=SEQ_ERRORS", ALWAYS, ("default: state_d = SEQ_RELEASED;", "default: ;")),
        ("host_commit", "dsdpv1_rsu/host_commit.sv", "state_q<=CLEAR", ALWAYS, ("      default: state_d = IDLE;", "      CLEAR: state_d = IDLE;")),
        ("host_uart", "dsdpv1_rsu/host_uart.sv", "state_q<=BREAK", ALWAYS, ("state_d = state_q >= BREAK ? BREAK : state_q;", "state_d = state_q;")),
        ("telegram_rx", "profibus/telegram_rx.sv", "state_q<=COMPLETE", "(due_i&&!busy_i&&!valid_i)",
         ("state_q <= NONE;  // decided, or a gap", "state_q <= state_q == COMPLETE ? NONE : state_q;")),
        ("telegram_rx_fields", "profibus/telegram_rx.sv", "(field_q<=ED&&sd_q<=SD_SC)", "(first&&!restart_i&&!risen_i)",
         ("field_q <= char_i == 8'h68 ? LE : DA;", "field_q <= char_i == 8'h68 ? LE : field_q | DA;")),
        ("baud_search", "profibus/baud_search.sv", "rate_q<=RATE_LAST", "restart_o", ("rate_d = rate_q >= RATE_LAST", "rate_d = rate_q == RATE_LAST")),
        ("msac2_channel", "profibus/msac2_channel.sv", "state_q<=C2_ABORTED", "(polls||requests||ends||watch_end||init_i)",
         ("default: if (polls || requests) state_d = C2_FREE;", "C2_ABORTED: if (polls || requests) state_d = C2_FREE;")),
        ("dpram_sequencer_item", SEQUENCER, "item_q<=ITEM_NOTHING", "chooses", ("else if (chooses) item_q <= pick;", "else if (chooses) item_q <= item_q | pick;")),
        ("host_commit_area", "dsdpv1_rsu/host_commit.sv", "area_q<=AREA_C2", "(state_q==CHOICE&&!start_i)", ("area_q <= area;", "area_q <= area_q | area;")),
        ("host_telegram", "dsdpv1_rsu/host_telegram.sv", "field_q<=CRC_LOW", "(silence_i||begins_i||ends_i)",
         ("if (begins_i || silence_i) field_d = START;", "if (begins_i) field_d = START;")),
        ("host_reply", "dsdpv1_rsu/host_reply.sv", "state_q<=CRC_LOW", "(gives_o||ends_i||judgement_i.replies)", ("default: state_d = OFF;", "CRC_LOW: state_d = OFF;")),
    )),
    # ---- telegrams and answers
    Proof("right_fcs", "a decided telegram has the right FCS and ED", "telegram_rx", {"profibus/telegram_rx.sv": "right_fcs"}, engine="induction",
          depth=1, twin_depth=12, faults=(10, 11)),
    Proof("answer_needs_telegram", "no answer without a telegram that has FCS and ED", "fdl", {"profibus/fdl.sv": "answer_needs_telegram"},
          cut_cells=("c:u_builder", "c:u_answers"), edit=("profibus/fdl.sv", "kind_q <= sd_i == SD_SD1 || sd_i == SD_SD2 ||", "kind_q <= sd_i == SD_SD1 || sd_i == SD_SD4 ||")),
    Proof("uart_rx_deadline", "the deadline of a character is six edges after it or more", "uart_rx", {"profibus/uart_rx.sv": "uart_rx_deadline"},
          edit=("profibus/uart_rx.sv", ": bit_len + half;", ": half;")),
    # ---- banks
    Proof("banks", "the bank of reception is none in use", "bus_banks", {"profibus/bus_banks.sv": "banks"},
          edit=("profibus/bus_banks.sv", "| bit_in_use | bit_transfer;", "| bit_in_use;")),
    Proof("banks_user", "a block of the user is read into a bank not in use, nor being sent", "user_banks", {"profibus/user_banks.sv": "banks_user"},
          edit=("profibus/user_banks.sv", "sends_inputs_i ? sent_i : in2_q", "in2_q")),
    Proof("banks_dpv1", "the banks of DPV1 are a permutation", "msac_buffers", {"profibus/msac_buffers.sv": "banks_dpv1"},
          cut_cells=("c:u_transfer", "c:u_user", "c:u_initiate"),
          edit=("profibus/msac_buffers.sv", "c2f_q <= spare_q;\n        spare_q <= c2f_q;", "c2f_q <= spare_q;\n        spare_q <= c30_q;")),
    Proof("sync_holds", "Sync: what the user gets stands", "bus_banks", {"profibus/bus_banks.sv": "sync_holds"}, faults=(31,)),
    Proof("freeze_holds", "Freeze: what masters get stands", "user_banks", {"profibus/user_banks.sv": "freeze_holds"}, faults=(28,)),
    Proof("hold_until", "Sync and Freeze hold until Global_Control ends them or DATA_EXCH is left", "dp_slave", {"profibus/dp_slave.sv": "hold_until"},
          cut_cells=("c:u_buffers", "c:u_set_prm", "c:u_check_cfg", "c:u_diagnosis", "c:u_parameters"),
          edit=("profibus/dp_slave.sv", "!gc_unfreeze && !leave;", "!gc_unfreeze && !gc_unsync && !leave;")),
    # ---- what ends
    Proof("dp_control_ends", "DP_CONTROL ends without a telegram of the holder", "watchdog", {"profibus/watchdog.sv": "dp_control_ends"},
          cut_wires=("w:dp_base",), engine="induction", depth=1, twin_depth=16, edit=("profibus/watchdog.sv", "if (inner_q == 8'd0) outer_d = outer_q - 8'd1;", "")),
    Proof("search_moves", "the search for the rate always moves on", "baud_search", {"profibus/baud_search.sv": "search_moves"},
          cut_wires=("w:window_of_rate",), edit=("profibus/baud_search.sv", "window_q == 32'd1;", "window_q == 32'd0;")),
    # ---- the DPRAM
    Proof("writes_as_owner", "the chip writes the DPRAM only while it owns it, and B006 first", "dsdpv1", {CHIP: "writes_as_owner"},
          cut_cells=("c:u_station", "c:u_dpram", "c:u_host_port", "c:u_interrupt"), cut_wires=("w:u_sequencer.boot_q",), defines=ANY_PARAMETERS,
          edit=(SEQUENCER, "own_q <= state_d != SEQ_IDLE && state_d", "own_q <= state_d != SEQ_IDLE && state_d != SEQ_FLAG && state_d")),
    Proof("counts_as_ruled", "B006: 01 once in each access, with its first move, and by no other move", "dpram_sequencer",
          {SEQUENCER: "counts_as_ruled", "dpram/dpram_block.sv": "counts_as_ruled_block"}, cut_wires=("w:boot_q",),
          edit=("dpram/dpram_choice.sv", "addr_o = DSDPV1_REG_OFFLINE_COUNT + 11'd1;", "addr_o = DSDPV1_REG_OFFLINE_COUNT - 11'd2;"),
          second=(SEQUENCER, "SEQ_IDLE: if (starts) state_d = SEQ_COUNT;", "SEQ_IDLE: if (starts) state_d = SEQ_USER_1;")),
    Proof("start_up_counts", "B006 in the start-up: 00 at its turn, 01 with the last move", "dpram_sequencer", {SEQUENCER: "start_up_counts"},
          edit=("dpram/dpram_move.sv", "SEQ_CLEAR: begin\n        we_o = 1'b1;", "SEQ_CLEAR: begin\n        wdata_o = 8'h01;\n        we_o = 1'b1;")),
    Proof("newest_write", "a read gives the newest write", "dpram", {"dpram/dpram.sv": "newest_write"}, cut_cells=("c:*u_ram",), engine="induction",
          depth=1, twin_depth=8, edit=("dpram/dpram.sv", "hit_settling || hit_second || hit_first;", "hit_settling || hit_first;")),
    Proof("writes_taken_once", "a legal write is taken exactly once, in order, at the third edge", "host_port",
          {"dsdpv1/host_port.sv": "writes_taken_once"}, faults=(47,),
          edit=("dsdpv1/host_port.sv", "2'd1: oldest = entry1_q;", "2'd1: oldest = entry0_q;")),
    Proof("writes_at_any_time", "... with CLK and WR as two clocks", "host_port", {"dsdpv1/host_port.sv": "writes_at_any_time"}, two_clocks=True, faults=(47,),
          edit=("dsdpv1/host_port.sv", "2'd1: oldest = entry1_q;", "2'd1: oldest = entry0_q;"),
          second=("dsdpv1/host_port.sv", "gray_q <= gray_first_q;", "gray_q <= head_gray_q;")),
    Proof("sent_whole", "an answer has no gap, and PBRTS covers it with lead and trail", "uart_tx", {"profibus/uart_tx.sv": "sent_whole"},
          engine="induction", depth=1,
          edit=("profibus/uart_tx.sv", "count_q <= {4'd0, rts_trail_i} - 10'd1;", "count_q <= {4'd0, rts_trail_i} - 10'd2;"),
          second=("profibus/uart_tx.sv", "bit_q == 4'd10 && index_q != length_i);", "bit_q == 4'd11 && index_q != length_i);")),
    Proof("never_overtakes", "the sender never overtakes the builder", "fdl", {"profibus/fdl.sv": "never_overtakes"}, cut_cells=("c:u_answers",),
          engine="induction", depth=1, edit=("profibus/answer_builder.sv", "end else if (state_q != IDLE) begin", "end else if (state_q != IDLE && state_q != FCS) begin")),
    Proof("reset_equal", "after RESET two copies from any two states are equal", "dsdpv1", engine="miter", excepted=NOT_RESET,
          edit=("profibus/watchdog.sv", "      state_q <= WD_OFF;\n      base_q <= 32'd0;", "      base_q <= 32'd0;")),
    Proof("reset_equal_rsu", "DSDPV1-RSU: the same, with SPI and UART", "dsdpv1_rsu", engine="miter", chip="dsdpv1_rsu", excepted=(*NOT_RESET, *NOT_RESET_RSU),
          edit=("dsdpv1_rsu/host_uart.sv", "      code_q <= 3'd0;\n      {phase_q", "      {phase_q")),
    Proof("answer_clock", "the answer's clock is the time since the request's end, and the lead", "uart_rx", {"profibus/uart_rx.sv": "answer_clock"},
          engine="induction", depth=1, twin_depth=48, edit=("profibus/uart_rx.sv", "ahead = lead_cycles + 3 - len / 2;", "ahead = lead_cycles + 4 - len / 2;")),
    Proof("not_before_min_tsdr", "no answer before min_TSDR, nor before 11 bit times", "uart_tx", {"profibus/uart_tx.sv": "not_before_min_tsdr"},
          engine="induction", depth=1, edit=("profibus/uart_tx.sv", "bits_q >= {1'b0, tsdr_now};", "bits_q + 9'd1 >= {1'b0, tsdr_now};")),
)
