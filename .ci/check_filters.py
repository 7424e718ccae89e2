"""VTK's own filters on files of `mandoline flow`: its cutter cuts all of the box, its stream tracer comes through it."""
import sys

import vtk

TOLERANCE = 1e-2  # of areas: what VTK makes of concave cells overlaps, by 0.3 % about a scan
ROWS = 6  # of seeds
SEEDS = ROWS * ROWS


def section(grid, axis):
    """The area of what the cutter makes of a plane beside the middle of the box, over that of the box's section."""
    bounds = grid.GetBounds()
    sizes = [bounds[2 * d + 1] - bounds[2 * d] for d in range(3)]
    origin = list(grid.GetCenter())
    origin[axis] += 0.0137 * sizes[axis]
    plane = vtk.vtkPlane()
    plane.SetOrigin(origin)
    plane.SetNormal([float(d == axis) for d in range(3)])
    cutter = vtk.vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(grid)
    triangles = vtk.vtkTriangleFilter()
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.SetInputConnection(cutter.GetOutputPort())
    triangles.Update()
    cut = triangles.GetOutput()
    area = sum(cut.GetCell(i).ComputeArea() for i in range(cut.GetNumberOfCells()))
    return area / (sizes[(axis + 1) % 3] * sizes[(axis + 2) % 3])


def streamlines(grid):
    """How many lines begin near xMin, and how many come to xMax."""
    x0, x1, y0, y1, z0, z1 = grid.GetBounds()
    at = lambda low, high, share: low + share * (high - low)
    seeds = vtk.vtkPlaneSource()
    start = at(x0, x1, 0.03)
    seeds.SetOrigin(start, at(y0, y1, 0.1), at(z0, z1, 0.1))
    seeds.SetPoint1(start, at(y0, y1, 0.9), at(z0, z1, 0.1))
    seeds.SetPoint2(start, at(y0, y1, 0.1), at(z0, z1, 0.9))
    seeds.SetResolution(ROWS - 1, ROWS - 1)
    points = vtk.vtkCellDataToPointData()
    points.SetInputData(grid)
    tracer = vtk.vtkStreamTracer()
    tracer.SetInputConnection(points.GetOutputPort())
    tracer.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, 'velocity')
    tracer.SetSourceConnection(seeds.GetOutputPort())
    tracer.SetIntegrationDirectionToForward()
    tracer.SetMaximumPropagation(10 * (x1 - x0))
    tracer.SetMaximumNumberOfSteps(10000)
    tracer.Update()
    lines = tracer.GetOutput()
    through = 0
    for i in range(lines.GetNumberOfCells()):
        line = lines.GetCell(i).GetPointIds()
        through += lines.GetPoint(line.GetId(line.GetNumberOfIds() - 1))[0] > at(x0, x1, 0.9)
    return lines.GetNumberOfCells(), through


def check(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    sections = [section(grid, axis) for axis in range(3)]
    if not all(abs(one - 1) < TOLERANCE for one in sections):
        sys.exit(f'{path}: VTK cuts {sections} of the sections of the box')
    begun, ended = streamlines(grid)
    if begun != SEEDS or ended < SEEDS / 2:
        sys.exit(f'{path}: VTK begins {begun} of {SEEDS} lines, of which {ended} come through')
    print(f'{path}: VTK cuts all of the box, and {ended} of {begun} lines come through')


for file in sys.argv[1:]:
    check(file)
