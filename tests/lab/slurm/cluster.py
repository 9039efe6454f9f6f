"""A Slurm cluster of one node on this computer: munged, slurmctld and slurmd in a separate folder, on free ports, as the calling user. No systemd and
no rights of root are needed. All that it has started ends with it."""
import os
import signal
import socket
import subprocess
import sys
import time

REAPER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "reaper.py")
DEADLINE = 300  # s, for one step
CPUS = 40      # more than this computer has: a small task mostly waits for Slurm

CONF = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1,default_queue_depth=500
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus}
PartitionName=test Nodes=ALL Default=YES State=UP
"""


def program(name):
    """Daemons are in folders that a user's PATH may omit."""
    for folder in (*os.environ["PATH"].split(":"), "/usr/sbin", "/sbin"):
        if os.access(os.path.join(folder, name), os.X_OK):
            return os.path.join(folder, name)
    raise SystemExit("%s is not there: Debian's packages slurmctld, slurmd, slurm-client and munge have it" % name)


def free_ports(count):
    held = [socket.socket() for _ in range(count)]
    for each in held:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in held]
    for each in held:
        each.close()
    return ports


def wait_for(condition, what, deadline=DEADLINE):
    end = time.monotonic() + deadline
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError("waited for %s in vain" % what)
        time.sleep(0.02)


class Cluster:
    def __init__(self, folder):
        self.folder = folder
        self.environment = {**os.environ, "SLURM_CONF": os.path.join(folder, "slurm.conf")}
        self.daemons = []

    def __enter__(self):
        try:
            self.configure()
            munge = os.path.join(self.folder, "munge")
            # forced: the folders above are not open to all users, as those of a service would be
            self.start("munged", "--foreground", "--force", "--key-file=%s/key" % munge, "--socket=%s/socket" % munge, "--pid-file=%s/pid" % munge,
                       "--log-file=%s/log" % munge, "--seed-file=%s/seed" % munge)
            self.wait_for(lambda: os.path.exists(os.path.join(munge, "socket")))
            self.start("slurmctld", "-D")
            self.start("slurmd", "-D")
            self.wait_for(lambda: "idle" in self.call("sinfo", "--noheader", "--format=%t"))
        except BaseException:
            self.__exit__()
            raise
        return self

    def configure(self):
        for name in ("state", "spool", "munge"):
            os.mkdir(os.path.join(self.folder, name), 0o700)
        os.chmod(os.path.join(self.folder, "munge"), 0o711)  # its clients pass
        with open(os.open(os.path.join(self.folder, "munge", "key"), os.O_WRONLY | os.O_CREAT, 0o400), "wb") as key:
            key.write(os.urandom(1024))
        host = socket.gethostname().split(".")[0]
        user = subprocess.run(["id", "-un"], check=True, capture_output=True, text=True).stdout.strip()
        with open(self.environment["SLURM_CONF"], "w", encoding="UTF-8") as conf:
            conf.write(CONF.format(host=host, ports=free_ports(2), user=user, folder=self.folder, cpus=CPUS))

    def start(self, name, *words):
        with open(os.path.join(self.folder, name + ".out"), "wb") as out:
            self.daemons.append(subprocess.Popen([sys.executable, REAPER, program(name), *words], env=self.environment, stdin=subprocess.DEVNULL, stdout=out,
                                                 stderr=out))

    def wait_for(self, condition):
        """Waits; gives up as soon as a daemon has ended."""
        try:
            wait_for(lambda: condition() or any(daemon.poll() is not None for daemon in self.daemons), "a daemon")
        except TimeoutError as error:
            raise SystemExit("the cluster does not come up\n" + self.logs()) from error
        if not condition():
            raise SystemExit("a daemon has ended\n" + self.logs())

    def call(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False).stdout

    def logs(self):
        text = ""
        for name in ("munged", "slurmctld", "slurmd"):
            path = os.path.join(self.folder, name + ".out")
            if os.path.exists(path):
                with open(path, encoding="UTF-8", errors="replace") as file:
                    text += "%s: %s\n" % (name, "".join(file.readlines()[-5:]))
        return text

    def processes(self):
        """Tasks and their processes: recognised by the cluster's configuration in their environment."""
        mark = b"SLURM_CONF=" + self.environment["SLURM_CONF"].encode() + b"\0"
        for number in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open("/proc/%s/environ" % number, "rb") as file:
                    if mark in file.read():
                        yield int(number)
            except OSError:
                pass  # it has ended, or is another user's

    def __exit__(self, *_):
        if len(self.daemons) == 3:
            self.call("scancel", "--me")
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        own = {daemon.pid for daemon in self.daemons} | {os.getpid()}
        for number in set(self.processes()) - own:
            try:
                os.kill(number, signal.SIGKILL)
            except ProcessLookupError:
                pass
