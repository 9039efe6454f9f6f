#!/usr/bin/env python3
"""find_package reports missing items: a component, and one required by another.

    components_test.py CMAKE STAGE FOLDER
"""
import pathlib
import shutil
import subprocess
import sys

cmake, stage, folder = (pathlib.Path(each) for each in sys.argv[1:])


def refusal(components, missing=""):
    """CMake's message, as one line, for components with the targets of one missing."""
    prefix = folder / "prefix"
    shutil.rmtree(folder, ignore_errors=True)
    (config,) = stage.glob("lib*/**/dsdpv1-config.cmake")
    shutil.copytree(config.parent, prefix / config.parent.relative_to(stage))
    for targets in prefix.glob(f"lib*/**/dsdpv1-{missing}-targets*.cmake"):
        targets.unlink()
    script = folder / "find.cmake"
    script.write_text(f"cmake_minimum_required(VERSION 3.25)\nfind_package(dsdpv1 REQUIRED COMPONENTS {components})\n", encoding="utf-8")
    done = subprocess.run([cmake, f"-DCMAKE_PREFIX_PATH={prefix}", "-P", script], capture_output=True, text=True, check=False)
    assert done.returncode != 0, components
    return " ".join(done.stderr.split())


for component in ("dpi", "python"):
    said = refusal(component, missing="capi")
    assert f"component {component} needs component capi, which is not installed here" in said, said
said = refusal("capi", missing="capi")
assert "component capi is not installed here, expected " in said, said
