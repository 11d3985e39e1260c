"""Random expressions of *PARAMETER_EXPRESSION against an own evaluator: Python's grammar reads
the same text (the module ast), the rules of Fortran for integers and reals are written here.
The values come back from the echo deck, where they stand with all their digits."""

import ast
import math
import os
import random
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import plain
from scenes import at_most, check, finish, run_text, show

LARGEST = 2147483647
NAMES = {
    "n": 3,
    "m": -7,
    "k": 12,
    "half": 0.5,
    "c": 1103.25,
    "eps": 1.0e-3,
    "v0": -2.75,
    "sin1": 4.5,
}
HEAD = "*PARAMETER\n" + "\n".join(
    ("I" if isinstance(v, int) else "R") + name.ljust(9) + repr(v).rjust(10)
    for name, v in NAMES.items()
)


class Wrong(Exception):
    """What is wrong with an expression, and at which character (from 0)."""

    def __init__(self, at, words):
        super().__init__(words)
        self.at, self.words = at, words


class Unwanted(Exception):
    """A value that no deck takes, or too near to a limit."""


def quotient(a, b):
    """An integer division of Fortran: towards 0."""
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


def nearest(x):
    """Rounded half away from 0."""
    whole = math.floor(abs(x))
    return int(math.copysign(whole + (abs(x) - whole >= 0.5), x))


REAL = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": math.log,
}
DOMAIN = {
    "asin": (lambda x: abs(x) <= 1, "ASIN takes a number from -1 to 1"),
    "acos": (lambda x: abs(x) <= 1, "ACOS takes a number from -1 to 1"),
    "sqrt": (lambda x: x >= 0, "SQRT takes a number >= 0"),
    "log": (lambda x: x > 0, "LOG takes a number > 0"),
    "exp": (lambda x: x < 340, "EXP takes a number below 345"),
}


def call(name, at, a):
    """Value of a function."""
    integers = all(isinstance(x, int) for x in a)
    if name in DOMAIN and not DOMAIN[name][0](a[0]):
        raise Wrong(at, DOMAIN[name][1])
    if name in REAL:
        return REAL[name](float(a[0]))
    if name == "mod":
        if a[1] == 0:
            raise Wrong(at, "MOD with a divisor of 0")
        return (
            a[0] - b * a[1] if integers and (b := quotient(*a)) is not None else math.fmod(*a)
        )
    if name == "atan2":
        if a[0] == 0 and a[1] == 0:
            raise Wrong(at, "ATAN2 of 0 and 0")
        return math.atan2(float(a[0]), float(a[1]))
    if name in ("int", "nint"):
        if abs(a[0]) > LARGEST:
            raise Wrong(at, name.upper() + " of a number beyond 2147483647")
        return math.trunc(a[0]) if name == "int" else nearest(a[0])
    found = {"abs": lambda: abs(a[0]), "min": lambda: min(a), "max": lambda: max(a)}[name]()
    return found if integers else float(found)


def operate(kind, at, a, b):
    """Value of an operation of two numbers."""
    integers = isinstance(a, int) and isinstance(b, int)
    if kind is ast.Div:
        if b == 0:
            raise Wrong(at, "division by zero")
        value = quotient(a, b) if integers else a / b
    elif kind is ast.Pow:
        if a == 0 and b <= 0:
            raise Wrong(at, "0 to a power that is not above 0")
        if a < 0 and b != math.floor(b):
            raise Wrong(at, "a negative number to a broken power is not real")
        if integers and b < 0:
            raise Wrong(at, "an integer to a negative power")
        if a != 0 and b * math.log(abs(a)) > 230:
            raise Unwanted
        value = a ** b if integers else float(a) ** float(b)
    else:
        value = {ast.Add: a + b, ast.Sub: a - b, ast.Mult: a * b}[kind]
    if integers and abs(value) > LARGEST:
        raise Wrong(at, "the integer is beyond 2147483647")
    if abs(value) > 1.0e100 or (value != 0 and abs(value) < 1.0e-60):
        raise Unwanted
    return value


def value_of(text, tree):
    """Value of a tree, from left to right."""
    if isinstance(tree, ast.Constant):
        if isinstance(tree.value, int) and tree.value > LARGEST:
            raise Wrong(tree.col_offset, "is no number, or too large")
        return tree.value
    if isinstance(tree, ast.Name):
        name = tree.id.lower()
        if name not in NAMES and name != "pi":
            raise Wrong(tree.col_offset, 'undefined parameter "%s"' % name.upper())
        return math.pi if name == "pi" else NAMES[name]
    if isinstance(tree, ast.UnaryOp):
        value = value_of(text, tree.operand)
        return -value if isinstance(tree.op, ast.USub) else value
    if isinstance(tree, ast.Call):
        values = [value_of(text, x) for x in tree.args]
        return call(tree.func.id.lower(), tree.func.col_offset, values)
    a, b = value_of(text, tree.left), value_of(text, tree.right)
    between = text[tree.left.end_col_offset : tree.right.col_offset]
    at = tree.left.end_col_offset + re.match(r"[ )]*", between).end()
    return operate(type(tree.op), at, a, b)


def evaluate(text):
    """Value of a text."""
    return value_of(text, ast.parse(text, mode="eval").body)


def constant(rng):
    kind = rng.randrange(6)
    if kind <= 1:
        return str(rng.choice((0, 1, 2, 3, 4, 5, 7, 10, 16, 100, 999)))
    if kind == 2:
        return repr(round(rng.uniform(0, 10), rng.randrange(5)))
    if kind == 3:
        return rng.choice((".5", "1.", "0.", "2.5E0", "1.e-1", "3.E+2", "25e-2", "1E1"))
    return rng.choice(list(NAMES) + ["pi", "PI", "C", "Half"])


def expression(rng, depth):
    """A random text, with parentheses where they are needed and where they are not."""
    if depth == 0:
        return constant(rng)
    kind = rng.randrange(10)
    blank = rng.choice(("", "", " "))
    if kind < 6:
        operator = rng.choice(("+", "-", "*", "/", "+", "-", "*", "/", "**"))
        left, right = expression(rng, depth - 1), expression(rng, depth - 1)
        if operator == "**" and rng.random() < 0.7:
            right = rng.choice(("2", "3", "-1", "0.5", "(-2)", "2.0", "n"))
        return left + blank + operator + blank + right
    if kind == 6:
        return rng.choice("-+") + blank + expression(rng, depth - 1)
    if kind == 7:
        return "(" + blank + expression(rng, depth - 1) + blank + ")"
    name = rng.choice(list(REAL) + ["abs", "min", "max", "mod", "atan2", "int", "nint"])
    count = {"min": rng.choice((2, 2, 3)), "max": 2, "mod": 2, "atan2": 2}.get(name, 1)
    arguments = ("," + blank).join(expression(rng, depth - 1) for _ in range(count))
    return rng.choice((name, name.upper())) + blank + "(" + arguments + ")"


def draw(rng, wrong):
    """(text, value or Wrong) of the wanted kind."""
    while True:
        text = expression(rng, rng.randrange(1, 6))
        if len(text) > 400:
            continue
        try:
            value = evaluate(text)
            if wrong or abs(value) > 1.0e70:
                continue
            return text, value
        except Unwanted:
            continue
        except Wrong as found:
            if wrong:
                return text, found


def cards_of(kind, number, text, rng):
    """Cards of an expression, over several lines where it is long: (cards, line and column of
    every character)."""
    name = "%sx%d" % (kind, number)
    first = (name + ",") if rng.random() < 0.3 else name.ljust(10)
    lines, places, at = [], [], 0
    while at < len(text) or not lines:
        room = 70 if len(text) - at > 70 or rng.random() < 0.3 else len(text)
        piece = text[at : at + room]
        if room < len(text):
            piece = cut(text, at, room)
        head = first if not lines else " " * 10
        places += [(len(lines), len(head) + i + 1) for i in range(len(piece))]
        lines.append(head + piece)
        at += len(piece)
    return lines, places


def cut(text, at, room):
    """A piece that ends between two tokens: the reader puts a blank between lines."""
    end = min(at + room, len(text))
    while end < len(text) and end > at + 1 and not re.match(r"[()]", text[end - 1]):
        end -= 1
    if end <= at + 1 or text[end : end + 1] == "*":
        return text[at:]
    return text[at:end]


def random_values():
    """300 random expressions: the value that Python finds, to 1e-15 (an operation of each side
    is rounded alike; the functions are those of one library), integers exactly."""
    rng = random.Random(20260105)
    drawn = [draw(rng, False) for _ in range(300)]
    early, points = [HEAD, "*PARAMETER_EXPRESSION"], ["*DEFINE_CURVE", plain.fixed(99)]
    for k, (text, value) in enumerate(drawn):
        early += cards_of("I" if isinstance(value, int) else "R", k, text, rng)[0]
        points.append("%d.0,&x%d" % (k, k))
    folder, code, errors = run_text(
        "values", plain.deck(early="\n".join(early), more="\n".join(points)), "--quiet"
    )
    check(code == 0, errors)
    if code != 0:
        return
    with open(os.path.join(folder, "deck.echo.k")) as echo:
        found = re.findall(r"(?m)^(\d+)\.0,([^,]*),$", echo.read())
    check(len(found) == len(drawn), "%d values came back" % len(found))
    worst = 0.0
    for (k, back), (text, value) in zip(found, drawn):
        error = abs(float(back) - value) / (abs(value) or 1.0)
        worst = max(worst, error)
        check(
            error <= (0.0 if isinstance(value, int) else 1.0e-15),
            "%s = %r, found %s" % (text, value, back),
        )
    at_most(worst, 1.0e-15, "largest relative difference")
    show(
        "operators and functions: %d"
        % sum(len(re.findall(r"[-+*/]|\w+ ?\(", t)) for t, _ in drawn)
    )


def refusals(name, wrong):
    """Expressions that are wrong, fifteen a deck: (text, character, words); each is refused at
    its character."""
    rng = random.Random(11)
    for first in range(0, len(wrong), 15):
        part = wrong[first : first + 15]
        early, expected = [HEAD, "*PARAMETER_EXPRESSION"], []
        line = plain.deck(early="*HERE").split("*HERE")[0].count("\n") + HEAD.count("\n") + 2
        for k, (text, at, words) in enumerate(part):
            cards, places = cards_of("R", k, text, rng)
            places.append((len(cards) - 1, len(cards[-1]) + 1))
            expected.append((line + 1 + places[at][0], places[at][1], words, text))
            early += cards
            line += len(cards)
        _, code, errors = run_text(name, plain.deck(early="\n".join(early)), "--quiet")
        check(code == 2, "%s: exit code %d" % (name, code))
        for row, column, words, text in expected:
            place = ":%d, column %d: *PARAMETER_EXPRESSION card" % (row, column)
            said = [x for x in errors.split("\n") if place in x]
            check(
                said and words in said[0],
                '"%s": no "%s" at %d, %d' % (text, words, row, column),
            )
        check("%d problem" % len(part) in errors, "%s: %s" % (name, errors))


def number(rng):
    """(text, value) of a number as programs write them: digits on one or both sides of a point,
    exponents by E, e, D, d or a bare sign."""
    digits = "".join(
        rng.choice("0123456789") for _ in range(rng.choice((1, 2, 3, 6, 15, 16, 17, 18)))
    )
    point = rng.randrange(len(digits) + 1)
    mantissa = rng.choice(("", "", "-", "+")) + digits[:point] + "." + digits[point:]
    power = rng.randrange(-30, 31)
    exponent = rng.choice(("", "E%d", "e%+d", "D%+03d", "d%d", "%+d"))
    return mantissa + (exponent and exponent % power), float(
        mantissa + (exponent and "e%d" % power)
    )


def random_numbers():
    """600 numbers in all the forms that the format knows: each is the double that is nearest to
    it, as Python's is."""
    rng = random.Random(20260107)
    drawn = [
        (t, v)
        for t, v in (number(rng) for _ in range(900))
        if len(t) <= 24 and (v == 0.0 or 1.0e-60 < abs(v) < 1.0e60)
    ][:600]
    early = ["*PARAMETER"] + ["Rp%d,%s" % (k, t) for k, (t, _) in enumerate(drawn)]
    early += ["*PARAMETER_EXPRESSION"] + ["Rq%d,p%d*1.0" % (k, k) for k in range(len(drawn))]
    points = ["*DEFINE_CURVE", plain.fixed(99)] + [
        "%d.0,&q%d" % (k, k) for k in range(len(drawn))
    ]
    folder, code, errors = run_text(
        "numbers", plain.deck(early="\n".join(early), more="\n".join(points)), "--quiet"
    )
    check(code == 0, errors)
    with open(os.path.join(folder, "deck.echo.k")) as echo:
        found = re.findall(r"(?m)^\d+\.0,([^,]*),$", echo.read())
    check(len(found) == len(drawn) > 500, "%d values came back" % len(found))
    for back, (text, value) in zip(found, drawn):
        check(float(back) == value, "%s is %r, found %s" % (text, value, back))


def random_faults():
    """150 random expressions that divide by zero, leave the domain of a function or the
    integers, or name an unknown: refused at the operator, the function or the name. 150 more
    with a character that is none of theirs: refused there."""
    rng = random.Random(20260106)
    wrong = []
    while len(wrong) < 150:
        text, found = draw(rng, True)
        wrong.append((text, found.at, found.words))
    refusals("faults", wrong)
    wrong = []
    while len(wrong) < 150:
        text, _ = draw(rng, False)
        token = r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|\w+|\*\*|\S"
        ends = [0] + [m.end() for m in re.finditer(token, text)]
        at = rng.choice([e for e in ends if not re.match(r" ?\(", text[e:])])
        wrong.append((text[:at] + rng.choice("%^=]?#;{!'") + text[at:], at, "expected "))
    refusals("characters", wrong)


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
