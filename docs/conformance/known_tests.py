"""The names of the tests that the project has, read from its sources: nothing need be built for it."""
import re


def existing_tests(root):
    """Suites and tests of GoogleTest, and the tests that CMake adds by name."""
    tests = set()
    for path in [*root.glob("tests/**/*.cpp"), *root.glob("examples/*.cpp")]:
        for suite, test in re.findall(r"^\s*TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", path.read_text(encoding="utf-8"), re.M):
            tests.add(f"{suite}.{test}")
    for path in [*root.glob("tests/**/CMakeLists.txt"), *root.glob("examples/CMakeLists.txt")]:
        text = path.read_text(encoding="utf-8")
        tests.update(re.findall(r"add_test\(NAME ([\w.]+)", text))
        wrapper = r"^function\((\w+) name.*?add_test\(NAME ([\w.]*\$\{name\})"
        for function, pattern in re.findall(wrapper, text, re.M | re.S):
            for name in re.findall(rf"^\s*{function}\(([\w.]+)", text, re.M):
                tests.add(pattern.replace("${name}", name))
    return tests | {test.split(".")[0] for test in tests}


def named_in(text):
    """Tests are named in text by backquotes; a word in them that begins with a capital is one."""
    return re.findall(r"`([A-Z]\w*|\w+\.[A-Z]\w*|examples\.\w+)`", text)


class KnownTests:
    def __init__(self, root):
        self.root = root
        self.names = existing_tests(root)
        self.names |= {name.split(".")[-1] for name in self.names}  # a test that many suites have

    def has(self, name):
        return (self.root / name).exists() if "/" in name else name in self.names
