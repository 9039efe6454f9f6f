"""The targets: their input, its maximum length, and the number of inputs required without a finding."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Target:
    name: str
    longest: int  # bytes of an input
    what: str
    goal: int = 1_000_000  # inputs
    flags: tuple = ()  # of libFuzzer, after those that all have
    asan: str = ""  # options of AddressSanitizer, after those that all have


TARGETS = (
    Target("telegram", 300, "telegrams: decoded, in words, printed, and encoded again", 10_000_000),
    Target("log", 2048, "text of telegrams: hexadecimal, logs of runs, JSON lines"),
    Target("scenario", 2048, "scenarios and settings of a command line: read and checked"),
    Target("gsd", 2048, "GSD files: read, set up with modules, reported"),
    Target("pin_map", 1024, "maps of pins for user RTL"),
    Target("stimulus", 2048, "stimulus files: read, written, read again"),
    Target("pcapng", 2048, "captures of packets: pcapng and pcap"),
    Target("csv", 2048, "tables of logic analysers"),
    Target("sigrok", 4096, "sessions of sigrok: archives as they are, and right ones round any content"),
    Target("vcd", 2048, "waves as text"),
    Target("fst", 2048, "waves in FST, read by a separate process", flags=("-malloc_limit_mb=1000000",),
           # The process may be refused memory, and needs no place of the damage in the library; little freed memory makes it cheap to fork.
           asan="max_allocation_size_mb=256:symbolize=0:quarantine_size_mb=1"),
    Target("serve", 1024, "what a host writes to a socket of `serve`, in pieces and with pauses"),
    Target("elf", 8192, "firmware for the ARM board, and its lines of source"),
    Target("gdb", 2048, "what a gdb sends to the ARM board, in pieces"),
    Target("run", 2048, "scenarios carried out for 2 ms, in step and in skip: the same results"),
    Target("capi", 1024, "calls of the C API in any order, with right and wrong arguments"),
    Target("chip", 512, "the chip's pins, its three host ports and its line, with and without manners: step, skip and dozing change the same pins"),
    Target("state", 128, "saved states of chips, damaged: refused, or restored and carried on in step and in skip"),
)
NAMES = tuple(each.name for each in TARGETS)


def find(name):
    return next(each for each in TARGETS if each.name == name)
