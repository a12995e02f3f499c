#!/usr/bin/env python3
"""Does the forecast of memory keep to what runs take? Its constants are in app/memory/memory_parts.cpp and core/solve/direct_memory.hpp.

    memory.py BULBUS FOLDER [--set KEY=VALUE ...]

Runs a small indentation of the half eye on meshes of each kind, and blocks and shells, with both solvers, and prints for each the
forecast and the peak (MB over all ranks), their ratio, and the parts that are both forecast and tallied. FOLDER keeps the runs.
"""
import argparse
import json
import pathlib
import subprocess

SCENES = pathlib.Path(__file__).resolve().parent.parent / "data/scenes"
EYE = ["steps.1.displace.0.radial=-.1", "steps.1.increments=1", "output.checkpoint=1"]
RUNS = [("half_eye", [*EYE, *mesh, f"solver.linear.method={method}"])
        for method, meshes in (("iterative", (["mesh.eye.n=8"], ["mesh.eye.n=14"], ["mesh.eye.n=10", "mesh.refine=1"], ["mesh.eye.n=6", "mesh.refine=2"])),
                               ("direct", (["mesh.eye.n=8"], ["mesh.eye.n=14"])))
        for mesh in meshes]
RUNS += [("block_stretch", [f"mesh.block.n{axis}=20" for axis in "xyz"] + [f"solver.linear.method={m}"]) for m in ("iterative", "direct")]
RUNS += [("sphere_liquid", ["mesh.shell.n=16", f"solver.linear.method={m}"]) for m in ("iterative", "direct")]
# forecast parts against parts of the tally
PARTS = {"displacement block": (["smoother", "coarse matrix", "coarser levels", "base factors"], ["displacement preconditioner"]),
         "Krylov basis": (["Krylov basis"], ["Krylov basis"]), "factors": (["factors"], ["factor"])}


def megabytes(program, folder, number, scene, settings):
    out = folder / f"run_{number:02d}"
    if not (out / "summary.json").exists():
        command = [program, "run", SCENES / f"{scene}.yaml", "-o", out, "--set", *settings]
        subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    return json.loads((out / "summary.json").read_text())["memory_mb"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("bulbus")
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--set", nargs="+", default=[])
    a = arguments.parse_args()
    for number, (scene, settings) in enumerate(RUNS):
        mb = megabytes(a.bulbus, a.folder, number, scene, settings + a.set)
        forecast, peak = mb["forecast"]["together"], mb["process_peak"]["all_ranks"]
        print(f"{scene} {' '.join(s for s in settings if s not in EYE)}: {forecast:.0f} forecast, {peak:.0f} taken, ratio {forecast / peak:.2f}")
        for name, (expected, tallied) in PARTS.items():
            found = sum(mb["parts"].get(p, {}).get("all_ranks", 0) for p in tallied)
            if found:
                print(f"    {name:<20} {sum(mb['forecast'].get(p, 0) for p in expected):8.1f} {found:8.1f}")


if __name__ == "__main__":
    main()
