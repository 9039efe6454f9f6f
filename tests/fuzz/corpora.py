"""The corpora under version control: few small inputs that reach all the code of larger ones, and former findings."""
import pathlib
import re
import shutil
import subprocess
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent / "corpus"
ROOT = str(pathlib.Path(__file__).resolve().parents[2]).encode()
MOST_BYTES, MOST_INPUTS = 10_000, 60  # of a target
FOUND = "found_"  # names of inputs that were findings; they always stay


def of(name):
    path = FOLDER / name
    path.mkdir(parents=True, exist_ok=True)
    return path


def features(control):
    """The contents of libFuzzer's control file for a merge: the code reached by each input, with its counters."""
    lines = control.read_text(encoding="utf-8").splitlines()
    names = lines[2:2 + int(lines[0])]
    entered = {}
    for line in lines[2 + len(names):]:
        if match := re.fullmatch(r"FT ([0-9]+)((?: [0-9]+)*)", line):
            entered[pathlib.Path(names[int(match.group(1))])] = set(map(int, match.group(2).split()))
    return entered


def chosen(entered, had):
    """The inputs that enter most that is new for their size, as long as there is room."""
    taken, size = [], 0
    rest = {path: more - had for path, more in entered.items()}
    while rest and len(taken) < MOST_INPUTS:
        best = max(rest, key=lambda path: len(rest[path]) / (path.stat().st_size + 16))
        new = rest.pop(best)
        if not new:
            break
        if size + best.stat().st_size > MOST_BYTES:
            continue
        taken.append(best)
        size += best.stat().st_size
        rest = {path: more - new for path, more in rest.items()}
    return taken


def minimise(name, work, call):
    """Chooses among the corpus and `work`, the findings of fuzzing."""
    own = of(name)
    with tempfile.TemporaryDirectory() as folder:
        pool, control, merged = (pathlib.Path(folder) / each for each in ("pool", "control", "merged"))
        pool.mkdir()
        merged.mkdir()
        for path in [*own.iterdir(), *work.iterdir()]:
            if ROOT not in path.read_bytes():  # programs with debug information name the folder that they were compiled in
                shutil.copy(path, pool)
        result = call(name, ["-merge=1", f"-merge_control_file={control}", merged, pool], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if result.returncode:
            raise SystemExit(f"fuzz: {name}: an input of its corpus is a finding, ./run fuzz {name} shows it")
        entered = features(control)
        found = [path for path in entered if path.name.startswith(FOUND)]
        had = set().union(*(entered.pop(path) for path in found))
        taken = chosen(entered, had)
        for path in own.iterdir():
            if not path.name.startswith(FOUND):
                path.unlink()
        for path in taken:
            shutil.copy(path, own / path.name)
    size = sum(path.stat().st_size for path in own.iterdir())
    print(f"{name}\t{len(taken)} inputs and {len(found)} that were found once, {size} bytes")
