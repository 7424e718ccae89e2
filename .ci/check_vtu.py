"""Reads .vtu and .pvtu files with VTK. Errors are cells that are not closed, or whose volumes are off by 1e-9 of the largest."""
import sys

import vtk


def polygons(grid, cell):
    """The faces of a cell, each the ids of its points, counter-clockwise as seen from outside."""
    if grid.GetCellType(cell) == vtk.VTK_POLYHEDRON:
        stream = vtk.vtkIdList()
        grid.GetFaceStream(cell, stream)
        at = 1
        for _ in range(stream.GetId(0)):
            size = stream.GetId(at)
            yield [stream.GetId(at + 1 + i) for i in range(size)]
            at += 1 + size
    else:
        points = grid.GetCell(cell).GetPointIds()
        corners = [points.GetId(i) for i in range(8)]
        for face in ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)):
            yield [corners[i] for i in face]


def volume(grid, cell):
    """By the divergence theorem, from a point of the cell; None if the directed edges don't cancel."""
    edges = {}
    total = 0
    origin = None
    for polygon in polygons(grid, cell):
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            key, sense = ((a, b), 1) if a < b else ((b, a), -1)
            edges[key] = edges.get(key, 0) + sense
        at = [grid.GetPoint(p) for p in polygon]
        origin = origin or at[0]
        p, *rest = [[x - o for x, o in zip(point, origin)] for point in at]
        for q, r in zip(rest, rest[1:]):
            total += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0])
    return total / 6 if not any(edges.values()) else None


def check(path):
    reader = vtk.vtkXMLPUnstructuredGridReader() if path.endswith('.pvtu') else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    expected = grid.GetCellData().GetArray('volume')
    if reader.GetErrorCode() or grid.GetNumberOfCells() == 0 or expected is None:
        sys.exit(f'{path}: VTK does not read it')
    largest = max(expected.GetValue(c) for c in range(grid.GetNumberOfCells()))
    worst = 0
    for cell in range(grid.GetNumberOfCells()):
        found = volume(grid, cell)
        if found is None:
            sys.exit(f'{path}: cell {cell} is not closed')
        worst = max(worst, abs(found - expected.GetValue(cell)) / largest)
    if worst > 1e-9:
        sys.exit(f'{path}: the volume of a cell is off by {worst} of the largest')
    print(f'{path}: {grid.GetNumberOfCells()} cells, volumes within {worst:.1e} of the largest')


for file in sys.argv[1:]:
    check(file)
