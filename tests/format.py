#!/usr/bin/env python3
"""Fails where clang-format would change a source. `tests/format.py --fix` lets it."""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["app", "benchmarks", "contact", "core", "docs", "examples", "precond", "tests"]


def main():
    sources = sorted(p for folder in FOLDERS for end in ("[ch]pp", "js") for p in (ROOT / folder).rglob("*." + end))
    how = ["-i"] if "--fix" in sys.argv[1:] else ["--dry-run", "-Werror", "--ferror-limit=1"]
    done = subprocess.run(["clang-format", *how, *sources], capture_output=True, text=True)
    print(done.stderr[-3000:] or f"{len(sources)} files are formatted")
    return done.returncode if sources else 1


if __name__ == "__main__":
    sys.exit(main())
