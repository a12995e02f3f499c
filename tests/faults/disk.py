"""Disks that become full, of one file (ulimit -f) and of all (a small tmpfs)."""
import shlex
import subprocess

from folders import may_mount
from runs import PATIENCE, environment


def faults_of(runs, out, done, where):
    if done.returncode == 0 and not runs.differences(out):
        return []  # it was large enough
    if done.returncode != 1:
        return [f"{where}: status {done.returncode}: {done.stderr}"]
    said = [line for line in done.stderr.splitlines() if "bulbus" in line]
    if len(said) != 1 or "cannot be written: no space left" not in said[0] or "the same command" not in said[0]:
        return [f"{where}: one line that says so was expected, not {done.stderr}"]
    fault = runs.unwhole(out) or runs.finish(out)
    return [f"{where}: {fault}"] if fault else []


def small_files(runs):
    losses = []
    largest = max(p.stat().st_size for p in runs.reference.iterdir())
    for ranks, sizes in ((1, (100, 3000, largest // 2)), (2, (100, largest - 1))):
        for size in sizes:
            out = runs.fresh()
            runs.prefix = ["prlimit", f"--fsize={size}"]  # of the ranks: mpirun itself writes files
            done = runs.run(out, ranks)
            runs.prefix = []
            losses += faults_of(runs, out, done, f"{ranks} ranks, files up to {size} bytes")
    return losses


def small_disks(runs):
    if not may_mount():
        print("full disks: skipped, no private mounts allowed")
        return []
    losses = []
    whole = sum(p.stat().st_size for p in runs.reference.iterdir())
    for ranks, parts in ((1, (.1, .6)), (2, (.3, .9))):
        for part in parts:
            out, disk = runs.fresh(), runs.fresh()
            disk.mkdir()
            command = shlex.join(runs.command(disk / "out", ranks))
            script = (f"mount -t tmpfs -o size={int(whole * part)} none {disk}; {command}; status=$?; "
                      f"cp -r {disk}/out {out} || mkdir {out}; exit $status")
            done = subprocess.run(["unshare", "-m", "sh", "-c", script], env=environment(), capture_output=True, text=True, timeout=PATIENCE)
            losses += faults_of(runs, out, done, f"{ranks} ranks, a disk of {part} of the room")
    return losses


def faults(runs):
    return small_files(runs) + small_disks(runs)
