"""Names and headings as preprocessors write them (see preprocessors.py)."""

import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from plain import SECTIONS, MESH, deck, fixed, long, cards, refused, same
from scenes import check, finish

# Names of files of results and of controls that decks of other programs have.
OUTPUTS = """ABSTAT ACEOUT ALE ATDOUT AVSFLT BEARING BNDOUT CURVOUT DCFAIL DEFGEO DEFORC
    DISBOUT FORMAT GCEOUT JNTFORC MASSOUT MOVIE MPGS NODFOR PBSTAT PLLYOUT PRTUBE
    SBTOUT SECFORC SPHOUT SSSTAT SWFORC TPRINT TRHIST BINARY_D3DUMP BINARY_D3PART
    BINARY_D3THDT BINARY_D3DRLF BINARY_INTFOR BINARY_RUNRSF BINARY_D3PROP BINARY_FSIFOR
    EXTENT_BINARY EXTENT_INTFOR EXTENT_D3PART CROSS_SECTION_PLANE CROSS_SECTION_SET_ID
    NODAL_FORCE_GROUP HISTORY_BEAM HISTORY_TSHELL HISTORY_DISCRETE
    HISTORY_BEAM_SET HISTORY_SEATBELT HISTORY_NODE_LOCAL
    FREQUENCY_BINARY_D3PSD RCFORC_MOMENT SUPERPLASTIC_FORMING
    FREQUENCY_ASCII_NODOUT_SSD_MODAL_CONTRIBUTION""".split()
CONTROLS = """ACCURACY BULK_VISCOSITY CPU DEBUG ENERGY HOURGLASS IMPLICIT_SOLVER OUTPUT
    PARALLEL RIGID SOLID STRUCTURED SUBCYCLE UNITS MPP_DECOMPOSITION_METHOD
    MPP_DECOMPOSITION_NUMPROC MPP_IO_NODUMP MPP_IO_BINOUTONLY
    MPP_DECOMPOSITION_TRANSFORMATION MPP_CONTACT_GROUPABLE THERMAL_SOLVER
    MPP_DECOMPOSITION_DISTRIBUTE_ALE_ELEMENT ALE SPH EFG AIRBAG DISCRETE_ELEMENT""".split()


def names():
    """Names of files of results and of controls without effect: one note each, nothing else
    changes. The list is exact: other names are errors that name the nearest known one."""
    skipped = ["DATABASE_" + n for n in OUTPUTS] + ["CONTROL_" + n for n in CONTROLS]
    text = "\n".join(cards(n, fixed("0.01", 0, 0, 1)) for n in skipped)
    same("all at once", deck(more=text), notes=["*%s is skipped: " % n for n in skipped])
    same("all before the rest", deck(title=text + "\n" + SECTIONS["title"]), notes=None)
    for name in (
        "HOURGLASS",
        "HOURGLASS_TITLE",
        "SET_TSHELL",
        "SET_BEAM_LIST_TITLE",
        "SET_TSHELL_LIST",
        "COMMENT",
    ):
        same(
            name,
            deck(more=cards(name, "anything", fixed(1, 2, 3))),
            notes=["*%s is skipped: " % name],
        )
    same(
        "controls without effect twice",
        deck(
            more="\n".join(
                2
                * [
                    cards(n, fixed(0))
                    for n in (
                        "CONTROL_CONTACT",
                        "CONTROL_SHELL",
                        "CONTROL_SOLUTION",
                        "CONTROL_TIMESTEP",
                    )
                ]
            )
        ),
        notes=["CONTROL_"] * 4,
    )
    same(
        "twice, one note",
        deck(more=2 * (cards("DATABASE_ABSTAT", fixed(1)) + "\n")),
        notes=["*DATABASE_ABSTAT"],
    )
    same(
        "in lower case, with a remark",
        deck(more="*database_abstat $ of airbags\n" + fixed(1)),
        notes=["*DATABASE_ABSTAT"],
    )
    same(
        "mass properties",
        deck(tables=SECTIONS["tables"].replace("GLSTAT", "GLSTAT_MASS_PROPERTIES")),
        notes=[],
    )
    same(
        "text of a comment",
        deck(more=cards("COMMENT", " * first", "   *NODE", "*".rjust(9))),
        notes=["*COMMENT"],
    )
    for name, text in (
        (
            "in a skipped keyword",
            cards("DATABASE_ABSTAT", fixed(0.1), " *BOUNDARY_SPC_SET", fixed(1, None, 1)),
        ),
        ("in one that is not available", cards("DAMPING_RELATIVE", fixed(0.1), "   *NODE")),
        ("after a title in an include", "*INCLUDE\nt.k"),
    ):
        refused(
            "a keyword with blanks before it " + name,
            deck(more=text),
            "a keyword starts with * in column 1",
            files={"t.k": "*TITLE\nmesh\n *NODE\n"},
        )
    for name, nearest in (
        ("DATABASE_ABSTATS", "DATABASE_ABSTAT"),
        ("DATABASE_RBDOT", "DATABASE_RBDOUT"),
        ("DATABASE_GLSTATT", "DATABASE_GLSTAT"),
        ("DATABASE_XYZOUT", "DATABASE_"),
        ("DATABASE_BINARY_D3PLOTS", "DATABASE_BINARY_D3PLOT"),
        ("CONTROL_ACCURAC", "CONTROL_ACCURACY"),
        ("CONTROL_ENERGYS", "CONTROL_ENERGY"),
        ("CONTROL_OUTPUTS", "CONTROL_OUTPUT"),
        ("HOURGLAS", "HOURGLASS"),
        ("SET_NODES_LIST", "SET_NODE_LIST"),
        ("INITIAL_VELOCTY", "INITIAL_VELOCITY"),
        ("PARAMTER", "PARAMETER"),
        ("PARAMETER_EXPRESION", "PARAMETER_EXPRESSION"),
        ("INCLUDES", "INCLUDE"),
        ("EDN", "END"),
    ):
        refused(
            name,
            deck(more=cards(name, fixed(1))),
            "unknown keyword *" + name,
            "the nearest known one is *" + nearest,
            problems=1,
        )
    for name, words in (
        ("NODE", "| NID | 1-8 |"),
        ("set_node", "| NID8 | 71-80 |"),
        ("*SET_NODE_LIST_TITLE", "### *SET_NODE_LIST"),
        ("BOUNDARY_SPC_SET_ID", "### *BOUNDARY_SPC_SET"),
        ("PARAMETER", "*PARAMETER names and values"),
        ("END", "*END ends a file"),
        ("HOURGLASS", "*HOURGLASS is skipped with a note: elements are fully integrated"),
        ("CONTROL_CONTACT", "| SFRIC | 1-10 |"),
        (
            "ELEMENT_SHELL_THICKNESS",
            "*ELEMENT_SHELL_THICKNESS is not available in this version",
        ),
        ("SENSOR_SWITCH", "*SENSOR_* is not available in this version"),
    ):
        done = subprocess.run(
            [scenes.BIPACT, "--keywords", name], stdout=subprocess.PIPE, text=True
        )
        check(
            done.returncode == 0 and words in done.stdout,
            "--keywords %s: %s" % (name, done.stdout[:200]),
        )
    done = subprocess.run(
        [scenes.BIPACT, "--keywords", "NOED"], stderr=subprocess.PIPE, text=True
    )
    check(
        done.returncode == 2 and "the nearest known one is *NODE" in done.stderr,
        "--keywords NOED",
    )
    for name in (
        "CONTROL_TERMINATION_FOO",
        "DATABASE_GLSTAT_FOO",
        "NODE_FOO",
        "SET_NODE_LIST_FOO",
        "TITLE_TITLE",
        "NODE_TITLE",
        "INITIAL_VELOCITY_TITLE",
    ):
        refused(
            name,
            deck(more=cards(name, fixed(1))),
            "unknown keyword *" + name,
            "has no option _",
            problems=1,
        )
    for name in (
        "CONTROL_CHECK_SHELL",
        "CONTROL_ADAPTIVE",
        "CONTROL_DYNAMIC_RELAXATION",
        "CONTROL_IMPLICIT_EIGENVALUE",
        "CONTROL_IMPLICIT_STABILIZATION",
        "CONTROL_IMPLICIT_SOLUTION_DYN",
        "CONTROL_MPP_MATERIAL_MODEL_DRIVER",
        "ELEMENT_SHELL_THICKNESS",
        "ELEMENT_SHELL_BETA",
        "ELEMENT_TSHELL",
        "SECTION_TSHELL",
        "PART_CONTACT",
        "SET_NODE_ADD",
        "SET_NODE_LIST_COLLECT",
        "SET_PART_ADD",
        "SET_SEGMENT_ADD",
        "SET_NODE_LIST_GENERATE_INCREMENT",
        "RIGIDWALL_PLANAR_ORTHO",
        "RIGIDWALL_PLANAR_FINITE_MOVING_FORCES_ID",
        "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_MORTAR",
        "DEFINE_CURVE_FUNCTION",
        "DEFINE_BOX_LOCAL",
        "LOAD_BODY_RX",
        "LOAD_SEGMENT_NONUNIFORM",
        "NODE_TRANSFORM",
        "BOUNDARY_SPC_SET_BIRTH_DEATH",
        "BOUNDARY_PRESCRIBED_MOTION_SET_BOX",
        "MAT_ELASTIC_FLUID",
        "INITIAL_VELOCITY_GENERATION_START_TIME",
        "INCLUDE_TRANSFORM",
        "PARAMETER_TYPE",
        "SENSOR_CONTROL",
        "COSIM_FMI_CONTROL",
        "HOURGLASS_936",
    ):
        refused(
            name,
            deck(more=cards(name, fixed(1))),
            "*" + name + " is not available in this version",
            problems=1,
        )


def titles():
    """*TITLE of an include, *KEYWORD_ID and _JOBID, _ID and _TITLE."""
    included = "*KEYWORD\n*TITLE\nthe mesh, as a program wrote it\n%s\n*END\nafter the end\n"
    for name, mesh in (
        ("of a mesh", included % MESH),
        ("after the mesh", "*KEYWORD\n" + MESH + "\n*TITLE\nlate\n*END\n"),
        ("twice", included % ("*TITLE\nagain\n" + MESH)),
        (
            "with options of the frame",
            included.replace("*KEYWORD", "*KEYWORD memory=20m ncpu=4") % MESH,
        ),
    ):
        same(
            "*TITLE " + name,
            deck(nodes="*INCLUDE\nmesh.k", elements=""),
            files={"mesh.k": mesh},
            notes=["mesh.k: *TITLE of an included file is passed over"]
            + ["has no effect"] * 2 * ("frame" in name),
        )
    same(
        "*TITLE of an include of an include",
        deck(nodes="*INCLUDE\na.k", elements=""),
        files={"a.k": "*TITLE\na\n*INCLUDE\nmesh.k\n*END\n", "mesh.k": included % MESH},
        notes=["a.k", "mesh.k"],
    )
    same(
        "no title but that of an include",
        deck(title="", nodes="*INCLUDE\nmesh.k", elements=""),
        files={"mesh.k": included % MESH},
        notes=["mesh.k"],
    )
    refused("*TITLE twice", deck(more="*TITLE\nagain"), "*TITLE stands twice", problems=1)
    refused(
        "*TITLE without a card",
        deck(title="*TITLE"),
        "*TITLE ends too early: expected 1 card, found 0",
        problems=1,
    )
    for name, text in (
        ("*KEYWORD_ID", "*KEYWORD_ID\nstudy      1         stage_a"),
        ("*KEYWORD_JOBID", "*KEYWORD_JOBID\nrun_17"),
        ("*KEYWORD_ID without a card", "*KEYWORD_ID"),
        ("*KEYWORD_ID with blank lines", "*KEYWORD_ID\n\nstudy\n"),
        ("*keyword_id", "*keyword_id\nstudy"),
    ):
        same(
            name,
            text + deck()[len("*KEYWORD") :],
            notes=[text.split("\n")[0].upper() + " is skipped"],
        )
    same(
        "*KEYWORD_ID in an include",
        deck(nodes="*INCLUDE\nmesh.k", elements=""),
        files={"mesh.k": "*KEYWORD_ID\nx\n" + MESH + "\n*END\n"},
        notes=["*KEYWORD_ID"],
    )
    refused(
        "*KEYWORD_IDS",
        "*KEYWORD_IDS\nstudy" + deck()[len("*KEYWORD") :],
        "unknown keyword *KEYWORD_IDS",
        problems=1,
    )


# Every keyword that has the option: a change of the scene, with the head put in place of %s.
TITLED = [
    ("section", "*SECTION_SHELL_TITLE\n%s\n" + SECTIONS["section"].split("\n", 1)[1]),
    ("left material", "*MAT_ELASTIC_TITLE\n%s\n" + SECTIONS["left material"].split("\n", 1)[1]),
    ("left material", "*MAT_001_TITLE\n%s\n" + SECTIONS["left material"].split("\n", 1)[1]),
    ("held", "*SET_NODE_LIST_TITLE\n%s\n" + SECTIONS["held"].split("\n", 1)[1]),
    ("held", "*SET_NODE_TITLE\n%s\n" + SECTIONS["held"].split("\n", 1)[1]),
    ("held", "*SET_NODE_LIST_GENERATE_TITLE\n%s\n" + fixed(1) + "\n" + fixed(13, 13, 16, 16)),
    ("held", "*SET_NODE_COLUMN_TITLE\n%s\n" + fixed(1) + "\n" + fixed(13) + "\n" + fixed(16)),
    ("held", "*SET_NODE_GENERAL_TITLE\n%s\n" + fixed(1) + "\n" + fixed("NODE", 13, 16)),
    ("left set", "*SET_PART_LIST_TITLE\n%s\n" + fixed(11) + "\n" + fixed(1)),
    ("left set", "*SET_PART_TITLE\n%s\n" + fixed(11) + "\n" + fixed(1)),
    ("left set", "*SET_PART_LIST_GENERATE_TITLE\n%s\n" + fixed(11) + "\n" + fixed(1, 1)),
    ("left set", "*SET_PART_COLUMN_TITLE\n%s\n" + fixed(11) + "\n" + fixed(1)),
    ("curve", "*DEFINE_CURVE_TITLE\n%s\n" + SECTIONS["curve"].split("\n", 1)[1]),
    ("more", "*SET_SHELL_LIST_TITLE\n%s\n" + fixed(8) + "\n" + fixed(1)),
    ("more", "*SET_SHELL_LIST_GENERATE_TITLE\n%s\n" + fixed(8) + "\n" + fixed(1, 2)),
    ("more", "*SET_SHELL_COLUMN_TITLE\n%s\n" + fixed(8) + "\n" + fixed(1)),
    ("more", "*SET_SHELL_GENERAL_TITLE\n%s\n" + fixed(8) + "\n" + fixed("ALL")),
    ("more", "*SET_SEGMENT_TITLE\n%s\n" + fixed(8) + "\n" + fixed(3, 6)),
    ("more", "*SET_SEGMENT_GENERAL_TITLE\n%s\n" + fixed(8) + "\n" + fixed("ALL")),
    ("more", "*DEFINE_BOX_TITLE\n%s\n" + fixed(8, 0, 1)),
]
WALL = "\n" + fixed(None) + "\n" + fixed(-9.0, None, None, 9.0)
NUMBERED = [
    ("support", "*BOUNDARY_SPC_SET_ID\n%s\n" + fixed(1, None, 1, 1), None),
    (
        "support",
        "*BOUNDARY_SPC_NODE_ID\n%s\n" + fixed(13, 0, 1, 1) + "\n%s\n" + fixed(16, 0, 1, 1),
        None,
    ),
    (
        "more",
        "*BOUNDARY_PRESCRIBED_MOTION_SET_ID\n%s\n" + fixed(2, 1, 2, 1, 0.001),
        "*BOUNDARY_PRESCRIBED_MOTION_SET\n" + fixed(2, 1, 2, 1, 0.001),
    ),
    (
        "more",
        "*BOUNDARY_PRESCRIBED_MOTION_NODE_ID\n%s\n" + fixed(15, 1, 2, 1, 0.001),
        "*BOUNDARY_PRESCRIBED_MOTION_NODE\n" + fixed(15, 1, 2, 1, 0.001),
    ),
    ("more", "*LOAD_NODE_SET_ID\n%s\n" + fixed(2, 1, 1), "*LOAD_NODE_SET\n" + fixed(2, 1, 1)),
    (
        "more",
        "*LOAD_NODE_POINT_ID\n%s\n" + fixed(15, 1, 1),
        "*LOAD_NODE_POINT\n" + fixed(15, 1, 1),
    ),
    ("more", "*LOAD_SEGMENT_SET_ID\n%s\n" + fixed(2, 1), "*LOAD_SEGMENT_SET\n" + fixed(2, 1)),
    (
        "more",
        "*LOAD_SEGMENT_ID\n%s\n" + fixed(1, 1.0, None, 4, 5),
        "*LOAD_SEGMENT\n" + fixed(1, 1.0, None, 4, 5),
    ),
    ("more", "*RIGIDWALL_PLANAR_ID\n%s" + WALL, "*RIGIDWALL_PLANAR" + WALL),
    ("more", "*RIGIDWALL_PLANAR_TITLE\n%s" + WALL, "*RIGIDWALL_PLANAR" + WALL),
    (
        "contact",
        "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID\n%s\n" + fixed(11, 12, None, None, 0.3),
        None,
    ),
    (
        "contact",
        "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_TITLE\n%s\n" + fixed(11, 12, None, None, 0.3),
        None,
    ),
    (
        "contact",
        "*CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE_ID\n%s\n" + fixed(11, 12, None, None, 0.3),
        "*CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE\n" + fixed(11, 12, None, None, 0.3),
    ),
    (
        "contact",
        "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE_ID\n%s\n" + fixed(0, None, None, None, 0.3),
        "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE\n" + fixed(0, None, None, None, 0.3),
    ),
]
SETS_2 = (
    "*SET_NODE_LIST\n"
    + fixed(2)
    + "\n"
    + fixed(12)
    + "\n*SET_SEGMENT\n"
    + fixed(2)
    + "\n"
    + fixed(4, 5)
)


def heads():
    """_TITLE and _ID on every keyword that has them."""
    for section, text in TITLED:
        name = text.split("\n")[0]
        for title in (
            "held, side 3",
            "",
            "         7 as a number",
            "1,2,3",
            "*".rjust(2) + "NODE",
        ):
            same(
                '%s "%s"' % (name, title),
                deck(**{section.replace(" ", "_"): text % title}),
                notes=[],
            )
        refused(
            name + " without a title",
            deck(**{section.replace(" ", "_"): text.replace("%s\n", "")}),
        )
    for section, text, plain_text in NUMBERED:
        name = text.split("\n")[0]
        plain_deck = (
            deck(early=SETS_2)
            if plain_text is None
            else deck(early=SETS_2, **{section: plain_text})
        )
        for head in (
            "         1the heading, with a comma",
            "         1",
            "1",
            "          no number",
            "",
            "1,the heading",
        ):
            if name.count("SPC_NODE") and head == "":
                continue
            same(
                '%s "%s"' % (name, head),
                deck(early=SETS_2, **{section: text.replace("%s", head)}),
                plain_deck,
                notes=[],
            )
        refused(
            name + " with a word",
            deck(early=SETS_2, **{section: text.replace("%s", "        1x")}),
            "the card of _ID begins with an integer",
        )
        refused(
            name + " with a fraction",
            deck(early=SETS_2, **{section: text.replace("%s", "       1.5")}),
            "the card of _ID begins with an integer",
        )
    for name, lines in (
        ("no heading at all", [fixed(13, 0, 1, 1), fixed(16, 0, 1, 1)]),
        (
            "one heading for three nodes",
            ["         1held", fixed(13, 0, 1, 1), fixed(15, 0, 1, 1), fixed(16, 0, 1, 1)],
        ),
        (
            "the second heading is missing",
            ["         1held", fixed(13, 0, 1, 1), fixed(16, 0, 1, 1), fixed(15, 0, 1, 1)],
        ),
    ):
        refused(
            "_ID: " + name,
            deck(support=cards("BOUNDARY_SPC_NODE_ID", *lines)),
            "the heading looks like a card",
            problems=1,
        )
    same(
        "a heading of a number",
        deck(support=cards("BOUNDARY_SPC_SET_ID", fixed(1) + "  2", fixed(1, 0, 1, 1))),
        notes=[],
    )
    same(
        "a heading with numbers",
        deck(support=cards("BOUNDARY_SPC_SET_ID", fixed(1) + "  2 of 3", fixed(1, 0, 1, 1))),
        notes=[],
    )
    same(
        "two sections with titles",
        deck(
            section="*SECTION_SHELL_TITLE\nfirst\n"
            + SECTIONS["section"].split("\n", 1)[1]
            + "\nsecond\n"
            + fixed(2, 12)
            + "\n"
            + fixed(3.0)
        ),
        notes=[],
    )
    same(
        "histories with headings",
        deck(
            nodes_of_nodout="*DATABASE_HISTORY_NODE_ID\n"
            + "\n".join(
                fixed(n) + h
                for n, h in zip(
                    (1, 3, 6, 11, 13, 14, 16),
                    ("foot", "", "top, left", " 5", "a, b, c", "x" * 70, "1,2"),
                )
            ),
            elements_of_elout="*DATABASE_HISTORY_SHELL_ID\n"
            + "\n".join(fixed(n) + "element %d" % n for n in (1, 2, 3, 4)),
        ),
        notes=[],
    )
    same(
        "histories with headings, comma form",
        deck(
            nodes_of_nodout="*DATABASE_HISTORY_NODE_ID\n"
            + "\n".join(
                "%d,%s" % (n, h)
                for n, h in zip(
                    (1, 3, 6, 11, 13, 14, 16),
                    ("foot", "", "top, left", " 5", "a, b, c", "x" * 70, "1,2"),
                )
            )
        ),
        notes=[],
    )
    same(
        "histories with headings, long form",
        deck(
            nodes_of_nodout="*DATABASE_HISTORY_NODE_ID+\n"
            + "\n".join(
                long(n) + h
                for n, h in zip(
                    (1, 3, 6, 11, 13, 14, 16),
                    (
                        "foot",
                        "",
                        "top, left",
                        " 5",
                        "a, b, c",
                        "a heading of more than twenty columns",
                        "1,2",
                    ),
                )
            )
        ),
        notes=[],
    )
    same(
        "an id in long form",
        deck(
            contact="*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID+\n"
            + long(7)
            + "long heading\n"
            + long(11, 12, None, None, 0.3)
            + "\n*BIPACT_PAIR\n"
            + fixed(7, "B")
        ),
        deck(
            contact="*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID\n"
            + fixed(7)
            + "\n"
            + fixed(11, 12, None, None, 0.3)
            + "\n*BIPACT_PAIR\n"
            + fixed(7, "B")
        ),
        notes=[],
    )


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
