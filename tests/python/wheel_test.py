"""Makes the wheel and uses it without the rest of the project.

    wheel_test.py FOLDER [BUILD]    FOLDER keeps the compiled files; BUILD: a build whose library goes into the wheel, else one is compiled.
The preset default compiles the same by the same commands, so the compiler's cache has it.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
USE = """
import pathlib, dsdpv1, dsdpv1._library as library
assert "site" in dsdpv1.__file__, dsdpv1.__file__
assert library._path() == str(pathlib.Path(dsdpv1.__file__).parent / "lib" / "libdsdpv1.so.0"), library._path()
mapped = open("/proc/self/maps").read()
assert "/site/dsdpv1/lib/libyaml-cpp" in mapped, "not the wheel's own libraries"
result = dsdpv1.run("power_on_12m.yaml", changes=True)
assert result.passed and len(result.changes) > 1000000
print(dsdpv1.__version__, len(result.changes))
"""
EDITABLE = """
import os, dsdpv1, dsdpv1._library as library
assert dsdpv1.__file__.startswith(os.environ["ROOT"] + "/bindings/"), dsdpv1.__file__
assert library._path().endswith("site-packages/dsdpv1/lib/libdsdpv1.so.0"), library._path()
print(dsdpv1.__version__, "editable")
"""


def call(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def settings_of(folder, build):
    settings = {"build-dir": folder, **({"cmake.define.DSDPV1_BUILD": build} if build else {})}
    return [word for name, value in settings.items() for word in ("--config-settings", f"{name}={value}")]


def wheel_of(folder, build):
    """The wheel in `folder`."""
    for old in folder.glob("*.whl"):
        old.unlink()
    call(sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--disable-pip-version-check", "-w", folder, *settings_of(folder, build), ROOT)
    return next(folder.glob("*.whl"))


def names_are_right(wheel):
    """One wheel for every Python 3; it contains its dependencies, but neither tests nor sources."""
    names = zipfile.ZipFile(wheel).namelist()
    wanted = ("dsdpv1/__init__.py", "dsdpv1/py.typed", "dsdpv1/lib/libdsdpv1.so.0", "dsdpv1/__main__.py", "dsdpv1/demo/power_on_12m.yaml", "dsdpv1/demo/dsdpv1.gsd", "cocotbext/profibus/__init__.py")
    missing = [name for name in wanted if name not in names]
    assert not missing, f"the wheel has no {', '.join(missing)}"
    assert not [name for name in names if name.startswith("cocotbext/__init__")], "cocotbext is a namespace, shared with others"
    assert wheel.name.split("-")[2:4] == ["py3", "none"], wheel.name
    assert any("libyaml-cpp" in name for name in names) and not any("libc.so" in name or "libstdc++" in name for name in names), names


def licences_are_there(wheel):
    """Of each bundled library the text of the package that it is from."""
    with zipfile.ZipFile(wheel) as file:
        libraries = {name.removeprefix("dsdpv1/lib/") for name in file.namelist() if re.match(r"dsdpv1/lib/[^/]+\.so", name)} - {"libdsdpv1.so.0"}
        assert len(libraries) >= 5, libraries
        for library in libraries:
            package = call("dpkg-query", "-S", f"*-linux-gnu/{library}", stdout=subprocess.PIPE, text=True).stdout.split(":")[0]
            assert b"opyright" in file.read(f"dsdpv1/lib/licences/{package}.txt"), library
        assert b"Niels Lohmann" in file.read("dsdpv1/lib/licences/nlohmann-json3-dev.txt")


def editable_finds_its_library(folder, build, environment, place):
    """pip install -e leaves the package where it is, and its library and generated modules elsewhere."""
    python = place / "venv" / "bin" / "python"
    call(sys.executable, "-m", "venv", place / "venv")
    environment = {**environment, "PYTHONPATH": next(path for path in sys.path if path.endswith("site-packages"))}
    call(python, "-m", "pip", "install", "-q", "--no-deps", "--no-build-isolation", "--disable-pip-version-check", *settings_of(folder, build), "-e", ROOT, env=environment)
    call(python, "-c", EDITABLE, cwd=place, env={**environment, "ROOT": str(ROOT)})


def main(folder, build):
    folder.mkdir(parents=True, exist_ok=True)
    wheel = wheel_of(folder, build)
    names_are_right(wheel)
    licences_are_there(wheel)
    with tempfile.TemporaryDirectory() as place:
        site = pathlib.Path(place) / "site"
        call(sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--disable-pip-version-check", "--target", site, wheel)
        for name in ("power_on_12m.yaml", "dsdpv1.gsd"):
            shutil.copy(ROOT / "scenarios" / name, place)
        environment = {key: value for key, value in os.environ.items() if not key.startswith(("DSDPV1", "PYTHON", "LD_"))}
        call(sys.executable, "-c", USE, cwd=place, env={**environment, "PYTHONPATH": str(site)})
        if build:  # nothing to compile
            editable_finds_its_library(folder / "editable", build, environment, pathlib.Path(place))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else None)
