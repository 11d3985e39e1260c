#!/usr/bin/env python3
"""Which scheme, mass and step is worth its time on a deck: error against run time and against
counted work, for what the deck's own tables hold.

    study.py deck.k                         # every scheme and mass, three steps, three meshes
    study.py deck.k --refine 0              # the deck's mesh alone
    study.py deck.k finer.k finest.k        # meshes of your own, coarsest first
    study.py deck.k --mesh n=50,100,200     # the same, by a *PARAMETER

The deck is run as it stands; then as it was understood, with each scheme of *BIPACT_TIME, each
mass of *BIPACT_MASS (NAME* = massless contact nodes) and DT0 times each of --steps, on the mesh
of the deck and on finer ones, where the step becomes smaller with the elements. The finest runs
that converge make a reference with a bar, against which all runs are measured: no exact
solution is needed, and where nothing converges the page says so. Writes DIR/study.md, study.csv
and figures.

Started again the study goes on; what is finished is not run again (see sweep.py). doc/study.md
says how to read the page.

Exit code: 0 written, 2 wrong arguments or a deck that cannot be studied, 130 interrupted.
"""

import argparse
import csv
import os
import re
import signal
import subprocess
import sys
from dataclasses import dataclass

import startup

import study_estimate
import study_page
from study_deck import CannotRefine, EchoDeck, is_number
from sweep import FINISHED, Sweep, read_summary, values_of

# Parameters that a scheme is run with; of one that is not named here, its defaults.
SETTINGS = {
    "NEWMARK": [{}],
    "HHT": [{"ALPHA": -0.1}],
    "PAOLI": [{}, {"PBETA": 0.0}],
}
ON_ONE_MESH, ON_MESHES = "4,2,1,0.5,0.25", "4,2,1"


@dataclass(frozen=True)
class Run:
    """One run: the mesh's number, coarsest first; the scheme's fields; the step over that which
    belongs to the mesh."""

    mesh: int
    variant: tuple
    mass: str
    redist: int
    factor: float
    dt: float

    @property
    def scheme(self):
        """Name with the parameters that are not the defaults."""
        fields = dict(self.variant)
        words = [fields.pop("SCHEME")]
        for name, value in fields.items():
            words.append(
                "%s=%s" % (name.lower(), "%g" % value if is_number(value) else value)
            )
        return " ".join(words)

    @property
    def mass_name(self):
        return self.mass + ("*" if self.redist else "")

    @property
    def method(self):
        return self.scheme, self.mass_name

    @property
    def label(self):
        return "%s %s" % self.method


class Study(Sweep):
    """The runs of a study, each with a deck of its own in its folder."""

    def __init__(self, program, decks, out, runs, meshes):
        super().__init__(program, decks[0], {}, os.path.join(out, "runs"))
        self.meshes, self.combinations = meshes, runs
        self.coarsest = max(run.dt for run in runs)

    def words(self, run):
        scheme = run.scheme.replace(" ", "_")
        return [scheme, run.mass_name, "dt=%.6g" % run.dt, "mesh=%d" % run.mesh]

    def deck_of(self, run):
        return os.path.abspath(os.path.join(self.folder(run), "deck.k"))

    def command(self, run):
        return [self.program, self.deck_of(run), "-o", self.folder(run), "--quiet"]

    def is_its(self, summary, run):
        return summary["deck"]["path"] == self.deck_of(run)

    def window(self, run):
        """Over which a force is averaged [T]: two steps, of the largest on a mesh where the
        meshes are compared."""
        if len(self.meshes) == 1:
            return 2.0 * run.dt
        return 2.0 * max(r.dt for r in self.combinations if r.mesh == run.mesh)

    def write_decks(self):
        """The meshes once each, and for every run the cards that tell it from the others."""
        os.makedirs(self.out, exist_ok=True)
        for k, mesh in enumerate(self.meshes):
            keep(os.path.join(self.out, "mesh%d.k" % k), mesh.mesh_text())
        for run in self.combinations:
            os.makedirs(self.folder(run), exist_ok=True)
            head = self.meshes[run.mesh].head(
                dict(run.variant), run.mass, run.redist, run.dt, self.coarsest
            )
            lines = ["*KEYWORD", head, "*INCLUDE", "../mesh%d.k" % run.mesh, "*END", ""]
            keep(self.deck_of(run), "\n".join(lines))


def keep(path, text):
    """Writes a file unless it is there with this text."""
    data = text.encode("utf-8", "surrogateescape")
    if os.path.exists(path):
        with open(path, "rb") as file:
            if file.read() == data:
                return
    with open(path + ".tmp", "wb") as file:
        file.write(data)
    os.replace(path + ".tmp", path)


# ---------------------------------------------------------------- what there is to run


def fields_of(program, keyword):
    """{field: (words it may be, is it used, default)} as the program tells."""
    text = subprocess.run(
        [program, "--keywords", keyword], capture_output=True, text=True, check=True
    ).stdout
    found = {}
    for line in text.splitlines():
        cells = [c.strip() for c in line.strip().strip("|").split("|")]
        if len(cells) == 8 and re.match(r"\d", cells[1]):
            words = [w.strip() for w in cells[5].split(",") if w.strip()]
            default = cells[4].split(" ")[0]
            default = float(default) if is_number(default) else default
            found[cells[0]] = words, cells[6].startswith("honoured"), default
    return found


def variants_of(program):
    """Fields of every scheme that the program has, {SCHEME: name, ...}."""
    fields = fields_of(program, "BIPACT_TIME")
    for name in fields["SCHEME"][0]:
        for setting in SETTINGS.get(name, [{}]):
            if all(key == "ALPHA" or fields.get(key, ((), False))[1] for key in setting):
                yield {"SCHEME": name, **setting}


def without_defaults(variant, fields):
    """A deck's own scheme as variants_of writes it, where it is one of them: the echo of a deck
    has the defaults filled in."""
    default = {name: field[2] for name, field in fields.items()}
    found = {k: v for k, v in variant.items() if k == "SCHEME" or default.get(k) != v}
    if found.get("XI") == found.get("THETA"):
        found.pop("XI", None)
    if found.get("THETA") == 0.5:
        del found["THETA"]
    return found


def wanted_methods(a, deck):
    """[(variant, mass, redist)]; the deck's own is among them."""
    masses = fields_of(a.bipact, "BIPACT_MASS")["TYPE"][0]
    masses = [m + star for m in masses for star in ("", "*")]
    if a.masses:
        masses = [m for m in masses if matches(m, a.masses)]
    variants = [v for v in variants_of(a.bipact) if not a.schemes or v["SCHEME"] in a.schemes]
    own, (mass, redist) = deck.own_variant()
    own = without_defaults(own, fields_of(a.bipact, "BIPACT_TIME"))
    if own not in variants and (not a.schemes or own["SCHEME"] in a.schemes):
        variants.append(own)
    found = [
        (tuple(variant.items()), m.rstrip("*"), int(m.endswith("*")))
        for variant in variants
        for m in masses
    ]
    mine = (tuple(own.items()), mass, redist)
    return found if mine in found else found + [mine]


def matches(mass, wanted):
    """Is a mass among those of --masses, which may be first letters?"""
    short = mass[0] + ("*" if mass.endswith("*") else "")
    return mass in wanted or short in wanted


def read_meshes(a):
    """([EchoDeck], remarks) of the study, coarsest first: of the decks, of the values of
    --mesh, or of the deck refined."""
    remarks, meshes = [], []
    jobs = [(deck, None) for deck in a.decks]
    if a.mesh:
        ((name, values),) = a.mesh.items()
        jobs = [(a.decks[0], "%s=%s" % (name, v)) for v in values]
    for k, (deck, word) in enumerate(jobs):
        meshes.append(EchoDeck.read(run_as_given(a, deck, word, k)))
    if meshes[0].is_static or meshes[0].step <= 0.0:
        raise SystemExit("study.py: %s is not dynamic: there are no schemes to compare" % deck)
    for _ in range(a.refine if len(meshes) == 1 else 0):
        try:
            meshes.append(meshes[-1].refined())
        except CannotRefine as why:
            remarks.append("The mesh is not refined: %s." % why)
            break
    return meshes, remarks


def run_as_given(a, deck, word, k):
    """Runs a deck as it stands, unless it has been; the path of its echo."""
    own = Sweep(a.bipact, deck, {}, os.path.join(a.out, "given%d" % k))
    if word:
        name, _, value = word.partition("=")
        own = Sweep(a.bipact, deck, {name: [value]}, os.path.join(a.out, "given%d" % k))
    own.total, own.limit = 1, a.limit
    (combination,) = own.combinations
    if a.fresh or not own.is_finished(combination):
        ending = own.run(combination)
        if ending:
            raise SystemExit(ending.get("message") or "study.py: %s" % ending["status"])
    return os.path.join(own.folder(combination), "deck.echo.k")


def plan(a, meshes):
    """All runs, the cheapest first."""
    widths = [m.least_edge() for m in meshes]
    factors = a.steps or (ON_MESHES if len(meshes) > 1 else ON_ONE_MESH)
    runs = []
    for k, width in enumerate(widths):
        for factor in map(float, factors.split(",")):
            dt = near(meshes[0].end, meshes[0].step * factor * width / widths[0])
            for variant, mass, redist in wanted_methods(a, meshes[0]):
                runs.append(Run(k, variant, mass, redist, factor, dt))
    cells = [len(m.elements()) for m in meshes]
    return sorted(runs, key=lambda r: cells[r.mesh] / r.dt), widths


def near(end, dt):
    """A step free of the round-off of a division, where it divides the time."""
    steps = round(end / dt)
    return end / steps if steps and abs(end / dt - steps) < 1.0e-9 * steps else dt


# ---------------------------------------------------------------- results


@dataclass
class Result:
    """How a run ended, and what it cost: processor seconds, counted multiplications."""

    status: str
    message: str = ""
    cpu: float = 0.0
    work: float = 0.0
    steps: int = 0
    growth: bool = False
    warnings: tuple = ()

    @property
    def done(self):
        return self.status == "done"


def result_of(folder, ending):
    summary = ending or read_summary(folder)
    if summary is None or ending:
        summary = summary or {"status": "not run"}
        return Result(summary["status"], first_line(summary.get("message")))
    found = Result(summary["status"], first_line(summary["message"]), summary["cpu"])
    found.steps, found.warnings = summary["steps"], tuple(summary["warnings"])
    found.growth = any(w.startswith("energy-growth") for w in found.warnings)
    found.work = work_of(folder, summary)
    return found


def first_line(text):
    return re.sub(r"^\S+:\d+(, columns? [\d-]+)?: ", "", (text or "").split("\n")[0])


def work_of(folder, summary):
    """Multiplications that the counts of a run stand for: each factorisation, two of each entry
    of the factor a solve, 36 a node (nine neighbours, blocks of four) a step for K u, and of a
    sweep of contact the square of its rows."""
    with open(os.path.join(folder, "bipact.log"), encoding="utf-8", errors="replace") as log:
        match = re.search(r"factor (\d+) bytes, (\d+) block mult", log.read())
    size, products = (int(x) for x in match.groups()) if match else (0, 0)
    counts = summary["counts"]
    rows = sum(counts["rows_" + k] for k in ("edge", "vertex", "second", "wall"))
    rows = 2.0 * rows / max(1, counts["contact_solves"])
    return (
        counts["factors"] * 8.0 * products
        + counts["solves"] * 2.0 * size / 8.0
        + summary["steps"] * 36.0 * summary["scene"]["nodes"]
        + counts["sweeps"] * rows**2
    )


def sequences_of(runs, results, widths, one_mesh):
    """Runs that are done, as sequences: on finer meshes at one ratio of step to mesh, or on one
    mesh with smaller steps."""
    groups = {}
    for run in runs:
        groups.setdefault(run.method + (0.0 if one_mesh else run.factor,), []).append(run)
    for method, members in groups.items():
        width = (lambda r: r.dt) if one_mesh else (lambda r: widths[r.mesh])
        members = sorted(members, key=width, reverse=True)
        if len(members) > 1:
            trusted = not any(results[r].growth for r in members)
            yield study_estimate.Sequence(
                method, members, [width(r) for r in members], trusted
            )


def evaluate(study, widths, endings):
    """{run: Result}, {quantity: Estimate}, {run: {quantity: Quantity}} of all runs."""
    one_mesh = len(widths) == 1
    results = {r: result_of(study.folder(r), endings.get(r)) for r in study.combinations}
    histories = {
        r: study_estimate.quantities(study.folder(r), study.window(r), one_mesh)
        for r, result in results.items()
        if result.done
    }
    found = study_estimate.estimate_all(
        lambda: list(sequences_of(histories, results, widths, one_mesh)), histories, one_mesh
    )
    return results, found, histories


def write_csv(path, results, estimates):
    """One row for each quantity of each run."""
    with open(path + ".tmp", "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(
            "mesh scheme mass factor dt status cpu work steps growth quantity error bar "
            "message".split()
        )
        for run, r in results.items():
            head = [run.mesh, run.scheme, run.mass_name, run.factor, run.dt, r.status, r.cpu]
            head += [r.work, r.steps, int(r.growth)]
            if not r.done:
                out.writerow(head + ["", "", "", r.message])
            for name, e in estimates.items():
                if run in e.errors:
                    out.writerow(head + [name, e.errors[run], e.bars[run], ""])
    os.replace(path + ".tmp", path)


# ---------------------------------------------------------------- command line


def arguments(argv):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("decks", nargs="+", metavar="DECK", help="the deck; then the same on finer meshes")
    add("-o", dest="out", metavar="DIR", help="folder of the study (DECK's name with .study)")
    add("--mesh", metavar="name=a,b,c", help="parameter that makes the mesh, coarsest first")
    add("--refine", type=int, default=2, metavar="N", help="times each element is cut (2)")
    steps = "DT0 times these (%s; one mesh: %s)" % (ON_MESHES, ON_ONE_MESH)
    add("--steps", metavar="A,B,C", help=steps)
    add("--schemes", metavar="A,B", help="schemes (all that there are)")
    add("--masses", metavar="A,B", help="masses, or their first letters: C,L,D* (all)")
    add("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="runs at once (cores)")
    add("--limit", type=float, default=600.0, metavar="S", help="longest run [s] (600)")
    add("--fresh", action="store_true", help="run finished runs again")
    add("--bipact", metavar="PATH", default=startup.program(), help="program")
    a = parser.parse_args(argv)
    for deck in a.decks:
        if not os.path.isfile(deck):
            parser.error('there is no deck "%s"' % deck)
    if not os.access(a.bipact, os.X_OK):
        parser.error('there is no program "%s"' % a.bipact)
    if a.jobs < 1 or a.refine < 0:
        parser.error("--jobs must be at least 1, --refine at least 0")
    if a.mesh and len(a.decks) > 1:
        parser.error("--mesh or several decks, not both")
    if a.steps and not all(is_number(x) and float(x) > 0.0 for x in a.steps.split(",")):
        parser.error("--steps: expected positive numbers")
    a.mesh = values_of([a.mesh], parser) if a.mesh else None
    a.schemes = a.schemes and a.schemes.upper().split(",")
    a.masses = a.masses and a.masses.upper().split(",")
    a.out = a.out or os.path.splitext(os.path.basename(a.decks[0]))[0] + ".study"
    return a


def run_study(a):
    """Runs what is missing: (study, widths, endings, remarks, was it interrupted)."""
    os.makedirs(a.out, exist_ok=True)
    meshes, remarks = read_meshes(a)
    runs, widths = plan(a, meshes)
    study = Study(a.bipact, a.decks, a.out, runs, meshes)
    study.limit = a.limit
    study.write_decks()
    endings, interrupted = study.run_all(a.jobs, a.fresh)
    return study, widths, endings, remarks, interrupted


def main(argv=None):
    a = arguments(argv)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        study, widths, endings, remarks, interrupted = run_study(a)
    except SystemExit as problem:
        print(problem.code, file=sys.stderr)
        return 2
    results, estimates, _ = evaluate(study, widths, endings)
    write_csv(os.path.join(a.out, "study.csv"), results, estimates)
    path = study_page.write(a, study, widths, results, estimates, remarks)
    done = sum(r.done for r in results.values())
    print("%s: %d of %d runs are done" % (path, done, len(results)))
    return 130 if interrupted else 0


if __name__ == "__main__":
    sys.exit(main())
