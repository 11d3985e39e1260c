"""Field files as VTK and PyVista see them: VTKHDF file by file, XDMF over all of them, a large
scene by PyVista. The numbers are those that h5py reads. Run with each version of VTK that a
requirements-vtk*.txt names, which is the first argument."""

import os
import re
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from full_disk import one_message, starved
from scenes import (
    BIPACT,
    TMP,
    at_most,
    bipact,
    check,
    finish,
    make_bars,
    run_text,
    show,
    within,
)

import fields
import solids

try:
    import matplotlib.pyplot as plt
    import plot_fields
    import plot_space
    import pyvista
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("VTK cannot be loaded here (%s): field files were NOT read by it" % error)
    sys.exit(77)

KIND = {"Point": "GetPointData", "Cell": "GetCellData"}
# Rows and columns of the six components of a symmetric tensor in VTK's order.
PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
WORST = []  # of the principal values, over the largest stress


def fields_run(name, cards, **options):
    """Runs two bars with some cards more; the folder and its fields."""
    path = os.path.join(TMP, name + ".k")
    make_bars.write(path, **options)
    with open(path) as file:
        text = file.read().replace("*END", cards + "*END")
    folder, code, errors = run_text(name, text)
    check(code == 0, errors)
    return folder, fields.Fields(folder)


def tensors(values):
    """The nine components, row by row, of tensors of six: what VTK makes of a Tensor6."""
    full = np.zeros((len(values), 3, 3), values.dtype)
    for c, (i, j) in enumerate(PLACES):
        full[:, i, j] = full[:, j, i] = values[:, c]
    return full.reshape(-1, 9)


def compare(output, run, k, what, stress=6):
    """A grid of VTK against frame k; stress: components that STRESS must have."""
    points = vtk_to_numpy(output.GetPoints().GetData())
    check(np.array_equal(points, run.points), what + ": points")
    wrong = 0
    for c, corners in enumerate(run.cells):
        ids = output.GetCell(c).GetPointIds()
        wrong += [ids.GetId(i) for i in range(ids.GetNumberOfIds())] != corners.tolist()
    check(output.GetNumberOfCells() == len(run.cells) and not wrong, what + ": cells")
    for name, kind in run.names.items():
        array = getattr(output, KIND[kind])().GetArray(name)
        check(array is not None, "%s: %s is there" % (what, name))
        if array is not None:
            wanted = run.frame(k, name)
            if name == "STRESS":
                components = array.GetNumberOfComponents()
                check(components == stress, "%s: STRESS has %d" % (what, components))
                wanted = tensors(wanted) if components == 9 else wanted
            values = vtk_to_numpy(array).reshape(wanted.shape)
            check(
                np.array_equal(values, wanted, equal_nan=True),
                "%s: %s of frame %d" % (what, name, k),
            )
    if "PRINCIPAL" in run.names:
        principal(output, run, k)


def principal(output, run, k):
    """How far the principal values of what VTK takes for the tensor STRESS are from PRINCIPAL:
    not at all, if no two of its components have changed places."""
    array = output.GetCellData().GetArray("STRESS")
    if array.GetNumberOfComponents() == 9:
        found = np.linalg.eigvalsh(vtk_to_numpy(array).reshape(-1, 3, 3))[:, ::-1]
    else:
        found = principal_by_vtk(output)
    wanted, largest = run.frame(k, "PRINCIPAL"), np.abs(run.frame(k, "STRESS")).max()
    off = np.inf if found is None else np.abs(found - wanted).max()
    WORST.append(off / max(largest, 1e-300))


def principal_by_vtk(output):
    """Principal values as a filter of VTK has them, that takes tensors of six components."""
    invariants = vtk.vtkTensorPrincipalInvariants()
    invariants.GetCellDataArraySelection().EnableArray("STRESS")
    invariants.SetInputData(output)
    invariants.Update()
    data = invariants.GetOutput().GetCellData()
    names = [invariants.GetSigmaValueArrayName("STRESS", i) for i in (1, 2, 3)]
    if not all(data.HasArray(name) for name in names):
        return None
    return np.array([vtk_to_numpy(data.GetArray(name)) for name in names]).T


def vtkhdf(run, what):
    """Every step of every file by vtkHDFReader."""
    k = 0
    for path in run.paths:
        reader = vtk.vtkHDFReader()
        reader.SetFileName(path)
        reader.UpdateInformation()
        steps = reader.GetNumberOfSteps()
        for step in range(steps):
            reader.SetStep(step)
            reader.Update()
            # Of a file with one step VTK takes no time.
            check(steps == 1 or reader.GetTimeValue() == run.times[k], what + ": time")
            compare(reader.GetOutput(), run, k, what + ", VTKHDF")
            k += 1
    check(k == len(run.times), "%s: %d of %d frames" % (what, k, len(run.times)))


def xdmf(folder, run, what):
    """The series over all files, by the reader of VTK."""
    reader = vtk.vtkXdmfReader()
    reader.SetFileName(os.path.join(folder, "fields.xdmf"))
    reader.UpdateInformation()
    key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    times = reader.GetOutputInformation(0).Get(key)
    check(np.array_equal(times, run.times), what + ": XDMF, times")
    for k in range(0, len(run.times), max(1, len(run.times) // 5)):
        reader.UpdateTimeStep(run.times[k])
        compare(reader.GetOutputDataObject(0), run, k, what + ", XDMF", stress=9)


def main():
    version = vtk.vtkVersion().GetVTKVersion()
    with open(sys.argv[1]) as file:
        check("vtk==" + version in file.read(), "VTK %s is what the list names" % version)
    show("VTK %s, PyVista %s" % (version, pyvista.__version__))
    every = "*BIPACT_FIELD\n%10.3e\n       ALL\n"
    restart = "*BIPACT_RESTART\n%10d\n"
    scene = dict(nx=6, ny=2, courant=0.5, poisson=0.3, mu=0.3, slide=0.3)
    folder, run = fields_run("bars", every % 1e-9 + restart % 10, **scene)
    check(len(run.paths) > 2, "segments at restart points")
    stress = np.abs(run.history("STRESS")).max(axis=(0, 1))
    check(len(set(stress[:4])) == 4 and stress[:4].min() > 0.0, "four components differ")
    vtkhdf(run, "bars")
    xdmf(folder, run, "bars")
    # Round-off of the eigenvalues of 3 x 3 matrices.
    at_most(max(WORST), 1e-12, "principal values of what VTK takes for STRESS")
    cut_short()
    triangles()
    in_space()
    pyvista_large()


def cut_short():
    """Files that a full disk (a limit on their size) has cut short."""
    path = os.path.join(TMP, "cut.k")
    make_bars.write(path, nx=30, ny=2, courant=0.5)
    with open(path) as file:
        text = file.read().replace("*END", "*BIPACT_FIELD\n     1.e-9\n*END")
    with open(path, "w") as file:
        file.write(text)
    folder = os.path.join(TMP, "cut")
    one_message(*starved(path, folder, bytes_of_file=900_000), "cannot write", "cut short")
    run = fields.Fields(folder)
    check(10 < len(run.times) < 100, "cut short: %d frames" % len(run.times))
    vtkhdf(run, "cut short")
    xdmf(folder, run, "cut short")


def triangles():
    """Triangles and quadrilaterals in one mesh."""
    with open(os.path.join(os.environ["ROOT"], "input", "cards", "every_keyword.k")) as file:
        text = file.read()
    text = re.sub(r"(?s)\*BIPACT_(FIELD|RESTART).*?(?=\n\*)", "$", text)
    text = text.replace(
        "*END", "*BIPACT_FIELD\n     0.002\n         U    STRESS      PART\n*END"
    )
    folder, code, errors = run_text("mixed", text)
    check(code == 0, "mixed: " + errors)
    run = fields.Fields(folder)
    check({len(c) for c in run.cells} == {3, 4}, "mixed: both kinds")
    vtkhdf(run, "mixed")
    xdmf(folder, run, "mixed")


def in_space():
    """Solids of every shape in one mesh: their volumes by VTK are those of the boxes they fill,
    which their nodes in a wrong order would not be."""
    lines, first, number = [], 1, 0
    for number, form in enumerate(solids.FORMS, start=1):
        box = solids.Box((2, 2, 1), (2.0, 2.0, 1.0), form, 0.2, number, (0.0, 0.0, 3.0 * number))
        lines += solids.cards(box.x, box.elements, number, first)
        lines += solids.part(form, number=number)
        first += 1000
    lines += ["*INITIAL_VELOCITY_NODE"] + ["%d,0.5,-1.0,0.3" % n for n in range(1, 7001, 1000)]
    lines += ["*BIPACT_FIELD", "0.002,", "U,STRESS,PRINCIPAL,PART"]
    folder, code, errors = run_text("solids", solids.deck(lines, 1.0e-3, 0.01))
    check(code == 0, "solids: " + errors)
    run = fields.Fields(folder)
    check({len(c) for c in run.cells} == {4, 5, 6, 8, 10, 27}, "solids: all shapes")
    vtkhdf(run, "solids")
    xdmf(folder, run, "solids")
    at_most(max(WORST), 1e-12, "principal values of solids")
    reader = vtk.vtkHDFReader()
    reader.SetFileName(run.paths[0])
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputConnection(reader.GetOutputPort())
    sizes.Update()
    volume = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))
    # The triangles of a wedge face inward since VTK 9.7, as our files have them; before
    # they faced outward, and the same file has volumes below 0 there.
    if vtk.vtkVersion().GetVTKMajorVersion() * 100 + vtk.vtkVersion().GetVTKMinorVersion() < 907:
        volume = np.where([len(c) == 6 for c in run.cells], -volume, volume)
        # It takes no account of quadratic hexahedra.
        volume[run.types == 29] = quadratic_volumes(sizes.GetOutput(), run)
    check(volume.min() > 0.0, "solids: volumes are positive")
    # Planes cut the warped faces of cells differently from both sides: not exact in sum.
    within(volume.sum() / (4.0 * number), 0.98, 1.02, "solids: their volume by VTK")
    pictures(folder)


def quadratic_volumes(grid, run):
    """Volumes of the hexahedra with 27 nodes, by VTK's shape functions at 3 x 3 x 3 points."""
    at = np.array([-1.0, 0.0, 1.0]) * np.sqrt(0.6) / 2.0 + 0.5
    weight = np.array([5.0, 8.0, 5.0]) / 18.0
    found = []
    for e in np.flatnonzero(run.types == 29):
        cell, total = grid.GetCell(e), 0.0
        x = np.array([cell.GetPoints().GetPoint(k) for k in range(27)])
        for i, j, k in np.ndindex(3, 3, 3):
            slopes = [0.0] * 81
            cell.InterpolateDerivs([at[i], at[j], at[k]], slopes)
            jacobian = np.reshape(slopes, (3, 27)) @ x
            total += weight[i] * weight[j] * weight[k] * np.linalg.det(jacobian)
        found.append(total)
    return found


def pictures(folder):
    """Solids of every shape, drawn by PyVista and by Matplotlib: pixels that are not the white of
    the ground have the hues of the parts."""
    picture = plot_fields.Picture(folder, "PART")
    frames = [0, len(picture.run.times) - 1]
    with_pyvista = plot_space.Scene(picture, 1.0, frames)
    check(with_pyvista.painter is not None, "PyVista draws here")
    image = with_pyvista.painter.image(frames[1], with_pyvista.colours(frames[1]), (400, 300))
    # The surfaces alone cover more; grey are the frame and its names.
    hue = np.ptp(image[:, :, :3].astype(int), axis=2)
    check((hue > 40).mean() > 0.02, "PyVista: faces cover %.3f" % (hue > 40).mean())
    path = os.path.join(folder, "plain.png")
    plot_space.painters = lambda: None
    plot_space.snapshots(picture, path, 1.0, "solids")
    image = plt.imread(path)[:, :, :3]
    hue = np.ptp(image, axis=2) * 255.0
    check((hue > 40).mean() > 0.02, "Matplotlib: faces cover %.3f" % (hue > 40).mean())


def pyvista_large():
    """2e5 dofs, 100 frames of U: the size of the file is that of its numbers within 10 %, and
    PyVista opens it and moves through time."""
    path = os.path.join(TMP, "large.k")
    meta = make_bars.write(path, nx=500, ny=100, courant=1.0, tend=100 * 2.0e-5)
    with open(path) as file:
        text = file.read()
    card = "*BIPACT_FIELD\n%10.3e                            32\n         U\n" % 1e-9
    folder, code, errors = run_text("large", text.replace("*END", card + "*END"))
    check(code == 0, errors)
    run = fields.Fields(folder)
    dofs = 2 * len(run.points)
    raw = len(run.times) * len(run.points) * 3 * 4
    size = sum(os.path.getsize(p) for p in run.paths)
    show("%d dofs, %d frames, %.0f MB" % (dofs, len(run.times), size / 1e6))
    check(dofs > 2e5 and len(run.times) >= 100, "%d dofs, %d frames" % (dofs, len(run.times)))
    mesh = run.points.nbytes + 8 * (sum(len(c) for c in run.cells) + len(run.cells) + 1)
    within(size / (raw + mesh + len(run.cells)), 1.0, 1.1, "size / numbers")
    reader = pyvista.get_reader(os.path.join(folder, "fields.xdmf"))
    check(
        len(reader.time_values) == len(run.times), "PyVista: %d times" % len(reader.time_values)
    )
    k = len(run.times) // 2
    reader.set_active_time_value(reader.time_values[k])
    grid = reader.read()
    if isinstance(grid, pyvista.MultiBlock):
        grid = grid[0]
    check(np.array_equal(grid.point_data["U"], run.frame(k, "U")), "PyVista: U in the middle")
    check(grid.n_cells == len(run.cells), "PyVista: %d cells" % grid.n_cells)


if __name__ == "__main__":
    if not os.path.exists(BIPACT.replace("bin/bipact", "bin/bipact-hdf5")):
        print("bipact-hdf5 is not built: field files NOT tested")
        sys.exit(77)
    main()
    finish()
