#!/usr/bin/env python3
"""Run the two-bar impact with each scheme, compare with the exact solution, draw the figures.

Needs bin/bipact and the decks input/two_bars/newmark.k, theta.k, theta_dispersion.k.  Writes
demo.out/NAME/ (the run directories) and demo.out/*.png: figures 1-4 of the paper, the
contact force, the waves over x and t (of waves.k), a ball on a plate in space and, animated,
a foam block that folds on a floor (where HDF5 is there).
Exit code 1 if a run or a comparison fails.
"""

import argparse
import os
import resource
import subprocess
import sys

import startup

DECKS = ("newmark", "theta", "theta_dispersion")
MASS = {
    "newmark": ("Newmark", "consistent"),
    "theta": ("theta", "consistent"),
    "theta_dispersion": ("theta", "dispersion"),
}


class DemoError(Exception):
    """A run that failed; the text says which and why."""


def child_seconds():
    """CPU seconds of all finished child processes, user and system."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run_deck(program, deck, directory):
    """Run one deck; returns its CPU seconds."""
    for path in (program, deck):
        if not os.path.exists(path):
            raise DemoError("%s is missing" % shown(path))
    os.makedirs(directory, exist_ok=True)
    before = child_seconds()
    done = subprocess.run(
        [program, deck, "-o", directory, "--quiet"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    if done.returncode != 0:
        raise DemoError(
            "%s ended with exit code %d\n%s%s"
            % (shown(deck), done.returncode, done.stdout, done.stderr)
        )
    return child_seconds() - before


def shown(path):
    """Path as seen from the current directory, if it is below it."""
    relative = os.path.relpath(path)
    return path if relative.startswith("..") else relative


def run_all(a):
    """{name: (run, measures, CPU seconds)} of the decks."""
    from compare import Run, measure
    from exact_scene import scene_of

    results = {}
    for name in DECKS:
        directory = os.path.join(a.out, name)
        seconds = run_deck(a.bin, os.path.join(a.decks, name + ".k"), directory)
        meta, why = scene_of(directory)
        if meta is None:
            raise DemoError("%s: no exact solution: %s" % (shown(directory), why))
        run, measures = Run(directory, meta), measure(directory, meta)
        if measures["status"] != "done" or measures["err"] is None:
            raise DemoError(
                "%s: the run is %s or lacks nodout rows of the contact face"
                % (shown(directory), measures["status"])
            )
        results[name] = run, measures, seconds
    return results


def print_table(results):
    """Small table of the results."""
    print("scheme   mass             dt        err    E_end/E0    E_max/E0   CPU s")
    for name, (run, m, seconds) in results.items():
        print(
            "%-8s %-10s %8.1e %10.2e %11.7f %11.7f %7.2f"
            % (*MASS[name], run.dt, m["err"], m["E_end"], m["E_max"], seconds)
        )


def findings(results):
    """What to look for in each figure, with the numbers of these runs."""
    newmark, theta, exact = (results[name][1] for name in DECKS)
    return [
        "The end should stand still while the bars touch: error %.1f %%."
        % (1e2 * newmark["err"]),
        "The total energy should be constant: it reaches %.1f times its initial value."
        % newmark["E_max"],
        "The computed curve should cover the exact one: error %.2f %%." % (1e2 * theta["err"]),
        "The total energy should be constant: greatest rise %.1g, change at the end %.2f %%."
        % (theta["dE_max"], 1e2 * theta["dE_end"]),
        "Consistent mass: the raw force alternates, its two-step mean shows the pulse; "
        "dispersion mass: the exact pulse (displacement error %.0e). The mean takes in the "
        "step before: at the touch it begins at half of the first force, at the release it "
        "ends one step later, at half of the last." % exact["err"],
    ]


def draw_all(results, out):
    """The figures: [(path, what to look for)]."""
    import plot_history as plot

    newmark, theta, dispersion = (results[name][0] for name in DECKS)
    text = findings(results)

    def at(name):  # path of a figure
        return os.path.join(out, name + ".png")

    panels = {
        "theta scheme, consistent mass": theta,
        "theta scheme, dispersion mass": dispersion,
    }
    paths = [
        plot.displacement(newmark, at("figure1_displacement_newmark"), "Newmark", text[0]),
        plot.energies(newmark, at("figure2_energy_newmark"), "Newmark", text[1]),
        plot.displacement(theta, at("figure3_displacement_theta"), "theta scheme", text[2]),
        plot.energies(theta, at("figure4_energy_theta"), "theta scheme", text[3]),
        plot.forces_and_ends(panels, at("contact_force"), text[4]),
    ]
    return list(zip(paths, text))


def draw_waves(a):
    """The velocity over x and t, from field files: [(path, what to look for)]."""
    if not os.path.exists(os.path.join(os.path.dirname(a.bin), "bipact-hdf5")):
        print("bipact-hdf5 is not built (no HDF5 for Fortran): no picture of the waves")
        return []
    from plot_fields import Picture, over_place_and_time

    directory = os.path.join(a.out, "waves")
    run_deck(a.bin, os.path.join(a.decks, "waves.k"), directory)
    title = "two bars: velocity over place and time"
    path = over_place_and_time(
        Picture(directory, "V:x"), os.path.join(a.out, "waves.png"), title
    )
    return [
        (
            path,
            "The bars meet; a wave brings each to rest, comes back from the free ends and sets "
            "them free with exchanged velocities.",
        )
    ]


def draw_ball(a):
    """A ball on a plate in space: [(path, what to look for)]."""
    if not os.path.exists(os.path.join(os.path.dirname(a.bin), "bipact-hdf5")):
        return []
    import plot_space
    from plot_fields import Picture

    directory = os.path.join(a.out, "ball_on_plate")
    run_deck(a.bin, os.path.join(startup.ROOT, "input", "space", "ball_on_plate.k"), directory)
    path = plot_space.snapshots(
        Picture(directory, "STRESS:mises"),
        os.path.join(a.out, "ball_on_plate.png"),
        3.0,
        "a quarter of a ball on a plate: von Mises stress, displacements x 3",
    )
    text = "The ball is stressed around the contact alone, and leaves nearly unstressed."
    return [(path, text)]


def draw_foam(a):
    """A foam block at finite deformation, animated: [(path, what to look for)]."""
    if not os.path.exists(os.path.join(os.path.dirname(a.bin), "bipact-hdf5")):
        return []
    from plot_fields import Picture, animation

    directory = os.path.join(a.out, "foam_block")
    run_deck(a.bin, os.path.join(startup.ROOT, "input", "finite", "foam_block.k"), directory)
    path = os.path.join(a.out, "foam_block.gif")
    animation(Picture(directory, "STRESS:yy"), path, 1.0)
    text = (
        "A corner sticks, folds and lets go; the block leaves with nine tenths of its energy."
    )
    return [(path, text)]


def main(argv=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--bin", default=startup.program(), help="program")
    parser.add_argument(
        "--decks",
        default=os.path.join(startup.ROOT, "input", "two_bars"),
        help="directory of the decks",
    )
    parser.add_argument("--out", default="demo.out", help="results")
    a = parser.parse_args(argv)
    try:
        results = run_all(a)
        print_table(results)
        figures = draw_all(results, a.out) + draw_waves(a) + draw_ball(a) + draw_foam(a)
    except Exception as problem:  # whatever fails, the demo fails with one clear message
        print("demo failed: %s" % problem, file=sys.stderr)
        return 1
    print("\nFigures:")
    for path, text in figures:
        print("  %s\n      %s" % (shown(path), text))
    return 0


if __name__ == "__main__":
    sys.exit(main())
