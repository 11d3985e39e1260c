"""Files, folders and blank lines as preprocessors write them (see preprocessors.py)."""

import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from plain import SECTIONS, MESH, deck, fixed, cards, refused, remove_files, same
from scenes import finish


def includes():
    """Names of files: beside the including one, in the folders of *INCLUDE_PATH and
    _RELATIVE."""
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
        (
            "a name over two lines",
            "*INCLUDE_PATH\n" + absolute[:-2] + " +\n" + absolute[-2:],
            mesh,
        ),
        ("*INCLUDE_PATH_RELATIVE", "*INCLUDE_PATH_RELATIVE\nfar", mesh),
        ("below", "*INCLUDE_PATH_RELATIVE\nvery/far/off", {"very/far/off/mesh.k": MESH}),
        ("above", "*INCLUDE_PATH_RELATIVE\nvery/../far", dict(mesh, **{"very/x": ""})),
        ("in lower case", "*include_path_relative\n./far/", mesh),
        (
            "a folder that an include names",
            "*INCLUDE\nfar/path.k",
            dict(mesh, **{"far/path.k": "*INCLUDE_PATH_RELATIVE\n.\n*END\n"}),
        ),
        (
            "a folder above that an include names",
            "*INCLUDE\nfar/path.k",
            {"far/path.k": "*INCLUDE_PATH_RELATIVE\n../other\n*END\n", "other/mesh.k": MESH},
        ),
    ):
        same(name, deck(early=early, **here), files=files, notes=None)
        remove_files(files)
    same(
        "the first folder wins",
        deck(early="*INCLUDE_PATH_RELATIVE\nfirst\nsecond", **here),
        files={"first/mesh.k": MESH, "second/mesh.k": "*NONSENSE"},
    )
    same(
        "the file's own folder wins",
        deck(early="*INCLUDE_PATH_RELATIVE\nfirst", **here),
        files={"mesh.k": MESH, "first/mesh.k": "*NONSENSE"},
    )
    remove_files({"mesh.k": ""})
    same(
        "an include of an include",
        deck(early="*INCLUDE_PATH_RELATIVE\nsecond", nodes="*INCLUDE\nfirst/a.k", elements=""),
        files={
            "first/a.k": "*INCLUDE\nb.k\n*INCLUDE\nc.k\n",
            "first/b.k": SECTIONS["nodes"],
            "second/c.k": SECTIONS["elements"],
        },
        notes=[],
    )
    for name, text in (
        ("two names", "*INCLUDE\nnodes.k\nelements.k"),
        ("a blank line after the name", "*INCLUDE\nnodes.k\n\n*INCLUDE\nelements.k\n"),
        ("a blank line before the name", "*INCLUDE\n\nnodes.k\n   \nelements.k"),
        (
            "a comment before the name",
            "*INCLUDE\n$ nodes\nnodes.k\n*INCLUDE\n$#  filename\nelements.k",
        ),
        ("blanks before the name", "*INCLUDE\n   nodes.k   \n  ./elements.k"),
        ("carriage returns", "*INCLUDE\r\nnodes.k\r\nelements.k\r"),
    ):
        same(
            name,
            deck(nodes=text, elements=""),
            files={"nodes.k": SECTIONS["nodes"], "elements.k": SECTIONS["elements"]},
        )
    remove_files({"mesh.k": "", "far/mesh.k": ""})
    for name, early, files, words in (
        (
            "no such file",
            "",
            {},
            ['cannot read "', "refused", 'mesh.k"', "or to a folder of *INCLUDE_PATH"],
        ),
        (
            "in no folder",
            "*INCLUDE_PATH_RELATIVE\nnowhere",
            {},
            ["*INCLUDE: cannot read", "mesh.k"],
        ),
        (
            "a folder that is named too late",
            "",
            {"far/mesh.k": MESH},
            ["*INCLUDE: cannot read"],
        ),
        (
            "a circle by a folder",
            "*INCLUDE_PATH_RELATIVE\nround",
            {"round/mesh.k": "*INCLUDE\nmesh.k"},
            ["the file includes itself"],
        ),
        (
            "a circle of two",
            "*INCLUDE_PATH_RELATIVE\nround",
            {"round/mesh.k": "*INCLUDE\nback.k", "round/back.k": "*INCLUDE\nmesh.k\n"},
            ["the file includes itself"],
        ),
        (
            "a circle by another name",
            "*INCLUDE_PATH_RELATIVE\nround",
            {"round/mesh.k": "*INCLUDE\n../round/./mesh.k\n"},
            ["*INCLUDE: "],
        ),
        (
            "a fault in a file of a folder",
            "*INCLUDE_PATH_RELATIVE\nround",
            {
                "round/mesh.k": MESH.replace(
                    "       1             0.0", "       1             o.0"
                )
            },
            ["round/mesh.k:2, columns 9-24", "included from"],
        ),
    ):
        late = "*INCLUDE_PATH_RELATIVE\nfar" if "late" in name else ""
        refused(name, deck(early=early, more=late, **here), *words, files=files)
        remove_files(files)
    refused(
        "no name", deck(more="*INCLUDE"), "*INCLUDE: the name of a file is missing", problems=1
    )
    refused(
        "no name but blanks",
        deck(more="*INCLUDE\n\n   \n"),
        "*INCLUDE: the name of a file is missing",
        problems=1,
    )
    refused(
        "a folder as a file", deck(more="*INCLUDE\nround"), "*INCLUDE: ", files={"round/x": ""}
    )


def blank_lines():
    """Blank lines between cards: passed over, one note for a file. A blank line is a card where
    one may come that is blank."""
    note = ["blank lines between cards are passed over"]
    text = deck()
    for name in sorted(set(SECTIONS) - {"early", "more", "velocity"}):
        after = SECTIONS[name] + "\n"
        same("after " + name, deck(**{name.replace(" ", "_"): after}), notes=note)
        same(
            "several after " + name,
            deck(**{name.replace(" ", "_"): after + "\n   \n" + " " * 90}),
            notes=note,
        )
    for name in ("nodes", "elements", "held", "left set", "support", "nodes of nodout"):
        lines = SECTIONS[name].split("\n")
        wide = "\n\n".join([lines[0] + "\n" + lines[1]] + lines[2:])
        if name in ("held", "left set"):
            wide = SECTIONS[name] + "\n\n" + fixed(0)
        if wide != SECTIONS[name]:
            same("among cards of " + name, deck(**{name.replace(" ", "_"): wide}), notes=note)
    points = SECTIONS["curve"].split("\n")
    same("among points", deck(curve="\n".join(points[:3] + ["", " "] + points[3:])), notes=note)
    for name in "nodes,elements,left material,held,left set,support,curve,load".split(","):
        first, rest = SECTIONS[name].split("\n", 1)
        same(
            "before the cards of " + name,
            deck(**{name.replace(" ", "_"): first + "\n\n" + rest}),
            notes=note,
        )
    same(
        "everywhere it is no card",
        re.sub(r"(?m)^(\*(?!END|INITIAL)\w+)$", r"\n\1", text),
        notes=note,
    )
    same("at the beginning", "\n  \n" + text, notes=note)
    same("after the end", text + "\n\n\n", notes=[])
    same("before the end", text.replace("*END", "\n \n*END"), notes=note)
    same("no end", text.replace("*END\n", "\n\n"), notes=note + ["no *END"])
    same(
        "carriage returns",
        text.replace("*NODE\n", "*NODE\n\n").replace("\n", "\r\n"),
        notes=note,
    )
    same("after *KEYWORD", text.replace("*KEYWORD\n", "*KEYWORD\n\n    \n"), notes=note)
    same(
        "among parameters",
        deck(
            early="*PARAMETER\n\n" + fixed("Rt", "0.5") + "\n\n",
            section=SECTIONS["section"].replace("0.5", " &t"),
        ),
        notes=None,
    )
    same(
        "among expressions",
        deck(
            early="*PARAMETER_EXPRESSION\n\nR t       1.0/\n\n          2.0\n\n",
            section=SECTIONS["section"].replace("0.5", " &t"),
        ),
        notes=None,
    )
    same(
        "in two files",
        deck(nodes="*INCLUDE\nmesh.k\n", elements=""),
        files={"mesh.k": MESH.replace("*ELEM", "\n*ELEM")},
        notes=["changed.k: blank", "mesh.k: blank"],
    )
    same(
        "in a skipped keyword",
        deck(more=cards("DATABASE_ABSTAT", "", fixed(1), "")),
        notes=["*DATABASE_ABSTAT"],
    )
    same(
        "a blank card is a card",
        deck(
            velocity=cards(
                "INITIAL_VELOCITY_GENERATION", fixed(1, 2, None, 1.0, -0.25), "        "
            ),
            more=cards("CONTROL_CONTACT", "", "", fixed(0, 0), ""),
        ),
        notes=note + ["CONTROL_CONTACT"],
    )
    same(
        "a blank heading",
        deck(parts="*PART\n\n" + fixed(1, 1, 1) + "\n\n" + fixed(2, 1, 2)),
        notes=[],
    )
    same(
        "a blank heading and a blank line",
        deck(parts="*PART\n\n" + fixed(1, 1, 1) + "\n\n" + fixed(2, 1, 2) + "\n\n"),
        notes=note,
    )
    same(
        "after heads",
        deck(
            support="*BOUNDARY_SPC_NODE_ID\n         1left\n\n"
            + fixed(13, 0, 1, 1)
            + "\n         2\n"
            + fixed(16, 0, 1, 1)
            + "\n\n"
        ),
        notes=note,
    )
    same(
        "sections",
        deck(
            section="*SECTION_SHELL\n\n"
            + fixed(1, 13, None, 4)
            + "\n"
            + fixed(0.5)
            + "\n\n"
            + fixed(2, 12)
            + "\n\n"
        ),
        notes=note,
    )
    for name, changes, words in (
        (
            "a card that is missing",
            dict(section="*SECTION_SHELL\n" + fixed(1, 13) + "\n\n" + fixed(0.5)),
            "*SECTION_SHELL",
        ),
        (
            "a keyword without its card",
            dict(left_material="*MAT_ELASTIC\n\n\n"),
            "*MAT_ELASTIC ends too early: expected 1 card, found 0",
        ),
        (
            "a point that is blank",
            dict(curve="\n".join(points[:2] + [""] + points[3:])),
            "expected a point, found a blank card",
        ),
        (
            "a set without members",
            dict(held="*SET_NODE_LIST\n" + fixed(1) + "\n\n"),
            "field SID: the node set is empty",
        ),
        (
            "a heading too many",
            dict(parts=SECTIONS["parts"] + "\n\nthird\n" + fixed(3, 1, 2)),
            "*PART card 6, field PID",
        ),
        (
            "a card too many",
            dict(load=SECTIONS["load"] + "\n\n" + fixed(1, 5.0)),
            "*LOAD_BODY_Y: one card too many",
        ),
        (
            "a table without an interval",
            dict(
                tables=SECTIONS["tables"].replace("*DATABASE_MATSUM\n", "*DATABASE_MATSUM\n\n")
            ),
            "*DATABASE_MATSUM: one card too many",
        ),
        (
            "a part without numbers",
            dict(parts="*PART\nleft\n\n" + fixed(1, 1, 1) + "\nright\n\n"),
            "*PART ends too early: expected 2 cards a set, found 1",
        ),
    ):
        refused("blank lines: " + name, deck(**changes), words)


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
