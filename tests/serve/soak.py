#!/usr/bin/env python3
"""Hours of `dsdpv1-sim serve` at 1.5 Mbit/s with hosts that come, babble, read slowly and go: the slave must be there for the next one, and memory flat.

A round is one host that misbehaves while a decent one waits; then the decent one must get its turn, bring the slave up and exchange data, of which every byte is checked. Real time: `serve` is never faster. Nothing is resumed; what was reached is printed every minute, also when it is interrupted.
"""
import argparse
import os
import random
import signal
import socket
import sys
import tempfile
import time

from bench import ROOT, Failure, Serve, check
from dp_host import DpHost, Silent
from faults_test import reset
from flood import PAYLOADS, peak_kb, push, rss_kb, tcp_number
from port_test import STATUS_REQUEST

sys.path.insert(0, os.path.join(ROOT, "docs", "trust"))
import records  # noqa: E402

EXAMPLES = """examples:
  tests/serve/soak.py build/default/apps/dsdpv1-sim                      # eight hours
  tests/serve/soak.py build/default/apps/dsdpv1-sim --hours 0.05 --seed 7
  tests/serve/soak.py build/default/apps/dsdpv1-sim --hours 1.5 --record # the row of docs/trust.md

The table is tab-separated: minutes, rounds, exchanges, memory in KB, greatest wait for a turn in s. Exit codes: 0 all held, 1 something did not,
2 wrong input, 130 interrupted (SIGINT, SIGTERM, SIGHUP), which ends `serve`, too.
"""
SCENARIO = """name: soak
baud: 1.5M
end: 100ms
chip: {access_interval: 480}
slaves:
  - name: echo
    address: 8
    gsd: "%s"
    modules: ["2 bytes in, 2 bytes out"]
    user_cpu: {behaviour: loop_back, cycle: 200us}
""" % os.path.join(ROOT, "scenarios", "dsdpv1.gsd")
EXCHANGES = 200       # of the decent host in each round
MOST_GROWTH_KB = 4096  # as flood.py; from the sixth part of an hour (or the tenth of a shorter run) on
TURN_S = 60           # after a host that hangs up has sent what TCP holds of it: up to 1 MB (docs/pyprofibus.md), which takes 8 s at 1.5 Mbit/s
UP_S = 30
SAMPLE_S = 60
HELD, FAILED, INTERRUPTED = "held", "failed", "interrupted"
EXIT_CODES = {HELD: 0, FAILED: 1, INTERRUPTED: 130}


# ------------------------------------------------------------------------------------------------- hosts that misbehave
class Hosts:
    """Each method misbehaves for about a second or a few; `join` is called when the decent host begins to wait: once another host has the port."""

    def __init__(self, port, chance, join):
        self.port, self.chance, self.join = port, chance, join

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=30)

    def write(self, connection, payload, seconds):
        connection.setblocking(False)
        at, end = 0, time.monotonic() + seconds
        while time.monotonic() < end:
            at = (at + push(connection.fileno(), payload[at:])) % len(payload)

    def leave(self, connection):
        """As a program that ends, or as one that is killed."""
        if self.chance.random() < 0.5:
            reset(connection)
        else:
            connection.close()

    def babbles(self):
        """Random bytes."""
        host = self.connect()
        self.join()
        self.write(host, self.chance.randbytes(8192), self.chance.uniform(0.5, 5))
        self.leave(host)

    def floods(self):
        """Requests one after the other; it reads their answers."""
        host = self.connect()
        self.join()
        self.write(host, PAYLOADS["telegrams"], self.chance.uniform(0.5, 5))
        self.leave(host)

    def reads_nothing(self):
        """As many requests as fit; it never reads an answer."""
        host = self.connect()
        self.join()
        host.setblocking(False)
        end = time.monotonic() + self.chance.uniform(0.5, 5)
        while time.monotonic() < end:
            try:
                host.send(STATUS_REQUEST * 50)
            except BlockingIOError:
                time.sleep(0.01)
        self.leave(host)

    def trickles(self):
        """A telegram byte by byte, with pauses close to the time limit for an incomplete telegram."""
        host = self.connect()
        self.join()
        for byte in bytes([0x68, 0xF9, 0xF9, 0x68]) + bytes(self.chance.randrange(40)):
            host.send(bytes([byte]))
            time.sleep(self.chance.uniform(0.0, 0.08))
        self.leave(host)

    def breaks_off(self):
        """The beginning of a valid telegram."""
        host = self.connect()
        self.join()
        host.send(STATUS_REQUEST[:self.chance.randrange(1, len(STATUS_REQUEST))])
        self.leave(host)

    def reconnects(self):
        """Connects and hangs up."""
        self.join()
        for _ in range(self.chance.randrange(20, 300)):
            host = self.connect()
            host.send(STATUS_REQUEST)
            self.leave(host)

    def crowds(self):
        """Fourteen more hosts that wait; each sends something."""
        hosts = [self.connect() for _ in range(15)]
        self.join()
        for host in hosts:
            host.send(self.chance.choice([STATUS_REQUEST, self.chance.randbytes(300)]))
        for host in hosts:
            self.leave(host)


KINDS = [name for name in vars(Hosts) if name not in ("connect", "write", "leave") and not name.startswith("_")]


# ----------------------------------------------------------------------------------------------------------------- soak
class Soak:
    def __init__(self, serve, seed):
        self.serve, self.port = serve, tcp_number(serve)
        self.chance = random.Random(seed)
        self.rounds, self.exchanges, self.repeats, self.longest_turn_s = 0, 0, 0, 0.0
        self.count = dict.fromkeys(KINDS, 0)
        self.begin, self.samples = time.monotonic(), []  # (s, KB)

    def now(self):
        return time.monotonic() - self.begin

    def another_round(self):
        waiting = []
        self.kind = kind = self.chance.choice(KINDS)
        hosts = Hosts(self.port, self.chance, lambda: waiting.append(socket.create_connection(("127.0.0.1", self.port), timeout=30)))
        getattr(hosts, kind)()
        begin = time.monotonic()
        with waiting[0] as connection:
            host = DpHost(connection)
            host.find(TURN_S)
            self.longest_turn_s = max(self.longest_turn_s, time.monotonic() - begin)
            host.insist(host.bring_up, UP_S)
            self.exchange(host)
        self.count[kind] += 1
        self.rounds += 1

    def exchange(self, host):
        """The inputs are the outputs of an earlier exchange: the last but one or two, because the slave's program has an independent cycle."""
        sent = [b"\x00\x00"]
        for number in range(EXCHANGES):
            outputs = ((self.exchanges + number) & 0xFFFF).to_bytes(2, "big")
            got = self.in_exchange(host, outputs)
            check(got in sent[-8:] or number < 8, "the slave has sent %s, after it got %s" % (got.hex(), " ".join(each.hex() for each in sent[-8:])))
            sent.append(outputs)
        self.exchanges += EXCHANGES
        self.repeats += host.repeats

    def in_exchange(self, host, outputs):
        try:
            return host.exchange(outputs)
        except Silent:
            host.forget()
            host.insist(host.bring_up, UP_S)
            return host.insist(lambda: host.exchange(outputs), UP_S)

    def sample(self):
        self.samples.append((self.now(), rss_kb(self.serve.process.pid)))
        print("%.0f\t%d\t%d\t%d\t%.1f" % (self.now() / 60, self.rounds, self.exchanges, self.samples[-1][1], self.longest_turn_s), flush=True)

    def run(self, seconds):
        due = 0.0
        while self.now() < seconds:
            if self.now() >= due:
                self.sample()
                due += min(SAMPLE_S, seconds / 20)
            check(self.serve.process.poll() is None, "serve has ended: " + self.serve.said())
            try:
                self.another_round()
            except (Silent, OSError) as error:
                raise Failure("round %d, after one that %s: %s" % (self.rounds, self.kind.replace("_", " "), error)) from error
        self.sample()

    def settled_kb(self):
        settled = min(600, self.now() / 10)
        return next(kb for at, kb in self.samples if at >= settled)

    def judge(self):
        growth = self.samples[-1][1] - self.settled_kb()
        check(growth < MOST_GROWTH_KB, "memory has grown by %d KB" % growth)


def listens_at(pid):
    """The IPv4 addresses at which a process listens, in the kernel's notation, and the IPv6 addresses, of which there must be none."""
    sockets = {os.readlink("/proc/%d/fd/%s" % (pid, fd)) for fd in os.listdir("/proc/%d/fd" % pid)}
    found = []
    for table in ("tcp", "tcp6"):
        with open("/proc/net/" + table, encoding="ascii") as file:
            rows = [line.split() for line in file][1:]
        found += [row[1].split(":")[0] for row in rows if row[3] == "0A" and "socket:[%s]" % row[9] in sockets]
    return found


def record(soak, seed, peak, verdict):
    result = soak.serve.result
    records.add("soak.tsv", seed, "%.2f" % (soak.now() / 3600), "%.2f" % (result["simulated_ns"] / 3.6e12), soak.rounds, soak.exchanges, soak.repeats,
                "%.1f" % soak.longest_turn_s, soak.settled_kb(), soak.samples[-1][1], peak, verdict)


def soak_for(program, hours, seed, keep):
    """Returns the verdict and a text."""
    verdict, words = HELD, "all held"
    with tempfile.TemporaryDirectory(prefix="dsdpv1_soak_") as folder:
        serve = Serve(program, folder, SCENARIO, port=("--tcp", "0"), log=False)
        soak = Soak(serve, seed)
        try:
            check(listens_at(serve.process.pid) == ["0100007F"], "it listens elsewhere than at 127.0.0.1: %s" % listens_at(serve.process.pid))
            soak.run(hours * 3600)
            soak.judge()
        except Failure as failure:
            verdict, words = FAILED, str(failure)
        except KeyboardInterrupt:
            verdict, words = INTERRUPTED, "interrupted after %.2f hours" % (soak.now() / 3600)
        peak = peak_kb(serve.process.pid) if serve.process.poll() is None else 0
        try:
            serve.end(read_log=False)
        finally:
            serve.kill()
        print("rounds of each kind: " + ", ".join("%s %d" % each for each in soak.count.items()))
        print("simulated %.3f hours, given up %.1f s" % (serve.result["simulated_ns"] / 3.6e12, serve.result["pacing"]["time_lost_ns"] / 1e9))
        if keep and soak.samples:
            record(soak, seed, peak, verdict)
    return verdict, words


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--hours", type=float, default=8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--record", action="store_true", help="adds a row to docs/trust/soak.tsv, from which docs/trust.md is made")
    arguments = parser.parse_args()
    if not 0 < arguments.hours <= 1000:
        parser.error("--hours is %s, expected above 0 and up to 1000" % arguments.hours)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)  # as SIGINT
    verdict, words = soak_for(os.path.abspath(arguments.program), arguments.hours, arguments.seed, arguments.record)
    print(words)
    return EXIT_CODES[verdict]


if __name__ == "__main__":
    sys.exit(main())
