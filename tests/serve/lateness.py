"""Scheduling delay of a process: a thread sleeps 1 ms at a time, a loop reads the clock all the time, and the greatest overshoot is kept.

A thread that waits for Python's lock is also late, so its overshoot includes a loop that holds the lock. But a loop that looks at a port again
and again gives the lock away each time. The scheduler may leave it there for a second while the thread runs at once.
"""
import os
import threading
import time

NAP_S = 0.001


class Watch:
    """From now on the file at `path` holds the greatest overshoot of this process, in ms."""

    def __init__(self, path):
        self.file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
        self.greatest = 0.0
        self.lock = threading.Lock()  # of it and the file
        self.read = None  # when the loop has read the clock last
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
            before, woke = woke, time.monotonic()  # from one nap's end to the next one's: no moment between them is left out
            self.was_late(woke - before - NAP_S)

    def clock(self):
        """The time, for a loop that asks for it all the time."""
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
