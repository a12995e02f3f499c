#!/usr/bin/env python3
"""Exported models in CalculiX (ccx): a stretched block and a pressurised thick sphere, at two mesh sizes, against Bulbus's own runs.

    python3 tests/calculix.py build/bulbus

CalculiX's C3D8I has incompatible modes where Bulbus's Q1/P0 has a pressure, and its material is compressible. Bulk moduli of 250 and 500
times the shear modulus extrapolate to an incompressible one (figures are linear in 1/bulk modulus); what remains is the difference of the
elements, which has to shrink with the mesh size. Exit status 77 where ccx is missing.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = """mesh: {block: {upper: [10, 4, 4], nx: %d, ny: %d, nz: %d}}
regions: {block: {c10: 50 kPa}}
symmetry: [y]
fix: [{set: xmin}]
steps: [{name: pull, increments: 4, displace: [{set: xmax, x: 3, y: 0, z: 0}]}]
probes:
  - {name: force, kind: reaction, set: xmax, component: x}
  - {name: waist, kind: displacement, set: ymax, component: y, statistic: min}
solver: {linear: {method: direct}}
"""
SPHERE = """mesh: {shell: {inner: 10, outer: 14, n: %d, layers: %d}}
regions: {shell: {c10: 40 kPa, c01: 10 kPa}}
symmetry: [x, y, z]
liquids: {inside: {surface: inner}}
steps: [{name: inflate, increments: 4, pressures: {inside: 15 kPa}}]
probes:
  - {name: inner, kind: displacement, set: inner}
  - {name: outer, kind: displacement, set: outer}
solver: {linear: {method: direct}}
"""
BULK = 250


def call(*command, cwd):
    run = subprocess.run([str(c) for c in command], cwd=cwd, text=True, capture_output=True)
    assert run.returncode == 0, run.stdout[-2000:] + run.stderr
    return run.stdout


def tables(dat):
    """Rows of the last table of displacements and of forces of every set, by its name in capitals."""
    found, rows = {}, None
    for line in dat.read_text().splitlines():
        head = re.match(r"\s*(displacements|forces|total force).* for set (\S+) and time\s+(\S+)", line)
        if head:
            rows = found[head[1], head[2]] = []
            found["time"] = float(head[3])
        elif line.strip() and rows is not None:
            rows.append([float(word) for word in line.split()])
    return found


def in_calculix(here, bulk):
    call(PROGRAM, "export", "s.yaml", "--to", "model.inp", "--bulk", bulk, cwd=here)
    call("ccx", "-i", "model", cwd=here)
    found = tables(here / "model.dat")
    assert found["time"] == 1, f"ccx ended at {found['time']} of the step"
    return found


def length(u):
    return sum(c * c for c in u) ** .5


def block_figures(found):
    return {"force": 2 * found["total force", "XMAX"][-1][0], "waist": min(row[2] for row in found["displacements", "YMAX"])}


def sphere_figures(found):
    """Means of |u|, as the probe has them."""
    return {s.lower(): sum(length(r[1:]) for r in rows) / len(rows) for s in ("INNER", "OUTER") for rows in [found["displacements", s]]}


def differences(here, scene, figures_of):
    """Relative differences of the figures that CalculiX extrapolates to an incompressible material, and at the smaller bulk modulus."""
    (here / "s.yaml").write_text(scene)
    call(PROGRAM, "run", "s.yaml", "-o", "out", cwd=here)
    own = json.loads((here / "out/summary.json").read_text())["probes"]
    soft, stiff = (figures_of(in_calculix(here, bulk)) for bulk in (BULK, 2 * BULK))
    return {k: ((2 * stiff[k] - soft[k]) / own[k] - 1, soft[k] / own[k] - 1) for k in own}


def main():
    global PROGRAM
    PROGRAM = pathlib.Path(sys.argv[1]).resolve()
    if not shutil.which("ccx"):
        print("skipped: there is no ccx (Debian's calculix-ccx)")
        return 77
    models = [("block", BLOCK, [(5, 2, 2), (10, 4, 4)], block_figures), ("sphere", SPHERE, [(2, 2), (4, 4)], sphere_figures)]
    with tempfile.TemporaryDirectory() as folder:
        for name, scene, sizes, figures_of in models:
            coarse, fine = (differences(pathlib.Path(folder), scene % size, figures_of) for size in sizes)
            for k in coarse:
                print(f"{name} {k}: differs by {100 * coarse[k][0]:+.3f} % and, at half the mesh size, {100 * fine[k][0]:+.3f} %; "
                      f"with a bulk modulus of {BULK} shear moduli {100 * fine[k][1]:+.3f} %")
                assert abs(coarse[k][0]) < .03, "more than the elements can differ by"
                assert abs(fine[k][0]) < .6 * abs(coarse[k][0]), "does not shrink with the mesh size"
    return 0


if __name__ == "__main__":
    sys.exit(main())
