"""Kills at random times."""
import collections
import os
import pathlib
import signal
import subprocess
import time

from runs import PATIENCE

MODES = ["alone", "one rank of 2", "alone", "mpirun", "alone", "one rank of 3"]


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


def hit(runs, mode, out, random):
    """Starts the run, or goes on with it, and kills it: whether that was in time, the exit status (None: something went on), where."""
    ranks = 1 if mode == "alone" else 3 if mode.endswith("3") else 2
    fresh, delay = not out.exists(), random.uniform(0, 1.1) * runs.seconds[ranks]
    process = runs.start(out, ranks, *runs.restart(out))
    if fresh and random.random() < .9:
        runs.wait_for(out)  # the way there is long, and leaves nothing
    time.sleep(delay)
    workers = children_of(process.pid) if ranks > 1 else []
    victim = process.pid if mode in ("alone", "mpirun") else random.choice(workers) if workers else None
    in_time = victim is not None and process.poll() is None
    if in_time:
        kill(victim)
    return in_time, end_of(process, workers), f"{mode}, killed after {delay:.2f} s"


def finished(runs, out):
    return (out / "summary.json").exists() and runs.summary(out)["converged"]


def one_kill(runs, mode, random, ends):
    """A run that is killed, at times once more when it goes on, and then finished: what is lost, in words; empty if nothing."""
    out = runs.fresh()
    for _ in range(random.choice([1, 1, 2])):
        in_time, status, where = hit(runs, mode, out, random)
        if status is None:
            return where + ": some rank did not end"
        done = finished(runs, out)
        ends[mode, "not hit" if not in_time else "finished before" if done else "in the middle" if out.exists() else "at the start"] += 1
        if in_time and status == 0 and not done:
            return where + ": status 0"
        if fault := runs.unwhole(out):
            return f"{where}: {fault}"
        if done:
            return ""
    fault = runs.finish(out, random.choice([1, 1, 1, 2]))
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
