"""Faulty decks and their messages, to the letter. Each fault changes base.k in one place; the
expected text is in expected.txt. `faults.py --write` makes that file anew (read the difference!).
Every fault must give exit code 2 and write no file."""
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
BASE = open(os.path.join(HERE, "base.k")).read()

# name, text in base.k, text that takes its place
FAULTS = [
    ("unknown keyword", "*DATABASE_GLSTAT", "*DATABASE_GLSTATS"),
    ("unknown option", "*CONTROL_TERMINATION", "*CONTROL_TERMINATION_FOO"),
    ("refused keyword", "*END", "*RIGIDWALL_PLANAR\n*END"),
    ("undefined parameter", "     &tend", "     &tond"),
    ("parameter used before", "*PARAMETER\nRtend           0.01Rdt            1e-03\n*CONTROL_TERMINATION\n     &tend", "*CONTROL_TERMINATION\n     &tend"),
    ("parameter one column short", "Rtend           0.01Rdt            1e-03", "Rtend          0.01Rdt            1e-03"),
    ("parameter twice", "Rdt            1e-03", "Rtend          1e-03"),
    ("letter in a number", "       2             1.0             0.0", "       2             1.O             0.0"),
    ("blank in a number", "       3             1.0             1.0", "       3             1 0             1.0"),
    ("nan", "       3             1.0             1.0", "       3             nan             1.0"),
    ("fraction for an integer", "       1       1       1       2       3       4", "       1       1     1.5       2       3       4"),
    ("tab", "     0.001\n*END", "\t0.001\n*END"),
    ("card shifted right", "       2             1.0             0.0", "       2               1.0             0.0"),
    ("out of range", "         1     0.001    1000.0       0.3", "         1     0.001    1000.0       0.5"),
    ("negative density", "         1     0.001    1000.0       0.3", "         1    -0.001    1000.0       0.3"),
    ("missing value", "         1     0.001    1000.0       0.3", "         1              1000.0       0.3"),
    ("undefined node", "       1       1       1       2       3       4", "       1       1       1       2       3       9"),
    ("clockwise", "       1       1       1       2       3       4", "       1       1       4       3       2       1"),
    ("triangle", "       1       1       1       2       3       4", "       1       1       1       2       3       3"),
    ("node twice", "       4             0.0             1.0", "       3             0.0             1.0"),
    ("node without element", "       4             0.0             1.0", "       4             0.0             1.0\n       5             7.0             1.0"),
    ("node off the plane", "       4             0.0             1.0", "       4             0.0             1.0             0.5"),
    ("undefined part", "       1       1       1       2", "       1       2       1       2"),
    ("undefined section", "         1         1         1\n*SECTION", "         1         4         1\n*SECTION"),
    ("undefined material", "         1         1         1\n*SECTION", "         1         1         4\n*SECTION"),
    ("element form", "         1        13                   4", "         1        16                   4"),
    ("unequal thickness", "       1.0\n*MAT", "       1.0       2.0\n*MAT"),
    ("undefined set", "*INITIAL_VELOCITY\n         1", "*INITIAL_VELOCITY\n         7"),
    ("field not available", "*INITIAL_VELOCITY\n         1", "*INITIAL_VELOCITY\n         1         3"),
    ("explicit", "         1       &dt", "         0       &dt"),
    ("static", "*CONTROL_IMPLICIT_DYNAMICS\n         1", "*CONTROL_IMPLICIT_DYNAMICS\n         0"),
    ("keyword missing", "*CONTROL_IMPLICIT_DYNAMICS\n         1\n", ""),
    ("card missing", "*INITIAL_VELOCITY\n         1\n       1.0\n", "*INITIAL_VELOCITY\n         1\n"),
    ("card too many", "*TITLE\n", "*TITLE\none\ntwo\n"),
    ("keyword twice", "*END", "*DATABASE_GLSTAT\n     0.002\n*END"),
    ("scheme", "     THETA       0.5", "      TETA       0.5"),
    ("theta of newmark", "     THETA       0.5", "   NEWMARK       0.5"),
    ("theta out of range", "     THETA       0.5", "     THETA       0.4"),
    ("include missing", "*END", "*INCLUDE\nnowhere.k\n*END"),
    ("support of a moving node", "*END", "*BOUNDARY_SPC_NODE\n         1                   1\n*END"),
    ("two velocities", "*END", "*INITIAL_VELOCITY_NODE\n         1       2.0\n*END"),
    ("too many commas", "     0.001\n*END", "0.001,0,0,0,5,6\n*END"),
    ("beyond the last field", "         1     0.001    1000.0       0.3", "         1     0.001    1000.0       0.3" + " " * 30 + "7"),
    ("curve missing", "*END", "*LOAD_BODY_Y\n         3       1.0\n*END"),
    ("curve not increasing", "*END", "*DEFINE_CURVE\n         3\n                 0.0                 1.0\n                 0.0                 1.0\n*END"),
    ("unstable beta", "*CONTROL_IMPLICIT_DYNAMICS\n         1", "*CONTROL_IMPLICIT_DYNAMICS\n         1       0.5       0.1"),
    ("dispersion and cut step", "*BIPACT_TIME", "*BIPACT_MASS\nDISPERSION\n*BIPACT_TIME", "     &tend", "    0.0105"),
    ("initial penetration", None, None),
    ("stray card", "*KEYWORD\n", "*KEYWORD\n*DATABASE_GLSTAT\n     0.001\n         1\n*END\n"),
    ("several at once", "     0.001    1000.0       0.3", "      zero   -1000.0       0.7"),
]


def overlapping():
    """Two blocks that overlap by 0.1."""
    text = BASE.replace("*ELEMENT_SHELL", """       5             0.9             0.0
       6             1.9             0.0
       7             1.9             1.0
       8             0.9             1.0
*ELEMENT_SHELL
       2       2       5       6       7       8""")
    return text.replace("*SECTION_SHELL", """other
         2         1         1
*SET_PART_LIST
        11
         1
*SET_PART_LIST
        12
         2
*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE
        11        12
*SECTION_SHELL""")


def faulty(fault):
    """Text of a faulty deck."""
    if fault[1] is None:
        return overlapping()
    text = BASE
    for old, new in zip(fault[1::2], fault[2::2]):
        if old not in text:
            raise SystemExit("fault '%s' does not fit base.k" % fault[0])
        text = text.replace(old, new, 1)
    return text


def message(name, text, folder):
    """Exit code and messages of a deck, with the scratch folder taken out."""
    deck = os.path.join(folder, "deck.k")
    with open(deck, "w", newline="") as out:
        out.write(text)
    shutil.rmtree(os.path.join(folder, "out"), ignore_errors=True)
    done = subprocess.run([os.environ["BIPACT"], deck, "-o", os.path.join(folder, "out")],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    wrote = os.path.exists(os.path.join(folder, "out"))
    return "== %s\nexit %d%s\n%s" % (name, done.returncode, ", WROTE FILES" if wrote else "",
                                    done.stderr.replace(folder + "/", ""))


def main():
    folder = os.environ["TMP"]
    found = [message(fault[0], faulty(fault), folder) for fault in FAULTS]
    path = os.path.join(HERE, "expected.txt")
    if "--write" in sys.argv:
        with open(path, "w") as out:
            out.write("".join(found))
        return 0
    expected = open(path).read().split("== ")[1:]
    failed = 0
    for k, text in enumerate(found):
        wanted = "== " + expected[k] if k < len(expected) else "(nothing)"
        if text != wanted or "exit 2\n" not in text:
            failed += 1
            print("FAIL %s\n--- expected\n%s--- found\n%s" % (FAULTS[k][0], wanted, text))
    good = message("base", BASE, folder)
    if "exit 0" not in good:
        failed += 1
        print("FAIL the deck without a fault: " + good)
    print("%d passed, %d failed" % (len(found) + 1 - failed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
