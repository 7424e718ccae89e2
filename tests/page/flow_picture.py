"""Draws a flow: flow_picture.py CELLS.vtu LINES.obj BODY.obj PICTURE.png. Needs VTK."""
import sys

import vtk

SPEEDS = ((0, (.16, .22, .45)), (.5, (.36, .58, .75)), (1, (.93, .95, .93)), (1.3, (.95, .68, .42)), (1.6, (.72, .22, .2)))


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def actor(port):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(port)
    mapper.ScalarVisibilityOff()
    result = vtk.vtkActor()
    result.SetMapper(mapper)
    return result


def section(cells, middle):
    """The cells in the plane through the middle, coloured by speed."""
    speed = vtk.vtkArrayCalculator()
    speed.SetInputData(cells)
    speed.SetAttributeTypeToCellData()
    speed.AddVectorArrayName('velocity')
    speed.SetFunction('mag(velocity)')
    speed.SetResultArrayName('speed')
    plane = vtk.vtkPlane()
    plane.SetOrigin(middle)
    plane.SetNormal(0, 0, 1)
    cutter = vtk.vtkCutter()
    cutter.SetInputConnection(speed.GetOutputPort())
    cutter.SetCutFunction(plane)
    cutter.GenerateTrianglesOff()
    colours = vtk.vtkColorTransferFunction()
    for value, colour in SPEEDS:
        colours.AddRGBPoint(value, *colour)
    result = actor(cutter.GetOutputPort())
    mapper = result.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetLookupTable(colours)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray('speed')
    result.GetProperty().LightingOff()
    result.GetProperty().EdgeVisibilityOn()
    result.GetProperty().SetEdgeColor(.3, .33, .4)
    return result


def tubes(lines, middle, size):
    """The lines that begin in front of the plane, near it."""
    kept = vtk.vtkCellArray()
    line = vtk.vtkIdList()
    lines.GetLines().InitTraversal()
    while lines.GetLines().GetNextCell(line):
        if 0 < lines.GetPoint(line.GetId(0))[2] - middle[2] < .3 * size:
            kept.InsertNextCell(line)
    front = vtk.vtkPolyData()
    front.SetPoints(lines.GetPoints())
    front.SetLines(kept)
    tube = vtk.vtkTubeFilter()
    tube.SetInputData(front)
    tube.SetRadius(.0032 * size)
    tube.SetNumberOfSides(12)
    result = actor(tube.GetOutputPort())
    result.GetProperty().SetColor(.1, .12, .2)
    return result


def smooth(body):
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputData(body)
    normals.SplittingOff()
    result = actor(normals.GetOutputPort())
    result.GetProperty().SetColor(.93, .86, .74)
    result.GetProperty().SetSpecular(.15)
    return result


def draw(cells, lines, body, picture):
    x0, x1, y0, y1, z0, z1 = body.GetBounds()
    size = max(x1 - x0, y1 - y0, z1 - z0)
    middle = (x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for part in (section(cells, middle), tubes(lines, middle, size), smooth(body)):
        renderer.AddActor(part)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(910, 700)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(middle)
    camera.SetPosition(middle[0] - .75 * size, middle[1] + .55 * size, middle[2] + 2.75 * size)
    camera.SetViewAngle(28)
    renderer.ResetCameraClippingRange()
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


CELLS, LINES, BODY, PICTURE = sys.argv[1:]
draw(read(vtk.vtkXMLUnstructuredGridReader(), CELLS), read(vtk.vtkOBJReader(), LINES), read(vtk.vtkOBJReader(), BODY), PICTURE)
