"""A sweep of 200 points as a job array. One task is killed while it runs, one is cancelled, then the sweep itself is killed. The same command
resumes: it waits for the tasks that Slurm still has, submits the two lost ones again, and gives the files of a sweep that was
carried out here.

    array_test.py DSDPV1_SIM
"""
import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile

from cluster import Cluster, wait_for

SCENARIO = """name: small
baud: 12M
end: 60us
slaves: [{name: demo, address: 5, init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: "30"}}]
expect: [{slave: demo, dp_state: offline}]
"""
POINTS = 200
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
SWEEP = ["sweep", "s.yaml", "--param", "user_cpu.fsmc.datast=1..20", "--param", "user_cpu.fsmc.addset=0..9", "--no-progress"]


def check(condition, what):
    if not condition:
        sys.exit(what)


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


class Sweep:
    def __init__(self, program, folder, cluster):
        self.program, self.folder, self.cluster = program, folder, cluster

    def command(self, out, *more):
        return [self.program, *SWEEP, "--out", out, *more]

    def points(self):
        path = os.path.join(self.folder, "out", "points")
        return {int(name[:5]) for name in os.listdir(path) if name.endswith(".json")} if os.path.isdir(path) else set()

    def submission(self, number):
        try:
            return json.loads(read(self.folder, "out", "slurm", "%d.json" % number))
        except (FileNotFoundError, ValueError):
            return {}

    def start(self):
        return subprocess.Popen(self.command("out", "--slurm"), cwd=self.folder, env=self.cluster.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)

    def tasks(self):
        """Process and number of the running tasks. Between fork and exec, a task's run has the same command line; it would be tried again."""
        found, parents = {}, {}
        for process in self.cluster.processes():
            try:
                words = read("/proc/%d/cmdline" % process).split(b"\0")
                environment = dict(word.split(b"=", 1) for word in read("/proc/%d/environ" % process).split(b"\0") if b"=" in word)
                parents[process] = int(read("/proc/%d/stat" % process).rsplit(b")", 1)[1].split()[1])
            except OSError:
                continue  # it has ended
            if b"--slurm-task" in words and b"SLURM_ARRAY_TASK_ID" in environment:
                found[process] = int(environment[b"SLURM_ARRAY_TASK_ID"])
        return [(process, task) for process, task in found.items() if parents[process] not in found]

    def kill_one(self):
        """Kills a running task; returns its number, or None when none could be caught before it had finished."""
        for process, task in self.tasks():
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGSTOP)
                if task not in self.points():
                    os.kill(process, signal.SIGKILL)
                    return task
                os.kill(process, signal.SIGCONT)
        return None


def lose_tasks_and_owner(sweep):
    """The numbers of the two tasks."""
    owner = sweep.start()
    try:
        wait_for(lambda: sweep.submission(1).get("job"), "the array")
        check(len(sweep.submission(1)["tasks"]) == POINTS, "the array is not one of %d tasks" % POINTS)
        cancelled = POINTS - 1  # one that waits
        subprocess.run(["scancel", "%s_%d" % (sweep.submission(1)["job"], cancelled)], env=sweep.cluster.environment, check=True)
        killed = []
        wait_for(lambda: killed.append(sweep.kill_one()) or killed[-1] is not None, "a task that can be killed")
        wait_for(lambda: len(sweep.points()) >= 10, "some points")
    finally:
        owner.kill()
        owner.communicate()
    return {killed[-1], cancelled}


def go_on(sweep, lost):
    """In one more array, or in two if Slurm learns later that one task is gone."""
    owner = sweep.start()
    again = set()

    def ended():
        for number in (2, 3):
            again.update(job for task in sweep.submission(number).get("tasks", []) for job in task)
        return owner.poll() is not None

    wait_for(ended, "the end of the sweep", 600)
    out, errors = owner.communicate()
    check(owner.returncode == 0, "exit %d: %s" % (owner.returncode, errors.decode()))
    check(again == lost, "submitted again: %s, lost: %s" % (again, lost))
    check(b" of 200 points are there already\n" in errors, errors.decode())
    return out


def regress(sweep):
    """Runs of a regression behave the same."""
    words = ["regress", "s.yaml", "--set", "user_cpu.fsmc.datast=2..5", "--no-progress", "--out"]
    verdicts = []
    for more in (["regress_here"], ["regress_out", "--slurm"]):
        done = subprocess.run([sweep.program, *words, *more], cwd=sweep.folder, env=sweep.cluster.environment, capture_output=True, text=True,
                              check=True)
        verdicts.append([line.split("\t")[:7] for line in done.stdout.splitlines()])
    check(verdicts[0] == verdicts[1] and len(verdicts[0]) == 5, "regress says something else: %s" % verdicts)


def verify_rtl(sweep):
    """RTL of one's own is built once, and its runs behave the same; the array's tasks find the build."""
    rtl = os.path.join(ROOT, "examples", "own_rtl")
    words = ["verify-rtl", "--rtl", rtl, "--top", "board_chip", "--pins", os.path.join(rtl, "pins.yaml"), "--only", "scenarios,random", "--cycles", "20000",
             "s.yaml", "--no-progress", "--out"]
    tables = []
    for more in (["rtl_here"], ["rtl_out", "--slurm"]):
        done = subprocess.run([sweep.program, *words, *more], cwd=sweep.folder, env=sweep.cluster.environment, capture_output=True, text=True, check=False)
        check(done.returncode == 1, "the pulse counter of the example has no reset: %s" % done.stderr)
        tables.append([[field for i, field in enumerate(line.split("\t")) if i != 7] for line in done.stdout.splitlines()])  # without seconds
    check(tables[0] == tables[1] and len(tables[0]) == 3, "verify-rtl says something else: %s" % tables)


def main(program):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_slurm_") as folder:
        with open(os.path.join(folder, "s.yaml"), "w", encoding="UTF-8") as file:
            file.write(SCENARIO)
        os.mkdir(os.path.join(folder, "cluster"))
        with Cluster(os.path.join(folder, "cluster")) as cluster:
            sweep = Sweep(program, folder, cluster)
            here = subprocess.run(sweep.command("here"), cwd=folder, check=True, capture_output=True).stdout
            out = go_on(sweep, lose_tasks_and_owner(sweep))
            check(out == here.replace(b"here/", b"out/"), "it says something else than a sweep that was carried out here")
            for name in ("results.csv", "map.svg"):
                check(read(folder, "out", name) == read(folder, "here", name), name + " is another one")
            regress(sweep)
            if shutil.which("verilator"):
                verify_rtl(sweep)
            left = sorted(os.listdir(os.path.join(folder, "out")))
            check(left == ["map.svg", "points", "results.csv", "sweep.json"], "left: %s" % left)
            check(sweep.points() == set(range(POINTS)) and len(os.listdir(os.path.join(folder, "out", "points"))) == POINTS, "points")


if __name__ == "__main__":
    main(os.path.abspath(sys.argv[1]))
