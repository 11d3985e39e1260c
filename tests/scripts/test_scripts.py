#!/usr/bin/env python3
"""Tests of the scripts: tables, exact solutions, deck writer, comparison, figures, demo.

Synthetic tables are made from the exact solution; decks are read back by a small reader of the
tests (class Deck of support/deck_text.py).  usage: test_scripts.py [part of a test name ...]
"""

import contextlib
import io
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPTS = os.path.join(os.path.dirname(os.path.dirname(HERE)), "scripts")
sys.path[:0] = [SCRIPTS, os.path.join(os.path.dirname(HERE), "support")]

import analytic  # noqa: E402
import compare  # noqa: E402
import make_bars  # noqa: E402
import plot_history  # noqa: E402
import tables  # noqa: E402
from deck_text import Deck  # noqa: E402

GLSTAT = (
    "time cycle dt kinetic internal total initial external motion friction contact "
    "unsolved algorithmic damping residual ratio momx momy momz angx angy angz"
).split()
NODOUT = "time node ux uy uz vx vy vz vmx vmy vmz x y z".split()
RCFORC = (
    "time contact side fx fy fz fmx fmy fmz ix iy iz fn ft nactive nstick nslip " "gapmin"
).split()


# ---------------------------------------------------------------- synthetic runs


def write_columns(directory, name, names, data, meta, status="done"):
    """Table from {column: values}; columns not given are zero."""
    rows = len(data["time"])
    columns = [np.broadcast_to(data.get(column, 0.0), rows) for column in names]
    tables.write_table(
        os.path.join(directory, name + ".tab"), names, columns, status, meta["steps"]
    )


def write_glstat(directory, meta, exact, t, energy=0.0, status="done"):
    """Exact energies; `energy` is added to the kinetic one from the release on [F L]."""
    kinetic, strain = exact.energies(t)
    kinetic = kinetic + energy * (t >= exact.release)
    momentum = sum(b.mass * v for b, v in zip(exact.bars, exact.mean_velocities(t)))
    data = {
        "time": t,
        "cycle": np.arange(len(t)),
        "dt": meta["dt"],
        "kinetic": kinetic,
        "internal": strain,
        "total": kinetic + strain,
        "initial": exact.energy,
        "residual": 3e-14,
        "ratio": 1.0,
        "momx": momentum * meta["axis"][0],
        "momy": momentum * meta["axis"][1],
    }
    write_columns(directory, "glstat", GLSTAT, data, meta, status)


def write_nodout(directory, meta, exact, t, shift, shake, every=1):
    """Exact ends; face nodes shifted by +-shift (mean 0) plus `shake` (t) along the axis."""
    axis, lateral = np.array(meta["axis"]), np.array(meta["lateral"])
    step = np.diff(t, prepend=-meta["dt"])
    u = exact.tip(t) + shake(t)
    vm = np.diff(u, prepend=0.0) / step
    vm[0] = exact.bars[0].velocity
    rows = []
    for k in range(0, len(t), every):
        for i, node in enumerate(meta["face1"]):
            off = shift * (-1) ** i if len(meta["face1"]) > 1 else 0.0
            place = -0.5 * meta["gap"] * axis + meta["height"] * i * lateral
            rows.append(
                (t[k], node, *((u[k] + off) * axis), 0, 0, 0, 0, *(vm[k] * axis), 0, *place, 0)
            )
        for i, node in enumerate(meta["face2"]):
            place = 0.5 * meta["gap"] * axis + meta["height"] * i * lateral
            rows.append((t[k], node, *([0] * 9), *place, 0))
    write_columns(directory, "nodout", NODOUT, dict(zip(NODOUT, np.array(rows).T)), meta)


def write_rcforc(directory, meta, exact, t, chatter=0.0, every=1):
    """Exact step forces; in contact they alternate by +-chatter [F]."""
    force = np.concatenate(([0.0], exact.step_forces(meta["dt"], len(t) - 1)))
    sign = (-1.0) ** np.arange(len(t))
    full = (t > exact.touch + 2.5 * meta["dt"]) & (t < exact.release - 0.5 * meta["dt"])
    raw = force + chatter * sign * full
    mean = 0.5 * (raw + np.concatenate(([0.0], raw[:-1])))
    impulse = np.cumsum(raw) * meta["dt"]
    rows = []
    for k in range(0, len(t), every):
        for side, along in zip(meta["sides"], (-1.0, 1.0)):
            vectors = [
                x * along * c
                for x in (raw[k], mean[k], impulse[k])
                for c in (*meta["axis"], 0.0)
            ]
            rows.append((t[k], 1, side, *vectors, raw[k], 0, 2, 2, 0, -1e-15))
    write_columns(directory, "rcforc", RCFORC, dict(zip(RCFORC, np.array(rows).T)), meta)


def write_run(
    directory,
    meta,
    shift=0.0,
    shake=lambda t: 0.0 * t,
    chatter=0.0,
    energy=0.0,
    every=1,
    status="done",
):
    """Tables of a run that found the exact solution, plus known errors."""
    exact = analytic.impact_of(meta)
    t = meta["dt"] * np.arange(meta["steps"] + 1)
    write_glstat(directory, meta, exact, t, energy, status)
    write_nodout(directory, meta, exact, t, shift, shake, every)
    write_rcforc(directory, meta, exact, t, chatter, every)
    return exact


class Case(unittest.TestCase):
    """Test case with a temporary directory and a quiet command line."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.dir = self.folder.name

    def path(self, name):
        return os.path.join(self.dir, name)

    def near(self, value, expected, tolerance=1e-12):
        """Equal within tolerance times the greatest expected value (at least 1e-300)."""
        scale = max(np.max(np.abs(expected)), 1e-300)
        self.assertLessEqual(np.max(np.abs(np.subtract(value, expected))), tolerance * scale)

    def call(self, main, *words):
        """(exit code, output and messages) of a script's main."""
        text = io.StringIO()
        with contextlib.redirect_stdout(text), contextlib.redirect_stderr(text):
            try:
                code = main(list(words))
            except SystemExit as stop:
                code = stop.code
        return code, text.getvalue()


# ---------------------------------------------------------------- tables


class TablesTest(Case):
    def write(self, text):
        with open(self.path("x.tab"), "w", encoding="ascii") as out:
            out.write(text)
        return self.path("x.tab")

    def test_round_trip_is_exact(self):
        values = np.array([math.pi, -1e-308, 1.7e308, 0.1, 0.0])
        tables.write_table(self.path("x.tab"), ["time", "node"], [values, range(5)], cycle=4)
        table = tables.read_table(self.path("x.tab"))
        self.assertTrue(np.array_equal(table["time"], values))
        self.assertEqual(table["node"].dtype, np.int64)
        self.assertEqual((table.status, table.cycle, len(table)), ("done", 4, 5))

    def test_header_select_and_vectors(self):
        path = self.write(
            "# two bars\n# 1 time 2 node 3 ux 4 uy\n# time node ux uy\n"
            " 0.0E+000 7 1.0 2.0\n 0.0E+000 9 3.0 4.0\n 1.0E+000 7 5.0 6.0\n"
            "# end: stopped, cycle 12\n"
        )
        table = tables.read_table(path)
        self.assertEqual(table.names, ["time", "node", "ux", "uy"])
        self.assertEqual(table.header[0], "two bars")
        self.assertEqual((table.status, table.cycle), ("stopped", 12))
        self.assertEqual(table.select(node=7)["ux"].tolist(), [1.0, 5.0])
        self.assertEqual(table.select(node=7, time=1.0).vectors("ux", "uy").tolist(), [[5, 6]])
        self.assertEqual(table.ids("node").tolist(), [7, 9])
        self.assertIn("ux", table)

    def test_unfinished_and_empty_tables(self):
        table = tables.read_table(self.write("# time ux\n 0.0 1.0\n"))
        self.assertEqual((table.status, table.cycle), ("", None))
        table = tables.read_table(self.write("# time ux\n# end: failed, cycle 0\n"))
        self.assertEqual((table.status, len(table)), ("failed", 0))

    def test_special_numbers(self):
        table = tables.read_table(self.write("# time ux\n 0.0 NaN\n 1.0 Infinity\n"))
        self.assertTrue(np.isnan(table["ux"][0]) and np.isinf(table["ux"][1]))

    def test_errors_name_the_file(self):
        for text in (
            "# time ux\n 0.0 1.0\n 1.0\n",
            "# time ux\n 0.0 1.0 2.0\n",
            "# time ux\n 0.0 ******\n",
            "0.0 1.0\n",
        ):
            with self.assertRaisesRegex(tables.TableError, "x.tab"):
                tables.read_table(self.write(text))
        with self.assertRaisesRegex(tables.TableError, "no column 'uq'; there are: time ux"):
            tables.read_table(self.write("# time ux\n 0.0 1.0\n"))["uq"]
        with self.assertRaises(tables.TableError):
            tables.read_table(self.path("missing.tab"))
        self.assertIsNone(tables.read_run(self.dir, "missing"))

    def test_command_line(self):
        self.write("# time node\n 0.0 3\n# end: done, cycle 1\n")
        code, text = self.call(tables.main, self.dir)
        self.assertEqual(code, 0)
        self.assertIn("1 rows, done, cycle 1", text)
        self.assertEqual(self.call(tables.main, self.path("no.tab"))[0], 1)


# ---------------------------------------------------------------- exact solutions


def grid_impact(bar1, bar2, dt, steps):
    """Independent solver: waves shifted cell by cell, h_i = c_i dt, touch at t = 0.
    Returns the force of each step and the final energies per bar (both kinds added)."""
    n = [round(b.length / (b.speed * dt)) for b in (bar1, bar2)]
    right = [np.full(k, b.velocity) for k, b in zip(n, (bar1, bar2))]
    left = [r.copy() for r in right]
    z1, z2, gap, forces = bar1.impedance, bar2.impedance, 0.0, []
    for _ in range(steps):
        a, b = right[0][-1], left[1][0]
        force = z1 * z2 / (z1 + z2) * (a - b) if gap <= 1e-15 else 0.0
        force = max(force, 0.0)
        v1, v2 = a - force / z1, b + force / z2
        gap += (v2 - v1) * dt
        forces.append(force)
        ends = left[0][0], right[1][-1]
        right = [np.append(ends[0], right[0][:-1]), np.append(v2 + force / z2, right[1][:-1])]
        left = [np.append(left[0][1:], v1 - force / z1), np.append(left[1][1:], ends[1])]
    energy = [
        np.sum(r**2 + w**2) * b.line_mass * b.speed * dt / 4
        for r, w, b in zip(right, left, (bar1, bar2))
    ]
    return np.array(forces), energy


class AnalyticTest(Case):
    def test_two_bars_numbers(self):
        bars = analytic.TwoBars()
        self.near(
            [bars.touch, bars.release, bars.energy, bars.impulse], [0.01, 0.03, 0.01, 0.02]
        )
        self.near(bars.tip([0.005, 0.02, 0.035]), [0.005, 0.01, 0.005])
        self.near(bars.force(np.array([0.005, 0.02, 0.035])), [0.0, 1.0, 0.0])
        self.near(bars.kinetic(np.array([0.0, 0.015, 0.02, 0.03])), [0.01, 0.005, 0, 0.01])
        self.near(bars.strain(np.array([0.0, 0.015, 0.02, 0.03])), [0, 0.005, 0.01, 0])
        self.near(bars.mean_velocity(np.array([0.0, 0.02, 0.04])), [1.0, 0.0, -1.0])

    def test_scaling_of_the_other_reading(self):
        a, b = analytic.TwoBars(), analytic.TwoBars(v0=10.0, gap=0.2)
        t = np.linspace(0.0, 0.04, 77)
        self.near(b.tip(t), 10.0 * a.tip(t))
        self.near(b.force(t), 10.0 * a.force(t))
        self.near(b.kinetic(t), 100.0 * a.kinetic(t))

    def test_fields_give_energy_and_momentum(self):
        bars = analytic.TwoBars()
        x = -bars.length * (np.arange(4000) + 0.5) / 4000
        for t in (0.005, 0.0137, 0.0249, 0.035):
            v, s = bars.velocity(x, t), bars.stress(x, t)
            kinetic = bars.density * bars.length * np.mean(v**2)
            strain = np.mean(s**2) * bars.length / (bars.density * bars.speed**2)
            self.near([kinetic, strain], [bars.kinetic(t), bars.strain(t)], 1e-3)
            self.near(np.mean(v), bars.mean_velocity(t), 1e-3)

    def test_characteristics_equal_the_closed_form(self):
        bars = analytic.TwoBars(gap=0.0213, v0=0.7, area=2.0, density=2e-3)
        z = bars.density * bars.speed * bars.area
        exact = analytic.Impact(
            analytic.Bar(10.0, 1000.0, z, 0.7),
            analytic.Bar(10.0, 1000.0, z, -0.7),
            0.0213,
            0.06,
        )
        t = np.linspace(0.0, 0.06, 203)
        self.near([exact.touch, exact.release], [bars.touch, bars.release])
        self.near(exact.tip(t), bars.tip(t))
        self.near(exact.displacement(t)[1], -bars.tip(t))
        self.near(exact.force(t), bars.force(t))
        self.near(exact.energies(t), [bars.kinetic(t), bars.strain(t)])
        self.near(exact.mean_velocities(t)[0], bars.mean_velocity(t))
        self.near(exact.impulse(t[-1]), bars.impulse)
        depth = np.linspace(0.05, 9.95, 67)
        for s in (0.004, 0.021, 0.0309, 0.05):
            v, n = np.array([exact.field(0, y, s) for y in depth]).T
            self.near(v, bars.velocity(-depth, s))
            self.near(n, bars.area * bars.stress(-depth, s))

    def test_wall_is_half_of_two_bars(self):
        wall = analytic.TwoBars(gap=0.01, bars=1)
        both = analytic.TwoBars(gap=0.02)
        t = np.linspace(0.0, 0.04, 91)
        self.near(wall.tip(t), both.tip(t))
        self.near(wall.force(t), both.force(t))
        self.near(wall.kinetic(t), 0.5 * both.kinetic(t))
        exact = analytic.wall_impact(analytic.Bar(10.0, 1000.0, 1.0, 1.0), 0.01, 0.04)
        self.near(exact.tip(t), wall.tip(t))

    def test_unequal_lengths(self):
        bar1, bar2 = (analytic.Bar(10.0, 1000.0, 1.5, 2.0), analytic.Bar(25.0, 1000.0, 1.5, 0))
        form = analytic.unequal_lengths(10.0, 25.0, 1000.0, 1.5, 2.0)
        exact = analytic.Impact(bar1, bar2, 0.0, 0.2)
        self.near([exact.force(0.01), exact.release], [form["force"], form["duration"]])
        self.near(exact.mean_velocities(0.2), [form["v_cm1"], form["v_cm2"]])
        self.near(form["v_cm2"], 0.8)
        self.near((form["v_cm2"] - form["v_cm1"]) / 2.0, form["restitution"])
        rigid = 0.5 * bar2.mass * form["v_cm2"] ** 2
        self.near(1.0 - rigid / exact.energy, form["vibration_share"])
        u1, u2 = exact.displacement(np.linspace(0.0, 0.05, 51))  # until 2 L2/c they touch
        self.near(u1, u2)
        u1, u2 = exact.displacement(0.06)
        self.assertGreater(u2 - u1, 1e-3)

    def test_mass_ratio_where_bar_1_is_shorter(self):
        bar1, bar2 = analytic.Bar(3.0, 900.0, 0.8, 1.0), analytic.Bar(8.0, 1100.0, 0.8, 0.0)
        exact = analytic.Impact(bar1, bar2, 0.0, 2 * 8.0 / 1100.0)
        self.near(exact.release, 6.0 / 900.0)
        self.near(exact.mean_velocities(exact.tend), [0.0, bar1.mass / bar2.mass])

    def test_staircase(self):
        self.near(analytic.staircase(3.0, 1.0, 1.0, [0, 1, 2]), [0.75, 0.375, 0.1875])
        exact = analytic.Impact(
            analytic.Bar(1.0, 1000.0, 3.0, 1.0), analytic.Bar(100.0, 1000.0, 1.0, 0.0), 0.0, 0.1
        )
        k = np.arange(12)
        self.near(exact.force(0.002 * (k + 0.5)), analytic.staircase(3.0, 1.0, 1.0, k))
        self.near(exact.step_forces(0.0005, 8), [0.75] * 4 + [0.375] * 4)

    def test_light_bar_rebounds(self):
        exact = analytic.Impact(
            analytic.Bar(1.0, 1000.0, 1.0, 1.0), analytic.Bar(50.0, 1000.0, 3.0, 0.0), 0.0, 0.05
        )
        self.near([exact.force(0.001), exact.force(0.003)], [0.75, 0.0])
        self.near(exact.mean_velocities(0.05)[0], -0.5)
        self.near(analytic.staircase(1.0, 3.0, 1.0, [0, 1]), [0.75, 0.0])

    def test_any_bars_conserve_energy_and_momentum(self):
        bar1, bar2 = analytic.Bar(7.3, 812.0, 1.9, 1.3), analytic.Bar(3.1, 1234.5, 0.7, -0.4)
        exact = analytic.Impact(bar1, bar2, 0.0123, 0.35)
        t = np.linspace(0.0, 0.35, 211)
        self.near(np.sum(exact.energies(t), axis=0), np.full(211, exact.energy))
        v1, v2 = exact.mean_velocities(t)
        momentum = bar1.mass * v1 + bar2.mass * v2
        self.near(momentum, np.full(211, bar1.mass * 1.3 - bar2.mass * 0.4))
        u1, u2 = exact.displacement(t)
        self.assertGreaterEqual(np.min(0.0123 + u2 - u1), -1e-15)
        self.assertGreaterEqual(np.min(exact.force_steps), 0.0)
        self.assertEqual(exact.release, analytic.Impact(bar1, bar2, 0.0123, 0.7).release)

    def test_grid_of_characteristics(self):
        for z2, cells in ((1.0, (20, 20)), (0.3, (20, 70)), (2.7, (15, 40)), (0.9, (33, 7))):
            dt = 1e-4
            bar1 = analytic.Bar(cells[0] * 1000.0 * dt, 1000.0, 1.0, 1.0)
            bar2 = analytic.Bar(cells[1] * 1500.0 * dt, 1500.0, z2, -0.5)
            forces, energy = grid_impact(bar1, bar2, dt, 300)
            exact = analytic.Impact(bar1, bar2, 0.0, 300 * dt)
            self.near(exact.step_forces(dt, 300), forces, 1e-11)
            self.near(np.sum(exact.energies(300 * dt)), sum(energy))

    def test_touch_in_mid_step(self):
        bars = [analytic.Bar(10.0, 1000.0, 1.0, s) for s in (1.0, -1.0)]
        exact = analytic.Impact(*bars, 0.02 + 2 * 0.25e-4, 0.04)
        force = exact.step_forces(1e-4, 400)
        self.near(force[[99, 100, 101, 299, 300, 301]], [0, 0.75, 1, 1, 0.25, 0], 1e-10)
        self.near(exact.touch, 0.010025)
        self.near(
            [analytic.touch_time(0.2, 1.0, -1.0), analytic.touch_time(0.0, 1.0, 0.0)],
            [0.1, 0.0],
        )
        self.assertEqual(analytic.touch_time(0.1, 1.0, 1.0), float("inf"))

    def test_command_line(self):
        code, text = self.call(analytic.main, "--rows", "5")
        self.assertEqual((code, len(text.splitlines())), (0, 6))
        self.assertEqual(float(text.splitlines()[3].split()[3]), 1.0)


# ---------------------------------------------------------------- decks


def area(points):
    """Signed area of a polygon, positive counter-clockwise."""
    x, y = np.array(points).T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


VARIANTS = (
    {},
    {"angle": 37.0},
    {"angle": 90.0},
    {"angle": -123.4, "mirror": "x"},
    {"mirror": "x"},
    {"mirror": "y"},
    {"swap": True},
    {"renumber": 5},
    {"renumber": 5, "swap": True, "mirror": "y", "angle": 12.0},
    {"random": (0.6, 3), "ny": 3, "ny2": 2},
    {"scale_length": 1024.0},
    {"offset": (100.0, -3.0)},
    {"slide": 0.25},
    {"nx2": 7, "length2": 3.0},
)


class MakeBarsTest(Case):
    def deck(self, **options):
        self.meta = make_bars.write(self.path("bars.k"), meta_file=True, **options)
        return Deck(self.path("bars.k"))

    def test_default_is_the_papers_test(self):
        deck = self.deck()
        self.near(
            [
                deck.field("*CONTROL_TERMINATION", 1, 1),
                deck.field("*CONTROL_IMPLICIT_GENERAL", 1, 2),
            ],
            [0.04, 1e-5],
        )
        self.assertEqual(
            [deck.number(f) for f in deck.cards["*MAT_ELASTIC"][0][:4]], [1, 1e-3, 1000.0, 0.0]
        )
        self.assertEqual(deck.cards["*SECTION_SHELL"][0][:4], ["1", "13", "", "4"])
        self.assertEqual(deck.velocities(), {1: (1.0, 0.0), 2: (-1.0, 0.0)})
        self.assertEqual((len(deck.nodes()), len(deck.elements())), (404, 200))
        self.assertEqual(
            deck.parameters, {"tend": "0.04", "dt": "1e-05", "v0": "1.0", "mu": "0.0"}
        )
        self.assertEqual(deck.cards["*DATABASE_GLSTAT"][0][0], "0.0001")
        self.assertEqual(
            (self.meta["steps"], self.meta["touch"], self.meta["case"]),
            (4000, 0.01, "two_bars"),
        )
        x = sorted({p[0] for p in deck.nodes().values()})
        self.assertEqual((x[0], x[100], x[101], x[-1]), (-10.01, -0.01, 0.01, 10.01))

    def test_every_number_reads_back(self):
        options = dict(
            nx=30,
            angle=37.0,
            v0=0.1 + 0.2,
            young=999.9999999,
            mass="DISPERSION",
            courant=1.0,
            mu=1 / 3,
        )
        deck = self.deck(**options)
        o = make_bars.resolve(options)
        wanted = {n: (x, y) for n, x, y in make_bars.make_mesh(o).nodes}
        self.assertEqual(deck.nodes(), wanted)
        self.assertEqual(deck.field("*CONTROL_IMPLICIT_GENERAL", 1, 2), self.meta["dt"])
        self.assertEqual(deck.field("*CONTROL_TERMINATION", 1, 1), self.meta["tend"])
        self.assertEqual(deck.field("*MAT_ELASTIC", 1, 3), 999.9999999)
        self.assertEqual(deck.field("*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", 1, 5), 1 / 3)
        speed = np.hypot(*deck.velocities()[1])
        self.near(speed, 0.1 + 0.2, 1e-15)
        self.assertEqual(list(deck.parameters), [])  # none fits its 10 columns

    def test_lines_keep_to_the_format(self):
        for options in VARIANTS:
            for line in self.deck(**options).lines:
                self.assertLessEqual(len(line), 80)
                self.assertNotIn("\t", line)
                self.assertTrue(line.isascii() and line == line.rstrip())

    def test_names_stand_over_their_fields(self):
        lines = self.deck(angle=90.0).lines
        at = lines.index("*MAT_ELASTIC")
        self.assertEqual(lines[at + 1].index("pr") + 2, 40)
        self.assertEqual(len(lines[at + 2]), 40)

    def test_elements_are_counter_clockwise(self):
        for options in VARIANTS:
            deck = self.deck(**{"nx": 11, **options})
            nodes, total = deck.nodes(), 0.0
            for _, corners in deck.elements().values():
                one = area([nodes[n] for n in corners])
                self.assertGreater(one, 0.0, options)
                total += one
            scale = options.get("scale_length", 1.0)
            self.near(total, (10.0 + options.get("length2", 10.0)) * scale**2)

    def test_faces_and_direction(self):
        for options in VARIANTS:
            deck = self.deck(**{"nx": 11, **options})
            nodes, sets, meta = deck.nodes(), deck.sets(), self.meta
            self.assertEqual(sets, {1: meta["face1"], 2: meta["face2"], 3: meta["free_ends"]})
            middle = [np.mean([nodes[n] for n in sets[s]], axis=0) for s in (1, 2)]
            gap = (middle[1] - middle[0]) @ np.array(meta["axis"])
            self.assertLess(abs(gap - meta["gap"]), 1e-13 * 100.0 * meta["L"])
            for part, bar in zip((1, 2), meta["bars"]):
                along = np.array(meta["axis"]) * bar["velocity"]
                self.near(deck.velocities()[part], along, 1e-15)
            owner = {n: part for part, ids in deck.elements().values() for n in ids}
            self.assertEqual({owner[n] for n in sets[1]}, {1})
            self.assertEqual({owner[n] for n in sets[2]}, {2})
            history = [int(n) for f in deck.cards["*DATABASE_HISTORY_NODE"] for n in f if n]
            self.assertEqual(sorted(history), sorted(sets[1] + sets[2] + sets[3]))

    def test_turn_mirror_and_quarter_are_exact_where_possible(self):
        plain = self.deck(nx=7).nodes()
        self.assertEqual(
            self.deck(nx=7, angle=90.0).nodes(),
            {n: (-y + 0.0, x) for n, (x, y) in plain.items()},
        )
        self.assertEqual(
            self.deck(nx=7, mirror="x").nodes(), {n: (-x, y) for n, (x, y) in plain.items()}
        )
        turned = self.deck(nx=7, angle=37.0).nodes()
        c, s = math.cos(math.radians(37.0)), math.sin(math.radians(37.0))
        for n, (x, y) in plain.items():
            self.near(turned[n], (c * x - s * y, s * x + c * y), 1e-15)

    def test_swap_changes_the_order_only(self):
        plain, swapped = self.deck(nx=5), self.deck(nx=5, swap=True)
        self.assertEqual(sorted(plain.nodes().values()), sorted(swapped.nodes().values()))
        self.assertEqual(plain.velocities(), swapped.velocities())
        contact = "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE"
        self.assertEqual(plain.cards[contact][0][:2], ["11", "12"])
        self.assertEqual(swapped.cards[contact][0][:2], ["12", "11"])
        self.assertEqual(self.meta["sides"], [2, 1])
        self.assertGreater(min(self.meta["face1"]), max(self.meta["face2"]))

    def test_renumber_gives_other_ids_and_the_same_scene(self):
        plain, other = self.deck(nx=9), self.deck(nx=9, renumber=3)
        self.assertEqual(sorted(plain.nodes().values()), sorted(other.nodes().values()))
        self.assertNotEqual(sorted(plain.nodes()), sorted(other.nodes()))
        self.assertNotEqual(list(other.nodes()), sorted(other.nodes()))
        again = self.deck(nx=9, renumber=3)
        self.assertEqual(other.lines, again.lines)
        self.assertNotEqual(other.lines, self.deck(nx=9, renumber=4).lines)

    def test_random_spacing(self):
        plain, other = self.deck(nx=20), self.deck(nx=20, random=(0.5, 1))
        shift = [abs(other.nodes()[n][0] - p[0]) for n, p in plain.nodes().items()]
        self.assertGreater(max(shift), 0.05)
        self.assertLessEqual(max(shift), 0.125)
        ends = self.meta["face1"] + self.meta["face2"] + self.meta["free_ends"]
        self.assertTrue(all(plain.nodes()[n] == other.nodes()[n] for n in ends))

    def test_change_of_units_keeps_every_digit(self):
        plain, a, b, s = self.deck(nx=6, gap=0.021), 0.25, 8.0, 2.0**-10
        first = self.meta
        scaled = self.deck(nx=6, gap=0.021, scale_length=a, scale_mass=b, scale_time=s)
        self.assertEqual(
            {n: (a * x, a * y) for n, (x, y) in plain.nodes().items()}, scaled.nodes()
        )
        mat = "*MAT_ELASTIC"
        self.assertEqual(scaled.field(mat, 1, 2), b / a**3 * plain.field(mat, 1, 2))
        self.assertEqual(scaled.field(mat, 1, 3), b / (a * s * s) * plain.field(mat, 1, 3))
        self.assertEqual(scaled.field("*SECTION_SHELL", 2, 1), a)
        self.assertEqual(scaled.velocities()[1][0], a / s)
        dt = ("*CONTROL_IMPLICIT_GENERAL", 1, 2)
        self.assertEqual(scaled.field(*dt), s * plain.field(*dt))
        self.assertEqual(
            scaled.field("*DATABASE_NODOUT", 1, 1), s * plain.field("*DATABASE_NODOUT", 1, 1)
        )
        self.assertEqual(self.meta["energy"], a * a * b / (s * s) * first["energy"])
        self.assertEqual(self.meta["Z"], b / s * first["Z"])
        self.near(self.meta["bars"][0]["courant"], first["bars"][0]["courant"], 1e-15)

    def test_time_step_from_the_courant_number(self):
        for nx, courant, dt in ((100, 1.0, 1e-4), (100, 0.5, 5e-5), (50, 1.0, 2e-4)):
            self.deck(nx=nx, courant=courant)
            self.assertEqual(self.meta["dt"], dt)
            self.near(self.meta["bars"][0]["courant"], courant, 1e-15)
        self.deck(nx=10, courant=1.0, poisson=0.3)
        c_p = math.sqrt(1e6 * 0.7 / (1.3 * 0.4))
        self.near(self.meta["dt"], 1.0 / c_p, 1e-15)
        self.near(self.meta["c"], math.sqrt(1e6 / 0.91), 1e-15)
        self.deck(nx=10, courant=1.0, poisson=0.3, plane_stress=True)
        self.near([self.meta["c"], self.meta["dt"]], [1e3, math.sqrt(0.91) / 1e3], 1e-15)

    def test_unequal_bars_get_the_same_courant_number(self):
        self.deck(nx=20, length2=30.0, young2=4000.0, courant=1.0)
        self.assertEqual(self.meta["bars"][1]["elements"][0], 30)
        self.near([b["courant"] for b in self.meta["bars"]], [1.0, 1.0], 1e-15)
        self.assertEqual(self.meta["case"], "unequal")
        deck = self.deck(young2=1000.0 / 3, density2=1e-3 / 3, v2=0.0)
        self.assertEqual(len(deck.cards["*MAT_ELASTIC"]), 2)
        self.near([b["impedance"] for b in self.meta["bars"]], [1.0, 1 / 3], 1e-15)
        self.assertNotIn("v0", deck.parameters)

    def test_touch_at_a_fraction_of_a_step(self):
        for fraction in (0.0, 0.25, 0.5, 0.75):
            for dt in (1e-5, 5e-5, 1e-4):
                self.deck(nx=3, dt=dt, touch=fraction)
                steps = self.meta["touch"] / self.meta["dt"]
                self.near(steps % 1.0 if fraction else steps, fraction or 0.01 / dt, 1e-9)
                self.assertLess(abs(self.meta["gap"] - 0.02), 1.01 * dt)
                self.near(self.meta["touch"], self.meta["gap"] / 2.0, 1e-15)

    def test_other_readings_of_the_data(self):
        self.deck(gap=0.2)
        self.near([self.meta["touch"], self.meta["tend"]], [0.1, 0.13])
        self.deck(gap=0.2, v0=10.0)
        self.near([self.meta["touch"], self.meta["tend"]], [0.01, 0.04])
        self.deck(nx=30, courant=1.0, mass="DISPERSION")  # whole steps
        self.near(self.meta["tend"] / self.meta["dt"], self.meta["steps"], 1e-12)

    def test_unused_fields_stay_blank(self):
        theta = self.deck()
        self.assertEqual(theta.cards["*BIPACT_TIME"][0][:3], ["THETA", "0.5", ""])
        self.assertEqual(theta.cards["*CONTROL_IMPLICIT_DYNAMICS"][0][1:], [""] * 7)
        self.assertEqual(theta.cards["*BIPACT_MASS"][0][:3], ["CONSISTENT", "", ""])
        self.assertNotIn("*BIPACT_LEDGER", theta.cards)
        newmark = self.deck(scheme="newmark", mass="lumped", redist=1, ledger_every=10)
        self.assertEqual(newmark.cards["*BIPACT_TIME"][0][:3], ["NEWMARK", "", ""])
        self.assertEqual(newmark.cards["*CONTROL_IMPLICIT_DYNAMICS"][0][1:3], ["0.5", "0.25"])
        self.assertEqual(newmark.cards["*BIPACT_MASS"][0][:2], ["LUMPED", "1"])
        self.assertEqual(newmark.cards["*BIPACT_LEDGER"][0][0], "10")
        self.assertEqual(
            self.deck(theta=0.7, xi=0.6).cards["*BIPACT_TIME"][0][1:3], ["0.7", "0.6"]
        )
        self.assertEqual(self.deck(plane_stress=True).cards["*SECTION_SHELL"][0][1], "12")

    def test_tables_and_intervals(self):
        deck = self.deck(tables=["glstat", "rcforc=step", "nodout=2e-3", "elout", "timing"])
        self.assertEqual(deck.field("*DATABASE_RCFORC", 1, 1), 1e-5)
        self.assertEqual(deck.field("*DATABASE_NODOUT", 1, 1), 2e-3)
        self.assertEqual(deck.field("*BIPACT_TIMING", 1, 1), 1e-4)
        self.assertIn("*DATABASE_HISTORY_SHELL", deck.cards)
        self.assertNotIn("*DATABASE_MATSUM", deck.cards)
        self.assertEqual(self.deck(output="step").field("*DATABASE_GLSTAT", 1, 1), 1e-5)

    def test_split_deck_is_the_same_deck(self):
        whole, split = self.deck(angle=20.0), self.deck(angle=20.0, split=True)
        self.assertEqual(split.cards.pop("*INCLUDE"), [["bars_mesh.k"]])
        self.assertEqual(whole.cards, split.cards)

    def test_meta_file_and_description(self):
        self.deck(nx=4, angle=30.0)
        self.assertEqual(
            compare.load_meta(self.path("bars.json")), json.loads(json.dumps(self.meta))
        )
        self.assertEqual(make_bars.describe(nx=4, angle=30.0), self.meta)

    def test_command_line(self):
        code, text = self.call(
            make_bars.main,
            "--nx",
            "5",
            "--random",
            "0.2",
            "7",
            "--meta",
            "--offset=-1,2",
            "--tables",
            "glstat",
            "-o",
            self.path("a.k"),
        )
        self.assertEqual((code, os.path.exists(self.path("a.json"))), (0, True), text)
        code, text = self.call(make_bars.main, "--nx", "5")
        self.assertEqual((code, text.splitlines()[-1]), (0, "*END"))
        self.assertEqual(self.call(make_bars.main, "--meta")[0], 2)
        self.assertIn("--courant", self.call(make_bars.main, "--help")[1])

    def test_bad_data_are_refused(self):
        for options in (
            {"v0": -1.0},
            {"nx": 0},
            {"gap": -1.0},
            {"poisson": 0.5},
            {"dt": 0.0},
            {"dt": 1e-5, "courant": 1.0},
            {"tables": ["foo"]},
            {"nosuch": 1},
            {"random": (1.0, 1)},
        ):
            with self.assertRaises(ValueError, msg=options):
                make_bars.describe(**options)
        self.assertEqual(self.call(make_bars.main, "--gap", "-1")[0], 1)

    def test_needs_the_standard_library_only(self):
        code = (
            "import sys; sys.modules['numpy'] = sys.modules['matplotlib'] = None; "
            "sys.path.insert(0, %r); import make_bars; make_bars.describe(nx=3)" % SCRIPTS
        )
        self.assertEqual(subprocess.run([sys.executable, "-c", code]).returncode, 0)


# ---------------------------------------------------------------- comparison


class CompareTest(Case):
    def scene(self, **options):
        return make_bars.describe(**{"nx": 20, "courant": 0.5, **options})

    def test_exact_tables_have_no_error(self):
        for options in (
            {},
            {"angle": 37.0},
            {"mirror": "x", "angle": 90.0},
            {"swap": True},
            {"touch": 0.25},
            {"renumber": 1},
            {"scale_length": 8.0},
            {"length2": 25.0, "v2": 0.0},
            {"young2": 250.0, "density2": 2.5e-4},
        ):
            meta = self.scene(**options)
            write_run(self.dir, meta)
            m = compare.measure(self.dir, meta)
            for name in ("err", "e_u", "e_R", "e_R2", "osc", "momentum", "force_sum"):
                self.assertLess(m[name], 2e-11, (name, options))
            self.near(
                [m["impulse"], m["E_end"], m["E_max"], m["residual"]], [1, 1, 1, 3e-14], 1e-11
            )
            self.assertEqual((m["status"], m["gapmin"]), ("done", -1e-15))

    def test_known_displacement_error(self):
        meta = self.scene()
        write_run(self.dir, meta, shift=0.5, shake=lambda t: 1e-4 * (t > 0.02))
        m = compare.measure(self.dir, meta)
        t = meta["dt"] * np.arange(meta["steps"] + 1)
        u = analytic.TwoBars().tip(t)
        self.near(m["err"], 1e-4 * math.sqrt(np.sum(t > 0.02) / np.sum(u**2)), 1e-9)
        self.near(m["e_u"], 1e-4 / 0.02, 1e-9)

    def test_known_force_chatter(self):
        meta = self.scene()
        exact = write_run(self.dir, meta, chatter=0.3)
        m = compare.measure(self.dir, meta)
        full = round((exact.release - exact.touch) / meta["dt"]) - 3  # see write_rcforc
        self.near(m["e_R"], 0.3 * full * meta["dt"] / exact.impulse(1.0), 1e-9)
        self.near(m["e_R2"], 2 * 0.15 * meta["dt"] / exact.impulse(1.0), 1e-9)

    def test_known_oscillation(self):
        meta = self.scene()
        dt = meta["dt"]
        step = 2e-3 * dt
        write_run(self.dir, meta, shake=lambda t: 0.5 * step * (-1) ** np.rint(t / dt))
        self.near(compare.measure(self.dir, meta)["osc"], 2e-3, 1e-9)

    def test_first_and_last_step_in_contact_do_not_count(self):
        meta = self.scene(touch=0.5)
        dt = meta["dt"]
        inside = round((0.02 - dt) / dt) - 2  # whole steps in contact, without two
        write_run(self.dir, meta)
        run = compare.Run(self.dir, meta)
        mask = compare.steps_in_contact(run, run.tip()[0])
        self.assertEqual(np.sum(mask), inside)
        t = run.tip()[0][mask]
        self.assertGreater(t[0] - 2 * dt, run.exact.touch)
        self.assertLess(t[-1] + dt, run.exact.release)

    def test_known_energy(self):
        meta = self.scene()
        write_run(self.dir, meta, energy=0.002)
        m = compare.measure(self.dir, meta)
        self.near([m["E_end"], m["dE_end"], m["dE_max"]], [1.2, 0.2, 0.2], 1e-9)

    def test_force_error_needs_every_step(self):
        meta = self.scene()
        write_run(self.dir, meta, every=4)
        m = compare.measure(self.dir, meta)
        self.assertIsNone(m["e_R"])
        self.near(m["impulse"], 1.0, 1e-9)
        self.assertLess(m["err"], 1e-12)

    def test_missing_tables(self):
        meta = self.scene()
        write_run(self.dir, meta)
        os.remove(self.path("nodout.tab"))
        m = compare.measure(self.dir, meta)
        self.assertIsNone(m["err"])
        self.assertLess(m["e_R"], 1e-11)
        os.remove(self.path("rcforc.tab"))
        os.remove(self.path("glstat.tab"))
        self.assertEqual(self.call(compare.main, self.dir)[0], 2)

    def test_face_is_found_without_node_ids(self):
        for options in ({}, {"angle": 37.0}, {"renumber": 2}):
            meta = self.scene(**options)
            write_run(self.dir, meta)
            nodout = tables.read_table(self.path("nodout.tab"))
            found = compare.contact_face(nodout, {**meta, "face1": None})
            self.assertEqual(sorted(found), sorted(meta["face1"]))

    def test_wall(self):
        meta = self.scene(gap=0.02)
        exact = write_run(self.dir, meta)
        rows = tables.read_table(self.path("rcforc.tab")).select(side=1)
        names = ["wall" if n == "contact" else n for n in RCFORC if n != "side"]
        columns = [rows["contact" if n == "wall" else n] for n in names]
        tables.write_table(self.path("rwforc.tab"), names, columns, "done", meta["steps"])
        wall = compare.meta_of("wall", 10.0, 1000.0, 1.0, 0.01, 1.0, 1e-3, face1=meta["face1"])
        m = compare.measure(self.dir, wall)
        for name in ("err", "e_R", "e_R2", "osc"):
            self.assertLess(m[name], 2e-11, name)
        self.assertIsNone(m["momentum"])
        self.assertEqual(exact.touch, 0.01)

    def test_bounds(self):
        result = dict.fromkeys(compare.ORDER, 0.5)
        result.update(status="done", osc=None)
        met = [
            "err<=0.5",
            "err <= 0.5",
            "E_end in 0.4..0.6",
            "dE_end in -6e-3..0.5",
            "e_u>=.5",
            "e_R<0.6",
            "gapmin>-1e-9",
        ]
        self.assertEqual(compare.missed_bounds(result, met), [])
        missed = ["err<=0.4", "E_end in 0.6..1", "osc<=1", "e_R<0.5"]
        self.assertEqual(len(compare.missed_bounds(result, missed)), 4)
        result["err"] = float("nan")
        self.assertEqual(len(compare.missed_bounds(result, ["err<=1", "err>=0"])), 2)
        for text in ("err", "err=1", "nosuch<=1", "err<=x"):
            with self.assertRaises(ValueError):
                compare.missed_bounds(result, [text])

    def test_command_line(self):
        meta = make_bars.write(self.path("a.k"), meta_file=True, nx=20, courant=0.5)
        write_run(self.dir, meta)
        words = (self.dir, "--meta", self.path("a.json"), "--check", "err<=1e-10")
        code, text = self.call(compare.main, *words)
        self.assertEqual((code, text.splitlines()[-1]), (0, "all 1 bounds met"), text)
        code, text = self.call(compare.main, *words, "E_end in 0.5..0.9")
        self.assertEqual(code, 1)
        self.assertIn("E_end = 1, wanted in 0.5..0.9", text)
        code, text = self.call(
            compare.main,
            self.dir,
            "--L",
            "10",
            "--gap",
            "0.02",
            "--axis",
            "2,0",
            "--check",
            "err<=1e-10",
            "osc<=1e-9",
        )
        self.assertEqual(code, 0, text)
        self.assertEqual(self.call(compare.main, *words[:-1], "err=3")[0], 2)

    def test_a_failed_run_misses_its_bounds(self):
        meta = self.scene()
        write_run(self.dir, meta, status="failed")
        result = compare.measure(self.dir, meta)
        self.assertEqual(result["status"], "failed")
        self.assertEqual(len(compare.missed_bounds(result, ["err<=1"])), 1)


# ---------------------------------------------------------------- figures and demo

FAKE = """#!%s
import sys
sys.path.insert(0, %r)
import test_scripts
from test_scripts import make_bars
meta = make_bars.describe(courant=%s)
test_scripts.write_run(sys.argv[3], meta)
test_scripts.write_echo(sys.argv[3], courant=1.0)
"""


def write_echo(directory, **options):
    """The deck of a scene as a run leaves it: parameters resolved."""
    path = os.path.join(directory, "deck.echo.k")
    meta = make_bars.write(path, **options)
    with open(path, encoding="ascii") as stream:
        text = stream.read()
    for name, value in (
        ("v0", "%.1f" % meta["v0"]),
        ("mu", "0.0"),
        ("tend", "0.04"),
        ("dt", ""),
    ):
        text = text.replace("-&" + name, "-" + value).replace("&" + name, value)
    with open(path, "w", encoding="ascii") as out:
        out.write(text)


class FigureTest(Case):
    def setUp(self):
        super().setUp()
        self.meta = make_bars.write(self.path("a.k"), meta_file=True, nx=20, courant=0.5)
        write_run(self.dir, self.meta, chatter=0.2)

    def check_picture(self, path):
        with open(path, "rb") as stream:
            head = stream.read(24)
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreaterEqual(int.from_bytes(head[16:20], "big"), 1000)

    def test_figures_of_the_impact(self):
        for kind in ("displacement", "energy", "force"):
            path = self.path(kind + ".png")
            code, text = self.call(
                plot_history.main,
                self.dir,
                "--kind",
                kind,
                "--meta",
                self.path("a.json"),
                "-o",
                path,
            )
            self.assertEqual((code, text.strip()), (0, path))
            self.check_picture(path)

    def test_columns_of_any_table(self):
        path = self.path("f.png")
        words = (self.dir, "--table", "nodout", "--columns", "ux,vmx", "-o", path, "--id")
        node = "node=%d" % self.meta["face1"][0]
        self.assertEqual(self.call(plot_history.main, *words, node), (0, path + "\n"))
        self.check_picture(path)
        self.assertEqual(self.call(plot_history.main, *words, "node=999999")[0], 1)
        self.assertEqual(
            self.call(
                plot_history.main, self.dir, "--table", "none", "--columns", "ux", "-o", path
            )[0],
            1,
        )
        self.assertEqual(self.call(plot_history.main, self.dir, "-o", path)[0], 2)

    def test_dimensions(self):
        for table, column, unit in (
            ("glstat", "contact", " [F L]"),
            ("nodout", "ux", " [L]"),
            ("rcforc", "contact", ""),
            ("glstat", "residual", ""),
        ):
            self.assertEqual(plot_history.unit_of(table, column), unit)

    def test_missing_table_is_named(self):
        os.remove(self.path("rcforc.tab"))
        code, text = self.call(
            plot_history.main, self.dir, "--kind", "force", "-o", self.path("f.png")
        )
        self.assertEqual(code, 1)
        self.assertIn("no rows of table rcforc", text)


class DemoTest(Case):
    def demo(self, program):
        for name in ("newmark", "theta", "theta_dispersion"):
            with open(self.path(name + ".k"), "w", encoding="ascii") as out:
                out.write("*KEYWORD\n*END\n")
        with open(self.path("program"), "w", encoding="utf-8") as out:
            out.write(program)
        os.chmod(self.path("program"), 0o755)
        return subprocess.run(
            [
                sys.executable,
                os.path.join(SCRIPTS, "demo.py"),
                "--bin",
                self.path("program"),
                "--decks",
                self.dir,
                "--out",
                self.path("out"),
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=self.dir,
        )

    def test_figures_and_table(self):
        done = self.demo(FAKE % (sys.executable, HERE, "1.0"))
        self.assertEqual(done.returncode, 0, done.stderr)
        pictures = [n for n in os.listdir(self.path("out")) if n.endswith(".png")]
        self.assertEqual(len(pictures), 5)
        for name in pictures:
            self.assertIn(os.path.join("out", name), done.stdout)
        self.assertIn("theta    dispersion  1.0e-04", done.stdout)

    def test_a_failing_run_stops_the_demo(self):
        done = self.demo("#!/bin/sh\necho pivot is zero >&2\nexit 1\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("newmark.k ended with exit code 1", done.stderr)
        self.assertIn("pivot is zero", done.stderr)
        self.assertEqual(self.demo("#!/bin/sh\nexit 0\n").returncode, 1)  # no tables

    def test_a_missing_program_is_named(self):
        done = subprocess.run(
            [
                sys.executable,
                os.path.join(SCRIPTS, "demo.py"),
                "--bin",
                self.path("nothing"),
                "--out",
                self.path("out"),
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.assertEqual(done.returncode, 1)
        self.assertIn("nothing is missing", done.stderr)


class StyleTest(Case):
    FILES = [
        os.path.join(SCRIPTS, n + ".py")
        for n in (
            "analytic compare demo exact_scene fields make_bars plot_fields plot_history tables"
        ).split()
    ] + [__file__]

    def test_width_and_help(self):
        for path in self.FILES:
            with open(path, encoding="ascii") as stream:
                for number, line in enumerate(stream, 1):
                    self.assertLessEqual(len(line.rstrip("\n")), 96, (path, number))
                    self.assertEqual(line.rstrip(), line.rstrip("\n"), (path, number))
        for path in self.FILES[:-1]:
            done = subprocess.run([sys.executable, path, "--help"], stdout=subprocess.PIPE)
            self.assertEqual(done.returncode, 0, path)


def main(words):
    """Run the tests whose names contain a word; print the count as the last line."""
    suite, loader = unittest.TestSuite(), unittest.TestLoader()
    for case in (
        TablesTest,
        AnalyticTest,
        MakeBarsTest,
        CompareTest,
        FigureTest,
        DemoTest,
        StyleTest,
    ):
        for name in loader.getTestCaseNames(case):
            if not words or any(w in case.__name__ + "." + name for w in words):
                suite.addTest(case(name))
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=1).run(suite)
    failed = len(result.failures) + len(result.errors)
    print("%d passed, %d failed" % (result.testsRun - failed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
