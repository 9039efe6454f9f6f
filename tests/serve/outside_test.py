#!/usr/bin/env python3
"""A host program of the user's at the UART of an XGate-DPS10 of `dsdpv1-sim serve`, by a pseudo-terminal or TCP (docs/xgate.md).

    outside_test.py DSDPV1_SIM CASE      CASE: one of the functions below, or `list`
"""
import os
import socket
import subprocess
import sys
import time

from bench import DEADLINE, Failure, Serve, check, exit_code, talks, was_late
from port_test import Folder, ask, open_raw, read_some

SCENARIO = """name: a host outside
baud: 500k
end: 100ms
chip: {kind: xgate}
allow: [{event: FRAME_GAP}, {event: FRAME_FORM}, {event: ANSWER_AWAITED}, {event: XGATE_LOST}, {event: RESET_AWAITED}]
slaves:
  - {name: module, address: 8, init: {ident: 0x0F01, max_inputs: 2, max_outputs: 2, cfg: 11 21}}
masters:
  - {name: plc, address: 2, slaves: [{slave: module, outputs: CA FE}]}
"""
ALONE = SCENARIO.split("masters:")[0]
PATIENCE_S = 0.05  # how long a command may pause
CATCHES_UP_S = 0.1  # how far simulated time may have been behind


def frame(command, data=b"", wrong=0):
    """A command (tables 4.3 to 4.5); `wrong` damages its XOR."""
    head = bytes([0x7E, command, len(data), 0x11]) + data
    total = 0
    for byte in head:
        total ^= byte
    return head + bytes([total ^ wrong])


def error(command, kind, code):
    head = bytes([0x7E, command, 3, 0x91, kind, code, 0])
    total = 0
    for byte in head:
        total ^= byte
    return head + bytes([total])


INITIALISE = frame(0x04, bytes([8, 0x01, 0x0F, 2, 2, 2, 0]) + bytes(12) + bytes([0x11, 0x21]))


def answer_to(fd, command, pieces=None):
    """Writes it and reads the answer: its bytes."""
    spoke = time.monotonic()
    for piece in pieces or [command]:
        spoke = talks(spoke, PATIENCE_S)
        os.write(fd, piece)
    head = read_some(fd, 4)
    check(len(head) == 4 and head[0] == 0x7E, "no answer to %s: %s" % (command.hex(" "), head.hex(" ")))
    return head + read_some(fd, head[2] + 1)


def initialise(fd):
    """Command 04 until it is right: the module's firmware starts first."""
    end = time.monotonic() + DEADLINE
    os.write(fd, INITIALISE)
    while read_some(fd, 64, 0.2) != frame(0x04):
        check(time.monotonic() < end, "command 04 is never right")
        os.write(fd, INITIALISE)


def comes_to_data(fd, outputs, inputs=b"\x12\x34"):
    """Exchanges until the master's outputs come; command 21 clears the mark of new parameters."""
    initialise(fd)
    end = time.monotonic() + DEADLINE
    got = b""
    while got != frame(0x21, outputs):
        check(time.monotonic() < end, "the outputs never came: " + got.hex(" "))
        got = answer_to(fd, frame(0x20, inputs))
    check(answer_to(fd, frame(0x21, inputs)) == frame(0x21, outputs), "command 21")


def host_at(serve, kind):
    """Opens the module's host port."""
    if kind == "--user-pty":
        return os.fdopen(open_raw(os.path.join(serve.folder, "host")), "r+b", buffering=0)
    number = int(serve.said().split("is the program at TCP port 127.0.0.1:")[1].split("\n")[0])
    with socket.create_connection(("127.0.0.1", number)) as host:
        return os.fdopen(host.detach(), "r+b", buffering=0)


def served(program, body, port, scenario=SCENARIO, *options):
    with Folder() as folder:
        serve = Serve(program, folder, scenario, *port, *options)
        try:
            body(serve)
            serve.end()
            check(serve.status == 0, "serve ended with %s: %s%s" % (serve.status, serve.said(), serve.summary))
            return serve
        finally:
            serve.kill()


def both_ports(program):
    """Data exchange, a wrong XOR, a command in pieces, a pause in one, two at once, a rate; the port is closed and opened again."""
    for port in (("--user-pty", "host"), ("--user-tcp", "0")):
        def body(serve):
            with host_at(serve, port[0]) as host:
                fd = host.fileno()
                comes_to_data(fd, b"\xca\xfe")
                check(answer_to(fd, frame(0x20, b"\x55\xaa", wrong=1)) == error(0x20, 2, 4), "a wrong XOR is 2/4")
                got = answer_to(fd, frame(0x01, b"\x03"), [bytes([byte]) for byte in frame(0x01, b"\x03")])
                check(got == frame(0x01, b"\x00\x01"), "in pieces: " + got.hex(" "))
                spoke = time.monotonic()
                for byte in frame(0x01, b"\x03"):  # pauses longer than X4's 2 ms
                    spoke = talks(spoke, PATIENCE_S)
                    os.write(fd, bytes([byte]))
                    time.sleep(0.006)
                check(read_some(fd, 7) == frame(0x01, b"\x00\x01"), "pauses of 6 ms")
                os.write(fd, frame(0x01, b"\x03")[:4])
                check(read_some(fd, 8) == error(0x01, 2, 2), "broken off: X4")
                check(answer_to(fd, frame(0x01, b"\x03") * 2) == frame(0x01, b"\x00\x01"), "the first of two at once")
                check(answer_to(fd, frame(0x01, b"\x03")) == error(0x01, 2, 1), "the second was lost: X2")
                check(answer_to(fd, frame(0x03, (9600).to_bytes(3, "little"))) == frame(0x03), "a rate")
                time.sleep(0.05)  # X13: 1 ms of simulated time, which may be late
                asked = time.monotonic()
                for _ in range(20):
                    check(answer_to(fd, frame(0x20, b"\x55\xaa")) == frame(0x20, b"\xca\xfe"), "at the new rate")
                check(time.monotonic() - asked > 20 * 14 * 10 / 9600 - CATCHES_UP_S, "bytes came faster than 9600 bit/s")
            serve.wait_for_log("the host hung up")
            with host_at(serve, port[0]) as host:
                check(answer_to(host.fileno(), frame(0x20, b"\x56\x78")) == frame(0x20, b"\xca\xfe"), "opened again")
        serve = served(program, body, port)
        check(serve.result["slaves"][0]["dp_state"] == "DATA_EXCH", serve.summary)
        check([line for line in serve.log if "56 78" in line.text], "the master never had the new inputs")
        said = {line.text.split()[0].rstrip(":") for line in serve.log if line.kind == "allowed"}
        found = {"FRAME_GAP", "FRAME_FORM", "ANSWER_AWAITED", "XGATE_LOST"}
        check(found <= said <= found | {"RESET_AWAITED"}, "checks: %s" % said)


def with_a_real_master(program):
    """The master is outside, too, at the line's port: both at once."""
    def body(serve):
        fd = open_raw(serve.port)
        with host_at(serve, "--user-pty") as host:
            initialise(host.fileno())
            ask(fd)
        os.close(fd)
    served(program, body, ("--user-pty", "host"), ALONE)


def control(program):
    """Actions that are for the program are refused: it cannot be told anything. Those of chip and line are done."""
    def body(serve):
        number = int(serve.said().split("takes actions at 127.0.0.1:")[1].split("\n")[0])
        with host_at(serve, "--user-tcp") as host, socket.create_connection(("127.0.0.1", number)) as peer, peer.makefile() as answers:
            comes_to_data(host.fileno(), b"\xca\xfe")
            for word, more in {"flip_bit": "", "set_inputs": ', "bytes": "01 02"', "pause_user": ', "for": "1ms"', "reinitialise": ""}.items():
                peer.sendall(('{"do": "%s", "slave": "module"%s}\n' % (word, more)).encode())
                check(answers.readline() == "control: %s is for the program of module, which cannot be told anything\n" % word, word)
            peer.sendall(b'{"do": "reset_chip", "slave": "module"}\n')
            check(answers.readline() == "ok\n", "/Rst")
            comes_to_data(host.fileno(), b"\xca\xfe")
    cut = "allow: [{event: BUS_TELEGRAM_ERROR}, {event: BUS_CHARACTER_ERROR}, "  # /Rst comes in an answer at times
    served(program, body, ("--user-tcp", "0"), SCENARIO.replace("allow: [", cut), "--control", "0")


def bad_options(program):
    spi = SCENARIO.replace("kind: xgate", "kind: xgate, port: spi")
    two = ALONE + ALONE.split("slaves:\n")[1].replace("module", "other").replace("address: 8", "address: 9")
    with Folder() as folder:
        for scenario, options, words in ((SCENARIO, ["--user-pty", "a", "--user-tcp", "0"], "excludes"),
                                         (SCENARIO, ["--user-tcp", "70000"], "70000"),
                                         (SCENARIO, ["--user-of", "module"], "requires --user-pty or --user-tcp"),
                                         (SCENARIO, ["--user-pty", "scenario.yaml"], "expected a name that is free"),
                                         (SCENARIO, ["--user-pty", "a", "--user-of", "mod"], "--user-of is mod, expected"),
                                         (two, ["--user-pty", "a"], "--user-of is missing, expected a slave with a UART for its user CPU: module, other"),
                                         (spi, ["--user-pty", "a"], "needs a slave with a UART for its user CPU")):
            with open(os.path.join(folder, "scenario.yaml"), "w", encoding="UTF-8") as file:
                file.write(scenario)
            called = subprocess.run([program, "serve", "scenario.yaml", *options], cwd=folder, capture_output=True, text=True,
                                    check=False, timeout=DEADLINE)
            check(called.returncode == 2 and called.stderr.count("\n") == 1 and words in called.stderr and not called.stdout,
                  "%s: %d %r" % (options, called.returncode, called.stderr))


CASES = {case.__name__: case for case in (both_ports, with_a_real_master, control, bad_options)}


def main():
    program, name = sys.argv[1:]
    if name == "list":
        print("\n".join(CASES))
        return 0
    return exit_code(lambda: CASES[name](os.path.abspath(program)), was_late)


if __name__ == "__main__":
    sys.exit(main())
