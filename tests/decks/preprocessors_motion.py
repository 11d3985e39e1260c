"""Curves, velocities of held nodes, the scheme that a deck leaves open (see
preprocessors.py)."""

import os
import shutil
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from plain import SECTIONS, cards, deck, fixed, held_nodes, long, pair, refused, rows_of, same
from scenes import check, finish, run_text


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
        (
            "scale of the ordinate",
            fixed(1, 0, None, 4.0),
            points(*[(a, o / 4) for a, o in wanted]),
        ),
        (
            "negative scale of the ordinate",
            fixed(1, 0, 0, -0.5),
            points(*[(a, -2 * o) for a, o in wanted]),
        ),
        ("both scales", fixed(1, 0, 2.0, 0.5), points(*[(a / 2, 2 * o) for a, o in wanted])),
        (
            "offset of the ordinate",
            fixed(1, 0, None, None, None, 2.0),
            points(*[(a, o - 2) for a, o in wanted]),
        ),
        (
            "offset and scale of the ordinate",
            fixed(1, 0, None, 4.0, None, 1.0),
            points(*[(a, o / 4 - 1) for a, o in wanted]),
        ),
        (
            "an offset to earlier times",
            fixed(1, 0, None, None, -2.0),
            points(*[(a + 2.0, o) for a, o in ((0.0, 1.0), (0.0078125, 3.0))]),
        ),
        ("comma form", "1,,,,", [",".join(x.split()) for x in written]),
        ("resampling", fixed(1, 0, 0, 0, 0, 0, 0, 0), written),
        (
            "scales by parameters",
            fixed(1, 0, "&two", "&four"),
            points(*[(a / 2, o / 4) for a, o in wanted]),
        ),
    ):
        expected = plain_deck
        if "earlier" in name:
            expected = curve_deck(fixed(1), *points((0.0, 1.0), (0.0078125, 3.0)))
        text = curve_deck(head, *lines)
        if "&" in head:
            text = text.replace(
                "*DEFINE_CURVE",
                "*PARAMETER\n" + pair("Rtwo", "2.0", "Rfour", "4.0") + "\n*DEFINE_CURVE",
            )
        same("curve: " + name, text, expected, notes=["it stays at"])
    begin = 0.999 * 0.004
    for name, head, lines, expected in (
        (
            "OFFA",
            fixed(1, 0, None, None, 0.004),
            [(0.0, 1.0), (0.002, 3.0)],
            [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)],
        ),
        (
            "OFFA and a first abscissa above 0",
            fixed(1, 0, None, None, 0.004),
            [(0.001, 1.0), (0.002, 3.0)],
            [(0.0, 0.0), (begin, 0.0), (0.005, 1.0), (0.006, 3.0)],
        ),
        (
            "OFFA and SFA",
            fixed(1, 0, 2.0, None, 0.002),
            [(0.0, 1.0), (0.001, 3.0)],
            [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)],
        ),
        (
            "OFFA and SFO",
            fixed(1, 0, None, 2.0, 0.004),
            [(0.0, 0.5), (0.002, 1.5)],
            [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)],
        ),
        (
            "OFFA and OFFO",
            fixed(1, 0, None, None, 0.004, 1.0),
            [(0.0, 0.0), (0.002, 2.0)],
            [(0.0, 0.0), (begin, 0.0), (0.004, 1.0), (0.006, 3.0)],
        ),
        (
            "OFFA, one point",
            fixed(1, 0, None, None, 0.004),
            [(0.0, 1.0)],
            [(0.0, 0.0), (begin, 0.0), (0.004, 1.0)],
        ),
        (
            "OFFA and a first ordinate of 0",
            fixed(1, 0, None, None, 0.004),
            [(0.0, 0.0), (0.002, 3.0)],
            [(0.0, 0.0), (begin, 0.0), (0.004, 0.0), (0.006, 3.0)],
        ),
    ):
        same(
            "curve: " + name,
            curve_deck(head, *points(*lines)),
            curve_deck(fixed(1), *points(*expected)),
            notes=["it stays at"],
        )
    same(
        "curve: it begins late",
        curve_deck(fixed(1), *points((0.004, 1.0), (0.02, 3.0))),
        curve_deck(fixed(1), *points((0.0, 1.0), (0.004, 1.0), (0.02, 3.0))),
        notes=["curve 1 begins after t = 0: it is constant before"],
    )
    motion = cards("BOUNDARY_PRESCRIBED_MOTION_NODE", fixed(15, 2, 0, 5)) + "\n"
    same(
        "a motion by a shifted curve",
        deck(
            more=motion
            + cards(
                "DEFINE_CURVE",
                fixed(5, 0, None, None, 0.004),
                *points((0.0, 0.2), (0.002, 0.5))
            )
        ),
        deck(
            more=motion
            + cards(
                "DEFINE_CURVE",
                fixed(5),
                *points((0.0, 0.0), (begin, 0.0), (0.004, 0.2), (0.006, 0.5))
            )
        ),
        notes=["it stays at"],
    )
    for name, head, lines, words in (
        (
            "SIDR 1",
            fixed(1, 1),
            written,
            "field SIDR: expected 0 or 2: dynamic relaxation is not available in this version",
        ),
        ("SIDR 3", fixed(1, 3), written, "field SIDR: expected an integer >= 0 and <= 2"),
        ("SFA below 0", fixed(1, 0, -1.0), written, "field SFA: expected a real number > 0"),
        (
            "an abscissa before the offset",
            fixed(1, 0, None, None, 0.004),
            points((-0.001, 1.0), (0.002, 1.0)),
            "field OFFA: expected a first abscissa >= 0",
        ),
        (
            "points in space",
            fixed(1, 0, 1, 1, 0, 0, -1),
            written,
            "field DATTYP: expected blank or 0",
        ),
        (
            "not increasing",
            fixed(1),
            points((0.0, 1.0), (0.002, 1.0), (0.002, 2.0)),
            "field A: expected an abscissa greater than that of the card before",
        ),
        (
            "decreasing",
            fixed(1),
            points((0.003, 1.0), (0.002, 1.0)),
            "field A: expected an abscissa greater",
        ),
        ("three columns", fixed(1), [long(0.0, 1.0, 2.0)], "text beyond column 40"),
        (
            "ten columns",
            fixed(1),
            [fixed(0.0, 1.0), fixed(1.0, 3.0)],
            "field A: expected a real number",
        ),
    ):
        refused("curve: " + name, curve_deck(head, *lines), words)


def supported():
    """Initial velocity in held directions: the support wins, one note with the number of
    nodes."""
    right = (
        SECTIONS["velocity"]
        + "\n*INITIAL_VELOCITY_NODE\n"
        + "\n".join(fixed(n, -0.5, 0.125) for n in (11, 12, 14, 15))
    )
    plain_deck = deck(velocity=right)
    note = ["initial velocity on fixed directions of 2 nodes: the supports win"]
    of_right = lambda keyword: SECTIONS["velocity"] + "\n" + keyword
    for name, changes, notes in (
        (
            "a part",
            dict(
                velocity=of_right(
                    cards("INITIAL_VELOCITY_GENERATION", fixed(2, 2, None, -0.5, 0.125), "")
                )
            ),
            note,
        ),
        (
            "a part set",
            dict(
                velocity=of_right(
                    cards("INITIAL_VELOCITY_GENERATION", fixed(12, 1, None, -0.5, 0.125), "")
                )
            ),
            note,
        ),
        (
            "a node set",
            dict(
                velocity=of_right(
                    cards("SET_NODE_LIST", fixed(8), fixed(11, 12, 13, 14, 15, 16))
                    + "\n"
                    + cards("INITIAL_VELOCITY", fixed(8), fixed(-0.5, 0.125))
                )
            ),
            note,
        ),
        (
            "nodes",
            dict(velocity=right + "\n" + fixed(13, -0.5, 0.125) + "\n" + fixed(16, 1.0)),
            note,
        ),
        (
            "TC",
            dict(
                support="",
                nodes=held_nodes(7, 13, 16),
                velocity=of_right(
                    cards("INITIAL_VELOCITY_GENERATION", fixed(2, 2, None, -0.5, 0.125), "")
                ),
            ),
            note,
        ),
        ("a velocity of 0", dict(velocity=right + "\n" + fixed(13, 0.0, 0.0)), []),
        (
            "one node",
            dict(velocity=right + "\n" + fixed(13, 0.0, 3.0)),
            ["fixed directions of 1 node: the supports win"],
        ),
    ):
        same("velocity on a support: " + name, deck(**changes), plain_deck, notes=notes)
    one = dict(support=cards("BOUNDARY_SPC_SET", fixed(1, None, 1)))
    same(
        "velocity on a support: along a free direction",
        deck(
            velocity=right + "\n" + fixed(13, 0.7, 0.25) + "\n" + fixed(16, None, 0.25), **one
        ),
        deck(
            velocity=right + "\n" + fixed(13, None, 0.25) + "\n" + fixed(16, None, 0.25), **one
        ),
        notes=["of 1 node:"],
    )
    same(
        "velocity on a support: all nodes",
        deck(velocity=cards("INITIAL_VELOCITY", "", fixed(1.0, -0.25))),
        deck(
            velocity=cards(
                "INITIAL_VELOCITY_NODE",
                *[fixed(n, 1.0, -0.25) for n in (1, 2, 3, 4, 5, 6, 11, 12, 14, 15)]
            )
        ),
        notes=note,
    )
    for name, changes, words in (
        (
            "two velocities",
            dict(velocity=right + "\n" + fixed(12, 7.0)),
            "node 12 gets a second, different initial velocity",
        ),
        (
            "two velocities on a support",
            dict(velocity=right + "\n" + fixed(13, 7.0) + "\n" + fixed(13, 8.0)),
            "node 13 gets a second, different initial velocity",
        ),
        (
            "a motion that contradicts it",
            dict(
                velocity=right,
                more=cards("BOUNDARY_PRESCRIBED_MOTION_NODE", fixed(15, 1, 0, 1)),
            ),
            "differs from that of its prescribed motion",
        ),
        (
            "no such node",
            dict(velocity=right + "\n" + fixed(77, 1.0)),
            "node 77 is not defined",
        ),
    ):
        refused("velocity: " + name, deck(**changes), words, problems=1)


def goes_on():
    """A run without *BIPACT_TIME goes on from its restart file to a later end, and to the same
    end with the card that says what was chosen."""
    restarts = cards("BIPACT_RESTART", fixed(50))
    late = SECTIONS["end"].replace(" 0.01", "0.012")
    folder, code, errors = run_text("early", deck(time="", more=restarts), "--quiet")
    check(code == 0, "a run with restart files: " + errors)
    for name, changes in (
        ("no card", dict(time="")),
        ("the card", dict(time="*BIPACT_TIME\n" + fixed("THETA", 0.5, 0.5))),
    ):
        text = deck(end=late, more=restarts, **changes)
        whole, code, errors = run_text("whole", text, "--quiet")
        check(code == 0, name + ": " + errors)
        shutil.rmtree(os.path.join(scenes.TMP, "later"), ignore_errors=True)
        shutil.copytree(folder, os.path.join(scenes.TMP, "later"))
        later, code, errors = run_text("later", text, "--quiet", "--restart", "latest")
        check(code == 0, "%s, from a restart file: %s" % (name, errors))
        check(rows_of(later) == rows_of(whole), name + ": other tables by a restart")


def no_time_card():
    """Without *BIPACT_TIME: THETA where there is contact and neither GAMMA nor BETA, else
    NEWMARK."""
    theta = ["no *BIPACT_TIME: the scheme is THETA with theta = xi = 1/2"]
    warning = [
        "no *BIPACT_TIME, but GAMMA or BETA: it is NEWMARK",
        "WARNING energy-growth",
    ]
    newmark = deck(time="*BIPACT_TIME\n   NEWMARK")
    dynamics = lambda *x: cards("CONTROL_IMPLICIT_DYNAMICS", fixed(1, *x))
    wall = cards("RIGIDWALL_PLANAR", "", fixed(-9.0, None, None, 9.0))
    free = dict(
        contact="",
        tables=SECTIONS["tables"]
        .replace("*DATABASE_RCFORC\n     0.001\n*DATABASE_SLEOUT\n     0.001\n", "")
        .replace("\n*DATABASE_NCFORC\n     0.001", ""),
    )
    for name, changes, plain_deck, notes in (
        ("neither", dict(time=""), deck(), theta),
        ("zeros", dict(time="", dynamics=dynamics("0.0", "0.0")), deck(), theta),
        (
            "zeros by parameters",
            dict(
                time="",
                dynamics="*PARAMETER\n" + pair("Rg", "0.0") + "\n" + dynamics("&g", "&g"),
            ),
            deck(),
            theta,
        ),
        ("GAMMA", dict(time="", dynamics=dynamics("0.5")), newmark, warning),
        ("BETA", dict(time="", dynamics=dynamics(None, "0.25")), newmark, warning),
        ("both", dict(time="", dynamics=dynamics("0.5", "0.25")), newmark, warning),
        (
            "both, not those of the scheme",
            dict(time="", dynamics=dynamics(0.6, 0.38)),
            deck(time="*BIPACT_TIME\n   NEWMARK", dynamics=dynamics(0.6, 0.38)),
            warning,
        ),
        (
            "no contact",
            dict(time="", **free),
            deck(time="*BIPACT_TIME\n   NEWMARK", **free),
            [],
        ),
        (
            "no contact, GAMMA",
            dict(time="", dynamics=dynamics("0.5"), **free),
            deck(time="*BIPACT_TIME\n   NEWMARK", **free),
            [],
        ),
        ("a wall", dict(time="", more=wall, **free), deck(more=wall, **free), theta),
        ("a blank card", dict(time="*BIPACT_TIME\n\n"), deck(), None),
        (
            "node to surface",
            dict(time="", contact=SECTIONS["contact"].replace("SURFACE_TO", "NODE_TO")),
            deck(contact=SECTIONS["contact"].replace("SURFACE_TO", "NODE_TO")),
            theta,
        ),
        (
            "a single surface",
            dict(
                time="",
                contact=cards(
                    "CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", fixed(None, None, None, None, 0.3)
                ),
            ),
            deck(
                contact=cards(
                    "CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", fixed(None, None, None, None, 0.3)
                )
            ),
            theta,
        ),
    ):
        same("no time card: " + name, deck(**changes), plain_deck, notes=notes)
    same(
        "gamma and beta of another scheme",
        deck(dynamics=dynamics(0.6, 0.38)),
        notes=["GAMMA and BETA have no effect: they are none of scheme THETA"],
    )
    same("gamma and beta by default", deck(dynamics=dynamics(0.5, 0.25)), notes=[])
    goes_on()
    refused(
        "no time card: unstable",
        deck(time="", dynamics=dynamics(0.5, 0.1)),
        "field BETA: expected BETA >= (GAMMA + 1/2)^2/4",
        problems=1,
    )
    refused(
        "time card: static",
        deck(dynamics=cards("CONTROL_IMPLICIT_DYNAMICS", fixed(0))),
        "has no place in a static analysis",
        problems=1,
    )
    refused(
        "no time card: alpha",
        deck(time="", dynamics=dynamics(0.5, 0.25, 0, 0, 0, 0, -0.5)),
        "field ALPHA",
        problems=1,
    )


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
