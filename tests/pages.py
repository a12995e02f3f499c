#!/usr/bin/env python3
"""Does what pages say: their commands, on their files, print what they show.

    python3 tests/pages.py build/bulbus docs/own_eye.md docs/tutorials/*.md

A block of a page that begins with ```LANGUAGE NAME is the file NAME, one with ```sh commands from the folder of the repository, and one
with ```text lines that the commands print; numbers may differ in their last digit. Exit status 77, skipped, where a page has Python in it
and numpy, h5py or scipy is missing.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
NUMBER = r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?"


def blocks(page, language):
    return re.findall(r"^```%s\n(.*?)^```$" % language, page, re.M | re.S)


def lacks_packages(page):
    probe = [sys.executable, "-c", "import numpy, h5py, scipy"]
    return "```python" in page and subprocess.run(probe, capture_output=True).returncode != 0


def last_digit(number):
    """Unit in the last place of a number as it is printed."""
    mantissa, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def alike(shown, said):
    """The same words, and numbers that differ by no more than a unit in the last place of the page's."""
    if re.sub(NUMBER, "#", shown) != re.sub(NUMBER, "#", said):
        return False
    pairs = zip(re.findall(NUMBER, shown), re.findall(NUMBER, said))
    return all(abs(float(a) - float(b)) <= 1.01 * last_digit(a) for a, b in pairs)


def prepare(here, page, program):
    """A folder that looks like the repository's to the page's commands."""
    (here / "build").mkdir()
    (here / "build/bulbus").symlink_to(program)
    for folder in ("data", "docs", "examples", "python"):
        (here / folder).symlink_to(ROOT / folder)
    for name, text in re.findall(r"^```\w+ (\S+)\n(.*?)^```$", page, re.M | re.S):
        (here / name).write_text(text)


def commands(here, page):
    """What the page's commands print; ends the test where one fails."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "python"), "BULBUS": str(here / "build/bulbus")}
    said = ""
    for command in "".join(blocks(page, "sh")).splitlines():
        command = re.sub(r"(^| )python3 ", rf"\1{sys.executable} ", command)
        run = subprocess.run(command, shell=True, cwd=here, text=True, capture_output=True, env=environment)
        said += run.stdout
        if run.returncode:
            sys.exit(f"{command}\n{run.stdout[-3000:]}\n{run.stderr}")
    return said


def lost(path, program):
    """Lines that the page shows and its commands do not print; None if packages are missing."""
    page = path.read_text()
    if lacks_packages(page):
        return None
    with tempfile.TemporaryDirectory() as folder:
        prepare(pathlib.Path(folder), page, program)
        said = [" ".join(line.split()) for line in commands(pathlib.Path(folder), page).splitlines()]
    shown = [" ".join(line.split()) for text in blocks(page, "text") for line in text.splitlines()]
    return [line for line in shown if not any(alike(line, other) for other in said)]


def main():
    program, status = pathlib.Path(sys.argv[1]).resolve(), 0
    for name in sys.argv[2:]:
        missing = lost(pathlib.Path(name), program)
        print(f"{name}: skipped, numpy, h5py or scipy is missing" if missing is None else
              "\n".join([f"{name}: not printed:"] + missing) if missing else f"{name} is true")
        status = 1 if missing else 77 if missing is None and status == 0 else status
    return status


sys.exit(main())
