#!/usr/bin/env python3
"""Mistakes in the example firmware for the SPC3 family, each found by its check and by no other: boards on one line, each with the mistake that
its switches choose (examples/firmware/spc3/planted.c).

    planted_test.py DSDPV1_SIM ELF
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[4]
MISTAKES = re.findall(r"^  k(\w+),?$", re.search(r"enum \{\n  kNone,\n(.*?)\};", (ROOT / "examples/firmware/spc3/planted.c").read_text(encoding="utf-8"), re.S).group(1), re.M)
CHECKS = re.findall(r'^X\(k(\w+), "(\w+)"', (ROOT / "kinds/spc3/checks/check_table.inc").read_text(encoding="utf-8"), re.M)
FIRST_ADDRESS = 10
ALSO = {"IRQ_EOI": {"ACK_TIME"}, "BUS_DATA": {"BUS_READY"}}  # until EOI there is no further interrupt; the shortest strobe
# An FSMC keeps these whatever its registers say; the others are planted at SPI (tests/planted/checks.yaml).
NOT_OF_FIRMWARE = {"BUS_SETUP", "BUS_HOLD", "BUS_LEVELS", "BUS_STROBES", "SPI_CLOCK", "SPI_DATA", "SPI_FRAME", "SPI_ARRAY"}
PLACES = {"USE_DATA": "port_read", "USE_DIAG": "port_write", "ACK_SWEEP": "port_read", "IRQ_SEEN": "port_write", "START_MODE": "port_write"}
HEAD = """name: planted
baud: 12M
end: 25ms
chip: {kind: apc3}
checks: {ACK_TIME: {max: 2ms}, IRQ_EOI: {max: 5ms}, IRQ_IDLE: {max: 20}, LIVE_OUTPUTS: {max: 5ms}, LIVE_INPUTS: {max: 5ms}}
"""


def switches(first, count, port, value):
    return [f"P{port}{first + bit}=high" for bit in range(count) if value >> bit & 1]


def slave(number, check, elf):
    held = switches(0, 7, "C", FIRST_ADDRESS + number) + switches(8, 5, "D", number)
    chip = "chip: {kind: vpc3}, " if check == "LIVE_FIRST" else ""
    return (f"  - {{name: {check.lower()}, address: {FIRST_ADDRESS + number}, {chip}init: {{ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: \"11 21\"}}, "
            f"user_cpu: {{kind: arm, elf: \"{elf}\", switches: [{', '.join(held)}]}}}}\n")


def scenario(checks, elf):
    slaves = "".join(slave(number, check, elf) for number, check in checks.items())
    asked = ", ".join(f"{{slave: {check.lower()}, watchdog: 100ms, user_prm: \"00 01 02\", outputs: \"01 02\"}}" for check in checks.values())
    return f"{HEAD}slaves:\n{slaves}masters:\n  - {{name: plc, address: 2, start: 4ms, bus: {{min_slave_interval: 0}}, slaves: [{asked}]}}\n"


def violated(result):
    """Slave to its violated checks, each with the function that made the access, or moved the pin."""
    found = {}
    for each in result["checks"]:
        if each["violations"]:
            where = each["listed"][0]["where"]
            found.setdefault(each["slave"], {})[each["id"]] = where and where["function"]
    return found


def main():
    simulator, elf = sys.argv[1:3]
    ids = dict(CHECKS)
    faults = [f"{name} is planted, and no check has that name" for name in MISTAKES if name not in ids]
    faults += [f"{check} has no mistake in planted.c" for name, check in CHECKS if (name in MISTAKES) == (check in NOT_OF_FIRMWARE)]
    checks = {number: ids[name] for number, name in enumerate(MISTAKES, 1) if name in ids}
    checks[0] = "NONE"
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "x.yaml").write_text(scenario(checks, elf), encoding="utf-8")
        done = subprocess.run([simulator, "run", "x.yaml", "-q", "--result", "x.json"], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 1:
            sys.exit(f"exit code {done.returncode}, expected 1\n{done.stderr}")
        found = violated(json.loads(pathlib.Path(folder, "x.json").read_text(encoding="utf-8")))
    for check in checks.values():
        wanted = ({check} | ALSO.get(check, set())) - {"NONE"}
        seen = found.get(check.lower(), {})
        if set(seen) != wanted:
            faults.append(f"{check}: {sorted(seen)} instead of {sorted(wanted)}")
        elif check in PLACES and seen[check] != PLACES[check]:
            faults.append(f"{check}: in {seen[check]} instead of {PLACES[check]}")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
