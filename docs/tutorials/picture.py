#!/usr/bin/env python3
"""Renders saved states of a run side by side, coloured by Mises stress; symmetry images in grey, rigid bodies translucent.

    PYTHONPATH=python xvfb-run -a python3 docs/tutorials/picture.py PICTURE.png FOLDER '0=at rest' '4=full'

Options: --from X Y Z (direction of the viewer), --mirror xz (planes across which images are shown), --ranks (colour by the rank
that owned a cell). Needs Debian's python3-vtk9, python3-h5py, xvfb and libgl1-mesa-dri.
"""
import argparse
import itertools
import os

import h5py
import vtk
from vtk.util.numpy_support import numpy_to_vtk

import bulbus

WIDTH, HEIGHT, SCALE = 420, 430, 130  # of a state, of the scale; pixels


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("picture")
    parser.add_argument("folder")
    parser.add_argument("states", nargs="+")
    parser.add_argument("--from", dest="viewer", nargs=3, type=float, default=(-1, -2, 0.8))
    parser.add_argument("--mirror", default="")
    parser.add_argument("--ranks", action="store_true")
    return parser.parse_args()


def surface(run, number, ranks):
    """Outer faces of the deformed body with the colour as their cell scalar."""
    state = run.state(number)
    grid, points = vtk.vtkUnstructuredGrid(), vtk.vtkPoints()
    points.SetData(numpy_to_vtk(state.positions, deep=1))
    grid.SetPoints(points)
    for cell in state.cells:
        grid.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, cell.tolist())
    colour = 1000 * state.cell_fields["mises"].astype(float)
    if ranks:
        with h5py.File(run.folder / f"result_{number:04d}.hdf") as file:
            colour = [float(rank) for rank, cells in enumerate(file["VTKHDF/NumberOfCells"]) for _ in range(cells)]
    scalars = vtk.vtkDoubleArray()
    for value in colour:
        scalars.InsertNextValue(value)
    grid.GetCellData().SetScalars(scalars)
    outside = vtk.vtkDataSetSurfaceFilter()
    outside.SetInputData(grid)
    outside.Update()
    return outside.GetOutput(), max(colour)


def actor(data, table=None, opacity=1.0):
    mapper, made = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputData(data)
    made.SetMapper(mapper)
    made.GetProperty().SetOpacity(opacity)
    made.GetProperty().SetColor(0.8, 0.8, 0.82)
    made.GetProperty().SetAmbient(0.25)
    made.GetProperty().SetDiffuse(0.8)
    if table:
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
        made.GetProperty().EdgeVisibilityOn()
        made.GetProperty().SetEdgeColor(0.2, 0.2, 0.2)
    else:
        mapper.ScalarVisibilityOff()
    return made


def images(axes):
    """Scales of the images across planes of symmetry: all sign changes but none."""
    signs = [(1, -1) if axis in axes else (1,) for axis in "xyz"]
    return [scale for scale in itertools.product(*signs) if scale != (1, 1, 1)]


def body(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def view(args, data, number, title, table):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor(data, table))
    for scale in images(args.mirror):
        image = actor(data)
        image.SetScale(*scale)
        renderer.AddActor(image)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*args.viewer)
    camera.SetViewUp(0, 0, 1)
    camera.ParallelProjectionOn()
    renderer.ResetCamera()
    camera.Zoom(0.9)
    path = f"{args.folder}/bodies_{number:04d}.vtp"
    if os.path.exists(path):
        renderer.AddActor(actor(body(path), opacity=0.25))
        renderer.ResetCameraClippingRange()
    text = vtk.vtkTextActor()
    text.SetInput(title)
    text.SetPosition(12, 8)
    text.GetTextProperty().SetFontSize(20)
    text.GetTextProperty().SetColor(0, 0, 0)
    renderer.AddActor2D(text)
    return renderer


def colours(high):
    """From pale yellow to dark blue: also read in grey."""
    table, ramp = vtk.vtkLookupTable(), vtk.vtkColorTransferFunction()
    for part, red, green, blue in ((0, 1, 0.97, 0.75), (0.35, 0.5, 0.8, 0.73), (0.7, 0.15, 0.5, 0.72), (1, 0.05, 0.15, 0.45)):
        ramp.AddRGBPoint(part, red, green, blue)
    table.SetRange(0, high)
    for i in range(256):
        table.SetTableValue(i, *ramp.GetColor(i / 255))
    return table


def legend(table, title, labels):
    bar, renderer = vtk.vtkScalarBarActor(), vtk.vtkRenderer()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(labels)
    bar.SetLabelFormat("%.3g")
    bar.SetVerticalTitleSeparation(12)
    bar.UnconstrainedFontSizeOn()
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(16)
        text.ShadowOff()
        text.ItalicOff()
    bar.SetPosition(0.1, 0.12)
    bar.SetWidth(0.8)
    bar.SetHeight(0.76)
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor2D(bar)
    return renderer


def round_up(value):
    """The next of 1, 2, 4, 10 times a power of ten, so that the ticks are round."""
    power = 10.0 ** len(str(int(value))) / 10 if value >= 1 else 0.1
    return next(power * digit for digit in (1, 2, 4, 6, 8, 10) if power * digit >= value)


def main():
    args = arguments()
    states = [(int(number), title) for number, title in (state.split("=", 1) for state in args.states)]
    run = bulbus.Run(args.folder)
    surfaces = [surface(run, number, args.ranks) for number, _ in states]
    table = colours(max(high for _, high in surfaces) if args.ranks else round_up(max(high for _, high in surfaces)))
    window, width = vtk.vtkRenderWindow(), WIDTH * len(states) + SCALE
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(width, HEIGHT)
    for i, ((number, title), (data, _)) in enumerate(zip(states, surfaces)):
        renderer = view(args, data, number, title, table)
        renderer.SetViewport(WIDTH * i / width, 0, WIDTH * (i + 1) / width, 1)
        window.AddRenderer(renderer)
    last = legend(table, "rank" if args.ranks else "Mises, kPa", 2 if args.ranks else 3)
    last.SetViewport(1 - SCALE / width, 0, 1, 1)
    window.AddRenderer(last)
    window.Render()
    image, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
    image.SetInput(window)
    writer.SetFileName(args.picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


main()
