"""The schemas of results: each kind of run, and of random stimulus, has a valid result, and the schema detects each missing or unknown
member and each wrong type.

    results_test.py DSDPV1_SIM [rtl]
"""
import copy
import json
import os
import signal
import subprocess
import sys
import tempfile

from validate import faults, validator

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
VIOLATIONS = "scenarios/violations.yaml"  # has checks with violations, refusals, events
FAULT = "12"  # of rtl_ref/dsdpv1/faults.txt, one that is quickly found and shrunk
ANY_NAMES = ("telegrams", "codes", "rulings", "situations")  # objects whose members may have any name


def check(condition, what):
    if not condition:
        sys.exit(what)


def result_of(program, folder, *words, status=(0,)):
    path = os.path.join(folder, "result.json")
    done = subprocess.run([program, *words, "--quiet", "--result", path], cwd=ROOT, capture_output=True, text=True, check=False)
    check(done.returncode in status, "%s: exit %d\n%s" % (words, done.returncode, done.stderr))
    with open(path, encoding="UTF-8") as file:
        return json.load(file)


def interrupted(program, folder):
    path = os.path.join(folder, "interrupted.json")
    run = subprocess.Popen([program, "run", VIOLATIONS, "--set", "end=3000s", "--progress", "--quiet", "--result", path], cwd=ROOT,
                           stderr=subprocess.PIPE)
    run.stderr.read(1)  # the bar: it runs
    run.send_signal(signal.SIGINT)
    run.communicate()
    with open(path, encoding="UTF-8") as file:
        return json.load(file)


def results(program, folder, with_rtl):
    run = ["run", VIOLATIONS, "--no-progress"]
    yield "skip", result_of(program, folder, *run)
    yield "tlm", result_of(program, folder, *run, "--view", "tlm")
    yield "checks off", result_of(program, folder, *run, "--checks", "off")
    yield "refusals", result_of(program, folder, "run", "scenarios/read_services.yaml", "--no-progress")
    yield "checks fail", result_of(program, folder, "run", "scenarios/bus_timing.yaml", "--no-progress", "--set", "user_cpu.fsmc.datast=1", "--set", "user_cpu.fsmc.mode=A",
                                   "--checks", "fail", status=(1,))
    yield "serve", result_of(program, folder, "serve", "scenarios/serve_19k2.yaml", "--pty", "--for", "100ms")
    yield "interrupted", interrupted(program, folder)
    if with_rtl:
        yield "lockstep", result_of(program, folder, "run", "scenarios/bus_timing.yaml", "--no-progress", "--engine", "lockstep")


def results_of_rtl_random(program, folder):
    """Model and RTL are the same; a case that differs; its replay."""
    files = ["--difference", os.path.join(folder, "d.vcd")]
    case = os.path.join(folder, "case.stimulus")
    for what, words, status in (("same", ["--cycles", "20000"], 0), ("case", ["--fault", FAULT, "--stimulus", case, *files], 1),
                                ("replay", ["--fault", FAULT, "--replay", case, *files], 1)):
        path = os.path.join(folder, what + ".json")
        done = subprocess.run([program, "rtl-random", *words, "--result", path], cwd=folder, capture_output=True, text=True, check=False)
        check(done.returncode == status, "%s: exit %d\n%s" % (words, done.returncode, done.stderr))
        with open(path, encoding="UTF-8") as file:
            yield what, json.load(file)


def places(value, path=()):
    """The paths of all objects in a result, one for each list."""
    if isinstance(value, dict) and path[-1:] not in [(name,) for name in ANY_NAMES]:
        yield path
        for name, each in value.items():
            yield from places(each, (*path, name))
    elif isinstance(value, list) and value:
        yield from places(value[0], (*path, 0))


def at(value, path):
    for step in path:
        value = value[step]
    return value


def shortened(value):
    """The value with one item of each list."""
    if isinstance(value, list):
        return [shortened(each) for each in value[:1]]
    return {name: shortened(each) for name, each in value.items()} if isinstance(value, dict) else value


def check_each_member(judge, result):
    """Returns the number of members checked."""
    count = 0
    result = shortened(result)
    for path in places(result):
        for name in at(result, path):
            for change in ("missing", "unknown", "another type"):
                other = copy.deepcopy(result)
                members = at(other, path)
                value = members.pop(name)
                if change == "unknown":
                    members[name + "_"] = members[name] = value
                elif change == "another type":
                    members[name] = {"x": 1} if not isinstance(value, dict) else 1
                optional = change == "missing" and name in ("arm_board", "pacing")
                check(optional or faults(judge, other), "%s of %s is %s, and the schema does not mind" % (name, path, change))
            count += 1
    return count


def check_all(judge, all_results, looked_at, least):
    """Each is valid; for the kinds to check, each member is required."""
    count = 0
    for what, result in all_results:
        found = faults(judge, result)
        check(not found, "%s: %s" % (what, "\n".join(found[:10])))
        check(list(result)[:2] == ["schema", "version"], "the first members are others")
        if what in looked_at:
            count = check_each_member(judge, result)
    check(count > least, "only %d members were looked at" % count)


def main(program, *options):
    with tempfile.TemporaryDirectory() as folder:
        with_rtl = "rtl" in options
        check_all(validator(program), results(program, folder, with_rtl), ("checks fail", "refusals"), 60)
        if with_rtl:
            check_all(validator(program, "--rtl-random"), results_of_rtl_random(program, folder), ("case",), 20)


if __name__ == "__main__":
    main(os.path.abspath(sys.argv[1]), *sys.argv[2:])
