"""Expressions and local parameters (see preprocessors.py; random ones are in
expressions.py)."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from plain import SECTIONS, deck, fixed, pair, refused, remove_files, same
from scenes import finish


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
        ("1.0/2.0", 1.0 / 2.0),
        ("1.0/3.0", 1.0 / 3.0),
        ("sqrt(2.0)/7", 2.0**0.5 / 7),
        ("2.0**-1", 0.5),
        ("(1+2)/(3.0*2)", 3 / 6.0),
        ("1.e-1+.4D0", 0.1 + 0.4),
        ("5/2", 2.0),
        ("-5/2+3", 1.0),
        ("pi/4", 3.141592653589793 / 4),
        ("2*-3+6.5", 0.5),
        ("--.5", 0.5),
        ("+.5", 0.5),
        ("2.0-+1.5", 0.5),
        ("1.0-3*.1", 1.0 - 3 * 0.1),
        ("2**3**2/1024.0", 0.5),
        ("-2**2+4.5", 0.5),
        ("(-2)**2/8.", 0.5),
        ("max(0.25, .5, 1/3)", 0.5),
        ("mod(7.25, 2.25)", 0.5),
        ("nint(2.5)/6.0", 0.5),
        ("int(-2.9)+2.5", 0.5),
        ("atan2(1.0,1.0)*2/pi", 0.5),
        ("min(3,2)/4.", 0.5),
        ("abs(-4)/8.0", 0.5),
        ("7-3-3.5", 0.5),
        ("16/4/8.0", 0.5),
        ("1.0e0 * ( 5.0e-1 )", 0.5),
        ("1e-320*0+0.5", 0.5),
    ):
        same(
            "expression " + text,
            deck(
                early="*PARAMETER_EXPRESSION\n" + expression("R t", text),
                section=with_value("&t"),
            ),
            deck(section="*SECTION_SHELL\n1,13,,4\n%r," % value),
            notes=None,
        )
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
        (
            "over three lines",
            expression("Rt", "(width")
            + "\n"
            + expression("", "+width")
            + "\n"
            + expression("", ")"),
        ),
        (
            "a number broken at the end of a line",
            expression("Rt", "width +") + "\n" + expression("", "width"),
        ),
        (
            "a line that begins with a comma",
            expression("Rt", "max(width*two") + "\n" + expression("", ",0.0)"),
        ),
        ("over twenty lines", expression("Rt", "0.5") + ("\n" + expression("", "+0.0")) * 19),
        ("a comment in it", expression("Rt", "width") + "\n$ twice\n" + expression("", "*two")),
        (
            "a parameter of a function's name",
            expression("Rsin", "0.5") + "\n" + expression("Rt", "sin + sin(0.0)"),
        ),
        ("a parameter called pi", expression("Rpi", "0.5") + "\n" + expression("Rt", "pi")),
        ("a parameter called e", expression("Re", "0.5") + "\n" + expression("Rt", "e")),
        (
            "a name of nine characters",
            expression("Rlongname1", "0.5") + "\n" + expression("Rt", "longname1"),
        ),
        (
            "a name with _ and digits",
            expression("Ra_1", "0.5") + "\n" + expression("Rt", "a_1*1"),
        ),
        (
            "integer division",
            expression("Ihalf", "5/two") + "\n" + expression("Rt", "half*width"),
        ),
        (
            "a whole real for an integer",
            expression("Itwo_", "4.0/two") + "\n" + expression("Rt", "two_*width"),
        ),
        ("a long line", expression("Rt", "width" + "*1.0" * 60 + "*two")),
    ):
        same(
            "expression: " + name,
            deck(early=base + "\n*PARAMETER_EXPRESSION\n" + text, section=with_value("&t")),
            notes=["remainder is dropped"] if "division" in name else None,
        )
    same(
        "an expression in long form",
        deck(
            early="*PARAMETER_EXPRESSION+\n" + "R t".ljust(20) + "1.0/2",
            section=with_value("&t"),
        ),
        notes=[],
    )
    same(
        "a sign before a name",
        deck(
            early="*PARAMETER_EXPRESSION\n" + expression("R t", "-1.0/2"),
            section=with_value("-&t"),
        ),
        notes=[],
    )
    same(
        "-D instead of an expression",
        deck(
            early="*PARAMETER_EXPRESSION\n" + expression("R t", "3.0*x"),
            section=with_value("&t"),
        ),
        options=["-D", "t=0.5"],
        notes=[],
    )
    same(
        "-D of a name in an expression",
        deck(
            early="*PARAMETER\n"
            + pair("Rx", "9.0")
            + "\n*PARAMETER_EXPRESSION\n"
            + expression("R t", "x/4"),
            section=with_value("&t"),
        ),
        options=["-D", "x=2.0"],
        notes=[],
    )
    same(
        "an integer parameter",
        deck(
            early="*PARAMETER_EXPRESSION\n"
            + expression("In", "2**4-3")
            + "\n"
            + expression("Im", "n+3"),
            held="*SET_NODE_LIST\n" + fixed(1) + "\n" + fixed("&n", "&m"),
        ),
        notes=[],
    )
    same(
        "a real parameter that is whole",
        deck(
            early="*PARAMETER_EXPRESSION\n" + expression("Rn", "26/2.0"),
            held="*SET_NODE_LIST\n" + fixed(1) + "\n" + fixed("&n", 16),
        ),
        notes=[],
    )
    for name, text, at, words in (
        ("division by zero", "1.0/(2-2)", 3, "division by zero"),
        ("an integer by zero", "7/0", 1, "division by zero"),
        ("mod by zero", "mod(5,0)", 0, "MOD with a divisor of 0"),
        ("not finite", "exp(400.)", 0, "EXP takes"),
        ("too large", "1e100*1e100", 5, "the result is too large"),
        ("zero to a negative power", "0.0**-1", 3, "0 to a power"),
        ("an integer to a negative power", "2**-1", 1, "an integer to a negative power"),
        ("too large an integer", "65536*65536", 5, "the integer is beyond 2147483647"),
        ("an unknown name", "1.0+sinn", 4, 'undefined parameter "SINN"'),
        ("an unknown function", "sinn(1.0)", 0, 'unknown function "SINN"'),
        ("a function without arguments", "2*sin", 2, 'undefined parameter "SIN"'),
        ("nothing in parentheses", "2*()", 3, "expected a number, a name or a parenthesis"),
        ("an open parenthesis", "2*(1+3", 2, "the parenthesis is not closed"),
        ("too many arguments", "sin(1.0,2.0)", 0, "SIN takes 1 argument, found 2"),
        ("too few", "mod(1)", 0, "MOD takes 2 arguments, found 1"),
        ("an operator too many", "2**/3", 3, "expected a number"),
        ("a power apart", "2* *3", 3, "expected a number"),
        ("a power of C", "2^3", 1, "expected an operator or the end"),
        ("two numbers", "2 3", 2, "expected an operator"),
        ("two points", "1.2.3", 0, "is no number"),
        ("an equals sign", "=2", 0, "expected a number"),
        ("text after it", "2.0 of 3", 4, "expected an operator or the end"),
        ("a word", "'a'", 0, "expected a number"),
        ("a root", "sqrt(-1.0)", 0, "SQRT takes a number >= 0"),
        ("an arc", "1+asin(1.5)", 2, "ASIN takes a number from -1 to 1"),
        ("a name after a number", "2dt", 1, "expected an operator"),
        ("an underscore", "_a", 0, 'undefined parameter "_A"'),
        ("a sign alone", "2*-", 2, "the expression ends where a value should follow"),
        ("nothing", "", 0, "the expression ends where a value should follow"),
        ("a percent sign", "5%2", 1, "expected an operator"),
        ("a bracket", "[1]", 0, "expected a number"),
        ("an angle of no vector", "atan2(0,0.0)", 0, "ATAN2 of 0 and 0"),
    ):
        column = 11 + at
        refused(
            "expression: " + name,
            deck(
                early="*PARAMETER_EXPRESSION\n" + expression("R t", text),
                section=with_value("0.5"),
            ),
            (
                ":13, column %d: *PARAMETER_EXPRESSION card 1: " % column
                if text
                else "*PARAMETER_EXPRESSION card 1: "
            ),
            words,
            problems=1,
        )
    one = "*PARAMETER_EXPRESSION\n"
    for name, early, words in (
        (
            "the second line",
            [expression("R t", "1.0+"), expression("", " 2.0/0")],
            (":14, column 15: ", "division by zero"),
        ),
        (
            "more than twenty lines",
            [expression("Rt", "0.5")] + 20 * [expression("", "+0.0")],
            ("*PARAMETER_EXPRESSION card 1", "20 lines"),
        ),
        (
            "an integer that is none",
            [expression("I n", "5/2.0")],
            ("expected an integer, the value is 2.5",),
        ),
        (
            "an integer beyond all integers",
            [expression("I n", "3.0e100/2")],
            ("expected an integer, the value is 1.5E100",),
        ),
        (
            "a name that comes later",
            [expression("R t", "2*u"), expression("R u", "1.0")],
            ('undefined parameter "U"',),
        ),
        ("its own name", [expression("R t", "t+1")], ('undefined parameter "T"',)),
        (
            "twice",
            [expression("R t", "1"), expression("R t", "1")],
            ("parameter T is defined twice",),
        ),
        ("a tab", [expression("R t", "1+\t2")], ("*PARAMETER_EXPRESSION",)),
        (
            "a word in it",
            ["Cw," + "THETA", one + expression("R t", "1+w")],
            ('"W" is a word, not a number',),
        ),
    ):
        head = "*PARAMETER\n" if early[0].startswith("C") else one
        text = deck(early=head + "\n".join(early), section=with_value("0.5"))
        refused("expression: " + name, text, *words, problems=1)


LOCAL = "*PARAMETER_LOCAL\n"
GLOBAL = "*PARAMETER\n"


def local_parameters():
    """*PARAMETER_LOCAL: for one file and what it includes below; before one of all files."""
    section = with_value("&t")
    for name, changes, files in (
        ("in the main deck", dict(early=LOCAL + pair("Rt", "0.5"), section=section), {}),
        (
            "by an expression",
            dict(
                early="*PARAMETER_EXPRESSION_LOCAL\n" + expression("Rt", "1.0/2"),
                section=section,
            ),
            {},
        ),
        (
            "in an include",
            dict(section="*INCLUDE\ns.k"),
            {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section},
        ),
        (
            "seen below",
            dict(early=LOCAL + pair("Rt", "0.5"), section="*INCLUDE\ns.k"),
            {"s.k": section},
        ),
        (
            "before one of all files",
            dict(early=GLOBAL + pair("Rt", "9.0"), section="*INCLUDE\ns.k"),
            {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section},
        ),
        (
            "before one of all files, in the same file",
            dict(
                early=GLOBAL + pair("Rt", "9.0") + "\n" + LOCAL + pair("Rt", "0.5"),
                section=section,
            ),
            {},
        ),
        (
            "before one of all files that comes later",
            dict(
                early=LOCAL + pair("Rt", "0.5"),
                section=section,
                more=GLOBAL + pair("Rt", "9.0"),
            ),
            {},
        ),
        (
            "before one of all files between it and its use",
            dict(
                early=LOCAL + pair("Rt", "0.5") + "\n" + GLOBAL + pair("Rt", "9.0"),
                section=section,
            ),
            {},
        ),
        (
            "not seen in the file above",
            dict(early=GLOBAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k", section=section),
            {"p.k": LOCAL + pair("Rt", "9.0") + "\n*END\n"},
        ),
        (
            "not seen in a file beside",
            dict(early=GLOBAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k\ns.k", section=""),
            {"p.k": LOCAL + pair("Rt", "9.0"), "s.k": section},
        ),
        (
            "not seen above its line",
            dict(section="*INCLUDE\ns.k", early=GLOBAL + pair("Rt", "0.5")),
            {"s.k": section + "\n" + LOCAL + pair("Rt", "9.0")},
        ),
        (
            "of the same name in two files",
            dict(section="*INCLUDE\ns.k\nq.k"),
            {
                "s.k": LOCAL + pair("Rt", "0.5") + "\n" + section,
                "q.k": LOCAL + pair("Rt", "2.0") + "\n*DATABASE_RWFORC\n" + fixed("&t"),
            },
        ),
        (
            "the inner of two",
            dict(early=LOCAL + pair("Rt", "9.0"), section="*INCLUDE\ns.k"),
            {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section},
        ),
        (
            "the outer of two after the inner file",
            dict(early=LOCAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k", section=section),
            {"p.k": LOCAL + pair("Rt", "9.0")},
        ),
        (
            "the outer of two before the inner line",
            dict(early=LOCAL + pair("Rt", "0.5"), section="*INCLUDE\ns.k"),
            {"s.k": section + "\n" + LOCAL + pair("Rt", "9.0")},
        ),
        (
            "of three files",
            dict(early=LOCAL + pair("Rt", "9.0"), section="*INCLUDE\na.k"),
            {
                "a.k": LOCAL + pair("Rt", "0.5") + "\n*INCLUDE\nb.k",
                "b.k": "*INCLUDE\nc.k",
                "c.k": section,
            },
        ),
        (
            "in an expression",
            dict(early=GLOBAL + pair("Rhalf", "9.0"), section="*INCLUDE\ns.k"),
            {
                "s.k": LOCAL
                + pair("Rhalf", "0.25")
                + "\n*PARAMETER_EXPRESSION_LOCAL\n"
                + expression("Rt", "2*half")
                + "\n"
                + section
            },
        ),
        (
            "from one of all files of the same name",
            dict(
                early=GLOBAL
                + pair("Rt", "0.25")
                + "\n*PARAMETER_EXPRESSION_LOCAL\n"
                + expression("Rt", "2*t"),
                section=section,
            ),
            {},
        ),
        (
            "of all files from an include",
            dict(early="*INCLUDE\np.k", section=section),
            {
                "p.k": LOCAL
                + pair("Rh", "1.0")
                + "\n*PARAMETER_EXPRESSION\n"
                + expression("Rt", "h/2")
            },
        ),
        (
            "a word",
            dict(
                early=LOCAL + pair("Cw", "MECH"),
                held="*SET_NODE_LIST\n"
                + fixed(1, None, None, None, None, "&w")
                + "\n"
                + fixed(13, 16),
            ),
            {},
        ),
    ):
        same(
            "local: " + name,
            deck(**changes),
            files=files,
            notes=None if "two files" in name else [],
        )
        remove_files(files)
    files = {"s.k": LOCAL + pair("Rt", "0.5") + "\n" + section}
    same(
        "-D leaves a local parameter of an include",
        deck(
            early=GLOBAL + pair("Rt", "0.3") + "\n*DATABASE_RWFORC\n" + fixed("&t"),
            section="*INCLUDE\ns.k",
        ),
        files=files,
        options=["-D", "t=9.0"],
        notes=None,
    )
    refused(
        "-D of a local parameter of an include",
        deck(section="*INCLUDE\ns.k"),
        "-D t=9.0: the deck has no such parameter",
        files=files,
        options=["-D", "t=9.0"],
        problems=1,
    )
    remove_files(files)
    same(
        "-D of a local parameter",
        deck(early=LOCAL + pair("Rt", "9.0"), section=section),
        options=["-D", "t=0.5"],
        notes=[],
    )
    for name, changes, files, words in (
        (
            "twice",
            dict(early=LOCAL + pair("Rt", "0.5", "Rt", "0.5"), section=section),
            {},
            "parameter T is defined twice; the first is at",
        ),
        (
            "used above its line",
            dict(section=section, more=LOCAL + pair("Rt", "0.5")),
            {},
            'undefined parameter "&t"',
        ),
        (
            "used in the file above",
            dict(early="*INCLUDE\np.k", section=section),
            {"p.k": LOCAL + pair("Rt", "0.5")},
            'undefined parameter "&t"',
        ),
        (
            "used in a file beside",
            dict(early="*INCLUDE\np.k\ns.k", section=""),
            {"p.k": LOCAL + pair("Rt", "0.5"), "s.k": section},
            'undefined parameter "&t"',
        ),
        (
            "one of all files twice",
            dict(early=GLOBAL + pair("Rt", "0.5") + "\n*INCLUDE\np.k", section=section),
            {"p.k": GLOBAL + pair("Rt", "0.5")},
            "parameter T is defined twice",
        ),
    ):
        refused("local: " + name, deck(**changes), words, files=files, problems=1)
        remove_files(files)


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
