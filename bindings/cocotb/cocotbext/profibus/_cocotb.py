# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""What cocotb 1 and cocotb 2 do in different words. Other versions are refused here, before anything of theirs is used."""
import re
import typing
import warnings

import cocotb

VERSION = tuple(int(part) for part in re.findall(r"\d+", cocotb.__version__)[:2])
if not (1, 8) <= VERSION < (3, 0):
    raise ImportError(f"cocotbext.profibus: this is cocotb {cocotb.__version__}, expected 1.9 or 2.x")
if VERSION < (1, 9):
    warnings.warn(f"cocotbext.profibus: cocotb {cocotb.__version__} is deprecated, use 1.9 or 2.x", DeprecationWarning, stacklevel=2)


def change_of(signal: typing.Any) -> typing.Any:
    """The trigger of any change of a signal."""
    return signal.value_change if VERSION >= (2, 0) else cocotb.triggers.Edge(signal)


def set_now(signal: typing.Any, level: int) -> None:
    """Sets a signal before any write of this time step by `value`.

    Not by cocotb 2's setimmediatevalue: its action is an alias of an ordinary write's, so it waits for the same phase. A clock set by it rises
    together with the inputs of its tick, and RTL that samples them is a cycle early.
    """
    if VERSION >= (2, 0):
        signal.value = cocotb.handle.Immediate(level)
    else:
        signal.setimmediatevalue(level)


def release(signal: typing.Any) -> None:
    """Drives Z at the end of the present time step."""
    high_impedance = "z" * len(signal)
    signal.value = high_impedance if VERSION >= (2, 0) else cocotb.binary.BinaryValue(high_impedance)


def stop(task: typing.Any) -> None:
    """Ends a task that waits."""
    if VERSION >= (2, 0):
        task.cancel()
    else:
        task.kill()
