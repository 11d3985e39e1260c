"""The rule of version 0.1.0: nodes of the side with the shorter mean edge, one row for a node and
pair, normals of the reference, the whole gap as offset."""

import numpy as np
from second_contact import DEPTH, END, Pair, edge_row, vertex_row


class OldPair(Pair):
    """A pair of sides by the old rule; rows as those of the new rule, all of them exact."""

    def __init__(self, boundary, card, first, second, side_rule):
        super().__init__(boundary, card, first, second, side_rule)
        mean = [boundary.length[s.edges].mean() if len(s.edges) else 0.0 for s in (first, second)]
        swap = side_rule == "B" or side_rule == "AUTO" and mean[1] < mean[0] * (1 - 1e-6)
        if card.kind == "node_to_surface":
            swap = False
        self.own, self.other = (second, first) if swap else (first, second)
        self.direction = int(swap)

    def rows(self, shape, _motion, reach):
        """Returns a row for each node that has an edge in front of it."""
        b = self.boundary
        result = []
        for i in self.own.nodes:
            best = None
            node_normal = sum(b.normal[e] for e in (b.into[i], b.out[i]) if e >= 0)
            if b.closed[i]:
                node_normal = node_normal / np.hypot(*node_normal)
            for row in self.candidates(shape, i, node_normal):
                if -DEPTH * row.length < row.gap <= reach:
                    if best is None or abs(row.gap) < abs(best.gap) - 1e-12 * row.length:
                        best = row
            if best is not None:
                best.group, best.mu = (self, self.direction), self.card.mu
                best.card = self.card
                result.append(best)
        return result

    def candidates(self, shape, i, node_normal):
        """Yields the rows of the edges, and of convex vertices, that a node faces."""
        b = self.boundary
        for e in self.other.edges:
            if not b.closed[i] or node_normal @ b.normal[e] <= -0.2:
                y = shape.x[i] - shape.x[b.edges[e, 0]]
                s = y @ shape.tangent[e] / shape.span[e]
                if -END <= s <= 1 + END:
                    yield edge_row(shape, i, e, s)
        for k in self.other.vertices:
            if b.turn[k] > 0:
                y = shape.x[i] - shape.x[k]
                n = shape.mean_normal(k)
                beyond = y @ shape.tangent[b.into[k]] > 0 and y @ shape.tangent[b.out[k]] < 0
                if beyond and (not b.closed[i] or node_normal @ n <= -0.2):
                    yield vertex_row(shape, i, k, n)
