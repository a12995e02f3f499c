"""Fits keys of a scene to measured figures, by least squares."""
from __future__ import annotations

import os
import pathlib
from dataclasses import dataclass
from typing import Any, Mapping, Union

import numpy

from .program import BulbusError, run
from .records import Run

Target = Union[str, "tuple[str, str]"]  # probe, or probe and step at whose end it was measured


@dataclass(frozen=True)
class Fit:
    """Outcome of `fit`."""

    values: dict[str, float]  # by key of the scene
    figures: dict[Target, float]  # of the run with these values, in the units of the probes
    residuals: dict[Target, float]  # (figure - target) / scale
    condition: float  # of the scaled Jacobian: above 1e3 the figures hardly tell the keys apart
    runs: int
    converged: bool
    message: str
    run: Run  # with these values

    def __str__(self) -> str:
        lines = [f"{key} = {value:.6g}" for key, value in self.values.items()]
        lines += [f"{_name(target)}: {figure:.6g}, residual {self.residuals[target]:+.1e}"
                  for target, figure in self.figures.items()]
        return "\n".join(lines + [f"{self.runs} runs, condition {self.condition:.3g}: {self.message}"])


def _name(target: Target) -> str:
    return target if isinstance(target, str) else f"{target[0]} after {target[1]}"


class _Model:
    """Residuals of a scene over positions in the box of bounds, each from 0 (low) to 1 (high)."""

    def __init__(self, scene, parameters, targets, out, overrides, ranks):
        self.scene, self.out, self.overrides, self.ranks = scene, pathlib.Path(out), overrides, ranks
        self.keys = list(parameters)
        self.start, self.low, self.high = numpy.array([parameters[key] for key in self.keys], dtype=float).T
        self.targets = list(targets)
        pairs = [value if isinstance(value, tuple) else (value, abs(value)) for value in targets.values()]
        self.wanted, self.scale = numpy.array(pairs, dtype=float).T
        self.known: dict[tuple[float, ...], tuple[Run, numpy.ndarray]] = {}

    def check(self) -> None:
        for key, start, low, high in zip(self.keys, self.start, self.low, self.high):
            if not low < start < high:
                raise ValueError(f"{key}: the start {start:g} is not between {low:g} and {high:g}")
        for target, scale in zip(self.targets, self.scale):
            if not scale > 0:
                raise ValueError(f"{_name(target)}: give a target of 0 its scale, as (0, scale)")
        if len(self.targets) < len(self.keys):
            raise ValueError(f"{len(self.targets)} targets cannot determine {len(self.keys)} parameters")

    def values(self, position: numpy.ndarray) -> dict[str, float]:
        return dict(zip(self.keys, (self.low + position * (self.high - self.low)).tolist()))

    def solved(self, position: numpy.ndarray) -> tuple[Run, numpy.ndarray]:
        """The run at a position, and its figures."""
        mark = tuple(position.tolist())
        if mark not in self.known:
            values = self.values(position)
            try:
                made = run(self.scene, self.out / f"run_{len(self.known):03d}",
                           {"output.vtk": False, **self.overrides, **values}, self.ranks)
            except BulbusError as error:
                at = ", ".join(f"{key} = {value:.6g}" for key, value in values.items())
                raise BulbusError(f"{error}\nin the fit, at {at}", error.status, error.run) from None
            figures = [made.figure(*([t] if isinstance(t, str) else t)) for t in self.targets]
            if not numpy.isfinite(figures).all():
                missing = self.targets[int(numpy.argmin(numpy.isfinite(figures)))]
                raise ValueError(f"{_name(missing)}: the run has no such figure")
            self.known[mark] = made, numpy.array(figures)
        return self.known[mark]

    def residuals(self, position: numpy.ndarray) -> numpy.ndarray:
        return (self.solved(position)[1] - self.wanted) / self.scale

    def jacobian(self, position: numpy.ndarray, step: float) -> numpy.ndarray:
        """One-sided differences, away from the nearer bound."""
        here = self.residuals(position)
        steps = numpy.where(position < 0.5, step, -step)
        moved = [self.residuals(position + row) for row in numpy.diag(steps)]
        return numpy.array([(there - here) / h for there, h in zip(moved, steps)]).T


def fit(scene: str | os.PathLike[str], parameters: Mapping[str, tuple[float, float, float]],
        targets: Mapping[Target, float | tuple[float, float]], *, out: str | os.PathLike[str] = "results/fit",
        set: Mapping[str, Any] | None = None, ranks: int = 1, step: float = 1e-3, tolerance: float = 1e-6,
        max_iterations: int = 50) -> Fit:
    """Finds the keys of a scene with which its figures come closest to measured ones.

    parameters: {"regions.wall.c10": (start, low, high)}, in mm, N, MPa, rad.
    targets: {"P": 0.02} for the figure at the end of the run, {("P", "inflate"): 0.02} for that at the end of a
    step, in the unit of the probe. The sum of ((figure - target) / scale)² is minimised; the scale, |target| unless
    given as (target, scale), may be the standard deviation of the measurement.
    out: folder with a folder for each run. Result files are not written unless `set` says "output.vtk": True.
    step: of the differences for derivatives, as a part of (high - low): above the noise of the figures.
    tolerance: relative change of the parameters at which the search ends.

    Raises ValueError for a fit that cannot be, KeyError for a probe or step that the scene lacks, and BulbusError
    where a run fails. Needs scipy (`scipy.optimize.least_squares`, rectangular trust region within bounds).
    """
    from scipy.optimize import least_squares

    model = _Model(scene, parameters, targets, out, dict(set or {}), ranks)
    model.check()
    start = (model.start - model.low) / (model.high - model.low)
    best = least_squares(model.residuals, start, jac=lambda position: model.jacobian(position, step), bounds=(0, 1),
                         method="dogbox", xtol=tolerance, ftol=tolerance**2, gtol=1e-12, max_nfev=max_iterations)
    made, figures = model.solved(best.x)
    return Fit(model.values(best.x), dict(zip(model.targets, figures.tolist())),
               dict(zip(model.targets, best.fun.tolist())), float(numpy.linalg.cond(best.jac)), len(model.known),
               best.status > 0, best.message, made)
