"""Starts a program on a machine with a fault: launch.py FAULTS PROGRAM ARGUMENTS...

FAULTS, with commas: fsize=N, no file may be longer than N bytes (as on a full disk); nofile=N, at most N files may be open; user, files without
write permission cannot be written even by root; closed, there is no standard output.
"""
import ctypes
import os
import resource
import signal
import sys

PR_CAPBSET_DROP = 24
CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH = 1, 2
LIMITS = {"fsize": resource.RLIMIT_FSIZE, "nofile": resource.RLIMIT_NOFILE}


def keep_to_permissions():
    """Privileges of root; no effect for others."""
    libc = ctypes.CDLL(None, use_errno=True)
    for capability in (CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH):
        libc.prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)


for fault in filter(None, sys.argv[1].split(",")):
    if fault == "user":
        keep_to_permissions()
    elif fault == "closed":
        os.close(1)
    else:
        limit, number = fault.split("=")
        resource.setrlimit(LIMITS[limit], (int(number), resource.getrlimit(LIMITS[limit])[1]))
for number in (signal.SIGPIPE, signal.SIGXFSZ):  # Python ignores them, and ignored signals are inherited
    signal.signal(number, signal.SIG_DFL)
os.execv(sys.argv[2], sys.argv[2:])
