#!/usr/bin/env python3
"""Does every preset of accuracy keep its promise, however far the bodies close and in however few increments?

    presets.py BULBUS FOLDER [-o presets.json] [-j 1] [--set KEY=VALUE ...]

Runs band, encircling and segmental (study_band varies the depth of band.yaml) with every preset, with the increments of the
scene and with one, at depths of 0.5 to 3 mm. The reference of a depth is `tight` with the increments of the scene. A row says
the figure that is farthest off, relative to itself, or why the run stopped. Runs that FOLDER has already are not repeated.
"""
import argparse
import concurrent.futures
import json
import pathlib
import subprocess

SCENES = pathlib.Path(__file__).resolve().parent.parent / "data/scenes"
DEPTHS = [.5, 1, 1.5, 2, 2.5, 3]
MOVES = {"band": ("close", ["band"]), "encircling": ("buckle", ["band", "tire"]), "segmental": ("buckle", ["tire"])}
PROMISE = {"fast": 2e-2, "balanced": 2e-3, "tight": 1e-4}  # relative to a converged solution on the same mesh: help solver
SMALL = {"mm": 1e-3, "mm2": .1}  # of figures that are zero but for round-off or a node more or less


def run(program, folder, more, scene, depth, accuracy, one):
    name = f"{scene}_{depth}_{accuracy}_{'one' if one else 'own'}"
    out = folder / name
    if not (out / "summary.json").exists():
        step, bodies = MOVES[scene]
        keys = [f"solver.accuracy={accuracy}"] + [f"steps.{step}.move.{b}.close={depth}" for b in bodies] + more
        if one:
            keys += [f"steps.{step}.increments=1"] + (["steps.sew.increments=1"] if scene != "band" else [])
        out.mkdir(parents=True, exist_ok=True)
        with open(folder / f"{name}.log", "w") as log:
            status = subprocess.run([program, "run", SCENES / f"{scene}.yaml", "-o", out, "--set", *keys], stdout=log, stderr=log).returncode
        (folder / f"{name}.status").write_text(str(status))
    summary = json.loads((out / "summary.json").read_text())
    return {"scene": scene, "depth": depth, "accuracy": accuracy, "increments": "one" if one else "scene's",
            "status": int((folder / f"{name}.status").read_text()), "reason": summary["reason"], "probes": summary["probes"],
            "units": summary["units"], **{k: summary["totals"].get(k) for k in ("newton_iterations", "krylov_iterations", "cuts")}}


def deviation(row, reference):
    """Largest relative difference of a figure, and which."""
    worst = (0., "")
    for name, value in row["probes"].items():
        wanted = reference["probes"][name]
        if value is None or wanted is None:
            continue
        scale = max(abs(wanted), SMALL.get(row["units"].get(name), 0))
        worst = max(worst, (abs(value - wanted) / scale if scale else float(value != wanted), name))
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("-j", "--jobs", type=int, default=1)
    parser.add_argument("--set", nargs="*", default=[])
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    plan = [(scene, depth, accuracy, one) for scene in MOVES for depth in DEPTHS for accuracy in reversed(PROMISE) for one in (False, True)]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        rows = list(pool.map(lambda p: run(arguments.program, arguments.folder, arguments.set, *p), plan))
    references = {(r["scene"], r["depth"]): r for r in rows if r["accuracy"] == "tight" and r["increments"] != "one"}
    for row in rows:
        reference = references[row["scene"], row["depth"]]
        if row["status"] == 0 and reference["status"] == 0:
            row["deviation"], row["figure"] = deviation(row, reference)
            row["kept"] = row["deviation"] <= PROMISE[row["accuracy"]]
        print(*(row.get(k, "") for k in ("scene", "depth", "accuracy", "increments", "status", "deviation", "figure", "kept", "newton_iterations",
                                         "cuts", "reason")), sep="\t")
    if arguments.output:
        for row in rows:
            del row["probes"], row["units"]
        arguments.output.write_text(json.dumps({"rows": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
