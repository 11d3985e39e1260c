#!/usr/bin/env python3
"""Checks the layout rules of the sources: check_style.py [ROOT].

Prints one line per problem (file:line: message), then the procedure lengths; exit code 1 if
there is a problem. It reads Fortran by statements, not by grammar: where it cannot tell, it
says nothing."""

import argparse
import re
import subprocess
import sys
from pathlib import Path

import startup

MAX_COLUMNS = 96
MAX_FILE_LINES = 500
MAX_PROCEDURE_LINES = 100  # code lines: neither blank nor comment
MAY_SAVE = "base_signal.f90"  # a signal handler can reach nothing but a saved variable
MAY_STOP = {"src/run/main.f90", "src/base/base_checks.F90"}  # a failed assertion stops
NAMELESS_LAYERS = ("linalg", "cone", "contact", "assembly", "run")  # of time schemes
UNTRACKED = {"build", "bin", ".venv", ".git", "__pycache__"}
NO_FINAL_NEWLINE_NEEDED = {".k", ".tab"}  # decks may be malformed on purpose
# Spelled so that this file does not hold what it looks for.
ABSOLUTE_PATH = re.compile(r"(?<![\w.})\]*~-])/(?:work|home|root)/")

TYPE = re.compile(
    r"^(?:integer|real|complex|logical|character|double\s+precision|"
    r"(?:type|class|procedure)\s*\()"
)
PROCEDURE = re.compile(
    r"^(?:(?:pure|elemental|impure|recursive|module|"
    r"(?:integer|real|complex|logical|character|double\s+precision|type|class)"
    r"\s*(?:\((?:[^()]|\([^()]*\))*\))?)\s+)*"
    r"(?:subroutine|function)\s+(\w+)\s*(?:\(([^()]*)\))?"
)
CLOSING = re.compile(
    r"^end\s*(?:(?:subroutine|function|module|program|interface|type)"
    r"(?:\s+\w+(?:\s*\(.*\))?)?)?$"
)
STOP = re.compile(r"(?:^|\)\s*)(?:error\s*)?stop\b(?!\s*[=(%])")
GOTO = re.compile(r"(?:^|\)\s*)go\s*to\s*[\d(]")
COMMON = re.compile(r"^common\s*(?:/|\w)")
USE = re.compile(r"^use(?:\s*,\s*(?:non_)?intrinsic)?\s*(?:::\s*|\s)\s*(\w+)\s*(.*)$")

problems = []
lengths = []


def problem(path, line, message):
    problems.append((str(path), line, message))


class Scope:
    """A module, program, procedure, interface or derived type that is open while reading."""

    def __init__(self, kind, name, line, dummies=()):
        self.kind, self.name, self.line = kind, name, line
        self.dummies = list(dummies)
        self.declared = {}  # dummy: whether its declaration is complete
        self.code_lines = 0
        self.contains = False
        self.statements = set()
        self.public, self.openings = set(), {}


def strip_line(line, quote):
    """Returns the code of a line with strings emptied, and the quote that it leaves open."""
    code = []
    i = 0
    if quote:
        i = len(line) - len(line.lstrip())
        i += line[i : i + 1] == "&"
    while i < len(line):
        c = line[i]
        if quote:
            if c == quote:
                quote = None
                code.append(c)
            elif c == "&" and not line[i + 1 :].strip():
                return "".join(code) + "&", quote
        elif c == "!":
            break
        else:
            code.append(c)
            if c in "'\"":
                quote = c
        i += 1
    return "".join(code).strip(), None


def read_statements(lines):
    """Yields (first line, number of code lines, text) of each statement, continuations
    joined."""
    text, first, quote, count = "", 0, None, 0
    for number, line in enumerate(lines, 1):
        if line.startswith("#"):
            continue
        in_string = quote is not None
        code, quote = strip_line(line, quote)
        code = code if in_string else code.lower()
        if not code:
            continue
        count += 1
        if text and not in_string and code.startswith("&"):
            code = code[1:]
        first = first or number
        text += code.rstrip("&") if in_string else " " + code.rstrip("&").strip()
        if code.endswith("&"):
            continue
        for part in text.lower().split(";"):
            if part.strip():
                yield first, count, re.sub(r"^\d+\s+", "", part.strip())
                count = 0
        text, first, count = "", 0, 0


def split_list(text):
    """Splits at commas outside parentheses."""
    parts, depth, start = [], 0, 0
    for i, c in enumerate(text):
        depth += (c in "([") - (c in ")]")
        if c == "," and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return [part.strip() for part in parts + [text[start:]] if part.strip()]


def has_doc(lines, number):
    """A block of comment lines ends right above the line, and one of it starts with !>."""
    for line in reversed(lines[: number - 1]):
        if not line.lstrip().startswith("!"):
            return False
        if line.lstrip().startswith("!>"):
            return True
    return False


class Checker:
    """Reads the statements of one Fortran file."""

    def __init__(self, path, lines):
        self.path, self.lines = path, lines
        self.in_src = path.parts[0] == "src"
        self.stack = []

    def say(self, line, message):
        problem(self.path, line, message)

    def run(self):
        for line, count, text in read_statements(self.lines):
            for scope in reversed(self.stack):
                if scope.kind in ("procedure", "program"):
                    scope.code_lines += count
                    break
            self.read(line, count, text)

    def read(self, line, count, text):
        self.check_words(line, text)
        if CLOSING.match(text):
            if self.stack:
                self.close(self.stack.pop())
            return
        opened = self.opening(line, text)
        if opened:
            opened.code_lines = count
            self.stack.append(opened)
        elif self.stack:
            self.read_inside(self.stack[-1], line, text)

    def check_words(self, line, text):
        if GOTO.search(text):
            self.say(line, "goto is not allowed")
        if COMMON.match(text):
            self.say(line, "common is not allowed")
        if self.in_src and self.path.as_posix() not in MAY_STOP and STOP.search(text):
            self.say(line, "stop belongs to main and to tests")
        use = USE.match(text)
        if use and not re.match(r",\s*only\s*:", use.group(2)):
            self.say(line, f"use {use.group(1)} needs an only list")

    def opening(self, line, text):
        """The scope that the statement opens, if it opens one."""
        found = PROCEDURE.match(text)
        if found:
            name, dummies = found.group(1), found.group(2) or ""
            parent = self.stack[-1] if self.stack else None
            if parent and parent.kind == "module":
                parent.openings.setdefault(name, line)
            if parent and parent.kind == "interface" and len(self.stack) > 1:
                self.stack[-2].declared[name] = True  # a dummy declared by its interface
            kind = "body" if parent and parent.kind == "interface" else "procedure"
            return Scope(kind, name, line, re.findall(r"\w+", dummies))
        found = re.match(r"^(module|program)\s+(\w+)$", text)
        if found and found.group(2) != "procedure":
            return Scope(found.group(1), found.group(2), line)
        found = re.match(r"^(?:abstract\s+)?interface(?:\s+(\w+(?:\s*\(.*\))?))?$", text)
        if found:
            if self.stack and found.group(1):
                self.stack[-1].openings.setdefault(found.group(1), line)
            return Scope("interface", "", line)
        if re.match(r"^type\s*(?:,.*::\s*\w+|::\s*\w+|\s+(?!is\b)\w+)(?:\s*\(.*\))?$", text):
            return Scope("type", "", line)
        return None

    def read_inside(self, scope, line, text):
        scope.statements.add(text)
        if text == "contains":
            scope.contains = True
        public = re.match(r"^public\b\s*(?:::)?\s*(.+)$", text)
        if public and scope.kind == "module":
            scope.public.update(split_list(public.group(1)))
        names = re.match(
            r"^(?:intent|value|pointer|external)\b.*?(?:::|\s)\s*([\w\s,]+)$", text
        )
        if names:
            scope.declared.update(dict.fromkeys(re.findall(r"\w+", names.group(1)), True))
        if self.in_src and self.path.name != MAY_SAVE and scope.kind != "type":
            if re.match(r"^save\b(?!\s*[=(%])", text) or re.match(r"^data\s+\w[^=]*/", text):
                self.say(line, "save and data are not allowed")
        if (
            not scope.contains
            and scope.kind in ("module", "program", "procedure", "body")
            and TYPE.match(text)
        ):
            self.read_declaration(scope, line, text)

    def read_declaration(self, scope, line, text):
        head, separator, entities = text.partition("::")
        if not separator:
            return
        attributes = [re.match(r"\w*", part).group() for part in split_list(head)]
        complete = head.startswith("procedure") or {
            "intent",
            "value",
            "pointer",
            "external",
        } & set(attributes)
        entities = split_list(entities)
        for entity in entities:
            name = re.match(r"\w*", entity).group()
            scope.declared[name] = bool(complete) or scope.declared.get(name, False)
        if not self.in_src or self.path.name == MAY_SAVE or "parameter" in attributes:
            return
        if "save" in attributes:
            self.say(line, "save is not allowed")
        elif scope.kind == "module":
            self.say(line, "a module variable must be a parameter")
        elif scope.kind == "procedure":
            for entity in entities:
                if "=" in re.sub(r"\((?:[^()]|\([^()]*\))*\)", "", entity):
                    self.say(
                        line, f"initialising {entity.split()[0]} here saves it between calls"
                    )

    def close(self, scope):
        if scope.kind in ("procedure", "program"):
            if scope.kind == "procedure" and self.in_src:
                lengths.append(scope.code_lines)
            if scope.code_lines > MAX_PROCEDURE_LINES:
                self.say(
                    scope.line,
                    f"{scope.name} has {scope.code_lines} lines of code, "
                    f"more than {MAX_PROCEDURE_LINES}",
                )
        for dummy in scope.dummies:
            if not scope.declared.get(dummy, True):
                self.say(scope.line, f"argument {dummy} of {scope.name} needs an intent")
        if scope.kind == "module":
            for needed in ("implicit none", "private"):
                if needed not in scope.statements:
                    self.say(scope.line, f"module {scope.name} needs the statement: {needed}")
            for name in sorted(scope.public & scope.openings.keys() if self.in_src else ()):
                if not has_doc(self.lines, scope.openings[name]):
                    self.say(scope.openings[name], f"public {name} needs a !> comment above it")


def check_layout(path, lines, fortran):
    for number, line in enumerate(lines, 1):
        if "\t" in line:
            problem(path, number, "tab")
        if line != line.rstrip():
            problem(path, number, "trailing blank")
        if fortran and len(line) > MAX_COLUMNS:
            problem(path, number, f"{len(line)} columns, more than {MAX_COLUMNS}")
    if fortran and len(lines) > MAX_FILE_LINES:
        problem(path, 1, f"{len(lines)} lines, more than {MAX_FILE_LINES}")


def project_files(root):
    """Tracked files and those about to be; without git, all but what the build makes."""
    if (root / ".git").exists():
        names = subprocess.run(
            [
                "git",
                "-C",
                str(root),
                "ls-files",
                "-z",
                "--cached",
                "--others",
                "--exclude-standard",
            ],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.split("\0")
    else:
        names = (p.relative_to(root).as_posix() for p in root.rglob("*"))
    for name in sorted(set(names)):
        path = Path(name)
        if name and not UNTRACKED & set(path.parts) and (root / path).is_file():
            yield path


def check_file(root, path):
    try:
        text = (root / path).read_bytes().decode()
    except UnicodeDecodeError:
        return  # not text
    if "\0" in text:
        return
    lines = text.removesuffix("\n").split("\n")
    for number, line in enumerate(lines, 1):
        if ABSOLUTE_PATH.search(line):
            problem(path, number, "absolute path of somebody's machine")
    if text and not text.endswith("\n") and path.suffix not in NO_FINAL_NEWLINE_NEEDED:
        problem(path, len(lines), "no newline at the end of the file")
    folder = path.parts[0]
    fortran = path.suffix in (".f90", ".F90") and folder in ("src", "tests", "examples")
    if fortran or path.suffix in (".sh", ".py") and folder in ("scripts", "tests"):
        check_layout(path, lines, fortran)
    if fortran:
        if folder == "src" and len(path.parts) != 3:
            problem(path, 1, "the build sees only src/LAYER/FILE")
        Checker(path, lines).run()


def scheme_names(root):
    """Names of the time schemes, from the one table that has them."""
    path = root / "src" / "deck" / "deck_schemes.f90"
    return re.findall(r"scheme_traits_t\('(\w+)'", path.read_text()) if path.exists() else []


def check_scheme_names(root):
    """What serves every scheme knows none by name, not even in a comment or a message."""
    names = scheme_names(root)
    if not names:
        return
    word = re.compile(r"\b(?:%s)\b" % "|".join(names), re.IGNORECASE)
    for layer in NAMELESS_LAYERS:
        for path in sorted((root / "src" / layer).glob("*.?90")):
            for number, line in enumerate(path.read_text().split("\n"), start=1):
                found = word.search(line)
                if found:
                    name = found.group().upper()
                    problem(path.relative_to(root), number, f"names the scheme {name}")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "root", nargs="?", type=Path, default=Path(startup.ROOT), metavar="ROOT"
    )
    root = parser.parse_args().root.resolve()
    for path in project_files(root):
        check_file(root, path)
    check_scheme_names(root)
    for path, line, message in sorted(problems):
        print(f"{path}:{line}: {message}")
    if lengths:
        lengths.sort()
        print(
            f"{len(lengths)} procedures, lines of code: median {lengths[len(lengths) // 2]}, "
            f"95 % within {lengths[(len(lengths) * 95 - 1) // 100]}, longest {lengths[-1]}"
        )
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
