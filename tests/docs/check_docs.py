#!/usr/bin/env python3
"""The documents against the project they describe: one line a fault, exit 1 when there is any.

    check_docs.py links            relative links and their anchors exist
    check_docs.py files            files named in backquotes exist
    check_docs.py mentions         pages of docs/ that sources name, in comments, texts and help, exist, and so do their headings
    check_docs.py table            the tables of docs/README.md name every document of docs/
    check_docs.py trust            the figures of README.md are those of docs/
    check_docs.py snippets         code after a comment "from FILE" is in that file
    check_docs.py bare             the times in README.md are those of docs/trust/bare.tsv, and its commands those that were measured
    check_docs.py update_bare      writes these times again
    check_docs.py packages         the tables of docs/install.md are those of packages.txt and ./run deps --commands
    check_docs.py marks            each ruling of docs/chip.md, chip_rsu.md and spc3.md has its anchor and one mark, which says how far the documents support it
    check_docs.py house            docs/img/house.svg is drawn from the table of arrows in docs/architecture.md
    check_docs.py picture SIM      docs/img/power_on_12m.svg and handshake.svg are drawn from what dsdpv1-sim writes
    check_docs.py update SIM       writes the figures of README.md, the pictures and the tables again

--root FOLDER: another project than the one this file is in. Python's standard library only.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import commands

SCENARIO = "scenarios/power_on_12m.yaml"
PICTURES = ["docs/img/power_on_12m.svg", "docs/img/handshake.svg"]  # as draw_wave.py takes them
HOUSE = ["docs/architecture.md", "docs/img/house.svg"]
FENCE = re.compile(r"^```.*?^```", re.M | re.S)
# Folders in which a file may be named from, besides the root and the document's own.
ROOMS = ["model", "tb", "docs"]
ENDINGS = "md|py|cpp|hpp|c|h|sv|svh|rdl|yaml|gsd|txt|cmake"
GENERATED = ("out/", "build/", ".venv/")


def documents(root):
    """The project's own documents; symbolic links are not part of it."""
    found = [*root.glob("*.md"), *root.glob("docs/**/*.md"), *root.glob("*/README.md")]
    return sorted(path for path in found if not path.is_symlink())


def fault(root, path, text, at, words):
    line = text.count("\n", 0, at) + 1
    return f"{path.relative_to(root)}:{line}: {words}"


def prose(text):
    """The text without its code blocks, every character at its place."""
    return FENCE.sub(lambda block: re.sub(r"[^\n]", " ", block.group()), text)


# --------------------------------------------------------------------------------------------------------------- links
def anchors(text):
    """GitHub's anchors of the headings, and those that the text sets itself."""
    yield from re.findall(r'<a id="([^"]+)"></a>', text)
    for heading in re.findall(r"^#+ +(.+)$", prose(text), re.M):
        yield re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def check_links(root):
    for path in documents(root):
        text = path.read_text(encoding="utf-8")
        for link in re.finditer(r"\]\(([^)\s]+)\)", prose(text)):
            target, _, anchor = link.group(1).partition("#")
            if re.match(r"\w+:", target):
                continue  # somewhere else in the world
            file = path if target == "" else path.parent / target
            if not file.exists():
                yield fault(root, path, text, link.start(), f"the link {target} leads nowhere")
            elif anchor and anchor not in anchors(file.read_text(encoding="utf-8")):
                yield fault(root, path, text, link.start(), f"no heading of {file.name} has the anchor #{anchor}")


# --------------------------------------------------------------------------------------------------------------- files
def is_path(word, folders):
    """A file or folder of the project by its form: begins with one of the folders, or has a known ending."""
    if not re.fullmatch(r"[\w.\-/*]+", word) or word.startswith(GENERATED):
        return False
    folder, slash, _ = word.partition("/")
    return folder in folders if slash else bool(re.fullmatch(rf"[\w\-]+\.({ENDINGS})", word))


def check_files(root):
    folders = {each.name for room in ["", *ROOMS] for each in (root / room).glob("*") if each.is_dir()}
    names = {each.name for top in folders - {"build", "out", ".venv", ".git"} for each in (root / top).glob("**/*")}
    for path in documents(root):
        text = path.read_text(encoding="utf-8")
        for word in re.finditer(r"`([^`\n]+)`", prose(text)):
            name = word.group(1)
            if not is_path(name, folders):
                continue
            places = [root, path.parent, *(root / room for room in ROOMS)]
            if any(any(place.glob(name.rstrip("/"))) for place in places) or ("/" not in name and name in names | commands.files(text).keys()):
                continue
            yield fault(root, path, text, word.start(), f"there is no {name}")


# ------------------------------------------------------------------------------------------------------------ mentions
MENTION = re.compile(r"(?<![\w./])docs/([\w/]+\.md)(?:#([\w\-]+))?")
SOURCES = {".c", ".cmake", ".cpp", ".h", ".hpp", ".inc", ".in", ".lua", ".py", ".rdl", ".sh", ".sv", ".svh", ".toml", ".txt", ".yaml", ""}


def sources(root):
    """The project's own, but the tests beside this file, whose small projects have other pages."""
    for top in sorted(root.glob("[a-zA-Z]*")):
        for path in [top] if top.is_file() else top.rglob("*") if top.name not in ("build", "out", "traces") else ():
            if path.suffix in SOURCES and path.is_file() and not (path.parent == root / "tests/docs" and path.name.endswith("_test.py")):
                yield path


def check_mentions(root):
    headings = {path.relative_to(root / "docs").as_posix(): set(anchors(path.read_text(encoding="utf-8"))) for path in (root / "docs").rglob("*.md")}
    for path in sources(root):
        text = path.read_bytes().decode("utf-8", "replace")
        for mention in MENTION.finditer(text):
            page, anchor = mention.groups()
            if page not in headings:
                yield fault(root, path, text, mention.start(), f"there is no docs/{page}")
            elif anchor and anchor not in headings[page]:
                yield fault(root, path, text, mention.start(), f"no heading of docs/{page} has the anchor #{anchor}")


# -------------------------------------------------------------------------------------------------------- docs/README.md
def check_table(root):
    text = (root / "docs/README.md").read_text(encoding="utf-8")
    rows = set(re.findall(r"^\| \[[^\]]+\]\(([^)#]+)\) \|", text, re.M))
    for path in sorted([*(root / "docs").glob("*.md"), *(root / "docs/tutorials").glob("*.md")]):
        name = path.relative_to(root / "docs").as_posix()
        if name not in rows | {"README.md"}:
            yield f"docs/README.md:1: the tables of documents have no row for docs/{name}"


# --------------------------------------------------------------------------------------------------------------- trust
TRUST = re.compile(r"(<!-- trust: [^\n]*-->\n)(.*?)(?=<!-- /trust -->)", re.S)


def figure(root, page, pattern):
    """The groups of the pattern's only place in a page."""
    found = re.findall(pattern, (root / f"docs/{page}.md").read_text(encoding="utf-8"), re.M)
    if len(found) != 1:
        sys.exit(f"docs/{page}.md:1: {pattern} is there {len(found)} times, README.md takes its figures from there")
    return found[0]


def trust(root):
    """The section of README.md, from the pages that runs have written."""
    sheet, manual, rulings = (figure(root, "conformance", rf"^\| {name} \| (\d+) \| (\d+) ") for name in ("The DSDPV1 datasheet[^|]*", "The user software manual[^|]*", "Rulings"))
    passed, run = figure(root, "conformance", r"(\d+) of all (\d+) tests passed")
    cycles = figure(root, "trust", r"^[\d-]+: ([\d ]+) cycles, [\d.]+ % of the goal\. No difference\.$")
    planted = re.findall(r"(\d+) of (\d+) found\.$", (root / "docs/trust.md").read_text(encoding="utf-8"), re.M)
    found, faults = (sum(int(each[side]) for each in planted) for side in (0, 1))
    killed, mutants = figure(root, "conformance", r"^(\d+) of (\d+) mutants are found by each of their rows")
    speed, faster = (figure(root, "performance", rf"^\| `{row}` \| ([\d.]+) \| at least") for row in ("demo", "core_vs_rtl"))
    met, goals = figure(root, "performance", r"^(\d+) of (\d+) goals are met\.$")
    return f"""- **Against the documents**: {sheet[1]} of {sheet[0]} clauses of the datasheet, {manual[1]} of {manual[0]} of the software manual and {rulings[1]} of {rulings[0]} rulings have tests, the other
  clauses a reason why not. In the recorded run {passed} of {run} tests passed. The tests that a clause or ruling names find {killed} of {mutants} mutants of the model
  ([conformance](docs/conformance.md)).
- **Against RTL**: model and reference RTL agree in every pin change over {cycles} cycles of random stimulus; tests find {found} of {faults} faults planted into
  SystemC modules, driver, checks and board ([trust](docs/trust.md)).
- **Speed**: the demo runs at {speed} times real time, the core {faster} times as fast as the RTL; {met} of {goals} goals are met ([performance](docs/performance.md)).
- **Against silicon**: nothing yet, no chip was measured. `calibrate` compares a capture of one ([how](docs/calibrate.md)).
"""


def check_trust(root):
    text = (root / "README.md").read_text(encoding="utf-8")
    block = TRUST.search(text)
    if block.group(2) != trust(root):
        yield fault(root, root / "README.md", text, block.start(), "the figures of docs/ are others: ./run generate")


def update_trust(root):
    path = root / "README.md"
    path.write_text(TRUST.sub(lambda block: block.group(1) + trust(root), path.read_text(encoding="utf-8")), encoding="utf-8")


# ------------------------------------------------------------------------------------------------------------ snippets
def check_snippets(root):
    for path in documents(root):
        text = path.read_text(encoding="utf-8")
        for snippet in re.finditer(r"<!-- from (\S+) -->\n```\w*\n(.*?)^```", text, re.M | re.S):
            if snippet.group(2) not in (root / snippet.group(1)).read_text(encoding="utf-8"):
                yield fault(root, path, text, snippet.start(), f"this is not in {snippet.group(1)} (any more)")


def simulate(root, sim, *arguments):
    return subprocess.run([sim, "run", SCENARIO, "--no-progress", *arguments], cwd=root, check=True, text=True,
                          stdout=subprocess.PIPE).stdout


def draw(root, sim, folder):
    """The pictures of one run, into a folder."""
    with tempfile.TemporaryDirectory() as waves:
        simulate(root, sim, "-q", "--wave", f"{waves}/waves.vcd")
        subprocess.run([sys.executable, root / "docs/img/draw_wave.py", f"{waves}/waves.vcd", *(folder / name for name in PICTURES)], check=True)


def draw_house(root, picture):
    subprocess.run([sys.executable, root / "docs/img/draw_house.py", root / HOUSE[0], picture], check=True)


def stale(root, folder, names):
    return [f"{name}:1: stale; ./run generate draws it again" for name in names if (folder / name).read_bytes() != (root / name).read_bytes()]


def check_picture(root, sim):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "docs/img").mkdir(parents=True)
        draw(root, sim, pathlib.Path(folder))
        return stale(root, pathlib.Path(folder), PICTURES)


def check_house(root):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "docs/img").mkdir(parents=True)
        draw_house(root, pathlib.Path(folder, HOUSE[1]))
        return stale(root, pathlib.Path(folder), HOUSE[1:])


# --------------------------------------------------------------------------------------------------------------- sweep
SWEEP = ["scenarios/bus_timing.yaml", "--set", "user_cpu.fsmc.mode=A", "--param", "user_cpu.fsmc.datast=0..15",
         "--param", "user_cpu.fsmc.addset=0..3", "--map", "TIMING_TS"]
SWEEP_PICTURE = "docs/img/sweep_fsmc.svg"
SWEEP_BLOCK = re.compile(r"(<!-- sweep -->\n```\n)(.*?)(```\n<!-- /sweep -->)", re.S)


def sweep(root, sim):
    """The table and the picture of docs/sweep.md, from a run of its command."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "out")
        table = subprocess.run([sim, "sweep", *SWEEP, "--no-progress", "--out", out], cwd=root, check=True, text=True,
                               stdout=subprocess.PIPE).stdout
        return table[:table.index("  written:")].strip("\n") + "\n", (out / "map.svg").read_bytes()


def check_sweep(root, sim):
    path = root / "docs/sweep.md"
    text = path.read_text(encoding="utf-8")
    table, picture = sweep(root, sim)
    if "dsdpv1-sim sweep " + " ".join(SWEEP) not in text:
        yield "docs/sweep.md:1: the command of the table and the picture is missing"
    if SWEEP_BLOCK.search(text).group(2) != table:
        yield fault(root, path, text, SWEEP_BLOCK.search(text).start(2), "stale; ./run generate writes it anew")
    if (root / SWEEP_PICTURE).read_bytes() != picture:
        yield f"{SWEEP_PICTURE}:1: stale; ./run generate draws it anew"


def update_sweep(root, sim):
    path = root / "docs/sweep.md"
    table, picture = sweep(root, sim)
    path.write_text(SWEEP_BLOCK.sub(lambda block: block.group(1) + table + block.group(3),
                                    path.read_text(encoding="utf-8")), encoding="utf-8")
    (root / SWEEP_PICTURE).write_bytes(picture)


# ------------------------------------------------------------------------------------------------------------- regress
REGRESS = ["scenarios/bus_timing.yaml", "--set", "user_cpu.fsmc.mode=A", "--set", "user_cpu.fsmc.datast=0..3"]
REGRESS_BLOCK = re.compile(r"(<!-- regress -->\n```\n)(.*?)(```\n<!-- /regress -->)", re.S)


def regress(root, sim):
    """The table of docs/regress.md, from a run of its command; some runs of it fail."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "out")
        return subprocess.run([sim, "regress", *REGRESS, "--no-progress", "--out", out], cwd=root, check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


def without_seconds(table):
    return re.sub(r"\t\d+\.\d{3}\t", "\t0\t", table)


def check_regress(root, sim):
    path = root / "docs/regress.md"
    text = path.read_text(encoding="utf-8")
    if "dsdpv1-sim regress " + " ".join(REGRESS) + "\n" not in text:
        yield "docs/regress.md:1: the command of the table is missing"
    block = REGRESS_BLOCK.search(text)
    if without_seconds(block.group(2)) != without_seconds(regress(root, sim)):
        yield fault(root, path, text, block.start(2), "stale; ./run generate writes it anew")


def update_regress(root, sim):
    path = root / "docs/regress.md"
    text = path.read_text(encoding="utf-8")
    table, block = regress(root, sim), REGRESS_BLOCK.search(text)
    if without_seconds(table) != without_seconds(block.group(2)):  # else the seconds alone would change the file
        path.write_text(text[:block.start(2)] + table + text[block.end(2):], encoding="utf-8")


# ------------------------------------------------------------------------------------------------------------- packages
INSTALL = "docs/install.md"
PACKAGES = re.compile(r"(<!-- packages: [^\n]*-->\n)(.*?)(?=<!-- /packages -->)", re.S)


def commands_of_run(root):
    return subprocess.run([root / "run", "deps", "--commands"], check=True, text=True, stdout=subprocess.PIPE).stdout


def tables_of_packages(root):
    """Commands that need the same groups are one row."""
    commands = {}
    for line in commands_of_run(root).splitlines():
        command, groups = line.split("\t")
        commands.setdefault(groups, []).append(f"`{command}`")
    groups = re.findall(r"^# (.*)\n\[(\w+)\]\n((?:\w.*\n)+)", (root / "packages.txt").read_text(encoding="utf-8"), re.M)
    return ("| `./run` | groups |\n|---|---|\n" + "".join(f"| {', '.join(names)} | {each} |\n" for each, names in commands.items()) +
            "\n| group | packages | what they are |\n|---|---|---|\n" + "".join(f"| {name} | {' '.join(names.split())} | {what} |\n" for what, name, names in groups))


# ---------------------------------------------------------------------------------------------------------------- bare
BARE = re.compile(r"(<!-- bare: [^\n]*-->\n)(.*?)(?=<!-- /bare -->)", re.S)
MEASURED = ["apt-get install ./dsdpv1_*.deb", "dsdpv1-sim demo", "pip install ./dsdpv1-*.whl", "python -m dsdpv1 demo", "./run demo"]


def about(seconds):
    return f"{seconds} s" if seconds < 120 else f"{(seconds + 30) // 60} min"


def bare(root):
    """The times of README.md, as ./run release --record has measured them."""
    lines = (root / "docs/trust/bare.tsv").read_text(encoding="utf-8").splitlines()[1:]
    rows = {row[2]: row for row in (line.split("\t") for line in lines)}
    deb, wheel = (about(int(rows[way][5]) + int(rows[way][6])) for way in ("deb", "wheel"))
    source, when = rows["source"], rows["deb"]
    return f"""From a bare Debian 12 to the end of the table, downloads included: package {deb}, wheel {wheel}. The first `./run demo` installs {packages_of_demo(root)} packages ({source[3]} with dependencies,
{source[4]} MB, {about(int(source[5]))}) and compiles for {source[7]} s of processor time, half of that on two idle cores. Later ones begin at once. Measured on {when[0]} with {when[8]} processors and a load of {when[9]}.
"""


def check_bare(root):
    text = (root / "README.md").read_text(encoding="utf-8")
    block = BARE.search(text)
    if block.group(2) != bare(root):
        yield fault(root, root / "README.md", text, block.start(), "docs/trust/bare.tsv has other times: ./run generate")
    for command in MEASURED:
        if command not in text:
            yield f"README.md:1: ./run release --record measures {command}, which is not here"


def update_bare(root):
    path = root / "README.md"
    path.write_text(BARE.sub(lambda block: block.group(1) + bare(root), path.read_text(encoding="utf-8")), encoding="utf-8")
    return []


def packages_of_demo(root):
    """How many packages.txt names for it."""
    groups = re.search(r"^demo\t(.*)$", commands_of_run(root), re.M).group(1).split()
    named = re.findall(r"^\[(\w+)\]\n((?:\w.*\n)+)", (root / "packages.txt").read_text(encoding="utf-8"), re.M)
    return sum(len(names.split()) for name, names in named if name in groups)


def check_packages(root):
    text = (root / INSTALL).read_text(encoding="utf-8")
    block = PACKAGES.search(text)
    if block.group(2) != tables_of_packages(root):
        yield fault(root, root / INSTALL, text, block.start(), "packages.txt and ./run deps --commands say otherwise: ./run generate")


def update_packages(root):
    path = root / INSTALL
    path.write_text(PACKAGES.sub(lambda block: block.group(1) + tables_of_packages(root), path.read_text(encoding="utf-8")), encoding="utf-8")


# --------------------------------------------------------------------------------------------------------------- marks
RULING = re.compile(r'^- \*\*([A-Z]+\d+)\*\*(?:<a id="([^"]+)"></a>)? ?(?:\[([^\]]*)\])?(?= |$)', re.M)
MARKS = ("documented", "documented in part", "firmware", "departed", "silent")


def check_marks(root):
    for path in sorted([*(root / "docs").glob("chip*.md"), *(root / "docs").glob("spc3.md")]):
        text = path.read_text(encoding="utf-8")
        for ruling in RULING.finditer(text):
            name, anchor, mark = ruling.groups()
            if anchor != name.lower():
                yield fault(root, path, text, ruling.start(), f"{name} has {f'the anchor {anchor}' if anchor else 'no anchor'}, expected {name.lower()}")
            if mark not in MARKS:
                what = f"has the mark [{mark}]" if mark else "has no mark"
                yield fault(root, path, text, ruling.start(), f"{name} {what}, expected one of {', '.join(MARKS)}")


def update(root, sim):
    update_trust(root)
    draw(root, sim, root)
    draw_house(root, root / HOUSE[1])
    update_sweep(root, sim)
    update_regress(root, sim)
    update_packages(root)
    update_bare(root)
    return []


def main():
    here = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=here)
    parser.add_argument("what", choices=["links", "files", "mentions", "table", "trust", "snippets", "bare", "update_bare", "packages", "marks", "house", "picture", "sweep", "regress", "update"])
    parser.add_argument("sim", nargs="?")
    arguments = parser.parse_args()
    with_sim = {"picture": check_picture, "sweep": check_sweep, "regress": check_regress, "update": update}
    without = {"links": check_links, "files": check_files, "mentions": check_mentions, "table": check_table, "trust": check_trust,
               "snippets": check_snippets, "bare": check_bare, "update_bare": update_bare, "packages": check_packages, "marks": check_marks, "house": check_house}
    if arguments.what in with_sim:
        if arguments.sim is None:
            parser.error(f"{arguments.what} needs the path of dsdpv1-sim")
        faults = list(with_sim[arguments.what](arguments.root, str(pathlib.Path(arguments.sim).resolve())))
    else:
        faults = list(without[arguments.what](arguments.root))
    print("\n".join(faults) if faults else f"{arguments.what}: right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
