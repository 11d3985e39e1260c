"""Contact geometry: which nodes are watched, which edges they meet, with which normals, and that
no overlap makes energy. Every bound has its reason beside it."""

import os
import re
import sys
from math import cos, pi, sin

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import scenes
from bodies import Scene, box, overlaps
from scenes import at_most, check, finish, run_text, show, table, within

# A scene that stops where energy grows by more than 1e-9 of its largest term.
STOP = ["*BIPACT_LEDGER", "1,,STOP"]


def run(name, scene, *options):
    """Runs a scene that must end well; returns (folder, positions of all nodes)."""
    folder, code, errors = run_text(name, scene.text(), *options)
    if code != 0:
        raise RuntimeError("%s: exit code %d: %s" % (name, code, errors))
    return folder, scene.positions(table(folder, "nodout"))


def log_of(folder):
    with open(os.path.join(folder, "bipact.log")) as log:
        return log.read()


def counted(folder, words):
    """The number that follows some words in the log."""
    return int(re.search(re.escape(words) + r" (\d+)", log_of(folder)).group(1))


def growth(folder):
    """Largest total - external - motion in parts of the energy at the start; of the largest
    total where that is 0."""
    rows = table(folder, "glstat")
    free = rows["total"] - rows["external"] - rows["motion"]
    return free.max() / (rows["initial"][0] or np.abs(rows["total"]).max())


def kept(name, folder):
    """Energy is never made (1e-9: the growth that ACTION STOP allows); the ledger closes to
    round-off, as everywhere."""
    at_most(growth(folder), 1.0 + 1.0e-9, name + ": energy")
    at_most(np.abs(table(folder, "glstat")["residual"]).max(), 1.0e-11, name + ": ledger")


def first_force(folder):
    """Number of the first step with a contact force; output of every step."""
    rows = table(folder, "rcforc", side=1)
    return int(np.nonzero((rows["fx"] != 0.0) | (rows["fy"] != 0.0))[0][0])


# 1. What the nodes of one side alone do not see.


def slab(mirror=False):
    """A block between the nodes of a coarse slab."""
    scene = Scene(mirror=mirror)
    block = scene.body(2, 2, box(0.27, 0.00315, 0.4, 0.4), (0.0, -1.0))
    base = scene.body(1, 1, box(0.0, -0.7, 1.1, 0.7))
    scene.hold(base.row(0))
    scene.contact(1, 2)
    return scene


def corner_on_edge(order=(1, 2), mu=0.0):
    """A turned block falls with its corner on a coarse base."""
    scene = Scene(dt=5.0e-5, steps=300)
    scene.body(3, 3, box(0.12, 0.00142, 0.8, 0.8, 0.6), (0.0, -2.0))
    base = scene.body(3, 1, box(-1.3, -0.8, 3.0, 0.8))
    scene.hold(base.row(0))
    scene.contact(*order, mu)
    return scene


def corner_between(order=(1, 2)):
    """A fine plate falls on the corner of a coarse body, which meets it between two nodes."""
    scene = Scene(steps=250)
    scene.body(8, 2, box(-0.83, 0.00213, 1.6, 0.3), (0.0, -1.0))
    roof = scene.body(1, 1, None, ring=[(-0.7, -0.6), (0.66, -0.6), (0.031, 0.0)])
    scene.hold([roof.at[0, 0], roof.at[1, 0]])
    scene.contact(*order)
    return scene


def wedge_tip(order=(1, 2)):
    """The sharp tip of a triangle falls on a coarse base."""
    scene = Scene(dt=5.0e-5, steps=300)
    scene.body(1, 1, None, (0.0, -2.0), ring=[(0.23, 0.00178), (0.41, 1.0), (0.08, 1.0)])
    base = scene.body(2, 1, box(-0.5, -0.6, 1.6, 0.6))
    scene.hold(base.row(0))
    scene.contact(*order)
    return scene


def corner_touch():
    """Corners and faces that the nodes of the finer side do not see meet when they touch, one
    step more or less for the round-off of the gap. All rows are exact but those of corners flat
    on finer edges, which here are none: overlap is what an edge turns under a node that slips,
    of second order in the step; 1e-6 of the edge was measured to be ample."""
    for name, make, gap, speed, dt in (
        ("slab", slab, 3.15e-3, 1.0, 1.0e-4),
        ("corner on edge", corner_on_edge, 1.42e-3, 2.0, 5.0e-5),
        ("corner between nodes", corner_between, 2.13e-3, 1.0, 1.0e-4),
        ("wedge tip", wedge_tip, 1.78e-3, 2.0, 5.0e-5),
    ):
        for order in ((1, 2), (2, 1)) if make is not slab else ((),):
            scene = make(order) if order else make()
            name_here = "%s %s" % (name, order)
            folder, x = run("touch", scene)
            touch = int(gap / (speed * dt)) + 1
            at_most(abs(first_force(folder) - touch), 1, name_here + ": step of the touch")
            _, share = overlaps(x, scene.bodies[0].rings, scene.bodies[1].rings)
            at_most(share.max(), 1.0e-6, name_here + ": overlap")
            kept(name_here, folder)
            rows = table(folder, "matsum", part=1)
            check(rows["vy"].max() > 0.0, name_here + ": it comes back")


def refused(name, scene, code_expected, *words):
    """A run that ends with a code and a message with all these words."""
    folder, code, errors = run_text("refused", scene.text())
    show("%s: exit %d: %s" % (name, code, errors.strip().replace("\n", " | ")))
    check(code == code_expected, "%s: exit code %d: %s" % (name, code, errors))
    for word in words:
        check(re.search(word, errors), '%s: no "%s" in: %s' % (name, word, errors))
    check("refine the step" not in errors, "%s: the step is not to blame: %s" % (name, errors))


def overlapped_start():
    """Bodies that overlap at the start: exit 2 with the node, how deep it is and that it is so
    at the start. A corner inside, bodies flush on three sides with no node inside either, a
    plus with no node inside."""
    for order in ((1, 2), (2, 1)):
        scene = Scene()
        scene.body(2, 2, box(0.3, -0.04, 0.4, 0.4, 0.7))
        scene.body(1, 1, box(-1.0, -1.0, 2.5, 1.0))
        scene.contact(*order)
        refused("corner %s" % (order,), scene, 2, r"node 1 is 0\.04\d* deep", "at the start")
        scene = Scene()
        scene.body(3, 2, box(0.0, 0.0, 1.0, 0.5))
        scene.body(3, 2, box(0.9, 0.0, 1.0, 0.5))
        scene.contact(*order)
        refused("flush %s" % (order,), scene, 2, r"node \d+ .*0\.\d+ deep", "at the start")
        scene = Scene()
        scene.body(1, 1, box(-1.0, -0.1, 2.0, 0.2))
        scene.body(1, 1, box(-0.11, -0.9, 0.2, 1.9))
        scene.contact(*order)
        refused("plus %s" % (order,), scene, 2, r"node \d+ .*0\.\d+ deep", "at the start")


def born_overlapped():
    """A contact whose TBIRTH finds a block 0.05 deep in a plate: exit 1, born overlapped; also
    where a wall has the nodes of one of them on its list."""
    for wall in (None, 0, 1):
        scene = Scene(dt=1.0e-3, steps=100)
        made = [scene.body(2, 2, box(0.31, 0.01, 0.5, 0.6), (0.0, -1.0), young=50.0)]
        made += [scene.body(5, 1, box(0.0, -0.1, 1.2, 0.1))]
        scene.hold(made[1].row(0))
        if wall is not None:
            scene.wall(made[wall].nodes(), (0.0, -0.1 if wall else -0.3), (0.0, 1.0))
        scene.contact(1, 2, birth=0.0605)
        refused("wall %s" % wall, scene, 1, r"node \d+ is 0\.0[45]\d* deep", "born overlapped")


# 2. Two edges at a time.


def corner_of_l(cells=(3, 3), speed=(-3.0, -3.0), mu=0.0, fine=1, place=(0.506, 0.508)):
    """A block flies into the inner corner of an L."""
    scene = Scene(dt=1.0e-4 / fine, steps=300 * fine)
    scene.body(*cells, box(*place, 0.7, 0.6), speed, poisson=0.2)
    ell = scene.body(4, 4, box(0.0, 0.0, 2.0, 2.0), keep=lambda i, j: i < 1 or j < 1)
    scene.hold(sorted({*ell.row(0), *ell.column(0)}))
    scene.contact(1, 2, mu)
    scene.cards += STOP
    return scene


def v_groove(mu=0.0, fine=1, shift=0.0):
    """The tip of a turned block flies to the bottom of a groove of one body."""
    scene = Scene(dt=5.0e-5 / fine, steps=300 * fine)
    scene.body(3, 3, box(shift, 0.002 + 0.9 * abs(shift), 0.5, 0.5, pi / 4), (0.0, -3.0))
    groove = scene.body(
        6, 3, lambda a, b: (2.6 * a - 1.3, 0.9 * abs(2.6 * a - 1.3) * b - 1.2 * (1.0 - b))
    )
    scene.hold(groove.row(0))
    scene.contact(1, 2, mu)
    scene.cards += STOP
    return scene


def inner_corner():
    """A node that meets two edges has two rows. Energy is never made, in any row of glstat, at
    any step; overlap: smooth vertices and turning edges leave up to the allowance of 1e-3 of the
    shorter edge, and 1.5 of it before a row is added."""
    for fine in (1, 4):
        for name, scene in (
            ("L", corner_of_l(fine=fine)),
            ("L, friction", corner_of_l((4, 3), (-3.0, -2.0), 0.3, fine)),
            ("L, finer block", corner_of_l((6, 5), (-2.0, -3.0), 0.0, fine)),
            ("L, one side first", corner_of_l((3, 2), (-3.0, -2.0), 0.0, fine, (0.52, 0.502))),
            ("groove", v_groove(fine=fine)),
            ("groove, friction", v_groove(0.3, fine)),
            ("groove, off the middle", v_groove(0.0, fine, 0.07)),
        ):
            name = "%s, dt/%d" % (name, fine)
            folder, x = run("inner", scene)
            kept(name, folder)
            at_most(
                overlaps(x[::fine], *(b.rings for b in scene.bodies))[1].max(),
                1.5e-3,
                name + ": overlap / shorter edge",
            )
            check((table(folder, "rcforc", side=1)["fn"] > 0.0).any(), name + ": it touches")


# 3. Symmetry.


def apex(order=(1, 2), side=None, flat=0.0, mu=0.0):
    """A block falls with the middle node of its face on the apex of a roof: flat > 0, one that
    ends in a short edge."""
    scene = Scene(dt=5.0e-5, steps=300)
    scene.body(4, 2, box(-0.6, 0.0011, 1.2, 0.5), (0.0, -2.0))
    if flat:
        scene.body(2, 2, lambda a, b: ((2.0 * a - 1.0) * (flat + 0.6 * (1.0 - b)), b - 1.0))
    else:
        scene.body(1, 1, None, ring=[(-0.8, -0.7), (0.8, -0.7), (0.0, 0.0)])
    scene.hold(scene.bodies[1].row(0)[: None if flat else 2])
    scene.contact(*order, mu, pair=side)
    return scene


def symmetry():
    """A scene that is its own mirror image gives no force and no momentum across its axis, to
    round-off (1e-9: what the solver's certificate of 1e-10 may leave), whichever side is exact
    and whichever body comes first. A mirrored scene gives the mirrored displacements."""
    for order in ((1, 2), (2, 1)):
        for side in (None, "A", "B"):
            for flat, mu in ((0.0, 0.0), (0.0, 0.4), (0.09, 0.0), (0.09, 0.4)):
                name = "apex %s SIDE %s flat %g mu %g" % (order, side, flat, mu)
                scene = apex(order, side, flat, mu)
                folder, x = run("apex", scene)
                force = table(folder, "rcforc", side=1)
                across = np.abs(force["fx"]).max() / np.abs(force["fy"]).max()
                at_most(across, 1.0e-9, name + ": force across")
                rows = table(folder, "matsum", part=1)
                across = np.abs(rows["momx"]).max() / np.abs(rows["momy"]).max()
                at_most(across, 1.0e-9, name + ": momentum across")
    for name, make in (("slab", slab), ("pressed", pressed_slider), ("tumbling", tumbling)):
        mirrored(name, make)


def mirrored(name, make):
    """Displacements of a scene and of its mirror image: 1e-9 of the largest, as for any change of
    round-off (conventions.md 4)."""
    ends = []
    for mirror in (False, True):
        scene = make(mirror=mirror)
        folder, x = run("mirror", scene)
        ends.append(x - np.array(scene.place))
        check((table(folder, "rcforc", side=1)["fn"] > 0.0).any(), name + ": it touches")
    off = np.abs(ends[0] - ends[1] * [-1.0, 1.0]).max() / np.abs(ends[0]).max()
    at_most(off, 1.0e-9, name + ": mirrored displacements")


def tumbling(mirror=False):
    """A turned block falls on a block with its corner, aside of the middle, and tips over."""
    scene = Scene(dt=1.0e-4, steps=300, mirror=mirror)
    scene.body(3, 3, box(0.41, 0.0017, 0.6, 0.5, 0.5), (0.4, -2.0))
    base = scene.body(4, 2, box(0.0, -0.6, 1.0, 0.6))
    scene.hold(base.row(0))
    scene.contact(1, 2, 0.2)
    return scene


def pressed_slider(mirror=False, mu=0.05):
    """A block is pressed into a soft plate and slides over several of its edges, which are then
    deep below their reference places: a search measures the gap at the node's place."""
    scene = Scene(dt=1.0e-3, steps=500, theta=0.6, mirror=mirror)
    block = scene.body(3, 2, box(1.02, 0.0, 0.31, 0.2), (-1.6, 0.0), young=2.0e3, density=1.0)
    plate = scene.body(14, 2, box(0.0, -0.4, 1.5, 0.4), young=60.0)
    scene.hold(plate.row(0))
    scene.contact(1, 2, mu)
    scene.curve(1, [(0.0, 0.0), (0.05, 1.0), (9.0, 1.0)])
    scene.cards += ["*LOAD_NODE_SET", "%d,2,1,-0.5" % scene.node_set(block.row(2))]
    return scene


def deformed_edge():
    """The block of pressed_slider and its mirror image: equal; it stays on top of the plate,
    though that is 0.3 of an edge below its reference place: 1.5 allowances of 1e-3 (from there on
    a row is set anew) and what a node slips on an edge that turns in a step."""
    mirrored("pressed slider", pressed_slider)
    mirrored("pressed slider, no friction", lambda mirror: pressed_slider(mirror, 0.0))
    for mirror in (False, True):
        scene = pressed_slider(mirror)
        folder, x = run("pressed", scene)
        _, share = overlaps(x[::5], *(b.rings for b in scene.bodies))
        face = x[:, [n - 1 for n in scene.bodies[1].row(2)]]
        slope = np.diff(face, axis=1)
        turn = np.abs(np.diff(np.arctan2(slope[..., 1], slope[..., 0]), axis=0)) % pi
        turn = np.minimum(turn, pi - turn).max()
        slip = np.abs(np.diff(x[:, :4, 0], axis=0)).max() / (0.31 / 3)
        show("slip / edge %.3g, turn %.3g in a step" % (slip, turn))
        at_most(share.max(), 1.5e-3 + slip * turn, "pressed slider: overlap")
        kept("pressed slider", folder)
        check(counted(folder, "contact searches") > 1, "it was listed more than once")
        at_most(face[..., 1].min() / (1.5 / 14), -0.1, "the plate is pressed in / its edge")
        moved = x[-1, 0, 0] - x[0, 0, 0]
        within(abs(moved), 0.3, 2.0, "way of the block")


# 4. Flush and from the end.


def tables_scene(ledge=0.0, weight=0.0, one_set=False, steps=400, start=-0.8, second=True):
    """A block slides from one table to another."""
    scene = Scene(dt=2.0e-3, steps=steps)
    scene.body(3, 2, box(start, 0.0, 0.6, 0.4), (1.5, 0.0))
    one = scene.body(2, 1, box(-1.0, -0.5, 1.0, 0.5))
    held = one.nodes()
    if second:
        two = scene.body(2, 1, box(0.004, -0.5 + ledge, 1.0, 0.5))
        held = held + two.nodes()
    scene.hold(held)
    if one_set:
        scene.cards += ["*SET_PART_LIST", "50,", "2,3,"]
        scene.contact(1, 50)
    else:
        scene.contact(1, 2)
        if second:
            scene.contact(1, 3)
    if weight:
        scene.gravity(weight)
    return scene


def flush_tables():
    """Without weight a block slides from table to table as if it were free: 1.5 to 1e-9 (a node
    that met the side of the next table would throw it back). A floor of two plates in one part
    set is the floor of two cards. Off the end of a table: the corner is an allowance of 2e-4 of
    its edge of 0.2 - 0.25 deep at most, 5e-5, doubled for the turn of the edge in a step."""
    for one_set in (False, True):
        folder, x = run("flush", tables_scene(one_set=one_set))
        rows = table(folder, "matsum", part=1)
        at_most(np.abs(rows["vx"] - 1.5).max(), 1.0e-9, "flush tables: change of velocity")
        kept("flush tables", folder)
    ends = []
    for one_set in (False, True):
        scene = Scene(dt=1.0e-3, steps=700)
        scene.body(2, 2, box(-0.33, 0.2, 0.5, 0.4), (1.1, -0.6))
        for place in (box(-1.0, -0.5, 1.0, 0.5), box(0.0, -0.5, 1.9, 0.5)):
            scene.hold(scene.body(2, 1, place).row(0))
        scene.cards += ["*SET_PART_LIST", "50,", "2,3,"]
        scene.contact(1, 50, 0.2) if one_set else [scene.contact(1, k, 0.2) for k in (2, 3)]
        folder, x = run("plates", scene)
        ends.append(x)
        rows = table(folder, "matsum", part=1)
        check(rows["vy"][-1] > 0.0, "two plates: it comes back")
        for part in (1, 2):
            _, share = overlaps(x, scene.bodies[0].rings, scene.bodies[part].rings)
            at_most(share.max(), 1.5e-3, "two plates: overlap")
        kept("two plates", folder)
    off = np.abs(ends[0] - ends[1]).max() / np.abs(ends[0] - ends[0][0]).max()
    at_most(off, 1.0e-9, "two plates: one set against two cards")
    scene = tables_scene(weight=3.0, steps=400, start=-0.45, second=False)
    folder, x = run("off", scene)
    depth, _ = overlaps(x, scene.bodies[0].rings, scene.bodies[1].rings)
    at_most(depth.max(), 1.0e-4, "off the table: depth")
    kept("off the table", folder)
    check(table(folder, "matsum", part=1)["vy"][-1] < -0.2, "off the table: it falls")


# 5. Open obstacles: they have a front and no inside.


def open_floor(kind="segments", start=(0.31, 0.0122), velocity=(0.6, -1.0), steps=300):
    """A block above the top face of a held base that is a set of segments or of nodes."""
    scene = Scene(dt=5.0e-4, steps=steps)
    block = scene.body(2, 2, box(*start, 0.4, 0.3), velocity)
    base = scene.body(3, 1, box(0.0, -0.4, 1.5, 0.4))
    scene.hold(base.row(0))
    if kind == "segments":
        scene.contact(1, scene.segment_set(base.row(1)), pair=",PARTSET,SEGSET")
    else:
        scene.contact(1, -scene.node_set(base.row(1)), kind="NODE_TO_SURFACE")
    return scene


def from_behind(kind, speed):
    """The block starts under the base, whose other faces are no contact, and flies up through it:
    it meets the open face from behind, and leaves it to the front."""
    return open_floor(kind, (0.33, -0.75), (0.3, speed), int(1.2 / speed / 5.0e-4))


def open_obstacle():
    """From the front an open face is a floor. From behind it is nothing: no force, or an error
    that says the node came through; energy is never made. At the start a body just behind it is
    an error, as inside a closed one."""
    for kind in ("segments", "nodes"):
        scene = open_floor(kind)
        folder, x = run("open", scene)
        at_most(abs(first_force(folder) - 25), 1, kind + ": step of the touch")
        _, share = overlaps(x, *(b.rings for b in scene.bodies))
        at_most(share.max(), 1.5e-3, kind + ": overlap")
        check(table(folder, "matsum", part=1)["vy"][-1] > 0.0, kind + ": it comes back")
        kept(kind, folder)
        for speed in (1.0, 4.0, 60.0):
            scene = from_behind(kind, speed)
            folder, code, errors = run_text("behind", scene.text())
            name = "%s, from behind at %g" % (kind, speed)
            show("%s: exit %d %s" % (name, code, errors.strip()))
            check(code == 0 or code == 1 and "node" in errors, name + ": " + errors)
            rows = table(folder, "rcforc", side=1)
            at_most(np.abs(rows["fy"]).max(), 0.0, name + ": force")
            at_most(growth_of_largest(folder), 1.0e-9, name + ": growth")
            if code == 0:
                x = scene.positions(table(folder, "nodout"))
                check(x[-1, :9, 1].min() > 0.0, name + ": it went through")
        refused(kind, open_floor(kind, (0.31, -0.02)), 2, r"node \d+ is 0\.02 deep", "at the start")


def growth_of_largest(folder):
    """Largest total - initial - external - motion over the largest term."""
    rows = table(folder, "glstat")
    over = rows["total"] - rows["initial"] - rows["external"] - rows["motion"]
    return over.max() / max(np.abs(rows[c]).max() for c in ("total", "external"))


# 7. Two cards at one node; fast bodies.


def two_floors(mu=0.0):
    """A block flies into the corner of a floor and a wall that are two bodies with two cards."""
    scene = Scene(dt=1.0e-3, steps=400)
    scene.body(3, 2, box(0.021, 0.013, 0.5, 0.4), (-1.5, -1.2))
    floor = scene.body(4, 1, box(-0.4, -0.3, 1.6, 0.3))
    wall = scene.body(1, 4, box(-0.4, 0.0, 0.4, 1.0))
    scene.hold(floor.row(0) + wall.column(0))
    scene.contact(1, 2, mu)
    scene.contact(1, 3, mu)
    return scene


def on_a_wall():
    """A block rests with its nodes on the list of a rigid wall; another flies into its side with
    0.9 of an edge a step."""
    scene = Scene(dt=1.0e-3, steps=60)
    still = scene.body(3, 2, box(0.0, 0.0, 0.3, 0.2), young=4.0e3)
    scene.body(3, 2, box(-1.1, 0.021, 0.3, 0.19), (90.0, -0.4), young=4.0e3)
    scene.wall(still.nodes(), (0.0, 0.0), (0.0, 1.0))
    scene.contact(2, 1)
    return scene


def two_cards():
    """A node that meets two bodies, or a rigid wall and a body: it passes neither."""
    for mu in (0.0, 0.3):
        scene = two_floors(mu)
        folder, x = run("two", scene)
        for part in (1, 2):
            _, share = overlaps(x, scene.bodies[0].rings, scene.bodies[part].rings)
            at_most(share.max(), 1.5e-3, "floor and wall, mu %g: overlap" % mu)
            rows = table(folder, "rcforc", contact=part, side=1)
            check((rows["fn"] > 0.0).any(), "both are touched")
        kept("floor and wall", folder)
    scene = on_a_wall()
    folder, x = run("listed", scene)
    _, share = overlaps(x, *(b.rings for b in scene.bodies))
    # Steps of 0.9 edge in which edges turn by a few hundredths: slip times turn.
    at_most(share.max(), 1.0e-2, "hit on a wall: overlap")
    check((table(folder, "rcforc", side=1)["fn"] > 0.0).any(), "hit on a wall: it touches")
    check((x[:, :12, 0].mean(axis=1) > x[:, 12:, 0].mean(axis=1)).all(), "it stays behind")
    at_most(-x[:, :12, 1].min() / 0.1, 1.0e-9, "hit on a wall: below it (PENTOL)")
    kept("hit on a wall", folder)


def bullet_scene(speed, start, steps=10):
    """A bullet of edges 0.1 flies at a free plate of 0.05, thinner than the way of a step."""
    scene = Scene(dt=1.0e-3, steps=steps)
    scene.body(3, 2, box(start - 0.3, 0.0, 0.3, 0.2), (speed, 0.0))
    scene.body(1, 5, box(0.0, -0.2, 0.05, 0.6), density=5.0e-3)
    scene.contact(1, 2)
    return scene


def bullet():
    """One, two and four edges a step on a plate of half an edge: stopped, or exit 1 that names
    node and step, never through; wherever in its step it arrives, also in the last step of the
    run. Overlap beyond 1e-2 of an edge (steps of several edges) is told as a warning."""
    worst = stopped = ended = 0
    for speed in (120.0, 200.0, 410.0):
        for at in (0.03, 0.3, 0.55, 0.9, 0.999):
            for steps in (4, 10):
                name = "bullet %g, touch at %g, %d steps" % (speed, at, steps)
                scene = bullet_scene(speed, -speed * 1.0e-3 * (3 + at), steps)
                folder, code, errors = run_text("bullet", scene.text())
                if code != 0:
                    check(code == 1 and re.search(r"step \d+.*node \d+", errors), name + errors)
                    show(name + ": " + errors.strip())
                    ended += 1
                    continue
                stopped += 1
                x = scene.positions(table(folder, "nodout"))
                check(x[-1, :12, 0].mean() < x[-1, 12:, 0].mean(), name + ": it went through")
                _, share = overlaps(x, *(b.rings for b in scene.bodies))
                warned = "WARNING overlap" in log_of(folder)
                check(share.max() <= 1.0e-2 or warned, name + ": overlap %g" % share.max())
                worst = max(worst, share.max())
                at_most(growth(folder), 1.0 + 1.0e-9, name + ": energy")
    show("bullets: %d stopped, %d ended with exit 1, worst overlap %.3g" % (stopped, ended, worst))
    check(stopped > 0, "some bullet is stopped")


# 8. Single surface.


def three_bodies(mu=0.2, one_card=True, extra=False):
    """Three bodies of unequal meshes that meet each other. extra: a card of its own for two."""
    scene = Scene(dt=1.0e-4, steps=260)
    scene.body(4, 2, box(0.0, 0.0, 1.0, 0.6), (0.0, 1.0))
    scene.body(3, 3, box(0.25, 0.6047, 0.75, 0.8), (0.4, -2.0))
    scene.body(2, 3, box(1.0061, 0.11, 0.5, 1.1), (-2.0, 0.0), young=700.0)
    if one_card:
        scene.contact(0, "", mu, "SINGLE_SURFACE")
        if extra:
            scene.contact(1, 2, 0.0)
    else:
        for pair in ((1, 2), (1, 3), (2, 3)):
            scene.contact(*pair, mu)
    return scene


def closing_u(card=("SINGLE_SURFACE", 1, ""), mu=0.2):
    """The legs of a U are driven onto each other."""
    scene = Scene(dt=1.0e-4, steps=350)
    u = scene.body(
        9, 6, box(0.0, 0.0, 1.62, 1.5), young=150.0, keep=lambda i, j: j < 1 or i != 4
    )
    for p, n in u.at.items():
        if p[1] > 2:
            scene.kick([n], (11.0 if p[0] <= 4 else -14.0) * (p[1] - 2) / 1.2, 0.0)
    scene.hold(u.row(0))
    scene.contact(*card[1:], mu, card[0])
    return scene


def single_surface():
    """One card of all bodies is the three cards of their pairs; a pair that another card names
    is that card's, with a note. A body meets itself: its legs do not pass. A part on both sides
    of a card is the single surface of it. Displacements: 1e-9, round-off in another order."""
    ends = []
    for one_card in (True, False):
        scene = three_bodies(one_card=one_card)
        folder, x = run("three", scene)
        ends.append(x)
        for a, b in ((0, 1), (0, 2), (1, 2)):
            _, share = overlaps(x[::2], scene.bodies[a].rings, scene.bodies[b].rings)
            at_most(share.max(), 1.5e-3, "bodies %d and %d: overlap" % (a + 1, b + 1))
        kept("three bodies", folder)
    for contact in (1, 2, 3):
        touched = (table(folder, "rcforc", contact=contact, side=1)["fn"] > 0.0).any()
        check(touched, "pair %d touches" % contact)
    size = np.abs(ends[0] - ends[0][0]).max()
    at_most(np.abs(ends[0] - ends[1]).max() / size, 1.0e-9, "one card against three")
    scene = three_bodies()
    at = scene.cards.index("*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE")
    scene.cards[at : at + 2] = ["*SET_PART_LIST", "70,", "1,2,3,"]
    scene.contact(70, 70, 0.2)
    x = run("set", scene)[1]
    at_most(np.abs(ends[0] - x).max() / size, 1.0e-9, "a set of all on both sides")
    folder, x = run("yields", three_bodies(extra=True))
    check(re.search("NOTE .*contact 1 of all parts leaves to contact 2", log_of(folder)), "note")
    rows = table(folder, "rcforc", contact=2, side=1)
    check((rows["fn"] > 0.0).any() and (rows["ft"] == 0.0).all(), "the named pair: no friction")
    rows = table(folder, "rcforc", contact=1, side=1)
    check((rows["ft"] > 0.0).any(), "the other pairs: with friction")
    ends = []
    for card in (
        ("SINGLE_SURFACE", 1, ""),
        ("SINGLE_SURFACE", 0, ""),
        ("SURFACE_TO_SURFACE", 1, 1),
    ):
        scene = closing_u(card)
        folder, x = run("u", scene)
        ends.append(x)
        middle = [(r, x[0, np.array(r) - 1].mean(axis=0)) for r in scene.bodies[0].rings]
        left = [r for r, m in middle if m[0] < 0.72 and m[1] > 0.25]
        right = [r for r, m in middle if m[0] > 0.9 and m[1] > 0.25]
        _, share = overlaps(x, left, right)
        at_most(share.max(), 1.5e-3, "legs of a U: overlap")
        kept("legs of a U", folder)
        check((table(folder, "rcforc")["fn"] > 0.0).any(), "the legs touch")
    size = np.abs(ends[0] - ends[0][0]).max()
    for k in (1, 2):
        at_most(np.abs(ends[0] - ends[k]).max() / size, 1.0e-9, "U: one card and another")


# 9. Pressures on nodes.


def pressed_squares(
    upper=3, lower=3, margin=0.0, order=(1, 2), held=False, pressure=8.0, thickness=1.0
):
    """A block under a uniform pressure on another; no Poisson ratio, so the pressure is the same
    everywhere. margin: how much the lower body is wider."""
    scene = Scene(
        dt=0.01, steps=300, theta=1.0, every=0.1, before=order[0] // 10 * 10, thickness=thickness
    )
    block = scene.body(upper, 2, box(0.0, 0.0, 0.9, 0.8), poisson=0.0, density=1.0)
    base = scene.body(
        lower, 2, box(-margin, -0.8, 0.9 + 2 * margin, 0.8), poisson=0.0, density=1.0
    )
    scene.hold(base.nodes() if held else base.row(0))
    scene.hold([block.at[0, j] for j in range(3)], 1, 0)
    scene.curve(1, [(0.0, 0.0), (0.5, pressure), (9.0, pressure)])
    top = block.row(2)
    scene.cards += ["*LOAD_SEGMENT"] + ["1,1.0,0.0,%d,%d" % p for p in zip(top[1:], top)]
    scene.contact(*order)
    scene.tables += ["NCFORC"]
    return scene


def glued(fields=True, mu=0.3):
    """Contact of one of two parts that share nodes: the ends of its boundary have one edge only.
    Forces on nodes are asked for, in a table and in fields."""
    scene = Scene(dt=2.0e-4, steps=150)
    scene.body(3, 2, box(0.1, 0.0023, 0.9, 0.5), (0.5, -1.0))
    left = scene.body(2, 2, box(-0.2, -0.6, 0.8, 0.6))
    right = scene.body(3, 2, box(0.6, -0.6, 0.9, 0.6), glue=left)
    scene.hold(left.row(0) + [n for n in right.row(0) if n not in left.row(0)])
    scene.contact(1, 2, mu)
    scene.tables += ["NCFORC"]
    if fields:
        scene.cards += ["*BIPACT_FIELD", "0.001,", "FORCE,PRESSURE,GAP,STATUS"]
    return scene


def contact_pressure():
    """Nodes of the block carry the pressure that presses it, corners too: 0.1 % is what is left
    of the waves of the load, damped by theta = 1. Contact of one of two glued parts: the sum of
    the forces on nodes is that of the contact, and only nodes of that part have any."""
    for name, scene in (
        ("equal squares", pressed_squares()),
        ("equal squares, other order", pressed_squares(order=(2, 1))),
        ("thin squares", pressed_squares(order=(11, 12), thickness=0.25)),
        ("wider plate, held", pressed_squares(3, 4, 0.37, held=True)),
        ("wider plate, held, other order", pressed_squares(3, 4, 0.37, (2, 1), held=True)),
        ("plate whose nodes match, held", pressed_squares(3, 5, 0.3, held=True)),
    ):
        folder, x = run("pressed", scene)
        face = scene.bodies[0].row(0)
        rows = table(folder, "ncforc")
        end = rows.rows((rows["time"] > 2.95) & np.isin(rows["node"], face))
        check(len(end) == len(face), name + ": every node of the face has a row")
        off = np.abs(end["pressure"] / 8.0 - 1.0).max()
        at_most(off, 1.0e-3, name + ": pressure of the block's nodes")
    scene = glued()
    folder, x = run("glued", scene)
    rows, total = table(folder, "ncforc"), table(folder, "rcforc", side=1)
    check((total["fn"] > 0.0).any(), "glued: it touches")
    own = scene.bodies[0].nodes()
    mine = rows.rows(np.isin(rows["node"], own))
    summed = [mine["fy"][mine["time"] == t].sum() for t in total["time"]]
    off = np.abs(summed - total["fy"]).max() / np.abs(total["fy"]).max()
    at_most(off, 1.0e-12, "glued: sum of the forces on nodes")
    others = set(rows["node"][rows["fy"] != 0.0].astype(int)) - set(own)
    check(others <= set(scene.bodies[1].nodes()), "glued: forces on %s" % sorted(others))


# 10. Zero gap; an edge that turns.

ANGLE = 0.43


def inclined(deep=0.0, mu=0.2):
    """A block at rest on an inclined wall; the deck holds seven decimals of everything."""
    c, s = cos(ANGLE), sin(ANGLE)
    scene = Scene(dt=5.0e-3, steps=100, theta=1.0)
    block = scene.body(5, 1, box(0.0, 0.0, 2.5, 0.6, ANGLE), density=1.0)
    scene.place = [(float("%.7f" % x), float("%.7f" % y)) for x, y in scene.place]
    point = (-s * deep, c * deep)
    scene.cards += ["*RIGIDWALL_PLANAR", "%10d" % scene.node_set(block.row(0))]
    values = (*point, 0.0, point[0] - s, point[1] + c, 0.0, mu)
    scene.cards += ["".join("%10.7f" % v for v in values)]
    scene.gravity(10.0)
    scene.tables += ["RWFORC"]
    return scene


def block_on_slope(deep=0.0):
    """The same of two bodies, at rest without loads."""
    c, s = cos(ANGLE), sin(ANGLE)
    scene = Scene(dt=1.0e-3, steps=20)
    scene.body(4, 1, box(s * deep, -c * deep, 1.6, 0.4, ANGLE))
    scene.body(3, 1, box(0.4 * s - 0.3 * c, -0.4 * c - 0.3 * s, 2.4, 0.4, ANGLE))
    scene.place = [(float("%.7f" % x), float("%.7f" % y)) for x, y in scene.place]
    scene.contact(1, 2, 0.3)
    return scene


def zero_gap():
    """A block set on an inclined wall with the seven digits of ten columns: a note, and it
    slides as g (sin a - mu cos a) says, to 0.1 % (digits and bouncing). Nearly a thousandth of
    its edge deep is no rounding: an error whose hint names PENTOL, with which it runs; the same
    of two bodies. What was never lost is not given: no energy comes of the overlap."""
    folder, x = run("inclined", inclined())
    rows = table(folder, "matsum")
    along = rows["vx"][-1] * cos(ANGLE) + rows["vy"][-1] * sin(ANGLE)
    exact = -10.0 * (sin(ANGLE) - 0.2 * cos(ANGLE)) * 0.5
    at_most(abs(along / exact - 1.0), 1.0e-3, "velocity along the wall")
    check(re.search("NOTE wall 1: nodes up to .* deep at its start", log_of(folder)), "note")
    folder, x = run("bodies", block_on_slope())
    at_most(table(folder, "glstat")["total"].max(), 0.0, "two bodies at rest: energy")
    for name, make, deep in (("wall", inclined, 0.45e-3), ("bodies", block_on_slope, 0.36e-3)):
        refused(name, make(deep), 2, r"node \d+ .*0\.000", "at the start", "PENTOL")
        scene = make(deep)
        scene.cards += ["*BIPACT_CONTACT", ",", ",,1.0e-3"]
        folder, x = run("pentol", scene)
        rows = table(folder, "glstat")
        over = (rows["total"] - rows["external"]).max()
        at_most(over, 1.0e-12, name + ": taken as a touch: energy that nobody put in")


def turned_edge_scene(frame, slip=2.0e-3, turn=1.0e-3, steps=100):
    """The tip of a triangle slides along an edge that is turned by prescribed motion."""
    scene = Scene(dt=1.0e-3, steps=steps)
    scene.body(1, 1, None, ring=[(0.71, 0.0), (1.1, 0.5), (0.4, 0.5)], density=1.0)
    scene.body(1, 1, box(0.0, -1.0, 2.0, 1.0), density=1.0)
    base, tip = scene.bodies[1].at, scene.bodies[0].nodes()
    end = steps * scene.dt
    scene.hold([base[0, 0], base[1, 0], base[0, 1]])
    scene.hold([base[1, 1]], 1, 0)
    scene.curve(1, [(0.0, 0.0), (end, 2.0 * turn * steps)])
    scene.curve(2, [(0.0, 0.0), (end, slip * steps)])
    scene.cards += ["*BOUNDARY_PRESCRIBED_MOTION_NODE", "%d,2,2,1,1.0" % base[1, 1]]
    scene.cards += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "%d,1,2,2,1.0" % scene.node_set(tip)]
    scene.gravity(50.0)
    scene.contact(1, 2)
    if frame != "START":
        scene.cards += ["*BIPACT_CONTACT", ",", ",%s" % frame]
    return scene


def turned_edge():
    """A node slips s along an edge that turns by dphi in the step. With the normal of the start
    of the step the overlap grows by s dphi at most: second order in the step. With that of the
    reference it is s tan phi of the whole turn, in every step."""
    found = {}
    for frame, turn in (("START", 1.0e-3), ("START", 4.0e-3), ("REF", 1.0e-3)):
        scene = turned_edge_scene(frame, turn=turn)
        folder, x = run("turned", scene)
        depth, _ = overlaps(x, *(b.rings for b in scene.bodies))
        edge = x[:, scene.bodies[1].at[1, 1] - 1] - x[:, scene.bodies[1].at[0, 1] - 1]
        phi = np.arctan2(edge[:, 1], edge[:, 0])
        slip = np.abs(np.diff(x[:, 0, 0])) / np.cos(phi[1:])
        if frame == "START":
            grown = np.diff(depth) / (slip * np.abs(np.diff(phi)))
            at_most(grown.max(), 1.0 + 1.0e-6, "START: growth of overlap / (s dphi)")
            check(grown.max() > 0.5, "START: the tip is pressed on")
        else:
            found = depth[1:] / (slip * np.abs(np.tan(phi[1:])))
            check(found.max() >= 0.9, "REF: overlap / (s tan phi) is %g" % found.max())
            show("REF: overlap / (s tan phi): %.3f" % found.max())


# 11. The purse, and growth of energy.


def wavy(mu=0.0, speed=9.0, wave=0.018, young=120.0, cells=3, theta=0.5):
    """A block slides over a soft wavy base."""
    scene = Scene(dt=1.0e-4, steps=500, theta=theta)
    scene.body(cells, 2, box(0.21, wave + 0.0013, 0.5, 0.4), (speed, -0.8))
    base = scene.body(
        11, 2, lambda a, b: (2.2 * a, 0.5 * (b - 1.0) + wave * b * sin(7.0 * pi * a)), young=young
    )
    scene.hold(base.row(0))
    scene.contact(1, 2, mu)
    scene.gravity(1500.0)
    return scene


def pressed_flat(theta=1.0, mu=0.0):
    """A block pressed on a base of other edges, theta = 1: nothing is lost in normal direction
    for good, so its purse has little to close overlaps with."""
    scene = Scene(dt=2.0e-4, steps=200, theta=theta)
    block = scene.body(3, 2, box(0.0, 0.0, 1.0, 0.6))
    base = scene.body(5, 2, box(-0.3, -0.7, 1.7, 0.7), young=500.0)
    scene.hold(base.row(0))
    scene.contact(1, 2, mu)
    scene.curve(1, [(0.0, 0.0), (0.01, 1.0), (9.0, 1.0)])
    scene.cards += ["*LOAD_NODE_SET", "%d,2,1,-3.0" % scene.node_set(block.row(2))]
    return scene


def purse():
    """Closing an overlap is paid for by what the contact took before. Total energy never exceeds
    what was put in, in scenes whose purse is short too."""
    short = 0
    for name, scene in (
        ("wavy", wavy()),
        ("wavy, finer block", wavy(cells=7, wave=0.03)),
        ("wavy, friction", wavy(0.3)),
        ("pressed", pressed_flat()),
        ("pressed, theta 0.7", pressed_flat(0.7)),
        ("pressed slider", pressed_slider(mu=0.0)),
    ):
        scene.cards += STOP
        folder, x = run("purse", scene)
        rows = table(folder, "glstat")
        put_in = rows["initial"] + rows["external"]
        largest = np.abs(rows["total"]).max()
        at_most((rows["total"] - put_in).max() / largest, 1.0e-9, name + ": growth")
        # The cumulative loss of the only card is its purse: 1e-12 of the largest term a step is
        # round-off that closes freely, less than 1e-10 in these steps.
        at_most(-rows["contact"].min() / largest, 1.0e-10, name + ": purse below zero")
        at_most(np.abs(rows["residual"]).max(), 1.0e-11, name + ": ledger")
        count = counted(folder, "steps with a short purse")
        show("%-60s %d" % (name + ": steps with a short purse", count))
        short += count
    check(short > 0, "the purse was short in some step")


def stacked(upper, lower, rows=None, pair=None):
    """A block under a pressure of 1 on a block as wide that stands held: mean displacement of
    the top at rest (theta 1 with steps of some periods)."""
    scene = Scene(dt=0.02, steps=40, theta=1.0, every=0.8)
    base = scene.body(lower, rows or max(2, lower // 2), box(-0.5, -1.0, 1.0, 1.0))
    layers = rows or max(2, upper // 2)
    block = scene.body(upper, layers, box(-0.5, 0.0, 1.0, 0.5))
    scene.hold(base.row(0))
    scene.contact(2, 1, pair=pair)
    scene.curve(5, [(0.0, 1.0), (1.0e3, 1.0)])
    top = block.row(layers)
    scene.cards += ["*LOAD_SEGMENT_SET", "%d,5,1.0" % scene.segment_set(top[::-1])]
    folder, x = run("stacked", scene)
    places = [n - 1 for n in top]
    return (x[-1, places, 1] - np.array(scene.place)[places, 1]).mean()


def pressed_flats():
    """Flat faces whose nodes do not meet: the top of a pressed block sinks as far as with a fine
    mesh of meeting nodes, to 2.5 %. Forces at the nodes of both sides instead make the faces
    too stiff by 2.5 to 5.8 % on such meshes (prototype)."""
    fine = stacked(40, 40, 20)
    for edges in ((10, 2), (9, 2), (11, 3), (21, 4), (2, 10), (2, 9), (3, 11), (4, 21)):
        at_most(abs(stacked(*edges) / fine - 1.0), 0.025, "%d edges on %d: top" % edges)


TERMS = "kinetic internal total initial external friction contact algorithmic".split()


def growth_of_energy():
    """NEWMARK makes energy on impact: a warning with its figure and the step; ACTION STOP ends
    the run there with exit 1. The figure is the rise above the lowest energy so far, over the
    largest term so far: the same from the rows of glstat, one a step, to its seven digits."""
    scene = Scene(dt=1.0e-5, steps=2000)
    scene.scheme = "NEWMARK,"
    scene.body(10, 2, box(-2.003, 0.0, 2.0, 0.4), (1.0, 0.0), poisson=0.0)
    scene.body(10, 2, box(0.0, 0.0, 2.0, 0.4), (-1.0, 0.0), poisson=0.0)
    scene.contact(1, 2)
    folder, x = run("newmark", scene)
    found = re.search(
        r"WARNING energy-growth: the energy rose by (\S+) of the largest term; first seen at step "
        r"(\d+)",
        log_of(folder),
    )
    check(found, "the warning is there")
    rows = table(folder, "glstat")
    total = rows["total"]
    rise = total - np.minimum(total[0], np.minimum.accumulate(total))
    largest = np.maximum.accumulate(np.max([np.abs(rows[c]) for c in TERMS], axis=0))
    show("growth in the log: " + found.group(1))
    at_most(abs((rise / largest).max() / float(found.group(1)) - 1.0), 1.0e-6, "its figure")
    scene.cards += STOP
    folder, code, errors = run_text("stopped", scene.text())
    show(errors.strip())
    check(code == 1 and "energy growth of" in errors, "STOP: %d %s" % (code, errors))
    check("step %s," % found.group(2) in errors, "STOP in the same step: " + errors)
    check(table(folder, "glstat").status == "failed", "STOP: the table says so")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
