#!/usr/bin/env python3
"""A real DP master, pyprofibus, with the served model.

    pyprofibus_test.py DSDPV1_SIM CASE      CASE: one of the functions below, or `list`

Exit code 77 (skipped) when pyprofibus is not in .venv: ./run test installs it. A case is repeated only in two situations: the machine was too
busy for real time, as measured by serve and the master (the repetition has a slower clock for pyprofibus), or the line shows that pyprofibus has
taken an answer for another slave's.
"""
import os
import re
import subprocess
import sys
import tempfile

import lateness
from bench import BITS_PER_SECOND, DEADLINE, HERE, LATE_MS, ROOT, Failure, Master, Serve, check, exit_code

PYTHON = os.path.join(ROOT, ".venv", "bin", "python")
AFTER_THE_END = {"WD_EXPIRED", "BAUD_LOST"}  # what a slave says when its master has gone
SLOWER = 4           # maximum slowdown of pyprofibus's clock: its requests still fall into every window of the baud search
ANSWER_CHARS = 255   # so long pyprofibus keeps the line for an answer; then another slave's request goes out, and since a short
                     # acknowledge names no slave it takes the one that comes too late as the answer of both

# first_master.py unchanged, with its lateness measured and its clock slowed down
FIRST_MASTER = """import sys
import first_master, lateness, master
master.slow_down(%d, lateness.Watch(sys.argv[1]))
first_master.main(sys.argv[2], int(sys.argv[3]))
"""

MIX_UPS = 20         # of pyprofibus in a row: on a machine whose processors are taken away for ms at a time every second run has one

IO2 = {"modules": ["2 bytes in, 2 bytes out"], "inputs": 2, "outputs": 2}


def slave(name, address, modules="2 bytes in, 2 bytes out", behaviour="loop_back", init=""):
    return ('  - {name: %s, address: %d, gsd: "%s", modules: ["%s"], user_cpu: {behaviour: %s, cycle: 50us}%s}\n'
            % (name, address, os.path.join(ROOT, "scenarios", "dsdpv1.gsd"), modules, behaviour, init))


def scenario(baud, slaves, script=""):
    # Access every 10 us instead of every 1 us: two slaves in real time also on a slow, busy machine. Of several slaves
    # pyprofibus takes a short acknowledge for another one's too, and its FCB is then that of the request before.
    rule = ", fcb_rule: content" if len(slaves) > 1 else ""
    return ("name: pyprofibus\nbaud: %s\nend: 100ms\nchip: {access_interval: 480%s}\nslaves:\n%s%s"
            % (baud, rule, "".join(slaves), "script:\n" + script if script else ""))


class Run:
    """Serve and master together; both end with the block."""

    late_ms = 0, 0       # in the last run: lateness of serve and of the master
    limit_ms = LATE_MS   # in the last run: its limit for each
    mixed_up = False     # in the last run: see left_out_set_prm
    slower = 1           # slowdown of pyprofibus's clock

    def __init__(self, program, baud, stations, script="", **plan):
        if len(stations) > 1:
            Run.slower = SLOWER
            Run.limit_ms = min(LATE_MS, Run.slower * ANSWER_CHARS * 11e3 / BITS_PER_SECOND[baud] / 2)
        self.folder = tempfile.TemporaryDirectory(prefix="dsdpv1_serve_")
        self.serve = self.master = None
        self.arguments = program, scenario(baud, stations, script)
        self.plan = dict(plan, baud=BITS_PER_SECOND[baud], slower=Run.slower)

    def __enter__(self):
        self.serve = Serve(self.arguments[0], self.folder.name, self.arguments[1])
        self.master = Master(PYTHON, self.folder.name, dict(self.plan, port=self.serve.port))
        return self

    def __exit__(self, *_):
        self.master.kill()
        self.serve.settle()
        Run.late_ms = self.serve.late_ms(), self.master.late_ms()
        Run.mixed_up = left_out_set_prm(self.serve.log or [])
        self.folder.cleanup()

    def codes(self, *kinds):
        return [line.code for line in self.serve.log if line.kind in kinds]


def left_out_set_prm(log):
    """True if a slave got a Chk_Cfg without a preceding Set_Prm: no answer of a slave, right or wrong, causes that. The
    master has taken a short acknowledge, which names no slave, for the answer to a Set_Prm that it had not sent yet."""
    parameterised = set()
    for line in log:
        request = re.match(r"\d+ -> (\d+)  request .*(Set_Prm|Chk_Cfg)", line.text) if line.kind == "telegram" else None
        if request and request[2] == "Set_Prm":
            parameterised.add(request[1])
        elif request and request[1] not in parameterised:
            return True
    return False


# ------------------------------------------------------------------------------------------------------------- checks
def check_clean(run, program):
    """Neither side reports an error up to the end of the master: in the log, in the monitor, in every telegram decoded again."""
    check(run.serve.status == 0, "serve ended with %s: %s" % (run.serve.status, run.serve.said()))
    check(run.serve.result["wrong_telegrams"] == 0, "wrong telegrams on the segment")
    bad = [line.text for line in run.serve.log if line.kind in ("refusal", "violation") and line.code not in AFTER_THE_END]
    check(not bad, "the log holds errors: %s" % bad[:5])
    check(not run.master.said(">ERROR<") and not run.master.said("RX error"), "pyprofibus saw errors: %s" % run.master.words[-10:])
    telegrams = [line.text.rsplit("  ", 1)[1] for line in run.serve.log if line.kind == "telegram"]
    check(len(telegrams) > 10, "hardly any telegrams")
    decoded = subprocess.run([program, "decode"], input="\n".join(telegrams), capture_output=True, text=True, check=False)
    check(decoded.returncode == 0, "the log does not decode: " + decoded.stderr + decoded.stdout[-500:])


def numbers(texts):
    return [int.from_bytes(bytes.fromhex(text.replace(" ", ""))[:2], "little") for text in texts]


def check_loop(run, name, cycles):
    """The master's outputs come back in order, and the slave's user CPU saw each of them, in order."""
    sent = numbers(event["sent"] for event in run.master.of(name))
    got = numbers(event["got"] for event in run.master.of(name))
    check(sent == list(range(cycles)) or len(sent) >= cycles, "only %d exchanges" % len(sent))
    check(got == sorted(got), "%s: inputs came back out of order" % name)
    late = [(cycle, value) for cycle, value in zip(sent, got) if cycle > 3 and not cycle - 3 <= value <= cycle]
    check(not late, "%s: (cycle, input) do not belong together: %s" % (name, late[:5]))
    seen = numbers(line.text[len("outputs "):] for line in run.serve.log
                   if line.station == name and line.kind == "user" and line.text.startswith("outputs "))
    fresh = [value for value in seen if value != 0]
    check(fresh[:cycles - 1] == list(range(1, cycles)), "%s: its user CPU saw other outputs than were sent: %s" % (name, fresh[:20]))


# -------------------------------------------------------------------------------------------------------------- cases
def exchange(program, baud, cycles):
    with Run(program, baud, [slave("echo", 8)], cycles=cycles, slaves=[dict(IO2, name="echo", address=8)]) as run:
        run.master.finish()
        run.serve.end()
        check_loop(run, "echo", cycles)
        check_clean(run, program)
        check(run.serve.result["slaves"][0]["data_exchanges"] >= cycles, "the chip counted fewer exchanges")
        check(run.serve.result["pacing"]["telegrams_from_host"] >= cycles, "serve counted fewer telegrams")
        return run.serve


def exchange_19k2(program):
    exchange(program, "19.2k", 200)


def exchange_45k45(program):
    exchange(program, "45.45k", 500)


def exchange_500k(program):
    exchange(program, "500k", 3000)


def exchange_1m5(program):
    exchange(program, "1.5M", 2000)


def two_slaves(program):
    slaves = [slave("io", 5, "4 bytes in, 4 bytes out"), slave("words", 40, "8 words in, 8 words out")]
    plan = [{"name": "io", "address": 5, "modules": ["4 bytes in, 4 bytes out"], "inputs": 4, "outputs": 4},
            {"name": "words", "address": 40, "modules": ["8 words in, 8 words out"], "inputs": 16, "outputs": 16}]
    with Run(program, "187.5k", slaves, cycles=200, slaves=plan) as run:
        run.master.finish()
        run.serve.end()
        check_loop(run, "io", 200)
        check_loop(run, "words", 200)
        check_clean(run, program)


def sync_freeze(program):
    """Sync for group 1 holds the outputs of `out`, Freeze for group 2 the inputs of `in`; neither reacts to the other's group."""
    slaves = [slave("out", 5), slave("in", 6, behaviour="count")]
    plan = [dict(IO2, name="out", address=5, sync=1, freeze=1, group=1), dict(IO2, name="in", address=6, sync=1, freeze=1, group=2)]
    actions = [{"at": 50, "do": "syncMode", "group": 1}, {"at": 100, "do": "freezeMode", "group": 2},
               {"at": 150, "do": "syncMode", "group": 1}, {"at": 200, "do": "syncModeCancel", "group": 1},
               {"at": 250, "do": "freezeModeCancel", "group": 2}]
    with Run(program, "500k", slaves, cycles=300, slaves=plan, actions=actions) as run:
        run.master.finish()
        run.serve.end()
        check_clean(run, program)
        for name, group in (("out", "02"), ("in", "01")):
            ignored = [line.text for line in run.serve.log if line.station == name and line.code == "GC_OTHER_GROUP"]
            others = [action for action in actions if action["group"] == int(group)]
            check(len(ignored) == len(others) and all("for group %s:" % group in text for text in ignored),
                  "%s minds another group than its own: %s" % (name, ignored))
        check([event["did"] for _, event in run.master.did] == [action["do"] for action in actions], "not all commands were sent")

        # Indexes into the list of all exchanges: after a restart of one slave, the slaves' own counts differ.
        places = [0] + [place for place, _ in run.master.did] + [len(run.master.exchanges)]

        def inputs(name, begin, end):
            """The number of different inputs between two commands, without the exchanges around the commands."""
            margin = 6
            got = [event["got"] for event in run.master.exchanges[places[begin]:places[end]] if event["slave"] == name]
            return set(got[margin:-margin])

        check(len(inputs("out", 0, 1)) > 20, "out: nothing moves before Sync")
        held = inputs("out", 1, 3)
        check(len(held) == 1, "out: outputs move although Sync holds: %s" % sorted(held)[:4])
        again = inputs("out", 3, 4)
        check(len(again) == 1 and again != held, "out: the second Sync took nothing over")
        check(len(inputs("out", 4, 6)) > 50, "out: nothing moves after Unsync")
        check(len(inputs("in", 1, 2)) > 20, "in: inputs do not move before Freeze")
        check(len(inputs("in", 2, 5)) == 1, "in: inputs move although Freeze holds")
        check(len(inputs("in", 5, 6)) > 10, "in: inputs do not move after Unfreeze")


def diagnosis(program):
    """A diagnosis of the user CPU makes the master read it, and data exchange continues."""
    script = ('  - {when: {slave: echo, data_exchanges: 100}, do: set_diagnosis, slave: echo, type: external, bytes: "03 44 55"}\n'
              '  - {when: {slave: echo, data_exchanges: 200}, do: set_diagnosis, slave: echo, type: external_gone, bytes: "01"}\n')
    with Run(program, "500k", [slave("echo", 8)], script, cycles=300, slaves=[dict(IO2, name="echo", address=8)]) as run:
        run.master.finish()
        run.serve.end()
        check_clean(run, program)
        check(run.master.said("requested diagnostics"), "pyprofibus did not see the high-priority answer")
        answers = [line.text for line in run.serve.log if line.kind == "telegram" and "Slave_Diag:" in line.text]
        came = [i for i, text in enumerate(answers) if "[Ext_Diag]" in text and "03 44 55" in text]
        check(came, "the master did not read the diagnosis: %s" % answers)
        check(any("[Ext_Diag]" not in text for text in answers[came[-1] + 1:]), "the master did not read that it has gone")
        check("WD_EXPIRED" not in [line.code for line in run.serve.log if line.ns < last_exchange(run)], "the slave left data exchange")


def last_exchange(run):
    return max(line.ns for line in run.serve.log if line.kind == "telegram" and "Data_Exchange" in line.text)


def unplug_and_replug(program):
    script = ("  - {when: {slave: echo, data_exchanges: 100}, do: unplug, slave: echo}\n"
              "  - {when: {slave: echo, data_exchanges: 100, after: 700ms}, do: plug, slave: echo}\n")
    plan = [dict(IO2, name="echo", address=8, watchdog=200)]
    with Run(program, "500k", [slave("echo", 8)], script, cycles=300, slaves=plan) as run:
        run.master.finish()
        run.serve.end()
        # A telegram on the line at that moment is cut off; a telegram of this scenario lasts less than 1 ms. There are no other errors.
        moments = [line.ns for line in run.serve.log if line.text in ("unplugged", "plugged in")]
        bad = [line.text for line in run.serve.log if line.kind == "violation" and not any(0 <= line.ns - at < 1e6 for at in moments)]
        check(len(moments) == 2 and not bad, "violations apart from the unplugging: %s" % bad)
        check(run.codes("refusal").count("WD_EXPIRED") >= 1, "the watchdog did not expire while unplugged")
        states = [line.text for line in run.serve.log if line.code == "DP_STATE"]
        check(sum("to DATA_EXCH" in text for text in states) == 2, "the slave was not brought up twice: %s" % states)
        got = numbers(event["got"] for event in run.master.of("echo"))
        check(got[-1] >= 290, "the exchange did not go on: %s" % got[-1])


def wrong_ident(program):
    plan = [dict(IO2, name="echo", address=8, ident=0x1234)]
    with Run(program, "500k", [slave("echo", 8)], cycles=1, slaves=plan) as run:
        run.serve.wait_for_log(r"response.*Slave_Diag:.*Prm_Fault")  # the master starts again and learns the fault
        run.master.kill()
        run.serve.end()
        check("PRM_IDENT" in run.codes("refusal"), "the slave does not say what is wrong")
        check(" PRM_IDENT " in run.serve.summary, "the table does not say what is wrong: " + run.serve.summary)
        text = next(line.text for line in run.serve.log if line.code == "PRM_IDENT")
        check("1234" in text and "0CC9" in text, "the reason names other values: " + text)
        check("CFG_OK" not in run.codes("info") and not run.master.exchanges, "the slave went on")


def wrong_configuration(program):
    """A slave that accepts only its own configuration refuses another one and names the byte."""
    slaves = [slave("echo", 8, init=", init: {cfg_mode: 1}")]
    plan = [dict(IO2, name="echo", address=8, modules=["4 bytes in, 4 bytes out"])]
    with Run(program, "500k", slaves, cycles=1, slaves=plan) as run:
        check(run.master.run_until(lambda: run.master.said("faulty configuration")), "the master ended")
        run.master.kill()
        run.serve.end()
        check("CFG_DIFFERS" in run.codes("refusal"), "the slave does not say what is wrong")
        check(not run.master.exchanges, "the slave went on")


def killed_master(program):
    """After the master is killed, the watchdog ends data exchange 300 ms after its last telegram, to the millisecond."""
    plan = [dict(IO2, name="echo", address=8, watchdog=300)]
    with Run(program, "500k", [slave("echo", 8)], cycles=100000, slaves=plan) as run:
        check(run.master.run_until(lambda: len(run.master.exchanges) >= 100), "the master ended")
        run.master.kill()
        run.serve.wait_for_log("WD_EXPIRED")
        run.serve.wait_for_log("hung up")
        run.serve.end()
        expired = [line for line in run.serve.log if line.code == "WD_EXPIRED"]
        check(len(expired) == 1, "the watchdog expired %d times" % len(expired))
        last = max(line.ns for line in run.serve.log if line.kind == "telegram" and line.ns < expired[0].ns and " 2 -> 8 " in " " + line.text)
        check(abs(expired[0].ns - last - 300e6) < 1e6, "the watchdog expired after %.1f ms" % ((expired[0].ns - last) / 1e6))
        after = [line.text for line in run.serve.log if line.ns >= expired[0].ns and line.kind == "user"]
        check("outputs 00 00" in after, "the outputs were not cleared")
        check("hung up" in run.serve.said(), "serve does not say that the host hung up")


def documented_commands(program):
    """The steps of docs/pyprofibus.md, with the shipped scenario and master."""
    with tempfile.TemporaryDirectory(prefix="dsdpv1_serve_") as folder:
        with open(os.path.join(ROOT, "scenarios", "serve_19k2.yaml"), encoding="UTF-8") as file:
            text = file.read().replace("dsdpv1.gsd", os.path.join(ROOT, "scenarios", "dsdpv1.gsd"))
        serve = Serve(program, folder, text)
        late = os.path.join(folder, "late_ms")
        try:
            master = subprocess.run([PYTHON, "-c", FIRST_MASTER % Run.slower, late, serve.port, "30"], cwd=HERE,
                                    capture_output=True, text=True, check=False, timeout=DEADLINE)
            serve.end()
            check(master.returncode == 0, master.stdout[-300:] + master.stderr[-300:])
            check(master.stdout.count("received") == 30 and "sent 1d00 received 1c00" in master.stdout, master.stdout[-300:])
            check(serve.status == 0, serve.said())
        finally:
            serve.settle()
            Run.late_ms = serve.late_ms(), lateness.greatest_ms(late)


CASES = [documented_commands, exchange_19k2, exchange_45k45, exchange_500k, exchange_1m5, two_slaves, sync_freeze, diagnosis, unplug_and_replug,
         wrong_ident, wrong_configuration, killed_master]


def installed():
    if not os.path.exists(PYTHON):
        return False
    return subprocess.run([PYTHON, "-c", "import pyprofibus, serial"], capture_output=True, check=False).returncode == 0


def was_too_busy():
    """Prints the lateness; if it is too great, the next run has a slower clock."""
    print("late at most: serve %.1f ms, the master %.1f ms; above %.1f ms it is the machine's fault" % (*Run.late_ms, Run.limit_ms))
    busy, Run.late_ms, Run.slower = max(Run.late_ms) > Run.limit_ms, (0, 0), SLOWER
    return busy


def untangled(case, program):
    """Runs the case, again if pyprofibus has mixed up its slaves: a few ms between an answer and its next look at the port can cause that."""
    for _ in range(MIX_UPS):
        try:
            return case(program)
        except Exception:
            if not Run.mixed_up:
                raise
    raise Failure("pyprofibus has sent a Chk_Cfg without a Set_Prm %d times: it takes each short acknowledge for another slave's" % MIX_UPS)


def main(program, name):
    cases = {case.__name__: case for case in CASES}
    if name == "list":
        print("\n".join(cases))
        return 0
    if not installed():
        print("skipped: pyprofibus is not in .venv, ./run test installs it")
        return 77
    return exit_code(lambda: untangled(cases[name], program), was_too_busy)


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2]))
