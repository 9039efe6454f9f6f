"""The model with all of its mutants in one build, each behind a switch; the product's sources stay free of them.

A tree of links to the project, in which the changed files are texts. A function with mutants has its body once for each, and the right one:
    { if (mutant::is(17)) {...} else if (mutant::is(18)) {...} else {...} }
A constant, a table or an initialiser, outside of a function, takes the changed words where they stand, as (mutant::is(17) ? 0x08 : 0x04), and is no longer
constexpr; nor are the constants that are made of it. DSDPV1_MUTANT is the number of the mutant; without it the program is right.
"""
import difflib
import os
import pathlib
import re

from lists import BadList

HEADER = "model/mutant.hpp"
HEADER_TEXT = """#pragma once
#include <cstdlib>
namespace mutant {
inline bool is(int number) {
  static const int chosen = [] {
    const char* text = std::getenv("DSDPV1_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  return number == chosen;
}
}  // namespace mutant
"""
TOKEN = re.compile(r"0[xX][0-9A-Fa-f']+|\d[\d']*|\w+(?:::\w+)*|::|->|&&|\|\||[<>=!]=|<<|>>|\s+|.", re.S)
BLANKED = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^#[^\n]*', re.S | re.M)
SCOPE = re.compile(r"\b(?:namespace|class|struct|enum|union|extern)\b")
SCOPE_OPENS = re.compile(r"\b(?:namespace|class|struct)\b[^;{}()=]*\{$")
BEFORE_BODY = re.compile(r"(?:[)}]|\bconst|\bnoexcept|\boverride|\bfinal)\s*$")


def blanked(text):
    """The same length, with blanks for comments, strings, and lines of the preprocessor."""
    return BLANKED.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


class Function:
    """Where a function of a file stands: head, then { body }."""

    def __init__(self, head, begin, end):
        self.head, self.begin, self.end = head, begin, end


def functions(code):
    """The outermost ones of a blanked text."""
    found, scopes, boundary, depth = [], [], 0, 0
    for at, letter in enumerate(code):
        if letter == "{":
            head = code[boundary:at]
            if depth:
                depth += 1
            elif "(" in head and BEFORE_BODY.search(head):
                depth, begin = 1, at + 1
            else:
                is_scope = SCOPE.search(head) and "=" not in head and "(" not in head
                scopes.append(is_scope)
                boundary = at + 1 if is_scope else boundary
        elif letter == "}":
            if depth:
                depth -= 1
                if depth == 0:
                    found.append(Function(boundary, begin, at))
                    boundary = at + 1
            elif scopes.pop():
                boundary = at + 1
        elif letter == ";" and not depth and all(scopes):
            boundary = at + 1
    return found


def changed_words(old, new):
    """(old words, new words, offset in old), for places where only words change. What is added belongs to the name before it."""
    old, new = TOKEN.findall(old), TOKEN.findall(new)
    if len(old) == len(new):
        yield from ((old[i], new[i], len("".join(old[:i]))) for i in range(len(old)) if old[i] != new[i])
        return
    for kind, i, j, k, m in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if kind == "equal":
            continue
        if kind == "insert" and i > 0 and re.fullmatch(r"[\w:]+", old[i - 1]):
            i, k = i - 1, k - 1
        if i == j:
            raise ValueError("outside of a function a mutant changes names and numbers, or adds to them")
        yield "".join(old[i:j]), "".join(new[k:m]), len("".join(old[:i]))


class Change:
    """A mutant's place in its file, without the text that stays the same at both ends."""

    def __init__(self, number, fault, text):
        self.number, self.fault = number, fault
        same = len(os.path.commonprefix([fault.replace, fault.by]))
        rest = fault.replace[same:][::-1], fault.by[same:][::-1]
        after = len(os.path.commonprefix(rest))
        self.begin = text.index(fault.replace) + same
        self.end = self.begin + len(rest[0]) - after
        self.by = fault.by[same:len(fault.by) - after]

    def within(self, function):
        return function.begin <= self.begin and self.end <= function.end


class File:
    """A source and its mutants, (number, fault)."""

    def __init__(self, text, faults):
        self.text, self.code = text, blanked(text)
        self.functions = functions(self.code)
        self.changes = [Change(number, fault, text) for number, fault in faults]

    def switched(self):
        edits = []  # (begin, end, new text)
        for function in self.functions:
            inside = [change for change in self.changes if change.within(function)]
            if inside:
                edits += self.with_bodies(function, inside)
        edits += self.with_words([change for change in self.changes if not any(map(change.within, self.functions))])
        text = self.text
        for begin, end, new in sorted(edits, reverse=True):
            text = text[:begin] + new + text[end:]
        return text

    def with_bodies(self, function, changes):
        body, bodies = self.text[function.begin:function.end], ""
        for change in changes:
            begin, end = change.begin - function.begin, change.end - function.begin
            bodies += f" if (::mutant::is({change.number})) {{{body[:begin]}{change.by}{body[end:]}\n}} else"
        yield function.begin, function.end, f"{bodies} {{{body}}}\n"
        yield from self.at_run_time(function.head, function.begin, "inline")

    def with_words(self, changes):
        places = {}
        for change in changes:
            fault, begin = change.fault, self.text.index(change.fault.replace)
            try:
                for old, new, offset in changed_words(fault.replace, fault.by):
                    places.setdefault((begin + offset, old), []).append((change.number, new))
            except ValueError as error:
                raise BadList(f"{fault.where}: {fault.name}: {error}") from None
        for (begin, old), choices in places.items():
            chosen = "".join(f"::mutant::is({number}) ? ({new}) : " for number, new in choices)
            yield begin, begin + len(old), f"({chosen}({old}))"
        for begin in {self.declaration(begin) for begin, _ in places}:
            yield from self.at_run_time(begin, self.code.find(";", begin), "const")

    def declaration(self, at):
        """The begin of the declaration around a place: behind a ; or a block, or at the begin of a scope."""
        depth = 0
        for begin in range(at - 1, -1, -1):
            letter = self.code[begin]
            if letter == "}" and (depth or re.match(r"\s*[,})]", self.code[begin + 1:])):
                depth += 1
            elif letter == "{" and depth:
                depth -= 1
            elif not depth and (letter in ";}" or letter == "{" and SCOPE_OPENS.search(self.code[:begin + 1])):
                return begin + 1
        return 0

    def at_run_time(self, begin, end, instead):
        """The edit that makes a declaration one without constexpr, if it is one with it."""
        found = re.compile(r"\bconstexpr\b").search(self.code, begin, end)
        if found:
            has_inline = re.search(r"\binline\b", self.code[begin:found.start()])
            yield found.start(), found.end(), "inline const" if instead == "const" and not has_inline else instead


CONSTANT = re.compile(r"\bconstexpr [^;{}()=]*?\b(\w+)(?:\[\])? ?(?:= ?|\{)[^;]*;")
SWITCHED = re.compile(r"\b(\w+)(?:\[\])? = (?:\{[^;]*|[^;,]*)?\(::mutant::is")
NAMED = re.compile(r"\b(\w+)\(")  # a function's head


class Demotion:
    """Constants and functions that use one that is no longer constexpr follow it."""

    def __init__(self, texts):
        self.texts = texts
        self.known = set()
        self.more = {name for text in texts.values() for name in SWITCHED.findall(text)}

    def run(self):
        for text in self.texts.values():
            code = blanked(text)
            for function in functions(code):
                if code[function.begin:function.end].lstrip().startswith("if (::mutant::is") and "inline" in code[function.head:function.begin]:
                    self.more.add(NAMED.search(code, function.head).group(1))
        while self.more - self.known:
            self.known |= self.more
            self.texts.update({file: self.follow(text) for file, text in self.texts.items()})

    def uses(self, code):
        return self.known & set(re.findall(r"\w+", code))

    def follow(self, text):
        code, edits = blanked(text), []
        inside = functions(code)
        for found in CONSTANT.finditer(code):
            if self.uses(code[found.end(1):found.end()]):
                local = any(each.begin <= found.start() < each.end for each in inside) or code[:found.start()].endswith("inline ")
                edits.append((found.start(), "const" if local else "inline const"))
                self.more.add(found.group(1))
        for function in inside:
            head = code.find("constexpr", function.head, function.begin)
            if head >= 0 and self.uses(code[function.begin:function.end]):
                edits.append((head, "inline"))
                self.more.add(NAMED.search(code, function.head).group(1))
        for begin, new in sorted(edits, reverse=True):
            text = text[:begin] + new + text[begin + len("constexpr"):]
        return text


def sources(root, faults):
    """The texts of the model with its mutants, which are numbered from 1 in the order of the list."""
    by_file = {}
    for number, fault in enumerate(faults, 1):
        by_file.setdefault(fault.file, []).append((number, fault))
    texts = {}
    for path in sorted((root / "model").rglob("*.[chi]*")):
        file = str(path.relative_to(root))
        text = path.read_text(encoding="utf-8")
        texts[file] = File(text, by_file[file]).switched() if file in by_file else text
    Demotion(texts).run()
    return {**texts, HEADER: HEADER_TEXT}


def write_if_changed(path, text):
    if not path.is_file() or path.is_symlink() or path.read_text(encoding="utf-8") != text:
        path.unlink(missing_ok=True)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def write_tree(root, faults, tree):
    """The project with these mutants; unchanged files keep their time, so that a build continues."""
    tree.mkdir(parents=True, exist_ok=True)
    for path in root.iterdir():
        if path.name not in ("model", "build", ".git") and not (tree / path.name).is_symlink():
            (tree / path.name).symlink_to(path)
    texts = sources(root, faults)
    for path in (root / "model").rglob("CMakeLists.txt"):
        texts[str(path.relative_to(root))] = path.read_text(encoding="utf-8")
    for file, text in texts.items():
        write_if_changed(tree / file, text)
    for path in (tree / "model").rglob("*"):
        if path.is_file() and str(path.relative_to(tree)) not in texts:
            os.unlink(path)
    return pathlib.Path(tree)
