#!/usr/bin/env python3
"""`bulbus man`: groff formats it without a warning, and it has every command, option and key. Exit status 77, skipped, without groff.

    python3 tests/man_page.py build/bulbus
"""
import re
import shutil
import subprocess
import sys


def said(*command, text=None):
    done = subprocess.run(command, capture_output=True, text=True, input=text)
    assert done.returncode == 0 and not done.stderr.strip(), (command, done.stderr)
    return done.stdout


def main():
    if not shutil.which("groff"):
        return 77
    program = sys.argv[1]
    page = said(program, "man")
    shown = said("groff", "-man", "-ww", "-Kutf8", "-Tutf8", "-P-cbou", text=page)
    for heading in ("NAME", "SYNOPSIS", "COMMANDS", "SCENE", "STUDY", "EXIT STATUS"):
        assert re.search(rf"^{heading}$", shown, re.M), heading
    commands = re.findall(r"^  (\S+) ", said(program, "--help").split("Subcommands:")[1], re.M)
    assert "run" in commands and "completion" in commands, commands
    for command in commands:
        assert re.search(rf"^   {command}$", shown, re.M), command
        for option in re.findall(r"--\w+", said(program, command, "--help")):
            assert option == "--help" or option in shown, (command, option)
    for key in ("mesh.shell.inner", "steps.increments", "probes.kind", "vary.values"):
        assert re.search(rf"^ +{re.escape(key)}$", shown, re.M), key
    assert "smoothing_range" not in shown  # for experts
    return 0


sys.exit(main())
