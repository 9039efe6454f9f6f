"""Builds programs with one fault beside a finished build: files that depend on the faulty file are compiled again; the other objects are those of
the build.

Neither the sources nor the build are changed. The faulty file is in a separate folder, which the compiler searches first.
"""
import pathlib
import re
import shlex
import subprocess

FASTER = {"-O2": "-O1", "-O3": "-O1"}  # is compiled once and runs for seconds
NOT_TAKEN = ("-Werror", "-MD")
MAKES = r" -o (\S+)| qc (\S+\.a) "  # of a compiler or linker; of the archiver
WITH_A_WORD = ("-MT", "-MF")


class Failed(Exception):
    """The target that could not be built."""


class Build:
    """A finished build by ninja: the command for each of its files, and its inputs."""

    def __init__(self, folder, root):
        self.folder, self.root = pathlib.Path(folder), pathlib.Path(root)
        self.commands = {}  # for each product: object, archive, program
        self.users = self.read_dependencies()

    def ninja(self, *words):
        return subprocess.run(["ninja", "-C", self.folder, *words], capture_output=True, text=True, check=True).stdout

    def read_dependencies(self):
        """For each file of the project, the objects that have read it."""
        users, made = {}, None
        for line in self.ninja("-t", "deps").splitlines():
            if not line.startswith("    "):
                made = line.split(":", 1)[0]
            elif line.strip().startswith(f"{self.root}/"):
                users.setdefault(line.strip()[len(str(self.root)) + 1:], []).append(made)
        return users

    def know(self, program):
        """Reads the commands that make a program and its parts."""
        if program in self.commands:
            return
        for line in self.ninja("-t", "commands", program).splitlines():
            made = re.search(MAKES, line)
            if made:
                self.commands[made.group(1) or made.group(2)] = line

    def words(self, made):
        """The command of the compiler or the archiver alone, without preceding and following ones."""
        return shlex.split(next(part for part in self.commands[made].split(" && ") if re.search(MAKES, part)))

    def program(self, target):
        """The path of a test program, relative to the build's folder."""
        return next(str(path.relative_to(self.folder)) for path in (self.folder / "tests").rglob(target) if path.is_file())


class Overlay:
    """The build with one fault, in a separate folder."""

    def __init__(self, build, fault, folder):
        self.build, self.fault, self.folder = build, fault, pathlib.Path(folder)
        self.sources = self.folder / "sources"
        self.place = {}  # new products: object, archive or program of the build
        source = self.sources / fault.file
        source.parent.mkdir(parents=True, exist_ok=True)
        source.write_text(fault.planted(build.root), encoding="utf-8")

    def run(self, words):
        done = subprocess.run(words, cwd=self.build.folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Failed(f"{self.fault.where}: {self.fault.name} cannot be built: " + (done.stderr.strip().splitlines() or ["?"])[0])

    def new_place(self, made):
        path = self.folder / "build" / made
        path.parent.mkdir(parents=True, exist_ok=True)
        self.place[made] = str(path)
        return str(path)

    def compiled_from(self, source):
        """The faulty file itself, or a file of the build that includes it together with others."""
        file = self.build.folder / source
        if file == self.build.root / self.fault.file:
            return str(self.sources / self.fault.file)
        text = file.read_text(encoding="utf-8")
        there = f'"{self.build.root / self.fault.file}"'
        if there not in text:
            return source
        together = self.folder / file.name
        together.write_text(text.replace(there, f'"{self.sources / self.fault.file}"'), encoding="utf-8")
        return str(together)

    def compile(self, made):
        words = self.build.words(made)
        source = words[words.index("-c") + 1]
        precompiled = any("cmake_pch" in word for word in words)  # of the same optimisation
        kept, skip = [], False
        for word in words:
            if not skip and word not in NOT_TAKEN and word not in WITH_A_WORD:
                kept.append(word if precompiled else FASTER.get(word, word))
            skip = word in WITH_A_WORD
        kept[kept.index("-o") + 1] = self.new_place(made)
        kept[kept.index("-c") + 1] = self.compiled_from(source)
        first = next(i for i, word in enumerate(kept) if word.startswith("-I"))
        beside = (self.build.root / self.fault.file).parent  # for includes of the faulty file without a folder
        self.run([*kept[:first], f"-I{self.sources}", "-iquote", str(beside), *kept[first:]])

    def archive(self, made):
        """True when it contains an object that depends on the faulty file."""
        words = self.build.words(made)
        members = [word for word in words if word.endswith(".o")]
        if not [member for member in members if self.update(member)]:
            return False
        self.run([words[0], "qc", self.new_place(made), *(self.place.get(member, member) for member in members)])
        return True

    def update(self, made):
        """Makes a file of the build again if it depends on the faulty one; returns whether it does."""
        if made in self.place:
            return True
        if made.endswith(".o"):
            depends = made in self.build.users.get(self.fault.file, ())
            if depends:
                self.compile(made)
            return depends
        return made.endswith(".a") and made in self.build.commands and self.archive(made)

    def link(self, program):
        """The path of the program with the fault; None when the fault is not in it."""
        if program in self.place:
            return self.place[program]
        self.build.know(program)
        words = self.build.words(program)
        if not [made for made in dict.fromkeys(words) if self.update(made)]:
            return None
        output = self.new_place(program)
        words = [self.place.get(word, word) for word in words]
        words[words.index("-o") + 1] = output
        self.run(words)
        return output
