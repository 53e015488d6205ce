#!/usr/bin/env python3
"""Draws 60 pieces of the project's prose at random and prints them, numbered, to be read aloud.

    tests/house/sample_words.py --seed N

Twelve of each kind, each with the place where it stands:
    comment    a whole comment of app, core, drivers and tests
    message    what the program says: in tr(), translate(), fail() and refused() of app, core and drivers, and in the
               shipped protocols
    heading    a title of a document, or of a table or figure of a result or report
    change     an entry of CHANGELOG.md
    commit     the subject of one of the newest 100 commits

The measure: somebody who does not know the code reads them, once. 54 of 60 should be plain at that reading. The same seed
draws the same pieces from the same tree.
"""
import argparse
import pathlib
import random
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
EACH = 12
COMMITS = 100


def files(folders, endings):
    found = [path for folder in folders for path in (ROOT / folder).rglob("*")]
    return sorted(path for path in found if path.suffix in endings and path.is_file())


def place(path, text, at):
    return f"{path.relative_to(ROOT)}:{text.count(chr(10), 0, at) + 1}"


COMMENT = re.compile(r"(^|.*?[\s;,{}()])//[/!]?<?[ \t]+(.*)")


def comments():
    """A comment goes on in the lines below that have nothing but its next words, at or behind where it began."""
    for path in files(["app", "core", "drivers", "tests"], {".h", ".cpp", ".c"}):
        lines = path.read_text().splitlines()
        at = 0
        while at < len(lines):
            first = at
            at += 1
            found = COMMENT.fullmatch(lines[first])
            if not found or found[1].count('"') % 2:
                continue
            code, words = found[1].strip(), found[2]
            while at < len(lines) and (more := COMMENT.fullmatch(lines[at])) and not more[1].strip() \
                    and (not code or len(more[1]) > len(found[1]) - 4):
                words += " " + more[2]
                at += 1
            code = code or next((line.strip() for line in lines[at:at + 1]), "")
            if not words.startswith(("clang-format", "NOLINT", "Thread-safety:")) and len(words.split()) > 2:
                yield words, f"{path.relative_to(ROOT)}:{first + 1}, {code}" if code else place(path, "", 0)


LITERALS = r'("(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*)'
SAID = re.compile(r"\b(?:tr|translate|fail|refused)\((?:[^;()\"]|\([^;()\"]*\))*(?:\w+\()?" + LITERALS)
OF_SCRIPTS = re.compile(r"\b(?:label|purpose)\s*:\s*" + LITERALS + r"|\b(?:confirm|ask|log|Error)\(" + LITERALS)


def joined(literals):
    return re.sub(r'\\(.)', r'\1', re.sub(r'"\s*"', "", literals).strip('"')).replace("\n", " ")


def messages():
    for folders, endings, said in ((["app", "core", "drivers"], {".h", ".cpp"}, SAID),
                                   (["resources/protocols"], {".js"}, OF_SCRIPTS)):
        for path in files(folders, endings):
            text = path.read_text()
            for found in said.finditer(text):
                words = joined(next(group for group in found.groups() if group))
                if len(words.split()) > 2:
                    yield words, place(path, text, found.start())


TITLE = re.compile(r'\breport\.(?:table|figure)\(\s*' + LITERALS)
OF_RESULTS = re.compile(r'\b(?:rows|facts)\(\s*' + LITERALS)


def headings():
    for path in [ROOT / "README.md", ROOT / "CONTRIBUTING.md"] + files(["resources"], {".md"}):
        text = path.read_text()
        for found in re.finditer(r"^#+ (.*)$", text, re.M):
            yield found[1], place(path, text, found.start())
    for folders, endings, title in (["resources/protocols"], {".js"}, TITLE), (["core"], {".h", ".cpp"}, OF_RESULTS):
        for path in files(folders, endings):
            text = path.read_text()
            for found in title.finditer(text):
                yield joined(found[1]), place(path, text, found.start())


def changes():
    path = ROOT / "CHANGELOG.md"
    text = path.read_text()
    for found in re.finditer(r"^- (.*(?:\n  .*)*)", text, re.M):
        yield re.sub(r"\n\s+", " ", found[1]), place(path, text, found.start())


def commits():
    words = ["git", "-c", "safe.directory=*", "log", "--no-merges", f"-{COMMITS}", "--format=%h %s"]
    try:  # sources without git, or without their history, have none
        log = subprocess.run(words, cwd=ROOT, check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return
    for line in log.stdout.splitlines():
        name, subject = line.split(" ", 1)
        yield subject, name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, required=True, metavar="N", help="another number draws other pieces")
    draw = random.Random(parser.parse_args().seed)
    number = 0
    for kind in (comments, messages, headings, changes, commits):
        pieces = list(kind())
        for words, where in draw.sample(pieces, min(EACH, len(pieces))):
            number += 1
            print(f"{number}. [{kind.__name__[:-1]}] {words}  ({where})")


if __name__ == "__main__":
    main()
