"""What preprocessors write on cards, against the same scene written plainly: the tables must
agree in every digit, for the deck and for its echo deck. Beside each kind stand decks that only
look like it: they must be refused, with the right words. The modules preprocessors_... go on by
subject."""

import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from format_defaults import BESIDE_THE_SCENE, BEYOND, OF_THE_SCENE
from plain import (
    SECTIONS,
    MESH,
    deck,
    fixed,
    long,
    cards,
    node,
    held_nodes,
    refused,
    remove_files,
    same,
    shell,
)
from scenes import finish


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
        (
            "fields filled up with zeros",
            "0000000001" + "00000.0010" + "01000.0000" + ".300000000",
        ),
    ):
        same("touching " + name, deck(left_material="*MAT_ELASTIC\n" + card))
    same(
        "a parameter after a full field",
        deck(
            early="*PARAMETER\nRvx              1.0Rmu              0.3Rro            0.001",
            velocity="*INITIAL_VELOCITY_GENERATION\n"
            + fixed(1, 2, "0.0")
            + "&vx            -0.25\n",
            contact="*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE\n"
            + fixed(11, 12, "1.0", "0")
            + "&mu       ",
            left_material="*MAT_ELASTIC\n" + fixed(1) + "&ro       " + fixed(1000.0, 0.3),
        ),
    )
    same(
        "signs part two numbers",
        deck(
            velocity=SECTIONS["velocity"].replace(fixed(1.0, -0.25), "       1.0-0.25     ")
            + "\n*INITIAL_VELOCITY_NODE\n"
            + fixed(11, "-0.0")
            + "-0.0      "
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
            curve="*DEFINE_CURVE\n"
            + fixed(1)
            + "\n                 0.01.0\n"
            + "1.000000000000000000"
            + "3.000000000000000000"
        ),
    )
    same(
        "long form",
        deck(left_material="*MAT_ELASTIC+\n" + long(1, 0.001) + "1000.0".ljust(20) + long(0.3)),
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
            dict(
                elements=SECTIONS["elements"].replace(
                    shell(3, 2, 11), shell(3, 2) + "       11"
                )
            ),
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
                held="*SET_NODE_LIST\n"
                + fixed(1, "0.0", "0.0", "0.0", "0.0")
                + "        MECH\n"
                + fixed(13, 16)
            ),
            ('the value "MECH" crosses the border between columns 60 and 61',),
        ),
        (
            "another solver",
            dict(
                held="*SET_NODE_LIST\n"
                + fixed(1)
                + mech.replace("MECH", "CESE")
                + "\n"
                + fixed(13)
            ),
            ('field SOLVER: expected MECH, found "CESE"',),
        ),
        (
            "ITS beyond its values",
            dict(
                held="*SET_NODE_LIST\n" + fixed(1) + mech + "               2\n" + fixed(13, 16)
            ),
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
        (
            "ELFORM and SECID",
            dict(section=cards("SECTION_SHELL", fixed("1.", "13.00"), fixed(0.5))),
        ),
        (
            "numbers of a part",
            dict(
                parts=cards(
                    "PART",
                    "left",
                    fixed("1.0", "1.0", "1.0"),
                    "right",
                    fixed("2.0", "1.", "0.2E1"),
                )
            ),
        ),
        (
            "a set",
            dict(held=cards("SET_NODE_LIST", fixed("1.0"), fixed("13.0", "16.0", "0.0"))),
        ),
        (
            "directions",
            dict(support=cards("BOUNDARY_SPC_SET", fixed("1.0", "0.0", "1.0", "1.0"))),
        ),
        ("comma form", dict(left_material=cards("MAT_ELASTIC", "1.0,.001,1000,.3"))),
        (
            "IMFLAG and IMASS",
            dict(
                general=cards("CONTROL_IMPLICIT_GENERAL", fixed("1.0", 0.0001, "2.0")),
                dynamics=cards("CONTROL_IMPLICIT_DYNAMICS", fixed("1.0")),
            ),
        ),
        (
            "an integer parameter",
            dict(
                early=cards("PARAMETER", fixed("In", "13.0")),
                held=cards("SET_NODE_LIST", fixed(1), fixed("&n", 16)),
            ),
        ),
        (
            "a real parameter",
            dict(
                early=cards("PARAMETER", fixed("Rn", "13.0")),
                held=cards("SET_NODE_LIST", fixed(1), fixed("&n", 16)),
            ),
        ),
    ):
        same("a whole real: " + name, deck(**changes), notes=[])
    for name, field, text in (
        ("a fraction", "NIP", cards("SECTION_SHELL", fixed(1, 13, None, "4.5"), fixed(0.5))),
        (
            "nearly whole",
            "NIP",
            cards("SECTION_SHELL", fixed(1, 13, None, "4.0000001"), fixed(0.5)),
        ),
        ("too large", "SECID", cards("SECTION_SHELL", fixed("3.0E9", 13), fixed(0.5))),
        ("an exponent alone", "SECID", cards("SECTION_SHELL", fixed("1E0", 13), fixed(0.5))),
        ("a bare exponent", "SECID", cards("SECTION_SHELL", fixed("1+0", 13), fixed(0.5))),
    ):
        refused(
            "a real in an integer field: " + name,
            deck(section=text),
            "field %s: expected an integer" % field,
            problems=1,
        )
    refused(
        "a fraction by a parameter",
        deck(
            early=cards("PARAMETER", fixed("Rn", "13.5")),
            held=cards("SET_NODE_LIST", fixed(1), fixed("&n", 16)),
        ),
        'field NID1: expected an integer >= 0, found "&n = 13.5"',
        problems=1,
    )


def effects():
    """HGID with *HOURGLASS, TMID, DTMIN, ENDMAS and the like: a note, no effect."""
    hourglass = cards("HOURGLASS", fixed(3, 4, 0.05))
    for name, changes, notes in (
        (
            "HGID",
            dict(
                parts=cards("PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2)),
                more=hourglass,
            ),
            ["HOURGLASS", "*PART HGID"],
        ),
        (
            "HGID twice",
            dict(
                parts=cards(
                    "PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2, 0, 3)
                ),
                more=hourglass,
            ),
            ["HOURGLASS", "*PART HGID"],
        ),
        (
            "HGID of a card with a title",
            dict(
                parts=cards("PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2)),
                more=cards("HOURGLASS_TITLE", "stiff", fixed(3, 4)),
            ),
            ["HOURGLASS", "*PART HGID"],
        ),
        (
            "HGID without a card",
            dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, 3), "right", fixed(2, 1, 2))),
            ["*PART HGID"],
        ),
        (
            "TMID",
            dict(
                parts=cards(
                    "PART", "left", fixed(1, 1, 1, 0, 0, 0, 0, 2), "right", fixed(2, 1, 2)
                )
            ),
            ["*PART TMID"],
        ),
        ("DTMIN", dict(end=cards("CONTROL_TERMINATION", fixed(0.01, 0, 0.01))), ["DTMIN"]),
        (
            "ENDMAS",
            dict(end=cards("CONTROL_TERMINATION", fixed(0.01, 0, 0, 0, 50.0))),
            ["ENDMAS"],
        ),
        (
            "both, packed",
            dict(
                end=cards(
                    "CONTROL_TERMINATION",
                    "      0.01         0      0.01       0.02.000000E8         0",
                )
            ),
            ["DTMIN", "ENDMAS"],
        ),
        (
            "SHRF and PROPT",
            dict(section=cards("SECTION_SHELL", fixed(1, 13, 0.8333, 4, 3.0), fixed(0.5))),
            ["SHRF", "PROPT"],
        ),
        (
            "penalty contact",
            dict(
                contact=cards(
                    "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE",
                    fixed(11, 12, 0.1, 10, 0.3),
                    fixed(0, 0, 0.5, 0.5, 1, 1, 1),
                    fixed(0, 20.0, 0, 0, 1),
                    fixed(0, 0, 0.1),
                )
            ),
            ["SFACT", "FREQ", "SOA", "SOB", "NDA", "NDB", "COF", "VDC", "ISTIFF", "TDPEN"],
        ),
        (
            "springback",
            dict(general=cards("CONTROL_IMPLICIT_GENERAL", fixed(1, 0.0001, 1))),
            ["IMFORM"],
        ),
        (
            "nonlinear solves",
            dict(more=cards("CONTROL_IMPLICIT_SOLUTION", fixed(1, 1, 5, 0.01), fixed(4, 2))),
            ["ILIMIT", "MAXREF", "DCTOL", "DNORM", "DIVERG"],
        ),
        (
            "options of tables",
            dict(
                tables=SECTIONS["tables"].replace(
                    cards("DATABASE_NODOUT", fixed(0.001)),
                    cards("DATABASE_NODOUT", fixed(0.001, 3, 0, 2, 1.0e-6, 1)),
                )
            ),
            ["BINARY", "IOOPT", "OPTION1", "OPTION2"],
        ),
        (
            "points of a curve",
            dict(
                curve=SECTIONS["curve"].replace(
                    fixed(1) + "\n", fixed(1, 0, 0, 0, 0, 0, 0, 500) + "\n"
                )
            ),
            ["LCINT"],
        ),
        (
            "rotations of a support",
            dict(support=cards("BOUNDARY_SPC_SET", fixed(1, 0, 1, 1, 1, 1, 1, 1))),
            [],
        ),
    ):
        same(name, deck(**changes), notes=notes)
    for name, changes, words in (
        (
            "HGID of no number",
            dict(parts=cards("PART", "left", fixed(1, 1, 1, 0, "x"), "right", fixed(2, 1, 2))),
            "field HGID: expected an integer",
        ),
        (
            "DTMIN of no number",
            dict(end=cards("CONTROL_TERMINATION", fixed(0.01, 0, "1/2"))),
            "field DTMIN: expected a real number",
        ),
        (
            "an equation of state",
            dict(parts=cards("PART", "left", fixed(1, 1, 1, 3), "right", fixed(2, 1, 2))),
            "field EOSID: expected blank or 0",
        ),
        (
            "a fluid",
            dict(left_material=cards("MAT_ELASTIC", fixed(1, 0.001, 1000.0, 0.3, 0, 0, 2.0))),
            "field K: expected blank or 0",
        ),
    ):
        refused(name, deck(**changes), words, problems=1)


def forms():
    """Long form, comma form and the marks + - % of keywords."""
    wide = (
        long_nodes({})
        + "\n"
        + "\n".join(
            ["*ELEMENT_SHELL+"]
            + [long(*x.split()) for x in SECTIONS["elements"].split("\n")[1:]]
        )
    )
    bare = wide.replace("+", "")
    here = dict(nodes="*INCLUDE\nmesh.k", elements="")
    for name, mesh in (
        ("*NODE+", wide),
        ("*NODE +", wide.replace("+", " +")),
        ("LONG=Y of the include", "*KEYWORD LONG=Y\n" + bare),
        ("LONG=Y and memory", "*KEYWORD memory=20m LONG=Y ncpu=2\n" + bare),
        ("long=y, in lower case", "*keyword long=y\n" + bare),
        (
            "*NODE- in a long include",
            "*KEYWORD LONG=Y\n"
            + SECTIONS["nodes"].replace("*NODE", "*NODE-")
            + "\n"
            + bare[bare.index("*ELEM") :],
        ),
        (
            "*NODE - in a long include",
            "*KEYWORD LONG=Y\n"
            + SECTIONS["nodes"].replace("*NODE", "*NODE -")
            + "\n"
            + bare[bare.index("*ELEM") :],
        ),
    ):
        same(
            name + ": the file above stays as it is",
            deck(**here),
            files={"mesh.k": mesh + "\n*END\n"},
            notes=None,
        )
    same(
        "an include of a long include",
        deck(**here),
        files={"mesh.k": "*KEYWORD LONG=Y\n*INCLUDE\nmesh2.k\n*END\n", "mesh2.k": bare},
        notes=[],
    )
    same(
        "LONG=S of an include of a long include",
        deck(**here),
        files={
            "mesh.k": "*KEYWORD LONG=Y\n*INCLUDE\nmesh2.k\nmesh3.k\n*END\n",
            "mesh2.k": "*KEYWORD LONG=S\n" + SECTIONS["nodes"],
            "mesh3.k": bare[bare.index("*ELEM") :],
        },
        notes=[],
    )
    remove_files({"mesh.k": "", "mesh2.k": "", "mesh3.k": ""})
    commas = re.sub(r"(?m)^( +[-0-9.]+)+$", lambda m: ",".join(m.group().split()) + ",", MESH)
    same("a mesh in comma form", deck(nodes=commas, elements=""), notes=[])
    same(
        "comma form with many blanks",
        deck(nodes=commas.replace(",", "  ,   "), elements=""),
        notes=[],
    )
    same(
        "comma form beyond column 80",
        deck(nodes=commas.replace(",", " " * 40 + ","), elements=""),
        notes=[],
    )
    same(
        "comma form in long form",
        deck(nodes=commas.replace("*NODE", "*NODE+"), elements=""),
        notes=[],
    )
    same(
        "a remark after a keyword",
        deck(
            nodes=SECTIONS["nodes"].replace("*NODE", "*NODE  + four more"),
            elements=SECTIONS["elements"].replace("SHELL", "SHELL\tplane"),
        ),
        notes=[],
    )
    for name, text in (
        ("*NODE %", deck(nodes=SECTIONS["nodes"].replace("*NODE", "*NODE %"))),
        ("*NODE%", deck(nodes=SECTIONS["nodes"].replace("*NODE", "*NODE%"))),
        (
            "*ELEMENT_SHELL %",
            deck(elements=SECTIONS["elements"].replace("SHELL", "SHELL   %  ")),
        ),
        ("*KEYWORD I10=Y", deck().replace("*KEYWORD", "*KEYWORD I10=Y")),
    ):
        refused(
            name,
            text,
            re.sub(" *%", " %", name)
            + " (ids of ten columns) is not available in this version",
        )
    refused(
        "long cards of a standard keyword",
        deck(nodes=wide.replace("*NODE+", "*NODE"), elements=""),
        "*NODE card 1",
    )
    refused(
        "standard cards of a long keyword",
        deck(nodes=SECTIONS["nodes"].replace("*NODE", "*NODE+")),
        "*NODE card 1",
    )
    refused(
        "a comma too many",
        deck(load=cards("LOAD_BODY_Y", "1,5.0,,,,,,,9")),
        "expected at most 7 comma-separated fields, found 9",
    )


def node_card():
    """TC of *NODE against *BOUNDARY_SPC_NODE; RC is a note."""
    for tc, x, y in (
        (1, 1, 0),
        (2, 0, 1),
        (3, 0, 0),
        (4, 1, 1),
        (5, 0, 1),
        (6, 1, 0),
        (7, 1, 1),
    ):
        support = (
            cards("BOUNDARY_SPC_NODE", fixed(13, None, x, y), fixed(16, None, x, y))
            if x + y
            else ""
        )
        plain_deck = deck(support=support)
        same(
            "TC %d" % tc,
            deck(support="", nodes=held_nodes(tc, 13, 16)),
            plain_deck,
            notes=[] if x + y else ["SPCFORC"],
        )
        same(
            "TC %d and RC" % tc,
            deck(support="", nodes=held_nodes(tc, 13, 16, rc=7)),
            plain_deck,
            notes=["RC"] + [] * (x + y) + ["SPCFORC"] * (x + y == 0),
        )
    same("TC 0, RC 0", deck(nodes=held_nodes(0, 1, 2, 3, rc=0)), notes=[])
    same(
        "RC alone",
        deck(nodes=held_nodes(None, 1, 2, 13, rc=4)),
        notes=["*NODE RC has no effect"],
    )
    same("TC beside a support", deck(nodes=held_nodes(7, 13, 16)), notes=[])
    same(
        "TC completes a support",
        deck(
            nodes=held_nodes(2, 13, 16), support=cards("BOUNDARY_SPC_SET", fixed(1, None, 1, 0))
        ),
        notes=[],
    )
    same("TC as a whole real", deck(support="", nodes=held_nodes("7.0", 13, 16)), notes=[])
    same(
        "TC in comma form",
        deck(
            support="",
            nodes=SECTIONS["nodes"]
            .replace(node(13, 2.005, 0.0), "13,2.005,0.,0.,7,7")
            .replace(node(16, 2.005, 1.0), "16,2.005,1.,,7"),
        ),
        notes=["RC"],
    )
    same(
        "TC by a parameter",
        deck(
            early="*PARAMETER\nIfix              7",
            support="",
            nodes=held_nodes("&fix", 13, 16),
        ),
        notes=[],
    )
    same("TC in long form", deck(support="", nodes=long_nodes({13: 7, 16: 7})), notes=[])
    motion = "BOUNDARY_PRESCRIBED_MOTION_NODE"
    same(
        "TC across a motion",
        deck(nodes=held_nodes(1, 15), more=cards(motion, fixed(15, 2, 2, 1, 1.0e-3))),
        deck(
            support=SECTIONS["support"] + "\n*BOUNDARY_SPC_NODE\n" + fixed(15, None, 1),
            more=cards(motion, fixed(15, 2, 2, 1, 1.0e-3)),
        ),
        notes=[],
    )
    same(
        "TC and a velocity",
        deck(nodes=held_nodes(1, 1, 4)),
        deck(
            support=SECTIONS["support"]
            + "\n*BOUNDARY_SPC_NODE\n"
            + fixed(1, None, 1)
            + "\n"
            + fixed(4, None, 1)
        ),
        notes=["fixed directions of 2 nodes"],
    )
    refused(
        "TC on a motion",
        deck(nodes=held_nodes(2, 15), more=cards(motion, fixed(15, 2, 2, 1))),
        "field DOF: direction Y of node 15 is fixed",
        problems=1,
    )
    refused(
        "TC 7 on a motion",
        deck(nodes=held_nodes(7, 15), more=cards(motion, fixed(15, 1, 0, 1))),
        "field DOF: direction X of node 15 is fixed",
        problems=1,
    )
    for name, nodes in (
        ("TC 8", held_nodes(8, 13)),
        ("TC -1", held_nodes(-1, 13)),
        ("TC 1.5", held_nodes(1.5, 13)),
        ("RC 9", held_nodes(7, 13, rc=9)),
    ):
        words = "field %s: expected an integer >= 0 and <= 7" % name.split()[0]
        refused(name, deck(nodes=nodes), words, problems=1)
    refused(
        "TC one column off",
        deck(
            nodes=SECTIONS["nodes"].replace(
                node(13, 2.005, 0.0), node(13, 2.005, 0.0).ljust(56) + "       12       "
            )
        ),
        "crosses the border",
        problems=None,
    )


def long_nodes(held):
    """The nodes in long form."""
    lines = []
    for line in SECTIONS["nodes"].split("\n")[1:]:
        number, x, y = line.split()
        lines.append(long(number, x, y, 0.0, held.get(int(number))))
    return "\n".join(["*NODE+"] + lines)


def parts_without():
    """*PART with SECID or MID 0: one message."""
    for name, card, words in (
        ("MID 0", fixed(1, 1, 0), "part 1 has no section or no material (SECID 1, MID 0)"),
        ("SECID 0", fixed(1, 0, 1), "part 1 has no section or no material (SECID 0, MID 1)"),
        ("both 0", fixed(1, 0, 0), "part 1 has no section or no material (SECID 0, MID 0)"),
        ("both blank", fixed(1), "part 1 has no section or no material (SECID 0, MID 0)"),
        ("0.0", fixed(1, "0.0", 1), "part 1 has no section or no material (SECID 0, MID 1)"),
        (
            "SECID 0 and no such material",
            fixed(1, 0, 9),
            "part 1 has no section or no material (SECID 0, MID 9)",
        ),
        ("no such section", fixed(1, 9, 1), "section 9 is not defined"),
        ("no such material", fixed(1, 1, 9), "material 9 is not defined"),
        ("a negative number", fixed(1, -1, 1), "field SECID: expected an integer >= 0"),
    ):
        refused(
            name,
            deck(parts="*PART\nleft\n" + card + "\nright\n" + fixed(2, 1, 2)),
            words,
            problems=1,
        )
    refused(
        "two parts",
        deck(parts="*PART\nleft\n" + fixed(1) + "\nright\n" + fixed(2)),
        "part 1 has no section",
        "part 2 has no section",
        problems=2,
    )
    refused(
        "a part of rigid bodies of other programs",
        deck(parts=SECTIONS["parts"] + "\nground\n" + fixed(3)),
        "part 3 has no section or no material",
        problems=1,
    )


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
