#!/usr/bin/env python3
"""Runs that are killed, interrupted, fill the disk, or may not write: what stands under its final name is whole, and a restart ends as if nothing had been.

    python3 tests/faults/faults.py build/bulbus build/tests/faults_whole [--kills 200] [--seed 1]
"""
import argparse
import pathlib
import random
import tempfile

import disk
import folders
import interrupts
import kills
from runs import Runs


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("whole")
    parser.add_argument("--kills", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="bulbus_faults_") as name:
        runs = Runs(given.program, given.whole, pathlib.Path(name))
        losses = kills.campaign(runs, given.kills, random.Random(given.seed))
        losses += interrupts.faults(runs)
        losses += folders.faults(runs)
        losses += disk.faults(runs)
    for loss in losses:
        print("LOSS:", loss)
    print(f"{len(losses)} losses")
    return 1 if losses else 0


if __name__ == "__main__":
    raise SystemExit(main())
