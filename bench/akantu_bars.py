#!/usr/bin/env python3
"""Two bars in flight by Akantu, explicit with a lumped mass: akantu_bars.py NX NY DT STEPS prints
processor microseconds of a step. Exit code 77: akantu is not installed (pip install akantu).
The scene is that of explicit.py: 10 x 1 bars apart, plane strain, NX x NY quadrilaterals each."""

import os
import sys
import tempfile
import time

try:
    import akantu
    import numpy
except ImportError:
    sys.exit(77)

MATERIAL = "material elastic [\n name = bar\n rho = 0.001\n E = 1000.0\n nu = 0.0\n]\n"


def write_mesh(path, nx, ny):
    """Both bars as a file of Gmsh, format 2.2."""
    nodes, elements = [], []
    for bar in (0, 1):
        first = len(nodes) + 1
        for j in range(ny + 1):
            for i in range(nx + 1):
                place = (-12.5 + 15.0 * bar + 10.0 * i / nx, j / ny)
                nodes.append("%d %.16g %.16g 0" % ((len(nodes) + 1,) + place))
        for j in range(ny):
            for i in range(nx):
                a = first + j * (nx + 1) + i
                corners = (a, a + 1, a + nx + 2, a + nx + 1)
                elements.append("%d 3 2 1 1 %d %d %d %d" % ((len(elements) + 1,) + corners))
    with open(path, "w") as f:
        f.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" % len(nodes))
        f.write("\n".join(nodes) + "\n$EndNodes\n$Elements\n%d\n" % len(elements))
        f.write("\n".join(elements) + "\n$EndElements\n")


def main():
    nx, ny, dt, steps = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
    mesh = akantu.Mesh(2)
    with tempfile.TemporaryDirectory() as folder:
        write_mesh(os.path.join(folder, "bars.msh"), nx, ny)
        with open(os.path.join(folder, "material.dat"), "w") as f:
            f.write(MATERIAL)
        akantu.parseInput(os.path.join(folder, "material.dat"))
        mesh.read(os.path.join(folder, "bars.msh"))
    model = akantu.SolidMechanicsModel(mesh)
    model.initFull(_analysis_method=akantu._explicit_lumped_mass)
    model.setTimeStep(dt)
    speed = numpy.where(mesh.getNodes()[:, 0] < 0.0, 1.0, -1.0)
    model.getVelocity()[:, 0] = speed
    before = time.process_time()
    for _ in range(steps):
        model.solveStep()
    used = time.process_time() - before
    flown = model.getDisplacement()[:, 0] - speed * dt * steps
    if not abs(flown).max() < 1.0e-9 * dt * steps:
        sys.exit("akantu_bars.py: the bars are not where they fly to")
    print("%.3f" % (1.0e6 * used / steps))


if __name__ == "__main__":
    main()
