"""Elements, masses, loads and the boundary of the second implementation, with dense matrices."""

import numpy as np

QUAD = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)


def elasticity(material, form):
    """Returns the matrix of stress over strain (xx, yy, 2 xy); form 12 plane stress, 13 strain."""
    _, e, nu = material
    if form == 12:
        c = e / (1 - nu * nu)
        return c * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])
    if form != 13:
        raise ValueError("ELFORM 12 or 13")
    c = e / ((1 + nu) * (1 - 2 * nu))
    return c * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, (1 - 2 * nu) / 2]])


def strain_matrix(slopes):
    """Returns B (3, 2 n) from the slopes (n, 2) of the shape functions."""
    b = np.zeros((3, 2 * len(slopes)))
    b[0, 0::2] = b[2, 1::2] = slopes[:, 0]
    b[1, 1::2] = b[2, 0::2] = slopes[:, 1]
    return b


def quad_point(x, place):
    """Returns shape functions, their slopes in space and the Jacobian at a place of a quad."""
    n = (1 + QUAD[:, 0] * place[0]) * (1 + QUAD[:, 1] * place[1]) / 4
    local = np.empty((4, 2))
    local[:, 0] = QUAD[:, 0] * (1 + QUAD[:, 1] * place[1]) / 4
    local[:, 1] = QUAD[:, 1] * (1 + QUAD[:, 0] * place[0]) / 4
    jacobian = local.T @ x
    return n, np.linalg.solve(jacobian, local.T).T, np.linalg.det(jacobian)


def element_stiffness(x, d, thickness):
    """Returns the stiffness of a quad (2 x 2 points) or of a triangle of constant strain."""
    if len(x) == 3:
        a, b = x[1] - x[0], x[2] - x[0]
        twice = a[0] * b[1] - a[1] * b[0]
        y = np.roll(x, -1, 0) - np.roll(x, -2, 0)
        slopes = np.stack([y[:, 1], -y[:, 0]], axis=1) / twice
        b = strain_matrix(slopes)
        return b.T @ d @ b * (thickness * twice / 2)
    k = np.zeros((8, 8))
    for place in QUAD / np.sqrt(3.0):
        _, slopes, det = quad_point(x, place)
        b = strain_matrix(slopes)
        k += b.T @ d @ b * (det * thickness)
    return k


def element_mass(x, surface_density, kind, courant):
    """Returns the mass of an element, one number per pair of nodes."""
    n = len(x)
    if n == 3:
        a, b = x[1] - x[0], x[2] - x[0]
        m = (np.ones((3, 3)) + np.eye(3)) * (a[0] * b[1] - a[1] * b[0]) / 24
    else:
        reach = np.array([1.0, 1.0]) / np.sqrt(3.0)
        if kind == "DISPERSION":
            reach = np.sqrt(2 / 3 * (1 - np.minimum(courant, 1.0) ** 2))
        m = np.zeros((4, 4))
        for place in QUAD * reach:
            shape, _, det = quad_point(x, place)
            m += np.outer(shape, shape) * det
    if kind == "LUMPED":
        m = np.diag(m.sum(axis=1))
    return m * surface_density


class Body:
    """Everything of the deck that does not change: mesh, matrices, loads, supports, boundary."""

    def __init__(self, deck):
        self.deck = deck
        self.ids = sorted(deck.nodes)
        self.index = {i: k for k, i in enumerate(self.ids)}
        self.x = np.array([deck.nodes[i] for i in self.ids])
        self.n = len(self.ids)
        self.elements = []
        self.mass = np.zeros((self.n, self.n))
        self.stiffness = np.zeros((2 * self.n, 2 * self.n))
        edges = {}
        for _, pid, corners in deck.elements:
            nodes = [self.index[i] for i in corners]
            self.add_element(pid, nodes)
            for a, b in zip(nodes, nodes[1:] + nodes[:1]):
                edges.setdefault((min(a, b), max(a, b)), []).append((a, b, pid))
        exposed = sorted(e[0] for e in edges.values() if len(e) == 1)
        self.edges = [e[:2] for e in exposed]
        self.edge_part = [e[2] for e in exposed]
        self.group_elements()
        self.free = np.ones(2 * self.n, dtype=bool)
        for where, *held in deck.fixed:
            for k in self.nodes_of(where):
                self.free[2 * k : 2 * k + 2] &= ~np.array(held, dtype=bool)
        self.v0 = np.zeros((self.n, 2))
        for where, v in deck.velocities:
            self.v0[self.nodes_of(where)] = v
        self.v0[~self.free.reshape(-1, 2)] = 0.0

    def add_element(self, pid, nodes):
        """Computes an element and adds it to the matrices."""
        section, mid = self.deck.parts[pid]
        form, thickness = self.deck.sections[section]
        material = self.deck.materials[mid]
        x = self.x[nodes]
        d = elasticity(material, form)
        courant = None
        if self.deck.mass == "DISPERSION":
            middle = (x + np.roll(x, -1, 0)) / 2
            h = np.linalg.norm(middle[[1, 2]] - middle[[3, 0]], axis=1)
            courant = np.sqrt(d[0, 0] / material[0]) * self.deck.dt / h
            if self.deck.courant is not None:
                courant = np.full(2, self.deck.courant)
        m = element_mass(x, material[0] * thickness, self.deck.mass, courant)
        k = element_stiffness(x, d, thickness)
        dofs = np.array([2 * i + j for i in nodes for j in (0, 1)])
        self.mass[np.ix_(nodes, nodes)] += m
        self.stiffness[np.ix_(dofs, dofs)] += k
        self.elements.append((nodes, dofs, k))

    def group_elements(self):
        """Stacks elements of equal shape, so that forces are computed at once."""
        self.groups = []
        for count in (3, 4):
            some = [e for e in self.elements if len(e[0]) == count]
            if some:
                nodes, dofs, k = (np.array(part) for part in zip(*some))
                self.groups.append((nodes, dofs, k))

    def nodes_of(self, where):
        """Returns the nodes of ("set", id) or ("node", id); set 0 is all."""
        kind, identity = where
        if kind == "set":
            if identity == 0:
                return list(range(self.n))
            return [self.index[i] for i in self.deck.node_sets[identity]]
        return [self.index[identity]]

    def elastic(self, u):
        """Returns K u and the strain energy, from motions relative to an element's first node."""
        force, energy = np.zeros(2 * self.n), 0.0
        for nodes, dofs, k in self.groups:
            relative = u[nodes] - u[nodes[:, :1]]
            relative = relative.reshape(len(nodes), -1)
            local = np.einsum("eij,ej->ei", k, relative)
            np.add.at(force, dofs, local)
            energy += 0.5 * np.sum(local * relative)
        return force, energy

    def curve(self, identity, t):
        a, o = self.deck.curves[identity]
        return np.interp(t, a, o)

    def load(self, t):
        """Returns the nodal loads at a time."""
        p = np.zeros((self.n, 2))
        for where, direction, curve, factor in self.deck.forces:
            p[self.nodes_of(where), direction] += factor * self.curve(curve, t)
        for direction, curve, factor in self.deck.gravity:
            p[:, direction] -= factor * self.curve(curve, t) * self.mass.sum(axis=1)
        return p.reshape(-1)
