#!/usr/bin/env python3
"""Opens every result of a run in ParaView as a double click does, and compares it with what h5py finds in the files.

    pvpython --force-offscreen-rendering tests/open_in_paraview.py build/bulbus SCENE.yaml ... DIR ...

Scenes are run first. Needs Debian's python3-paraview and python3-h5py. Exit status: 0 if everything opens and agrees, 1 if
not, 77 without h5py.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import h5py
except ModuleNotFoundError:
    print("h5py is not installed")
    sys.exit(77)
from paraview import servermanager, simple

faults = []


def expect(condition, words):
    if not condition:
        faults.append(words)
        print("  FAULT:", words)


def opened(path, time=None):
    """The times of a file, and its data at one; no data where ParaView has no reader for it."""
    try:
        reader = simple.OpenDataFile(str(path))
    except RuntimeError as fault:
        reader = None
        print(" ", fault)
    expect(reader is not None, f"{path}: no reader")
    if reader is None:
        return [], None
    reader.UpdatePipeline() if time is None else reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    if data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    times = list(reader.TimestepValues) if hasattr(reader, "TimestepValues") else []
    simple.Delete(reader)  # closes the file, which h5py would do first at the end
    return times, data


def names(attributes):
    return {attributes.GetAbstractArray(i).GetName() for i in range(attributes.GetNumberOfArrays())}


def held(path):
    """Points, cells and names of what a file holds. To be read before ParaView opens the file: both have the same HDF5 library."""
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        count = [int(root[name][:].sum()) for name in ("NumberOfPoints", "NumberOfCells")]
        regions = {name: int(data[0]) for name, data in root["FieldData"].items()}
        return count, {group: set(root[group]) for group in ("PointData", "CellData")}, regions


def compare(path, data, wanted):
    count, fields, regions = wanted
    expect([data.GetNumberOfPoints(), data.GetNumberOfCells()] == count, f"{path}: points and cells")
    for group, names_there in (*fields.items(), ("FieldData", set(regions))):
        lost = names_there - names(getattr(data, f"Get{group}")())
        expect(not lost, f"{path}: {group} lacks {lost}")
    expect(any(name.startswith("region_") for name in regions), f"{path}: no names of regions")


def check_series(folder):
    index = folder / "result.hdf.series"
    states = json.loads(index.read_text())["files"]
    wanted = [held(folder / s["name"]) for s in states]
    times, data = opened(index, states[-1]["time"])
    if data is None:
        return
    expect(times == [s["time"] for s in states], f"{index}: times {times}")
    compare(index, data, wanted[-1])
    for state, of_file in zip(states, wanted):
        _, alone = opened(folder / state["name"])
        if alone is not None:
            compare(folder / state["name"], alone, of_file)
    fields = sorted(names(data.GetPointData()) | names(data.GetCellData()))
    print(f"  {index.name}: {len(states)} states, {wanted[-1][0]} points and cells, {', '.join(fields)}; {wanted[-1][2]}")


def check_collection(index):
    entries = re.findall(r'timestep="([^"]*)".*file="([^"]*)"', index.read_text())
    times, data = opened(index, float(entries[-1][0]))
    if data is None:
        return
    expect(len(times) in (0, len(entries)), f"{index}: times {times}")
    for _, file in entries:
        opened(index.parent / file)
    fields = sorted(names(data.GetCellData()) | names(data.GetFieldData()))
    print(f"  {index.name}: {len(entries)} states, {data.GetNumberOfPoints()} points, {data.GetNumberOfCells()} cells, {', '.join(fields)}")


def run(program, scene, folder):
    """Apart from the MPI that pvpython has started."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_", "PMIX_", "ORTE_", "OPAL_"))}
    environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    subprocess.run([program, "run", scene, "-o", folder], env=environment, stdout=subprocess.DEVNULL, check=True)


def main():
    program, *arguments = sys.argv[1:]
    with tempfile.TemporaryDirectory() as temporary:
        for argument in arguments:
            folder = pathlib.Path(argument)
            if folder.suffix == ".yaml":
                folder = pathlib.Path(temporary) / folder.stem
                run(program, argument, folder)
            print(argument)
            check_series(folder)
            for index in sorted(folder.glob("*.pvd")):
                check_collection(index)
    print(f"{len(faults)} faults" if faults else "everything opens")
    return 1 if faults else 0


sys.exit(main())
