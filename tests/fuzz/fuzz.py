#!/usr/bin/env python3
"""Mutation fuzzer: small decks with random damage. Standard library only.

    fuzz.py [--count N] [--seed S] [--jobs J] [--keep DIR] [--decks WORD ...]

Every mutant is made from (seed, its number, the decks) alone, so a failure can be made again. What must
hold: no crash and no run-time error of Fortran, exit code 0 to 3, no file after a deck error
(exit 2), no NaN or infinity in a table, an end within five seconds (a mutant that asks for very
many steps is only read and checked then).
"""

import argparse
import multiprocessing
import os
import random
import re
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
    "4.0",
    "0.0MECH",
    "1.0E+3",
    "1.-3",
    "&x",
    "-&vx",
    "7",
]
TOKENS = b"""+ - * / ** ( ) , 1 2 0 3.5 1e3 1.e-2 .5 1d2 pi sin( sqrt( mod( min( max(
    atan2( int( nint( exp( log( abs( & &x &vx -&dt x vx end two h t 2**-1 1/0 ) ) 1.0/3 --
    ^ % 2147483647 99999999999 1e200 _ e5""".split()
CLAUSES = b"ALL NODE DNODE PART DPART BOX DBOX ELEM DELEM SEG DSEG TUBE all".split()
OPTIONS = [
    (b"_LIST", b"_GENERAL"),
    (b"_LIST", b"_COLUMN"),
    (b"_LIST", b"_LIST_GENERATE"),
    (b"_GENERAL", b"_LIST"),
    (b"_COLUMN", b"_GENERAL"),
    (b"_LIST", b"_ADD"),
    (b"_SET", b"_NODE"),
    (b"_NODE", b"_SET"),
    (b"_ID", b""),
    (b"_TITLE", b""),
    (b"_LOCAL", b""),
    (b"PARAMETER", b"PARAMETER_LOCAL"),
    (b"PARAMETER", b"PARAMETER_EXPRESSION"),
    (b"PARAMETER_EXPRESSION", b"PARAMETER"),
    (b"_RELATIVE", b""),
    (b"_SURFACE_TO", b"_NODE_TO"),
]
HEADS = [
    b"",
    b"a title, with a comma",
    b"         7heading",
    b"7,heading",
    b"        1x",
    b"   *NODE",
    b"         0",
    b"        -1",
]
PATHS = [
    b"far",
    b"far/",
    b".",
    b"..",
    b"nowhere",
    b"",
    b"   far",
    b"far +\n/x",
    b"./far/../far",
    b"/",
    b"*",
    b"a" * 300,
]
BYTES = b"\t\r\n $*,&+-.0123456789eEdDnNaA\x00\x7f\xe9\xff\"'"
KEYWORDS = []
MOST_BYTES = 40000  # of a deck: runs are to be short


def corpus(words=()):
    """{name: bytes} of the decks to damage, all small and short; those that hold a word."""
    decks = {}
    for folder in (
        "tests/bad_decks",
        "tests/fuzz/decks",
        "input/cards",
        "input/lessons",
        "input/space",
    ):
        path = os.path.join(ROOT, folder)
        for name in sorted(os.listdir(path)) if os.path.isdir(path) else ():
            if name.endswith(".k"):
                with open(os.path.join(path, name), "rb") as file:
                    decks[folder + "/" + name] = file.read()
    words = [word.encode() for word in words]
    decks = {n: d for n, d in decks.items() if len(d) < MOST_BYTES}
    return {n: d for n, d in decks.items() if not words or any(w in d for w in words)}


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


def mutate_scale(rng, text):
    """A real number multiplied, for decks that still run: other speeds, steps, moduli, places."""
    lines, k = lines_of(rng, text, lambda line: is_card(line) and b"." in line)
    found = [
        m for m in re.finditer(rb"-?[0-9]*\.[0-9]*(?:e-?[0-9]+)?", lines[k]) if len(m[0]) > 1
    ]
    if not found:
        return text
    word = rng.choice(found)
    value = float(word[0]) if word[0].strip(b"-.") else 0.0
    value = (value or rng.choice((0.1, 1.0))) * rng.choice(
        (-1.0, 0.01, 0.3, 0.9, 2.0, 30.0, 1.0e4)
    )
    new = b"%.3g" % value
    if b"." not in new and b"e" not in new:
        new += b"."
    before, more = lines[k][: word.start()], len(new) - len(word[0])
    if more > 0 and not before[-more:].strip():
        before = before[:-more]
    lines[k] = before + new.rjust(len(word[0])) + lines[k][word.end() :]
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


def blocks_of(lines, name):
    """Numbers of the lines under keywords whose name holds `name`."""
    found, inside = [], False
    for k, line in enumerate(lines):
        if line[:1] == b"*":
            inside = name in line.upper()
        elif inside and line[:1] != b"$":
            found.append(k)
    return found


def mutate_expression(rng, text):
    """Tokens of an expression put in, changed, dropped; or an expression more."""
    lines = text.split(b"\n")
    found = blocks_of(lines, b"PARAMETER_EXPRESSION")
    if not found or rng.random() < 0.2:
        name = rng.choice((b"Rx", b"R new", b"Inew", b"Cnew", b"Rvx", b"")).ljust(10)
        tokens = b"".join(rng.choice(TOKENS) for _ in range(rng.randrange(1, 12)))
        k = rng.randrange(len(lines)) if rng.random() < 0.3 else min(3, len(lines))
        local = rng.choice((b"", b"", b"_LOCAL"))
        lines[k:k] = [b"*PARAMETER_EXPRESSION" + local, name + tokens]
        return b"\n".join(lines)
    k = rng.choice(found)
    for _ in range(rng.choice((1, 1, 2, 4))):
        at = rng.randrange(len(lines[k]) + 1)
        cut = rng.choice((0, 0, 1, 1, 3))
        lines[k] = lines[k][:at] + rng.choice(TOKENS + [b""]) + lines[k][at + cut :]
    if rng.random() < 0.1:
        lines[k:k] = [b" " * 10 + rng.choice(TOKENS)] * rng.choice((1, 2, 25))
    return b"\n".join(lines)


def mutate_parameter(rng, text):
    """A field that takes a parameter, or a definition more, also of a name that is there."""
    lines, k = lines_of(rng, text, is_card)
    name = rng.choice((b"x", b"vx", b"end", b"dt", b"two", b"h", b"styp", b"nope"))
    if rng.random() < 0.5:
        width = rng.choice((8, 10, 16))
        at = width * rng.randrange(0, 8)
        value = rng.choice((b"&", b"-&", b"&&", b"+&", b"& ")) + name
        value = value.rjust(width) if rng.random() < 0.5 else value.ljust(width)
        lines[k] = lines[k].ljust(at)[:at] + value[:width] + lines[k][at + width :]
    else:
        k = rng.randrange(len(lines) + 1)
        keyword = rng.choice((b"*PARAMETER", b"*PARAMETER_LOCAL", b"*PARAMETER+"))
        kind = rng.choice((b"R", b"I", b"C", b"r", b"X"))
        lines[k:k] = [keyword, (kind + name).ljust(10) + rng.choice(NUMBERS).encode().rjust(10)]
    return b"\n".join(lines)


def mutate_blanks(rng, text):
    """Blank lines."""
    lines = text.split(b"\n")
    for _ in range(rng.choice((1, 1, 2, 8))):
        k = rng.randrange(len(lines) + 1)
        lines[k:k] = [rng.choice((b"", b" ", b" " * 80, b"\r"))] * rng.choice((1, 1, 3))
    return b"\n".join(lines)


def mutate_touching(rng, text):
    """Blanks between two values dropped, or a value moved to the left of its columns."""
    lines, k = lines_of(rng, text, is_card)
    words = [
        i for i in range(1, len(lines[k])) if lines[k][i - 1 : i] == b" " != lines[k][i : i + 1]
    ]
    if not words:
        return text
    i = rng.choice(words)
    gap = len(lines[k][:i]) - len(lines[k][:i].rstrip())
    drop = rng.randrange(1, gap + 1)
    end = i + len(lines[k][i:].split(b" ")[0])
    lines[k] = (
        lines[k][: i - drop]
        + lines[k][i:end]
        + b" " * rng.choice((0, drop, drop))
        + lines[k][end:]
    )
    return b"\n".join(lines)


def mutate_option(rng, text):
    """A keyword with another option, with or without the card that it brings."""
    lines, k = lines_of(rng, text, lambda line: line[:1] == b"*")
    kind = rng.randrange(4)
    if kind == 0:
        lines[k] += rng.choice((b"_TITLE", b"_ID", b"+", b" +", b"%", b" %", b"-"))
        if rng.random() < 0.7:
            lines[k + 1 : k + 1] = [rng.choice(HEADS)]
    elif kind == 1:
        old, new = rng.choice(OPTIONS)
        fit = [i for i, line in enumerate(lines) if line[:1] == b"*" and old in line] or [k]
        k = rng.choice(fit)
        lines[k] = lines[k].replace(old, new, 1)
    elif kind == 2:
        found = blocks_of(lines, b"_GENERAL") or [k]
        k = rng.choice(found)
        clause = rng.choice(CLAUSES)
        clause = clause.rjust(10) if rng.random() < 0.7 else clause.ljust(10)
        numbers = b"".join(
            rng.choice((b"1", b"2", b"4", b"16", b"0", b"", b"99")).rjust(10) for _ in range(7)
        )
        lines[k:k] = [clause + numbers]
    else:
        lines[k] = rng.choice((b" ", b"*", b"")) + lines[k]
    return b"\n".join(lines)


def mutate_include(rng, text):
    """An include: of itself, of nothing, of a folder, of another deck."""
    lines, k = lines_of(rng, text, lambda line: line[:1] == b"*")
    if rng.random() < 0.4:
        keyword = rng.choice((b"*INCLUDE_PATH", b"*INCLUDE_PATH_RELATIVE"))
        lines[k:k] = [keyword] + [rng.choice(PATHS) for _ in range(rng.choice((0, 1, 1, 2)))]
        return b"\n".join(lines)
    names = (
        b"deck.k",
        b"none.k",
        b".",
        b"/",
        b"",
        b"other.k",
        b"a +",
        b"mesh.k",
        b"far/mesh.k",
        b"far/../deck.k",
    )
    lines[k:k] = [b"*INCLUDE", rng.choice(names)]
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
    mutate_scale,
    mutate_scale,
    mutate_cards,
    mutate_cards,
    mutate_keyword,
    mutate_include,
    mutate_expression,
    mutate_parameter,
    mutate_blanks,
    mutate_touching,
    mutate_option,
    mutate_option,
    mutate_whole,
)


def mutant(seed, number, decks):
    """Texts of a mutant, {name: text}: the deck, and the mesh that some include, which is the
    damaged one now and then."""
    rng = random.Random(seed * 1000003 + number)
    with open(os.path.join(ROOT, "tests/fuzz/decks/far/mesh.key"), "rb") as file:
        mesh = file.read()
    name = rng.choice(sorted(decks))
    texts = {"deck.k": decks[name], "far/mesh.k": mesh}
    damaged = "far/mesh.k" if b"mesh.k" in decks[name] and rng.random() < 0.4 else "deck.k"
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        texts[damaged] = rng.choice(MUTATIONS)(rng, texts[damaged])
    return texts


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
    first, step, count, seed, program, keep, words = task
    decks, codes, failures = corpus(words), {}, []
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "other.k"), "wb") as file:
            file.write(b"*NODE\n    9001             0.0             0.0\n*END\n")
        os.mkdir(os.path.join(folder, "far"))
        for number in range(first, count, step):
            for name, text in mutant(seed, number, decks).items():
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(text)
            wrong, code = judge(program, folder)
            codes[code] = codes.get(code, 0) + 1
            if wrong:
                failures.append((number, wrong))
                shutil.rmtree(os.path.join(folder, "out"), ignore_errors=True)
                if keep:
                    for name in ("deck.k", "far/mesh.k"):
                        kept = "mutant%d.%s" % (number, name.replace("/", "_"))
                        shutil.copy(os.path.join(folder, name), os.path.join(keep, kept))
    return codes, failures


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=20000, help="mutants (20000)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--keep", metavar="DIR", help="keep the decks that fail")
    parser.add_argument(
        "--decks", nargs="+", default=(), metavar="WORD", help="those with a word"
    )
    a = parser.parse_args()
    program = os.path.abspath(os.environ.get("BIPACT", os.path.join(ROOT, "bin", "bipact")))
    listed = subprocess.run([program, "--keywords"], stdout=subprocess.PIPE).stdout
    names = [w.strip(b"`*:") for w in listed.split() if w.startswith((b"*", b"`*"))]
    KEYWORDS.extend(sorted(set(n for n in names if n)) or [b"NODE"])
    if a.keep:
        os.makedirs(a.keep, exist_ok=True)
    start = time.time()
    with multiprocessing.Pool(a.jobs) as pool:
        rest = (a.jobs, a.count, a.seed, program, a.keep, a.decks)
        parts = pool.map(work, [(k,) + rest for k in range(a.jobs)])
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
