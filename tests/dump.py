#!/usr/bin/env python3
"""Dumped linear systems solved by scipy: its sparse LU finds what Bulbus found.

    python3 tests/dump.py build/bulbus

Exit status 77 where Debian's python3-scipy is missing.
"""
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
    import scipy.io
    import scipy.sparse.linalg
except ImportError:
    print("skipped: there is no scipy (Debian's python3-scipy)")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parent.parent
OF_GMRES = 1e-9
OF_LU = 1e-11
AMPLIFIED = 1000  # error of a solution over its scaled residual, at most: 250 is the largest here


def call(*command):
    run = subprocess.run([str(c) for c in command], text=True, capture_output=True)
    assert run.returncode == 0, run.stdout[-2000:] + run.stderr
    return run.stdout


def parts(dump):
    """Matrix and vectors that `bulbus matrix-market` makes of a dump, by name."""
    call(sys.argv[1], "matrix-market", dump)
    stem = dump.with_suffix("")
    read = {"matrix": scipy.io.mmread(f"{stem}.mtx").tocsc()}
    for name in ("rhs", "solution", "scaling", "kind", "coordinates", "near_null_space"):
        read[name] = np.squeeze(scipy.io.mmread(f"{stem}_{name}.mtx"))
    with open(f"{stem}.mtx") as file:
        comments = [line.split() for line in file if line.startswith("% ")]
    return read | {name: float(value) for _, name, value in comments}


def check(dump):
    p = parts(dump)
    allowed = max(p["tolerance"], OF_LU)
    A, s = p["matrix"], p["scaling"]
    exact = scipy.sparse.linalg.splu(A).solve(p["rhs"])
    scaled = np.linalg.norm(s * (A @ p["solution"] - p["rhs"])) / np.linalg.norm(s * p["rhs"])
    # both solutions in units of 1: scaling is about 1 / sqrt(diagonal)
    difference = np.linalg.norm((p["solution"] - exact) / s) / np.linalg.norm(exact / s)
    kinds = [int((p["kind"] == k).sum()) for k in range(4)]
    print(f"{dump.parent.parent.name} {dump.name}: {A.shape[0]} unknowns by kind {kinds}, scaled residual {scaled:.1e} of {p['tolerance']:.1e}, difference from scipy {difference:.1e}")
    assert p["coordinates"].shape == (A.shape[0], 3) and p["near_null_space"].shape == (A.shape[0], 6)
    assert p["converged"] == 1 and kinds[0] > 0 and kinds[1] > 0
    assert scaled < 1.01 * allowed and difference < AMPLIFIED * allowed


def main():
    with tempfile.TemporaryDirectory() as folder:
        for method, scene, more in [("iterative", "sphere_liquid", []), ("direct", "sphere_liquid", []),
                                    ("iterative", "zonules", ["mesh.refine=0"])]:
            out = pathlib.Path(folder) / (scene + method)
            call(sys.argv[1], "run", ROOT / f"data/scenes/{scene}.yaml", "-o", out, "--set", f"solver.linear.method={method}",
                 "solver.linear.dump=systems", *([f"solver.newton.eta_max={OF_GMRES}"] if method == "iterative" else []), *more)
            dumps = sorted((out / "systems").glob("*.h5"))
            for dump in dict.fromkeys((dumps[0], dumps[-1] if scene == "sphere_liquid" else dumps[0])):
                check(dump)
    return 0


if __name__ == "__main__":
    sys.exit(main())
