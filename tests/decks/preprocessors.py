"""What preprocessors write, against the same scene written plainly: the tables must agree in
every digit, for the deck and for its echo deck. Beside each kind stand decks that only look like
it: they must be refused, with the right words."""

import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from format_defaults import BESIDE_THE_SCENE, BEYOND, OF_THE_SCENE, cards, long
from plain import SECTIONS, deck, fixed, node, refused, remove_files, same, shell
from scenes import check, finish


def touching():
    """Text in the SOLVER field that touches its neighbour, numbers that touch at a border."""
    mech = "       0.0       0.0       0.0       0.0MECH"
    right = "       0.0       0.0       0.0       0.0      MECH         1"
    for name, head in (
        ("left-aligned", fixed(1) + mech),
        ("with ITS 1", fixed(1) + mech + "               1"),
        ("with ITS 0", fixed(1) + mech + "               0"),
        ("lower case", fixed(1) + mech.lower()),
        ("right-aligned", fixed(1) + right),
        ("ITS left-aligned", fixed(1) + mech + "      1"),
    ):
        same("SOLVER " + name, deck(held="*SET_NODE_LIST\n" + head + "\n" + fixed(13, 16)))
    same(
        "SOLVER in every kind of set",
        deck(
            held="*SET_NODE_LIST_GENERATE\n%s\n%s" % (fixed(1) + mech, fixed(13, 13, 16, 16)),
            left_set="*SET_PART_LIST\n%s\n%s" % (fixed(11) + mech, fixed(1)),
            right_set="*SET_PART_COLUMN\n%s\n%s" % (fixed(12) + mech, fixed(2)),
            more="*SET_SHELL_LIST\n%s\n%s\n" % (fixed(5) + mech, fixed(1))
            + "*SET_SEGMENT\n%s\n%s\n" % (fixed(5) + mech, fixed(3, 6))
            + "*SET_NODE_GENERAL\n%s\n%s" % (fixed(6) + mech, fixed("PART", 1)),
        ),
        notes=[],
    )
    for name, card in (
        ("two reals", fixed(1, 0.001) + "1000.0    " + fixed(0.3)),
        ("three reals", fixed(1, 0.001) + "1000.00000" + "0.3       "),
        ("full fields", fixed(1) + "1.0000E-03" + "1.0000E+03" + "3.00000E-1"),
        ("fields filled up with zeros", "0000000001" + "00000.0010" + "01000.0000" + ".300000000"),
    ):
        same("touching " + name, deck(left_material="*MAT_ELASTIC\n" + card))
    same(
        "a parameter after a full field",
        deck(
            early="*PARAMETER\nRvx              1.0Rmu              0.3Rro            0.001",
            velocity="*INITIAL_VELOCITY_GENERATION\n"
            + fixed(1, 2, "0.0") + "&vx            -0.25\n",
            contact="*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE\n"
            + fixed(11, 12, "1.0", "0") + "&mu       ",
            left_material="*MAT_ELASTIC\n" + fixed(1) + "&ro       " + fixed(1000.0, 0.3),
        ),
    )
    same(
        "signs part two numbers",
        deck(
            velocity=SECTIONS["velocity"].replace(fixed(1.0, -0.25), "       1.0-0.25     ")
            + "\n*INITIAL_VELOCITY_NODE\n" + fixed(11, "-0.0") + "-0.0      "
        ),
    )
    same(
        "fields of eight columns",
        deck(
            elements=SECTIONS["elements"].replace(
                shell(1, 1, 1, 2, 5, 4), "00000001000000010000000100000002       5       4"
            )
        ),
    )
    same(
        "fields of sixteen columns",
        deck(
            nodes=SECTIONS["nodes"].replace(
                node(3, 1.0, 0.0), "       3" + "1.00000000000000" + "0.00000000000000"
            )
        ),
    )
    same(
        "fields of twenty columns",
        deck(
            curve="*DEFINE_CURVE\n" + fixed(1) + "\n                 0.01.0\n"
            + "1.000000000000000000" + "3.000000000000000000"
        ),
    )
    same(
        "long form",
        deck(
            left_material="*MAT_ELASTIC+\n" + long(1, 0.001) + "1000.0".ljust(20) + long(0.3)
        ),
    )
    for name, change, words in (
        (
            "a value across a border",
            dict(left_material="*MAT_ELASTIC\n" + fixed(1) + "       0.001  1000.0       0.3"),
            ('the value "0.001" crosses the border between columns 20 and 21', "looks shifted"),
        ),
        (
            "an exponent across a border",
            dict(left_material="*MAT_ELASTIC\n" + fixed(1) + "     1.0E-3 1000.0       0.3"),
            ('the value "1.0E-3" crosses the border between columns 20 and 21',),
        ),
        (
            "an integer and the broken part of one",
            dict(left_material="*MAT_ELASTIC\n" + fixed(1) + ".001      " + fixed(1000.0, 0.3)),
            ('the value "1.001" crosses the border between columns 10 and 11',),
        ),
        (
            "an integer across a border",
            dict(elements=SECTIONS["elements"].replace(shell(3, 2, 11), shell(3, 2) + "       11")),
            ('the value "11" crosses the border between columns 24 and 25',),
        ),
        (
            "a parameter across a border",
            dict(
                early="*PARAMETER\nRvelocity        1.0",
                velocity="*INITIAL_VELOCITY_GENERATION\n" + fixed(1, 2) + "       &velocity\n",
            ),
            ('the value "&velocity" crosses the border between columns 30 and 31',),
        ),
        (
            "a parameter with a sign across a border",
            dict(
                early="*PARAMETER\nRv              -1.0",
                velocity="*INITIAL_VELOCITY_GENERATION\n" + fixed(1, 2) + "         -&v    \n",
            ),
            ('the value "-&v" crosses the border between columns 30 and 31',),
        ),
        (
            "a word across a border",
            dict(
                held="*SET_NODE_LIST\n" + fixed(1, "0.0", "0.0", "0.0", "0.0")
                + "        MECH\n" + fixed(13, 16)
            ),
            ('the value "MECH" crosses the border between columns 60 and 61',),
        ),
        (
            "another solver",
            dict(held="*SET_NODE_LIST\n" + fixed(1) + mech.replace("MECH", "CESE") + "\n" + fixed(13)),
            ('field SOLVER: expected MECH, found "CESE"',),
        ),
        (
            "ITS beyond its values",
            dict(held="*SET_NODE_LIST\n" + fixed(1) + mech + "               2\n" + fixed(13, 16)),
            ("field ITS: expected an integer >= 0 and <= 1",),
        ),
        (
            "a card one column to the right",
            dict(left_material="*MAT_ELASTIC\n " + fixed(1, 0.001, 1000.0, 0.3)),
            ("crosses the border", "a blank inside a number"),
        ),
        (
            "a card one column to the left",
            dict(left_material="*MAT_ELASTIC\n" + fixed(1, "0.001", "1000.0", "0.3")[6:]),
            ("crosses the border", "field MID"),
        ),
    ):
        refused(name, deck(**change), *words)


def defaults():
    """Further cards and fields at the defaults of the format; beside them the values that could
    change a solution, which are errors with the name of the field."""
    for name, section, text, notes in OF_THE_SCENE:
        same(name, deck(**{section.replace(" ", "_"): text}), notes=notes)
    together = {section.replace(" ", "_"): text for name, section, text, _ in OF_THE_SCENE}
    same("all of them", deck(**together), notes=None)
    for name, text, plain_text, notes in BESIDE_THE_SCENE:
        same(name, deck(more=text), deck(more=plain_text or ""), notes=notes)
    for name, section, text, words in BEYOND:
        refused(name, deck(**{section.replace(" ", "_"): text}), words)


def whole_reals():
    """Real numbers that are whole in integer fields."""
    for name, changes in (
        ("NIP", dict(section=cards("SECTION_SHELL", fixed(1, 13, "1.0", "4.0"), fixed(0.5)))),
        ("ELFORM and SECID", dict(section=cards("SECTION_SHELL", fixed("1.", "13.00"), fixed(0.5)))),
        ("numbers of a part", dict(parts=cards("PART", "left", fixed("1.0", "1.0", "1.0"), "right", fixed("2.0", "1.", "0.2E1")))),
        ("a set", dict(held=cards("SET_NODE_LIST", fixed("1.0"), fixed("13.0", "16.0", "0.0")))),
        ("directions", dict(support=cards("BOUNDARY_SPC_SET", fixed("1.0", "0.0", "1.0", "1.0")))),
        ("comma form", dict(left_material=cards("MAT_ELASTIC", "1.0,.001,1000,.3"))),
        ("IMFLAG and IMASS", dict(general=cards("CONTROL_IMPLICIT_GENERAL", fixed("1.0", 0.0001, "2.0")), dynamics=cards("CONTROL_IMPLICIT_DYNAMICS", fixed("1.0")))),
        ("an integer parameter", dict(early=cards("PARAMETER", fixed("In", "13.0")), held=cards("SET_NODE_LIST", fixed(1), fixed("&n", 16)))),
        ("a real parameter", dict(early=cards("PARAMETER", fixed("Rn", "13.0")), held=cards("SET_NODE_LIST", fixed(1), fixed("&n", 16)))),
    ):
        same("a whole real: " + name, deck(**changes), notes=[])
    for name, field, text in (
        ("a fraction", "NIP", cards("SECTION_SHELL", fixed(1, 13, None, "4.5"), fixed(0.5))),
        ("nearly whole", "NIP", cards("SECTION_SHELL", fixed(1, 13, None, "4.0000001"), fixed(0.5))),
        ("too large", "SECID", cards("SECTION_SHELL", fixed("3.0E9", 13), fixed(0.5))),
        ("an exponent alone", "SECID", cards("SECTION_SHELL", fixed("1E0", 13), fixed(0.5))),
        ("a bare exponent", "SECID", cards("SECTION_SHELL", fixed("1+0", 13), fixed(0.5))),
    ):
        refused("a real in an integer field: " + name, deck(section=text),
                "field %s: expected an integer" % field, problems=1)
    refused("a fraction by a parameter",
            deck(early=cards("PARAMETER", fixed("Rn", "13.5")), held=cards("SET_NODE_LIST", fixed(1), fixed("&n", 16))),
            "field NID1: expected an integer >= 0, found \"&n = 13.5\"", problems=1)


# Names of files of results and of controls that decks of other programs have.
OUTPUTS = """ABSTAT ACEOUT ALE ATDOUT AVSFLT BEARING BNDOUT CURVOUT DCFAIL DEFGEO DEFORC DISBOUT FORMAT
    GCEOUT JNTFORC MASSOUT MOVIE MPGS NODFOR PBSTAT PLLYOUT PRTUBE RBDOUT SBTOUT SECFORC SPHOUT SSSTAT
    SWFORC TPRINT TRHIST BINARY_D3DUMP BINARY_D3PART BINARY_D3THDT BINARY_D3DRLF BINARY_INTFOR
    BINARY_RUNRSF BINARY_D3PROP BINARY_FSIFOR EXTENT_BINARY EXTENT_INTFOR EXTENT_D3PART
    CROSS_SECTION_PLANE CROSS_SECTION_SET_ID NODAL_FORCE_GROUP HISTORY_BEAM HISTORY_SOLID
    HISTORY_TSHELL HISTORY_DISCRETE HISTORY_BEAM_SET HISTORY_SOLID_SET HISTORY_SEATBELT
    HISTORY_NODE_LOCAL FREQUENCY_BINARY_D3PSD RCFORC_MOMENT SUPERPLASTIC_FORMING
    FREQUENCY_ASCII_NODOUT_SSD_MODAL_CONTRIBUTION""".split()
CONTROLS = """ACCURACY BULK_VISCOSITY CPU DEBUG ENERGY HOURGLASS IMPLICIT_SOLVER OUTPUT PARALLEL RIGID SOLID
    STRUCTURED SUBCYCLE UNITS MPP_DECOMPOSITION_METHOD MPP_DECOMPOSITION_NUMPROC MPP_IO_NODUMP
    MPP_IO_BINOUTONLY MPP_DECOMPOSITION_TRANSFORMATION MPP_CONTACT_GROUPABLE THERMAL_SOLVER
    MPP_DECOMPOSITION_DISTRIBUTE_ALE_ELEMENT ALE SPH EFG AIRBAG DISCRETE_ELEMENT""".split()


def names():
    """Names of files of results and of controls without effect: one note each, nothing else
    changes. The list is exact: other names are errors that name the nearest known one."""
    skipped = ["DATABASE_" + n for n in OUTPUTS] + ["CONTROL_" + n for n in CONTROLS]
    text = "\n".join(cards(n, fixed("0.01", 0, 0, 1)) for n in skipped)
    same("all at once", deck(more=text), notes=["*%s is skipped: " % n for n in skipped])
    same("all before the rest", deck(title=text + "\n" + SECTIONS["title"]), notes=None)
    for name in ("HOURGLASS", "HOURGLASS_TITLE", "SET_SOLID", "SET_BEAM_LIST_TITLE", "SET_TSHELL_LIST", "COMMENT"):
        same(name, deck(more=cards(name, "anything", fixed(1, 2, 3))), notes=["*%s is skipped: " % name])
    same("controls without effect twice", deck(more="\n".join(2 * [cards(n, fixed(0)) for n in ("CONTROL_CONTACT", "CONTROL_SHELL", "CONTROL_SOLUTION", "CONTROL_TIMESTEP")])), notes=["CONTROL_"] * 4)
    same("twice, one note", deck(more=2 * (cards("DATABASE_ABSTAT", fixed(1)) + "\n")), notes=["*DATABASE_ABSTAT"])
    same("in lower case, with a remark", deck(more="*database_abstat $ of airbags\n" + fixed(1)), notes=["*DATABASE_ABSTAT"])
    same("mass properties", deck(tables=SECTIONS["tables"].replace("GLSTAT", "GLSTAT_MASS_PROPERTIES")), notes=[])
    same("text of a comment", deck(more=cards("COMMENT", " * first", "   *NODE", "*".rjust(9))), notes=["*COMMENT"])
    for name, text in (
        ("in a skipped keyword", cards("DATABASE_ABSTAT", fixed(0.1), " *BOUNDARY_SPC_SET", fixed(1, None, 1))),
        ("in one that is not available", cards("DAMPING_GLOBAL", fixed(0.1), "   *NODE")),
        ("after a title in an include", "*INCLUDE\nt.k"),
    ):
        refused("a keyword with blanks before it " + name, deck(more=text), "a keyword starts with * in column 1", files={"t.k": "*TITLE\nmesh\n *NODE\n"})
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
        refused(name, deck(more=cards(name, fixed(1))), "unknown keyword *" + name,
                "the nearest known one is *" + nearest, problems=1)
    for name, words in (
        ("NODE", "| NID | 1-8 |"), ("set_node", "| NID8 | 71-80 |"), ("*SET_NODE_LIST_TITLE", "### *SET_NODE_LIST"), ("BOUNDARY_SPC_SET_ID", "### *BOUNDARY_SPC_SET"),
        ("PARAMETER", "*PARAMETER names and values"), ("END", "*END ends a file"), ("HOURGLASS", "*HOURGLASS is skipped with a note: elements are fully integrated"),
        ("CONTROL_CONTACT", "| SFRIC | 1-10 |"), ("ELEMENT_SHELL_THICKNESS", "*ELEMENT_SHELL_THICKNESS is not available in this version"), ("SENSOR_SWITCH", "*SENSOR_* is not available in this version"),
    ):
        done = subprocess.run([scenes.BIPACT, "--keywords", name], stdout=subprocess.PIPE, text=True)
        check(done.returncode == 0 and words in done.stdout, "--keywords %s: %s" % (name, done.stdout[:200]))
    done = subprocess.run([scenes.BIPACT, "--keywords", "NOED"], stderr=subprocess.PIPE, text=True)
    check(done.returncode == 2 and "the nearest known one is *NODE" in done.stderr, "--keywords NOED")
    for name in (
        "CONTROL_TERMINATION_FOO", "DATABASE_GLSTAT_FOO", "NODE_FOO", "SET_NODE_LIST_FOO", "TITLE_TITLE",
        "NODE_TITLE", "INITIAL_VELOCITY_TITLE",
    ):
        refused(name, deck(more=cards(name, fixed(1))), "unknown keyword *" + name, "has no option _", problems=1)
    for name in (
        "CONTROL_CHECK_SHELL", "CONTROL_ADAPTIVE", "CONTROL_DYNAMIC_RELAXATION", "CONTROL_IMPLICIT_EIGENVALUE",
        "CONTROL_IMPLICIT_STABILIZATION", "CONTROL_IMPLICIT_SOLUTION_DYN", "CONTROL_MPP_MATERIAL_MODEL_DRIVER",
        "ELEMENT_SHELL_THICKNESS", "ELEMENT_SHELL_BETA", "ELEMENT_TSHELL", "SECTION_TSHELL", "PART_INERTIA", "PART_CONTACT",
        "SET_NODE_ADD", "SET_NODE_LIST_COLLECT", "SET_PART_ADD", "SET_SEGMENT_ADD", "SET_NODE_LIST_GENERATE_INCREMENT",
        "RIGIDWALL_PLANAR_MOVING", "RIGIDWALL_PLANAR_FINITE_MOVING_FORCES_ID", "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_MORTAR",
        "DEFINE_CURVE_FUNCTION", "DEFINE_BOX_LOCAL", "LOAD_BODY_RX", "LOAD_SEGMENT_NONUNIFORM", "NODE_TRANSFORM",
        "BOUNDARY_SPC_SET_BIRTH_DEATH", "BOUNDARY_PRESCRIBED_MOTION_SET_BOX", "MAT_ELASTIC_FLUID", "MAT_RIGID_TITLE",
        "INITIAL_VELOCITY_GENERATION_START_TIME", "INCLUDE_TRANSFORM", "PARAMETER_TYPE", "SENSOR_CONTROL", "COSIM_FMI_CONTROL",
        "HOURGLASS_936",
    ):
        refused(name, deck(more=cards(name, fixed(1))), "*" + name + " is not available in this version", problems=1)


def effects():
    """HGID with *HOURGLASS, TMID, DTMIN, ENDMAS and the like: a note, no effect."""
    hourglass = cards("HOURGLASS", fixed(3, 4, 0.05))
    for name, changes, notes in (
        ("HGID", dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2)), more=hourglass), ["HOURGLASS", "*PART HGID"]),
        ("HGID twice", dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2, 0, 3)), more=hourglass), ["HOURGLASS", "*PART HGID"]),
        ("HGID of a card with a title", dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2)), more=cards("HOURGLASS_TITLE", "stiff", fixed(3, 4))), ["HOURGLASS", "*PART HGID"]),
        ("HGID without a card", dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2))), ["*PART HGID"]),
        ("TMID", dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, 0, 0, 0, 2), "right", fixed(2, 1, 2))), ["*PART TMID"]),
        ("DTMIN", dict(end=cards("CONTROL_TERMINATION", fixed(0.01, 0, 0.01))), ["DTMIN"]),
        ("ENDMAS", dict(end=cards("CONTROL_TERMINATION", fixed(0.01, 0, 0, 0, 50.0))), ["ENDMAS"]),
        ("both, packed", dict(end=cards("CONTROL_TERMINATION", "      0.01         0      0.01       0.02.000000E8         0")), ["DTMIN", "ENDMAS"]),
        ("SHRF and PROPT", dict(section=cards("SECTION_SHELL", fixed(1, 13, 0.8333, 4, 3.0), fixed(0.5))), ["SHRF", "PROPT"]),
        ("penalty contact", dict(contact=cards("CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", fixed(11, 12, 0.1, 10, 0.3), fixed(0, 0, 0.5, 0.5, 1, 1, 1), fixed(0, 20.0, 0, 0, 1), fixed(0, 0, 0.1))),
         ["SFACT", "FREQ", "SOA", "SOB", "NDA", "NDB", "COF", "VDC", "ISTIFF", "TDPEN"]),
        ("springback", dict(general=cards("CONTROL_IMPLICIT_GENERAL", fixed(1, 0.0001, 1))), ["IMFORM"]),
        ("nonlinear solves", dict(more=cards("CONTROL_IMPLICIT_SOLUTION", fixed(1, 1, 5, 0.01), fixed(4, 2))), ["ILIMIT", "MAXREF", "DCTOL", "DNORM", "DIVERG"]),
        ("options of tables", dict(tables=SECTIONS["tables"].replace(cards("DATABASE_NODOUT", fixed(0.001)), cards("DATABASE_NODOUT", fixed(0.001, 3, 0, 2, 1.0e-6, 1)))),
         ["BINARY", "IOOPT", "OPTION1", "OPTION2"]),
        ("points of a curve", dict(curve=SECTIONS["curve"].replace(fixed(1) + "\n", fixed(1, 0, 0, 0, 0, 0, 0, 500) + "\n")), ["LCINT"]),
        ("rotations of a support", dict(support=cards("BOUNDARY_SPC_SET", fixed(1, 0, 1, 1, 1, 1, 1, 1))), []),
    ):
        same(name, deck(**changes), notes=notes)
    for name, changes, words in (
        ("HGID of no number", dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, "x"), "right", fixed(2, 1, 2))), "field HGID: expected an integer"),
        ("DTMIN of no number", dict(end=cards("CONTROL_TERMINATION", fixed(0.01, 0, "1/2"))), "field DTMIN: expected a real number"),
        ("an equation of state", dict(parts=cards("PART", "left", fixed(1, 1, 1, 3), "right", fixed(2, 1, 2))), "field EOSID: expected blank or 0"),
        ("a fluid", dict(left_material=cards("MAT_ELASTIC", fixed(1, 0.001, 1000.0, 0.3, 0, 0, 2.0))), "field K: expected blank or 0"),
    ):
        refused(name, deck(**changes), words, problems=1)


MESH = SECTIONS["nodes"] + "\n" + SECTIONS["elements"]
HEAD = {name: SECTIONS[name] for name in ("end", "general", "dynamics", "time")}


def titles():
    """*TITLE of an include, *KEYWORD_ID and _JOBID, _ID and _TITLE."""
    included = "*KEYWORD\n*TITLE\nthe mesh, as a program wrote it\n%s\n*END\nafter the end\n"
    for name, mesh in (
        ("of a mesh", included % MESH),
        ("after the mesh", "*KEYWORD\n" + MESH + "\n*TITLE\nlate\n*END\n"),
        ("twice", included % ("*TITLE\nagain\n" + MESH)),
        ("with options of the frame", included.replace("*KEYWORD", "*KEYWORD memory=20m ncpu=4") % MESH),
    ):
        same("*TITLE " + name, deck(nodes="*INCLUDE\nmesh.k", elements=""), files={"mesh.k": mesh},
             notes=["mesh.k: *TITLE of an included file is passed over"] + ["has no effect"] * 2 * ("frame" in name))
    same("*TITLE of an include of an include", deck(nodes="*INCLUDE\na.k", elements=""),
         files={"a.k": "*TITLE\na\n*INCLUDE\nmesh.k\n*END\n", "mesh.k": included % MESH}, notes=["a.k", "mesh.k"])
    same("no title but that of an include", deck(title="", nodes="*INCLUDE\nmesh.k", elements=""), files={"mesh.k": included % MESH}, notes=["mesh.k"])
    refused("*TITLE twice", deck(more="*TITLE\nagain"), "*TITLE stands twice", problems=1)
    refused("*TITLE without a card", deck(title="*TITLE"), "*TITLE ends too early: expected 1 card, found 0", problems=1)
    for name, text in (
        ("*KEYWORD_ID", "*KEYWORD_ID\nstudy      1         stage_a"),
        ("*KEYWORD_JOBID", "*KEYWORD_JOBID\nrun_17"),
        ("*KEYWORD_ID without a card", "*KEYWORD_ID"),
        ("*KEYWORD_ID with blank lines", "*KEYWORD_ID\n\nstudy\n"),
        ("*keyword_id", "*keyword_id\nstudy"),
    ):
        same(name, text + deck()[len("*KEYWORD"):], notes=[text.split("\n")[0].upper() + " is skipped"])
    same("*KEYWORD_ID in an include", deck(nodes="*INCLUDE\nmesh.k", elements=""), files={"mesh.k": "*KEYWORD_ID\nx\n" + MESH + "\n*END\n"}, notes=["*KEYWORD_ID"])
    refused("*KEYWORD_IDS", "*KEYWORD_IDS\nstudy" + deck()[len("*KEYWORD"):], "unknown keyword *KEYWORD_IDS", problems=1)


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
    ("support", "*BOUNDARY_SPC_NODE_ID\n%s\n" + fixed(13, 0, 1, 1) + "\n%s\n" + fixed(16, 0, 1, 1), None),
    ("more", "*BOUNDARY_PRESCRIBED_MOTION_SET_ID\n%s\n" + fixed(2, 1, 2, 1, 0.001), "*BOUNDARY_PRESCRIBED_MOTION_SET\n" + fixed(2, 1, 2, 1, 0.001)),
    ("more", "*BOUNDARY_PRESCRIBED_MOTION_NODE_ID\n%s\n" + fixed(15, 1, 2, 1, 0.001), "*BOUNDARY_PRESCRIBED_MOTION_NODE\n" + fixed(15, 1, 2, 1, 0.001)),
    ("more", "*LOAD_NODE_SET_ID\n%s\n" + fixed(2, 1, 1), "*LOAD_NODE_SET\n" + fixed(2, 1, 1)),
    ("more", "*LOAD_NODE_POINT_ID\n%s\n" + fixed(15, 1, 1), "*LOAD_NODE_POINT\n" + fixed(15, 1, 1)),
    ("more", "*LOAD_SEGMENT_SET_ID\n%s\n" + fixed(2, 1), "*LOAD_SEGMENT_SET\n" + fixed(2, 1)),
    ("more", "*LOAD_SEGMENT_ID\n%s\n" + fixed(1, 1.0, None, 4, 5), "*LOAD_SEGMENT\n" + fixed(1, 1.0, None, 4, 5)),
    ("more", "*RIGIDWALL_PLANAR_ID\n%s" + WALL, "*RIGIDWALL_PLANAR" + WALL),
    ("more", "*RIGIDWALL_PLANAR_TITLE\n%s" + WALL, "*RIGIDWALL_PLANAR" + WALL),
    ("contact", "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID\n%s\n" + fixed(11, 12, None, None, 0.3), None),
    ("contact", "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_TITLE\n%s\n" + fixed(11, 12, None, None, 0.3), None),
    ("contact", "*CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE_ID\n%s\n" + fixed(11, 12, None, None, 0.3), "*CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE\n" + fixed(11, 12, None, None, 0.3)),
    ("contact", "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE_ID\n%s\n" + fixed(0, None, None, None, 0.3), "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE\n" + fixed(0, None, None, None, 0.3)),
]
SETS_2 = "*SET_NODE_LIST\n" + fixed(2) + "\n" + fixed(12) + "\n*SET_SEGMENT\n" + fixed(2) + "\n" + fixed(4, 5)


def heads():
    """_TITLE and _ID on every keyword that has them."""
    for section, text in TITLED:
        name = text.split("\n")[0]
        for title in ("held, side 3", "", "         7 as a number", "1,2,3", "*".rjust(2) + "NODE"):
            same('%s "%s"' % (name, title), deck(**{section.replace(" ", "_"): text % title}), notes=[])
        refused(name + " without a title", deck(**{section.replace(" ", "_"): text.replace("%s\n", "")}))
    for section, text, plain_text in NUMBERED:
        name = text.split("\n")[0]
        plain_deck = deck(early=SETS_2) if plain_text is None else deck(early=SETS_2, **{section: plain_text})
        for head in ("         1the heading, with a comma", "         1", "1", "          no number", "", "1,the heading"):
            if name.count("SPC_NODE") and head == "":
                continue
            same('%s "%s"' % (name, head), deck(early=SETS_2, **{section: text.replace("%s", head)}), plain_deck, notes=[])
        refused(name + " with a word", deck(early=SETS_2, **{section: text.replace("%s", "        1x")}), "the card of _ID begins with an integer")
        refused(name + " with a fraction", deck(early=SETS_2, **{section: text.replace("%s", "       1.5")}), "the card of _ID begins with an integer")
    for name, lines in (
        ("no heading at all", [fixed(13, 0, 1, 1), fixed(16, 0, 1, 1)]),
        ("one heading for three nodes", ["         1held", fixed(13, 0, 1, 1), fixed(15, 0, 1, 1), fixed(16, 0, 1, 1)]),
        ("the second heading is missing", ["         1held", fixed(13, 0, 1, 1), fixed(16, 0, 1, 1), fixed(15, 0, 1, 1)]),
    ):
        refused("_ID: " + name, deck(support=cards("BOUNDARY_SPC_NODE_ID", *lines)), "the heading looks like a card", problems=1)
    same("a heading of a number", deck(support=cards("BOUNDARY_SPC_SET_ID", fixed(1) + "  2", fixed(1, 0, 1, 1))), notes=[])
    same("a heading with numbers", deck(support=cards("BOUNDARY_SPC_SET_ID", fixed(1) + "  2 of 3", fixed(1, 0, 1, 1))), notes=[])
    same("two sections with titles", deck(section="*SECTION_SHELL_TITLE\nfirst\n" + SECTIONS["section"].split("\n", 1)[1] + "\nsecond\n" + fixed(2, 12) + "\n" + fixed(3.0)), notes=[])
    same("histories with headings",
         deck(nodes_of_nodout="*DATABASE_HISTORY_NODE_ID\n" + "\n".join(fixed(n) + h for n, h in zip((1, 3, 6, 11, 13, 14, 16), ("foot", "", "top, left", " 5", "a, b, c", "x" * 70, "1,2"))),
              elements_of_elout="*DATABASE_HISTORY_SHELL_ID\n" + "\n".join(fixed(n) + "element %d" % n for n in (1, 2, 3, 4))), notes=[])
    same("histories with headings, comma form",
         deck(nodes_of_nodout="*DATABASE_HISTORY_NODE_ID\n" + "\n".join("%d,%s" % (n, h) for n, h in zip((1, 3, 6, 11, 13, 14, 16), ("foot", "", "top, left", " 5", "a, b, c", "x" * 70, "1,2")))), notes=[])
    same("histories with headings, long form",
         deck(nodes_of_nodout="*DATABASE_HISTORY_NODE_ID+\n" + "\n".join(long(n) + h for n, h in zip((1, 3, 6, 11, 13, 14, 16), ("foot", "", "top, left", " 5", "a, b, c", "a heading of more than twenty columns", "1,2")))), notes=[])
    same("an id in long form", deck(contact="*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID+\n" + long(7) + "long heading\n" + long(11, 12, None, None, 0.3) + "\n*BIPACT_PAIR\n" + fixed(7, "B")),
         deck(contact="*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_ID\n" + fixed(7) + "\n" + fixed(11, 12, None, None, 0.3) + "\n*BIPACT_PAIR\n" + fixed(7, "B")), notes=[])


def includes():
    """Names of files: beside the including one, in the folders of *INCLUDE_PATH and _RELATIVE."""
    mesh = {"far/mesh.k": MESH + "\n*END\n"}
    here = dict(nodes="*INCLUDE\nmesh.k", elements="")
    absolute = os.path.join(scenes.TMP, "far")
    for name, early, files in (
        ("*INCLUDE_PATH, absolute", "*INCLUDE_PATH\n" + absolute, mesh),
        ("with a slash at its end", "*INCLUDE_PATH\n" + absolute + "/", mesh),
        ("with blanks around", "*INCLUDE_PATH\n   " + absolute + "   ", mesh),
        ("the second of two folders", "*INCLUDE_PATH\nnowhere\n" + absolute, mesh),
        ("two keywords", "*INCLUDE_PATH\nnowhere\n*INCLUDE_PATH\n" + absolute, mesh),
        ("a blank line among the folders", "*INCLUDE_PATH\n\n" + absolute + "\n", mesh),
        ("a name over two lines", "*INCLUDE_PATH\n" + absolute[:-2] + " +\n" + absolute[-2:], mesh),
        ("*INCLUDE_PATH_RELATIVE", "*INCLUDE_PATH_RELATIVE\nfar", mesh),
        ("below", "*INCLUDE_PATH_RELATIVE\nvery/far/off", {"very/far/off/mesh.k": MESH}),
        ("above", "*INCLUDE_PATH_RELATIVE\nvery/../far", dict(mesh, **{"very/x": ""})),
        ("in lower case", "*include_path_relative\n./far/", mesh),
        ("a folder that an include names", "*INCLUDE\nfar/path.k", dict(mesh, **{"far/path.k": "*INCLUDE_PATH_RELATIVE\n.\n*END\n"})),
        ("a folder above that an include names", "*INCLUDE\nfar/path.k", {"far/path.k": "*INCLUDE_PATH_RELATIVE\n../other\n*END\n", "other/mesh.k": MESH}),
    ):
        same(name, deck(early=early, **here), files=files, notes=None)
        remove_files(files)
    same("the first folder wins", deck(early="*INCLUDE_PATH_RELATIVE\nfirst\nsecond", **here), files={"first/mesh.k": MESH, "second/mesh.k": "*NONSENSE"})
    same("the file's own folder wins", deck(early="*INCLUDE_PATH_RELATIVE\nfirst", **here), files={"mesh.k": MESH, "first/mesh.k": "*NONSENSE"})
    remove_files({"mesh.k": ""})
    same("an include of an include", deck(early="*INCLUDE_PATH_RELATIVE\nsecond", nodes="*INCLUDE\nfirst/a.k", elements=""),
         files={"first/a.k": "*INCLUDE\nb.k\n*INCLUDE\nc.k\n", "first/b.k": SECTIONS["nodes"], "second/c.k": SECTIONS["elements"]}, notes=[])
    for name, text in (
        ("two names", "*INCLUDE\nnodes.k\nelements.k"),
        ("a blank line after the name", "*INCLUDE\nnodes.k\n\n*INCLUDE\nelements.k\n"),
        ("a blank line before the name", "*INCLUDE\n\nnodes.k\n   \nelements.k"),
        ("a comment before the name", "*INCLUDE\n$ nodes\nnodes.k\n*INCLUDE\n$#  filename\nelements.k"),
        ("blanks before the name", "*INCLUDE\n   nodes.k   \n  ./elements.k"),
        ("carriage returns", "*INCLUDE\r\nnodes.k\r\nelements.k\r"),
    ):
        same(name, deck(nodes=text, elements=""), files={"nodes.k": SECTIONS["nodes"], "elements.k": SECTIONS["elements"]})
    remove_files({"mesh.k": "", "far/mesh.k": ""})
    for name, early, files, words in (
        ("no such file", "", {}, ['cannot read "', "refused", 'mesh.k"', "or to a folder of *INCLUDE_PATH"]),
        ("in no folder", "*INCLUDE_PATH_RELATIVE\nnowhere", {}, ["*INCLUDE: cannot read", "mesh.k"]),
        ("a folder that is named too late", "", {"far/mesh.k": MESH}, ["*INCLUDE: cannot read"]),
        ("a circle by a folder", "*INCLUDE_PATH_RELATIVE\nround", {"round/mesh.k": "*INCLUDE\nmesh.k"}, ["the file includes itself"]),
        ("a circle of two", "*INCLUDE_PATH_RELATIVE\nround", {"round/mesh.k": "*INCLUDE\nback.k", "round/back.k": "*INCLUDE\nmesh.k\n"}, ["the file includes itself"]),
        ("a circle by another name", "*INCLUDE_PATH_RELATIVE\nround", {"round/mesh.k": "*INCLUDE\n../round/./mesh.k\n"}, ["*INCLUDE: "]),
        ("a fault in a file of a folder", "*INCLUDE_PATH_RELATIVE\nround", {"round/mesh.k": MESH.replace("       1             0.0", "       1             o.0")}, ["round/mesh.k:2, columns 9-24", "included from"]),
    ):
        late = "*INCLUDE_PATH_RELATIVE\nfar" if "late" in name else ""
        refused(name, deck(early=early, more=late, **here), *words, files=files)
        remove_files(files)
    refused("no name", deck(more="*INCLUDE"), "*INCLUDE: the name of a file is missing", problems=1)
    refused("no name but blanks", deck(more="*INCLUDE\n\n   \n"), "*INCLUDE: the name of a file is missing", problems=1)
    refused("a folder as a file", deck(more="*INCLUDE\nround"), "*INCLUDE: ", files={"round/x": ""})


def sets():
    """Sets by clauses, columns, boxes against the list of their members."""
    everything = "*SET_NODE_LIST\n" + fixed(5) + "\n" + fixed(1, 2, 3, 4, 5, 6) + "\n"
    boxes = cards("DEFINE_BOX", fixed(1, -1.0, 0.25, -1.0, 2.0)) + "\n" + cards("DEFINE_BOX_TITLE", "the far side", fixed(2, 1.9, 2.1, -1.0, 2.0, -1.0, 1.0)) + "\n"
    boxes += cards("DEFINE_BOX", fixed(3, 0.0, 3.0, 0.5, 1.5)) + "\n"
    for name, head, members in (
        ("a column", "COLUMN", [fixed(13), fixed(16)]),
        ("a column with attributes of zero", "COLUMN", [fixed(13, 0.0, 0.0, 0.0, 0.0), fixed(16, "0.0")]),
        ("a column in comma form", "COLUMN", ["13,", "16,0,0"]),
        ("a column with blank lines", "COLUMN", ["", fixed(13), "", fixed(16), ""]),
        ("clauses of numbers", "GENERAL", [fixed("NODE", 13, 16)]),
        ("clauses of numbers, one a card", "GENERAL", ["node".ljust(10) + fixed(13), fixed("NODE", None, None, None, None, None, None, 16)]),
        ("all but some", "GENERAL", [fixed("ALL"), fixed("DNODE", 1, 2, 3, 4, 5, 6, 11), fixed("DNODE", 12, 14, 15)]),
        ("a part but some", "GENERAL", [fixed("PART", 2), fixed("DNODE", 11, 12, 14, 15)]),
        ("all but a part and some", "GENERAL", [fixed("ALL"), fixed("DPART", 1), fixed("DNODE", 11, 12, 14, 15)]),
        ("a box", "GENERAL", [fixed("BOX", 2)]),
        ("two boxes but a part", "GENERAL", [fixed("BOX", 1, 2), fixed("DPART", 1)]),
        ("all but a box, and more", "GENERAL", [fixed("PART", 2), fixed("DBOX", 3), fixed("DNODE", 11, 12), fixed("NODE", 16)]),
        ("the order counts", "GENERAL", [fixed("DNODE", 13), fixed("NODE", 13, 16, 12), fixed("DNODE", 12)]),
        ("comma form", "GENERAL", ["NODE,13,16"]),
        ("zeros are padding", "GENERAL", [fixed("NODE", 13, 0, 0, 16, 0, 0, 0)]),
        ("blank lines among clauses", "GENERAL", ["", fixed("NODE", 13), "", "", fixed("NODE", 16), ""]),
        ("whole reals", "GENERAL", [fixed("NODE", "13.0", "16.0")]),
        ("ranges", "LIST_GENERATE", [fixed(13, 13, 16, 999)]),
        ("ranges with padding", "LIST_GENERATE", [fixed(0, 0, 13, 13, 0, 0, 16, 16)]),
    ):
        same("nodes by " + name, deck(held=cards("SET_NODE_" + head, fixed(1), *members), more=boxes), notes=None)
    for name, head, members in (
        ("a column", "COLUMN", [fixed(2)]),
        ("ranges", "LIST_GENERATE", [fixed(2, 2)]),
        ("a column in comma form", "COLUMN", ["2,"]),
        ("a range with holes", "LIST_GENERATE", [fixed(2, 900)]),
    ):
        same("parts by " + name, deck(right_set=cards("SET_PART_" + head, fixed(12), *members)), notes=[])
    wanted = "*DATABASE_HISTORY_SHELL_SET\n" + fixed(6)
    for name, head, members, plain_members in (
        ("a column", "COLUMN", [fixed(4), fixed(1)], (4, 1)),
        ("clauses of numbers", "GENERAL", [fixed("ELEM", 1, 4)], (1, 4)),
        ("all", "GENERAL", [fixed("ALL")], (1, 2, 3, 4)),
        ("a part", "GENERAL", [fixed("PART", 2)], (3, 4)),
        ("all but a part", "GENERAL", [fixed("ALL"), fixed("DPART", 2)], (1, 2)),
        ("all but one", "GENERAL", [fixed("ALL"), fixed("DELEM", 3)], (1, 2, 4)),
        ("a box", "GENERAL", [fixed("BOX", 4)], (3,)),
        ("all but a box", "GENERAL", [fixed("ALL"), fixed("DBOX", 4)], (1, 2, 4)),
    ):
        box = "\n" + cards("DEFINE_BOX", fixed(4, 1.0, 1.6, -0.1, 1.1))
        same("elements by " + name, deck(elements_of_elout=cards("SET_SHELL_" + head, fixed(6), *members) + "\n" + wanted, more=box),
             deck(elements_of_elout=cards("DATABASE_HISTORY_SHELL", fixed(*plain_members))), notes=None)
    pressure = "*LOAD_SEGMENT_SET\n" + fixed(9, 1, 2.0) + "\n"
    edges = {"left": (4, 1), "bottom 1": (1, 2), "bottom 2": (2, 3), "right": (3, 6), "top 1": (5, 4), "top 2": (6, 5)}
    other = [(11, 12), (12, 13), (13, 16), (16, 15), (15, 14), (14, 11)]
    for name, members, plain_edges in (
        ("all", [fixed("ALL")], [edges[k] for k in ("bottom 1", "left", "bottom 2", "right", "top 2", "top 1")] + other),
        ("a part", [fixed("PART", 1)], list(edges.values())),
        ("one edge", [fixed("SEG", 4, 5)], [edges["top 1"]]),
        ("two edges", [fixed("SEG", 4, 5), fixed("SEG", 6, 5)], [edges["top 1"], edges["top 2"]]),
        ("a box", [fixed("BOX", 1)], [edges["left"]]),
        ("a part but a box", [fixed("PART", 1), fixed("DBOX", 3)], [edges[k] for k in ("left", "bottom 1", "bottom 2", "right")]),
        ("a part but an edge", [fixed("PART", 1), fixed("DSEG", 1, 2)], [v for k, v in edges.items() if k != "bottom 1"]),
        ("all but a part", [fixed("ALL"), fixed("DPART", 2)], list(edges.values())),
    ):
        listed = cards("SET_SEGMENT", fixed(9), *[fixed(*e) for e in sorted(plain_edges)])
        same("edges by " + name, deck(more=boxes + pressure + cards("SET_SEGMENT_GENERAL", fixed(9), *members)), deck(more=pressure + listed))
    for name, text, words in (
        ("no such node", cards("SET_NODE_GENERAL", fixed(7), fixed("NODE", 77)), "field E1: node 77 is not defined"),
        ("no such part", cards("SET_NODE_GENERAL", fixed(7), fixed("PART", 1, 77)), "field E2: part 77 is not defined"),
        ("no such box", cards("SET_NODE_GENERAL", fixed(7), fixed("DBOX", 77)), "field E1: box 77 is not defined"),
        ("no such element", cards("SET_SHELL_GENERAL", fixed(7), fixed("ELEM", 77)), "field E1: element 77 is not defined"),
        ("a clause of other sets", cards("SET_NODE_GENERAL", fixed(7), fixed("ELEM", 1)), "field OPTION: expected one of ALL, NODE, DNODE, PART, DPART, BOX, DBOX"),
        ("no clause", cards("SET_NODE_GENERAL", fixed(7), fixed(None, 1)), "field OPTION: expected one of ALL"),
        ("a clause one column off", cards("SET_NODE_GENERAL", fixed(7), "        NODE" + fixed(13)), "crosses the border"),
        ("nothing left", cards("SET_NODE_GENERAL", fixed(7), fixed("ALL"), fixed("DPART", 1, 2)), "the node set is empty"),
        ("an edge of two bodies", cards("SET_SEGMENT_GENERAL", fixed(7), fixed("SEG", 2, 5)), "expected the two nodes of one exposed element edge"),
        ("an edge of three nodes", cards("SET_SEGMENT_GENERAL", fixed(7), fixed("SEG", 1, 2, 3)), "expected the two nodes of one exposed element edge"),
        ("a column with attributes", cards("SET_NODE_COLUMN", fixed(7), fixed(13, 0.5)), "field A1: expected blank or 0"),
        ("a box backwards", cards("DEFINE_BOX", fixed(1, 0, 1, 2, 1)), "field YMX: expected a number that is not below YMN"),
        ("a box twice", cards("DEFINE_BOX", fixed(1, 0, 1)) + "\n" + cards("DEFINE_BOX", fixed(1, 0, 1)), "box 1 is defined twice"),
        ("a set twice", cards("SET_NODE_COLUMN", fixed(1), fixed(13)), "node set 1 is defined twice"),
        ("a range backwards", cards("SET_NODE_LIST_GENERATE", fixed(7), fixed(16, 13)), "field B1END: expected a number not below 16"),
    ):
        refused("sets: " + name, deck(more=text), words)


def forms():
    """Long form, comma form and the marks + - % of keywords."""
    wide = long_nodes({}) + "\n" + "\n".join(["*ELEMENT_SHELL+"] + [long(*x.split()) for x in SECTIONS["elements"].split("\n")[1:]])
    bare = wide.replace("+", "")
    here = dict(nodes="*INCLUDE\nmesh.k", elements="")
    for name, mesh in (
        ("*NODE+", wide),
        ("*NODE +", wide.replace("+", " +")),
        ("LONG=Y of the include", "*KEYWORD LONG=Y\n" + bare),
        ("LONG=Y and memory", "*KEYWORD memory=20m LONG=Y ncpu=2\n" + bare),
        ("long=y, in lower case", "*keyword long=y\n" + bare),
        ("*NODE- in a long include", "*KEYWORD LONG=Y\n" + SECTIONS["nodes"].replace("*NODE", "*NODE-") + "\n" + bare[bare.index("*ELEM"):]),
        ("*NODE - in a long include", "*KEYWORD LONG=Y\n" + SECTIONS["nodes"].replace("*NODE", "*NODE -") + "\n" + bare[bare.index("*ELEM"):]),
    ):
        same(name + ": the file above stays as it is", deck(**here), files={"mesh.k": mesh + "\n*END\n"}, notes=None)
    same("an include of a long include", deck(**here), files={"mesh.k": "*KEYWORD LONG=Y\n*INCLUDE\nmesh2.k\n*END\n", "mesh2.k": bare}, notes=[])
    same("LONG=S of an include of a long include", deck(**here), files={"mesh.k": "*KEYWORD LONG=Y\n*INCLUDE\nmesh2.k\nmesh3.k\n*END\n", "mesh2.k": "*KEYWORD LONG=S\n" + SECTIONS["nodes"], "mesh3.k": bare[bare.index("*ELEM"):]}, notes=[])
    remove_files({"mesh.k": "", "mesh2.k": "", "mesh3.k": ""})
    commas = re.sub(r"(?m)^( +[-0-9.]+)+$", lambda m: ",".join(m.group().split()) + ",", MESH)
    same("a mesh in comma form", deck(nodes=commas, elements=""), notes=[])
    same("comma form with many blanks", deck(nodes=commas.replace(",", "  ,   "), elements=""), notes=[])
    same("comma form beyond column 80", deck(nodes=commas.replace(",", " " * 40 + ","), elements=""), notes=[])
    same("comma form in long form", deck(nodes=commas.replace("*NODE", "*NODE+"), elements=""), notes=[])
    same("a remark after a keyword", deck(nodes=SECTIONS["nodes"].replace("*NODE", "*NODE  + four more"), elements=SECTIONS["elements"].replace("SHELL", "SHELL\tplane")), notes=[])
    for name, text in (
        ("*NODE %", deck(nodes=SECTIONS["nodes"].replace("*NODE", "*NODE %"))),
        ("*NODE%", deck(nodes=SECTIONS["nodes"].replace("*NODE", "*NODE%"))),
        ("*ELEMENT_SHELL %", deck(elements=SECTIONS["elements"].replace("SHELL", "SHELL   %  "))),
        ("*KEYWORD I10=Y", deck().replace("*KEYWORD", "*KEYWORD I10=Y")),
    ):
        refused(name, text, re.sub(" *%", " %", name) + " (ids of ten columns) is not available in this version")
    refused("long cards of a standard keyword", deck(nodes=wide.replace("*NODE+", "*NODE"), elements=""), "*NODE card 1")
    refused("standard cards of a long keyword", deck(nodes=SECTIONS["nodes"].replace("*NODE", "*NODE+")), "*NODE card 1")
    refused("a comma too many", deck(load=cards("LOAD_BODY_Y", "1,5.0,,,,,,,9")), "expected at most 7 comma-separated fields, found 9")


def held_nodes(tc, *nodes, rc=None):
    """The nodes with TC (and RC) for some of them."""
    lines = []
    for line in SECTIONS["nodes"].split("\n"):
        if line[:1] == " " and int(line[:8]) in nodes:
            line = line.ljust(56) + fixed(tc, rc, width=8)
        lines.append(line)
    return "\n".join(lines)


def node_card():
    """TC of *NODE against *BOUNDARY_SPC_NODE; RC is a note."""
    for tc, x, y in ((1, 1, 0), (2, 0, 1), (3, 0, 0), (4, 1, 1), (5, 0, 1), (6, 1, 0), (7, 1, 1)):
        support = cards("BOUNDARY_SPC_NODE", fixed(13, None, x, y), fixed(16, None, x, y)) if x + y else ""
        plain_deck = deck(support=support)
        same("TC %d" % tc, deck(support="", nodes=held_nodes(tc, 13, 16)), plain_deck, notes=[] if x + y else ["SPCFORC"])
        same("TC %d and RC" % tc, deck(support="", nodes=held_nodes(tc, 13, 16, rc=7)), plain_deck, notes=["RC"] + [] * (x + y) + ["SPCFORC"] * (x + y == 0))
    same("TC 0, RC 0", deck(nodes=held_nodes(0, 1, 2, 3, rc=0)), notes=[])
    same("RC alone", deck(nodes=held_nodes(None, 1, 2, 13, rc=4)), notes=["*NODE RC has no effect"])
    same("TC beside a support", deck(nodes=held_nodes(7, 13, 16)), notes=[])
    same("TC completes a support", deck(nodes=held_nodes(2, 13, 16), support=cards("BOUNDARY_SPC_SET", fixed(1, None, 1, 0))), notes=[])
    same("TC as a whole real", deck(support="", nodes=held_nodes("7.0", 13, 16)), notes=[])
    same("TC in comma form", deck(support="", nodes=SECTIONS["nodes"].replace(node(13, 2.005, 0.0), "13,2.005,0.,0.,7,7").replace(node(16, 2.005, 1.0), "16,2.005,1.,,7")), notes=["RC"])
    same("TC by a parameter", deck(early="*PARAMETER\nIfix              7", support="", nodes=held_nodes("&fix", 13, 16)), notes=[])
    same("TC in long form", deck(support="", nodes=long_nodes({13: 7, 16: 7})), notes=[])
    motion = "BOUNDARY_PRESCRIBED_MOTION_NODE"
    same("TC across a motion", deck(nodes=held_nodes(1, 15), more=cards(motion, fixed(15, 2, 2, 1, 1.0e-3))),
         deck(support=SECTIONS["support"] + "\n*BOUNDARY_SPC_NODE\n" + fixed(15, None, 1), more=cards(motion, fixed(15, 2, 2, 1, 1.0e-3))), notes=[])
    same("TC and a velocity", deck(nodes=held_nodes(1, 1, 4)),
         deck(support=SECTIONS["support"] + "\n*BOUNDARY_SPC_NODE\n" + fixed(1, None, 1) + "\n" + fixed(4, None, 1)), notes=["fixed directions of 2 nodes"])
    refused("TC on a motion", deck(nodes=held_nodes(2, 15), more=cards(motion, fixed(15, 2, 2, 1))), "field DOF: direction Y of node 15 is fixed", problems=1)
    refused("TC 7 on a motion", deck(nodes=held_nodes(7, 15), more=cards(motion, fixed(15, 1, 0, 1))), "field DOF: direction X of node 15 is fixed", problems=1)
    refused("TC 8", deck(nodes=held_nodes(8, 13)), "field TC: expected an integer >= 0 and <= 7", problems=1)
    refused("TC -1", deck(nodes=held_nodes(-1, 13)), "field TC: expected an integer >= 0 and <= 7", problems=1)
    refused("TC 1.5", deck(nodes=held_nodes(1.5, 13)), "field TC: expected an integer >= 0 and <= 7", problems=1)
    refused("RC 9", deck(nodes=held_nodes(7, 13, rc=9)), "field RC: expected an integer >= 0 and <= 7", problems=1)
    refused("TC one column off", deck(nodes=SECTIONS["nodes"].replace(node(13, 2.005, 0.0), node(13, 2.005, 0.0).ljust(56) + "       12       ")), "crosses the border", problems=None)


def long_nodes(held):
    """The nodes in long form."""
    lines = []
    for line in SECTIONS["nodes"].split("\n")[1:]:
        number, x, y = line.split()
        lines.append(long(number, x, y, 0.0, held.get(int(number))))
    return "\n".join(["*NODE+"] + lines)


def blank_lines():
    """Blank lines between cards: passed over, one note for a file. A blank line is a card where
    one may come that is blank."""
    note = ["blank lines between cards are passed over"]
    text = deck()
    for name in ("nodes", "elements", "parts", "left material", "held", "left set", "support", "curve", "load", "contact", "tables", "nodes of nodout", "elements of elout", "title", "end", "general", "dynamics", "time"):
        after = SECTIONS[name] + "\n"
        same("after " + name, deck(**{name.replace(" ", "_"): after}), notes=note)
        same("several after " + name, deck(**{name.replace(" ", "_"): after + "\n   \n" + " " * 90}), notes=note)
    for name in ("nodes", "elements", "held", "left set", "support", "nodes of nodout"):
        lines = SECTIONS[name].split("\n")
        wide = "\n\n".join([lines[0] + "\n" + lines[1]] + lines[2:])
        if name in ("held", "left set"):
            wide = SECTIONS[name] + "\n\n" + fixed(0)
        if wide != SECTIONS[name]:
            same("among cards of " + name, deck(**{name.replace(" ", "_"): wide}), notes=note)
    points = SECTIONS["curve"].split("\n")
    same("among points", deck(curve="\n".join(points[:3] + ["", " "] + points[3:])), notes=note)
    for name in ("nodes", "elements", "left material", "held", "left set", "support", "curve", "load"):
        first, rest = SECTIONS[name].split("\n", 1)
        same("before the cards of " + name, deck(**{name.replace(" ", "_"): first + "\n\n" + rest}), notes=note)
    same("everywhere it is no card", re.sub(r"(?m)^(\*(?!END|INITIAL)\w+)$", r"\n\1", text), notes=note)
    same("at the beginning", "\n  \n" + text, notes=note)
    same("after the end", text + "\n\n\n", notes=[])
    same("before the end", text.replace("*END", "\n \n*END"), notes=note)
    same("no end", text.replace("*END\n", "\n\n"), notes=note + ["no *END"])
    same("carriage returns", text.replace("*NODE\n", "*NODE\n\n").replace("\n", "\r\n"), notes=note)
    same("after *KEYWORD", text.replace("*KEYWORD\n", "*KEYWORD\n\n    \n"), notes=note)
    same("among parameters", deck(early="*PARAMETER\n\n" + fixed("Rt", "0.5") + "\n\n", section=SECTIONS["section"].replace("0.5", " &t")), notes=None)
    same("among expressions", deck(early="*PARAMETER_EXPRESSION\n\nR t       1.0/\n\n          2.0\n\n", section=SECTIONS["section"].replace("0.5", " &t")), notes=None)
    same("in two files", deck(nodes="*INCLUDE\nmesh.k\n", elements=""), files={"mesh.k": MESH.replace("*ELEM", "\n*ELEM")}, notes=["changed.k: blank", "mesh.k: blank"])
    same("in a skipped keyword", deck(more=cards("DATABASE_ABSTAT", "", fixed(1), "")), notes=["*DATABASE_ABSTAT"])
    same("a blank card is a card", deck(velocity=cards("INITIAL_VELOCITY_GENERATION", fixed(1, 2, None, 1.0, -0.25), "        "), more=cards("CONTROL_CONTACT", "", "", fixed(0, 0), "")), notes=note + ["CONTROL_CONTACT"])
    same("a blank heading", deck(parts="*PART\n\n" + fixed(1, 1, 1) + "\n\n" + fixed(2, 1, 2)), notes=[])
    same("a blank heading and a blank line", deck(parts="*PART\n\n" + fixed(1, 1, 1) + "\n\n" + fixed(2, 1, 2) + "\n\n"), notes=note)
    same("after heads", deck(support="*BOUNDARY_SPC_NODE_ID\n         1left\n\n" + fixed(13, 0, 1, 1) + "\n         2\n" + fixed(16, 0, 1, 1) + "\n\n"), notes=note)
    same("sections", deck(section="*SECTION_SHELL\n\n" + fixed(1, 13, None, 4) + "\n" + fixed(0.5) + "\n\n" + fixed(2, 12) + "\n\n"), notes=note)
    for name, changes, words in (
        ("a card that is missing", dict(section="*SECTION_SHELL\n" + fixed(1, 13) + "\n\n" + fixed(0.5)), "*SECTION_SHELL"),
        ("a keyword without its card", dict(left_material="*MAT_ELASTIC\n\n\n"), "*MAT_ELASTIC ends too early: expected 1 card, found 0"),
        ("a point that is blank", dict(curve="\n".join(points[:2] + [""] + points[3:])), "expected a point, found a blank card"),
        ("a set without members", dict(held="*SET_NODE_LIST\n" + fixed(1) + "\n\n"), "field SID: the node set is empty"),
        ("a heading too many", dict(parts=SECTIONS["parts"] + "\n\nthird\n" + fixed(3, 1, 2)), "*PART card 6, field PID"),
        ("a card too many", dict(load=SECTIONS["load"] + "\n\n" + fixed(1, 5.0)), "*LOAD_BODY_Y: one card too many"),
        ("a table without an interval", dict(tables=SECTIONS["tables"].replace("*DATABASE_MATSUM\n", "*DATABASE_MATSUM\n\n")), "*DATABASE_MATSUM: one card too many"),
        ("a part without numbers", dict(parts="*PART\nleft\n\n" + fixed(1, 1, 1) + "\nright\n\n"), "*PART ends too early: expected 2 cards a set, found 1"),
    ):
        refused("blank lines: " + name, deck(**changes), words)


def parts_without():
    """*PART with SECID or MID 0: one message."""
    for name, card, words in (
        ("MID 0", fixed(1, 1, 0), "part 1 has no section or no material (SECID 1, MID 0)"),
        ("SECID 0", fixed(1, 0, 1), "part 1 has no section or no material (SECID 0, MID 1)"),
        ("both 0", fixed(1, 0, 0), "part 1 has no section or no material (SECID 0, MID 0)"),
        ("both blank", fixed(1), "part 1 has no section or no material (SECID 0, MID 0)"),
        ("0.0", fixed(1, "0.0", 1), "part 1 has no section or no material (SECID 0, MID 1)"),
        ("SECID 0 and no such material", fixed(1, 0, 9), "part 1 has no section or no material (SECID 0, MID 9)"),
        ("no such section", fixed(1, 9, 1), "section 9 is not defined"),
        ("no such material", fixed(1, 1, 9), "material 9 is not defined"),
        ("a negative number", fixed(1, -1, 1), "field SECID: expected an integer >= 0"),
    ):
        refused(name, deck(parts="*PART\nleft\n" + card + "\nright\n" + fixed(2, 1, 2)), words, problems=1)
    refused("two parts", deck(parts="*PART\nleft\n" + fixed(1) + "\nright\n" + fixed(2)), "part 1 has no section", "part 2 has no section", problems=2)
    refused("a part of rigid bodies of other programs", deck(parts=SECTIONS["parts"] + "\nground\n" + fixed(3)), "part 3 has no section or no material", problems=1)


def pair(*texts):
    """Pairs of *PARAMETER: names and values in turn."""
    return "".join(n.ljust(10) + str(v).rjust(10) for n, v in zip(texts[::2], texts[1::2]))


def expression(name, text):
    """A card of *PARAMETER_EXPRESSION."""
    return name.ljust(10) + text


def with_value(reference):
    """The scene with a thickness that is a parameter."""
    return SECTIONS["section"].replace("       0.5", reference.rjust(10))


def parameters():
    """*PARAMETER_EXPRESSION against the number that Python computes, *PARAMETER_LOCAL against
    the number written; the text of a number reads back equal."""
    for text, value in (
        ("1.0/2.0", 1.0 / 2.0), ("1.0/3.0", 1.0 / 3.0), ("sqrt(2.0)/7", 2.0 ** 0.5 / 7), ("2.0**-1", 0.5),
        ("(1+2)/(3.0*2)", 3 / 6.0), ("1.e-1+.4D0", 0.1 + 0.4), ("5/2", 2.0), ("-5/2+3", 1.0), ("pi/4", 3.141592653589793 / 4),
        ("2*-3+6.5", 0.5), ("--.5", 0.5), ("+.5", 0.5), ("2.0-+1.5", 0.5), ("1.0-3*.1", 1.0 - 3 * 0.1),
        ("2**3**2/1024.0", 0.5), ("-2**2+4.5", 0.5), ("(-2)**2/8.", 0.5), ("max(0.25, .5, 1/3)", 0.5), ("mod(7.25, 2.25)", 0.5),
        ("nint(2.5)/6.0", 0.5), ("int(-2.9)+2.5", 0.5), ("atan2(1.0,1.0)*2/pi", 0.5), ("min(3,2)/4.", 0.5), ("abs(-4)/8.0", 0.5),
        ("7-3-3.5", 0.5), ("16/4/8.0", 0.5), ("1.0e0 * ( 5.0e-1 )", 0.5), ("1e-320*0+0.5", 0.5),
    ):
        same("expression " + text, deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", text), section=with_value("&t")),
             deck(section="*SECTION_SHELL\n1,13,,4\n%r," % value), notes=None)
    base = "*PARAMETER\n" + pair("Rwidth", "0.25", "I two", "2", "Rone", "1.0")
    for name, text in (
        ("names", expression("Rt", "width*two")),
        ("names with &", expression("Rt", "&width*&two")),
        ("names in other cases", expression("rT", "WIDTH*Two")),
        ("comma form", "Rt,width*two"),
        ("comma form with blanks", "R t , width * two"),
        ("a function of two in comma form", "Rt,min(width*two,9.0)"),
        ("two cards", expression("Ra", "width") + "\n" + expression("Rt", "a*two")),
        ("over two lines", expression("Rt", "width") + "\n" + expression("", "*two")),
        ("over three lines", expression("Rt", "(width") + "\n" + expression("", "+width") + "\n" + expression("", ")")),
        ("a number broken at the end of a line", expression("Rt", "width +") + "\n" + expression("", "width")),
        ("a line that begins with a comma", expression("Rt", "max(width*two") + "\n" + expression("", ",0.0)")),
        ("over twenty lines", expression("Rt", "0.5") + ("\n" + expression("", "+0.0")) * 19),
        ("a comment in it", expression("Rt", "width") + "\n$ twice\n" + expression("", "*two")),
        ("a parameter of a function's name", expression("Rsin", "0.5") + "\n" + expression("Rt", "sin + sin(0.0)")),
        ("a parameter called pi", expression("Rpi", "0.5") + "\n" + expression("Rt", "pi")),
        ("a parameter called e", expression("Re", "0.5") + "\n" + expression("Rt", "e")),
        ("a name of nine characters", expression("Rlongname1", "0.5") + "\n" + expression("Rt", "longname1")),
        ("a name with _ and digits", expression("Ra_1", "0.5") + "\n" + expression("Rt", "a_1*1")),
        ("integer division", expression("Ihalf", "5/two") + "\n" + expression("Rt", "half*width")),
        ("a whole real for an integer", expression("Itwo_", "4.0/two") + "\n" + expression("Rt", "two_*width")),
        ("a long line", expression("Rt", "width" + "*1.0" * 60 + "*two")),
    ):
        same("expression: " + name, deck(early=base + "\n*PARAMETER_EXPRESSION\n" + text, section=with_value("&t")), notes=["remainder is dropped"] if "division" in name else None)
    same("an expression in long form", deck(early="*PARAMETER_EXPRESSION+\n" + "R t".ljust(20) + "1.0/2", section=with_value("&t")), notes=[])
    same("a sign before a name", deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", "-1.0/2"), section=with_value("-&t")), notes=[])
    same("-D instead of an expression", deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", "3.0*x"), section=with_value("&t")), options=["-D", "t=0.5"], notes=[])
    same("-D of a name in an expression", deck(early="*PARAMETER\n" + pair("Rx", "9.0") + "\n*PARAMETER_EXPRESSION\n" + expression("R t", "x/4"), section=with_value("&t")), options=["-D", "x=2.0"], notes=[])
    same("an integer parameter", deck(early="*PARAMETER_EXPRESSION\n" + expression("In", "2**4-3") + "\n" + expression("Im", "n+3"), held="*SET_NODE_LIST\n" + fixed(1) + "\n" + fixed("&n", "&m")), notes=[])
    same("a real parameter that is whole", deck(early="*PARAMETER_EXPRESSION\n" + expression("Rn", "26/2.0"), held="*SET_NODE_LIST\n" + fixed(1) + "\n" + fixed("&n", 16)), notes=[])
    for name, text, at, words in (
        ("division by zero", "1.0/(2-2)", 3, "division by zero"), ("an integer by zero", "7/0", 1, "division by zero"), ("mod by zero", "mod(5,0)", 0, "MOD with a divisor of 0"),
        ("not finite", "exp(400.)", 0, "EXP takes"), ("too large", "1e100*1e100", 5, "the result is too large"), ("zero to a negative power", "0.0**-1", 3, "0 to a power"),
        ("an integer to a negative power", "2**-1", 1, "an integer to a negative power"), ("too large an integer", "65536*65536", 5, "the integer is beyond 2147483647"),
        ("an unknown name", "1.0+sinn", 4, 'undefined parameter "SINN"'), ("an unknown function", "sinn(1.0)", 0, 'unknown function "SINN"'), ("a function without arguments", "2*sin", 2, 'undefined parameter "SIN"'),
        ("nothing in parentheses", "2*()", 3, "expected a number, a name or a parenthesis"), ("an open parenthesis", "2*(1+3", 2, "the parenthesis is not closed"),
        ("too many arguments", "sin(1.0,2.0)", 0, "SIN takes 1 argument, found 2"), ("too few", "mod(1)", 0, "MOD takes 2 arguments, found 1"),
        ("an operator too many", "2**/3", 3, "expected a number"), ("a power apart", "2* *3", 3, "expected a number"), ("a power of C", "2^3", 1, "expected an operator or the end"),
        ("two numbers", "2 3", 2, "expected an operator"), ("two points", "1.2.3", 0, "is no number"), ("an equals sign", "=2", 0, "expected a number"),
        ("text after it", "2.0 of 3", 4, "expected an operator or the end"), ("a word", "'a'", 0, "expected a number"), ("a root", "sqrt(-1.0)", 0, "SQRT takes a number >= 0"),
        ("an arc", "1+asin(1.5)", 2, "ASIN takes a number from -1 to 1"), ("a name after a number", "2dt", 1, "expected an operator"), ("an underscore", "_a", 0, 'undefined parameter "_A"'),
        ("a sign alone", "2*-", 2, "the expression ends where a value should follow"), ("nothing", "", 0, "the expression ends where a value should follow"),
        ("a percent sign", "5%2", 1, "expected an operator"), ("a bracket", "[1]", 0, "expected a number"), ("an angle of no vector", "atan2(0,0.0)", 0, "ATAN2 of 0 and 0"),
    ):
        column = 11 + at
        refused("expression: " + name, deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", text), section=with_value("0.5")),
                ":13, column %d: *PARAMETER_EXPRESSION card 1: " % column if text else "*PARAMETER_EXPRESSION card 1: ", words, problems=1)
    refused("expression: the second line", deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", "1.0+") + "\n" + expression("", " 2.0/0"), section=with_value("0.5")), ":14, column 15: ", "division by zero", problems=1)
    refused("expression: more than twenty lines", deck(early="*PARAMETER_EXPRESSION\n" + expression("Rt", "0.5") + ("\n" + expression("", "+0.0")) * 20, section=with_value("0.5")), "*PARAMETER_EXPRESSION card 1", "20 lines", problems=1)
    refused("expression: an integer that is none", deck(early="*PARAMETER_EXPRESSION\n" + expression("I n", "5/2.0"), section=with_value("0.5")), "expected an integer, the value is 2.5", problems=1)
    refused("expression: a name that comes later", deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", "2*u") + "\n" + expression("R u", "1.0"), section=with_value("0.5")), 'undefined parameter "U"', problems=1)
    refused("expression: its own name", deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", "t+1"), section=with_value("0.5")), 'undefined parameter "T"', problems=1)
    refused("expression: twice", deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", "1") + "\n" + expression("R t", "1"), section=with_value("0.5")), "parameter T is defined twice", problems=1)
    refused("expression: a tab", deck(early="*PARAMETER_EXPRESSION\n" + expression("R t", "1+\t2"), section=with_value("0.5")), "*PARAMETER_EXPRESSION", problems=1)
    refused("expression: a word in it", deck(early="*PARAMETER\n" + pair("Cw", "THETA") + "\n*PARAMETER_EXPRESSION\n" + expression("R t", "1+w"), section=with_value("0.5")), '"W" is a word, not a number', problems=1)


LOCAL = "*PARAMETER_LOCAL\n"
GLOBAL = "*PARAMETER\n"


def local_parameters():
    """*PARAMETER_LOCAL: for one file and what it includes below; before one of all files."""
    section = with_value("&t")
    for name, changes, files in (
        ("in the main deck", dict(early=LOCAL + pair("Rt", "0.5"), section=section), {}),
        ("by an expression", dict(early="*PARAMETER_EXPRESSION_LOCAL\n" + expression("Rt", "1.0/2"), section=section), {}),
        ("in an include", dict(section="*INCLUDE\ns.k"), {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section}),
        ("seen below", dict(early=LOCAL + pair("Rt", "0.5"), section="*INCLUDE\ns.k"), {"s.k": section}),
        ("before one of all files", dict(early=GLOBAL + pair("Rt", "9.0"), section="*INCLUDE\ns.k"), {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section}),
        ("before one of all files, in the same file", dict(early=GLOBAL + pair("Rt", "9.0") + "\n" + LOCAL + pair("Rt", "0.5"), section=section), {}),
        ("before one of all files that comes later", dict(early=LOCAL + pair("Rt", "0.5"), section=section, more=GLOBAL + pair("Rt", "9.0")), {}),
        ("before one of all files between it and its use", dict(early=LOCAL + pair("Rt", "0.5") + "\n" + GLOBAL + pair("Rt", "9.0"), section=section), {}),
        ("not seen in the file above", dict(early=GLOBAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k", section=section), {"p.k": LOCAL + pair("Rt", "9.0") + "\n*END\n"}),
        ("not seen in a file beside", dict(early=GLOBAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k\ns.k", section=""), {"p.k": LOCAL + pair("Rt", "9.0"), "s.k": section}),
        ("not seen above its line", dict(section="*INCLUDE\ns.k", early=GLOBAL + pair("Rt", "0.5")), {"s.k": section + "\n" + LOCAL + pair("Rt", "9.0")}),
        ("of the same name in two files", dict(section="*INCLUDE\ns.k\nq.k"), {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section, "q.k": LOCAL + pair("Rt", "2.0") + "\n*DATABASE_RWFORC\n" + fixed("&t")}),
        ("the inner of two", dict(early=LOCAL + pair("Rt", "9.0"), section="*INCLUDE\ns.k"), {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section}),
        ("the outer of two after the inner file", dict(early=LOCAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k", section=section), {"p.k": LOCAL + pair("Rt", "9.0")}),
        ("the outer of two before the inner line", dict(early=LOCAL + pair("Rt", "0.5"), section="*INCLUDE\ns.k"), {"s.k": section + "\n" + LOCAL + pair("Rt", "9.0")}),
        ("of three files", dict(early=LOCAL + pair("Rt", "9.0"), section="*INCLUDE\na.k"), {"a.k": LOCAL + pair("Rt", "0.5") + "\n*INCLUDE\nb.k", "b.k": "*INCLUDE\nc.k", "c.k": section}),
        ("in an expression", dict(early=GLOBAL + pair("Rhalf", "9.0"), section="*INCLUDE\ns.k"), {"s.k": LOCAL + pair("Rhalf", "0.25") + "\n*PARAMETER_EXPRESSION_LOCAL\n" + expression("Rt", "2*half") + "\n" + section}),
        ("from one of all files of the same name", dict(early=GLOBAL + pair("Rt", "0.25") + "\n*PARAMETER_EXPRESSION_LOCAL\n" + expression("Rt", "2*t"), section=section), {}),
        ("of all files from an include", dict(early="*INCLUDE\np.k", section=section), {"p.k": LOCAL + pair("Rh", "1.0") + "\n*PARAMETER_EXPRESSION\n" + expression("Rt", "h/2")}),
        ("a word", dict(early=LOCAL + pair("Cw", "MECH"), held="*SET_NODE_LIST\n" + fixed(1, None, None, None, None, "&w") + "\n" + fixed(13, 16)), {}),
    ):
        same("local: " + name, deck(**changes), files=files, notes=None if "two files" in name else [])
        remove_files(files)
    files = {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section}
    same("-D leaves a local parameter of an include", deck(early=GLOBAL + pair("Rt", "0.3") + "\n*DATABASE_RWFORC\n" + fixed("&t"), section="*INCLUDE\ns.k"), files=files, options=["-D", "t=9.0"], notes=None)
    refused("-D of a local parameter of an include", deck(section="*INCLUDE\ns.k"), "-D t=9.0: the deck has no such parameter", files=files, options=["-D", "t=9.0"], problems=1)
    remove_files(files)
    same("-D of a local parameter", deck(early=LOCAL + pair("Rt", "9.0"), section=section), options=["-D", "t=0.5"], notes=[])
    for name, changes, files, words in (
        ("twice", dict(early=LOCAL + pair("Rt", "0.5", "Rt", "0.5"), section=section), {}, "parameter T is defined twice; the first is at"),
        ("used above its line", dict(section=section, more=LOCAL + pair("Rt", "0.5")), {}, 'undefined parameter "&t"'),
        ("used in the file above", dict(early="*INCLUDE\np.k", section=section), {"p.k": LOCAL + pair("Rt", "0.5")}, 'undefined parameter "&t"'),
        ("used in a file beside", dict(early="*INCLUDE\np.k\ns.k", section=""), {"p.k": LOCAL + pair("Rt", "0.5"), "s.k": section}, 'undefined parameter "&t"'),
        ("one of all files twice", dict(early=GLOBAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k", section=section), {"p.k": GLOBAL + pair("Rt", "0.5")}, "parameter T is defined twice"),
    ):
        refused("local: " + name, deck(**changes), words, files=files, problems=1)
        remove_files(files)


def curve_deck(*lines, load=5.0):
    """The scene with another curve."""
    return deck(curve=cards("DEFINE_CURVE", *lines), load=cards("LOAD_BODY_Y", fixed(1, load)))


def points(*pairs):
    return [long(repr(float(a)), repr(float(o))) for a, o in pairs]


def curves():
    """Scales, offsets and SIDR of *DEFINE_CURVE against the curve with its points written out.
    Where the abscissae are shifted to later times the curve is 0 up to .999 of the shift (S.
    Bala, "Curve offset in LS-DYNA", d3view.com, 2008)."""
    wanted = ((0.0, 1.0), (0.004, 3.0), (0.009, -2.0))
    written = points(*wanted)
    plain_deck = curve_deck(fixed(1), *written)
    half = points(*[(a / 2, o) for a, o in wanted])
    for name, head, lines in (
        ("SIDR 0", fixed(1, 0), written),
        ("SIDR 2", fixed(1, 2), written),
        ("scale of the abscissa", fixed(1, 0, 2.0), half),
        ("scale of the ordinate", fixed(1, 0, None, 4.0), points(*[(a, o / 4) for a, o in wanted])),
        ("negative scale of the ordinate", fixed(1, 0, 0, -0.5), points(*[(a, -2 * o) for a, o in wanted])),
        ("both scales", fixed(1, 0, 2.0, 0.5), points(*[(a / 2, 2 * o) for a, o in wanted])),
        ("offset of the ordinate", fixed(1, 0, None, None, None, 2.0), points(*[(a, o - 2) for a, o in wanted])),
        ("offset and scale of the ordinate", fixed(1, 0, None, 4.0, None, 1.0), points(*[(a, o / 4 - 1) for a, o in wanted])),
        ("an offset to earlier times", fixed(1, 0, None, None, -2.0), points(*[(a + 2.0, o) for a, o in ((0.0, 1.0), (0.0078125, 3.0))])),
        ("comma form", "1,,,,", [",".join(x.split()) for x in written]),
        ("resampling", fixed(1, 0, 0, 0, 0, 0, 0, 0), written),
        ("scales by parameters", fixed(1, 0, "&two", "&four"), points(*[(a / 2, o / 4) for a, o in wanted])),
    ):
        expected = plain_deck
        if "earlier" in name:
            expected = curve_deck(fixed(1), *points((0.0, 1.0), (0.0078125, 3.0)))
        text = curve_deck(head, *lines)
        if "&" in head:
            text = text.replace("*DEFINE_CURVE", "*PARAMETER\n" + pair("Rtwo", "2.0", "Rfour", "4.0") + "\n*DEFINE_CURVE")
        same("curve: " + name, text, expected, notes=["stays constant"])
    begin = 0.999 * 0.004
    for name, head, lines, expected in (
        ("OFFA", fixed(1, 0, None, None, 0.004), [(0.0, 1.0), (0.002, 3.0)], [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)]),
        ("OFFA and a first abscissa above 0", fixed(1, 0, None, None, 0.004), [(0.001, 1.0), (0.002, 3.0)], [(0.0, 0.0), (begin, 0.0), (0.005, 1.0), (0.006, 3.0)]),
        ("OFFA and SFA", fixed(1, 0, 2.0, None, 0.002), [(0.0, 1.0), (0.001, 3.0)], [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)]),
        ("OFFA and SFO", fixed(1, 0, None, 2.0, 0.004), [(0.0, 0.5), (0.002, 1.5)], [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)]),
        ("OFFA and OFFO", fixed(1, 0, None, None, 0.004, 1.0), [(0.0, 0.0), (0.002, 2.0)], [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)]),
        ("OFFA, one point", fixed(1, 0, None, None, 0.004), [(0.0, 1.0)], [(0.0, 0.0), (begin, 0.0), (0.004, 1.0)]),
        ("OFFA and a first ordinate of 0", fixed(1, 0, None, None, 0.004), [(0.0, 0.0), (0.002, 3.0)], [(0.0, 0.0), (begin, 0.0), (0.004, 0.0), (0.006, 3.0)]),
    ):
        same("curve: " + name, curve_deck(head, *points(*lines)), curve_deck(fixed(1), *points(*expected)), notes=["stays constant"])
    motion = cards("BOUNDARY_PRESCRIBED_MOTION_NODE", fixed(15, 2, 0, 5)) + "\n"
    same("a motion by a shifted curve", deck(more=motion + cards("DEFINE_CURVE", fixed(5, 0, None, None, 0.004), *points((0.0, 0.2), (0.002, 0.5)))),
         deck(more=motion + cards("DEFINE_CURVE", fixed(5), *points((0.0, 0.0), (begin, 0.0), (0.004, 0.2), (0.006, 0.5)))), notes=["stays constant"])
    for name, head, lines, words in (
        ("SIDR 1", fixed(1, 1), written, "field SIDR: expected 0 or 2: dynamic relaxation is not available in this version"),
        ("SIDR 3", fixed(1, 3), written, "field SIDR: expected an integer >= 0 and <= 2"),
        ("SFA below 0", fixed(1, 0, -1.0), written, "field SFA: expected a real number > 0"),
        ("an abscissa before the offset", fixed(1, 0, None, None, 0.004), points((-0.001, 1.0), (0.002, 1.0)), "field OFFA: expected a first abscissa >= 0"),
        ("points in space", fixed(1, 0, 1, 1, 0, 0, -1), written, "field DATTYP: expected blank or 0"),
        ("not increasing", fixed(1), points((0.0, 1.0), (0.002, 1.0), (0.002, 2.0)), "field A: expected an abscissa greater than that of the card before"),
        ("decreasing", fixed(1), points((0.003, 1.0), (0.002, 1.0)), "field A: expected an abscissa greater"),
        ("three columns", fixed(1), [long(0.0, 1.0, 2.0)], "text beyond column 40"),
        ("ten columns", fixed(1), [fixed(0.0, 1.0), fixed(1.0, 3.0)], "field A: expected a real number"),
    ):
        refused("curve: " + name, curve_deck(head, *lines), words)


def supported():
    """Initial velocity in held directions: the support wins, one note with the number of nodes."""
    right = SECTIONS["velocity"] + "\n*INITIAL_VELOCITY_NODE\n" + "\n".join(fixed(n, -0.5, 0.125) for n in (11, 12, 14, 15))
    plain_deck = deck(velocity=right)
    note = ["initial velocity on fixed directions of 2 nodes: the supports win"]
    of_right = lambda keyword: SECTIONS["velocity"] + "\n" + keyword
    for name, changes, notes in (
        ("a part", dict(velocity=of_right(cards("INITIAL_VELOCITY_GENERATION", fixed(2, 2, None, -0.5, 0.125), ""))), note),
        ("a part set", dict(velocity=of_right(cards("INITIAL_VELOCITY_GENERATION", fixed(12, 1, None, -0.5, 0.125), ""))), note),
        ("a node set", dict(velocity=of_right(cards("SET_NODE_LIST", fixed(8), fixed(11, 12, 13, 14, 15, 16)) + "\n" + cards("INITIAL_VELOCITY", fixed(8), fixed(-0.5, 0.125)))), note),
        ("nodes", dict(velocity=right + "\n" + fixed(13, -0.5, 0.125) + "\n" + fixed(16, 1.0)), note),
        ("TC", dict(support="", nodes=held_nodes(7, 13, 16), velocity=of_right(cards("INITIAL_VELOCITY_GENERATION", fixed(2, 2, None, -0.5, 0.125), ""))), note),
        ("a velocity of 0", dict(velocity=right + "\n" + fixed(13, 0.0, 0.0)), []),
        ("one node", dict(velocity=right + "\n" + fixed(13, 0.0, 3.0)), ["fixed directions of 1 node: the supports win"]),
    ):
        same("velocity on a support: " + name, deck(**changes), plain_deck, notes=notes)
    one = dict(support=cards("BOUNDARY_SPC_SET", fixed(1, None, 1)))
    same("velocity on a support: along a free direction", deck(velocity=right + "\n" + fixed(13, 0.7, 0.25) + "\n" + fixed(16, None, 0.25), **one), deck(velocity=right + "\n" + fixed(13, None, 0.25) + "\n" + fixed(16, None, 0.25), **one), notes=["of 1 node:"])
    same("velocity on a support: all nodes", deck(velocity=cards("INITIAL_VELOCITY", "", fixed(1.0, -0.25))),
         deck(velocity=cards("INITIAL_VELOCITY_NODE", *[fixed(n, 1.0, -0.25) for n in (1, 2, 3, 4, 5, 6, 11, 12, 14, 15)])), notes=note)
    for name, changes, words in (
        ("two velocities", dict(velocity=right + "\n" + fixed(12, 7.0)), "node 12 gets a second, different initial velocity"),
        ("two velocities on a support", dict(velocity=right + "\n" + fixed(13, 7.0) + "\n" + fixed(13, 8.0)), "node 13 gets a second, different initial velocity"),
        ("a motion that contradicts it", dict(velocity=right, more=cards("BOUNDARY_PRESCRIBED_MOTION_NODE", fixed(15, 1, 0, 1))), "differs from that of its prescribed motion"),
        ("no such node", dict(velocity=right + "\n" + fixed(77, 1.0)), "node 77 is not defined"),
    ):
        refused("velocity: " + name, deck(**changes), words, problems=1)


def no_time_card():
    """Without *BIPACT_TIME: THETA where there is contact and neither GAMMA nor BETA, else
    NEWMARK."""
    theta = ["no *BIPACT_TIME: the scheme is THETA with theta = xi = 1/2"]
    warning = ["no *BIPACT_TIME, but GAMMA or BETA: the scheme is NEWMARK", "WARNING energy-growth"]
    newmark = deck(time="*BIPACT_TIME\n   NEWMARK")
    dynamics = lambda *x: cards("CONTROL_IMPLICIT_DYNAMICS", fixed(1, *x))
    wall = cards("RIGIDWALL_PLANAR", "", fixed(-9.0, None, None, 9.0))
    free = dict(contact="", tables=SECTIONS["tables"].replace("*DATABASE_RCFORC\n     0.001\n*DATABASE_SLEOUT\n     0.001\n", "").replace("\n*DATABASE_NCFORC\n     0.001", ""))
    for name, changes, plain_deck, notes in (
        ("neither", dict(time=""), deck(), theta),
        ("zeros", dict(time="", dynamics=dynamics("0.0", "0.0")), deck(), theta),
        ("zeros by parameters", dict(time="", dynamics="*PARAMETER\n" + pair("Rg", "0.0") + "\n" + dynamics("&g", "&g")), deck(), theta),
        ("GAMMA", dict(time="", dynamics=dynamics("0.5")), newmark, warning),
        ("BETA", dict(time="", dynamics=dynamics(None, "0.25")), newmark, warning),
        ("both", dict(time="", dynamics=dynamics("0.5", "0.25")), newmark, warning),
        ("both, not those of the scheme", dict(time="", dynamics=dynamics(0.6, 0.38)), deck(time="*BIPACT_TIME\n   NEWMARK", dynamics=dynamics(0.6, 0.38)), warning),
        ("no contact", dict(time="", **free), deck(time="*BIPACT_TIME\n   NEWMARK", **free), []),
        ("no contact, GAMMA", dict(time="", dynamics=dynamics("0.5"), **free), deck(time="*BIPACT_TIME\n   NEWMARK", **free), []),
        ("a wall", dict(time="", more=wall, **free), deck(more=wall, **free), theta),
        ("a blank card", dict(time="*BIPACT_TIME\n\n"), deck(), None),
        ("node to surface", dict(time="", contact=SECTIONS["contact"].replace("SURFACE_TO", "NODE_TO")), deck(contact=SECTIONS["contact"].replace("SURFACE_TO", "NODE_TO")), theta),
        ("a single surface", dict(time="", contact=cards("CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", fixed(None, None, None, None, 0.3))), deck(contact=cards("CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", fixed(None, None, None, None, 0.3))), theta),
    ):
        same("no time card: " + name, deck(**changes), plain_deck, notes=notes)
    refused("no time card: unstable", deck(time="", dynamics=dynamics(0.5, 0.1)), "field BETA: expected BETA >= (GAMMA + 1/2)^2/4", problems=1)
    refused("no time card: static", deck(time="", dynamics=cards("CONTROL_IMPLICIT_DYNAMICS", fixed(0))), "field IMASS: expected 1", problems=1)
    refused("no time card: alpha", deck(time="", dynamics=dynamics(0.5, 0.25, 0, 0, 0, 0, -0.1)), "field ALPHA", problems=1)


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
