#!/usr/bin/env python3
"""The ports of `dsdpv1-sim serve`, without any master: bytes in, bytes out, comings and goings.

    port_test.py DSDPV1_SIM CASE      CASE: one of the functions below, or `list`
"""
import os
import pty
import signal
import socket
import subprocess
import sys
import tempfile
import time
import tty

from bench import DEADLINE, ROOT, Failure, Serve, check, exit_code, talks, was_late

SCENARIO = """name: ports
baud: 500k
end: 100ms
chip: {access_interval: 480}
slaves:
  - {name: echo, address: 8, gsd: "%s", modules: ["2 bytes in, 2 bytes out"]}
""" % os.path.join(ROOT, "scenarios", "dsdpv1.gsd")
STATUS_REQUEST = bytes.fromhex("100802495316")
PATIENCE_S = 0.05  # how long serve waits for the rest of a telegram
STATUS_ANSWER = bytes.fromhex("10020800 0A16")


class Folder(tempfile.TemporaryDirectory):
    def __init__(self):
        super().__init__(prefix="dsdpv1_port_")


def read_some(fd, count, patience=DEADLINE):
    """Reads up to `count` bytes; fewer if `patience` seconds have passed."""
    os.set_blocking(fd, False)
    got, end = b"", time.monotonic() + patience
    while len(got) < count and time.monotonic() < end:
        try:
            got += os.read(fd, count - len(got))
        except (BlockingIOError, InterruptedError):
            time.sleep(0.001)
    return got


def ask(fd, pieces=(STATUS_REQUEST,), answer=STATUS_ANSWER):
    """Repeats a request until the answer comes: the slave has to find the baud rate first."""
    end = time.monotonic() + DEADLINE
    while time.monotonic() < end:
        for piece in pieces:
            os.write(fd, piece)
        if read_some(fd, len(answer), 0.02) == answer:
            read_some(fd, 4096, 0.2)  # late answers to earlier requests
            return
    raise Failure("never answered")


def open_raw(path):
    fd = os.open(path, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(fd)
    return fd


def open_host(serve, kind):
    if kind == "--pty":
        return os.fdopen(open_raw(serve.port), "r+b", buffering=0)
    number = int(serve.ready.split("127.0.0.1:")[1].split(";")[0])
    with socket.create_connection(("127.0.0.1", number)) as host:
        return os.fdopen(host.detach(), "r+b", buffering=0)


def with_serve(program, body, *options, port=("--pty", "dp")):
    with Folder() as folder:
        serve = Serve(program, folder, SCENARIO, *options, port=port)
        try:
            body(serve)
            serve.end()
            check(serve.status == 0, "serve ended with %s: %s" % (serve.status, serve.said()))
            return serve
        finally:
            serve.kill()


def pty_hang_up_and_next_opener(program):
    def body(serve):
        for time_round in range(1, 4):
            fd = open_raw(serve.port)
            ask(fd)
            os.close(fd)
            serve.wait_for_log("(?s)(hung up.*?){%d}" % time_round)
    serve = with_serve(program, body)
    check(serve.said().count("hung up") == 3, "not one line for each hang-up: " + serve.said())


def one_shot_hosts(program):
    """A telegram of a host that hangs up at once is sent, and the next host does not get its answer."""
    for port in (("--pty", "dp"), ("--tcp", "0")):
        def body(serve):
            for time_round in range(1, 3):
                with open_host(serve, port[0]) as host:
                    host.write(STATUS_REQUEST)
                serve.wait_for_log("(?s)(10 08 02 49 53 16.*?){%d}" % time_round)
            with open_host(serve, port[0]) as host:
                check(read_some(host.fileno(), 1, 0.1) == b"", "it got what was not meant for it")
                ask(host.fileno())
        with_serve(program, body, port=port)


def telegram_in_pieces(program):
    """Bytes that arrive one by one form a telegram without gaps on the segment."""
    def body(serve):
        fd = open_raw(serve.port)
        ask(fd)
        ask(fd, [bytes([byte]) for byte in STATUS_REQUEST])
        spoke = time.monotonic()
        for byte in STATUS_REQUEST:
            spoke = talks(spoke, PATIENCE_S)
            os.write(fd, bytes([byte]))
            time.sleep(0.005)
        check(read_some(fd, 6) == STATUS_ANSWER, "a slow telegram was not answered")
        os.close(fd)
    serve = with_serve(program, body)
    codes = {line.code for line in serve.log}
    check(not codes & {"GAP", "BUS_GAP", "T_SYN", "BUS_T_SYN_VIOLATED"}, "gaps on the segment: %s" % codes)


def requests_in_one_write(program):
    """The second request waits for the first one's answer and for T_SYN, and was too early. Sent after the answers they are not."""
    for options, kind, status in ((), "check", 0), (("--strict",), "violation", 1):
        with Folder() as folder:
            serve = Serve(program, folder, SCENARIO, *options)
            try:
                with open_host(serve, "--pty") as host:
                    fd = host.fileno()
                    ask(fd)
                    ask(fd)
                    for _ in range(100):  # serve is certain only if it has looked at the port just before
                        os.write(fd, STATUS_REQUEST * 5)
                        check(read_some(fd, 30) == STATUS_ANSWER * 5, "not all five were answered")
                        with open(serve.growing_log(), encoding="UTF-8") as log:
                            if "HOST_EARLY" in log.read():
                                break
                serve.end()
            finally:
                serve.kill()
            check(serve.result["pacing"]["held_back"] >= 4, "nothing was held back")
            early = [line for line in serve.log if line.text.startswith("HOST_EARLY")]
            check(early and all(line.kind == kind and "10 08 02 49 53 16" in line.text for line in early), "early: %s" % early)
            check(not [line for line in serve.log if line.kind == "violation" and line not in early], "violations")
            check(serve.status == status, "%s ended with %s" % (options, serve.status))
            violations = ("FAILED: %d violation" if options else "PASSED, %d violation") % len(early)
            check(violations in serve.summary and "HOST_EARLY" in serve.summary, serve.summary)


def broken_off_telegram(program):
    """Half a telegram delays the next one only briefly, and the log reports its bytes."""
    def body(serve):
        fd = open_raw(serve.port)
        ask(fd)
        os.write(fd, STATUS_REQUEST[:3])
        serve.wait_for_log("BUS_TELEGRAM_ERROR")
        ask(fd)
        os.write(fd, b"\x00\xff")
        ask(fd)
        os.close(fd)
    with Folder() as folder:
        serve = Serve(program, folder, SCENARIO)
        try:
            body(serve)
            serve.end()
            check(serve.status == 1, "a broken telegram is a violation on the bus")
        finally:
            serve.kill()


def telegram(fc, data, da=8, sa=2):
    """Request with the SAPs that `data` begins with."""
    body = bytes([da | 0x80, sa | 0x80, fc]) + data
    return bytes([0x68, len(body), len(body), 0x68]) + body + bytes([sum(body) & 0xFF, 0x16])


def configuration_fault(program):
    """A host that parameterises the slave and sends another configuration has failed, although nothing was violated."""
    def body(serve):
        with open_host(serve, "--pty") as host:
            ask(host.fileno())
            for fc, data in (0x6D, bytes.fromhex("3D3E8000000B0CC900000000")), (0x5D, b"\x3e\x3e" + b"\x7f" * 16):  # 512 bytes each way
                os.write(host.fileno(), telegram(fc, data))
                check(read_some(host.fileno(), 1) == b"\xe5", "not acknowledged")
    with Folder() as folder:
        serve = Serve(program, folder, SCENARIO)
        try:
            body(serve)
            serve.end()
            check(serve.status == 1 and "comes to data exchange with the host" in serve.summary and "CFG_" in serve.summary, serve.summary)
        finally:
            serve.kill()


def station_behind_the_port(program):
    """Master and slave are both at the port, the scenario has none: the slave's time is not that of its answer."""
    with Folder() as folder:
        serve = Serve(program, folder, SCENARIO.split("slaves:")[0] + "slaves: []\n")
        try:
            with open_host(serve, "--pty") as host:
                os.write(host.fileno(), (STATUS_REQUEST + STATUS_ANSWER) * 3)
                serve.wait_for_log("(?s)(10 02 08 00 0A 16.*?){3}")
            serve.end()
            check(serve.status == 0 and not [line for line in serve.log if "TSDR" in line.text], [line.text for line in serve.log])
        finally:
            serve.kill()
        called = subprocess.run([program, "run", "scenario.yaml"], cwd=folder, capture_output=True, text=True, check=False)
        check(called.returncode == 2 and "slaves has 0 items, expected 1 to 125" in called.stderr, called.stderr)


def control(program):
    """Actions while serve runs: each line is answered, and the host sees what was done."""
    def body(serve):
        number = int(serve.said().split("takes actions at 127.0.0.1:")[1].split("\n")[0])
        with open_host(serve, "--pty") as host, socket.create_connection(("127.0.0.1", number)) as peer, peer.makefile() as answers:
            def does(line, answer="ok"):
                peer.sendall(line.encode() + b"\n")
                got = answers.readline().rstrip("\n")
                check(got == answer, "%s: %s" % (line, got))
            fd = host.fileno()
            ask(fd)
            does('{"do": "answer_fault", "slave": "echo", "fault": "silent", "times": 2}')
            for answer in b"", b"", STATUS_ANSWER:
                os.write(fd, STATUS_REQUEST)
                check(read_some(fd, 6, 0.05 if not answer else DEADLINE) == answer, "not %r" % answer)
            does('{"do": "answer_fault", "slave": "echo", "fault": "fcs"}')
            os.write(fd, STATUS_REQUEST)
            check(read_some(fd, 6) == STATUS_ANSWER[:4] + b"\x0b\x16", "no wrong FCS")
            does('{"do": "unplug", "slave": "echo"}')
            os.write(fd, STATUS_REQUEST)
            check(read_some(fd, 6, 0.05) == b"", "it has not left the bus")
            does('{"do": "plug", "slave": "echo"}')
            ask(fd)
            does('{"do": "set_inputs", "slave": "echo", "bytes": "01 02"}')
            does('{"do": "glitch", "for": "1us"}')
            does('{"do": "reset_chip", "slave": "echo"}')
            ask(fd)
            does('{"do": "answer_fault", "slave": "ech", "fault": "cut"}',
                 "control:1: slave ech does not exist (did you mean echo?), expected echo")
            does('{"do": "answer_fault", "slave": "echo", "fault": "late"}', "control:1: for is the delay of fault: late, expected both or neither")
            does('{"do": "plug", "slave": "echo", "at": "1ms"}', "control: at or when, expected neither: it is done at once")
            does("do: plug", 'control: is not JSON, expected an action: {"do": ...}')
            does("x" * 65537, "a line of more than 65536 bytes, expected at most so many")
            check(answers.readline() == "", "still connected")
    with Folder() as folder:
        serve = Serve(program, folder, SCENARIO + "allow: [{event: BUS_TELEGRAM_ERROR}, {event: BUS_GLITCH}]\n", "--control", "0")
        try:
            body(serve)
            serve.end()
            check(serve.status == 0, serve.summary)
        finally:
            serve.kill()


def live_capture(program):
    """A telegram can be read from the FIFO within 50 ms of its end, although no other one follows."""
    with Folder() as folder:
        fifo = os.path.join(folder, "fifo")
        os.mkfifo(fifo)
        capture = os.open(fifo, os.O_RDONLY | os.O_NONBLOCK)  # so that serve need not wait for a reader
        serve = Serve(program, folder, SCENARIO, "--capture", "fifo")
        try:
            check(read_some(capture, 4) == b"\x0a\x0d\x0d\x0a", "no header of a pcapng file")
            with open_host(serve, "--pty") as host:
                ask(host.fileno())
                for _ in range(5):
                    read_some(capture, 65536, 0.1)
                    os.write(host.fileno(), STATUS_REQUEST)
                    check(read_some(host.fileno(), 6) == STATUS_ANSWER, "not answered")
                    answered = time.monotonic()
                    got = read_some(capture, 65536, 0.05)
                    talks(answered, 0.06)  # a reader that was kept from running
                    check(STATUS_REQUEST in got and STATUS_ANSWER in got, "not in the FIFO: %r" % got)
        finally:
            serve.kill()
            os.close(capture)


def wrong_speed_is_said(program):
    def body(serve):
        fd = open_raw(serve.port)  # a fresh pseudo-terminal stands at 38400
        ask(fd)
        os.close(fd)
    serve = with_serve(program, body)
    check(serve.said().count("the segment runs at 500000") == 1, "no warning: " + serve.said())


def tcp_one_after_the_other(program):
    def body(serve):
        number = int(serve.ready.split("127.0.0.1:")[1].split(";")[0])
        for _ in range(2):
            with socket.create_connection(("127.0.0.1", number)) as host:
                ask(host.fileno())
        taken = subprocess.run([program, "serve", "scenario.yaml", "--tcp", str(number)], cwd=serve.folder, capture_output=True,
                               text=True, check=False)
        check(taken.returncode == 2 and taken.stderr.count("\n") == 1 and "cannot be had" in taken.stderr, "taken port: " + taken.stderr)
    serve = with_serve(program, body, port=("--tcp", "0"))
    check(serve.said().count("has connected") == 2, serve.said())


def serial_port(program):
    """A pseudo-terminal in place of a serial port: whole answers, exclusive use, a line when it disappears."""
    wire, device = pty.openpty()
    tty.setraw(device)
    name = os.ttyname(device)

    def body(serve):
        nonlocal device
        second = subprocess.run([program, "serve", "scenario.yaml", "--serial", name], cwd=serve.folder, capture_output=True, text=True,
                                check=False)
        check(second.returncode == 2 and second.stderr.count("\n") == 1, "device in use: " + second.stderr)
        ask(wire)
        ask(wire, [bytes([byte]) for byte in STATUS_REQUEST])
        os.close(device)
        os.close(wire)
        serve.wait_for_log("is gone")
    with_serve(program, body, port=("--serial", name))


def bad_ports(program):
    """One line and exit code 2 for each port that cannot be opened."""
    with Folder() as folder:
        with open(os.path.join(folder, "scenario.yaml"), "w", encoding="UTF-8") as file:
            file.write(SCENARIO)
        with open(os.path.join(folder, "there"), "w", encoding="UTF-8") as file:
            file.write("a file that must stay")
        for options in (["--serial", "/dev/nothing"], ["--serial", "/dev/null"], ["--pty", "there"], ["--tcp", "70000"],
                        ["--tcp", "1", "--bind", "nowhere"], ["--baud", "9600"], ["--for", "5"], ["--rts"],
                        ["--tcp", "1", "--pty", "x"], ["--log", "no/folder/log"]):
            called = subprocess.run([program, "serve", "scenario.yaml", *options], cwd=folder, capture_output=True, text=True,
                                    check=False, timeout=DEADLINE)
            check(called.returncode == 2 and called.stderr.count("\n") == 1 and not called.stdout,
                  "%s: %d %r" % (options, called.returncode, called.stderr))
        check(sorted(os.listdir(folder)) == ["scenario.yaml", "there"], "left behind: %s" % os.listdir(folder))


def link_of_a_killed_run(program):
    """The next pseudo-terminal often has the number of the one that was killed; another program may be faster, so there are several trials."""
    with Folder() as folder:
        for trial in range(10):
            ends = os.openpty()
            os.symlink(os.ttyname(ends[1]), os.path.join(folder, "dp"))
            for end in ends:
                os.close(end)
            try:
                serve = Serve(program, folder, SCENARIO, "--for", "300ms")
            except Failure as failure:
                check(trial < 9 and "delete it if a run that was killed has left it" in str(failure), str(failure))
                os.remove(os.path.join(folder, "dp"))
                continue
            serve.process.wait(timeout=DEADLINE)
            serve.end()
            return


def ends_after_its_time(program):
    with Folder() as folder:
        serve = Serve(program, folder, SCENARIO, "--for", "300ms", "--wave", "serve.vcd")
        try:
            serve.process.wait(timeout=DEADLINE)
            serve.end()
            check(serve.status == 3 and serve.result["simulated_ns"] == 300e6, "ended at %s" % serve.result["simulated_ns"])
            check(serve.result["pacing"]["error_mean_us"] >= 0 and os.path.getsize(os.path.join(folder, "serve.vcd")) > 1000, "files")
        finally:
            serve.kill()


def shipped_scenario(program):
    with Folder() as folder:
        called = subprocess.run([program, "serve", os.path.join(ROOT, "scenarios", "serve_19k2.yaml"), "--for", "300ms"], cwd=folder,
                                capture_output=True, text=True, check=False, timeout=DEADLINE)
        check(called.returncode == 0 and "PASSED" in called.stdout and "pacing" in called.stdout, called.stdout + called.stderr)


def too_slow_is_said(program):
    """A computer that stalls for 0.3 s is too slow, because serve catches up 0.1 s at most: serve reports it and continues."""
    def body(serve):
        fd = open_raw(serve.port)
        ask(fd)
        serve.process.send_signal(signal.SIGSTOP)
        time.sleep(0.3)  # duration of the stall
        serve.process.send_signal(signal.SIGCONT)
        serve.wait_for_log("too slow")
        ask(fd)
        os.close(fd)
    serve = with_serve(program, body)
    check("of real time" in serve.said() and serve.result["pacing"]["times_too_slow"] >= 1, serve.said())


CASES = [pty_hang_up_and_next_opener, one_shot_hosts, telegram_in_pieces, requests_in_one_write, broken_off_telegram, configuration_fault,
         station_behind_the_port, control, live_capture, wrong_speed_is_said,
         tcp_one_after_the_other, serial_port, bad_ports, link_of_a_killed_run, ends_after_its_time, shipped_scenario, too_slow_is_said]


def main(program, name):
    cases = {case.__name__: case for case in CASES}
    if name == "list":
        print("\n".join(cases))
        return 0
    return exit_code(lambda: cases[name](program), was_late)


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2]))
