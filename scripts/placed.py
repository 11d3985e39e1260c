"""Where the scenes of make_scenes.py are placed."""

import math


def turned(o, x, y):
    """A vector of the scene as it is placed: mirrored, then turned."""
    if o["mirror"]:
        y = -y
    quarter, rest = divmod(o["angle"], 90.0)
    for _ in range(int(quarter) % 4):
        x, y = -y, x
    a = math.radians(rest)
    return (
        (x, y)
        if rest == 0.0
        else (x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a))
    )
