"""The decks of styles.py: (name, what must come of it, text, other files)."""

from writers import Banners, ByHand, Commas, Components, Filled

# The keywords that public decks of the format use most.
FREQUENT = """END NODE KEYWORD PART DEFINE_CURVE CONTROL_TERMINATION
    DATABASE_BINARY_D3PLOT TITLE ELEMENT_SOLID ELEMENT_SHELL INCLUDE DATABASE_GLSTAT
    DATABASE_NODOUT CONTROL_TIMESTEP SECTION_SOLID SET_NODE_LIST DATABASE_EXTENT_BINARY
    SECTION_SHELL PARAMETER MAT_ELASTIC DATABASE_ELOUT DATABASE_MATSUM BOUNDARY_SPC_SET
    CONTROL_IMPLICIT_GENERAL PARAMETER_EXPRESSION DATABASE_HISTORY_NODE MAT_RIGID
    SET_PART_LIST SET_SEGMENT CONTROL_SOLUTION CONTROL_ENERGY DATABASE_SPCFORC
    BOUNDARY_SPC_NODE CONTROL_IMPLICIT_SOLUTION DATABASE_RCFORC CONTROL_OUTPUT
    MAT_PIECEWISE_LINEAR_PLASTICITY BOUNDARY_PRESCRIBED_MOTION_SET MAT_NULL HOURGLASS
    RIGIDWALL_PLANAR DATABASE_BINARY_D3THDT CONTROL_ACCURACY CONTROL_CONTACT
    CONTROL_HOURGLASS CONTROL_SHELL DATABASE_RBDOUT DATABASE_SECFORC DATABASE_ABSTAT
    CONTROL_STRUCTURED MAT_USER_DEFINED_MATERIAL_MODELS DATABASE_TPRINT
    DATABASE_HISTORY_BEAM BOUNDARY_PRESCRIBED_MOTION_NODE CONTROL_IMPLICIT_SOLVER
    CONTACT_AUTOMATIC_SURFACE_TO_SURFACE INITIAL_VELOCITY_NODE
    BOUNDARY_PRESCRIBED_MOTION_RIGID CONTACT_AUTOMATIC_SINGLE_SURFACE
    DATABASE_HISTORY_NODE_SET""".split()

NODES = [
    [first + 3 * j + i, x + 0.5 * i, 1.0 * j]
    for first, x in ((1, 0.0), (11, 1.005))
    for j in (0, 1)
    for i in (0, 1, 2)
]
SHELLS = [
    [e, part, a, a + 1, a + 4, a + 3]
    for e, part, a in ((1, 1, 1), (2, 1, 2), (3, 2, 11), (4, 2, 12))
]
TABLES = "GLSTAT MATSUM NODOUT ELOUT RCFORC SLEOUT SPCFORC".split()
# The blocks of the scene of tests/support/plain.py.
SCENE = {
    "title": ("TITLE", ["a block meets another"]),
    "end": ("CONTROL_TERMINATION", [[0.01]]),
    "general": ("CONTROL_IMPLICIT_GENERAL", [[1, 0.0001]]),
    "dynamics": ("CONTROL_IMPLICIT_DYNAMICS", [[1]]),
    "tables": None,
    "section": (
        "SECTION_SHELL",
        [{"secid": 1, "elform": 13, "nip": 4}, {"t1": 0.5}],
        "plane strain",
    ),
    "left material": ("MAT_ELASTIC", [[1, 0.001, 1000.0, 0.3]], "soft"),
    "right material": ("MAT_ELASTIC", [[2, 0.002, 2000.0, 0.25]], "stiff"),
    "parts": ("PART", ["left", [1, 1, 1], "right", [2, 1, 2]]),
    "curve": ("DEFINE_CURVE", [[1], [0.0, 1.0], [1.0, 3.0]], "base acceleration"),
    "load": ("LOAD_BODY_Y", [[1, 5.0]]),
    "held": ("SET_NODE_LIST", [{"sid": 1}, [13, 16]], "far side"),
    "support": ("BOUNDARY_SPC_SET", [{"nsid": 1, "dofx": 1, "dofy": 1}], "wall"),
    "left set": ("SET_PART_LIST", [{"sid": 11}, [1]], "left"),
    "right set": ("SET_PART_LIST", [{"sid": 12}, [2]], "right"),
    "contact": (
        "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE",
        [{"surfa": 11, "surfb": 12, "fs": 0.3}, {}],
    ),
    "velocity": (
        "INITIAL_VELOCITY_GENERATION",
        [{"id": 1, "styp": 2, "vx": 1.0, "vy": -0.25}, {}],
    ),
    "more": None,
    "nodes": ("NODE", NODES),
    "elements": ("ELEMENT_SHELL", SHELLS),
}
REQUESTS = [("DATABASE_" + name, [[0.001]]) for name in TABLES] + [
    ("DATABASE_HISTORY_NODE", [[1, 3, 6, 11, 13, 14, 16]]),
    ("DATABASE_HISTORY_SHELL", [[1, 2, 3, 4]]),
]
# What the plain scene asks for besides.
NCFORC = ("DATABASE_NCFORC", [[0.001]])
TIME = ("BIPACT_TIME", [{"scheme": "THETA", "theta": 0.5}])


def blocks(**changes):
    """Blocks of the scene, some replaced (a block, a list of blocks, or None: left out)."""
    scene = dict(SCENE, tables=REQUESTS + [NCFORC])
    for name, block in changes.items():
        if name.replace("_", " ") not in scene:
            raise KeyError(name)
        scene[name.replace("_", " ")] = block
    found = []
    for block in scene.values():
        found += block if isinstance(block, list) else [block] if block else []
    return found


def without(name, *more):
    """A block of the scene, and others beside it."""
    return [SCENE[name]] + list(more)


DECKS = []


def add(name, kind, writer, files=None, edit=None, frame="*KEYWORD", **changes):
    """One deck; edit: (old, new) pairs of its text."""
    text = writer.deck(blocks(**changes), frame)
    for old, new in edit or ():
        if old not in text:
            raise ValueError("%s: no %r" % (name, old))
        text = text.replace(old, new, 1)
    DECKS.append((name, kind, text, files or {}))


filled, banners, components, commas, by_hand = (
    Filled(),
    Banners(),
    Components(),
    Commas(),
    ByHand(),
)
WRITERS = {
    "filled": filled,
    "banners": banners,
    "components": components,
    "commas": commas,
    "by hand": by_hand,
}

# 1. The scene itself in each handwriting.
for name, writer in WRITERS.items():
    add(name + ": the scene", "same", writer)
    add(name + ": with *BIPACT_TIME", "same", writer, more=TIME)

# 2. What programs add that fill every field.
SOLID = [
    ("ELEMENT_SOLID", [[1, 1, 1, 2, 3, 4, 5, 6, 7, 8]]),
    ("SECTION_SOLID", [[9, 1]], "bricks"),
]
OTHER_TABLES = [
    ("DATABASE_" + n, [[0.001]]) for n in "RBDOUT SECFORC ABSTAT TPRINT BINARY_D3THDT".split()
] + [
    ("DATABASE_HISTORY_BEAM", [[1, 2]]),
    ("DATABASE_EXTENT_BINARY", [{}, {}]),
]
OTHER_CONTROLS = (
    [
        (n, [{}] if n != "CONTROL_STRUCTURED" else [])
        for n in """CONTROL_ACCURACY CONTROL_BULK_VISCOSITY CONTROL_ENERGY
            CONTROL_HOURGLASS CONTROL_PARALLEL CONTROL_CPU CONTROL_SOLUTION
            CONTROL_STRUCTURED CONTROL_TIMESTEP CONTROL_IMPLICIT_AUTO""".split()
    ]
    + [(n, [{}, {}]) for n in ("CONTROL_OUTPUT", "CONTROL_SHELL", "CONTROL_IMPLICIT_SOLVER")]
    + [("CONTROL_CONTACT", [{}] * 4)]
)
HGID = (
    "PART",
    [
        "left",
        {"pid": 1, "secid": 1, "mid": 1, "hgid": 3},
        "right",
        {"pid": 2, "secid": 1, "mid": 2, "hgid": 3},
    ],
)
DYNAMICS = ("CONTROL_IMPLICIT_DYNAMICS", [{"imass": 1, "gamma": 0.5, "beta": 0.25}])
add("filled: linear solution", "same", filled, more=("CONTROL_IMPLICIT_SOLUTION", [{}] * 4))
add("filled: other files of results", "same", filled, more=OTHER_TABLES)
add("filled: other controls", "same", filled, more=OTHER_CONTROLS)
add("filled: hourglass", "same", filled, parts=HGID, more=("HOURGLASS", [{"hgid": 3}], "stiff"))
add(
    "filled: NIP as for shells",
    "same",
    filled,
    section=("SECTION_SHELL", [{"secid": 1, "elform": 13}, {"t1": 0.5}]),
)
add("filled: a d3plot", "runs", filled, more=("DATABASE_BINARY_D3PLOT", [{"dt": 0.005}, {}]))
add("filled: gamma and beta", "runs", filled, dynamics=DYNAMICS)
add(
    "filled: a wall",
    "runs",
    filled,
    more=[
        ("SET_NODE_LIST", [{"sid": 5}, [1, 4]]),
        ("RIGIDWALL_PLANAR", [{"nsid": 5}, {"xt": -1.0, "xh": 1.0}], "left"),
    ],
)
add(
    "filled: motions",
    "runs",
    filled,
    more=[
        ("BOUNDARY_PRESCRIBED_MOTION_NODE", [[15, 2, 2, 1, 0.0001]], "edge"),
        ("SET_NODE_LIST", [{"sid": 5}, [12]]),
        ("BOUNDARY_PRESCRIBED_MOTION_SET", [[5, 2, 2, 1, 0.0001]], "edge"),
    ],
)
add(
    "filled: loads of segments",
    "runs",
    filled,
    more=[
        ("SET_SEGMENT", [{"sid": 5}, [4, 5, 5, 5], [5, 6, 0, 0]]),
        ("LOAD_SEGMENT_SET", [[5, 1, 0.5]]),
    ],
)
add(
    "filled: velocities of nodes",
    "same",
    filled,
    velocity=("INITIAL_VELOCITY_NODE", [[n, 1.0, -0.25] for n in range(1, 7)]),
)
add(
    "filled: supports of nodes",
    "same",
    filled,
    support=(
        "BOUNDARY_SPC_NODE",
        [{"nid": n, "dofx": 1, "dofy": 1, "dofz": 1} for n in (13, 16)],
    ),
)
add(
    "filled: constraints of nodes",
    "same",
    filled,
    support=None,
    nodes=("NODE", [n + [0.0] + [7 if n[0] in (13, 16) else 0] * 2 for n in NODES]),
)
add(
    "filled: an explicit deck",
    "fault",
    filled,
    general=None,
    dynamics=None,
    more=("CONTROL_TIMESTEP", [{}, {}]),
)
add(
    "filled: mass scaling",
    "refused",
    filled,
    more=("CONTROL_TIMESTEP", [{"dt2ms": "-1.0E-06"}, {}]),
)
add(
    "filled: three dimensions",
    "fault",
    filled,
    more=SOLID + [("CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", [{"surfa": 1, "surfb": 2}, {}, {}])],
)
add(
    "filled: rigid bodies",
    "runs",
    filled,
    left_material=("MAT_RIGID", [[1, 0.001, 1000.0, 0.3], {}, {}], "tool"),
    more=("BOUNDARY_PRESCRIBED_MOTION_RIGID", [[1, 1, 0, 1]]),
)
add(
    "filled: plasticity",
    "refused",
    filled,
    left_material=[
        SCENE["left material"],
        ("MAT_PIECEWISE_LINEAR_PLASTICITY", [[7, 1.0, 1.0, 0.3], {}, {}, {}], "steel"),
        ("MAT_NULL", [[8, 1.0]], "skin"),
    ],
)
add(
    "filled: user material",
    "refused",
    filled,
    more=("MAT_USER_DEFINED_MATERIAL_MODELS", [[7, 1.0], {}, {}], "mine"),
)
add(
    "filled: real shells",
    "refused",
    filled,
    section=("SECTION_SHELL", [{"secid": 1}, {"t1": 0.5}]),
    contact=("CONTACT_AUTOMATIC_SINGLE_SURFACE", [{}, {}, {}]),
)
add(
    "filled: nonlinear solution",
    "runs",
    filled,
    more=("CONTROL_IMPLICIT_SOLUTION", [{"nsolvr": 12}, {}, {}, {}]),
)
add("filled: automatic steps", "runs", filled, more=("CONTROL_IMPLICIT_AUTO", [{"iauto": 1, "dtmax": 0.0}]))
add("filled: damping", "runs", filled, more=("DAMPING_GLOBAL", [{"valdmp": 10.0}]))
add("filled: dynamic relaxation", "refused", filled, more=("CONTROL_DYNAMIC_RELAXATION", [{}]))

# 3. Components and their names.
add(
    "components: constraints",
    "same",
    components,
    support=None,
    nodes=("NODE", [n + [0.0] + ([7, 7] if n[0] in (13, 16) else []) for n in NODES]),
)
add(
    "components: a component without material",
    "fault",
    components,
    parts=("PART", ["left", [1, 1, 1], "right", [2, 1, 2], "auxiliary", [3, 0, 0]]),
)
add(
    "components: a component without elements",
    "fault",
    components,
    parts=("PART", ["left", [1, 1, 1], "right", [2, 1, 2], "unused", [3, 1, 1]]),
)
add(
    "components: history of a set",
    "same",
    components,
    tables=REQUESTS[:-2]
    + [
        NCFORC,
        ("SET_NODE_LIST", [{"sid": 9}, [1, 3, 6, 11, 13, 14, 16]]),
        ("DATABASE_HISTORY_NODE_SET", [[9]]),
        REQUESTS[-1],
    ],
)
add(
    "components: a late load",
    "runs",
    components,
    curve=("DEFINE_CURVE", [{"lcid": 1, "offa": 0.004}, [0.0, 1.0], [1.0, 3.0]]),
)
add(
    "components: a set by clauses",
    "same",
    components,
    held=[
        ("DEFINE_BOX", [[4, 1.9, 2.1, -1.0, 2.0, -1.0, 1.0]]),
        ("SET_NODE_GENERAL", [{"sid": 1}, {"option": "BOX", "e1": 4}]),
    ],
)
add("components: an unused node", "fault", components, nodes=("NODE", NODES + [[99, 5.0, 5.0]]))
add(
    "components: turned elements",
    "fault",
    components,
    elements=("ELEMENT_SHELL", [[1, 1, 1, 4, 5, 2]] + SHELLS[1:]),
)

# 4. Comments, ids, parameters, several files.
MESH = banners.deck([("NODE", NODES), ("ELEMENT_SHELL", SHELLS)])
ASIDE = dict(nodes=None, elements=("INCLUDE", ["mesh.key"]))
PARAMETERS = (
    "PARAMETER",
    ["Rvx              1.0Rmu              0.3Rend            0.01Istyp              2"],
)
EXPRESSIONS = (
    "PARAMETER_EXPRESSION",
    ["R vy      -vx/4", "R dt      end/100", "I two     nint(2*vx)"],
)
USING = dict(
    title=[SCENE["title"], PARAMETERS, EXPRESSIONS],
    end=("CONTROL_TERMINATION", [["&end"]]),
    general=("CONTROL_IMPLICIT_GENERAL", [[1, "&dt"]]),
    velocity=(
        "INITIAL_VELOCITY_GENERATION",
        [{"id": 1, "styp": "&styp", "vx": "&vx", "vy": "&vy"}, {}],
    ),
)
add("banners: parameters", "same", banners, **USING)
add(
    "banners: a mesh apart",
    "same",
    banners,
    {"mesh.key": MESH.replace("*KEYWORD", "*KEYWORD\n*TITLE\nthe mesh")},
    **ASIDE
)
add(
    "banners: a mesh in a folder",
    "same",
    banners,
    {"include/mesh.key": MESH},
    title=[("INCLUDE_PATH_RELATIVE", ["include"]), SCENE["title"]],
    **ASIDE
)
add(
    "banners: local parameters",
    "same",
    banners,
    {
        "mesh.key": MESH.replace(
            "*NODE", "*PARAMETER_LOCAL\nRx               0.5\n*NODE"
        ).replace("       2             0.5", "       2              &x")
    },
    title=[("PARAMETER", ["Rx               9.0"]), SCENE["title"]],
    **ASIDE
)
add(
    "banners: ids and headings",
    "same",
    banners,
    support=("BOUNDARY_SPC_SET", [{"nsid": 1, "dofx": 1, "dofy": 1}], "far side, held"),
    frame="*KEYWORD_ID\nproject   1\n*KEYWORD",
)
add(
    "banners: an unknown parameter",
    "fault",
    banners,
    **dict(USING, end=("CONTROL_TERMINATION", [["&tend"]]))
)
add(
    "banners: transformed include",
    "refused",
    banners,
    {"mesh.key": MESH},
    nodes=None,
    elements=[("INCLUDE", ["mesh.key"]), ("INCLUDE_TRANSFORM", ["more.key"])],
)
add(
    "banners: a wall with ribs", "refused", banners, more=("RIGIDWALL_PLANAR_ORTHO", ["", " 1.0"])
)
add(
    "banners: a missing include",
    "fault",
    banners,
    nodes=None,
    elements=("INCLUDE", ["nowhere.key"]),
)

# 5. Mesh generators and scripts.
LINES = ("ELEMENT_BEAM", ["101, 1000001, 1, 2", "102, 1000001, 2, 3"])
TRIANGLES = [
    [e, 1] + t for e, t in enumerate(([1, 2, 5], [1, 5, 4], [2, 3, 6], [2, 6, 5]), 1)
] + [s for s in SHELLS[2:]]
add("commas: boundary lines", "same", commas, elements=[LINES, SCENE["elements"]])
add(
    "commas: triangles",
    "runs",
    commas,
    elements=(
        "ELEMENT_SHELL",
        [[e + 10 * (k > 3), *rest] for k, (e, *rest) in enumerate(TRIANGLES)],
    ),
    tables=REQUESTS[:-1],
)
add(
    "commas: a title of the mesh",
    "same",
    commas,
    {
        "mesh.key": commas.deck(
            [("TITLE", ["mesh"]), ("NODE", NODES), ("ELEMENT_SHELL", SHELLS)]
        )
    },
    **ASIDE
)
add(
    "commas: whole reals",
    "same",
    commas,
    section=("SECTION_SHELL", [{"secid": "1.0", "elform": "13.0", "nip": "4.0"}, {"t1": 0.5}]),
)

# 6. People.
add("by hand: expressions", "same", by_hand, **USING)
add(
    "by hand: blank lines everywhere",
    "same",
    by_hand,
    edit=[("*node\n", "*node\n\n\n"), ("*element_shell\n", "\n*element_shell\n   \n")],
)
add("by hand: a slip of the pen", "fault", by_hand, edit=[("*set_part_list", "*set_prat_list")])
add(
    "by hand: a letter in a number",
    "fault",
    by_hand,
    edit=[("0.001     1000.0", "0.001     1000.O")],
)
add(
    "by hand: a shifted card",
    "fault",
    filled,
    edit=[("     0.001    1000.0       0.3", "0.001    1000.0       0.3")],
)
add("by hand: a tab", "fault", by_hand, edit=[("2000.0    0.25", "2000.0\t0.25")])
add("by hand: a forgotten heading", "fault", by_hand, edit=[("right\n2 ", "2 ")])
add(
    "by hand: a set that is not there",
    "fault",
    by_hand,
    support=("BOUNDARY_SPC_SET", [{"nsid": 8, "dofx": 1}]),
)
add(
    "by hand: an option that nobody has",
    "fault",
    by_hand,
    edit=[("*part\n", "*part_headings\n")],
)
