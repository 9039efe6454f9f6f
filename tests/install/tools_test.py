#!/usr/bin/env python3
"""The installed programs: they run with the installed files; manual page and completions match the program.

    tools_test.py STAGE what        what: runs, version, manual, completion
"""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def call(*command, status=0, **more):
    done = subprocess.run(command, check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **more)
    assert done.returncode == status, f"{command}: exit {done.returncode}\n{done.stdout}"
    return done.stdout


def options_of(help_text):
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", "\n".join(re.findall(r"^  (-[^ ].*?)(?:  |$)", help_text, re.M))))


def commands_of(sim):
    return re.findall(r"^  ([a-z][a-z-]*)  ", call(sim, "--help"), re.M)


def check_runs(stage, sim):
    """Data is found beside the program: a scenario only installed there can be used by name."""
    data = stage / "share/dsdpv1"
    shutil.copy(data / "scenarios/power_on_12m.yaml", data / "scenarios/only_here.yaml")
    try:
        words = call(sim, "traces", "check", "only_here", status=2)
        assert str(data / "traces/only_here") in words, words
    finally:
        (data / "scenarios/only_here.yaml").unlink()
    with tempfile.TemporaryDirectory() as folder:
        assert "PASSED" in call(sim, "run", data / "scenarios/power_on_12m.yaml", "--wave", "w.fst", cwd=folder)
        call(sim, "traces", "check", "power_on_12m", cwd=folder)
        call(sim, "rtl-random", "--cycles", "20000", cwd=folder)
        assert "PASSED" in call(sim, "run", data / "scenarios/arm_board_12m.yaml", cwd=folder)
        assert "power_on_12m" in call(sim, "traces", "list", cwd=folder)
    former = call(str(stage / "libexec/dsdpv1/dsdpv1-board"), "--version")
    assert former == "dsdpv1-board is deprecated and goes with 0.5: use dsdpv1-sim, which it is\n" + call(sim, "--version"), former


def check_version(stage, sim):
    """The version is defined in one place, and is the same everywhere."""
    version = call(sim, "--version").split()[-1]
    told = {each.name: re.search(r"^Version: (.*)$", each.read_text(), re.M)[1] for each in stage.rglob("*.pc")}
    assert len(told) >= 7 and set(told.values()) == {version}, (version, told)
    config = next(stage.rglob("dsdpv1-config-version.cmake")).read_text()
    assert f'set(PACKAGE_VERSION "{version}")' in config
    assert f"\n## [{version}] - " in (stage / "share/doc/dsdpv1/CHANGELOG.md").read_text(), f"CHANGELOG.md lacks {version}"


def check_manual(stage, sim):
    page = gzip.decompress((stage / "share/man/man1/dsdpv1-sim.1.gz").read_bytes()).decode()
    assert page == call(sim, "manual")
    with tempfile.NamedTemporaryFile("w", suffix=".1") as file:
        file.write(page)
        file.flush()
        shown = call("man", "--warnings", "-E", "UTF-8", "-l", file.name, env={"MANWIDTH": "120", "LC_ALL": "C.UTF-8", "PATH": "/usr/bin:/bin"})
    assert "warning" not in shown.lower(), shown[:2000]
    words = re.sub(r"\s+", " ", shown)
    for command in commands_of(sim):
        for option in options_of(call(sim, command, "--help")):
            assert option in words, f"the manual page lacks {option} of {command}"


BASH = """source {file}
COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
_dsdpv1_sim; printf '%s\\n' "${{COMPREPLY[@]}}" """


def completed(file, *words):
    quoted = " ".join(f"'{word}'" for word in words)
    return set(call("bash", "-c", BASH.format(file=file, words=quoted)).split())


# The arguments that the function would pass to zsh's _arguments.
ZSH = """_arguments() {{ print -rl -- "$@" }}
f() {{ words=(dsdpv1-sim {command} -) CURRENT=3; source {file} }}; f"""


def zsh_options(file, command):
    given = call("zsh", "-f", "-c", ZSH.format(file=file, command=command)).splitlines()
    assert given[-1] == "*:file:_files" and all("]" in each for each in given[:-1]), given
    return {each.lstrip("*").partition("[")[0] for each in given[:-1]}


def check_completion(stage, sim):
    bash = stage / "share/bash-completion/completions/dsdpv1-sim"
    zsh = stage / "share/zsh/site-functions/_dsdpv1-sim"
    assert bash.read_text() == call(sim, "completion", "bash")
    assert zsh.read_text() == call(sim, "completion", "zsh")
    commands = set(commands_of(sim))
    assert len(commands) > 10
    assert completed(bash, "dsdpv1-sim", "") == commands | options_of(call(sim, "--help"))
    assert completed(bash, "dsdpv1-sim", "rec") == {"recover"}
    assert completed(bash, "dsdpv1-sim", "run", "") == set(), "files are the shell's own"
    for command in commands:
        options = options_of(call(sim, command, "--help"))
        assert options == {word for dash in ("-", "--") for word in completed(bash, "dsdpv1-sim", command, dash)}, command
        assert options == zsh_options(zsh, command), command
    call(sim, "completion", "fish", status=2)


def main():
    stage = pathlib.Path(sys.argv[1]).resolve()
    {"runs": check_runs, "version": check_version, "manual": check_manual, "completion": check_completion}[sys.argv[2]](stage, str(stage / "bin/dsdpv1-sim"))
    print(f"{sys.argv[2]}: right")


if __name__ == "__main__":
    main()
