#!/usr/bin/env python3
"""Mutation fuzzer: small decks with random damage. Standard library only.

    fuzz.py [--count N] [--seed S] [--jobs J] [--keep DIR]

Every mutant is made from (seed, its number) alone, so a failure can be made again. What must
hold: no crash and no run-time error of Fortran, exit code 0 to 3, no file after a deck error
(exit 2), no NaN or infinity in a table, an end within five seconds (a mutant that asks for very
many steps is only read and checked then).
"""

import argparse
import multiprocessing
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LIMIT = 5.0
NUMBERS = [
    "0",
    "-0",
    "1",
    "-1",
    "2147483647",
    "2147483648",
    "-2147483648",
    "1e308",
    "1e309",
    "-1e308",
    "1e-308",
    "1e-320",
    "5e-324",
    "0.0",
    "1.0-3",
    "1d5",
    "nan",
    "inf",
    "1e",
    ".",
    "+",
    "-",
    "&",
    "&x",
    "-&x",
    "1 0",
    "1/2",
    "3*1",
    "1.5",
    "99999999999999999999",
    "1e-5",
    "1e5",
    "0.5",
    "2",
    "3",
    "THETA",
    "NEWMARK",
    "LUMPED",
    "DISPERSION",
    "AUTO",
    "1e20",
    "1e-20",
    "12",
    "13",
]
BYTES = b"\t\r\n $*,&+-.0123456789eEdDnNaA\x00\x7f\xe9\xff\"'"
KEYWORDS = []


def corpus():
    """{name: bytes} of the decks to damage, all small and short."""
    decks = {}
    for folder in ("tests/bad_decks", "tests/fuzz/decks", "input/cards", "input/lessons"):
        path = os.path.join(ROOT, folder)
        for name in sorted(os.listdir(path)) if os.path.isdir(path) else ():
            if name.endswith(".k"):
                with open(os.path.join(path, name), "rb") as file:
                    decks[folder + "/" + name] = file.read()
    return decks


def mutate_bytes(rng, text):
    """A few bytes changed, dropped or put in."""
    data = bytearray(text)
    for _ in range(rng.choice((1, 1, 2, 5, 20))):
        at = rng.randrange(len(data) + 1)
        kind = rng.randrange(3)
        if kind == 0 and at < len(data):
            data[at] = rng.choice(BYTES) if rng.random() < 0.8 else rng.randrange(256)
        elif kind == 1 and at < len(data):
            del data[at : at + rng.choice((1, 1, 2, 10))]
        else:
            data[at:at] = bytes([rng.choice(BYTES)]) * rng.choice((1, 1, 1, 3, 90, 300))
    return bytes(data)


def lines_of(rng, text, wanted):
    """(lines, index of a line that fits)."""
    lines = text.split(b"\n")
    fit = [k for k, line in enumerate(lines) if wanted(line)] or [0]
    return lines, rng.choice(fit)


def is_card(line):
    return line[:1] not in (b"*", b"$", b"")


def mutate_field(rng, text):
    """One field of a card replaced: fixed columns of 8, 10 or 16, or between commas."""
    lines, k = lines_of(rng, text, is_card)
    value = rng.choice(NUMBERS).encode()
    if b"," in lines[k]:
        fields = lines[k].split(b",")
        fields[rng.randrange(len(fields))] = value
        lines[k] = b",".join(fields)
    else:
        width = rng.choice((8, 10, 10, 16))
        at = width * rng.randrange(0, max(1, (len(lines[k]) + width) // width))
        lines[k] = lines[k].ljust(at)[:at] + value.rjust(width)[:width] + lines[k][at + width :]
    return b"\n".join(lines)


def mutate_number(rng, text):
    """A run of digits replaced."""
    lines, k = lines_of(rng, text, is_card)
    words = lines[k].split(b" ")
    fit = [i for i, w in enumerate(words) if w] or [0]
    i = rng.choice(fit)
    words[i] = rng.choice(NUMBERS).encode().rjust(len(words[i]))
    lines[k] = b" ".join(words)
    return b"\n".join(lines)


def mutate_cards(rng, text):
    """Cards dropped, doubled, swapped, cut, moved."""
    lines, k = lines_of(rng, text, lambda line: True)
    j = rng.randrange(len(lines))
    kind = rng.randrange(6)
    if kind == 0:
        del lines[k]
    elif kind == 1:
        lines[k:k] = [lines[k]] * rng.choice((1, 2, 30))
    elif kind == 2:
        lines[k], lines[j] = lines[j], lines[k]
    elif kind == 3:
        lines[k] = lines[k][: rng.randrange(len(lines[k]) + 1)]
    elif kind == 4:
        lines[k] = lines[k] + b" " * rng.randrange(90) + rng.choice(NUMBERS).encode()
    else:
        lines[k] = b" " * rng.randrange(1, 12) + lines[k]
    return b"\n".join(lines)


def mutate_keyword(rng, text):
    """A keyword replaced, damaged, or given an option."""
    lines, k = lines_of(rng, text, lambda line: line[:1] == b"*")
    kind = rng.randrange(4)
    if kind == 0:
        lines[k] = b"*" + rng.choice(KEYWORDS)
    elif kind == 1:
        lines[k] += rng.choice(
            (b"_TITLE", b"_ID", b"+", b"-", b"_LIST", b"_GENERATE", b"_SET", b" x")
        )
    elif kind == 2:
        lines[k:k] = [b"*" + rng.choice(KEYWORDS), rng.choice(NUMBERS).encode().rjust(10)]
    else:
        lines[k] = lines[k][: rng.randrange(1, len(lines[k]) + 1)]
    return b"\n".join(lines)


def mutate_include(rng, text):
    """An include: of itself, of nothing, of a folder, of another deck."""
    lines, k = lines_of(rng, text, lambda line: line[:1] == b"*")
    lines[k:k] = [
        b"*INCLUDE",
        rng.choice((b"deck.k", b"none.k", b".", b"/", b"", b"other.k", b"a +")),
    ]
    return b"\n".join(lines)


def mutate_whole(rng, text):
    """The whole file: cut, carriage returns, a mark, nothing, twice."""
    kind = rng.randrange(6)
    if kind == 0:
        return text[: rng.randrange(len(text) + 1)]
    if kind == 1:
        return text.replace(b"\n", b"\r\n")
    if kind == 2:
        return b"\xef\xbb\xbf" + text
    if kind == 3:
        return text + text
    if kind == 4:
        return text.lower()
    return text.replace(b"*KEYWORD", b"*KEYWORD LONG=Y")


MUTATIONS = (
    mutate_bytes,
    mutate_field,
    mutate_field,
    mutate_field,
    mutate_number,
    mutate_number,
    mutate_cards,
    mutate_cards,
    mutate_keyword,
    mutate_include,
    mutate_whole,
)


def mutant(seed, number, decks):
    """Text of a mutant."""
    rng = random.Random(seed * 1000003 + number)
    text = decks[rng.choice(sorted(decks))]
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        text = rng.choice(MUTATIONS)(rng, text)
    return text


def run(arguments, folder):
    """(exit code or None after the limit, messages)."""
    try:
        done = subprocess.run(
            arguments,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=LIMIT,
        )
        return done.returncode, done.stderr
    except subprocess.TimeoutExpired:
        return None, b""


def judge(program, folder):
    """None, or what is wrong with the run of folder/deck.k; and its exit code."""
    out = os.path.join(folder, "out")
    code, errors = run([program, "deck.k", "-o", "out", "--quiet"], folder)
    if code is None:
        shutil.rmtree(out, ignore_errors=True)
        code, errors = run([program, "deck.k", "--check", "--quiet"], folder)
        if code is None:
            return "no end within %g s, even with --check" % LIMIT, code
        return (None if code == 0 else "no end within %g s" % LIMIT), "long"
    if (
        b"ortran runtime error" in errors
        or b"Backtrace" in errors
        or b"Sanitizer" in errors
        or b"runtime error:" in errors
    ):
        return "run-time error", code
    if code not in (0, 1, 2, 3):
        return "exit code %d" % code, code
    if code != 0 and not errors.strip():
        return "exit code %d without a word" % code, code
    if code == 2 and os.path.exists(out):
        return "files after a deck error", code
    if os.path.isdir(out):
        for name in os.listdir(out):
            if name.endswith(".tab"):
                with open(os.path.join(out, name), "rb") as file:
                    table = b"".join(x for x in file if x[:1] != b"#").lower()
                if b"nan" in table or b"inf" in table or b"***" in table:
                    return "not a number in " + name, code
        shutil.rmtree(out)
    return None, code


def work(task):
    """Runs mutants first, first + step, ... in a folder of their own; returns (codes,
    failures)."""
    first, step, count, seed, program, keep = task
    decks, codes, failures = corpus(), {}, []
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "other.k"), "wb") as file:
            file.write(b"*NODE\n    9001             0.0             0.0\n*END\n")
        for number in range(first, count, step):
            text = mutant(seed, number, decks)
            with open(os.path.join(folder, "deck.k"), "wb") as file:
                file.write(text)
            wrong, code = judge(program, folder)
            codes[code] = codes.get(code, 0) + 1
            if wrong:
                failures.append((number, wrong))
                shutil.rmtree(os.path.join(folder, "out"), ignore_errors=True)
                if keep:
                    shutil.copy(
                        os.path.join(folder, "deck.k"),
                        os.path.join(keep, "mutant%d.k" % number),
                    )
    return codes, failures


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=20000, help="mutants (20000)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--keep", metavar="DIR", help="keep the decks that fail")
    a = parser.parse_args()
    program = os.path.abspath(os.environ.get("BIPACT", os.path.join(ROOT, "bin", "bipact")))
    listed = subprocess.run([program, "--keywords"], stdout=subprocess.PIPE).stdout
    names = [w.strip(b"`*:") for w in listed.split() if w.startswith((b"*", b"`*"))]
    KEYWORDS.extend(sorted(set(n for n in names if n)) or [b"NODE"])
    if a.keep:
        os.makedirs(a.keep, exist_ok=True)
    start = time.time()
    with multiprocessing.Pool(a.jobs) as pool:
        parts = pool.map(
            work, [(k, a.jobs, a.count, a.seed, program, a.keep) for k in range(a.jobs)]
        )
    codes, failures = {}, []
    for part_codes, part_failures in parts:
        failures += part_failures
        for code, n in part_codes.items():
            codes[code] = codes.get(code, 0) + n
    for number, wrong in sorted(failures)[:20]:
        print("FAIL seed %d mutant %d: %s" % (a.seed, number, wrong))
    print(
        "%d mutants in %.0f s; exit codes %s"
        % (
            a.count,
            time.time() - start,
            ", ".join("%s: %d" % item for item in sorted(codes.items(), key=str)),
        )
    )
    print("%d passed, %d failed" % (a.count - len(failures), len(failures)))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
