#!/usr/bin/env python3
"""The condition for repeating cases with pyprofibus: a late process is detected, and no other failure is forgiven.

    lateness_test.py DSDPV1_SIM CASE      CASE: one of the functions below
"""
import os
import signal
import subprocess
import sys
import tempfile
import time

import lateness
from bench import ATTEMPTS, DEADLINE, HERE, Failure, check, exit_code

STOPPED_MS = 200
WATCHED = "import lateness, sys; lateness.Watch(sys.argv[1]); input()"
STOPS_AS_IT_TELLS = """
import lateness, os, signal, sys, threading
write = os.pwrite
def write_and_stop(*arguments):
    os.pwrite = write
    write(*arguments)
    signal.pthread_kill(threading.get_ident(), signal.SIGSTOP)  # not os.kill: it stops here, not as soon as some thread hears of it
os.pwrite = write_and_stop
""" + WATCHED


def wait_for_lateness(path, least_ms):
    end = time.monotonic() + DEADLINE
    while lateness.greatest_ms(path) < least_ms:
        check(time.monotonic() < end, "not noticed: %.1f ms of %.1f ms" % (lateness.greatest_ms(path), least_ms))
        time.sleep(0.01)  # polls; the interval does not matter


def is_late(program, stop):
    """True if a process of `program` that `stop` has stopped, and that continues after STOPPED_MS, was that late."""
    with tempfile.TemporaryDirectory(prefix="dsdpv1_late_") as folder:
        late = os.path.join(folder, "late_ms")
        check(lateness.greatest_ms(late) == 0, "late before it was watched")
        with subprocess.Popen([sys.executable, "-c", program, late], cwd=HERE, stdin=subprocess.PIPE) as watched:
            try:
                wait_for_lateness(late, 0.001)
                stop(watched)
                os.waitid(os.P_PID, watched.pid, os.WSTOPPED)
                time.sleep(STOPPED_MS / 1000)  # the process is late by this time
                watched.send_signal(signal.SIGCONT)
                wait_for_lateness(late, 0.9 * STOPPED_MS)
                watched.communicate(b"\n")
            finally:
                watched.kill()
        check(watched.returncode == 0, "it did not come to its end")


def stopped_process_was_late():
    is_late(WATCHED, stop=lambda process: process.send_signal(signal.SIGSTOP))


def stopped_between_two_naps_was_late():
    is_late(STOPS_AS_IT_TELLS, stop=lambda process: None)


def loop_that_was_kept_from_running_was_late():
    with tempfile.TemporaryDirectory(prefix="dsdpv1_late_") as folder:
        late = os.path.join(folder, "late_ms")
        watch = lateness.Watch(late)
        watch.clock()
        time.sleep(STOPPED_MS / 1000)  # the other thread runs meanwhile
        watch.clock()
        check(lateness.greatest_ms(late) >= STOPPED_MS, "not noticed: %.1f ms" % lateness.greatest_ms(late))


def only_a_busy_machine_gets_another_try():
    def tries(busy, succeeds_at=ATTEMPTS + 1):
        done = []

        def case():
            done.append(case)
            check(len(done) >= succeeds_at, "made up, attempt %d" % len(done))
        return exit_code(case, lambda: busy, pause_s=0), len(done)
    check(tries(busy=False) == (1, 1), "a failure on a machine that was not busy was tried again")
    check(tries(busy=True) == (1, ATTEMPTS), "not tried again, or too often")
    check(tries(busy=True, succeeds_at=2) == (0, 2), "the second try does not count")


CASES = [stopped_process_was_late, stopped_between_two_naps_was_late, loop_that_was_kept_from_running_was_late, only_a_busy_machine_gets_another_try]

if __name__ == "__main__":
    try:
        {case.__name__: case for case in CASES}[sys.argv[2]]()
    except Failure as failure:
        sys.exit(str(failure))
