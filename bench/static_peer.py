"""Case H of contact_scenes.py in CalculiX (ccx), beside the pairings of static_pairings.py: the same
mesh as one layer of C3D8 that is held across the plane, surface to surface contact by a linear
penalty of 10 E/h with friction that sticks by a tenth of it (as peers.py), pressed in one
increment and dragged in five. Its nodal CPRESS and CSHEAR of the dependent face are compared."""

import os
import re
import tempfile

import contact_errors
import contact_scenes
import make_scenes
import numpy as np
import peers
from analytic import Hertz

DEPENDENT = ("upper", "lower")  # the face whose points are held by the penalty


class Layer:
    """Two blocks as one layer of C3D8: nodes [(x, y, z)], their numbers {(node, layer): number}
    and elements; first: {first node of a ring: number of its element}."""

    def __init__(self, blocks):
        self.nodes, self.number, self.elements, self.first = [], {}, [], {}
        for block in blocks:
            for node, place in block.place.items():
                for layer in (0, 1):
                    self.nodes.append(place + (float(layer),))
                    self.number[node, layer] = len(self.nodes)
            for ring in block.elements(False):
                self.elements.append([self.number[n, k] for k in (0, 1) for n in ring])
                self.first[ring[0]] = len(self.elements)

    def both(self, nodes):
        return [self.number[n, k] for n in nodes for k in (0, 1)]


def deck(upper, lower, layer, meta, h, dependent):
    """The whole input. Coordinates in 12 digits: ccx reads 20 columns."""
    stiff = peers.PENALTY * meta["young"] / h
    out = ["*NODE, NSET=NALL"]
    out += ["%d, %.12g, %.12g, %.12g" % ((k,) + p) for k, p in enumerate(layer.nodes, 1)]
    out += ["*ELEMENT, TYPE=C3D8, ELSET=EALL"]
    out += ["%d, %s" % (k, ", ".join(map(str, e))) for k, e in enumerate(layer.elements, 1)]
    for name, nodes in (("BASE", lower.row(0)), ("TOP", upper.row(-1))):
        out += ["*NSET, NSET=" + name] + peers.listed(layer.both(nodes))
    out += peers.surface("LOWER", [layer.first[n] for n in lower.row(-2)[:-1]], "S5")
    out += peers.surface("UPPER", [layer.first[n] for n in upper.row(0)[:-1]], "S3")
    out += ["*MATERIAL, NAME=M", "*ELASTIC", "%r, %r" % (meta["young"], meta["poisson"])]
    out += ["*SOLID SECTION, ELSET=EALL, MATERIAL=M", "*SURFACE INTERACTION, NAME=I"]
    out += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", "%r" % stiff]
    out += ["*FRICTION", "%r, %r" % (meta["mu"], peers.STICK * stiff)]
    out += ["*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE"]
    out += ["UPPER, LOWER" if dependent == "upper" else "LOWER, UPPER"]
    out += ["*BOUNDARY", "NALL, 3, 3", "BASE, 1, 2"]
    for share, steps in ((0.0, 1), (1.0, meta["steps"])):
        out += ["*STEP, INC=1000", "*STATIC", "%r, 1.0, 1.0e-5, %r" % (2 * (1.0 / steps,))]
        out += ["*BOUNDARY", "TOP, 1, 1, %r" % (share * meta["drag"])]
        out += ["TOP, 2, 2, %r" % -meta["down"]]
        out += ["*NODE PRINT, NSET=BASE, TOTALS=ONLY, FREQUENCY=1000", "RF"]
        out += ["*CONTACT FILE, FREQUENCY=1000", "CDIS, CSTR", "*END STEP"]
    return "\n".join(out + [""])


def last_contact(path):
    """{number of a node: its values} of the last block CONTACT of a .frd file: COPEN, CSLIP1,
    CSLIP2, CPRESS, CSHEAR1, CSHEAR2."""
    found, inside = {}, False
    with open(path) as file:
        for line in file:
            if line.startswith(" -4  "):
                inside = "CONTACT" in line
                found = {} if inside else found
            elif inside and line.startswith(" -1"):
                values = [float(line[k : k + 12]) for k in range(13, 85, 12)]
                found[int(line[3:13])] = values
    return found


def last_force(path):
    """Total force x, y on the base at the end, of a .dat file."""
    with open(path) as file:
        found = re.findall(r"total force.*\n\s*\n\s*(\S+)\s+(\S+)", file.read())
    return [abs(float(x)) for x in found[-1]]


def errors_of(block, face, layer, meta, folder):
    """p_n, q_t as in contact_errors.py, of the nodes of the dependent face."""
    tangential, normal = last_force(os.path.join(folder, "run.dat"))
    exact = Hertz(meta["radius"], meta["modulus"], normal)
    found = last_contact(os.path.join(folder, "run.frd"))
    values = [[found.get(layer.number[n, k], 6 * [0.0]) for k in (0, 1)] for n in face]
    values = np.mean(values, axis=1)
    x = np.array([block.place[n][0] for n in face])
    length, shear = contact_errors.lengths_at(x), np.hypot(values[:, 4], values[:, 5])
    wanted = exact.shear(x, meta["mu"], tangential)
    return {
        "p_n": contact_errors.off_nodes(length, values[:, 3], exact.pressure(x)),
        "q_t": contact_errors.off_nodes(length, shear, wanted),
        "h_b": meta["h"] / exact.half_width,
    }


def measure(program, h, ratio, dependent):
    """Errors and processor time of a run, or why it failed."""
    with tempfile.TemporaryDirectory() as folder:
        like = os.path.join(folder, "like.k")
        meta = make_scenes.write(like, "hertz", h=h, ratio=ratio)
        blocks = contact_scenes.hertz_blocks(h, ratio, meta["young"], meta["poisson"])
        layer = Layer(blocks)
        with open(os.path.join(folder, "run.inp"), "w") as file:
            file.write(deck(*blocks, layer, meta, h, dependent))
        usage = peers.resource_of([program, "-i", "run"], folder)
        if usage["code"] != 0:
            return {"failed": "exit %s: %s" % (usage["code"], usage["said"])}
        block = blocks[DEPENDENT.index(dependent)]
        face = block.row(0 if dependent == "upper" else -1)
        try:
            found = errors_of(block, face, layer, meta, folder)
        except (KeyError, IndexError, OSError, ValueError) as problem:
            return {"failed": "its output is not read: %r" % problem}
    return dict({k: float(v) for k, v in found.items()}, cpu=usage["cpu"])
