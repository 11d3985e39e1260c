"""Cards of a deck as text, for the scripts that write decks: a number reads back equal."""

TEN, NODE, SHELL = (10,) * 8, (8, 16, 16, 16, 8, 8), (8,) * 10


def text_of(value):
    """Shortest text that reads back equal; '' for a default."""
    if value is None:
        return ""
    if isinstance(value, float):
        return repr(value + 0.0)  # no negative zero
    return str(value)


def card(widths, *values):
    """One card: fixed columns, or comma form where a number is wider than its field."""
    texts = [text_of(v) for v in values]
    if all(len(t) <= w for t, w in zip(texts, widths)):
        return "".join(t.rjust(w) for t, w in zip(texts, widths)).rstrip()
    joined = ",".join(texts).rstrip(",")
    return joined if "," in joined else joined + ","


def names(widths, *labels):
    """'$#' comment with each field's name over its columns."""
    return ("$#" + "".join(n.rjust(w) for n, w in zip(labels, widths))[2:]).rstrip()


def block(keyword, labels, *values):
    """A keyword with one card of 10-column fields under its names."""
    return [keyword, names(TEN, *labels.split()), card(TEN, *values)]


def listed(ids):
    """Cards of eight ids each."""
    return [card(TEN, *ids[k : k + 8]) for k in range(0, len(ids), 8)]


def parameter_lines(values):
    """*PARAMETER card: type letter and name in 10 columns, value in 10."""
    if not values:
        return []
    labels = [part + str(k + 1) for k in range(len(values)) for part in ("name", "value")]
    pairs = "".join(
        ("R" + name).ljust(10) + text_of(value).rjust(10) for name, value in values.items()
    )
    return ["*PARAMETER", names(TEN, *labels), pairs]


# Fields of the two cards of a time scheme, in their order.
DYNAMICS = "imass gamma beta tdybir tdydth tdybur irate alpha".split()
SCHEME = "scheme theta xi rest rhoinf rule pbeta".split()


def scheme_cards(scheme, **setting):
    """*CONTROL_IMPLICIT_DYNAMICS of a motion and *BIPACT_TIME; what is not set stays blank."""
    given = dict(setting, imass=1, scheme=scheme)
    unknown = set(given) - set(DYNAMICS) - set(SCHEME)
    if unknown:
        raise ValueError("no scheme has a field %s" % sorted(unknown)[0])
    out = []
    for keyword, fields in (("*CONTROL_IMPLICIT_DYNAMICS", DYNAMICS), ("*BIPACT_TIME", SCHEME)):
        values = [given.get(name) for name in fields]
        out += block(keyword, " ".join(fields), *values)
    return out


def heading(text, columns=70):
    """A title card of at most `columns` bytes: one line, neither a comment nor a keyword."""
    line = " ".join(text.split()) or "-"
    if line[0] in "$*":
        line = " " + line
    return line.encode("utf-8")[:columns].decode("utf-8", "ignore").rstrip()
