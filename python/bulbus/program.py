"""Finds the program and runs it."""
from __future__ import annotations

import json
import os
import pathlib
import shutil
import subprocess
from typing import Any, Mapping

from .records import Run


class BulbusError(RuntimeError):
    """The program refused a scene (`status` 2) or did not converge (1); the text is its own message.

    `run` has what was recorded up to the last converged increment, or is None where nothing was.
    """

    def __init__(self, message: str, status: int, run: Run | None):
        super().__init__(message)
        self.status = status
        self.run = run


def find_program() -> str:
    """The program: that of the environment variable BULBUS, of PATH, or of the tree or prefix which this file is in.

    Raises FileNotFoundError if there is none.
    """
    here = pathlib.Path(__file__).resolve()
    nearby = [here.parents[2] / "build/bulbus", *(up / "bin/bulbus" for up in here.parents[4:5])]
    for candidate in (os.environ.get("BULBUS"), "bulbus", *map(str, nearby)):
        found = shutil.which(candidate) if candidate else None
        if found:
            return found
        if candidate and candidate == os.environ.get("BULBUS"):
            raise FileNotFoundError(f"BULBUS={candidate} is no program")
    raise FileNotFoundError("no program 'bulbus': put its folder on PATH, or its path into the variable BULBUS")


def _as_override(key: str, value: Any) -> str:
    """`key=value` as --set reads it: text as it stands ("50 kPa"), else JSON, which is YAML."""
    return f"{key}={value if isinstance(value, str) else json.dumps(value)}"


def _message(done: subprocess.CompletedProcess[str]) -> str:
    """What the program says of its failure on standard error, where lines of the log begin with `error: `."""
    said = "\n".join(line.removeprefix("error: ") for line in done.stderr.strip().splitlines())
    return said or f"the program ended with exit status {done.returncode}\n{done.stdout[-1000:]}"


def run(scene: str | os.PathLike[str], out: str | os.PathLike[str] | None = None,
        set: Mapping[str, Any] | None = None, ranks: int = 1) -> Run:
    """Solves a scene and returns its records.

    out: folder of the results (default: results/ and the name of the scene).
    set: overrides by their path, such as {"mesh.shell.n": 4, "regions.wall.c10": "50 kPa"}; a number without a unit
    is in mm, N, MPa, rad.
    ranks: MPI ranks; above 1 the program is started by mpirun.

    Raises BulbusError with the program's message if the exit status is not 0.
    """
    folder = pathlib.Path(out) if out is not None else pathlib.Path("results") / pathlib.Path(scene).stem
    command = [find_program(), "run", os.fspath(scene), "-o", os.fspath(folder)]
    if ranks > 1:
        command = ["mpirun", "-n", str(ranks), *command]
    if set:
        command += ["--set", *(_as_override(key, value) for key, value in set.items())]
    done = subprocess.run(command, text=True, capture_output=True)
    if done.returncode:
        recorded = done.returncode != 2 and (folder / "summary.json").exists()
        raise BulbusError(_message(done), done.returncode, Run(folder) if recorded else None)
    return Run(folder)
