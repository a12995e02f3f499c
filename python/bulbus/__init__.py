"""Runs Bulbus from Python: scenes with overrides, records as numpy arrays, fits of keys to measured figures.

    import bulbus
    run = bulbus.run("data/scenes/sphere_liquid.yaml", out="results/sphere", set={"mesh.shell.n": 4})
    print(run.figures["pressure"], run.units["pressure"])

Lengths are in mm, forces in N, stresses in MPa unless a probe names another unit. Needs numpy; `Run.state` needs
h5py, and `fit` needs scipy (Debian: python3-numpy, python3-h5py, python3-scipy).
"""
import sys

try:
    import numpy as _
except ModuleNotFoundError as fault:
    raise ModuleNotFoundError(f"bulbus needs numpy, which {sys.executable} does not have\n"
                              "  apt-get install python3-numpy python3-h5py python3-scipy, and call /usr/bin/python3") from fault

from .fitting import Fit, fit
from .program import BulbusError, find_program, run
from .records import Run, State

__all__ = ["BulbusError", "Fit", "Run", "State", "find_program", "fit", "run"]
