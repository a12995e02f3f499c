"""Folders that cannot be written, or are in use: refused with status 2 before anything is touched."""
import os
import signal
import subprocess

from runs import PATIENCE, environment


def may_mount():
    return subprocess.run(["unshare", "-m", "true"], capture_output=True).returncode == 0


def state(folder):
    return {p.name: p.stat().st_mtime_ns for p in folder.iterdir()} if folder.exists() else {}


def refused(done, word):
    if done.returncode != 2 or word not in done.stderr:
        return [f"'{word}' was expected with status 2, not {done.returncode}: {done.stderr}"]
    return []


def in_use(runs):
    """The lock of a run that is at work, and that goes with it however it ends."""
    out = runs.fresh()
    process = runs.start(out)
    runs.wait_for(out / "run.log")
    os.kill(process.pid, signal.SIGSTOP)
    before = state(out)
    losses = []
    for ranks in (1, 2):
        losses += refused(runs.run(out, ranks), "another run is writing into this folder")
    if state(out) != before:
        losses.append("a refused run has changed the folder")
    process.kill()
    process.wait()
    fault = runs.finish(out)
    return losses + ([f"after a run that was killed: {fault}"] if fault else [])


def read_only(runs):
    if not may_mount():
        print("read-only folders: skipped, no private mounts allowed")
        return []
    out, losses = runs.fresh(), []
    out.mkdir()
    for where in (out, out / "new"):
        command = f"mount --bind {out} {out} && mount -o remount,bind,ro {out} && exec " + " ".join(runs.command(where))
        done = subprocess.run(["unshare", "-m", "sh", "-c", command], env=environment(), capture_output=True, text=True, timeout=PATIENCE)
        losses += refused(done, "cannot be made a folder of results")
    return losses


def faults(runs):
    file = runs.folder / "file"
    file.write_text("not a folder")
    losses = in_use(runs) + read_only(runs)
    for ranks in (1, 2):
        losses += refused(runs.run(file, ranks), "is a file")
        losses += refused(runs.run(file / "below", ranks), "is a file")
    return losses
