"""Scheduling delay of a process: a thread sleeps 1 ms at a time, a loop reads the clock all the time, and the greatest overshoot is kept.

A thread that waits for Python's lock is also late, so its overshoot includes a loop that holds the lock. But a loop that polls a port releases
the lock each time. The scheduler may then suspend the loop for a second while the thread runs without delay.
"""
import os
import threading
import time

NAP_S = 0.001


class Watch:
    """The file at `path` holds the greatest overshoot of this process so far, in ms."""

    def __init__(self, path):
        self.file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
        self.greatest = 0.0
        self.lock = threading.Lock()  # of `greatest` and the file
        self.read = None  # time of the loop's last look at the clock
        threading.Thread(target=self.nap_for_ever, daemon=True).start()

    def was_late(self, late):
        if late <= self.greatest:
            return
        with self.lock:
            self.greatest = max(self.greatest, late)
            os.pwrite(self.file, b"%12.3f" % (self.greatest * 1000), 0)  # at once: whoever is killed has told, too

    def nap_for_ever(self):
        woke = time.monotonic()
        while True:
            time.sleep(NAP_S)
            before, woke = woke, time.monotonic()  # from the end of one nap to the end of the next: no moment is left out
            self.was_late(woke - before - NAP_S)

    def clock(self):
        """The time, for a loop that reads it continuously."""
        before, self.read = self.read, time.monotonic()
        if before is not None:
            self.was_late(self.read - before)
        return self.read


def greatest_ms(path):
    """The file's value; 0 before the first measurement."""
    try:
        with open(path, encoding="ASCII") as file:
            return float(file.read() or 0)
    except FileNotFoundError:
        return 0.0
