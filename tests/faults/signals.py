"""Signals while a command starts or runs, and two simultaneous commands. Each returns the remaining files, the exit code, the line."""
import os
import signal
import subprocess

from place import DEADLINE, check, wait_for


def running(place, number):
    process = place.start_endless()
    process.send_signal(number)
    return place.end(process, early=True)


def interrupted(place):
    return running(place, signal.SIGINT)


def terminated(place):
    return running(place, signal.SIGTERM)


def hung_up(place):
    return running(place, signal.SIGHUP)


def kill(place):
    """Sends the signal when there is something to read, if that is before the end; for FST, more than its head."""
    process = place.start_endless()
    place.part(something=place.output.simulates and place.output.kind not in ("result", "report"))
    process.kill()
    return place.end(process, said=False)


def killed_and_recovered(place):
    kill(place)
    part = place.part()
    done = subprocess.run([place.program, "recover", part], cwd=place.path, capture_output=True, check=False, timeout=DEADLINE)
    place.inputs |= {part, part + ".hier"}
    check(os.path.getsize(place.file()) > 1000, "the recovered wave is small")
    return [place.left(early=True), "usual" if done.returncode == 0 else str(done.returncode), place.line(done.stdout + done.stderr)]


def starting(place, number):
    """The start blocks at a FIFO without a reader."""
    os.mkfifo(place.file("hold.vcd"))
    process = place.start(place.output.command(more=place.output.held("hold.vcd"), endless=True))
    part = place.part()
    if place.output.kind == "wave .fst":
        wait_for(lambda: os.path.exists(place.file(part + ".hier")), "FST's second file")
    process.send_signal(number)
    process.wait(DEADLINE)
    place.inputs.add("hold.vcd")
    if part.startswith("held") and number == signal.SIGKILL:
        place.inputs.add(part)
    return place.end(process)


def interrupted_at_start(place):
    return starting(place, signal.SIGINT)


def terminated_at_start(place):
    return starting(place, signal.SIGTERM)


def killed_at_start(place):
    return starting(place, signal.SIGKILL)


def two_at_once(place):
    """Both are running before the first of them ends: each has its own temporary file."""
    processes = [place.start_endless() for _ in range(2)]
    parts = [name for name in os.listdir(place.path) if name.endswith(".part") and name not in place.inputs]
    check(len({name.split(".")[-2] for name in parts}) == 2, "they do not have a temporary file each: %s" % parts)
    processes[0].send_signal(signal.SIGINT)
    first = place.end(processes[0], early=True)
    check("FILE.PID.part" in first[0], "after the first there is " + first[0])
    processes[1].send_signal(signal.SIGINT)
    second = place.end(processes[1], early=True)
    check(first[1:] == second[1:], "the two differ: %s, %s" % (first, second))
    return second
