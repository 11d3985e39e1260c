"""Deck cases against exact solutions. Every bound has its reason beside it."""

import itertools
import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import scenes
from scenes import at_most, bars, check, deck, finish, run_text, table, two_blocks, within


def exact_dispersion():
    """Mass DISPERSION at Courant 1 carries 1-D waves exactly: what is left is round-off.
    Displacement and energy collect about one unit in the last place (1e-16) a step and element
    crossing; the force divides a gap of that size by v h, the motion of a step, hence two
    digits less."""
    exact = dict(mass="DISPERSION", courant=1.0, output="step")
    runs = {"n%d" % n: dict(nx=n) for n in (10, 20, 100, 400)}
    runs["turned"] = dict(nx=50, angle=37.0)
    runs["three rows"] = dict(nx=50, ny=3)
    runs["unequal"] = dict(nx=50, length=5.0, length2=10.0, v1=1.0, v2=0.0)
    runs["impedance 3"] = dict(
        nx=50,
        young=3000.0,
        density=3.0e-3,
        length2=100.0,
        nx2=500,
        young2=1000.0,
        density2=1.0e-3,
        v1=1.0,
        v2=0.0,
    )
    for name, scene in runs.items():
        found, folder = bars(name.replace(" ", "_"), **dict(exact, **scene))
        at_most(found["err"], 1.0e-11, name + ": displacement")
        at_most(abs(found["dE_end"]), 1.0e-11, name + ": energy")
        at_most(found["e_R"], 1.0e-9, name + ": force of every step")
        at_most(found["osc"], 1.0e-9, name + ": step-mean velocity in contact")
        at_most(found["force_sum"], 0.0, name + ": sum of the forces on both sides")


def staircase():
    """Impedance ratio 3: the contact force falls by (Z1 - Z2)/(Z1 + Z2) = 1/2 every 2 L1/c1."""
    _, folder = bars(
        "staircase",
        nx=50,
        young=3000.0,
        density=3.0e-3,
        length2=100.0,
        nx2=500,
        young2=1000.0,
        density2=1.0e-3,
        v1=1.0,
        v2=0.0,
        mass="DISPERSION",
        courant=1.0,
        output="step",
        gap=0.02,
        tend=0.08,
    )
    force = table(folder, "rcforc", side=1)
    size, time = np.abs(force["fx"]), force["time"]
    for k, exact in enumerate((0.75, 0.375, 0.1875)):
        middle = (time > 0.02 + 0.02 * k + 0.001) & (time < 0.04 + 0.02 * k - 0.001)
        if middle.any() and time[-1] > 0.04 + 0.02 * k:
            at_most(
                np.abs(size[middle] - exact).max(), 1.0e-9, "force on interval %d" % (k + 1)
            )
    check(time[-1] > 0.06, "the run is long enough for two intervals")


def paper():
    """The paper's test, 100 elements a bar. Bounds are the targets of doc/verification.md: the
    error of the method on this mesh, which a faulty method would miss by factors."""
    found, _ = bars("theta")
    at_most(found["err"], 8.5e-3, "THETA: displacement")
    within(found["E_end"], 0.994, 1.0 + 1e-12, "THETA: energy")
    found, _ = bars("half", mass="DISPERSION", dt=5.0e-5)
    at_most(found["err"], 3.5e-3, "DISPERSION at Courant 1/2: displacement")
    within(found["E_end"], 0.995, 1.0 + 1e-12, "DISPERSION at Courant 1/2: energy")
    for dt in (1.0e-5, 5.0e-5):
        errors = []
        for touch in (0.0, 0.25, 0.5, 0.75):
            found, _ = bars("massless", mass="DISPERSION", redist=1, dt=dt, touch=touch)
            errors.append(found["err"])
            within(found["E_end"], 0.999, 1.0 + 1e-12, "massless: energy")
        at_most(np.mean(errors), 2.0e-3, "massless, dt %g: mean displacement error" % dt)
    found, folder = bars("newmark", scheme="NEWMARK")
    within(found["err"], 1.0e-2, 1.0e-1, "NEWMARK: displacement")
    check(found["E_max"] > 3.0, "NEWMARK gains energy on impact")
    log = open(os.path.join(folder, "bipact.log")).read()
    check("WARNING energy-growth" in log, "the growth is named in the log")
    found, _ = bars("literal", gap=0.2, tend=0.13)
    at_most(found["err"], 8.5e-3, "the paper's literal data: displacement")


def order():
    """Refining mesh and step together: first order or less across an impact; 0.7 in h was
    measured for the consistent mass by an independent 1-D code, 0.6 leaves room for the phase
    of the touch."""
    errors = [
        bars("order%d" % n, nx=n, courant=0.5, touch=0.5)[0]["err"] for n in (25, 50, 100, 200)
    ]
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    within(rates.mean(), 0.6, 1.3, "mean observed order")


def smooth_order():
    """A block sheared on a fixed foot, no contact: the motion is smooth in time and both
    schemes are of second order. Halving the step divides the difference of successive runs by
    4; the largest frequency times the coarsest step is 0.3, so terms of fourth order change
    that by a few per cent."""
    lines, sets = two_blocks(gap=5.0)
    block = list(sets[2])
    extra = ["*BOUNDARY_SPC_SET", "1,,1,1", "*BOUNDARY_SPC_NODE"]
    extra += ["%d,,1,1" % n for n in block[::3]] + ["*INITIAL_VELOCITY_NODE"]
    extra += ["%d,%r" % (n, 0.5 * (k % 3)) for k, n in enumerate(block) if k % 3]
    for scheme in ("THETA,0.5,0.5", "NEWMARK,"):
        for mass in ("CONSISTENT,0", "LUMPED,0"):
            ends = []
            for dt in (8.0e-5, 4.0e-5, 2.0e-5):
                folder, code, errors = run_text(
                    "smooth",
                    deck(
                        lines,
                        dt,
                        0.04,
                        scheme,
                        mass,
                        every=0.04,
                        history=block[-1:],
                        extra=extra,
                    ),
                )
                check(code == 0, errors)
                ends.append(table(folder, "nodout")["ux"][-1])
            within(
                (ends[0] - ends[1]) / (ends[1] - ends[2]), 3.7, 4.3, scheme + mass + " order 2"
            )


def ledger():
    """The balance closes to round-off for every scheme, mass and contact status, on
    non-matching meshes at an angle: 1e-12 a step, 1e-11 in all."""
    scene = dict(
        nx=20,
        ny=2,
        nx2=26,
        ny2=3,
        slide=0.1,
        poisson=0.3,
        dt=1.0e-4,
        ledger_every=1,
        output="step",
        angle=20.0,
    )
    for scheme in ("THETA", "NEWMARK"):
        for mass in ("CONSISTENT", "LUMPED", "DISPERSION"):
            for redist in (0, 1):
                for mu in (0.0, 0.3):
                    name = "%s_%s_%d_%g" % (scheme, mass, redist, mu)
                    _, folder = bars(
                        name, scheme=scheme, mass=mass, redist=redist, mu=mu, **scene
                    )
                    balance(name, folder, scheme == "THETA")
    for theta, xi in ((0.6, 0.6), (1.0, 1.0), (0.5, 0.8), (0.7, 0.5)):
        _, folder = bars("t%g_%g" % (theta, xi), theta=theta, xi=xi, mu=0.3, **scene)
        balance("theta %g, xi %g" % (theta, xi), folder, True)


def balance(name, folder, bounded):
    """Residual, and the growth that the scheme's own bound allows: r_n max(0, -g0) shows as a
    negative loss in contact, the unsolved part as itself."""
    rows = table(folder, "glstat")
    at_most(np.abs(rows["residual"]).max(), 1.0e-11, name + ": ledger residual")
    at_most(np.abs(np.diff(rows["residual"])).max(), 1.0e-12, name + ": ledger, one step")
    if bounded:
        free = rows["total"] - rows["external"]
        allowed = np.maximum(0.0, -np.diff(rows["contact"])) + np.maximum(
            0.0, np.diff(rows["unsolved"])
        )
        largest = np.abs(rows["total"]).max()
        at_most(
            (np.diff(free) - allowed).max() / largest,
            1.0e-13,
            name + ": growth beyond the bound",
        )
        check((np.diff(rows["friction"]) >= 0.0).all(), name + ": friction only takes energy")


def free_fall():
    """A body under gravity alone: both schemes have the parabola exactly, U = - g t^2/2 at step
    ends, and the external work is the kinetic energy. Round-off: 1e-16 a step, 100 steps."""
    for scheme in ("THETA,0.5,0.5", "NEWMARK,"):
        for mass in ("CONSISTENT,0", "LUMPED,0", "DISPERSION,0"):
            lines, sets = two_blocks(gap=5.0)
            fixed = ["*BOUNDARY_SPC_SET", "1,,1,1"]
            gravity = ["*DEFINE_CURVE", "1,", "0.0,10.0", "1.0,10.0", "*LOAD_BODY_Y", "1,1.0"]
            folder, code, errors = run_text(
                "fall",
                deck(
                    lines,
                    1.0e-3,
                    0.1,
                    scheme,
                    mass,
                    history=[max(sets[2])],
                    extra=fixed + gravity,
                ),
            )
            check(code == 0, errors)
            rows = table(folder, "nodout")
            exact = -5.0 * rows["time"] ** 2
            at_most(
                np.abs(rows["uy"] - exact).max() / 0.05, 1.0e-12, scheme + mass + ": parabola"
            )
            rows = table(folder, "glstat")
            at_most(np.abs(rows["residual"]).max(), 1.0e-11, scheme + mass + ": ledger")


def sliding_block():
    """A block sliding on a fixed base under gravity. While all of it slides |f_t| = mu f_n in
    every step, whatever the normal force does; it ends at rest, and the ledger closes. The
    stopping distance v0^2/(2 mu g) holds for a rigid block: the vertical bouncing of an elastic
    block set down unstressed and its rocking change it by O(mu) = 10 %."""
    v0, mu, g = 0.5, 0.2, 10.0
    lines, sets = two_blocks(young=1.0e5, nx=(9, 3), ny=(1, 3))
    extra = [
        "*BOUNDARY_SPC_SET",
        "1,,1,1",
        "*INITIAL_VELOCITY",
        "2,",
        "%r," % v0,
        "*DEFINE_CURVE",
        "1,",
        "0.0,%r" % g,
        "1.0,%r" % g,
        "*LOAD_BODY_Y",
        "1,1.0",
    ]
    folder, code, errors = run_text("slide", deck(lines, 5.0e-4, 0.4, mu=mu, extra=extra))
    check(code == 0, errors)
    force = table(folder, "rcforc", side=2)
    sliding = (force["nslip"] > 0) & (force["nstick"] == 0)
    check(sliding.sum() > 100, "the block slides for a while")
    off = np.abs(force["ft"] - mu * force["fn"])[sliding].max() / force["fn"].max()
    at_most(off, 1.0e-9, "Coulomb's law while sliding (certificate 1e-10)")
    check((force["ft"] <= mu * force["fn"] * (1.0 + 1e-9)).all(), "the cone is never left")
    balance("sliding block", folder, False)
    parts = table(folder, "matsum", part=2)
    distance = np.sum(0.5 * (parts["vx"][1:] + parts["vx"][:-1]) * np.diff(parts["time"]))
    within(distance / (v0**2 / (2.0 * mu * g)), 0.9, 1.1, "stopping distance / rigid one")
    check((force["nstick"] > 0).any(), "it sticks at the end")
    rows = table(folder, "glstat")
    within(rows["friction"][-1] / (0.5 * v0**2), 0.9, 1.1, "friction work / kinetic energy")


def sticking_block():
    """The same block at rest on a base that is tilted by body loads below the angle of friction
    stays: sliding would carry it a (g_x - mu g) t^2/2; stuck, only its shear moves it, g_x rho
    H^2/G."""
    lines, sets = two_blocks(young=1.0e5, nx=(9, 3), ny=(1, 3))
    extra = [
        "*BOUNDARY_SPC_SET",
        "1,,1,1",
        "*DEFINE_CURVE",
        "1,",
        "0.0,10.0",
        "1.0,10.0",
        "*DEFINE_CURVE",
        "2,",
        "0.0,0.0",
        "0.05,-2.0",
        "1.0,-2.0",
        "*LOAD_BODY_Y",
        "1,1.0",
        "*LOAD_BODY_X",
        "2,1.0",
    ]
    folder, code, errors = run_text("stick", deck(lines, 5.0e-4, 0.4, mu=0.6, extra=extra))
    check(code == 0, errors)
    parts = table(folder, "matsum", part=2)
    moved = abs(np.sum(0.5 * (parts["vx"][1:] + parts["vx"][:-1]) * np.diff(parts["time"])))
    at_most(moved, 0.05 * 0.5 * 2.0 * 0.4**2, "motion / 5 % of free sliding")
    balance("sticking block", folder, False)


def pulled_bar():
    """Nodal forces by a curve: momentum = impulse of the forces (trapezoidal rule, exact for a
    curve that is linear within each step)."""
    lines, sets = two_blocks(gap=5.0)
    ends = list(sets[2])[-3:]
    load = [
        "*BOUNDARY_SPC_SET",
        "1,,1,1",
        "*DEFINE_CURVE",
        "7,",
        "0.0,0.0",
        "0.05,2.0",
        "1.0,2.0",
        "*SET_NODE_LIST",
        "9,",
        ",".join(map(str, ends)) + ",",
        "*LOAD_NODE_SET",
        "9,1,7,0.5",
    ]
    for scheme in ("THETA,0.5,0.5", "NEWMARK,"):
        folder, code, errors = run_text("pull", deck(lines, 1.0e-3, 0.1, scheme, extra=load))
        check(code == 0, errors)
        rows = table(folder, "matsum", part=2)
        t = rows["time"]
        impulse = 3 * 0.5 * np.where(t < 0.05, 20.0 * t**2, 0.05 + 2.0 * (t - 0.05))
        at_most(
            np.abs(rows["momx"] - impulse).max() / impulse.max(), 1.0e-12, scheme + " impulse"
        )
        balance(scheme, folder, False)


def engines():
    """Every engine with every order, as the program names them, gives the run of the default,
    to round-off: displacement 1e-9 as for any other change of round-off."""
    scene = dict(nx=20, ny=2, dt=5.0e-5, touch=0.5, mu=0.3, poisson=0.3)
    _, folder = bars("default", **scene)
    base = table(folder, "nodout")
    text = open(os.path.join(scenes.TMP, "default.k")).read()
    # DIAGONAL is the engine of explicit runs: tests/decks/explicit.py; MUMPS that of several
    # ranks: tests/mpi.
    engine_names = [e for e in scenes.words_of("ENGINE") if e not in ("DIAGONAL", "MUMPS")]
    pairs = list(itertools.product(engine_names, scenes.words_of("ORDER")))
    check({("SKYLINE", "METIS"), ("SUPERNODAL", "RCM")} <= set(pairs), "engines and orders by name")
    for engine, order_name in pairs:
        card = "*BIPACT_SOLVER\n%s,%s,\n*END" % (engine, order_name)
        other, code, errors = run_text(engine + order_name, text.replace("*END", card))
        check(code == 0, errors)
        rows = table(other, "nodout")
        off = (
            max(np.abs(rows[c] - base[c]).max() for c in ("ux", "uy"))
            / np.abs(base["ux"]).max()
        )
        at_most(off, 1.0e-9, "%s %s" % (engine, order_name))
    card = "*BIPACT_SOLVER\nCG,,,,,1\n*END"
    other, code, errors = run_text("few", text.replace("*END", card))
    check(code == 1 and "not converged in 1 iterations" in errors, "CGMAX 1: " + errors)


def idle():
    """A feature that is there but idle changes no digit: a contact card whose bodies never
    meet, against no contact card; and its counts are zero."""
    scene = dict(nx=20, gap=5.0, tend=0.02, dt=1.0e-4)
    _, folder = bars("with", **scene)
    text = open(os.path.join(scenes.TMP, "with.k")).read()
    start = text.index("*CONTACT_2D")
    end = text.index("*", start + 1)
    without, code, errors = run_text("without", text[:start] + text[end:])
    check(code == 0, errors)
    for name in ("glstat", "nodout", "matsum"):
        a, b = table(folder, name), table(without, name)
        for column in a.names:
            check(np.array_equal(a[column], b[column]), "%s.%s differs" % (name, column))
    log = open(os.path.join(without, "bipact.log")).read()
    check("contact solves 0" in log and "contact searches 0" in log, "no contact: no calls")
    check(
        "contact solves 0" in open(os.path.join(folder, "bipact.log")).read(), "idle: no solve"
    )


def crossing():
    """A bar at rest far from a thin one is kicked through its place within one step, which its
    lists could not foresee: the step is solved again with longer ones, and the thin bar is
    pushed. The face of the first stays behind that of the other, to PENTOL (1e-9 edge) and as
    much of round-off; energy is what the loads have given, at most."""
    deck_file = os.path.join(scenes.TMP, "kick.k")
    scenes.make_bars.write(
        deck_file, nx=4, nx2=1, length2=0.02, gap=6.0, dt=1.0e-2, tend=0.2, output="step"
    )
    text = open(deck_file).read().replace("&v0", "0.0").replace("-0.0", "0.0")
    nodes = [str(n) for n in range(1, 11)]
    kick = (
        "*SET_NODE_LIST\n99,\n%s,\n%s,\n*DEFINE_CURVE\n1,\n0.0,0.0\n0.05,0.0\n0.06,1.0\n1.0,1.0\n"
        "*LOAD_NODE_SET\n99,1,1,%s\n*END" % (",".join(nodes[:8]), ",".join(nodes[8:]), "800.0")
    )
    folder, code, errors = run_text("kicked", text.replace("*END", kick))
    check(code == 0, "exit code %d: %s" % (code, errors))
    log = open(os.path.join(folder, "bipact.log")).read()
    again = int(re.search(r"steps that outran a list (\d+)", log).group(1))
    check(again > 0, "no step was solved again")
    rows = table(folder, "nodout")
    x = {n: rows["x"][rows["node"] == n] for n in (9, 11)}
    moved = np.diff(x[9]).max()
    check(moved > 6.02, "the kick is too small for its test: %g" % moved)
    at_most((x[9] - x[11]).max(), 2.0e-9, "the face beyond the other")
    # ACTION STOP's own bound: a longer list may not give energy.
    rows = table(folder, "glstat")
    growth = (rows["total"] - rows["external"]).max() / rows["external"].max()
    at_most(growth, 1.0e-9, "energy that the loads have not given")
    last = open(os.path.join(folder, "glstat.tab")).read().splitlines()[-1]
    check(last.startswith("# end: done, cycle"), last)


def commands():
    """-D, --check, --plan, the echo deck, a cut last step."""
    _, folder = bars("plain", nx=10, dt=1.0e-4)
    plain = os.path.join(scenes.TMP, "plain.k")
    echo = os.path.join(folder, "deck.echo.k")
    again = os.path.join(scenes.TMP, "again")
    code, errors, _ = scenes.bipact(echo, again, "--quiet")
    check(code == 0, errors)
    for name in ("glstat", "nodout", "rcforc"):
        same = (
            open(os.path.join(folder, name + ".tab")).read()
            == open(os.path.join(again, name + ".tab")).read()
        )
        check(same, "the echo deck gives another " + name)
    for option in ("--check", "--plan"):
        other = os.path.join(scenes.TMP, "none" + option)
        code, errors, out = scenes.bipact(plain, other, option)
        check(code == 0 and not os.path.exists(other), option + " writes no file")
        check("friction    off" in out, option + " shows the plan")
    needs = [line for line in out.splitlines() if line.startswith(("solver ", "of it "))]
    dofs = re.findall(r"of it for (\d+) contact dofs (\d+) bytes", "".join(needs))
    check(
        len(needs) == 2 and int(dofs[0][1]) == 8 * int(dofs[0][0]) ** 2,
        "--plan says what the factor and the contact dofs need: %s" % needs,
    )
    with open(os.path.join(folder, "bipact.log"), encoding="utf-8") as file:
        log = file.read()
    check("\n".join(needs) in log, "--plan says what the run needs")
    # Memory against that of the run. Time is not judged here, on a machine that may be busy, but
    # in bench/forecast.py; here it must be that of the steps, and what comes before them.
    forecast = r"forecast: memory (\d+) MB, start \S+ s, a step (\S+) s, the run (\S+) s at"
    memory, step, whole = map(float, re.search(forecast, out).groups())
    was = re.search(r"peak memory (\d+) kB", log)
    within(1.0e3 * memory / float(was[1]), 0.7, 1.4, "--plan: memory over that of the run")
    steps = table(folder, "glstat")["cycle"][-1]
    within(whole / (step * steps), 0.9, 1.5, "--plan: the run is its steps")
    check("forecast of the steps: " in log, "the log has what was forecast and what was")
    code, errors, _ = scenes.bipact(
        plain, os.path.join(scenes.TMP, "v2"), "--quiet", "-D", "v0=2.0"
    )
    a, b = table(folder, "glstat"), table(os.path.join(scenes.TMP, "v2"), "glstat")
    at_most(
        abs(b["kinetic"][0] / a["kinetic"][0] - 4.0), 1.0e-14, "-D v0=2.0 quadruples the energy"
    )
    code, errors, _ = scenes.bipact(plain, os.path.join(scenes.TMP, "v3"), "-D", "speed=2.0")
    check(code == 2 and "no such parameter" in errors, "an unknown parameter is an error")
    _, folder = bars("cut", nx=10, dt=3.0e-5, tend=0.04)
    rows = table(folder, "glstat")
    at_most(abs(rows["time"][-1] - 0.04), 1.0e-17, "the cut step ends at ENDTIM")
    balance("cut step", folder, True)
    lines, _ = two_blocks(gap=5.0)
    folder, code, errors = run_text("cut2", deck(lines, 3.0e-4, 1.0e-3))
    check(code == 0, "a cut step without contact: " + errors)


def awkward():
    """Legal but awkward forms of one deck: every one gives the tables of the plain form."""
    base = open(os.path.join(scenes.ROOT, "tests", "bad_decks", "base.k")).read()
    node = "       2             1.0             0.0\n"
    material = "         1     0.001    1000.0       0.3"
    forms = {
        "carriage returns": base.replace("\n", "\r\n"),
        "byte-order mark": "\ufeff" + base,
        "lower case": "\n".join(x.lower() if x[:1] == "*" else x for x in base.split("\n")),
        "no end": base.replace("*END\n", ""),
        "text after the end": base + "anything\n*NONSENSE\n",
        "comments": base.replace("*NODE\n", "*NODE\n$ caf\u00e9, a comment\n$#   nid\n"),
        "comma form": base.replace(node, "2, 1.0, 0.0\n").replace(
            material, "1,0.001,1000.0,0.3"
        ),
        "bare exponent": base.replace(node, "       2           1.0+0           0.0-2\n"),
        "d exponent": base.replace(node, "       2          1.00D0           0.0d0\n"),
        "packed columns": base.replace(material, "         11.00000E-31000.00000      .300"),
        "long form": base.replace(
            "*MAT_ELASTIC\n" + material,
            "*MAT_ELASTIC+\n" + "".join(x.rjust(20) for x in ("1", "0.001", "1000.0", "0.3")),
        ),
        "padding zeros": base.replace(
            "         4\n*INIT", "         4         0         0\n*INIT"
        ),
        "title with commas": base.replace("a block in flight, the", "a, b,, c, the"),
        "keyword with remark": base.replace("*NODE\n", "*NODE (four of them)\n"),
        "set in comma form": base.replace(
            "         1         2         3         4\n*INIT", "1, 2, 3\n4,\n*INIT"
        ),
        "set by a range": base.replace(
            "*SET_NODE_LIST\n         1\n         1         2         3         4",
            "*SET_NODE_LIST_GENERATE\n         1\n         1         2         3         9",
        ),
        "set by ranges that overlap": base.replace(
            "*SET_NODE_LIST\n         1\n         1         2         3         4",
            "*SET_NODE_LIST_GENERATE\n         1\n         3         3         1         2\n"
            "         2         4         42147483647\n         0         0",
        ),
        "long deck with standard blocks": re.sub(
            r"(?m)^(\*(?!KEYWORD|PARAMETER|END)\w+)$", r"\1-", base
        )
        .replace("*KEYWORD", "*KEYWORD LONG=Y memory=20m")
        .replace(
            "*PARAMETER\nRtend           0.01Rdt            1e-03",
            "*PARAMETER\nRtend                               0.01Rdt                                1e-03",
        ),
        "explicit zeros for defaults": base.replace("       1.0\n*MAT", "       0.0\n*MAT"),
        "words from a parameter": base.replace(
            "1e-03\n", "1e-03Cscheme        theta\n", 1
        ).replace("     THETA       0.5", "   &scheme       0.5"),
        "numbers in any case": base.replace("1000.0       0.3", "1.0D+3       .3"),
        "blank card for defaults": base.replace(
            "*DATABASE_GLSTAT", "*BIPACT_CONTACT\n\n*DATABASE_GLSTAT"
        ),
        "minus parameter": base.replace("Rtend           0.01", "Rtend          -0.01").replace(
            "     &tend", "    -&tend"
        ),
    }
    plain, code, errors = run_text("plain", base)
    check(code == 0, errors)
    rows = table(plain, "glstat")
    with open(os.path.join(scenes.TMP, "a_part_of_it.k"), "w") as out:
        out.write("*NODE\n" + node + "*END\nnot read\n")
    forms["include with a continued name"] = base.replace(
        node, "*INCLUDE\na_part +\n_of_it.k\n*NODE\n"
    )
    for name, text in forms.items():
        check(text != base, name + " changes the deck")
        folder, code, errors = run_text("awkward", text)
        check(code == 0, name + ": " + errors)
        other = table(folder, "glstat")
        check(
            all(np.array_equal(rows[c], other[c]) for c in rows.names), name + ": other tables"
        )


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
