"""Records of a run: figures, histories and result files; docs/output.md has every file, field, unit and sign."""
from __future__ import annotations

import csv
import functools
import json
import os
import pathlib
from dataclasses import dataclass
from typing import Any

import numpy


@dataclass(frozen=True)
class State:
    """Fields of one saved state. A node between two ranks is there twice."""

    time: float  # finished steps plus the part of the current one
    points: numpy.ndarray  # (nodes, 3), mm, of the undeformed body
    displacement: numpy.ndarray  # (nodes, 3), mm
    cells: numpy.ndarray  # (hexahedra, 8), numbers of their nodes in the order of VTK
    regions: dict[str, int]  # number of each region in cell_fields["region"]
    point_fields: dict[str, numpy.ndarray]  # by name, (nodes,) or (nodes, components)
    cell_fields: dict[str, numpy.ndarray]  # by name, (hexahedra,) or (hexahedra, components)
    units: dict[str, str]  # of the fields that have one

    @property
    def positions(self) -> numpy.ndarray:
        """Current positions of the nodes, mm."""
        return self.points + self.displacement

    def in_region(self, name: str) -> numpy.ndarray:
        """Mask of the hexahedra of a region. Raises KeyError with the names there are."""
        if name not in self.regions:
            raise KeyError(f"no region '{name}'; there are {', '.join(self.regions)}")
        return self.cell_fields["region"] == self.regions[name]


def _global_cells(grid: Any) -> numpy.ndarray:
    """Connectivity counts nodes from the start of each rank's piece."""
    cells = grid["Connectivity"][:].reshape(-1, 8)
    first_node = numpy.concatenate([[0], numpy.cumsum(grid["NumberOfPoints"][:])[:-1]])
    return cells + numpy.repeat(first_node, grid["NumberOfCells"][:])[:, None]


def _read_state(path: pathlib.Path, time: float) -> State:
    import h5py

    with h5py.File(path) as file:
        grid = file["VTKHDF"]
        fields = {group: {name: data[:] for name, data in grid[group].items()}
                  for group in ("PointData", "CellData")}
        units = {name: data.attrs["unit"].decode() for group in fields for name, data in grid[group].items()
                 if "unit" in data.attrs}
        labels = {name: int(data[0]) for name, data in grid["FieldData"].items()
                  if name.startswith("region_")}
        points = grid["Points"][:]
        none = numpy.zeros_like(points)  # where `output.fields` leaves displacements out
        return State(time, points, fields["PointData"].get("displacement", none), _global_cells(grid),
                     {name[len("region_"):]: number for name, number in labels.items()},
                     fields["PointData"], fields["CellData"], units)


def _column(name: str, values: list[str]) -> numpy.ndarray:
    if name == "step":
        return numpy.array(values)
    return numpy.array([float(value) if value else numpy.nan for value in values])


@dataclass(frozen=True)
class Run:
    """A folder of results, also one that the program wrote without Python: `Run("results/ball")`."""

    folder: pathlib.Path

    def __init__(self, folder: str | os.PathLike[str]):
        object.__setattr__(self, "folder", pathlib.Path(folder))

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """Everything in summary.json. Raises FileNotFoundError where the run has not ended."""
        return json.loads((self.folder / "summary.json").read_text())

    @property
    def converged(self) -> bool:
        return self.summary["converged"]

    @property
    def figures(self) -> dict[str, float]:
        """Last figure of every probe in the unit of `units`; NaN where a probe has none yet."""
        return {name: numpy.nan if value is None else value for name, value in self.summary["probes"].items()}

    @functools.cached_property
    def units(self) -> dict[str, str]:
        """Unit of every column of `history`; "" where it has none."""
        recorded = self.folder / "history.units.json"  # runs of earlier versions have units in their summary alone
        known = json.loads(recorded.read_text()) if recorded.exists() else self.summary["units"]
        return {**dict.fromkeys(self.history, ""), **known}

    @functools.cached_property
    def history(self) -> dict[str, numpy.ndarray]:
        """Columns of history.csv, one row per converged increment; NaN where a probe has no figure yet."""
        with open(self.folder / "history.csv", newline="") as file:
            rows = list(csv.reader(file))
        return {name: _column(name, [row[i] for row in rows[1:]]) for i, name in enumerate(rows[0])}

    def figure(self, probe: str, step: str | None = None) -> float:
        """Figure of a probe at the end of a step (default: at the end of the run), in its unit.

        Raises KeyError with the names there are.
        """
        if probe not in self.figures:
            raise KeyError(f"no probe '{probe}'; there are {', '.join(self.figures)}")
        if step is None:
            return self.figures[probe]
        rows = numpy.flatnonzero(self.history["step"] == step)
        if not rows.size:
            raise KeyError(f"no step '{step}'; there are {', '.join(dict.fromkeys(self.history['step']))}")
        return float(self.history[probe][rows[-1]])

    @functools.cached_property
    def _saved(self) -> list[dict[str, Any]]:
        return json.loads((self.folder / "result.hdf.series").read_text())["files"]

    @property
    def times(self) -> numpy.ndarray:
        """Pseudo-times of the saved states; the first is that before any load."""
        return numpy.array([entry["time"] for entry in self._saved])

    def state(self, number: int = -1) -> State:
        """Fields of a saved state by its place in `times` (default: the last). Needs h5py."""
        entry = self._saved[number]
        return _read_state(self.folder / entry["name"], entry["time"])
