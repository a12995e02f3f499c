"""Runs of the scene of this folder, and what has to hold of what they leave."""
import csv
import json
import os
import pathlib
import subprocess
import time
import xml.etree.ElementTree as xml

HERE = pathlib.Path(__file__).resolve().parent
PATIENCE = 300  # s: nothing here takes so long but a deadlock
TOLERANCE = 1e-7  # of figures: other ranks add up in another order


def environment():
    more = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
            "OPENBLAS_NUM_THREADS": "1"}
    return {**os.environ, **more}


def near(a, b):
    return abs(a - b) <= TOLERANCE * max(abs(a), abs(b), 1e-3)


class Runs:
    def __init__(self, program, whole, folder):
        self.program, self.whole = (str(pathlib.Path(p).resolve()) for p in (program, whole))
        self.folder, self.number = folder, 0
        self.seconds = {}  # from the making of the folder to the end, on so many ranks
        self.prefix = []
        for ranks in (1, 2, 3):
            out = self.fresh()
            process = self.start(out, ranks)
            self.wait_for(out)
            start = time.monotonic()
            assert process.wait(timeout=PATIENCE) == 0
            self.seconds[ranks] = time.monotonic() - start
            if ranks == 1:
                self.reference = out
                self.figures = self.summary(out)
        assert not self.unwhole(self.reference) and not self.differences(self.reference)

    def fresh(self):
        self.number += 1
        return self.folder / f"out_{self.number}"

    def command(self, out, ranks=1, *more):
        mpi = [] if ranks == 1 else ["mpirun", "--oversubscribe", "-n", str(ranks)]
        if mpi and self.prefix:
            mpi += ["--mca", "btl", "self,tcp"]  # shared memory needs files larger than the prefix may allow
        return [*mpi, *self.prefix, self.program, "run", str(HERE / "scene.yaml"), "-o", str(out), *more]

    def run(self, out, ranks=1, *more):
        command = self.command(out, ranks, *more)
        try:
            return subprocess.run(command, env=environment(), capture_output=True, text=True, errors="replace", timeout=PATIENCE)
        except subprocess.TimeoutExpired as fault:
            return subprocess.CompletedProcess(command, -1, "", f"no end after {PATIENCE} s: {fault.stdout}")

    def start(self, out, ranks=1, *more):
        return subprocess.Popen(self.command(out, ranks, *more), env=environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    @staticmethod
    def wait_for(path):
        end = time.monotonic() + PATIENCE
        while not path.exists() and time.monotonic() < end:
            time.sleep(.002)

    def go_on(self, out, ranks=1):
        """Finishes what was left: from the checkpoint, if there is one."""
        return self.run(out, ranks, *self.restart(out))

    @staticmethod
    def restart(out):
        return ["--restart"] if (out / "checkpoint.h5").exists() else []

    @staticmethod
    def summary(out):
        return json.loads((out / "summary.json").read_text())

    def unwhole(self, out):
        """What is wrong with files under their final names, in words; empty if all are whole."""
        if not out.exists():
            return ""
        results = [str(p) for p in sorted(out.glob("result_*.hdf"))]
        proof = subprocess.run([self.whole, *results], capture_output=True, text=True, env=environment(), timeout=PATIENCE)
        if proof.returncode != 0:
            return "unreadable: " + proof.stderr
        try:
            for p in [*out.glob("*.json"), *out.glob("*.series")]:
                json.loads(p.read_text())
            for p in [*out.glob("*.vtp"), *out.glob("*.pvd")]:
                xml.parse(p)
            series = out / "result.hdf.series"
            for file in json.loads(series.read_text())["files"] if series.exists() else []:
                assert (out / file["name"]).exists(), "listed and not there: " + file["name"]
            listed = (out / "manifest.txt").read_text().splitlines() if (out / "manifest.txt").exists() else []
            for p in out.iterdir():
                if ".tmp-" in p.name and p.name.endswith(".lock"):
                    continue  # MPI's own, beside a temporary file that a killed process was writing
                name = p.name.removesuffix(".tmp")
                assert name in listed or name == "manifest.txt", "not in the manifest: " + name
        except (ValueError, AssertionError, xml.ParseError) as fault:
            return f"{p.name if 'p' in locals() else out}: {fault}"
        return ""

    def differences(self, out):
        """In what a finished run differs from the one that nothing disturbed; empty if in nothing."""
        summary = self.summary(out)
        if not summary["converged"] or summary["totals"]["increments"] != self.figures["totals"]["increments"]:
            return "another end: " + summary["reason"]
        for name, value in self.figures["probes"].items():
            if not near(summary["probes"][name], value):
                return f"{name}: {summary['probes'][name]} for {value}"
        here, there = ([row[:6] for row in csv.reader((folder / "history.csv").open())] for folder in (out, self.reference))
        for a, b in zip(here, there):
            if a[:2] != b[:2] or (a != b and not all(near(float(x), float(y)) for x, y in zip(a[2:], b[2:]))):
                return f"history.csv: {a} for {b}"
        files = [sorted(p.name for p in folder.iterdir()) for folder in (out, self.reference)]
        if len(here) != len(there) or files[0] != files[1]:
            return f"{len(here)} rows for {len(there)}; files {set(files[0]) ^ set(files[1])}"
        return self.unwhole(out)

    def finish(self, out, ranks=1):
        """Goes on to the end; in words what is wrong there, empty if nothing."""
        done = self.go_on(out, ranks)
        if done.returncode != 0:
            return f"status {done.returncode} of the restart: {done.stderr}"
        return self.differences(out)
