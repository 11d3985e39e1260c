"""Reads decks as text, by the rules of the format alone."""

import os


class Deck:
    """Cards of a deck by keyword, read by the rules of the format: fixed columns or commas.

    cards  {keyword: [[field, ...], ...]} as text, '' for blank; title cards are one field
    """

    WIDTHS = {
        "*NODE": (8, 16, 16, 16, 8, 8),
        "*ELEMENT_SHELL": (8,) * 10,
        "*ELEMENT_SOLID": (8,) * 10,
        "*ELEMENT_SOLID (ten nodes format)": (8,) * 10,
        "*ELEMENT_SOLID_H27": (8,) * 10,
        "*PARAMETER": (10,) * 8,
    }
    TITLES = {
        "*TITLE": (1, 1),
        "*SET_NODE_LIST_TITLE": (1, 0),
        "*SET_PART_LIST_TITLE": (1, 0),
        "*SET_SEGMENT_TITLE": (1, 0),
        "*MAT_ELASTIC_TITLE": (1, 0),
        "*PART": (1, 2),
        "*INCLUDE": (1, 1),
    }

    def __init__(self, path):
        self.cards, self.lines = {}, []
        self._read(path)
        pairs = [f for fields in self.cards.get("*PARAMETER", []) for f in fields]
        self.parameters = {n[1:]: v for n, v in zip(pairs[::2], pairs[1::2]) if n}

    def _read(self, path):
        with open(path, encoding="utf-8") as stream:
            lines = stream.read().splitlines()
        self.lines += lines
        keyword, count = None, 0
        for line in lines:
            if line.startswith("$"):
                continue
            if line.startswith("*"):
                keyword, count = line.strip(), 0
                self.cards.setdefault(keyword, [])
                continue
            count += 1
            self.cards[keyword].append(self._fields(keyword, count, line))
            if keyword == "*INCLUDE":
                self._read(os.path.join(os.path.dirname(path), line.strip()))

    def _fields(self, keyword, count, line):
        first, period = self.TITLES.get(keyword, (0, 0))
        if first and (count == first or (period and (count - first) % period == 0)):
            return [line]
        if "," in line:
            return line.split(",")
        fields, widths = [], self.WIDTHS.get(keyword, (10,) * 8)
        for width in widths:
            fields.append(line[:width].strip())
            line = line[width:]
        assert not line.strip(), "text beyond the last field"
        return fields

    def number(self, text):
        """Number in a field; parameters resolved."""
        if "&" in text:
            sign, name = text.split("&")
            return float(self.parameters[name]) * (-1.0 if sign == "-" else 1.0)
        return float(text)

    def field(self, keyword, card, column):
        """Field of a card, both counted from 1, as a number."""
        return self.number(self.cards[keyword][card - 1][column - 1])

    def nodes(self):
        """{id: (x, y)}"""
        return {int(f[0]): (float(f[1]), float(f[2])) for f in self.cards["*NODE"]}

    def elements(self):
        """{id: (part, [nodes])}"""
        return {
            int(f[0]): (int(f[1]), [int(n) for n in f[2:6]])
            for f in self.cards["*ELEMENT_SHELL"]
        }

    def points(self):
        """{id: (x, y, z)}"""
        return {int(f[0]): tuple(float(v) for v in f[1:4]) for f in self.cards["*NODE"]}

    def solids(self):
        """{id: (part, [nodes as on the cards])}"""
        found = {}
        for keyword, many in (("", 1), (" (ten nodes format)", 2), ("_H27", 4)):
            cards = self.cards.get("*ELEMENT_SOLID" + keyword, [])
            for k in range(0, len(cards), many):
                numbers = [int(n) for card in cards[k : k + many] for n in card if n]
                found[numbers[0]] = numbers[1], numbers[2:]
        return found

    def sets(self, keyword="*SET_NODE_LIST_TITLE"):
        """{set id: [members]} of a keyword with titles"""
        return {number: members for number, _, members in self.titled(keyword)}

    def names(self, keyword):
        """{set id: title}"""
        return {number: title for number, title, _ in self.titled(keyword)}

    def titled(self, keyword):
        """[(set id, title, [members])]"""
        found, title = [], None
        for fields in self.cards.get(keyword, []):
            if len(fields) == 1:
                title = fields[0]
            elif title is not None:
                found.append((int(fields[0]), title, []))
                title = None
            else:
                found[-1][2].extend(int(n) for n in fields if n)
        return found

    def parts(self):
        """{part id: (heading, section, material)}"""
        cards = self.cards["*PART"]
        return {
            int(f[0]): (h[0], int(f[1]), int(f[2])) for h, f in zip(cards[::2], cards[1::2])
        }

    def velocities(self):
        """{part: (vx, vy)}"""
        cards = [f for f in self.cards["*INITIAL_VELOCITY_GENERATION"] if any(f)]
        return {
            int(f[0]): tuple(self.number(v) if v else 0.0 for v in (f + [""])[3:5])
            for f in cards
        }
