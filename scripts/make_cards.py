#!/usr/bin/env python3
"""Write a deck that shows every keyword once: make_cards.py [-o FILE] [--bin bin/bipact]; with
--space a second one, of the keywords of models in space, with --finite a third, of finite deformation.

Columns, names and help come from `bipact --keywords`, so the deck cannot fall behind the table;
the values, below, make a scene that runs: a block of quadrilaterals and triangles flies at a
held base, a rigid body beside it, with loads, a moved edge and every table. make doc writes it to
input/cards/every_keyword.k, the others to every_keyword_in_space.k and
every_keyword_at_finite_deformation.k there."""

import argparse
import os
import re
import subprocess
import sys

import startup
from solid_forms import with_middles

NODES = [(10 * j + i + 1, 1.0 * i, -0.5 + 0.5 * j) for j in (0, 1) for i in range(4)]  # base
NODES += [
    (101 + 10 * j + i, 1.0 + 0.5 * i, 0.01 + 0.5 * j) for j in (0, 1) for i in range(3)
]  # block
QUADS = [(k + 1, 1, k + 1, k + 2, k + 12, k + 11) for k in range(3)] + [
    (11, 2, 101, 102, 112, 111)
]
RIGID = [(201, 2.4, 0.3), (202, 2.8, 0.3), (203, 2.8, 0.7), (204, 2.4, 0.7)]
RIGID += [(211, 2.9, 0.3), (212, 3.1, 0.3), (213, 3.1, 0.5), (214, 2.9, 0.5)]
TRIANGLES = [(12, 2, 102, 103, 113), (13, 2, 102, 113, 112)]
RIGID_QUADS = [(21, 3, 201, 202, 203, 204), (22, 4, 211, 212, 213, 214)]

# Other names of keywords that stand at most once in a deck.
OTHER_NAMES = {
    "DATABASE_GLSTAT_MASS_PROPERTIES", "CONTACT_SURFACE_TO_SURFACE", "CONTACT_NODES_TO_SURFACE",
    "CONTACT_SINGLE_SURFACE",
}

# keyword: its cards, each a dictionary of the fields that are not left blank
SCENE = (
    [
        ("TITLE", [{"TITLE": "every keyword once"}]),
        ("CONTROL_TERMINATION", [{"ENDTIM": "&tend"}]),
        ("CONTROL_IMPLICIT_GENERAL", [{"IMFLAG": 1, "DT0": "&dt"}]),
        ("CONTROL_IMPLICIT_DYNAMICS", [{"IMASS": 1, "GAMMA": 0.5, "BETA": 0.25}]),
        ("CONTROL_IMPLICIT_SOLUTION", [{"NSOLVR": 1}]),
        ("CONTROL_TIMESTEP", [{"TSSFAC": 0.9}]),
        ("BIPACT_TIME", [{"SCHEME": "&scheme"}]),
        ("CONTROL_IMPLICIT_AUTO", [{"IAUTO": 0}]),
        ("BIPACT_STEP", [{"MODE": "&mode"}]),
        ("BIPACT_STATIC", [{"SHIFT": "1.0E-3", "MAXPASS": 60}]),
        ("BIPACT_MASS", [{"TYPE": "LUMPED", "REDIST": 0}]),
        (
            "BIPACT_CONTACT",
            [{"SOLVER": "AUTO", "TOL": "1.0E-10"}, {"PENTOL": "1.0E-9", "ROTWARN": 5.0}],
        ),
        ("BIPACT_SOLVER", [{"ENGINE": "LDLT", "ORDER": "AUTO"}]),
        ("BIPACT_LEDGER", [{"EVERY": 10, "GROWTH": "1.0E-9", "ACTION": "WARN"}]),
        ("NODE", [{"NID": n, "X": x, "Y": y} for n, x, y in NODES + RIGID]),
        (
            "ELEMENT_SHELL",
            [dict(zip(("EID", "PID", "N1", "N2", "N3", "N4"), e)) for e in QUADS + TRIANGLES + RIGID_QUADS],
        ),
        ("ELEMENT_BEAM", [{"EID": 91, "PID": 9, "N1": 1, "N2": 2}]),
        (
            "PART",
            [
                {"HEADING": "base"},
                {"PID": 1, "SECID": 1, "MID": 1},
                {"HEADING": "block"},
                {"PID": 2, "SECID": 1, "MID": 2},
                {"HEADING": "rigid"},
                {"PID": 3, "SECID": 1, "MID": 3},
            ],
        ),
        (
            "PART_INERTIA",
            [
                {"HEADING": "rigid, joined to part 3"},
                {"PID": 4, "SECID": 1, "MID": 4},
                {"XC": 3.0, "YC": 0.4, "TM": 1.0e-4},
                {"IZZ": 2.0e-6},
                {"VTX": 0.0},
            ],
        ),
        ("SECTION_SHELL", [{"SECID": 1, "ELFORM": 13, "NIP": 4}, {"T1": 1.0}]),
        ("MAT_ELASTIC", [{"MID": 1, "RO": 0.001, "E": 1000.0, "PR": 0.3}]),
        ("MAT_001", [{"MID": 2, "RO": 0.001, "E": 500.0, "PR": 0.0}]),
        (
            "MAT_RIGID",
            [{"MID": 3, "RO": 0.001}, {"CMO": 1.0, "CON1": 1, "CON2": 0}, {}],
        ),
        ("MAT_020", [{"MID": 4, "RO": 0.001}, {}, {}]),
        ("SET_NODE_LIST", [{"SID": 1}, {"NID1": 1, "NID2": 2, "NID3": 3, "NID4": 4}]),
        ("SET_NODE", [{"SID": 2}, {"NID1": 111}]),
        ("SET_NODE_LIST_GENERATE", [{"SID": 3}, {"B1BEG": 101, "B1END": 113}]),
        ("SET_PART_LIST", [{"SID": 1}, {"PID1": 1}]),
        ("SET_PART", [{"SID": 2}, {"PID1": 2}]),
        ("SET_PART_LIST_GENERATE", [{"SID": 3}, {"B1BEG": 1, "B1END": 2}]),
        ("SET_SHELL_LIST", [{"SID": 1}, {"EID1": 11}]),
        ("SET_SHELL", [{"SID": 2}, {"EID1": 12, "EID2": 13}]),
        ("SET_SHELL_LIST_GENERATE", [{"SID": 3}, {"B1BEG": 1, "B1END": 3}]),
        ("SET_SEGMENT", [{"SID": 1}, {"N1": 112, "N2": 111}]),
        ("SET_NODE_COLUMN", [{"SID": 4}, {"NID": 102}, {"NID": 103}]),
        ("SET_PART_COLUMN", [{"SID": 4}, {"PID": 2}]),
        ("SET_SHELL_COLUMN", [{"SID": 4}, {"EID": 11}]),
        ("DEFINE_BOX", [{"BOXID": 1, "XMN": -1.0, "XMX": 9.0, "YMN": 0.2, "YMX": 9.0}]),
        (
            "SET_NODE_GENERAL",
            [{"SID": 5}, {"OPTION": "PART", "E1": 2}, {"OPTION": "DBOX", "E1": 1}],
        ),
        ("SET_SHELL_GENERAL", [{"SID": 5}, {"OPTION": "PART", "E1": 2}]),
        ("SET_SEGMENT_GENERAL", [{"SID": 2}, {"OPTION": "PART", "E1": 2}]),
        (
            "DEFINE_CURVE",
            [{"LCID": 1}, {"A": 0.0, "O": 0.0}, {"A": 0.01, "O": 1.0}, {"A": 1.0, "O": 1.0}],
        ),
        ("INITIAL_VELOCITY", [{"NSID": 3}, {"VX": 0.2, "VY": "-&v0"}]),
        ("INITIAL_VELOCITY_NODE", [{"NID": 1}]),
        ("INITIAL_VELOCITY_GENERATION", [{"ID": 1, "STYP": 2}, {}]),
        ("INITIAL_VELOCITY_RIGID_BODY", [{"PID": 3, "VY": 1.0}]),
        ("CONSTRAINED_RIGID_BODIES", [{"PIDL": 3, "PIDC": 4}]),
        ("BOUNDARY_SPC_SET", [{"NSID": 1, "DOFX": 1, "DOFY": 1}]),
        ("BOUNDARY_SPC_NODE", [{"NID": 11, "DOFX": 1}]),
        (
            "BOUNDARY_PRESCRIBED_MOTION_SET",
            [{"NSID": 2, "DOF": 1, "VAD": 0, "LCID": 1, "SF": 0.1, "BIRTH": 0.012}],
        ),
        (
            "BOUNDARY_PRESCRIBED_MOTION_NODE",
            [{"NID": 14, "DOF": 1, "VAD": 2, "LCID": 1, "SF": 0.001, "BIRTH": 0.0005}],
        ),
        (
            "BOUNDARY_PRESCRIBED_MOTION_RIGID",
            [{"PID": 3, "DOF": 7, "VAD": 2, "LCID": 1, "SF": 0.001}],
        ),
        ("LOAD_RIGID_BODY", [{"PID": 3, "DOF": 2, "LCID": 1, "SF": 0.01}]),
        ("LOAD_NODE_SET", [{"NSID": 2, "DOF": 2, "LCID": 1, "SF": -0.01}]),
        ("LOAD_NODE_POINT", [{"NID": 113, "DOF": 2, "LCID": 1, "SF": -0.01}]),
        ("LOAD_SEGMENT_SET", [{"SSID": 1, "LCID": 1, "SF": 0.1}]),
        ("LOAD_SEGMENT", [{"LCID": 1, "SF": 0.1, "AT": 0.005, "N1": 113, "N2": 112}]),
        ("LOAD_BODY_X", [{"LCID": 1, "SF": 0.0001}]),
        ("LOAD_BODY_Y", [{"LCID": 1, "SF": 10.0}]),
        ("DAMPING_GLOBAL", [{"LCID": 0, "VALDMP": 0.0}]),
        ("DAMPING_PART_MASS", [{"PID": 1, "LCID": 1, "SF": 5.0}]),
        ("DAMPING_PART_MASS_SET", [{"PSID": 2, "LCID": 1, "SF": 10.0}]),
        ("DAMPING_PART_STIFFNESS", [{"PID": 1, "COEF": "-1.0E-5"}]),
        ("DAMPING_PART_STIFFNESS_SET", [{"PSID": 2, "COEF": "-2.0E-5"}]),
        ("CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", [{"SURFA": 1, "SURFB": 2, "FS": "&mu"}]),
        (
            "CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE",
            [{"SURFA": -3, "SURFB": 1, "FS": "&mu"}, {"TBIRTH": 0.03}],
        ),
        (
            "CONTACT_2D_AUTOMATIC_SINGLE_SURFACE",
            [{"SURFA": 0, "FS": "&mu"}, {"TBIRTH": 0.03}],
        ),
        ("RIGIDWALL_PLANAR", [{"NSID": 3}, {"XT": 2.2, "XH": 1.0, "FRIC": 0.1}]),
        (
            "RIGIDWALL_PLANAR_MOVING",
            [{"NSID": 3}, {"XT": 0.8, "XH": 1.0, "FRIC": 0.1}, {"MASS": 0.01, "V0": 0.1}],
        ),
        (
            "RIGIDWALL_GEOMETRIC_FLAT",
            [{"NSID": 3}, {"YT": 2.0, "YH": 1.0}, {"XHEV": 1.0, "YHEV": 2.0, "LENL": 3.0}],
        ),
        (
            "RIGIDWALL_GEOMETRIC_FLAT_MOTION",
            [{"NSID": 3}, {"YT": 3.0, "YH": 1.0}, {"LENL": 0.0}, {"LCID": 1, "VY": -1.0}],
        ),
        (
            "RIGIDWALL_GEOMETRIC_CYLINDER",
            [{"NSID": 3}, {"XT": -2.0, "XH": -2.0, "ZH": 1.0}, {"RADCYL": 0.5}],
        ),
        (
            "RIGIDWALL_GEOMETRIC_CYLINDER_MOTION",
            [
                {"NSID": 3},
                {"XT": 5.0, "XH": 5.0, "ZH": 1.0},
                {"RADCYL": 0.5},
                {"LCID": 1, "OPT": 1, "VX": -1.0},
            ],
        ),
        ("RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR", [{"NSID": 3}, {"ZH": 1.0}, {"RADCYL": 9.0}]),
        (
            "RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR_MOTION",
            [{"NSID": 3}, {"ZH": 1.0}, {"RADCYL": 9.5}, {"LCID": 1, "VY": 1.0}],
        ),
        ("BIPACT_PAIR", [{"CID": 1, "SIDE": "AUTO"}]),
        ("DATABASE_HISTORY_NODE", [{"ID1": 101}]),
        ("DATABASE_HISTORY_NODE_ID", [{"ID1": 102, "HEADING": "middle"}]),
        ("DATABASE_HISTORY_NODE_SET", [{"ID1": 2}]),
        ("DATABASE_HISTORY_SHELL", [{"ID1": 1}]),
        ("DATABASE_HISTORY_SHELL_ID", [{"ID1": 12, "HEADING": "a triangle"}]),
        ("DATABASE_HISTORY_SHELL_SET", [{"ID1": 2}]),
    ]
    + [
        ("DATABASE_" + name, [{"DT": 0.002}])
        for name in (
            "GLSTAT",
            "MATSUM",
            "NODOUT",
            "ELOUT",
            "RCFORC",
            "RWFORC",
            "SLEOUT",
            "SPCFORC",
            "NCFORC",
            "RBDOUT",
        )
    ]
    + [
        ("BIPACT_TIMING", [{"DT": 0.01}]),
        ("BIPACT_FIELD", [{"DT": 0.005, "PREC": 32}, {"NAME1": "U", "NAME2": "STRESS"}]),
        ("BIPACT_RESTART", [{"NSTEP": 100, "KEEP": 2}]),
        ("DATABASE_BINARY_D3PLOT", [{"DT": 0.01, "PSETID": 1}]),
    ]
)
# A hexahedron and a wedge beside it, on two cards; they fly, pulled and pressed. A quadratic one
# apart from them.
CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]
QUADRATIC = with_middles([(x + 4, y, z) for z in (0, 1) for x, y in CORNERS], [range(8)])
IN_SPACE = (
    [
        ("TITLE", [{"TITLE": "the keywords of models in space"}]),
        ("CONTROL_TERMINATION", [{"ENDTIM": 0.02}]),
        ("CONTROL_IMPLICIT_GENERAL", [{"IMFLAG": 1, "DT0": 0.001}]),
        ("CONTROL_IMPLICIT_DYNAMICS", [{"IMASS": 1}]),
        (
            "NODE",
            [
                {"NID": 4 * z + k + 1, "X": 1.0 * x, "Y": 1.0 * y, "Z": 1.0 * z}
                for z in (0, 1)
                for k, (x, y) in enumerate(CORNERS)
            ]
            + [{"NID": 9, "X": 2.0, "Y": 0.0, "Z": 0.5}, {"NID": 10, "X": 2.0, "Y": 1.0, "Z": 0.5}]
            + [
                {"NID": 8 * b + 4 * z + k + 11, "X": x + 0.2, "Y": y + 0.1, "Z": 1.5 * b + z + 1.5}
                for b in (0, 1)
                for z in (0, 1)
                for k, (x, y) in enumerate(CORNERS)
            ]
            + [dict(zip(("NID", "X", "Y", "Z"), (31 + k, *x))) for k, x in enumerate(QUADRATIC[0])],
        ),
        ("ELEMENT_SOLID", [
            dict(zip(["EID", "PID"] + ["N%d" % k for k in range(1, 9)],
                     [e, p] + list(range(first, first + 8))))
            for e, p, first in ((1, 1, 1), (3, 2, 11), (4, 3, 19))
        ]),
        (
            "ELEMENT_SOLID (ten nodes format)",
            [
                {"EID": 2, "PID": 1},
                dict(zip(["N%d" % k for k in range(1, 9)], [6, 2, 3, 7, 9, 9, 10, 10])),
            ],
        ),
        (
            "ELEMENT_SOLID_H27",
            [
                {"EID": 5, "PID": 4},
                *(
                    {"N%d" % (k + 1): 31 + QUADRATIC[1][0][k] for k in range(m, min(m + 10, 27))}
                    for m in (0, 10, 20)
                ),
            ],
        ),
        ("PART", [
            {"HEADING": "block"}, {"PID": 1, "SECID": 1, "MID": 1},
            {"HEADING": "above it"}, {"PID": 2, "SECID": 1, "MID": 1},
            {"HEADING": "above that"}, {"PID": 3, "SECID": 1, "MID": 1},
            {"HEADING": "quadratic"}, {"PID": 4, "SECID": 2, "MID": 1},
        ]),
        ("SECTION_SOLID", [{"SECID": 1, "ELFORM": -1}]),
        ("SECTION_SOLID", [{"SECID": 2, "ELFORM": 24}]),
        ("MAT_ELASTIC", [{"MID": 1, "RO": 0.001, "E": 1000.0, "PR": 0.3}]),
        ("SET_NODE_LIST", [{"SID": 1}, {"NID1": 11, "NID2": 12, "NID3": 13, "NID4": 14}]),
        ("SET_SOLID_LIST", [{"SID": 1}, {"EID1": 1}]),
        ("SET_SOLID", [{"SID": 2}, {"EID1": 1, "EID2": 2}]),
        ("SET_SOLID_LIST_GENERATE", [{"SID": 3}, {"B1BEG": 1, "B1END": 2}]),
        ("SET_SOLID_GENERATE", [{"SID": 4}, {"B1BEG": 1, "B1END": 2}]),
        ("SET_SOLID_GENERAL", [{"SID": 5}, {"OPTION": "ALL"}]),
        ("SET_SEGMENT", [{"SID": 1}, {"N1": 5, "N2": 6, "N3": 7, "N4": 8}]),
        ("SET_SEGMENT_GENERAL", [{"SID": 2}, {"OPTION": "SEG", "E1": 2, "E2": 9, "E3": 6}]),
        ("DEFINE_CURVE", [{"LCID": 1}, {"A": 0.0, "O": 1.0}, {"A": 1.0, "O": 1.0}]),
        (
            "INITIAL_VELOCITY_GENERATION",
            [{"ID": 1, "STYP": 2, "OMEGA": 0.1, "VZ": 1.0}, {"XC": 0.5, "NX": 1.0, "NY": 1.0}],
        ),
        ("BOUNDARY_SPC_NODE", [{"NID": 1, "DOFZ": 1}]),
        ("LOAD_NODE_POINT", [{"NID": 2, "DOF": 3, "LCID": 1, "SF": 0.01}]),
        ("LOAD_SEGMENT_SET", [{"SSID": 1, "LCID": 1, "SF": 0.1}]),
        ("LOAD_SEGMENT", [{"LCID": 1, "SF": 0.1, "N1": 3, "N2": 10, "N3": 7}]),
        ("LOAD_BODY_Z", [{"LCID": 1, "SF": 10.0}]),
        (
            "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE",
            [{"SURFA": 2, "SURFB": 3, "SURFATYP": 3, "SURFBTYP": 3}, {"FS": 0.2}],
        ),
        (
            "CONTACT_AUTOMATIC_NODES_TO_SURFACE",
            [{"SURFA": 1, "SURFB": 1, "SURFATYP": 4, "SURFBTYP": 3}, {"FS": 0.2, "BT": 1.0}],
        ),
        (
            "CONTACT_AUTOMATIC_SINGLE_SURFACE",
            [{"SURFA": 0, "SURFATYP": 5}, {"FS": 0.2}],
        ),
        ("DATABASE_HISTORY_SOLID", [{"ID1": 1}]),
        ("DATABASE_HISTORY_SOLID_ID", [{"ID1": 2, "HEADING": "the wedge"}]),
        ("DATABASE_HISTORY_SOLID_SET", [{"ID1": 2}]),
    ]
    + [("DATABASE_" + name, [{"DT": 0.002}]) for name in ("GLSTAT", "MATSUM", "ELOUT")]
    + [("BIPACT_FIELD", [{"DT": 0.01}, {"NAME1": "U", "NAME2": "STRESS"}])]
)
PARAMETERS = [
    ("Rtend", "0.02"),
    ("Rdt", "0.0001"),
    ("Rv0", "1.0"),
    ("Rmu", "0.2"),
    ("Cscheme", "THETA"),
    ("Cmode", "FIXED"),
]


# Laws of finite strain, each with both its names: cards but for MID and RO.
LAWS = (
    ("MAT_BLATZ-KO_RUBBER", "MAT_007", [{"G": 34.0}]),
    ("MAT_BLATZ-KO_FOAM", "MAT_038", [{"G": 40.0}]),
    ("MAT_MOONEY-RIVLIN_RUBBER", "MAT_027", [{"PR": 0.49, "A": 14.0, "B": 3.0}]),
    ("MAT_OGDEN_RUBBER", "MAT_077_O", [{"PR": 0.49}, {"MU1": 20.0, "MU2": -1.0}, {"ALPHA1": 3.0, "ALPHA2": -2.0}]),
    ("MAT_HYPERELASTIC_RUBBER", "MAT_077_H", [{"PR": 0.45}, {"C10": 17.0}]),
    ("MAT_PLASTIC_KINEMATIC", "MAT_003", [{"E": 100.0, "PR": 0.3, "SIGY": 1.0, "ETAN": 5.0, "BETA": 0.5}]),
    (
        "MAT_PIECEWISE_LINEAR_PLASTICITY",
        "MAT_024",
        [
            {"E": 100.0, "PR": 0.3, "SIGY": 1.0},
            {},
            {"EPS1": 0.0, "EPS2": 0.05, "EPS3": 0.5},
            {"ES1": 1.0, "ES2": 1.5, "ES3": 2.0},
        ],
    ),
)


def finite_scene():
    """A square of each law for each of its names, pulled apart by the velocity of its right edge."""
    names = [(name, cards) for law in LAWS for name, cards in ((law[0], law[2]), (law[1], law[2]))]
    squares = range(1, len(names) + 1)
    corners = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    places = [(10 * k + n, x, 2.0 * k + y) for k in squares for n, (x, y) in enumerate(corners, 1)]
    scene = [
        ("TITLE", [{"TITLE": "laws of finite strain"}]),
        ("CONTROL_TERMINATION", [{"ENDTIM": 0.02}]),
        ("CONTROL_IMPLICIT_GENERAL", [{"IMFLAG": 1, "DT0": "5.0E-4"}]),
        ("CONTROL_IMPLICIT_DYNAMICS", [{"IMASS": 1}]),
        ("CONTROL_IMPLICIT_SOLUTION", [{"NSOLVR": 12}]),
        ("BIPACT_KINEMATICS", [{"FORCE": "EMC", "QP0": "AUTO"}]),
        ("BIPACT_TIME", [{"SCHEME": "THETA"}]),
        ("NODE", [{"NID": n, "X": x, "Y": y} for n, x, y in places]),
        (
            "ELEMENT_SHELL",
            [{"EID": k, "PID": k, **{"N%d" % n: 10 * k + n for n in range(1, 5)}} for k in squares],
        ),
        ("PART", sum(([{"HEADING": n}, {"PID": k, "SECID": 1, "MID": k}] for k, (n, _) in enumerate(names, 1)), [])),
        ("SECTION_SHELL", [{"SECID": 1, "ELFORM": 13}, {"T1": 1.0}]),
    ]
    for k, (name, cards) in enumerate(names, 1):
        scene.append((name, [{"MID": k, "RO": "1.0E-3", **cards[0]}] + cards[1:]))
    pulled = [n for n, x, _ in places if x > 0.0]
    scene.append(("INITIAL_VELOCITY_NODE", [{"NID": n, "VX": 20.0} for n in pulled]))
    scene.append(("DATABASE_HISTORY_SHELL", [{"ID%d" % k: k for k in range(1, 9)}]))
    return scene + [("DATABASE_" + n, [{"DT": 0.002}]) for n in ("GLSTAT", "MATSUM", "ELOUT")]


HEAD_AT_FINITE_DEFORMATION = [
    "$ The keywords of finite deformation, written by scripts/make_cards.py from the program's own "
    "table;",
    "$ every_keyword.k has the others. Squares of each law are pulled apart. Units: any consistent "
    "set.",
    "*KEYWORD",
]
HEAD_IN_SPACE = [
    "$ The keywords of models in space, written by scripts/make_cards.py from the program's own "
    "table;",
    "$ every_keyword.k has the others. Two elements fly, pulled and pressed. Units: any consistent "
    "set.",
    "*KEYWORD",
]


def layouts(program):
    """{keyword: (help, repeat_from, cards)}, a card a list of (name, first, last)."""
    text = subprocess.run(
        [program, "--keywords"], stdout=subprocess.PIPE, text=True, check=True
    ).stdout
    found, name = {}, None
    for line in text.split("## Read without effect")[0].splitlines():
        if line.startswith("### *"):
            name, cards = line[5:], []
            found[name] = ["", 0, cards]
        elif line.startswith("Card "):
            cards.append([])
        elif line.startswith("| ") and not line.startswith("| field"):
            field, columns = [x.strip() for x in line.split("|")[1:3]]
            cards[-1].append((field,) + tuple(int(x) for x in columns.split("-")))
        elif line and name and not found[name][0] and not line.startswith("|"):
            found[name][0] = line.split(". ")[0].split(". `")[0].rstrip(".")
            repeat = re.search(r"Cards from (\d) on repeat", line)
            found[name][1] = int(repeat.group(1)) if repeat else 0
    for name, (text, _, cards) in found.items():
        same = re.match(r"The same as \*(\S+)", text)
        if same:
            found[name] = [text, found[same.group(1)][1], found[same.group(1)][2]]
    return found


def card_text(layout, values):
    """One card in columns."""
    out = ""
    for name, first, last in layout:
        if name not in values:
            continue
        text = str(values[name])
        if len(text) > last - first + 1:
            raise SystemExit("%s is too long for %s" % (text, name))
        out = out.ljust(first - 1)
        out += text if len(layout) == 1 and last - first > 60 else text.rjust(last - first + 1)
    unknown = set(values) - {name for name, _, _ in layout}
    if unknown:
        raise SystemExit("no such fields: %s" % sorted(unknown))
    return out


def header(layout):
    """The comment line with the names of the fields over their columns."""
    out = "$#"
    for name, first, last in layout:
        out = out.ljust(first - 1) + name.lower()[: last - first].rjust(
            last - first + 1 - max(0, len(out) - first + 1)
        )
    return out


def deck(program, kind):
    """The whole text of a deck: in the "plane", in "space", "finite"."""
    found = layouts(program)
    at_finite = finite_scene()
    shown = {name for name, _ in SCENE + IN_SPACE + at_finite}
    missing = sorted(set(found) - shown - OTHER_NAMES)
    if missing:
        raise SystemExit("make_cards.py does not show: " + " ".join(missing))
    heads = {"space": HEAD_IN_SPACE, "finite": HEAD_AT_FINITE_DEFORMATION}
    out = heads[kind][:] if kind in heads else [
        "$ Every keyword of bipact once, written by scripts/make_cards.py from the program's own "
        "table.",
        "$ A block of quadrilaterals and triangles falls on a held base. Units: any consistent "
        "set.",
        "*KEYWORD",
        "*PARAMETER",
        "$#   name1    value1     name2    value2     name3    value3     " "name4    value4",
    ]
    for k in range(0, len(PARAMETERS) if kind == "plane" else 0, 4):
        out.append("".join(n.ljust(10) + v.rjust(10) for n, v in PARAMETERS[k : k + 4]))
    for name, cards in {"space": IN_SPACE, "finite": at_finite}.get(kind, SCENE):
        text, repeat, layout = found[name]
        out += ["$", "$ " + text, "*" + name]
        for k, values in enumerate(cards):
            row = (
                k
                if k < len(layout)
                else (repeat - 1) + (k - repeat + 1) % (len(layout) - repeat + 1)
            )
            if k < len(layout) and layout[row][0][2] - layout[row][0][1] < 60:
                out.append(header(layout[row]))
            out.append(card_text(layout[row], values))
    return "\n".join(out + ["*END", ""])


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("-o", metavar="FILE", help="deck (default: to stdout)")
    parser.add_argument("--bin", default=startup.program(), help="program")
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("--space", action="store_true", help="the keywords of models in space")
    kinds.add_argument("--finite", action="store_true", help="those of finite deformation")
    a = parser.parse_args()
    text = deck(a.bin, "space" if a.space else "finite" if a.finite else "plane")
    if a.o:
        with open(a.o, "w", encoding="ascii") as out:
            out.write(text)
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
