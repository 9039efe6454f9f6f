"""Runs dsdpv1-sim and tshark for the tests of captures."""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DISSECTOR = ROOT / "share/wireshark/profibus_dp"
SIM = str(pathlib.Path(sys.argv[1]).resolve())


def sim(folder, *arguments, status=0):
    """The program's output; the exit code must be `status` (None: any)."""
    done = subprocess.run([SIM, *map(str, arguments)], cwd=folder, capture_output=True, text=True, check=False)
    if status is not None and done.returncode != status:
        sys.exit(f"dsdpv1-sim {arguments}: exit code {done.returncode} in the place of {status}\n{done.stdout}{done.stderr}")
    return done


def capture(folder, scenario, *options, link="user0", status=0):
    """Runs a scenario; its capture and the telegrams of its log."""
    packets, log = folder / "capture.pcapng", folder / "log.jsonl"
    sim(folder, "run", scenario, "-q", "--no-progress", "--capture", packets, "--capture-link", link, "--log", log, *options,
        status=status)
    entries = map(json.loads, log.read_text(encoding="utf-8").splitlines())
    return packets, [entry for entry in entries if entry["kind"] == "telegram"]


def tshark(folder, packets, *options, installed=False):
    """The output of tshark with the dissector; `installed`: from the plugin folder of `folder`, its home."""
    script = [] if installed else ["-X", f"lua_script:{DISSECTOR}/profibus_dp.lua"]
    home = os.environ | {"HOME": str(folder), "XDG_CONFIG_HOME": str(folder / "config")}
    done = subprocess.run(["tshark", *script, "-r", packets, *options], cwd=folder, env=home, capture_output=True, text=True,
                          check=False)
    if done.returncode != 0 or "Lua" in done.stderr:
        sys.exit(f"tshark {options}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def fields(folder, packets, *names, **options):
    """A row of values a packet, empty where there is none; of several the first."""
    wanted = [word for name in names for word in ("-e", name)]
    text = tshark(folder, packets, "-T", "fields", "-E", "occurrence=f", *wanted, **options)
    return [line.split("\t") for line in text.splitlines()]


failures = []


def expect(what, got, wanted):
    if got != wanted:
        failures.append(what)
        print(f"{what}:\n  wanted {wanted}\n  got    {got}")
