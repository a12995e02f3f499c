#!/usr/bin/env python3
"""benchmarks/compare: matches rows, divides figures, and refuses what cannot be compared."""
import json
import pathlib
import subprocess
import sys
import tempfile

COMPARE = pathlib.Path(__file__).resolve().parent.parent / "benchmarks" / "compare"
BEFORE = {"program": "one", "commit": "aaa", "ranks": 1, "rows": [{"n": 8, "method": "slow", "s": 2.0, "mb": {"factor": 10}},
                                                                 {"n": 8, "method": "fast", "s": 0.5, "mb": {"factor": 4}}]}
AFTER = {"program": "one", "commit": "bbb", "ranks": 1, "rows": [{"n": 8, "method": "fast", "s": 0.25, "mb": {"factor": 4}},
                                                                {"n": 8, "method": "slow", "s": 3.0, "mb": {"factor": 10}},
                                                                {"n": 9, "method": "new", "s": 1.0}]}


def compared(folder, a, b, *keys):
    paths = []
    for name, record in (("before.json", a), ("after.json", b)):
        paths.append(folder / name)
        paths[-1].write_text(record if isinstance(record, str) else json.dumps(record))
    return subprocess.run([sys.executable, COMPARE, *paths, *keys], capture_output=True, text=True)


def check(folder):
    said = compared(folder, BEFORE, AFTER)
    assert said.returncode == 0, said.stderr
    lines = [line.split() for line in said.stdout.splitlines()]
    assert ["commit:", '"aaa"', "|", '"bbb"'] in lines, said.stdout
    assert not any(line[0] == "ranks:" for line in lines), "what is alike is not said"
    assert ["rows:", "slow", "n=8", "s", "2", "3", "1.5"] in lines, said.stdout
    assert ["rows:", "fast", "n=8", "s", "0.5", "0.25", "0.5"] in lines, said.stdout
    assert ["mb.factor", "4", "4", "1"] in lines, said.stdout
    assert any("new" in line and "only" in line for line in lines), said.stdout
    assert "mb.factor" not in compared(folder, BEFORE, AFTER, "s").stdout
    for other, word in (({**AFTER, "program": "two"}, "cannot be compared"), ("", "after.json"), ("{}", "program")):
        refused = compared(folder, BEFORE, other)
        assert refused.returncode == 2 and word in refused.stderr, (refused.returncode, refused.stderr)


with tempfile.TemporaryDirectory() as folder:
    check(pathlib.Path(folder))
