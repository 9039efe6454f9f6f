"""How late a process comes to run: a thread sleeps 1 ms at a time and keeps the greatest overshoot.

A process that waits for Python's lock is late, too: so the overshoot is also that of a thread which is busy.
"""
import os
import threading
import time

NAP_S = 0.001


def watch(path):
    """From now on the file at `path` holds the greatest overshoot of this process, in ms."""
    file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
    threading.Thread(target=nap_for_ever, args=(file,), daemon=True).start()


def nap_for_ever(file):
    greatest = 0.0
    woke = time.monotonic()
    while True:
        time.sleep(NAP_S)
        before, woke = woke, time.monotonic()  # from one nap's end to the next one's: no moment between them is left out
        late = woke - before - NAP_S
        if late > greatest:
            greatest = late
            os.pwrite(file, b"%12.3f" % (greatest * 1000), 0)  # at once: whoever is killed has told, too


def greatest_ms(path):
    """What the file says; 0 when nothing was watched so far."""
    try:
        with open(path, encoding="ASCII") as file:
            return float(file.read() or 0)
    except FileNotFoundError:
        return 0.0
