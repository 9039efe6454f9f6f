#!/usr/bin/env python3
"""Floods `dsdpv1-sim serve` for minutes and watches its memory and its time.

    flood.py DSDPV1_SIM [--port tcp|pty] [--kind junk|telegrams] [--minutes 10] [--write]

Without --port it floods both ports at the same time, without --kind one kind after the other. --write puts the table into docs/robustness.md.
"""
import argparse
import contextlib
import os
import select
import signal
import socket
import sys
import tempfile
import threading
import time

from bench import DEADLINE, ROOT, Serve, check
from port_test import SCENARIO, STATUS_REQUEST, open_raw

sys.path.insert(0, os.path.join(ROOT, "tests", "faults"))
from page import replace_table  # noqa: E402

PAYLOADS = {"junk": bytes([0x00, 0xFF, 0x55, 0x16, 0xAA] * 819), "telegrams": STATUS_REQUEST * 680}
EVERY_S = 1.0
MOST_GROWTH_KB = 4096  # from the first minute (or tenth of a short run) on: the list of the first 10 000 events needs 2 to 3 MB until it is full


def rss_kb(pid):
    with open("/proc/%d/status" % pid, encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS:"))


def peak_kb(pid):
    with open("/proc/%d/status" % pid, encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmHWM:"))


def simulated_s(serve):
    """Simulated time of the last whole line of the log that is being written; 0 when there is none."""
    with open(serve.growing_log(), "rb") as file:
        file.seek(max(0, os.fstat(file.fileno()).st_size - 65536))
        lines = file.read().split(b"\n")[:-1]
    return float(lines[-1].split()[0]) / 1e9 if lines else 0.0


def tcp_number(serve):
    return int(serve.ready.split("127.0.0.1:")[1].split(";")[0])


def connect(serve, port):
    """A descriptor that writes to serve, and the object that must live as long."""
    if port == "pty":
        fd = open_raw(serve.port)
        os.set_blocking(fd, False)
        return fd, None
    host = socket.create_connection(("127.0.0.1", tcp_number(serve)))
    host.setblocking(False)
    return host.fileno(), host


def port_options(port):
    return ("--pty", "dp") if port == "pty" else ("--tcp", "0")


def push(fd, payload, patience=0.05):
    """Writes as much as the other side accepts, waits a little for it to accept more, and reads its output. Returns the bytes written."""
    readable, writable, _ = select.select([fd], [fd], [], patience)
    if readable:
        os.read(fd, 65536)
    if not writable:
        return 0
    try:
        return os.write(fd, payload)
    except BlockingIOError:
        return 0


def keep_pushing(fd, payload, serve):
    """Writes until serve has ended; for DEADLINE at most."""
    end = time.monotonic() + DEADLINE
    with contextlib.suppress(OSError):  # serve has closed it
        while serve.process.poll() is None and time.monotonic() < end:
            push(fd, payload)


class Flood:
    """One flood of one serve, for `seconds`; the figures are attributes."""

    def __init__(self, program, port, kind, seconds):
        self.port, self.kind, self.seconds = port, kind, seconds
        self.offered, self.samples = 0, []  # bytes; (wall s, rss KB, simulated s)
        with tempfile.TemporaryDirectory(prefix="dsdpv1_flood_") as folder:
            self.serve = Serve(program, folder, SCENARIO, port=port_options(port))
            try:
                self.run()
                self.end()
            finally:
                self.serve.kill()

    def run(self):
        self.fd, self.keep = connect(self.serve, self.port)
        begin = time.monotonic()
        self.begin, next_sample = begin, begin
        payload, at = PAYLOADS[self.kind], 0
        while (now := time.monotonic()) < begin + self.seconds:
            written = push(self.fd, payload[at:])  # continues where it stopped, so that telegrams stay whole
            self.offered += written
            at = (at + written) % len(payload)
            if now >= next_sample:
                self.samples.append((now - begin, rss_kb(self.serve.process.pid), simulated_s(self.serve)))
                next_sample = now + min(EVERY_S, self.seconds / 20)
        check(self.serve.process.poll() is None, "serve has ended: " + self.serve.said())

    def end(self):
        self.peak = peak_kb(self.serve.process.pid)
        asked = time.monotonic()
        self.serve.process.send_signal(signal.SIGINT)
        keep_pushing(self.fd, PAYLOADS[self.kind], self.serve)
        self.serve.process.wait(timeout=DEADLINE)
        self.serve.end(read_log=False)
        self.end_s = time.monotonic() - asked
        self.wall_s = time.monotonic() - self.begin
        pacing = self.serve.result["pacing"]
        self.taken = pacing["bytes_from_host"]
        self.simulated_s = self.serve.result["simulated_ns"] / 1e9
        self.lost_s = pacing["time_lost_ns"] / 1e9
        self.worst_ms = pacing["error_max_us"] / 1000

    def settled(self):
        """The first sample after a minute; after a tenth in shorter runs."""
        return next(sample for sample in self.samples if sample[0] >= min(60, self.seconds / 10))

    def judge(self):
        """Memory is flat, simulated time never stops, and the line is full; serve obeyed SIGINT during the flood, otherwise there would be no
        result."""
        growth = self.samples[-1][1] - self.settled()[1]
        what = "%s by %s: " % (self.kind, self.port)
        check(growth < MOST_GROWTH_KB, what + "memory has grown by %d KB" % growth)
        for (_, _, before), (_, _, after) in zip(self.samples[1::5], self.samples[6::5]):
            check(after > before, what + "simulated time stands still at %.1f s" % before)
        check(self.simulated_s + self.lost_s > self.wall_s - 2 - self.end_s, what + "simulated %.1f s of %.1f s" % (self.simulated_s, self.wall_s))

    def row(self):
        return "| %s by %s | %.0f s | %s | %s | %.1f MB | %.1f MB | %.1f MB | %.2f s | %.1f ms | %.1f s |" % (
            self.kind, self.port, self.seconds, thousands(self.offered), thousands(self.taken), self.settled()[1] / 1024,
            self.samples[-1][1] / 1024, self.peak / 1024, self.lost_s, self.worst_ms, self.end_s)


def thousands(number):
    return "{:,}".format(number).replace(",", " ")


HEAD = """| flood | for | bytes offered | of them sent on the line | memory after 1 minute | at the end | at most | simulated time given up | lag at most | SIGINT until the end |
|---|---|---|---|---|---|---|---|---|---|"""


def floods(program, pairs, seconds):
    """Runs each pair of kind and port, all at the same time. Returns the rows, the failures, and the greatest lateness of a serve in ms."""
    rows, wrong, late_ms = {}, [], [0.0]

    def one(kind, port):
        try:
            flood = Flood(program, port, kind, seconds)
            late_ms.append(flood.serve.late_ms())
            rows[kind, port] = flood.row()
            flood.judge()
        except Exception as error:  # passed to the thread that waits
            wrong.append(str(error))
    threads = [threading.Thread(target=one, args=pair) for pair in pairs]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return [rows[pair] for pair in sorted(rows)], wrong, max(late_ms)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--port", choices=["tcp", "pty"])
    arguments.add_argument("--kind", choices=sorted(PAYLOADS))
    arguments.add_argument("--minutes", type=float, default=10)
    arguments.add_argument("--write", action="store_true", help="into docs/robustness.md")
    arguments = arguments.parse_args()
    kinds = [arguments.kind] if arguments.kind else sorted(PAYLOADS)
    ports = [arguments.port] if arguments.port else ["pty", "tcp"]
    table, wrong = [HEAD], []
    for kind in kinds:
        rows, failures, _ = floods(os.path.abspath(arguments.program), [(kind, port) for port in ports], arguments.minutes * 60)
        table += rows
        wrong += failures
    table = "\n".join(table)
    print("\n".join([table, *wrong]))
    if arguments.write and not wrong:
        replace_table(os.path.join(ROOT, "docs", "robustness.md"), "serve floods", table)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
