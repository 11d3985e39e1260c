"""Every field of a card as the format has it by default, the way preprocessors write them, with
the notes that are expected. Sections are those of tests/support/plain.py."""

import re

from plain import SECTIONS, cards, fixed, long


def appended(section, tail):
    """The cards of a section with more columns."""
    return re.sub(r"(?m)^( .*)$", lambda m: m.group(1) + tail, SECTIONS[section])


# (name, section that is replaced, text, notes)
OF_THE_SCENE = [
    (
        "end of the run",
        "end",
        cards("CONTROL_TERMINATION", fixed(0.01, 0, "0.0", "0.0", "1.000E+08", 0)),
        [],
    ),
    (
        "end of the run, older",
        "end",
        cards("CONTROL_TERMINATION", fixed(0.01, 0, "0.0", "0.0", "0.0")),
        [],
    ),
    (
        "step",
        "general",
        cards("CONTROL_IMPLICIT_GENERAL", fixed(1, "1.0000E-4", 2, 1, 2, 0, 0, 0)),
        [],
    ),
    (
        "dynamics",
        "dynamics",
        cards(
            "CONTROL_IMPLICIT_DYNAMICS",
            fixed(1, "0.500", "0.250", "0.0", "1.00E+28", "1.00E+28", 0, "0.0"),
            fixed(0, "90.0"),
        ),
        [],
    ),
    (
        "section",
        "section",
        cards(
            "SECTION_SHELL",
            fixed(1, 13, "1.0", 4, "1.0", 0, 0, 1),
            fixed("0.5", "0.5", "0.5", "0.5", "0.0", "0.0", "0.0", 0),
        ),
        [],
    ),
    (
        "section, T2 to T4 by default",
        "section",
        cards(
            "SECTION_SHELL",
            fixed(1, 13, "1.0", 0, "1.0", "0.0", 0, 0),
            fixed("0.5", "0.0", "0.0", "0.0", "0.0", "0.0", "0.0", 0),
        ),
        [],
    ),
    (
        "section, points by default",
        "section",
        cards("SECTION_SHELL", fixed(1, 13, "1.0", 2, "1.0", 0, 0, 1), fixed("0.5")),
        ["NIP 2"],
    ),
    (
        "material",
        "left material",
        cards("MAT_ELASTIC", fixed(1, 0.001, "1000.0", "0.3", "0.0", "0.0", "0.0")),
        [],
    ),
    (
        "material, an integer in the last field",
        "left material",
        cards("MAT_ELASTIC", fixed(1, "1.0E-03", "1.0E+03", "0.3", 0, 0, 0)),
        [],
    ),
    (
        "node set",
        "held",
        cards(
            "SET_NODE_LIST",
            fixed(1, "0.0", "0.0", "0.0", "0.0", "MECH", 1),
            fixed(13, 16, 0, 0, 0, 0, 0, 0),
        ),
        [],
    ),
    (
        "parts",
        "parts",
        cards(
            "PART",
            "left",
            fixed(1, 1, 1, 0, 0, 0, 0, 0),
            "right",
            fixed(2, 1, 2, 0, 0, 0, 0, 0),
        ),
        [],
    ),
    ("support", "support", cards("BOUNDARY_SPC_SET", fixed(1, 0, 1, 1, 1, 1, 1, 1)), []),
    (
        "support of nodes",
        "support",
        cards(
            "BOUNDARY_SPC_NODE", fixed(13, 0, 1, 1, 0, 0, 0, 0), fixed(16, 0, 1, 1, 0, 0, 0, 0)
        ),
        [],
    ),
    (
        "curve",
        "curve",
        cards(
            "DEFINE_CURVE",
            fixed(1, 0, "1.0", "1.0", "0.0", "0.0", 0, 0),
            long("0.0", "1.0"),
            long("1.0", "3.0"),
        ),
        [],
    ),
    (
        "curve, scales 0",
        "curve",
        cards(
            "DEFINE_CURVE",
            fixed(1, 0, "0.0", "0.0", "0.0", "0.0", 0),
            long("0.0", "1.0"),
            long("1.0", "3.0"),
        ),
        [],
    ),
    ("load", "load", cards("LOAD_BODY_Y", fixed(1, "5.0", 0, "0.0", "0.0", "0.0", 0)), []),
    (
        "velocity",
        "velocity",
        cards(
            "INITIAL_VELOCITY_GENERATION",
            fixed(1, 2, "0.0", 1.0, -0.25, "0.0", 0, 0),
            fixed("0.0", "0.0", "0.0", "0.0", "0.0", "0.0", 0, 0),
        ),
        [],
    ),
    (
        "velocity of a set",
        "velocity",
        cards("SET_NODE_LIST", fixed(77), fixed(1, 2, 3, 4, 5, 6))
        + "\n"
        + cards(
            "INITIAL_VELOCITY",
            fixed(77, 0, 0, 0, 0),
            fixed("1.0", "-0.25", "0.0", "0.0", "0.0", "0.0"),
        ),
        [],
    ),
    (
        "velocity of nodes",
        "velocity",
        cards(
            "INITIAL_VELOCITY_NODE",
            *[fixed(n, "1.0", "-0.25", "0.0", "0.0", "0.0", "0.0", 0) for n in range(1, 7)]
        ),
        [],
    ),
    (
        "contact",
        "contact",
        cards(
            "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE",
            fixed(11, 12, "1.0", 50, 0.3, "0.0", "0.0"),
            fixed("0.0", "1.000E+20", "1.0", "1.0", 0, 0, 0, 0),
            fixed("0.0", "10.0", 0, 0, 0, "0.0", 0, 0),
            fixed("0.0", "0.0", "0.0"),
        ),
        [],
    ),
    (
        "contact, zeros",
        "contact",
        cards(
            "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE",
            fixed(11, 12, "0.0", 0, 0.3, "0.0", "0.0"),
            fixed("0.0", "0.0", "0.0", "0.0", 0, 0, 0, 0),
        ),
        [],
    ),
    (
        "nodes",
        "nodes",
        appended("nodes", fixed("0.0", width=16) + fixed(0, 0, width=8)),
        [],
    ),
    ("elements", "elements", appended("elements", fixed(0, 0, 0, 0, width=8)), []),
    (
        "tables",
        "tables",
        "\n".join(
            cards("DATABASE_" + name, fixed(0.001, 0, 0, 1, *options))
            for name, options in (
                ("GLSTAT", ()),
                ("MATSUM", ()),
                ("NODOUT", ("0.0", 0)),
                ("ELOUT", (0, 0, 0, 0)),
                ("RCFORC", (0,)),
                ("SLEOUT", ()),
                ("SPCFORC", ()),
                ("NCFORC", (0, 0, 0, 0)),
            )
        ),
        [],
    ),
    (
        "history",
        "nodes of nodout",
        cards("DATABASE_HISTORY_NODE", fixed(1, 3, 6, 11, 13, 14, 16, 0)),
        [],
    ),
]

# (name, text put at the end of the scene, the plain text for it or None, notes)
BESIDE_THE_SCENE = [
    (
        "linear solution, all cards",
        cards(
            "CONTROL_IMPLICIT_SOLUTION",
            fixed(1, 11, 15, "0.001", "0.01", "1.00E+10", "0.9", "1.0E-10"),
            fixed(2, 1, 1, 0, "2.0", 0, 0),
            fixed(0, 0, "0.0", 1, 2, "0.0", "0.0", "0.0"),
            fixed(4, 2, "0.0", "0.0", "0.0", "0.0"),
        ),
        None,
        [],
    ),
    (
        "linear solution, three cards",
        cards("CONTROL_IMPLICIT_SOLUTION", fixed(1), fixed(2), fixed(0, 1)),
        None,
        [],
    ),
    (
        "linear solution, blank cards",
        cards("CONTROL_IMPLICIT_SOLUTION", fixed(1), "", "", ""),
        None,
        None,
    ),
    (
        "automatic steps that are off",
        cards("CONTROL_IMPLICIT_AUTO", fixed(0, 11, 5, "0.0", "0.0", "0.0", 0, 0)),
        None,
        ["*CONTROL_IMPLICIT_AUTO"],
    ),
    (
        "explicit steps",
        cards(
            "CONTROL_TIMESTEP",
            fixed("0.0", "0.9", 0, "0.0", "0.0", 0, 0, 0),
            fixed("0.0", 0, 0, None, None, "0.0"),
        ),
        None,
        ["*CONTROL_TIMESTEP"],
    ),
    (
        "penalty contact",
        cards(
            "CONTROL_CONTACT",
            fixed("0.1", "0.0", 1, 0, 1, 1, 1, 0),
            fixed(0, 0, 10, 0, "4.0", 0, 0, 0),
            fixed("0.0", "0.0", "0.0", "0.0", "0.0", "0.0", "0.0", "0.0"),
            fixed(0, 0, 0, 0, 0, 0, "0.0", 0),
            fixed(0, 0, 0, "0.0", "1.0", 0, "0.0", 0),
            fixed(0, 0, 0, "0.0", 0, 0, 0),
        ),
        None,
        ["*CONTROL_CONTACT"],
    ),
    (
        "structural solution",
        cards("CONTROL_SOLUTION", fixed(0, 0, 0, 100)),
        None,
        ["*CONTROL_SOLUTION"],
    ),
    (
        "real shells",
        cards(
            "CONTROL_SHELL",
            fixed("20.0", 0, -1, 0, 2, 2, 1, 0),
            fixed("1.0", 0, 0, 1, 0),
            fixed(0, 0, 0, 0, 0, "0.0", "0.0", 0),
            fixed(0, 0, 0, 0, 0, 0, "1.0", 0),
            fixed(0, 0, "0.0"),
        ),
        None,
        ["*CONTROL_SHELL"],
    ),
    (
        "a d3plot that is off",
        cards(
            "DATABASE_BINARY_D3PLOT",
            fixed("0.0", 0, 0, 0, 0),
            fixed(0, "0.0", "0.0", "0.0", 0, 0),
        ),
        None,
        ["*DATABASE_BINARY_D3PLOT"],
    ),
    (
        "a wall",
        cards("SET_NODE_LIST", fixed(99), fixed(1, 4))
        + "\n"
        + cards(
            "RIGIDWALL_PLANAR",
            fixed(99, 0, 0, "0.0", "0.0", "1.0E+20", "1.0"),
            fixed("-9.0", "0.0", "0.0", "9.0", "0.0", "0.0", "0.0", "0.0"),
        ),
        cards("SET_NODE_LIST", fixed(99), fixed(1, 4))
        + "\n"
        + cards("RIGIDWALL_PLANAR", fixed(99), fixed(-9.0, None, None, 9.0)),
        [],
    ),
    (
        "a pressure",
        cards("LOAD_SEGMENT", fixed(1, "2.0", "0.0", 4, 5, 0, 0, 0)),
        cards("LOAD_SEGMENT", fixed(1, 2.0, None, 4, 5)),
        [],
    ),
    (
        "a force",
        cards("LOAD_NODE_POINT", fixed(4, 1, 1, "2.0", 0, 0, 0, 0)),
        cards("LOAD_NODE_POINT", fixed(4, 1, 1, 2.0)),
        [],
    ),
    (
        "a motion",
        cards(
            "BOUNDARY_PRESCRIBED_MOTION_NODE",
            fixed(15, 2, 0, 1, "0.0", 0, "1.00E+28", "0.0"),
        ),
        cards("BOUNDARY_PRESCRIBED_MOTION_NODE", fixed(15, 2, None, 1)),
        [],
    ),
]

# Fields that are not at their defaults and could change a solution: (name, changed section or
# "more", text, words of the message).
BEYOND = [
    (
        "no solution wanted",
        "end",
        cards("CONTROL_TERMINATION", fixed(0.01, 0, "0.0", "0.0", "0.0", 1)),
        "field NOSOL",
    ),
    (
        "springback",
        "general",
        cards("CONTROL_IMPLICIT_GENERAL", fixed(1, 0.0001, 2, 3)),
        "field NSBS",
    ),
    (
        "geometric stiffness",
        "general",
        cards("CONTROL_IMPLICIT_GENERAL", fixed(1, 0.0001, 2, 1, 1)),
        "field IGS",
    ),
    (
        "consistent tangent",
        "general",
        cards("CONTROL_IMPLICIT_GENERAL", fixed(1, 0.0001, 2, 1, 2, 1)),
        "field CNSTN",
    ),
    (
        "velocities set to zero",
        "general",
        cards("CONTROL_IMPLICIT_GENERAL", fixed(1, 0.0001, 2, 1, 2, 0, 0, 1)),
        "field ZERO_V",
    ),
    (
        "birth of dynamics within a step",
        "dynamics",
        cards("CONTROL_IMPLICIT_DYNAMICS", fixed(1, 0.5, 0.25, 0.00123456)),
        "field TDYBIR",
    ),
    (
        "death of dynamics",
        "dynamics",
        cards("CONTROL_IMPLICIT_DYNAMICS", fixed(1, 0.5, 0.25, "0.0", 0.005)),
        "field TDYDTH",
    ),
    (
        "a part set of dynamics",
        "dynamics",
        cards("CONTROL_IMPLICIT_DYNAMICS", fixed(1), fixed(11)),
        "field PSID",
    ),
    (
        "an arc length",
        "more",
        cards("CONTROL_IMPLICIT_SOLUTION", fixed(1), fixed(2), fixed(5)),
        "field ARCCTL",
    ),
    (
        "tolerances of another card",
        "more",
        cards("CONTROL_IMPLICIT_SOLUTION", fixed(1), fixed(-2), fixed(0.001)),
        "field DNORM",
    ),
    (
        "one point",
        "section",
        cards("SECTION_SHELL", fixed(1, 13, None, 1), fixed(0.5)),
        "field NIP",
    ),
    (
        "an Eulerian element",
        "section",
        cards("SECTION_SHELL", fixed(1, 13, None, 4, None, None, None, 2), fixed(0.5)),
        "field SETYP",
    ),
    (
        "mass without structure",
        "section",
        cards("SECTION_SHELL", fixed(1, 13, None, 4), fixed(0.5, None, None, None, None, 0.1)),
        "field MAREA",
    ),
    (
        "layers of a composite",
        "section",
        cards("SECTION_SHELL", fixed(1, 13, None, 4, None, None, 1), fixed(0.5)),
        "field ICOMP",
    ),
    (
        "thicknesses that differ",
        "section",
        cards("SECTION_SHELL", fixed(1, 13, None, 4), fixed(0.5, 0.5, 0.4, 0.5)),
        "field T3",
    ),
    (
        "an adaptive part",
        "parts",
        cards("PART", "left", fixed(1, 1, 1, 0, 0, 0, 1), "right", fixed(2, 1, 2)),
        "field ADPOPT",
    ),
    (
        "gravity of a part",
        "parts",
        cards("PART", "left", fixed(1, 1, 1, 0, 0, 5), "right", fixed(2, 1, 2)),
        "field GRAV",
    ),
    (
        "a support in another system",
        "support",
        cards("BOUNDARY_SPC_SET", fixed(1, 7, 1, 1)),
        "field CID",
    ),
    (
        "a curve of points in space",
        "curve",
        cards("DEFINE_CURVE", fixed(1, 0, "1.0", "1.0", "0.0", "0.0", 1), long(0.0, 1.0)),
        "field DATTYP",
    ),
    (
        "a curve of dynamic relaxation",
        "load",
        cards("LOAD_BODY_Y", fixed(1, 5.0, 1)),
        "field LCIDDR",
    ),
    (
        "nodes that are exempted",
        "velocity",
        cards("INITIAL_VELOCITY", fixed(None, 1), fixed(1.0)),
        "field NSIDEX",
    ),
    (
        "a box of velocities",
        "velocity",
        cards("INITIAL_VELOCITY", fixed(None, None, 1), fixed(1.0)),
        "field BOXID",
    ),
    (
        "a velocity that comes later",
        "velocity",
        cards("INITIAL_VELOCITY_GENERATION", fixed(1, 2, None, 1.0), fixed(*[None] * 6 + [1])),
        "field PHASE",
    ),
    (
        "a velocity out of the plane",
        "velocity",
        cards("INITIAL_VELOCITY_GENERATION", fixed(1, 2, None, 1.0, None, 1.0), ""),
        "field VZ",
    ),
    (
        "viscous friction",
        "contact",
        SECTIONS["contact"] + "\n\n" + fixed(1.0),
        "field VC",
    ),
    ("sliding", "contact", SECTIONS["contact"] + "\n\n" + fixed(0, 0, 0, 1), "field SLIDE"),
    (
        "a tied contact",
        "contact",
        SECTIONS["contact"] + "\n\n" + fixed(*[None] * 7 + [1]),
        "field TIETYP",
    ),
    (
        "a tie that closes gaps",
        "contact",
        SECTIONS["contact"] + "\n\n" + fixed(*[None] * 6 + [1]),
        "field IGAPCL",
    ),
    (
        "offsets of surfaces",
        "contact",
        SECTIONS["contact"] + "\n\n\n" + fixed(0.1),
        "field SLDSOA",
    ),
    (
        "a wall that looks out of the plane",
        "more",
        cards("RIGIDWALL_PLANAR", "", fixed(-9.0, 0.0, 0.0, 9.0, 0.0, 5.0)),
        "field ZH",
    ),
    (
        "a wall that moves",
        "more",
        cards("RIGIDWALL_PLANAR", "", fixed(-9.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 2.0)),
        "field WVEL",
    ),
    (
        "a wall that leaves nodes out",
        "more",
        cards("RIGIDWALL_PLANAR", fixed(None, 1), fixed(-9.0, 0.0, 0.0, 9.0)),
        "field NSIDEX",
    ),
    (
        "mass scaling",
        "more",
        cards("CONTROL_TIMESTEP", fixed("0.0", 0.9, 0, "0.0", "-1.E-6")),
        "field DT2MS",
    ),
    (
        "mass scaling by a curve",
        "more",
        cards("CONTROL_TIMESTEP", fixed("0.0", 0.9), fixed("0.0", 5)),
        "field DT2MSLC",
    ),
    (
        "selective mass scaling",
        "more",
        cards("CONTROL_TIMESTEP", fixed("0.0", 0.9), fixed("0.0", 0, 1)),
        "field IMSCL",
    ),
    (
        "elements that are deleted",
        "more",
        cards("CONTROL_TIMESTEP", fixed("0.0", 0.9, 0, "0.0", "0.0", 0, 1)),
        "field ERODE",
    ),
    (
        "moduli that follow the step",
        "more",
        cards("CONTROL_TIMESTEP", fixed("0.0", 0.9, 0, "1.E-6")),
        "field TSLIMT",
    ),
    (
        "friction of all contacts",
        "more",
        cards("CONTROL_CONTACT", "", "", fixed(0.2)),
        "field SFRIC",
    ),
    (
        "automatic steps",
        "more",
        cards("CONTROL_IMPLICIT_AUTO", fixed(2)),
        "field IAUTO",
    ),
    (
        "thermal analysis",
        "more",
        cards("CONTROL_SOLUTION", fixed(1)),
        "field SOLN",
    ),
    (
        "shells that are deleted when they warp",
        "more",
        cards("CONTROL_SHELL", "", "", fixed(0, 0, 0, 0, 0, "0.5")),
        "field W-MODE",
    ),
    (
        "shells that are deleted when they stretch",
        "more",
        cards("CONTROL_SHELL", "", "", fixed(0, 0, 0, 0, 0, "0.0", "1.5")),
        "field STRETCH",
    ),
    (
        "shells that are deleted when they fail",
        "more",
        cards("CONTROL_SHELL", "", "", "", fixed(1, 1)),
        "field NFAIL1",
    ),
    (
        "frames by a curve",
        "more",
        cards("DATABASE_BINARY_D3PLOT", fixed(0.001, 7)),
        "field LCDT",
    ),
    (
        "a number of frames",
        "more",
        cards("DATABASE_BINARY_D3PLOT", fixed(0.001, 0, 0, 7)),
        "field NPLTC",
    ),
    (
        "rows by a curve",
        "more",
        cards("DATABASE_RWFORC", fixed(0.001, 0, 7)),
        "field LCUR",
    ),
    (
        "a pressure on a quadratic edge",
        "more",
        cards("LOAD_SEGMENT", fixed(1, 2.0, None, 4, 5, 0, 0, 9)),
        "field N5",
    ),
]
