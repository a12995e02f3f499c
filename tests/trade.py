#!/usr/bin/env python3
"""`bulbus trade` of a scene of seconds: what it says follows from what its runs left behind.

    python3 tests/trade.py build/bulbus
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOISE = .05  # as the command has it


def trade(folder, *more):
    settings = ["solver.linear.method=iterative", "contacts.joint.tolerance=0", *more]
    command = [sys.argv[1], "trade", str(ROOT / "data/scenes/two_blocks.yaml"), "-o", str(folder), "--set", *settings]
    return subprocess.run(command, capture_output=True, text=True)


def rows_of(folder):
    with open(folder / "trade.csv") as file:
        return list(csv.DictReader(file))


def dominated(row, rows):
    return any(float(r["error"]) <= float(row["error"]) and float(r["seconds [s]"]) < (1 - NOISE) * float(row["seconds [s]"]) for r in rows)


def check(rows, folder):
    reference, scene = rows[0], rows[1]
    assert reference["parameter"] == "reference" and scene["parameter"] == "scene", rows[:2]
    assert reference["converged"] == scene["converged"] == "true"
    assert float(scene["error"]) < 1e-4, scene["error"]
    by = {(r["parameter"], r["value"]): r for r in rows}
    assert {"eta_max", "newton", "gamma", "reuse", "smoothing", "method", "operator", "iterations before the correction", "intermediate tolerance", "increments",
            "penalty", "augmentation"} <= {k for k, _ in by}
    assert float(by["newton", "1e-2"]["error"]) > float(by["newton", "1e-5"]["error"])
    assert int(by["newton", "1e-2"]["newton_iterations"]) < int(by["newton", "1e-5"]["newton_iterations"])
    assert float(by["penalty", "x 0.3"]["error"]) > 1e-4  # another penetration
    assert by["method", "direct"]["krylov_iterations"] == "0" and float(by["method", "direct"]["error"]) < 1e-4
    compared = [r for r in rows[1:] if r["error"]]
    for row in compared:
        assert row["front"] == ("dominated" if dominated(row, compared) else "front"), row
    probe = next(c for c in rows[0] if c.endswith(" error")).removesuffix(" error")
    column = next(c for c in rows[0] if c.split(" [")[0] == probe)
    right, got = float(reference[column]), float(scene[column])
    assert abs(abs(got - right) - float(scene[probe + " error"]) * abs(right)) <= 1e-9 * abs(right), "small figures are not expected here"
    for row in rows:
        summary = json.loads((folder / row["run"] / "summary.json").read_text())
        assert int(row["krylov_iterations"]) == summary["totals"]["krylov_iterations"]
    check_figure(compared, folder)


def check_figure(compared, folder):
    """On one mesh there is one panel: the front and four parameters at most are curves, and every run has its mark."""
    figure, again = folder / "trade.svg", folder.parent / "again.svg"
    svg = figure.read_text()
    assert 2 <= svg.count("<polyline") <= 5 and ">Pareto front<" in svg and ">other settings<" in svg, svg
    front = sum(row["front"] == "front" for row in compared)
    assert svg.count("<circle") >= len(compared) + front, (svg.count("<circle"), len(compared), front)
    subprocess.run([sys.argv[1], "plot", str(folder), "-o", str(again)], check=True, capture_output=True)
    assert again.read_text() == svg


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "out"
        first = trade(folder)
        assert first.returncode == 0, first.stdout + first.stderr
        rows = rows_of(folder)
        check(rows, folder)
        again = trade(folder)
        assert again.returncode == 0 and again.stdout.count("(there already)") == len(rows), again.stdout
        assert rows_of(folder) == rows
        wrong = trade(pathlib.Path(name) / "no", "probes=[]")
        assert wrong.returncode == 2 and "has no probes" in wrong.stderr, wrong.stderr
        assert not (pathlib.Path(name) / "no").exists()


main()
