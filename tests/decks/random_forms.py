"""The plain scene in random legal forms: cards by commas, in long form, values at the left of
their columns or by parameters, headings, comments, blank lines, other orders of keywords,
blocks in included files. Every one must give the tables of the plain deck in every digit."""

import os
import random
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import plain
from plain import SECTIONS, same
from scenes import finish

# Widths of the fields of each card where they are not 10; the last card repeats.
WIDTHS = {
    "NODE": [(8, 16, 16, 16, 8, 8)],
    "ELEMENT_SHELL": [(8,) * 10],
    "DEFINE_CURVE": [(10,) * 8, (20, 20)],
    "PART": ["text", (10,) * 8],
    "TITLE": ["text"],
}
TITLED = ("SECTION_SHELL", "MAT_ELASTIC", "SET_NODE_LIST", "SET_PART_LIST", "DEFINE_CURVE")
NUMBERED = ("BOUNDARY_SPC_SET", "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE")
WORDS = ("SCHEME",)


class Block:
    """A keyword with its cards, each a text or a list of values; long: in long form."""

    def __init__(self, text):
        lines = text.split("\n")
        self.name, self.long, self.head = lines[0][1:], False, None
        shapes = WIDTHS.get(self.name, [(10,) * 8])
        self.cards = []
        for k, line in enumerate(lines[1:]):
            shape = shapes[k % 2 if self.name == "PART" else min(k, len(shapes) - 1)]
            if shape == "text":
                self.cards.append((shape, line))
                continue
            values, at = [], 0
            for width in shape:
                values.append(line[at : at + width].strip())
                at += width
            self.cards.append((shape, values))

    def lines(self, rng, level):
        """The lines, each card in a form of its own."""
        name = self.name
        if self.head is not None:
            name += "_TITLE" if self.name in TITLED else "_ID"
        if level and rng.random() < 0.3:
            name = name.lower()
        out = ["*" + name + ("+" if self.long else "")]
        if self.head is not None:
            out.append(self.head)
        for shape, values in self.cards:
            if level and rng.random() < 0.15:
                out.append(rng.choice(("$", "$ a remark, *NODE", "$#   a       b")))
            out.append(values if shape == "text" else self.card(rng, level, shape, values))
        return out

    def card(self, rng, level, shape, values):
        used = max([k + 1 for k, v in enumerate(values) if v] or [0])
        if level and used and rng.random() < 0.25:
            blank = rng.choice(("", " ", "   "))
            return ("," + blank).join(values[:used]) + ","
        line = ""
        for width, value in zip((20,) * len(shape) if self.long else shape, values):
            left = level and len(value) < width and rng.random() < 0.15
            # Values that touch could be one value as a whole: only what is alone goes left.
            left = left and line[-1:] in ("", " ")
            line += value.ljust(width) if left else value.rjust(width)
        return line.rstrip() if rng.random() < 0.8 else line


def with_parameters(rng, blocks):
    """Some values by parameters: (early lines)."""
    pairs, expressions = [], []
    for block in blocks:
        for shape, values in block.cards:
            if shape == "text":
                continue
            for k, value in enumerate(values):
                if not value or not value[-1:].isdigit() or rng.random() > 0.04:
                    continue
                name = "p%d" % (len(pairs) + len(expressions))
                kind = "R" if "." in value or "e" in value else "I"
                sign = "-" if value.startswith("-") else ""
                size = value.lstrip("-")
                if rng.random() < 0.5:
                    pairs.append((kind + name, size))
                else:
                    form = rng.choice(("%s", "(%s)", "%s*1", "max(%s,%s)", "--%s", "%s**1"))
                    expressions.append((kind + name, form.replace("%s", size)))
                values[k] = sign + "&" + name
    early = []
    for name, value in pairs:
        keyword = rng.choice(("*PARAMETER", "*PARAMETER", "*PARAMETER_LOCAL", "*PARAMETER+"))
        width = 20 if "+" in keyword else 10
        card = name.ljust(width) + value.rjust(width)
        early += [keyword, name + "," + value if rng.random() < 0.3 else card]
    for name, text in expressions:
        comma = rng.random() < 0.3
        early += [
            "*PARAMETER_EXPRESSION",
            name + "," + text if comma else name.ljust(10) + text,
        ]
    return early


def scene(rng):
    """(text of a deck, its files) with random forms."""
    blocks = []
    for text in SECTIONS.values():
        for part in ("\n" + text).split("\n*")[1:]:
            blocks.append(Block("*" + part))
    first, rest = blocks[0], blocks[1:]
    if rng.random() < 0.5:
        rng.shuffle(rest)
    blocks = [first] + rest
    for block in blocks:
        block.long = block.name not in ("TITLE", "PART") and rng.random() < 0.15
        if rng.random() < 0.3 and block.name in TITLED:
            block.head = rng.choice(("a title", "1,2,3", "", "         5", " *NODE"))
        if rng.random() < 0.3 and block.name in NUMBERED:
            block.head = ("1" if rng.random() < 0.5 else "").rjust(
                20 if block.long else 10
            ) + "held"
    early = with_parameters(rng, blocks)
    main, files, level = ["*KEYWORD"] + early, {}, 0
    for block in blocks:
        lines = block.lines(rng, True)
        if rng.random() < 0.2 and block.name != "TITLE":
            lines += rng.choice(([""], ["   ", ""]))
        if rng.random() < 0.2 and block.name != "TITLE":
            name = "part%d.k" % len(files)
            files[name] = (
                "\n".join(
                    rng.choice(([], ["*KEYWORD"], ["*KEYWORD", "*TITLE", "a part"]))
                    + lines
                    + rng.choice(([], ["*END", "after"]))
                )
                + "\n"
            )
            lines = ["*INCLUDE", name]
        if rng.random() < 0.1:
            lines += rng.choice(
                (
                    ["*DATABASE_ABSTAT", "     0.001"],
                    ["*CONTROL_ENERGY", "         2"],
                    ["*COMMENT", " * text", "$"],
                )
            )
        main += lines
    text = "\n".join(main + ["*END", ""])
    if rng.random() < 0.2:
        text = text.replace("\n", "\r\n")
    return text, files


def random_forms(count=150, seed=20260108):
    for number in range(count):
        rng = random.Random(seed * 1000003 + number)
        text, files = scene(rng)
        same("scene %d of seed %d" % (number, seed), text, files=files)
        plain.remove_files(files)


if __name__ == "__main__":
    random_forms(*map(int, sys.argv[1:]))
    finish()
