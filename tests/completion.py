#!/usr/bin/env python3
"""What a shell offers after a part of a command line: `bulbus completion bash`, and in zsh where that is installed.

    python3 tests/completion.py build/bulbus
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
DRIVER = r"""
source "$1"
COMP_LINE=$2 COMP_POINT=${#2} COMPREPLY=()
_bulbus
printf '%s\n' "${COMPREPLY[@]}"
"""


def said(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


def offers_of_bash(script, folder):
    def offers(line):
        done = subprocess.run(["bash", "-c", DRIVER, "bash", script, line], capture_output=True, text=True, cwd=folder)
        assert done.returncode == 0 and not done.stderr, (line, done.stderr)
        return done.stdout.split()
    return offers


def check_commands(offers):
    assert offers("bulbus ru") == ["run"]
    assert {"run", "study", "plot", "new", "man", "--version"} <= set(offers("bulbus "))
    assert offers("bulbus run --qu") == ["--quiet"]
    assert offers("bulbus export a.yaml --element C3D8H") == ["C3D8H"]
    assert offers("bulbus new a --kind ") == ["eye", "sphere", "mesh"]
    assert offers("bulbus completion z") == ["zsh"]


def check_keys(offers):
    assert offers("bulbus run a.yaml --set sol") == ["solver."]
    assert "solver.linear." in offers("bulbus run --set solver.")
    assert offers("bulbus run --set solver.linear.meth") == ["solver.linear.method="]
    assert offers("bulbus run --set solver.linear.method=d") == ["direct"]
    assert offers("bulbus run --set output.vtk=") == ["true", "false"]
    assert offers("bulbus run --set output.vtk=true solver.linear.meth") == ["solver.linear.method="]
    assert offers("bulbus run --set steps.3.incr") == ["steps.3.increments="]
    assert offers("bulbus run --set regions.sclera.c10") == ["regions.sclera.c10="]
    assert offers("bulbus run --set regions.sclera.nothing") == []


def check_every_key(offers):
    """Every value that the schema knows at the end of a path of groups can be reached part by part."""
    def walk(node, path):
        for key, below in node.get("properties", {}).items():
            here = path + [key]
            if "properties" in below:
                yield from walk(below, here)
            elif below.get("type") not in ("object", "array"):
                yield ".".join(here)
    keys = list(walk(json.loads(said("schema"))["properties"]["solver"], ["solver"]))
    assert len(keys) > 30, keys
    for key in keys[::5]:
        assert key + "=" in offers("bulbus run --set " + key), key


def check_files(offers, folder):
    (folder / "scenes").mkdir()
    (folder / "one.yaml").touch()
    (folder / "one.txt").touch()
    assert offers("bulbus run o") == ["one.yaml"]
    assert offers("bulbus run --set output.vtk=true o") == ["output.", "one.yaml"]
    assert offers("bulbus run ") == ["one.yaml", "scenes"] or offers("bulbus run ") == ["scenes", "one.yaml"]
    assert offers("bulbus report s") == ["scenes"]


def check_topics(offers):
    assert offers("bulbus help pro") == ["probes"]
    assert "steps.increments" in offers("bulbus help steps.i")
    assert "log" in offers("bulbus help l")


def check_zsh(script):
    """The functions that both shells share, and the syntax of the rest."""
    assert subprocess.run(["zsh", "-n", script], capture_output=True).returncode == 0
    functions = pathlib.Path(script).read_text().split("\n_bulbus_setting()")[0]
    for call, wanted in (("_bulbus_keys steps.3.incr", "steps.3.increments="), ("_bulbus_words solver.linear.method", "iterative direct")):
        done = subprocess.run(["zsh", "-fc", functions + "\n" + call], capture_output=True, text=True)
        assert wanted in done.stdout.splitlines(), (call, done.stdout, done.stderr)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for shell in ("bash", "zsh"):
            (folder / shell).write_text(said("completion", shell))
        inside = folder / "inside"
        inside.mkdir()
        offers = offers_of_bash(folder / "bash", inside)
        for check in (check_commands, check_keys, check_every_key, check_topics):
            check(offers)
        check_files(offers, inside)
        assert (folder / "zsh").read_text().startswith("#compdef bulbus\n")
        if shutil.which("zsh"):
            check_zsh(folder / "zsh")


main()
