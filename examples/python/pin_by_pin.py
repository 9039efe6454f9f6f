# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""A master brings up a slave whose user CPU is this program; the rules of the user's side are checked as well.

    python3 examples/python/pin_by_pin.py [GSD]
"""
import importlib.util
import sys

if missing := [name for name in ("numpy", "dsdpv1") if importlib.util.find_spec(name) is None]:
    print(f"pin_by_pin.py: {sys.executable} has no {', '.join(missing)}, expected a Python with dsdpv1 (docs/python.md)", file=sys.stderr)
    sys.exit(2)

import dsdpv1
from dsdpv1 import CYCLE, MS, US


def main(gsd_file: str) -> None:
    gsd = dsdpv1.Gsd(gsd_file)
    slave = gsd.slave(5, ["8 bytes in, 8 bytes out"])

    bus = dsdpv1.Bus("12M")
    chip = bus.add_chip("demo")
    master = bus.add_master(address=2)
    master.add_slave(slave)
    master.set_outputs(5, bytes(range(1, 9)))
    chip.on_event(lambda event: print(f"{event.tick / US:10.3f} us  {event.code}: {event.text}"))
    bus.on_event(lambda event: print(f"{event.tick / US:10.3f} us  {event.type.name} {event.after.name if event.after else ''}"))

    checker = dsdpv1.Checker()
    checker.on_violation(lambda violation: print("violated:", violation.rule, violation.text))
    chip.watch()  # all pins

    user = dsdpv1.User(chip)
    user.wait(20 * CYCLE)
    user.power_on(dsdpv1.Initialisation.of(slave))
    master.start()
    outputs = None
    while outputs is None:
        user.wait(100 * US)
        outputs = user.exchange(inputs=b"\xCA\xFE" + bytes(6))
    print("outputs", outputs.hex(" "))
    bus.run(bus.now + 1 * MS)
    print("inputs at the master", master.slave(5).inputs.hex(" "))

    changes = chip.changes()  # numpy: tick, station, pin, level
    checker.pins(changes)
    checker.finish(bus.now)
    print(len(changes) > 1000, "changes; violations:", sum(each.violations for each in checker.results.values()))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "scenarios/dsdpv1.gsd")
