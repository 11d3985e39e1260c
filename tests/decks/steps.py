"""Steps that are halved where one is refused (MODE HALVE) or cut where bodies touch (EVENT): what
must hold, each bound with its reason beside it."""

import json
import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import contact_geometry as geometry
import numpy as np
import scenes
from scenes import at_most, bipact, check, finish, make_bars, run_text, table, within

import compare
import make_scenes

# Of the largest term: over a run, in one step (conventions of the ledger).
LEDGER, ONE_STEP = 1.0e-11, 1.0e-12
STEP = "*BIPACT_STEP\n%s,\n"
SCHEMES = ("THETA,0.5", "THETA,0.7,0.6", "NEWMARK,", "HHT,", "GENALPHA,,,,0.8")
ON_VELOCITIES = ("MOREAU,0.5", "THETAPV,", "NSGENALPHA,", "CSNEWMARK,")    # no EVENT


def with_cards(text, cards):
    assert text.count("*END") == 1
    return text.replace("*END", cards + "*END")


def counts(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)["counts"]


def coarse(scene, times, scheme="THETA,0.5"):
    """The deck of a scene with steps so many times as long, rows of every step."""
    steps = max(2, scene.steps // times)
    scene.dt, scene.steps = scene.dt * scene.steps / steps, steps
    scene.every, scene.scheme = scene.dt * 1.0e-3, scheme
    text = scene.text()
    if scheme.startswith("HHT"):
        dynamics = "*CONTROL_IMPLICIT_DYNAMICS\n1,"
        text = text.replace(dynamics, dynamics + ",,,,,,-0.3")
    return text


def closes(name, folder):
    rows = table(folder, "glstat")
    at_most(np.abs(rows["residual"]).max(), LEDGER, name + ": ledger")
    at_most(np.abs(np.diff(rows["residual"])).max(), ONE_STEP, name + ": ledger, one step")
    return rows


def event_is_exact():
    """Two bars, and a bar and a wall, with the mass DISPERSION at Courant number 1: exact for a
    touch at any fraction of a step, by one cut there. Bound as for a touch on a step: round-off
    of 400 steps. The rest of the cut step comes last, as the step that ends the run."""
    for scene in ("bars", "wall"):
        for touch in (0.25, 0.5, 0.75):
            name = "%s, touch at %g" % (scene, touch)
            deck, folder = os.path.join(scenes.TMP, "exact.k"), os.path.join(scenes.TMP, "exact")
            data = dict(mass="DISPERSION", courant=1.0, touch=touch)
            if scene == "bars":
                meta = make_bars.write(deck, nx=100, output=1.0e-7, **data)
            else:
                meta = make_scenes.write(deck, "wall", n=100, **data)
            with open(deck) as file:
                text = file.read()
            folder, code, errors = run_text("exact", with_cards(text, STEP % "EVENT"))
            check(code == 0, name + errors)
            found = compare.measure(folder, meta)
            at_most(found["err"], 1.0e-11, name + ": displacement")
            at_most(abs(found["dE_end"]), 1.0e-11, name + ": energy")
            check(counts(folder)["steps_cut"] == 1, name + ": one cut")
            rows = closes(name, folder)
            if scene == "wall":  # rows of whole steps, not of the cut one
                continue
            lengths = rows["dt"] / meta["dt"]
            cut = np.nonzero(lengths < 1.0 - 1.0e-6)[0][0]
            at_most(abs(lengths[cut] - touch), 1.0e-9, name + ": length of the cut step")
            at_most(abs(lengths[cut + 1] - 1.0), 1.0e-9, name + ": a whole step follows")


def every_scheme():
    """Every scheme of one step, with friction: its ledger closes with steps that are cut, and
    with steps that are halved because a contact solve of few sweeps fails (as it may with the
    shortest step too: then it closes up to there)."""
    for name, mode, make, times, sweeps in (
        ("corner", "EVENT", lambda: geometry.corner_on_edge(mu=0.3), 5, 10000),
        ("three bodies", "EVENT", geometry.three_bodies, 5, 10000),
        ("slider", "EVENT", lambda: geometry.pressed_slider(mu=0.3), 20, 10000),
        ("L", "HALVE", lambda: geometry.corner_of_l((4, 3), (-3.0, -2.0), 0.6), 5, 12),
        ("three bodies", "HALVE", lambda: geometry.three_bodies(0.6), 20, 50),
    ):
        for scheme in SCHEMES + (ON_VELOCITIES if mode == "HALVE" else ()):
            what = "%s, %s, %s" % (name, scheme, mode)
            text = with_cards(coarse(make(), times, scheme), STEP % mode)
            text = with_cards(text, "*BIPACT_CONTACT\nGS,,%d\n" % sweeps)
            folder, code, errors = run_text("ledger", text.replace("STOP", "WARN"))
            check(code == 0 or "converge in %d" % sweeps in errors, what + errors)
            rows = closes(what, folder)
            changed = counts(folder)["steps_cut" if mode == "EVENT" else "steps_halved"]
            scenes.show("%s: %d" % (what, changed))
            check(changed > 0, what + ": no step is refused")
            check(rows["dt"].min() < 0.999 * rows["dt"].max(), what + ": all steps are equal")
            if name in ("corner", "L") and scheme[:3] in ("THE", "NEW"):
                momentum_is_impulse(what, folder)


def momentum_is_impulse(what, folder):
    """Without other forces, for schemes whose contact force is the change of momentum: impulses
    know the length of each step. Round-off beside the momentum that changes hands."""
    for axis in "xy":
        p = table(folder, "matsum", part=1)["mom" + axis]
        i = table(folder, "rcforc", side=1)["i" + axis]
        scale = np.abs(p - p[0]).max() + np.abs(i).max()
        if scale > 0.0:
            at_most(np.abs(p - p[0] - i).max() / scale, 1.0e-9, what + ": impulse in " + axis)


def halved_where_refused():
    """Contact solves of few sweeps fail with DT0 (exit 1) and not with shorter steps: HALVE goes
    to the end. Lengths are DT0/2^k, on the grid; no two steps are longer than the one before
    them by more than twice, and four good ones come before. MAXHALF and DTMIN bound them."""
    make = lambda: geometry.three_bodies(0.6)
    cards = "*BIPACT_CONTACT\nGS,,25\n"
    text = with_cards(coarse(make(), 20), cards)
    _, code, errors = run_text("refused", text)
    check(code == 1 and "converge" in errors, "DT0 fails: %d %s" % (code, errors))
    folder, code, errors = run_text("halved", with_cards(text, STEP % "HALVE"))
    check(code == 0, "HALVE: " + errors)
    rows = closes("halved", folder)
    scene = make()
    dt = rows["dt"].max()
    levels = np.log2(dt / rows["dt"][1:])
    at_most(np.abs(levels - np.round(levels)).max(), 1.0e-12, "lengths are DT0/2^k")
    check(levels.max() >= 3.0, "halved more than twice")
    end = rows["time"][1:] / rows["dt"][1:]
    at_most(np.abs(end - np.round(end)).max(), 1.0e-9, "steps end on their grid")
    up = np.nonzero(np.diff(levels) < -0.5)[0]
    check(len(up) > 2, "steps grow again")
    check((np.diff(levels)[up] > -1.5).all(), "by twice at most")
    check(all((levels[k - 3 : k + 1] == levels[k]).all() for k in up), "after four good ones")
    check(counts(folder)["steps_halved"] >= int(levels.max()), "halvings are counted")
    with open(os.path.join(folder, "bipact.log")) as log:
        log = log.read()
    check("steps halved %d, cut" % counts(folder)["steps_halved"] in log, "the log tells")
    check("MODE HALVE" in log, "the plan tells")
    at_most(abs(rows["time"][-1] - scene.dt * scene.steps), 1.0e-12, "it ends at ENDTIM")
    for card, smallest in (("HALVE,,,,1", 0.5), ("HALVE,%r" % float(0.3 * dt), 0.5), ("HALVE,,,,0", 1)):
        _, code, errors = run_text("bounded", with_cards(text, "*BIPACT_STEP\n%s\n" % card))
        shortest = table(os.path.join(scenes.TMP, "bounded"), "glstat")["dt"].min()
        check(code == 1, card + ": exit code %d" % code)
        at_most(abs(shortest / dt - smallest), 1.0e-12, card + ": shortest step")


def overlap_is_halved():
    """A slider that is pressed into an edge by far too long steps: with DT0 an overlap is warned
    of, with halved steps there is none."""
    text = coarse(geometry.pressed_slider(), 80)
    folder, code, errors = run_text("long", text)
    check("WARNING overlap" in geometry.log_of(folder), "DT0: an overlap is warned of")
    folder, code, errors = run_text("short", with_cards(text, STEP % "HALVE"))
    check(code == 0 and "WARNING overlap" not in geometry.log_of(folder), "HALVE: " + errors)
    check(counts(folder)["steps_halved"] > 0, "a step is halved")
    closes("overlap", folder)


def automatic_is_halve():
    """*CONTROL_IMPLICIT_AUTO with IAUTO 1 is MODE HALVE, to the last byte of every table; ITEOPT
    is noted. Nothing is refused: MODE HALVE is MODE FIXED."""
    text = with_cards(coarse(geometry.three_bodies(0.6), 20), "*BIPACT_CONTACT\nGS,,50\n")
    card = "*CONTROL_IMPLICIT_AUTO\n1,11,5,%s\n"
    runs = [run_text("halve", with_cards(text, STEP % "HALVE"))[0]]
    for shortest in ("", "0.0", "%r" % (geometry.three_bodies().dt * 20 / 1024)):
        runs.append(run_text("auto", with_cards(text, card % shortest))[0])
        check("ITEOPT is not used" in geometry.log_of(runs[-1]), "a note on ITEOPT")
        same_tables("IAUTO 1", runs[0], runs[-1])
    text = coarse(geometry.three_bodies(0.2), 5)
    runs = [run_text(mode, with_cards(text, STEP % mode))[0] for mode in ("FIXED", "HALVE")]
    same_tables("nothing refused", *runs)


def same_tables(what, one, other):
    names = [x for x in os.listdir(one) if x.endswith(".tab")]
    check(len(names) > 3, what + ": tables")
    for name in names:
        with open(os.path.join(one, name), "rb") as a, open(os.path.join(other, name), "rb") as b:
            check(a.read() == b.read(), "%s: %s differs" % (what, name))


def rows_and_loads():
    """The block of every keyword (motions that begin and end, loads, walls, reactions) with steps
    that are cut, and a last one that is: the ledger closes, rows are due at the first step end
    from each multiple of their interval on. ENDCYC counts parts of a step as steps."""
    path = os.path.join(os.environ["ROOT"], "input", "cards", "every_keyword.k")
    for scheme in ("THETA", "NEWMARK", "GENALPHA"):
        for end in ("0.02", "0.01985"):
            what = "every keyword, %s, to %s" % (scheme, end)
            folder = os.path.join(scenes.TMP, "every")
            options = ("mode=EVENT", "scheme=" + scheme, "tend=" + end)
            code, errors, _ = bipact(path, folder, *(x for o in options for x in ("-D", o)))
            check(code == 0, what + errors)
            check(counts(folder)["steps_cut"] > 0, what + ": no step is cut")
            rows = table(folder, "glstat")
            at_most(np.abs(rows["residual"]).max(), LEDGER, what + ": ledger")
            at_most(abs(rows["time"][-1] - float(end)), 1.0e-15, what + ": it ends at ENDTIM")
    text = with_cards(coarse(geometry.three_bodies(0.2), 5), STEP % "EVENT")
    whole = table(run_text("whole", text)[0], "glstat")["time"]
    dt = geometry.three_bodies().dt * 5
    wanted = text.replace("*DATABASE_GLSTAT\n%r," % (dt * 1.0e-3), "*DATABASE_GLSTAT\n%r," % (2.5 * dt))
    check(wanted != text, "the interval of GLSTAT")
    rows = table(run_text("sparse", wanted)[0], "glstat")["time"]
    due = [whole[whole >= k * 2.5 * dt - 1.0e-9 * dt].min() for k in range(int(whole[-1] / 2.5 / dt))]
    check(set(due) <= set(rows) and len(rows) <= len(due) + 2, "rows at the first step end")
    last, one = re.subn(r"(\*CONTROL_TERMINATION\n[^,]*,)", r"\g<1>20", text)
    check(one == 1, "ENDCYC is given")
    rows = table(run_text("last", last)[0], "glstat")
    check(rows["cycle"][-1] == 20 and (rows["time"] == whole[:21]).all(), "ENDCYC counts cut steps")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
