"""Sixty small decks in the handwriting of several preprocessors and of people, with all
keywords that public decks of the format use most. What is said of each stands in expected.txt,
to the letter: notes and warnings of those that run, messages of those that are refused.
`styles.py --write` makes that file anew (read the difference!)."""

import atexit
import os
import re
import shutil
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
os.environ.setdefault("ROOT", ROOT)
os.environ.setdefault("BIPACT", os.path.join(ROOT, "bin", "bipact"))
if "TMP" not in os.environ:
    os.environ["TMP"] = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, os.environ["TMP"])
sys.path.insert(0, os.path.join(ROOT, "tests", "support"))
import plain
import scenes
from decks import DECKS, FREQUENT
from scenes import check, finish


def digits_off(note):
    """A note without a measured number: its digits depend on compiler and machine."""
    return re.sub(r"rose by \S+", "rose by ...", note)


def outcome(text, files):
    """(exit code, what is said of a deck, folder), the scratch folder taken out of names."""
    folder = os.path.join(scenes.TMP, "out")
    shutil.rmtree(folder, ignore_errors=True)
    plain.write_files(dict(files, **{"deck.k": text}))
    code, errors, _ = scenes.bipact(os.path.join(scenes.TMP, "deck.k"), folder, "--quiet")
    said = [errors] if code else [digits_off(n) + "\n" for n in plain.notes_of(folder)]
    plain.remove_files(files)
    return code, "".join(said).replace(scenes.TMP + "/", ""), folder


def problems_of(said):
    """The problems of a refusal, each with its hint."""
    parts = re.split(r"(?m)^(?=\S)", said)
    return [p for p in parts if p.strip() and not p.startswith("bipact: ")]


def judge(name, kind, code, said, folder):
    """runs: with the tables of the plain scene if kind is "same"; refused: each problem is
    something that is not available, or (kind "fault") the fault that the deck was given."""
    if kind in ("same", "runs"):
        check(code == 0, "%s: exit code %d: %s" % (name, code, said))
        if kind == "same" and code == 0:
            check(
                plain.rows_of(folder) == plain.run_plain(plain.deck()), name + ": other tables"
            )
        return
    check(code == 2, "%s: exit code %d: %s" % (name, code, said))
    check(not os.path.exists(folder), name + ": files after a refusal")
    for problem in problems_of(said):
        check(
            kind == "fault" or "not available in this version" in problem,
            "%s: refused without need: %s" % (name, problem),
        )


def main():
    found = []
    for name, kind, text, files in DECKS:
        code, said, folder = outcome(text, files)
        judge(name, kind, code, said, folder)
        found.append("== %s\nexit %d\n%s" % (name, code, said))
    used = set()
    for _, _, text, files in DECKS:
        for part in [text] + list(files.values()):
            used.update(
                re.sub("_(TITLE|ID)$", "", n.upper()) for n in re.findall(r"(?m)^\*(\w+)", part)
            )
    missing = sorted(set(FREQUENT) - used - {"TITLE", "KEYWORD_ID"})
    check(not missing, "keywords that no deck has: " + " ".join(missing))
    check(len(DECKS) >= 60, "%d decks" % len(DECKS))
    path = os.path.join(HERE, "expected.txt")
    if "--write" in sys.argv:
        with open(path, "w") as out:
            out.write("".join(found))
        return
    with open(path) as file:
        expected = file.read().split("== ")[1:]
    check(len(expected) == len(found), "%d decks, expected %d" % (len(found), len(expected)))
    for text, wanted in zip(found, expected):
        check(text == "== " + wanted, "--- expected\n== %s--- found\n%s" % (wanted, text))


if __name__ == "__main__":
    main()
    finish()
