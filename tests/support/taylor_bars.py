"""Taylor's copper bar of 3.2 x 32.4 mm at 227 m/s onto a rigid wall (mm, s, N, MPa): the nodes
of the impact face stay on the wall from the start, frictionless. Decks around the axis,
explicit and implicit, and of a quarter in space."""

import numpy as np
import rings
import solids

RADIUS, LENGTH, SPEED, END = 3.2, 32.4, 227.0e3, 80.0e-6
COPPER = ["*MAT_PLASTIC_KINEMATIC", "1,8.93e-9,117.0e3,0.35,400.0,99.9146,1.0"]
TABLES = ("GLSTAT", "NODOUT")
EXPLICIT = "PAOLI,,,,,,0.0"


def ring_bar(n, steps, implicit=False):
    """n x 5 n elements around the axis, steps halved where an implicit one fails: the deck."""
    mesh = rings.Mesh((n, 5 * n), (0.0, RADIUS), (0.0, LENGTH))
    lines = rings.mesh_cards(mesh) + rings.part_cards() + COPPER
    lines += rings.node_set(1, range(len(mesh.x))) + rings.flight(vy=-SPEED)
    lines += rings.node_set(2, mesh.bottom()) + ["*BOUNDARY_SPC_SET", "2,,,1"]
    followed = mesh.row(n, 0) + 1, mesh.row(0, 5 * n) + 1
    lines += ["*DATABASE_HISTORY_NODE", "%d,%d," % followed]
    if implicit:
        lines += ["*BIPACT_STEP", "HALVE,"]
    scheme = "THETA,0.5" if implicit else EXPLICIT
    return rings.deck(
        lines,
        END / steps,
        END,
        scheme=scheme,
        mass="LUMPED,0",
        tables=TABLES,
        every=1.0e-6,
        finite=True,
    )


def quarter(n, radius):
    """A quarter of a disc with n quadrilaterals over the radius: a core of about half of them
    each way, whose edge is straight, and layers from it to the rim. Returns x (*, 2) and
    elements."""
    core = (n + 1) // 2
    a, pull = radius * core / n, 0.2
    number, x, elements = {}, [], []

    def node(key, place):
        if key not in number:
            number[key] = len(x)
            x.append(place)
        return number[key]

    def inside(i, j):
        s, t = i / core, j / core
        return node((i, j), (a * s * (1.0 - pull * t), a * t * (1.0 - pull * s)))

    def outside(k, layer):
        """k from 0 on the x axis to 2 core on the y axis; layer 0 is the edge of the core."""
        i, j = min(core, 2 * core - k), min(core, k)
        if layer == 0:
            return inside(i, j)
        angle, share = 0.25 * np.pi * k / core, layer / (n - core)
        edge = np.array(x[inside(i, j)])
        rim = radius * np.array([np.cos(angle), np.sin(angle)])
        return node((k, layer, "ring"), tuple(edge + share * (rim - edge)))

    for i in range(core):
        for j in range(core):
            ring = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
            elements.append([inside(*p) for p in ring])
    for layer in range(n - core):
        for k in range(2 * core):
            ring = ((k, layer), (k, layer + 1), (k + 1, layer + 1), (k + 1, layer))
            elements.append([outside(*p) for p in ring])
    return np.array(x), elements


def space_bar(n, steps):
    """A quarter in space, n elements over the radius and 5 n along it, explicit: the deck."""
    flat, cells = quarter(n, RADIUS)
    heights = np.linspace(0.0, LENGTH, 5 * n + 1)
    x = np.array([(*p, z) for z in heights for p in flat])
    shift = len(flat)
    elements = [
        [shift * k + c for c in cell] + [shift * (k + 1) + c for c in cell]
        for k in range(5 * n)
        for cell in cells
    ]
    lines = solids.cards(x, elements) + ["*PART", "quarter", "1,1,1", "*SECTION_SOLID", "1,1"]
    lines += COPPER + ["*INITIAL_VELOCITY", "0,", "0.0,0.0,%r" % -SPEED]
    for axis in range(3):
        held = [k for k, p in enumerate(x) if abs(p[axis]) < 1e-9]
        lines += solids.node_set(1 + axis, held) + ["*BOUNDARY_SPC_SET"]
        lines += ["%d,,%d,%d,%d" % (1 + axis, *np.eye(3, dtype=int)[axis])]
    foot = int(np.argmax(x[:, 0] - 1e3 * (x[:, 1] + x[:, 2])))
    top = int(np.argmax(x[:, 2] - 1e3 * (x[:, 0] + x[:, 1])))
    lines += ["*DATABASE_HISTORY_NODE", "%d,%d," % (foot + 1, top + 1)]
    lines += ["*CONTROL_IMPLICIT_SOLUTION", "12,"]
    return solids.deck(lines, END / steps, END, EXPLICIT, "LUMPED,0", TABLES, 1.0e-6)
