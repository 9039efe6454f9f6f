#!/usr/bin/env python3
"""Causes the faults that a host can cause in `dsdpv1-sim serve`; each is a row of the table in docs/robustness.md.

    faults_test.py DSDPV1_SIM CASE      does one, and compares its row with the page; CASE: one of the functions below
    faults_test.py DSDPV1_SIM --write   does all and writes the table
"""
import os
import re
import signal
import socket
import struct
import sys
import threading
import time

from bench import DEADLINE, LATE_MS, ROOT, Serve, check, exit_code, talks, was_late
from flood import PAYLOADS, connect, floods, keep_pushing, port_options, push, rss_kb, simulated_s, tcp_number
from port_test import SCENARIO, STATUS_ANSWER, STATUS_REQUEST, Folder, ask, open_raw, read_some

sys.path.insert(0, os.path.join(ROOT, "tests", "faults"))
from page import read_table, replace_table  # noqa: E402

PAGE = os.path.join(ROOT, "docs", "robustness.md")
TABLE = "serve faults"
MOST_KB = 4096  # growth of memory
HEAD = """| a host | `serve` says | the others | exit, after SIGINT | memory |
|---|---|---|---|---|"""

CONNECTED, HUNG_UP = "PORT: HOST has connected", "PORT: the host hung up; the next one may connect"
WAITS, TURN = "PORT: HOST waits, N of 16: another host has the port", "PORT: HOST has waited and has its turn"
SILENT = "PORT: the host has sent nothing for N s while others waited: its turn is over"
REFUSED, LEFT = "PORT: HOST is refused: 16 hosts wait already", "PORT: HOST hung up while it waited"
MORE = "PORT: N more such lines are left out"
CLOSED, OPENED = "PORT: the host hung up; the next one may open it", "PORT: opened again"
SPEED = "PORT: the host has set N bit/s, the segment runs at N (--baud); a pseudo-terminal passes the bytes on all the same"
PLACES = {"PORT": r"(TCP port [\d.]+:\d+|dp \(/dev/pts/\d+\))", "HOST": r"[\d.]+:\d+", "N": r"\d+"}

CASES = {}


def fault(what, others, says, port="tcp", status=0, may=(), stop=signal.SIGINT, options=()):
    """A row of the table. `says`: the required lines; `may`: lines that can appear, too; no others."""
    def register(body):
        CASES[body.__name__] = (body, what, others, says, port, status, may, stop, options)
        return body
    return register


def pattern(template):
    text = re.escape(template)
    for place, what in PLACES.items():
        text = re.sub(r"\b%s\b" % place, lambda _, what=what: what, text)
    return re.compile("serve: " + text + "$")


def check_said(said, says, may):
    """Every line is a known one, and all required lines are present. The speed of this computer does not matter."""
    usual = re.compile("serve: the log grows as |.*this computer is too slow")
    lines = [line for line in said.splitlines() if not usual.match(line)]
    for line in lines:
        check(any(pattern(each).match(line) for each in (*says, *may)), "it also says " + line)
    for each in says:
        check(any(pattern(each).match(line) for line in lines), "it does not say " + each + ", but:\n" + said)


def do(program, name):
    """Carries out a case; returns its row."""
    body, what, others, says, port, status, may, stop, options = CASES[name]
    with Folder() as folder:
        serve = Serve(program, folder, SCENARIO, *options, port=port_options(port))
        try:
            before = rss_kb(serve.process.pid)
            body(serve)
            grown = rss_kb(serve.process.pid) - before
            serve.process.send_signal(stop)
            serve.process.wait(timeout=DEADLINE)
            serve.end()
        finally:
            serve.kill()
        check(serve.status == status, "exit %s instead of %s: %s" % (serve.status, status, serve.said()))
        check(grown < MOST_KB, "memory has grown by %d KB" % grown)
        check_said(serve.said(), says, may)
    words = "<br>".join("`%s`" % each for each in says) or "nothing"
    return "| %s | %s | %s | %d | grows by less than %d MB |" % (what, words, others, status, MOST_KB // 1024)


# --- hosts --------------------------------------------------------------------------------------------------------------


def host(serve):
    return socket.create_connection(("127.0.0.1", tcp_number(serve)), timeout=DEADLINE)


def reset(connection):
    """Ends a connection as a reset of its computer does: at once, with data still on the way."""
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    connection.close()


def until(holds, what):
    end = time.monotonic() + DEADLINE
    while not holds():
        check(time.monotonic() < end, "never: " + what)
        time.sleep(0.01)  # polls; the interval does not matter


def said(serve, template, count=1):
    def enough():
        return sum(bool(pattern(template).match(line)) for line in serve.said().splitlines()) >= count
    until(enough, template)


def flood(serve, fd, payload, seconds):
    """Checks that simulated time continues meanwhile. Returns the bytes written; the data can end anywhere."""
    begin, before, written = time.monotonic(), simulated_s(serve), 0
    while time.monotonic() < begin + seconds or simulated_s(serve) < before + 0.2:
        check(time.monotonic() < begin + DEADLINE, "simulated time stands still")
        written += push(fd, payload[written % len(payload):])
    return written


def log_so_far(serve):
    with open(serve.growing_log(), encoding="UTF-8") as file:
        return file.read()


def read_to_the_end(connection):
    """The end of the connection: "closed" or "reset"."""
    connection.setblocking(True)
    connection.settimeout(DEADLINE)
    try:
        while connection.recv(4096):
            pass
    except ConnectionResetError:
        return "reset"
    return "closed"


def answered_in_turn(serve, connection):
    """A host that waited has received nothing so far; it asks, and gets its answer and nothing else."""
    said(serve, TURN)
    fd = connection.fileno()
    check(read_some(fd, 1, 0.1) == b"", "it got what was not meant for it")
    ask(fd)


def close_and_open_again(serve, fd):
    """The next host that opens the pseudo-terminal gets no bytes of the previous one."""
    os.close(fd)
    said(serve, CLOSED)
    fd = open_raw(serve.port)
    said(serve, OPENED)
    check(read_some(fd, 1, 0.2) == b"", "it got what was not meant for it")
    ask(fd)
    os.close(fd)


# --- faults -------------------------------------------------------------------------------------------------------------


@fault("sends valid telegrams as fast as it can", "wait; the next has its turn when the flooding host hangs up, and gets answers to its own requests only",
       [CONNECTED, WAITS, HUNG_UP, TURN])
def flood_of_telegrams(serve):
    with host(serve) as flooding, host(serve) as other:
        said(serve, WAITS)
        flood(serve, flooding.fileno(), PAYLOADS["telegrams"], 2)
        reset(flooding)
        answered_in_turn(serve, other)


@fault("sends junk as fast as it can", "the same", [CONNECTED, WAITS, HUNG_UP, TURN], status=1)
def junk(serve):
    with host(serve) as flooding, host(serve) as other:
        said(serve, WAITS)
        flood(serve, flooding.fileno(), PAYLOADS["junk"], 2)
        reset(flooding)
        answered_in_turn(serve, other)


@fault("sends junk as fast as it can into the pseudo-terminal, and closes it", "the next that opens it gets answers to its own requests only",
       [CLOSED, OPENED, SPEED], port="pty", status=1)
def junk_by_pty(serve):
    fd, _ = connect(serve, "pty")
    flood(serve, fd, PAYLOADS["junk"], 2)
    close_and_open_again(serve, fd)


@fault("sends and does not read", "wait, as above. Unread bytes are kept up to 1 MB; then one line reports that, and the rest is discarded",
       [CONNECTED, WAITS, HUNG_UP, TURN])
def slow_host(serve):
    with host(serve) as slow, host(serve) as other:
        said(serve, WAITS)
        ask(slow.fileno())
        for _ in range(500):
            slow.send(STATUS_REQUEST)
        until(lambda: simulated_s(serve) > 0.5, "simulated time goes on")
        reset(slow)
        answered_in_turn(serve, other)


@fault("stops in the middle of a telegram", "see the bytes on the line 50 ms later, `BUS_TELEGRAM_ERROR` in the log", [CONNECTED, HUNG_UP], may=[WAITS, TURN], status=1)
def half_telegram(serve):
    with host(serve) as half:
        ask(half.fileno())
        half.send(STATUS_REQUEST[:3])
        serve.wait_for_log("BUS_TELEGRAM_ERROR")
        ask(half.fileno())
        half.send(STATUS_REQUEST[:3])
    with host(serve) as after:
        ask(after.fileno())


@fault("sends a telegram of 255 bytes in such small pieces that it would take 10 s", "see the bytes so far on the line after 1 s at most; simulated time, "
       "which stood still, catches up", [CONNECTED], may=[HUNG_UP], status=1)
def trickle(serve):
    with host(serve) as slow:
        ask(slow.fileno())
        slow.send(bytes([0x68, 0xF9, 0xF9, 0x68]))
        sent = 4
        while "BUS_TELEGRAM_ERROR" not in log_so_far(serve):
            check(sent < 250, "it was waited for")
            slow.send(b"\x00")
            sent += 1
            read_some(slow.fileno(), 1, 0.04)


@fault("connects and hangs up 1000 times", "are served afterwards. 40 lines a second are printed, the others counted", [CONNECTED, MORE],
       may=[HUNG_UP, WAITS, TURN, LEFT, REFUSED])
def reconnect_storm(serve):
    begin = time.monotonic()
    for _ in range(1000):
        with host(serve) as one:
            one.send(STATUS_REQUEST)
    with host(serve) as after:
        ask(after.fileno())
        said(serve, MORE)
        lines = len(serve.said().splitlines())
        check(lines < 43 * (time.monotonic() - begin + 2), "%d lines" % lines)


@fault("twenty at once", "1 has the port, 16 wait and are served in the order in which they came, 3 are refused: their connections are reset",
       [CONNECTED, WAITS, REFUSED, HUNG_UP, TURN], may=[MORE])
def twenty_hosts(serve):
    hosts = [host(serve) for _ in range(17)]
    for _ in range(3):
        try:
            with host(serve) as refused:
                check(refused.recv(1) == b"", "it got something")
        except ConnectionResetError:  # also during the connection
            pass
    for each in hosts:
        ask(each.fileno())
        each.close()


@fault("says nothing any more, and does not hang up", "wait; after 10 s (`--turn`; 1 s here) the next has its turn, the silent one's connection is reset",
       [CONNECTED, WAITS, SILENT, TURN], may=[HUNG_UP], options=("--turn", "1"))
def silent_host(serve):
    with host(serve) as silent:
        ask(silent.fileno())
        time.sleep(1.5)
        ask(silent.fileno())  # it keeps the port while no other host waits
        spoke = time.monotonic()
        with host(serve) as other:
            said(serve, WAITS)
            for _ in range(5):  # also while it talks
                time.sleep(0.4)
                ask(silent.fileno())
                spoke = talks(spoke, 1)
            check("its turn is over" not in serve.said(), "it has lost the port, though it was not silent")
            answered_in_turn(serve, other)
            check(read_to_the_end(silent) == "reset", "the silent one was not told")


@fault("is killed in the middle of its telegrams (RST)", "wait; its bytes already accepted (2040 at most) are still sent on the line, their answers are discarded",
       [CONNECTED, WAITS, HUNG_UP, TURN])
def killed_host(serve):
    with host(serve) as killed, host(serve) as other:
        ask(killed.fileno())
        said(serve, WAITS)
        killed.send(STATUS_REQUEST * 100)
        check(read_some(killed.fileno(), 6) == STATUS_ANSWER, "not answered")
        reset(killed)
        answered_in_turn(serve, other)


@fault("sends into the pseudo-terminal, does not read the answers and closes it", "the next that opens it gets answers to its own requests only",
       [CLOSED, OPENED, SPEED], port="pty")
def pty_reader_gone(serve):
    fd = open_raw(serve.port)
    ask(fd)
    os.write(fd, STATUS_REQUEST * 50)
    until(lambda: simulated_s(serve) > 0.3, "simulated time goes on")
    close_and_open_again(serve, fd)


def signal_during_flood(serve):
    """The host continues sending until serve has ended."""
    flooding = host(serve)
    flood(serve, flooding.fileno(), PAYLOADS["telegrams"], 0.5)
    threading.Thread(target=keep_pushing, args=(flooding.fileno(), PAYLOADS["telegrams"], serve), daemon=True).start()
    serve.keep = flooding


@fault("sends valid telegrams as fast as it can, and SIGINT comes", "-", [CONNECTED])
def sigint_during_flood(serve):
    signal_during_flood(serve)


@fault("sends valid telegrams as fast as it can, and SIGTERM comes", "-", [CONNECTED], stop=signal.SIGTERM)
def sigterm_during_flood(serve):
    signal_during_flood(serve)


def ten_seconds(program):
    """Junk and telegrams on both kinds of port: a short version of the page's long run. Returns the exit code; tries again when a serve was late,
    because a
    processor of the machine may be taken away for seconds."""
    late_ms = 0.0

    def case():
        nonlocal late_ms
        _, wrong, late_ms = floods(program, [(kind, port) for kind in ("junk", "telegrams") for port in ("pty", "tcp")], 10)
        check(not wrong, "; ".join(wrong))
    return exit_code(case, lambda: late_ms > LATE_MS)


def in_page(program, name):
    check(do(program, name) in read_table(PAGE, TABLE).splitlines(), "docs/robustness.md is stale: faults_test.py DSDPV1_SIM --write")


def main(program, name):
    if name == "--write":
        replace_table(PAGE, TABLE, "\n".join([HEAD] + [do(program, case) for case in CASES]))
        return 0
    if name == "ten_seconds":
        return ten_seconds(program)
    return exit_code(lambda: in_page(program, name), was_late)


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2]))
