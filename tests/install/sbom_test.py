#!/usr/bin/env python3
"""The installed bill of materials is valid SPDX 2.3, names every program with the hash it has, and says what is in it.

    sbom_test.py STAGE VALIDATOR
"""
import hashlib
import json
import pathlib
import subprocess
import sys

stage, validator = pathlib.Path(sys.argv[1]), sys.argv[2]
(path,) = stage.rglob("dsdpv1.spdx.json")
checked = subprocess.run([validator, "--infile", path, "--version", "SPDX-2.3"], capture_output=True, text=True, check=False)
assert checked.returncode == 0, checked.stderr

document = json.loads(path.read_text(encoding="utf-8"))
packages = {each["SPDXID"]: each for each in document["packages"]}
hashes = {each["name"]: each["checksums"][0]["checksumValue"] for each in packages.values() if "checksums" in each}
assert set(hashes) == {"dsdpv1-sim", "libdsdpv1.so", "libdsdpv1_dpi.so", "dsdpv1.vpi"}, hashes
for name, value in hashes.items():
    (file,) = (each for each in stage.rglob(name) if each.read_bytes().startswith(b"\x7fELF"))
    assert hashlib.sha256(file.read_bytes()).hexdigest() == value, name


def related(name, kind):
    return {packages[each["relatedSpdxElement"]]["name"] for each in document["relationships"]
            if each["relationshipType"] == kind and packages.get(each["spdxElementId"], {}).get("name") == name}


assert {"libfmt-dev", "libsystemc-dev"} <= related("dsdpv1-sim", "DYNAMIC_LINK"), related("dsdpv1-sim", "DYNAMIC_LINK")
assert {"libdw-dev", "libsystemc-dev"} <= set(related("dsdpv1-sim", "DYNAMIC_LINK")) and "libunicorn-dev" not in related("dsdpv1-sim", "DYNAMIC_LINK")
assert "node-d3" in related("dsdpv1-sim", "CONTAINS"), related("dsdpv1-sim", "CONTAINS")
(fmt,) = (each for each in packages.values() if each["name"] == "libfmt-dev")
installed = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "libfmt-dev"], capture_output=True, text=True, check=True).stdout
assert fmt["versionInfo"] == installed and fmt["licenseDeclared"] == "MIT", fmt
