"""SIGINT and SIGTERM: a run ends at a safe point and goes on from there; a second one ends it at once."""
import csv
import os
import signal
import subprocess
import time

from kills import children_of
from runs import HERE, PATIENCE, environment

LONG = ["--set", "mesh.block.nx=20", "mesh.block.ny=20", "mesh.block.nz=10"]
LONG_SOLVE = ["solver.linear.method=iterative", "solver.linear.displacement=jacobi", "solver.linear.max_iterations=100000",
              "solver.linear.fallback=none", "solver.newton.eta_max=1e-14"]


def wait_for_line(file, words):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if file.exists() and words in file.read_text():
            return
        time.sleep(.005)


def ended(process, expected, where):
    status = process.wait(timeout=PATIENCE)
    return [] if status == expected else [f"{where}: status {status} in place of {expected}"]


def of_a_run(runs, ranks, number):
    where, out = f"interrupted on {ranks} ranks", runs.fresh()
    process = runs.start(out, ranks)
    wait_for_line(out / "run.log", "increment 1 converged")
    pid = process.pid if ranks == 1 else children_of(process.pid)[-1]
    os.kill(pid, number)
    losses = ended(process, 128 + number, where)
    summary = runs.summary(out)
    if summary["converged"]:
        return losses + [where + ": too late to tell anything"]
    if summary["reason"] != "interrupted" or "interrupted by" not in (out / "run.log").read_text():
        losses.append(where + ": no word of it")
    fault = runs.unwhole(out) or runs.finish(out, ranks)
    return losses + ([f"{where}: {fault}"] if fault else [])


def amid_a_long_solve(runs, ranks):
    where, out = f"interrupted amid a long solve on {ranks} ranks", runs.fresh()
    process = runs.start(out, ranks, *LONG, *LONG_SOLVE)
    wait_for_line(out / "run.log", "from 0 to")
    time.sleep(.5)
    os.kill(process.pid if ranks == 1 else children_of(process.pid)[-1], signal.SIGTERM)
    losses = ended(process, 143, where)
    if not (out / "checkpoint.h5").exists() or runs.summary(out)["totals"]["increments"] != 0:
        losses.append(where + ": it was not in the first solve, or left no checkpoint")
    return losses


def twice(runs):
    out = runs.fresh()
    process = runs.start(out, 1, *LONG)
    wait_for_line(out / "run.log", "from 0 to")
    for _ in range(2):
        process.send_signal(signal.SIGINT)
        time.sleep(.05)
    losses = ended(process, -signal.SIGINT, "interrupted twice")
    fault = runs.unwhole(out)
    return losses + ([f"interrupted twice: {fault}"] if fault else [])


def of_a_study(runs):
    file, out = runs.folder / "study.yaml", runs.fresh()
    file.write_text(f"scene: {HERE / 'scene.yaml'}\nvary: [{{name: stiffness, keys: [regions.block.c10], values: [40 kPa, 50 kPa, 60 kPa]}}]\n")
    command = [runs.program, "study", str(file), "-o", str(out)]
    process = subprocess.Popen(command, env=environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wait_for_line(out / "study.log", "run_002 of 3")
    process.send_signal(signal.SIGTERM)
    losses = ended(process, 143, "an interrupted study")
    again = subprocess.run(command, env=environment(), capture_output=True, text=True, timeout=PATIENCE)
    if again.returncode != 0 or "run_001 is there already" not in again.stdout or "run_003 is there already" in again.stdout:
        losses.append(f"an interrupted study, again: {again.returncode} {again.stdout} {again.stderr}")
    rows = list(csv.DictReader((out / "study.csv").open()))
    force = runs.figures["probes"]["force"]
    if [r["converged"] for r in rows] != ["true"] * 3 or abs(float(rows[1]["force [N]"]) - force) > 1e-7 * abs(force):
        losses.append(f"an interrupted study: {rows}")
    return losses


def faults(runs):
    losses = of_a_run(runs, 1, signal.SIGINT) + of_a_run(runs, 2, signal.SIGTERM) + twice(runs) + of_a_study(runs)
    for ranks in (1, 2):
        losses += amid_a_long_solve(runs, ranks)
    return losses
