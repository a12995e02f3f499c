#!/usr/bin/env python3
"""Puts what the verification tests measured in their last run into docs/verification.md, between its two markers.

    ctest --test-dir build -R 'verify_|parallel_'; python3 docs/measured.py
"""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


def lines(log):
    test = None
    for line in log.splitlines():
        started = re.match(r'Command: .*?/((?:verify|parallel)_\w+)"', line)
        if line.startswith("Command:"):
            test = started.group(1) if started else None
        elif test and line.startswith("[ measured ] "):
            yield test, line.removeprefix("[ measured ] ")


def main():
    log = (ROOT / "build/Testing/Temporary/LastTest.log").read_text(errors="replace")
    by_test = {}
    for test, text in lines(log):
        by_test.setdefault(test, [])
        if text not in by_test[test]:
            by_test[test].append(text)
    body = "\n".join(f"### {test}\n\n" + "\n".join(f"- {t}" for t in texts) + "\n" for test, texts in sorted(by_test.items()))
    page = ROOT / "docs/verification.md"
    head, rest = page.read_text().split(BEGIN)
    page.write_text(head + BEGIN + "\n\n" + body + "\n" + END + rest.split(END)[1])


main()
