"""The tests that the project has, and the program of each, read from its sources: nothing need be built for it."""
import re

CTEST = "ctest"  # the program of the tests that CMake adds by name, and of scenarios


def programs_of_files(root):
    """(file, program that is made of it), of the files beside their CMakeLists.txt."""
    for path in [*root.glob("tests/**/CMakeLists.txt"), *root.glob("examples/CMakeLists.txt")]:
        text = path.read_text(encoding="utf-8")
        for program, files in re.findall(r"^\s*dsdpv1_\w*test\((\w+)([^)]*)\)", text, re.M):
            for variable in re.findall(r"\$\{(\w+)\}", files):
                files += " ".join(re.findall(rf"^\s*(?:set\(|list\(APPEND ){variable} ([^)]*)", text, re.M))
            yield from ((path.parent / name, program) for name in re.findall(r"[^\s{}]+\.cpp", files) if (path.parent / name).is_file())


def tests_of_programs(root):
    """(suite, test, program)"""
    for path, program in programs_of_files(root):
        for suite, test in re.findall(r"^\s*TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", path.read_text(encoding="utf-8"), re.M):
            yield suite, test, program


def named_by_cmake(root):
    for path in [*root.glob("tests/**/CMakeLists.txt"), *root.glob("examples/CMakeLists.txt")]:
        text = path.read_text(encoding="utf-8")
        yield from re.findall(r"add_test\(NAME ([\w.]+)", text)
        wrapper = r"^function\((\w+) name.*?add_test\(NAME ([\w.]*\$\{name\})"
        for function, pattern in re.findall(wrapper, text, re.M | re.S):
            for name in re.findall(rf"^\s*{function}\(([\w.]+)", text, re.M):
                yield pattern.replace("${name}", name)


def named_in(text):
    """Tests are named in text by backquotes; a word in them that begins with a capital is one."""
    return re.findall(r"`([A-Z]\w*|\w+\.[A-Z]\w*|examples\.\w+)`", text)


class KnownTests:
    def __init__(self, root):
        self.root = root
        self.programs = {}  # of each suite, and each test with its suite
        for suite, test, program in tests_of_programs(root):
            for name in (suite, f"{suite}.{test}"):
                self.programs.setdefault(name, set()).add(program)
        for test in named_by_cmake(root):
            for name in (test, test.split(".")[0]):
                self.programs.setdefault(name, {CTEST})

    def has(self, name):
        return self.is_scenario(name) or name in self.programs

    def is_scenario(self, name):
        return name.startswith("scenarios/") and (self.root / name).is_file()

    def program(self, name):
        """check.py names a test that has none."""
        return CTEST if self.is_scenario(name) else min(self.programs.get(name, {"no program"}))

    def shared(self):
        """Suites that are in several programs, so that a name does not say which test is meant."""
        return {name: sorted(found) for name, found in self.programs.items() if len(found) > 1 and "." not in name}
