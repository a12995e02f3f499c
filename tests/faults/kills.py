"""Kills at random times."""
import collections
import os
import pathlib
import signal
import subprocess
import time

from runs import PATIENCE

MODES = ["alone", "one rank of 2", "mpirun", "one rank of 3"]


def children_of(parent):
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == parent and fields[0] != "Z":
            found.append(int(stat.parent.name))
    return found


def alive(pids):
    return [p for p in pids if pathlib.Path(f"/proc/{p}").exists()]


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def end_of(process, ranks):
    """Exit status once nothing of the run is left; None if something goes on and on."""
    try:
        status = process.wait(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        status = None
    end = time.monotonic() + PATIENCE
    while alive(ranks) and time.monotonic() < end:
        time.sleep(.02)
    left = alive(ranks)
    for pid in [*left, process.pid] if left or status is None else []:
        kill(pid)
    return None if left else status


def one_kill(runs, mode, random, ends):
    """What is lost, in words; empty if nothing."""
    ranks = 1 if mode == "alone" else 3 if mode.endswith("3") else 2
    out = runs.fresh()
    delay = random.uniform(0, 1.1) * runs.seconds[ranks]
    process = runs.start(out, ranks)
    if random.random() < .9:
        runs.wait_for(out)  # the way there is long, and leaves nothing
    time.sleep(delay)
    workers = children_of(process.pid) if ranks > 1 else []
    victim = process.pid if mode in ("alone", "mpirun") else random.choice(workers) if workers else None
    if victim and process.poll() is None:
        kill(victim)
    else:
        victim = None
    status = end_of(process, workers)
    where = f"{mode}, killed after {delay:.2f} s"
    if status is None:
        return where + ": some rank did not end"
    summary = out / "summary.json"
    finished = summary.exists() and runs.summary(out)["converged"]
    ends[mode, "not hit" if victim is None else "finished before" if finished else "in the middle" if out.exists() else "at the start"] += 1
    if victim and status == 0 and not finished:
        return where + ": status 0"
    if fault := runs.unwhole(out):
        return f"{where}: {fault}"
    if finished:
        return ""
    fault = runs.finish(out, random.choice([1, 1, 2]))
    return f"{where}, restart: {fault}" if fault else ""


def campaign(runs, count, random):
    ends, losses = collections.Counter(), []
    for i in range(count):
        fault = one_kill(runs, MODES[i % len(MODES)], random, ends)
        if fault:
            losses.append(f"kill {i}: {fault}")
            print(losses[-1], flush=True)
    print(f"{count} kills:", ", ".join(f"{mode} {how}: {n}" for (mode, how), n in sorted(ends.items())), flush=True)
    return losses
