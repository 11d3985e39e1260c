"""Decks of the scenes of collide.py."""

import collide_scenes as scenes


def number(value):
    """A number that reads back equal."""
    return repr(float(value))


def cards(name, rows):
    """A keyword and its cards; nothing without cards."""
    return ["*" + name] + rows if rows else []


def in_eights(ids):
    ids = [str(i) for i in sorted(ids)]
    return [",".join(ids[k : k + 8]) + "," for k in range(0, len(ids), 8)]


def control(scene):
    return [
        "*KEYWORD",
        "*TITLE",
        "%s, %d bodies" % (scene["kind"], len(scene["bodies"])),
        "*CONTROL_TERMINATION",
        number(scene["end"]) + ",",
        "*CONTROL_IMPLICIT_GENERAL",
        "1," + number(scene["dt"]),
        "*CONTROL_IMPLICIT_DYNAMICS",
        "1,",
        "*BIPACT_TIME",
        scene["scheme"],
        "*BIPACT_LEDGER",
        "1,",
    ] + finite(scene)


def finite(scene):
    """Cards of a soft scene."""
    out = ["*CONTROL_IMPLICIT_SOLUTION", "12,"] if scene.get("soft") else []
    return out + (["*BIPACT_STEP", "HALVE,"] if scene.get("halve") else [])


def geometry(scene):
    """Nodes with their velocities in the order of their numbers, and elements."""
    nodes, velocities, elements = [], [], []
    for ids, b in zip(scene["ids"], scene["bodies"]):
        for i, place, v in zip(ids, b["xy"], b["velocity"]):
            nodes.append((i, "%d,%s,%s" % (i, number(place[0]), number(place[1]))))
            if v.any() and not b["rigid"]:
                velocities.append((i, "%d,%s,%s" % (i, number(v[0]), number(v[1]))))
    for count, (k, e) in enumerate(scene["order"], 1):
        ids = scene["ids"][k]
        corners = [ids[i] for i in scene["bodies"][k]["elements"][e]]
        elements.append(",".join(str(n) for n in [count, k + 1] + corners))
    out = cards("NODE", [text for _, text in sorted(nodes)])
    out += cards("ELEMENT_SHELL", elements)
    return out + cards("INITIAL_VELOCITY_NODE", [text for _, text in sorted(velocities)])


def parts(scene):
    out = []
    for k, b in enumerate(scene["bodies"], 1):
        material = [number(b[name]) for name in ("density", "young", "poisson")]
        out += ["*PART", "body %d" % k, "%d,%d,%d" % (k, k, k)]
        out += ["*SECTION_SHELL", "%d,13,,4" % k, "1.0,"]
        if b.get("law"):
            out += [b["law"][0], b["law"][1] % k] + b["law"][2:]
        elif b["rigid"]:
            held = "1.0,7,7" if b["held"] else "0.0,0,0"
            out += ["*MAT_RIGID", "%d,%s" % (k, material[0]), held, ","]
        else:
            out += ["*MAT_ELASTIC", "%d,%s" % (k, ",".join(material))]
        out += ["*SET_PART_LIST", "%d," % (10 + k), "%d," % k]
    return out + cards("INITIAL_VELOCITY_RIGID_BODY", rigid_velocities(scene))


def rigid_velocities(scene):
    out = []
    for k, b in enumerate(scene["bodies"], 1):
        if b["rigid"] and not (b["held"] or b["driven"]):
            v, omega = scenes.velocities_of(b)
            out += ["%d,%s,%s,,,,%s" % (k, number(v[0]), number(v[1]), number(omega))]
    return out


def loads(scene):
    """Gravity as the acceleration of the base, held nodes, driven nodes."""
    out, curve = [], 0
    for name, g in zip("XY", scene["gravity"]):
        if g:
            curve += 1
            out += constant(curve, -g, scene) + ["*LOAD_BODY_" + name, "%d,1.0" % curve]
    for k, (ids, b) in enumerate(zip(scene["ids"], scene["bodies"]), 1):
        if b["rigid"]:
            curve = move_rigid(out, k, b, curve, scene)
            continue
        if b["held"]:
            out += ["*SET_NODE_LIST", "%d," % (20 + k)] + in_eights(ids[b["held"]])
            out += ["*BOUNDARY_SPC_SET", "%d,,1,1" % (20 + k)]
        if b["driven"]:
            out += ["*SET_NODE_LIST", "%d," % (30 + k)] + in_eights(ids[b["driven"]])
            for dof in (1, 2):
                curve += 1
                out += constant(curve, b["drive"][dof - 1], scene)
                row = "%d,%d,0,%d" % (30 + k, dof, curve)
                out += ["*BOUNDARY_PRESCRIBED_MOTION_SET", row]
    return out


def move_rigid(out, k, b, curve, scene):
    """A driven rigid part moves at its speed and does not turn; returns the last curve."""
    if b["driven"]:
        for dof, value in ((1, b["drive"][0]), (2, b["drive"][1]), (7, 0.0)):
            curve += 1
            out += constant(curve, value, scene)
            out += ["*BOUNDARY_PRESCRIBED_MOTION_RIGID", "%d,%d,0,%d" % (k, dof, curve)]
    return curve


def constant(curve, value, scene):
    end = 2.0 * scene["end"]
    return ["*DEFINE_CURVE", "%d," % curve] + [
        "%s,%s" % (number(t), number(value)) for t in (0.0, end)
    ]


def contacts(scene):
    # FS, and FD and DC where friction falls
    out, mu = [], ",".join(map(number, (scene["mu"], *scene.get("falls", ()))))
    if scene["single"]:
        out += ["*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE"]
        out += ["%d,,,,%s" % (10 if scene["single"] == "set" else 0, mu)]
        if scene["single"] == "set":
            ids = range(1, len(scene["bodies"]) + 1)
            out += ["*SET_PART_LIST", "10,"] + in_eights(ids)
    else:
        for k, (a, b) in enumerate(scene["pairs"], 1):
            out += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE"]
            out += ["%d,%d,,,%s" % (11 + a, 11 + b, mu)]
            if frozenset((a, b)) in scene["mortars"]:
                out += ["*BIPACT_PAIR", "%d,,,,,MORTAR" % k]
    if scene["wall"]:
        point, normal, friction = scene["wall"]
        at = ",".join(map(number, point))
        ahead = ",".join(map(number, point + normal))
        row = "%s,,%s,,%s" % (at, ahead, number(friction))
        out += ["*RIGIDWALL_PLANAR", "0,", row]
    return out


def is_free(scene):
    """Nothing from outside acts on the bodies."""
    pushed = any(b["held"] or b["driven"] for b in scene["bodies"])
    return not (pushed or scene["wall"] or scene["gravity"].any())


def tables(scene, every):
    """All tables in every step; of a twin (every > 1) the nodes now and then, nothing else."""
    names = ["NODOUT"]
    if every == 1:
        names += ["GLSTAT", "MATSUM", "RCFORC", "SLEOUT"]
        names += ["RWFORC"] if scene["wall"] else []
        names += [] if is_free(scene) else ["SPCFORC"]
        names += ["RBDOUT"] if any(b["rigid"] for b in scene["bodies"]) else []
    row = number(every * scene["dt"]) + ","
    nodes = [i for ids in scene["ids"] for i in ids]
    out = [line for name in names for line in ("*DATABASE_" + name, row)]
    return out + cards("DATABASE_HISTORY_NODE", in_eights(nodes))


def deck(scene, every=1):
    """The text of a deck."""
    out = control(scene) + geometry(scene) + parts(scene) + loads(scene) + contacts(scene)
    return "\n".join(out + tables(scene, every) + ["*END", ""])
