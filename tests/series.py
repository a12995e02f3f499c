#!/usr/bin/env python3
"""benchmarks/series.py refuses records of different commits; benchmarks/all names every record of benchmarks/results."""
import json
import pathlib
import subprocess
import sys
import tempfile

BENCHMARKS = pathlib.Path(__file__).resolve().parent.parent / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))
import series  # noqa: E402


def put(folder, **commits):
    for name, commit in commits.items():
        (folder / f"{name}.json").write_text(json.dumps({"commit": commit}))


def check(folder):
    put(folder, one="aaa", two="bbb-dirty")
    assert series.faults(folder) == [], "records that do not claim to be one series"
    put(folder, two="aaa")
    series.write(folder, "aaa")
    assert series.faults(folder) == []
    for commit, word in (("bbb", "of commit bbb"), ("aaa-dirty", "not committed")):
        put(folder, two=commit)
        found = series.faults(folder)
        assert len(found) == 1 and found[0].startswith("two: ") and word in found[0], found
    put(folder, two="aaa", three="aaa")
    assert series.faults(folder) == ["three: not named in series.json"], series.faults(folder)
    for name in ("two", "three"):
        (folder / f"{name}.json").unlink()
    assert series.faults(folder)[0].startswith("two: named"), series.faults(folder)


def check_plan():
    said = subprocess.run([sys.executable, BENCHMARKS / "all", "--list"], capture_output=True, text=True)
    assert said.returncode == 0, said.stderr
    planned = {pathlib.Path(line.split()[-1]).stem for line in said.stdout.splitlines()}
    missing = set(series.records(BENCHMARKS / "results")) - planned
    assert planned and not missing, f"benchmarks/all does not make {missing}"


with tempfile.TemporaryDirectory() as temporary:
    check(pathlib.Path(temporary))
check_plan()
print("series are of one commit")
