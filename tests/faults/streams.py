"""Outputs that are not files: terminals, FIFOs, /dev/null, standard output. Each fault returns the remaining files, the exit code, the line."""
import os
import select
import signal
import tempfile
import threading
import tty

from place import DEADLINE, check, wait_for
from whole import read, same


def standard_outputs_file(place):
    place.inputs.add(place.output.file)
    with open(place.file(), "wb") as file:
        row = place.end(place.start(place.output.command(), stdout=file))
        check(os.stat(file.fileno()).st_nlink == 1 and os.path.getsize(place.file()) == 0, "it was replaced or written to")
    return row


def device(place):
    """A terminal, by its name."""
    master, slave = os.openpty()
    tty.setraw(slave)
    got = []
    os.symlink(os.ttyname(slave), place.file())  # a wave's name must have the ending of its format
    process = place.start(place.output.command())
    reader = threading.Thread(target=drain, args=(master, got))
    reader.start()
    row = place.end(process)
    os.close(slave)
    reader.join(DEADLINE)
    os.close(master)
    check(row[1] != "usual" or same(b"".join(got), place.output.reference), "the terminal got something else")
    return row


def drain(descriptor, got):
    try:
        while data := os.read(descriptor, 65536):
            got.append(data)
    except OSError:  # the other side is closed
        pass


def null_twice(place):
    for name in (place.output.file, "other.vcd"):
        os.symlink("/dev/null", place.file(name))
    place.inputs.add("other.vcd")
    return place.do(more=[place.output.other, "other.vcd"])


def join_reader(place, reader):
    """It still waits for a writer when the program has refused to be one."""
    while reader.is_alive():
        try:
            os.close(os.open(place.file(), os.O_WRONLY | os.O_NONBLOCK))
        except OSError:  # it is not in its open, not yet or no more
            pass
        reader.join(0.01)


def fifo(place):
    os.mkfifo(place.file())
    got = []
    reader = threading.Thread(target=lambda: got.append(read(place.file())), daemon=True)
    reader.start()
    row = place.do()
    join_reader(place, reader)
    check(row[1] != "usual" or same(got[0], place.output.reference), "the FIFO's reader got something else")
    return row


def fifo_reader_gone(place):
    """In the middle of a run that would take hours."""
    os.mkfifo(place.file())
    process = place.start(place.output.command(endless=True))
    reader = threading.Thread(target=lambda: open(place.file(), "rb", buffering=0).close(), daemon=True)  # pylint: disable=R1732
    reader.start()
    row = place.end(process)
    join_reader(place, reader)
    return row


def full_pipe_and_interrupted(place):
    """Another output waits for its reader when the signal comes: it continues afterwards, and no output is damaged."""
    os.mkfifo(place.file("pipe.vcd"))
    process = place.start(place.output.command(more=place.output.beside("pipe.vcd"), endless=True))
    with open(place.file("pipe.vcd"), "rb", buffering=0) as pipe:
        writer = os.open(place.file("pipe.vcd"), os.O_WRONLY | os.O_NONBLOCK)
        wait_for(lambda: not select.select([], [writer], [], 0)[1], "a pipe that takes no more")
        os.close(writer)
        process.send_signal(signal.SIGINT)
        while pipe.read(1 << 16):
            pass
    place.inputs.add("pipe.vcd")
    return place.end(process, early=True)


# --- standard output ------------------------------------------------------------------------------------------------------

def stdout_full(place):
    with open("/dev/full", "wb") as full:
        return place.end(place.start(place.output.command(), stdout=full))


def stdout_full_in_the_middle(place):
    """The limit is far beyond the run's files; the output begins a few bytes before it."""
    limit = 100_000_000
    with tempfile.TemporaryFile() as file:
        file.seek(limit - 100)
        return place.end(place.start(place.output.command(), "fsize=%d" % limit, stdout=file))


def stdout_closed(place):
    return place.end(place.start(place.output.command(), "closed"))


def stdout_reader_gone(place):
    reader, writer = os.pipe()
    os.close(reader)
    row = place.end(place.start(place.output.command(), stdout=writer))
    os.close(writer)
    return row
