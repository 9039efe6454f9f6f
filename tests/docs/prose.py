#!/usr/bin/env python3
"""Counts the sentences of the pages, and phrases that make a reader stop, in pages, help texts and comments. Exit 1 when a limit is exceeded.

    prose.py           the figures; with an excess each sentence with its file and line
    prose.py --list    all phrases that were found, also without an excess

A sentence ends with . ? or ! before a space, and with its paragraph or item: neither a colon nor a semicolon ends it. Code in backquotes is one word.
Tables, headings and blocks of code have no sentences, but phrases are counted in the cells of tables too.
--root FOLDER: another project than the one this file is in. Python's standard library only.
"""
import argparse
import ast
import collections
import io
import pathlib
import re
import sys
import tokenize

AVERAGE, LONGEST, PAGES_AND_HELP, COMMENTS = "words a sentence, on average", "words of a sentence", "phrases in pages and help", "phrases in comments"
LIMITS = {AVERAGE: 16, LONGEST: 40, PAGES_AND_HELP: 50, COMMENTS: 200}

# The better words, and those that they replace. The first row is about the beginning of a sentence.
FIRST_WORDS = ("a noun as the subject", r"(What|Who|Whoever|Whatever|Whether|Of|As of)\b(?! to do:)(?!.*\?$)")
PHRASES = [
    ("no station, no observer, the passive", r"nobody|anybody|somebody|everybody"),
    ("separate, your, its", r"of (its|their|one's|your|our) own"),
    ("is reported, receives", r"(is|are|was|were) told"),
    ("continues, resumes", r"(goes|go|going|went|gone) on"),
    ("is compared with, is checked by", r"(held|holds?)( \w+)?( \w+)? against|held to"),
    ("instead of", r"in the place of"),
    ("automatically, alone", r"by (itself|themselves)"),
    ("after; behind is for places", r"behind"),
    ("except, similarly, always", r"but for|likewise|as ever|for ever|be it that"),
    ("is not a", r"(?<!there )(is|are) no(?! (longer|more))"),
    ("default", r"left out:"),
    ("expected", r"allowed (is|are)"),
    ("again, depends on, amounts to, checked", r"anew|hangs? on|gives? away|comes to|looked at"),
]
FINDERS = [(instead, re.compile(rf"\b(?:{words})(?!\w)", re.I)) for instead, words in PHRASES]
BEGIN = re.compile(FIRST_WORDS[1])

CODE = {".c", ".cpp", ".h", ".hpp", ".inc", ".sv", ".svh", ".py"}
NOT_READ = {"build", "out"}  # folders of the root
LEAST_WORDS = 3  # fewer are a label
Sentence = collections.namedtuple("Sentence", "file line text")


# ------------------------------------------------------------------------------------------------------------ sentences
def sentences(file, line, text):
    """Those of one paragraph that begins in this line."""
    for found in re.finditer(r"\S.*?(?:[.?!][\"')*\]]*(?=\s)|\Z)", text, re.S):
        sentence = Sentence(file, line + text.count("\n", 0, found.start()), " ".join(found.group().split()))
        if len(sentence.text.split()) >= LEAST_WORDS:
            yield sentence


def blank(found):
    """Nothing, in as many lines."""
    return "\n" * found.group().count("\n")


def paragraphs(text):
    """First line and text of each: lines without an empty one between them, an item of a list alone."""
    begin, lines = 1, []
    for number, line in enumerate([*text.split("\n"), ""], 1):
        item = re.match(r"\s*(?:[-*]|\d+\.)\s+", line)
        if lines and (item or not line.strip()):
            yield begin, "\n".join(lines)
            lines = []
        if line.strip():
            if not lines:
                begin = number
            lines.append(line[item.end():] if item else line)


def read(path):
    return path.read_text(encoding="utf-8", errors="replace")


def prose_of_page(text):
    """Without code, and links as their words."""
    text = re.sub(r"^ *```.*?^ *```|<!--.*?-->|<a id=\"[\w.\-]+\"></a>", blank, text, flags=re.S | re.M)
    text = re.sub(r"`+[^`]+`+", lambda code: "X" + blank(code), text)
    return re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)


def page_sentences(root):
    """Those of paragraphs, and those in the cells of tables."""
    running, cells = [], []
    for path in sorted([*root.glob("*.md"), *root.glob("docs/**/*.md")]):
        name = path.relative_to(root).as_posix()
        lines = prose_of_page(read(path)).split("\n")
        for number, line in enumerate(lines, 1):
            if line.startswith("|"):
                cells += [Sentence(name, number, cell.strip()) for cell in line.split("|") if cell.strip()]
        text = "\n".join("" if line.startswith(("|", "#")) else line for line in lines)
        running += [each for begin, words in paragraphs(text) for each in sentences(name, begin, words)]
    return running, cells


# -------------------------------------------------------------------------------------------------------- help, comments
STRING = r'"(?:[^"\\\n]|\\.)*"'
LINES = r"^[ \t]*//[^\n]*(?:\n[ \t]*//[^\n]*)*"
COMMENT_OR_STRING = re.compile(rf"{STRING}|'(?:[^'\\\n]|\\.)'|{LINES}|//[^\n]*|/\*.*?\*/", re.S | re.M)


def help_sentences(root):
    """The texts in the sources of the program, parts that follow each other joined."""
    for path in sorted(root.glob("apps/**/*.cpp")):
        text = read(path)
        for found in re.finditer(rf"{STRING}(?:\s*{STRING})*", text):
            words = re.sub(r'"\s*"', "", found.group())[1:-1].replace("\\n", " ")
            yield from sentences(path.relative_to(root).as_posix(), text.count("\n", 0, found.start()) + 1, words)


def comments_of_c(text):
    for found in COMMENT_OR_STRING.finditer(text):
        if found.group().lstrip().startswith("/"):
            words = re.sub(r"\*/$|^[ \t]*(?://[/!<]*|/\*+|\*(?!/))(?: SPDX-.*)?", "", found.group(), flags=re.M)
            yield text.count("\n", 0, found.start()) + 1, words


def comments_of_python(text):
    """Comments that follow each other, and the texts that stand alone."""
    last, lines = 0, []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type != tokenize.COMMENT:
            continue
        if token.start[0] != last + 1 and lines:
            yield last - len(lines) + 1, "\n".join(lines)
            lines = []
        last = token.start[0]
        lines.append(token.string.lstrip("#! "))
    if lines:
        yield last - len(lines) + 1, "\n".join(lines)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            yield node.lineno, node.value.value


def code_files(root):
    for folder in sorted(path for path in root.iterdir() if path.is_dir() and path.name not in NOT_READ and not path.name.startswith(".")):
        yield from sorted(path for path in folder.rglob("*") if path.suffix in CODE)


def comment_sentences(root):
    for path in code_files(root):
        for line, words in (comments_of_python if path.suffix == ".py" else comments_of_c)(read(path)):
            for begin, paragraph in paragraphs(words):
                yield from sentences(path.relative_to(root).as_posix(), line + begin - 1, paragraph)


# --------------------------------------------------------------------------------------------------------------- limits
def phrases(found):
    """Sentence, phrase and what to write instead."""
    for sentence in found:
        if begin := BEGIN.match(sentence.text):
            yield sentence, begin.group(), FIRST_WORDS[0]
        for instead, finder in FINDERS:
            for phrase in finder.finditer(sentence.text):
                yield sentence, phrase.group(), instead


def shown(sentence, words):
    return f"{sentence.file}:{sentence.line}: {words}: {sentence.text}"


def marked(hits):
    return [shown(sentence, f"\"{phrase}\", better: {instead}") for sentence, phrase, instead in hits]


def measure(root):
    """The figure of each limit, and the lines that show it."""
    running, cells = page_sentences(root)
    lengths = sorted(((len(each.text.split()), each) for each in running), key=lambda pair: -pair[0])
    average = sum(length for length, _ in lengths) / max(1, len(lengths))
    in_pages, in_comments = list(phrases([*running, *cells, *help_sentences(root)])), list(phrases(comment_sentences(root)))
    return {
        AVERAGE: (round(average, 1), [shown(each, f"{length} words") for length, each in lengths[:10]]),
        LONGEST: (lengths[0][0] if lengths else 0, [shown(each, f"{length} words") for length, each in lengths if length > LIMITS[LONGEST]]),
        PAGES_AND_HELP: (len(in_pages), marked(in_pages)),
        COMMENTS: (len(in_comments), marked(in_comments)),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--list", action="store_true", help="prints all phrases")
    arguments = parser.parse_args()
    figures = measure(arguments.root)
    exceeded = [what for what, (figure, _) in figures.items() if figure > LIMITS[what]]
    for what, (figure, lines) in figures.items():
        if what in exceeded or (arguments.list and what in (PAGES_AND_HELP, COMMENTS)):
            print("\n".join(lines))
    for what, (figure, _) in figures.items():
        print(f"prose: {figure} {what}, at most {LIMITS[what]}" + (": too many" if what in exceeded else ""))
    return 1 if exceeded else 0


if __name__ == "__main__":
    sys.exit(main())
