#!/usr/bin/env python3
"""Renders saved states of a run side by side, seen on the plane x = 0, coloured by Mises stress; rigid bodies are grey.

    xvfb-run -a python3 docs/render.py docs/encircling.png results/encircling '1=15 mmHg' '5=band and tire in' '9=sewn'

Arguments: picture, folder of results, saved states as number=title. Needs Debian's python3-vtk9, xvfb and libgl1-mesa-dri.
"""
import os
import sys

import vtk


def deformed(path):
    reader = vtk.vtkHDFReader()
    reader.SetFileName(path)
    warp = vtk.vtkWarpVector()
    warp.SetInputConnection(reader.GetOutputPort())
    warp.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputConnection(warp.GetOutputPort())
    surface.Update()
    return surface


def bodies(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.75, 0.75, 0.78)
    return actor


def colours(low, high):
    table = vtk.vtkLookupTable()
    table.SetScaleToLog10()
    table.SetRange(low, high)
    table.SetHueRange(0.62, 0.0)
    table.Build()
    return table


def view(surface, table, title, left, right):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("mises")
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    if surface.GetOutput().GetNumberOfCells() < 200000:  # more would be black with edges
        actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.25, 0.25, 0.25)
    actor.GetProperty().SetLineWidth(0.3)
    text = vtk.vtkTextActor()
    text.SetInput(title)
    text.SetPosition(16, 12)
    text.GetTextProperty().SetFontSize(22)
    text.GetTextProperty().SetColor(0, 0, 0)
    renderer = vtk.vtkRenderer()
    renderer.SetViewport(left, 0, right, 1)
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    renderer.AddActor2D(text)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(-60, 0, -3)
    camera.SetFocalPoint(0, 0, -3)
    camera.SetViewUp(0, 1, 0)
    camera.ParallelProjectionOn()
    camera.SetParallelScale(18)
    renderer.ResetCameraClippingRange()
    return renderer


def legend(table):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("Mises, MPa")
    bar.SetNumberOfLabels(4)
    bar.GetTitleTextProperty().SetColor(0, 0, 0)
    bar.GetLabelTextProperty().SetColor(0, 0, 0)
    bar.SetPosition(0.1, 0.15)
    bar.SetWidth(0.8)
    bar.SetHeight(0.7)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor2D(bar)
    return renderer


def main():
    picture, folder, states = sys.argv[1], sys.argv[2], [s.split("=", 1) for s in sys.argv[3:]]
    width = 640 * len(states) + 140
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(width, 560)
    table = colours(1e-4, 0.15)
    for i, (number, title) in enumerate(states):
        surface = deformed(f"{folder}/result_{int(number):04d}.hdf")
        renderer = view(surface, table, title, 640 * i / width, 640 * (i + 1) / width)
        rigid = f"{folder}/bodies_{int(number):04d}.vtp"
        if os.path.exists(rigid):
            renderer.AddActor(bodies(rigid))
        window.AddRenderer(renderer)
    last = legend(table)
    last.SetViewport(640 * len(states) / width, 0, 1, 1)
    window.AddRenderer(last)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


main()
