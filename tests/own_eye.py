#!/usr/bin/env python3
"""Does what docs/own_eye.md says: its commands, on its scene, print what the page shows.

    python3 tests/own_eye.py build/bulbus
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def blocks(page, language):
    return re.findall(r"^```%s\n(.*?)^```$" % language, page, re.M | re.S)


def main():
    page = (ROOT / "docs/own_eye.md").read_text()
    with tempfile.TemporaryDirectory() as folder:
        here = pathlib.Path(folder)
        (here / "build").mkdir()
        (here / "build/bulbus").symlink_to(pathlib.Path(sys.argv[1]).resolve())
        (here / "data").symlink_to(ROOT / "data")
        (here / "own_eye.yaml").write_text(blocks(page, "yaml")[0])
        said = ""
        for command in "".join(blocks(page, "sh")).splitlines():
            run = subprocess.run(command, shell=True, cwd=here, text=True, capture_output=True)
            said += run.stdout
            if run.returncode:
                print(command, run.stdout[-3000:], run.stderr, sep="\n")
                return 1
    said = {" ".join(line.split()) for line in said.splitlines()}
    lost = [line for text in blocks(page, "text") for line in text.splitlines() if " ".join(line.split()) not in said]
    print("\n".join(["not printed:"] + lost if lost else ["docs/own_eye.md is true"]))
    return 1 if lost else 0


sys.exit(main())
