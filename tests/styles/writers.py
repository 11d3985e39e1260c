"""Decks in the handwriting of several programs and of people. A deck is a list of blocks
(keyword, cards, title); a card is a line of text, a dictionary of fields, or a list of values.
"""

from layouts import LAYOUT, fields_of

TITLED = ("SECTION_", "MAT_", "SET_", "DEFINE_", "HOURGLASS")
NUMBERED = ("BOUNDARY_", "CONTACT_", "RIGIDWALL_", "LOAD_SEGMENT", "LOAD_NODE")


class Writer:
    """The common part: fixed columns, values right-aligned, blanks for what is not said."""

    header = []
    fills_defaults = False
    names_fields = None  # the beginning of a comment line with the names of the fields
    left = ()  # fields that are written at the left of their columns

    def deck(self, blocks, frame="*KEYWORD"):
        """The whole text."""
        lines = list(self.header) + ([frame] if frame else [])
        for number, block in enumerate(blocks, 1):
            lines += self.block(number, *block)
        return "\n".join(lines + ["*END", ""])

    def block(self, number, keyword, cards, title=None):
        """Lines of a keyword."""
        if keyword.startswith("$"):
            return [keyword]
        name, head = self.head(number, keyword, title)
        lines = self.before(keyword, cards, title) + ["*" + self.cased(name)] + head
        layout = LAYOUT.get(keyword, [])
        for k, card in enumerate(cards):
            lines += self.card(self.shape(layout, k, keyword), card, k)
        return lines

    @staticmethod
    def shape(layout, k, keyword):
        """The layout of the k-th card: the last one repeats, all those of *PART do."""
        if keyword == "PART":
            return layout[k % 2]
        return layout[min(k, len(layout) - 1)] if layout else "text"

    def head(self, number, keyword, title):
        """The name with its option, and the card that it brings."""
        if title is None:
            return keyword, []
        if keyword.startswith(TITLED):
            return keyword + "_TITLE", [title]
        if keyword.startswith(NUMBERED):
            return keyword + "_ID", [str(number).rjust(10) + title]
        return keyword, []

    def before(self, keyword, cards, title):
        return []

    def cased(self, name):
        return name

    def card(self, shape, card, k):
        """Lines of one card."""
        if isinstance(card, str):
            return [card]
        fields = fields_of(shape)
        if isinstance(card, (list, tuple)):
            card = dict(zip([f[0] for f in fields], card))
        values = [self.value(card, name, default) for name, _, default in fields]
        return self.comment(fields, k) + [self.line(fields, values)]

    def value(self, card, name, default):
        if name in card:
            return self.number(card[name])
        return default if self.fills_defaults else ""

    def number(self, value):
        return value if isinstance(value, str) else repr(value)

    def comment(self, fields, k):
        if self.names_fields is None:
            return []
        text = "".join(name.rjust(width) for name, width, _ in fields)
        return [self.names_fields + text[len(self.names_fields) :]]

    def line(self, fields, values):
        return "".join(
            v.ljust(width) if name in self.left else v.rjust(width)
            for (name, width, _), v in zip(fields, values)
        ).rstrip()


class Filled(Writer):
    """All fields with their defaults, their names above them, titles on everything."""

    header = [
        "$# a deck as a program writes it that fills every field",
        "$# one block a keyword",
    ]
    fills_defaults = True
    names_fields = "$#"
    left = ("solver",)

    def head(self, number, keyword, title):
        if keyword.startswith(TITLED):
            return keyword + "_TITLE", [
                "$# title",
                title or "%s %d" % (keyword.lower(), number),
            ]
        if keyword == "TITLE":
            return keyword, ["$# title"]
        if keyword.startswith(NUMBERED) and title is not None:
            return keyword + "_ID", [
                "$#      id".ljust(10) + "heading".rjust(70),
                str(number).rjust(10) + title,
            ]
        return keyword, []


class Banners(Writer):
    """Comments between blocks, only what is said, headings and ids, parameters."""

    header = [
        "$",
        "$ ======================",
        "$ a model of two blocks",
        "$ ======================",
        "$",
    ]

    def before(self, keyword, cards, title):
        return ["$", "$ " + (title or keyword.replace("_", " ").lower()), "$ " + "-" * 20]


class Components(Writer):
    """Names and colours of components in comments, cards without trailing zeros."""

    header = [
        "$$ mesh and cards of a graphical preprocessor",
        "$$ --------------------------------",
    ]

    def before(self, keyword, cards, title):
        if keyword == "PART":
            return [
                "$HMNAME COMPS       %dcomponent" % (k + 1) for k in range(len(cards) // 2)
            ] + [
                "$HWCOLOR COMPS       %d       %d" % (k + 1, 3 + k)
                for k in range(len(cards) // 2)
            ]
        if keyword.startswith("SET_"):
            return ["$HMSET", "$HMTYPE", "$HMNAME SETS        1" + (title or "set")]
        if keyword.startswith("MAT_"):
            return ["$HMNAME MATS       1" + (title or "material")]
        return []


class Commas(Writer):
    """Every card by commas, as mesh generators and scripts write them."""

    header = ["$ written by a script"]

    def line(self, fields, values):
        while len(values) > 1 and values[-1] == "":
            values = values[:-1]
        return ", ".join(values) + ("," if len(values) == 1 else "")


class ByHand(Writer):
    """Lower case, values at the left of their columns, blank lines, remarks."""

    header = ["$ two blocks, by hand", ""]

    def cased(self, name):
        return name.lower()

    def before(self, keyword, cards, title):
        return ["", "$ " + title] if title else [""]

    def head(self, number, keyword, title):
        return keyword, []

    def line(self, fields, values):
        return "".join(v.ljust(width) for (_, width, _), v in zip(fields, values)).rstrip()
