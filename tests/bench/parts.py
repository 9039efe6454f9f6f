"""Where a run spends its time: samples of perf, each assigned to the part of the project, or the library, of its function."""
import collections
import re

from programs import Failed, samples
from rows import PROFILED

LINE = re.compile(r"^\s*([\d.]+)%\s+(\S.*?)\s+\[[.kgu]\]\s+(\S.*?)\s*$")
REST = "elsewhere"
PROGRAM = r"^(dsdpv1-sim|bench_systemc|libdsdpv1\.so.*)$"  # the last one has the row dpi
# Part, its file (program, library, kernel), its functions: the first that fits. Types in the arguments of a template come last.
OWNERS = tuple((part, re.compile(file), re.compile(function)) for part, file, function in (
    ("kernel", r"^\[(kernel|vdso)", ""),
    ("SystemC", "^libsystemc", ""),
    ("Verilator", "^Vbinding_speed$", ""),
    ("binding", r"^libdsdpv1_dpi\.so", ""),
    ("libraries", rf"^(?!{PROGRAM[1:]})", ""),
    ("FST library", PROGRAM, r"^(fst|LZ4_|fastlz|jenkins)"),
    ("driver", PROGRAM, "^dsdpv1_"),
    ("SystemC", PROGRAM, r"^([a-z]+ thunk to )?(sc_core|sc_dt|tlm|tlm_utils)::"),
    ("module", PROGRAM, r"^([a-z-]+ thunk to )?dsdpv1::systemc::"),
    ("binding", PROGRAM, r"^dpsim_|^([a-z-]+ thunk to )?dsdpv1::capi::"),
    ("chip", PROGRAM, r"^([a-z-]+ thunk to )?dsdpv1::((dpram|profibus)::|[A-Z])"),
    ("bus", PROGRAM, r"^([a-z-]+ thunk to )?dsdpv1::bus::"),
    ("processor", PROGRAM, r"\bdsdpv1::arm::(Engine|Operations|CortexM3|Nvic|SysTick|Scb)::"),
    ("bench", PROGRAM, r"\bdsdpv1::(tb|user_cpu|checks|arm|systemc_bench|app|speed)::"),
    ("bus", PROGRAM, r"\bdsdpv1::bus::"),
    ("chip", PROGRAM, r"\bdsdpv1::")))
NAMES = ("chip", "module", "driver", "bus", "bench", "processor", "FST library", "SystemC", "binding", "Verilator", "libraries", "kernel", REST)


def owner(file, function):
    return next((part for part, of, named in OWNERS if of.search(file) and named.search(function)), REST)


def shares(printed):
    """Maps each part to its percentage of the samples."""
    total = collections.Counter()
    for line in printed.splitlines():
        match = LINE.match(line)
        if match:
            total[owner(match.group(2), match.group(3))] += float(match.group(1))
    return total


def profiles(folder):
    """Maps each row to the shares of its run; empty without perf, which the profile of the core reports."""
    try:
        return {name: shares(samples(folder, command, "dso,sym")) for name, command in PROFILED.items()}
    except Failed:
        return {}
