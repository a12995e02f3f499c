#!/usr/bin/env python3
"""The encircling operation with and without drainage, for the table of docs/operation.md: every figure after every step.

    benchmarks/drainage.py build/bulbus -n 8 -o docs/operation.csv        four runs per mesh; benchmarks/tables.py --write makes the table
    benchmarks/drainage.py build/bulbus -n 14 -o docs/operation.csv --append
"""
import argparse
import csv
import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent.parent
RUNS = [("`paper`, band of fixed length", "encircling", []),
        ("`physiological`, band of fixed length", "encircling", ["materials=physiological"]),
        ("`physiological`, elastic band, drained after", "drainage", []),
        ("`physiological`, elastic band, drained while it is tightened", "drainage", ["steps.buckle.add.vitreous=-50 uL"])]
FIGURES = ["IOP", "IOP_peak", "axial_change", "refraction", "corneal_power", "corneal_astigmatism", "indentation_depth",
           "buckle_height_front", "buckle_height_back", "tear_sealed", "retina_reattached", "retina_gap_max",
           "choroid_contact_pressure", "tire_contact_pressure", "band_tension", "suture_mises_mean", "drained"]


def after_steps(folder):
    """The last row of every step, with the iterations of all increments up to it."""
    ends, newton, krylov = {}, 0, 0
    with open(pathlib.Path(folder) / "history.csv") as file:
        for row in csv.DictReader(file):
            newton, krylov = newton + int(row["newton_iterations"]), krylov + int(row["krylov_iterations"])
            ends[row["step"]] = row | {"newton": newton, "krylov": krylov}
    return ends


def run(program, n, name, scene, overrides, folder):
    command = [program, "run", str(HERE / f"data/scenes/{scene}.yaml"), "-o", folder, "--set", f"mesh.eye.n={n}", "output.vtk=false", *overrides]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{name}:\n{done.stdout[-2000:]}{done.stderr}")
    return [{"run": name, "n": n, "step": step, **{f: row.get(f, "") for f in FIGURES}, "newton": row["newton"], "krylov": row["krylov"]}
            for step, row in after_steps(folder).items()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("-n", type=int, default=8)
    parser.add_argument("-o", required=True)
    parser.add_argument("--append", action="store_true")
    given = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for k, (name, scene, overrides) in enumerate(RUNS):
            rows += run(given.program, given.n, name, scene, overrides, f"{scratch}/{k}")
    with open(given.o, "a" if given.append else "w", newline="") as file:
        table = csv.DictWriter(file, ["run", "n", "step", *FIGURES, "newton", "krylov"], lineterminator="\n")
        if not given.append:
            table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    main()
