#!/usr/bin/env python3
"""Installs the files of a release in a bare Debian 12 and runs the demo there; with --record also the sources, and what that takes becomes rows of
docs/trust/bare.tsv.

    bare_system.py RELEASE WORK [--record]      RELEASE: what cmake/release.py has made; WORK keeps what debootstrap has fetched

Each way has a system of its own: no documents are installed there, as in images for containers, and no compiler. Exit code 77 where no such system can be made.
"""
import argparse
import contextlib
import datetime
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD = ROOT / "docs/trust/bare.tsv"
NOT_TRIED = 77
SUITE = "bookworm"
MIRROR = "http://deb.debian.org/debian"
NO_DOCUMENTS = "path-exclude=/usr/share/doc/*\npath-exclude=/usr/share/man/*\n"
QUIET = "apt-get -q -y -o Dpkg::Use-Pty=0"
PASSED_ON = re.compile(r"^(PIP_CERT|PIP_INDEX_URL|SSL_CERT_FILE|\w+_proxy)$", re.I)  # how this machine reaches the registries


class NotTried(Exception):
    """Why there can be no bare system."""


class Wrong(Exception):
    """What did not do what it should."""


def require(right, words):
    if not right:
        raise Wrong(words)


# ------------------------------------------------------------------------------------------------------------- the system
def base(work):
    """A bare Debian as an archive, made once."""
    archive = work / f"{SUITE}.tar"
    if archive.exists():
        return archive
    if os.geteuid() != 0:
        raise NotTried("a bare Debian is made by root alone: sudo ./run release --check")
    if not shutil.which("debootstrap", path="/usr/sbin:/sbin:" + os.environ["PATH"]):
        raise NotTried("debootstrap is missing: ./run deps release")
    cache, root = work / "cache", work / "base"
    cache.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(root, ignore_errors=True)
    made = subprocess.run(["debootstrap", "--variant=minbase", f"--cache-dir={cache}", SUITE, root, MIRROR], check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if made.returncode != 0:
        raise NotTried("debootstrap could not: " + (made.stdout.strip().splitlines() or ["without a word"])[-1])
    subprocess.run(["tar", "-C", root, "-cf", f"{archive}.new", "."], check=True)
    os.replace(f"{archive}.new", archive)
    shutil.rmtree(root)
    return archive


class Bare:
    """One, gone when it is left."""

    def __init__(self, work, name):
        self.root = work / name
        shutil.rmtree(self.root, ignore_errors=True)
        self.root.mkdir()
        subprocess.run(["tar", "-C", self.root, "-xf", base(work)], check=True)
        self._environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive",
                             **{name: value for name, value in os.environ.items() if PASSED_ON.match(name)}}
        shutil.copy("/etc/resolv.conf", self.root / "etc/resolv.conf")
        (self.root / "etc/dpkg/dpkg.cfg.d/no_documents").write_text(NO_DOCUMENTS, encoding="utf-8")
        shutil.rmtree(self.root / "usr/share/doc")
        self._bring_certificates()

    def _bring_certificates(self):
        for name in ("PIP_CERT", "SSL_CERT_FILE"):
            if name in self._environment:
                shutil.copy(self._environment[name], self.root / name)
                self._environment[name] = f"/{name}"

    def call(self, command, status=0):
        """A line of the shell, in /root; its processes have their own /proc, which ends with them."""
        inside = f"mount -t proc proc {self.root}/proc && exec chroot {self.root} sh -c 'cd && exec sh -c \"$0\"' \"$0\""
        done = subprocess.run(["unshare", "--mount", "--pid", "--fork", "sh", "-c", inside, command], check=False, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, env=self._environment)
        require(done.returncode == status, f"{command}: exit {done.returncode}, not {status}:\n" + "\n".join(done.stdout.splitlines()[-15:]))
        return done.stdout

    def bring(self, path):
        shutil.copy(path, self.root / "root")

    def installed(self):
        return self.call("dpkg-query -W").count("\n")


@contextlib.contextmanager
def bare(work, name):
    system = Bare(work, name)
    try:
        yield system
    finally:
        shutil.rmtree(system.root, ignore_errors=True)


class Watch:
    """What a way takes: packages, and the rest until the table stands there."""

    def __init__(self, system):
        self._system, self._before, self.load = system, system.installed(), os.getloadavg()[0]
        self.packages, self.fetched, self.waited, self.rest, self.processor = 0, 0.0, 0.0, 0.0, 0.0

    def install(self, command):
        began = time.monotonic()
        said = self._system.call(f"{QUIET} update && {command}")
        self.waited += time.monotonic() - began
        self.packages = self._system.installed() - self._before
        for number, unit in re.findall(r"^Need to get ([\d.,]+) (.?B)", said, re.M):  # of more, where some are there
            self.fetched += float(number.replace(",", "")) * {"B": 1e-6, "kB": 1e-3, "MB": 1, "GB": 1e3}[unit]
        return said

    def do(self, command):
        began, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
        said = self._system.call(command)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.rest += time.monotonic() - began
        self.processor += after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return said


# ------------------------------------------------------------------------------------------------------------------ ways
def check_table(said, system, folder):
    require("DP state WAIT_CFG to DATA_EXCH" in said and "\nPASSED\n" in said, f"the demo prints:\n{said}")
    ((wave, others),) = re.findall(r"^Files: /(\S+), (.+)$", said, re.M)
    for file in [wave, *(os.path.splitext(wave)[0] + ending for ending in others.split(", "))]:
        require(file.startswith(folder) and (system.root / file).stat().st_size > 10000, f"the demo leaves no /{file}")


def bring_checked(release, system, pattern):
    for file in (*release.glob(pattern), release / "SHA256SUMS"):
        system.bring(file)
    system.call("sha256sum --check --strict --ignore-missing SHA256SUMS")


def try_deb(release, system):
    bring_checked(release, system, "*.deb")
    watch = Watch(system)
    watch.install(f"{QUIET} install ./dsdpv1_*.deb")
    check_table(watch.do("dsdpv1-sim demo"), system, "root/out/")
    require(not (system.root / "usr/share/doc/dsdpv1").exists(), "documents are there: this is not the system that it is meant to be")
    system.call("dsdpv1-sim demo && touch file")  # again, over its own files
    for wrong, words in (("--out file", "cannot be made"), ("--out /proc/1/x", "cannot be made"), ("now", "unexpected argument now")):
        said = system.call(f"dsdpv1-sim demo {wrong}", status=2)
        require(words in said and said.count("\n") == 1, f"dsdpv1-sim demo {wrong} says: {said}")
    check_table(system.call("python3 -m dsdpv1 demo --out python"), system, "root/python/")  # Debian's Python
    system.call("dsdpv1-sim gsd /usr/share/dsdpv1/scenarios/dsdpv1.gsd && dsdpv1-sim run sync_freeze")
    return watch


def try_wheel(release, system):
    bring_checked(release, system, "*.whl")
    watch = Watch(system)
    watch.install(f"{QUIET} install --no-install-recommends python3-venv")
    watch.do("python3 -m venv venv && venv/bin/pip install -q ./dsdpv1-*.whl")
    check_table(watch.do("venv/bin/python -m dsdpv1 demo"), system, "root/out/")
    system.call("venv/bin/python -m dsdpv1 demo && touch file")
    check_table(system.call("python3 -m zipfile -e dsdpv1-*.whl alone && PYTHONPATH=alone python3 -m dsdpv1 demo --out alone/out"), system, "root/alone/")  # without NumPy
    said = system.call("venv/bin/python -m dsdpv1", status=2)
    require("demo" in said and "usage: python -m dsdpv1" in said, f"python -m dsdpv1 prints: {said}")
    for wrong, words in (("demo --out file", "--out FOLDER"), ("demo --out /proc/1/x", "--out FOLDER"), ("dmeo", "'dmeo'"), ("demo now", "unrecognized arguments: now")):
        said = system.call(f"venv/bin/python -m dsdpv1 {wrong}", status=2)
        require(words in said and said.count("\n") == 1, f"python -m dsdpv1 {wrong} says: {said}")
    system.call("venv/bin/python -c 'import dsdpv1; assert len(dsdpv1.run(\"venv/lib/python3.11/site-packages/dsdpv1/demo/power_on_12m.yaml\", changes=True).changes) > 1000000'")
    return watch


def try_source(_, system):
    """The last commit."""
    archive = subprocess.run(["git", "-C", ROOT, "archive", "HEAD"], check=True, stdout=subprocess.PIPE).stdout
    (system.root / "root/dsdpv1").mkdir()
    subprocess.run(["tar", "-C", system.root / "root/dsdpv1", "-x"], input=archive, check=True)
    watch = Watch(system)
    groups = re.search(r"^demo\t(.*)$", system.call("dsdpv1/run deps --commands"), re.M)[1]
    said = watch.install(f"dsdpv1/run deps {groups}")
    watch.fetched = float(re.search(r"with dependencies\), ([\d.]+) MB", said)[1])
    check_table(watch.do("dsdpv1/run demo"), system, "root/dsdpv1/out/")
    return watch


WAYS = {"deb": try_deb, "wheel": try_wheel, "source": try_source}


def record(rows):
    commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty", "--abbrev=9"], check=True, text=True, stdout=subprocess.PIPE).stdout.strip()
    head, *known = RECORD.read_text(encoding="utf-8").splitlines(keepends=True)
    tried = {way for way, _ in rows}
    head += "".join(line for line in known if line.split("\t")[2] not in tried)
    lines = [f"{datetime.date.today()}\t{commit}\t{way}\t{watch.packages}\t{watch.fetched:.1f}\t{watch.waited:.0f}\t{watch.rest:.0f}\t{watch.processor:.0f}\t{os.cpu_count()}\t{watch.load:.1f}\n"
             for way, watch in rows]
    RECORD.write_text(head + "".join(lines), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("release", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--only", choices=WAYS)
    arguments = parser.parse_args()
    work, rows = arguments.work.resolve(), []
    work.mkdir(parents=True, exist_ok=True)
    ways = [arguments.only] if arguments.only else WAYS if arguments.record else ("deb", "wheel")
    try:
        for way in ways:
            with bare(work, way) as system:
                watch = WAYS[way](arguments.release.resolve(), system)
            rows.append((way, watch))
            print(f"{way}: {watch.packages} packages, {watch.fetched:.1f} MB in {watch.waited:.0f} s; then {watch.rest:.0f} s ({watch.processor:.0f} s of processor) to the end of the demo's table")
    except NotTried as error:
        print(f"not tried: {error}")
        return NOT_TRIED
    except Wrong as error:
        print(f"{way}: {error}")
        return 1
    if arguments.record:
        record(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
