#!/usr/bin/env python3
"""picture.py BULBUS: docs/picture.py draws panels of a run and a close-up, and refuses what has no room. Needs Chromium; skipped without."""
import pathlib
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))
from support import browser

SKIPPED = 77


def drawn(program, picture, folder, *more):
    command = [sys.executable, ROOT / "docs" / "picture.py", "--bulbus", program, picture, folder, "--colour", "mises", *more]
    return subprocess.run([str(c) for c in command], capture_output=True, text=True)


def size_of(picture):
    """Width and height of a PNG file."""
    data = picture.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:8]
    return struct.unpack(">II", data[16:24])


def main():
    if not browser.PROGRAM:
        print("Chromium is not installed: no picture was drawn")
        return SKIPPED
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        run, picture, none = folder / "run", folder / "picture.png", folder / "none.png"
        scene = ROOT / "data" / "scenes" / "suture.yaml"
        subprocess.run([program, "run", scene, "-o", run, "-q"], check=True)
        panels, close_up = ("0=at rest", "2=sewn"), ("--close-up", "0", "12", "16", "10")
        done = drawn(program, picture, run, *close_up, "--log", "--point", "cavity=0,9", *panels)
        assert done.returncode == 0, done.stdout + done.stderr
        width, height = size_of(picture)
        assert width > 2 * 2 * 292 and height > 2 * 292 * (1 + 10 / 16), (width, height)  # two panels, two rows, two pixels for each
        done = drawn(program, none, run, *close_up, "--point", "long word " * 12 + "=0,9", "2=sewn")
        assert done.returncode == 1 and "there is no room for the label" in done.stderr, done.stderr
        done = drawn(program, none, run, *close_up, "--view", "open", *panels)
        assert done.returncode == 2 and "--close-up is of the section" in done.stderr, done.stderr
        done = drawn(program, none, run, "3=later")
        assert done.returncode == 1 and "there is no state '3'. Name one from 0 to 2" in done.stderr, done.stderr
        done = drawn(program, none, run, "--colour", "mieses", "2=sewn")
        assert done.returncode == 1 and "there is no field 'mieses'. Name one of region, mises, displacement" in done.stderr, done.stderr
        assert not none.exists()
    print("pictures are drawn")
    return 0


if __name__ == "__main__":
    sys.exit(main())
