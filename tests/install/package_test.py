#!/usr/bin/env python3
"""The .deb and the .tar.gz made by cpack: the dependencies of the .deb, and that its contents run where they are unpacked, without root.

    package_test.py CPACK BUILD CXX HERE
"""
import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile

NEEDED = ["libc6", "libstdc++6", "libfmt9", "libsystemc", "libyaml-cpp", "libdw1"]


def output(*command, **more):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, **more).stdout


def pack(cpack, build, folder):
    quick = ["-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip"]  # xz takes longer than all the rest
    output(cpack, "--config", build / "CPackConfig.cmake", "-G", "DEB;TGZ", *quick, "-B", folder, cwd=folder)
    return next(folder.glob("*.deb")), next(folder.glob("*.tar.gz"))


def check_control(deb):
    depends = output("dpkg-deb", "-f", deb, "Depends")
    missing = [name for name in NEEDED if name not in depends]
    assert not missing, f"Depends lacks {missing}: {depends}"
    for field in ("Maintainer", "Description", "Section", "Recommends"):
        assert output("dpkg-deb", "-f", deb, field).strip(), f"{field} is missing"


def check_files(names):
    for name in ("bin/dsdpv1-sim", "libexec/dsdpv1/dsdpv1-board", "share/man/man1/dsdpv1-sim.1.gz", "share/doc/dsdpv1/copyright",
                 "share/doc/dsdpv1/CHANGELOG.md", "share/dsdpv1/examples/core_only.cpp", "include/dsdpv1/dsdpv1.h", "lib/python3/dist-packages/dsdpv1/__init__.py", "lib/python3/dist-packages/dsdpv1/demo/power_on_12m.yaml",
                 "share/dsdpv1/bindings/systemverilog/files.txt"):
        assert any(each.endswith("/" + name) for each in names), f"{name} is missing"


def check_unpacked(root, cxx, here, folder):
    data = root / "share/dsdpv1"
    assert "PASSED" in output(root / "bin/dsdpv1-sim", "run", data / "scenarios/power_on_12m.yaml", cwd=folder)
    assert "PASSED" in output(root / "bin/dsdpv1-sim", "demo", cwd=folder)
    assert (root / "lib/python3/dist-packages/dsdpv1/lib/libdsdpv1.so.0").resolve(strict=True).is_relative_to(root.resolve())
    environment = {**os.environ, "PKG_CONFIG_PATH": str(next(root.rglob("pkgconfig")))}
    flags = output("pkg-config", "--cflags", "--libs", "dsdpv1-core", env=environment).split()
    subprocess.run([cxx, "-std=c++17", here / "core/consumer.cpp", *flags, "-o", folder / "consumer"], check=True)
    subprocess.run([folder / "consumer"], check=True)


def main():
    cpack, build, cxx, here = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deb, archive = pack(cpack, build, folder)
        check_control(deb)
        root = folder / "unpacked"
        subprocess.run(["dpkg-deb", "-x", deb, root], check=True)
        check_files([str(path) for path in root.rglob("*")])
        with tarfile.open(archive) as file:
            check_files(file.getnames())
        check_unpacked(root / "usr", cxx, here, folder)
    print("packages: right")


if __name__ == "__main__":
    main()
