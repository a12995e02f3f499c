#!/usr/bin/env python3
"""What the program prints on a terminal, and what it does not print elsewhere: colour, the line of progress, the width of help; and what
goes to which stream.

    python3 tests/terminal.py build/bulbus
"""
import fcntl
import os
import pathlib
import pty
import struct
import subprocess
import sys
import tempfile
import termios

PROGRAM = sys.argv[1]
# It may not shrink to nothing: the run fails after some increments.
SCENE = """
mesh: {block: {upper: [2, 1, 1], nx: 2, ny: 2, nz: 2}}
regions: {block: {c10: 0.5}}
symmetry: [y, z]
fix: [{set: xmin, directions: [x]}]
steps:
  - {name: one, increments: 2, displace: [{set: xmax, x: 0.2}]}
probes: [{name: pull, kind: reaction, set: xmax, component: x}]
solver: {linear: {method: iterative}, stepping: {minimum: 0.2}}
output: {vtk: false}
"""
TOO_FAR = "steps.one.displace.xmax.x=-2.2"


def piped(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


def on_terminal(*arguments, width=100, **environment):
    """All that it prints on a terminal of that width, and its exit status."""
    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 40, width, 0, 0))
    variables = {k: v for k, v in os.environ.items() if k != "NO_COLOR"}
    process = subprocess.Popen([PROGRAM, *arguments], stdin=its, stdout=its, stderr=its, env={**variables, "TERM": "xterm", **environment})
    os.close(its)
    printed = b""
    try:
        while part := os.read(ours, 65536):
            printed += part
    except OSError:  # so it ends on Linux
        pass
    os.close(ours)
    return printed.decode(), process.wait()


def check_help():
    for width in (60, 90):
        for topic in (("scene",), ("log",), ("run",), ()):
            printed, status = on_terminal("help", *topic, width=width, NO_COLOR="1")
            longest = max(map(len, printed.replace("\r\n", "\n").split("\n")))
            assert status == 0 and width - 20 < longest <= width, (topic, width, longest)
            assert "\033" not in printed
    assert "\033[1m" in on_terminal("help", "steps")[0]
    assert "\033" not in piped("help", "steps").stdout
    listed = piped("help").stdout
    for word in ("scene", "study", "log", "run", "completion", "probes"):
        assert f"\n  {word} " in listed, word


def check_run(scene, out):
    log = lambda: (out / "run.log").read_text()
    printed, status = on_terminal("run", scene, "-o", str(out))
    assert status == 0 and "\rstep 1 of 1, 0 to 0.5: Newton iteration 0" in printed and "\033[K" in printed, printed
    assert "\r" not in log() and "\033" not in log()
    legend = log().index("Newton iteration")
    assert legend < log().index("step 1 of 1"), log()
    for arguments, environment in (((), {"width": 0}), (("--quiet",), {})):
        printed, status = on_terminal("run", scene, "-o", str(out), *arguments, **environment)
        assert status == 0 and "\033" not in printed, printed
    assert printed == "", printed
    assert "increment 2 converged" in log()
    plain, verbose = piped("run", scene, "-o", str(out)), piped("run", scene, "-o", str(out), "--verbose")
    assert "\033" not in plain.stdout and "residual" not in plain.stdout.split("step 1 of 1")[1]
    assert verbose.stdout.count("  Krylov ") > 5 and "  Krylov " in log(), verbose.stdout
    assert plain.stderr == verbose.stderr == ""
    assert piped("run", scene, "--quiet", "--verbose").returncode == 2


def check_failure(scene, out):
    plain = piped("run", scene, "-o", str(out), "--set", TOO_FAR)
    assert plain.returncode == 1 and "error: not converged: step 'one'" in plain.stderr and "diagnosis: " in plain.stderr, plain.stderr
    assert "error: " not in plain.stdout and "results in " in plain.stdout
    assert plain.stderr in (out / "run.log").read_text()
    quiet = piped("run", scene, "-o", str(out), "--quiet", "--set", TOO_FAR)
    assert quiet.returncode == 1 and quiet.stderr == plain.stderr
    assert all(line.startswith("warning: ") for line in quiet.stdout.splitlines()), quiet.stdout
    printed = on_terminal("run", scene, "-o", str(out), "--set", TOO_FAR)[0]
    assert "\033[31m\033[1merror: not converged" in printed, printed[-600:]
    printed = on_terminal("run", scene, "-o", str(out), "--set", TOO_FAR, NO_COLOR="1")[0]
    assert "error: not converged" in printed and "\033[31m" not in printed


def main():
    with tempfile.TemporaryDirectory() as name:
        scene, out = pathlib.Path(name) / "scene.yaml", pathlib.Path(name) / "out"
        scene.write_text(SCENE)
        check_help()
        check_run(str(scene), out)
        check_failure(str(scene), out)


main()
