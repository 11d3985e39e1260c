"""Sets by clauses, columns, boxes and ranges against the list of their members (see
preprocessors.py)."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from plain import deck, fixed, cards, refused, same
from scenes import finish


def sets():
    """Sets by clauses, columns, boxes against the list of their members."""
    boxes = (
        cards("DEFINE_BOX", fixed(1, -1.0, 0.25, -1.0, 2.0))
        + "\n"
        + cards("DEFINE_BOX_TITLE", "the far side", fixed(2, 1.9, 2.1, -1.0, 2.0, -1.0, 1.0))
        + "\n"
    )
    boxes += cards("DEFINE_BOX", fixed(3, 0.0, 3.0, 0.5, 1.5)) + "\n"
    for name, head, members in (
        ("a column", "COLUMN", [fixed(13), fixed(16)]),
        (
            "a column with attributes of zero",
            "COLUMN",
            [fixed(13, 0.0, 0.0, 0.0, 0.0), fixed(16, "0.0")],
        ),
        ("a column in comma form", "COLUMN", ["13,", "16,0,0"]),
        ("a column with blank lines", "COLUMN", ["", fixed(13), "", fixed(16), ""]),
        ("clauses of numbers", "GENERAL", [fixed("NODE", 13, 16)]),
        (
            "clauses of numbers, one a card",
            "GENERAL",
            [
                "node".ljust(10) + fixed(13),
                fixed("NODE", None, None, None, None, None, None, 16),
            ],
        ),
        (
            "all but some",
            "GENERAL",
            [fixed("ALL"), fixed("DNODE", 1, 2, 3, 4, 5, 6, 11), fixed("DNODE", 12, 14, 15)],
        ),
        ("a part but some", "GENERAL", [fixed("PART", 2), fixed("DNODE", 11, 12, 14, 15)]),
        (
            "all but a part and some",
            "GENERAL",
            [fixed("ALL"), fixed("DPART", 1), fixed("DNODE", 11, 12, 14, 15)],
        ),
        ("a box", "GENERAL", [fixed("BOX", 2)]),
        ("two boxes but a part", "GENERAL", [fixed("BOX", 1, 2), fixed("DPART", 1)]),
        (
            "all but a box, and more",
            "GENERAL",
            [fixed("PART", 2), fixed("DBOX", 3), fixed("DNODE", 11, 12), fixed("NODE", 16)],
        ),
        (
            "the order counts",
            "GENERAL",
            [fixed("DNODE", 13), fixed("NODE", 13, 16, 12), fixed("DNODE", 12)],
        ),
        ("comma form", "GENERAL", ["NODE,13,16"]),
        ("zeros are padding", "GENERAL", [fixed("NODE", 13, 0, 0, 16, 0, 0, 0)]),
        (
            "blank lines among clauses",
            "GENERAL",
            ["", fixed("NODE", 13), "", "", fixed("NODE", 16), ""],
        ),
        ("whole reals", "GENERAL", [fixed("NODE", "13.0", "16.0")]),
        ("ranges", "LIST_GENERATE", [fixed(13, 13, 16, 999)]),
        ("ranges with padding", "LIST_GENERATE", [fixed(0, 0, 13, 13, 0, 0, 16, 16)]),
    ):
        same(
            "nodes by " + name,
            deck(held=cards("SET_NODE_" + head, fixed(1), *members), more=boxes),
            notes=None,
        )
    for name, head, members in (
        ("a column", "COLUMN", [fixed(2)]),
        ("ranges", "LIST_GENERATE", [fixed(2, 2)]),
        ("a column in comma form", "COLUMN", ["2,"]),
        ("a range with holes", "LIST_GENERATE", [fixed(2, 900)]),
    ):
        same(
            "parts by " + name,
            deck(right_set=cards("SET_PART_" + head, fixed(12), *members)),
            notes=[],
        )
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
        same(
            "elements by " + name,
            deck(
                elements_of_elout=cards("SET_SHELL_" + head, fixed(6), *members)
                + "\n"
                + wanted,
                more=box,
            ),
            deck(elements_of_elout=cards("DATABASE_HISTORY_SHELL", fixed(*plain_members))),
            notes=None,
        )
    pressure = "*LOAD_SEGMENT_SET\n" + fixed(9, 1, 2.0) + "\n"
    edges = {
        "left": (4, 1),
        "bottom 1": (1, 2),
        "bottom 2": (2, 3),
        "right": (3, 6),
        "top 1": (5, 4),
        "top 2": (6, 5),
    }
    other = [(11, 12), (12, 13), (13, 16), (16, 15), (15, 14), (14, 11)]
    for name, members, plain_edges in (
        (
            "all",
            [fixed("ALL")],
            [edges[k] for k in ("bottom 1", "left", "bottom 2", "right", "top 2", "top 1")]
            + other,
        ),
        ("a part", [fixed("PART", 1)], list(edges.values())),
        ("one edge", [fixed("SEG", 4, 5)], [edges["top 1"]]),
        (
            "two edges",
            [fixed("SEG", 4, 5), fixed("SEG", 6, 5)],
            [edges["top 1"], edges["top 2"]],
        ),
        ("a box", [fixed("BOX", 1)], [edges["left"]]),
        (
            "a part but a box",
            [fixed("PART", 1), fixed("DBOX", 3)],
            [edges[k] for k in ("left", "bottom 1", "bottom 2", "right")],
        ),
        (
            "a part but an edge",
            [fixed("PART", 1), fixed("DSEG", 1, 2)],
            [v for k, v in edges.items() if k != "bottom 1"],
        ),
        ("all but a part", [fixed("ALL"), fixed("DPART", 2)], list(edges.values())),
    ):
        listed = cards("SET_SEGMENT", fixed(9), *[fixed(*e) for e in sorted(plain_edges)])
        same(
            "edges by " + name,
            deck(more=boxes + pressure + cards("SET_SEGMENT_GENERAL", fixed(9), *members)),
            deck(more=pressure + listed),
        )
    for name, text, words in (
        (
            "no such node",
            cards("SET_NODE_GENERAL", fixed(7), fixed("NODE", 77)),
            "field E1: node 77 is not defined",
        ),
        (
            "no such part",
            cards("SET_NODE_GENERAL", fixed(7), fixed("PART", 1, 77)),
            "field E2: part 77 is not defined",
        ),
        (
            "no such box",
            cards("SET_NODE_GENERAL", fixed(7), fixed("DBOX", 77)),
            "field E1: box 77 is not defined",
        ),
        (
            "no such element",
            cards("SET_SHELL_GENERAL", fixed(7), fixed("ELEM", 77)),
            "field E1: element 77 is not defined",
        ),
        (
            "a clause of other sets",
            cards("SET_NODE_GENERAL", fixed(7), fixed("ELEM", 1)),
            "field OPTION: expected one of ALL, NODE, DNODE, PART, DPART, BOX, DBOX",
        ),
        (
            "no clause",
            cards("SET_NODE_GENERAL", fixed(7), fixed(None, 1)),
            "field OPTION: expected one of ALL",
        ),
        (
            "a clause one column off",
            cards("SET_NODE_GENERAL", fixed(7), "        NODE" + fixed(13)),
            "crosses the border",
        ),
        (
            "nothing left",
            cards("SET_NODE_GENERAL", fixed(7), fixed("ALL"), fixed("DPART", 1, 2)),
            "the node set is empty",
        ),
        (
            "an edge of two bodies",
            cards("SET_SEGMENT_GENERAL", fixed(7), fixed("SEG", 2, 5)),
            "expected the two nodes of one exposed element edge",
        ),
        (
            "an edge of three nodes",
            cards("SET_SEGMENT_GENERAL", fixed(7), fixed("SEG", 1, 2, 3)),
            "expected the two nodes of one exposed element edge",
        ),
        (
            "a column with attributes",
            cards("SET_NODE_COLUMN", fixed(7), fixed(13, 0.5)),
            "field A1: expected blank or 0",
        ),
        (
            "a box backwards",
            cards("DEFINE_BOX", fixed(1, 0, 1, 2, 1)),
            "field YMX: expected a number that is not below YMN",
        ),
        (
            "a box twice",
            cards("DEFINE_BOX", fixed(1, 0, 1)) + "\n" + cards("DEFINE_BOX", fixed(1, 0, 1)),
            "box 1 is defined twice",
        ),
        (
            "a set twice",
            cards("SET_NODE_COLUMN", fixed(1), fixed(13)),
            "node set 1 is defined twice",
        ),
        (
            "a range backwards",
            cards("SET_NODE_LIST_GENERATE", fixed(7), fixed(16, 13)),
            "field B1END: expected a number not below 16",
        ),
    ):
        refused("sets: " + name, deck(more=text), words)


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
