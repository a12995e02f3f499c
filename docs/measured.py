#!/usr/bin/env python3
"""Puts what the tests measured in their last run into the documentation, between the markers there: lines of tests/verify and
tests/parallel into docs/verification.md, rows of tests/extremes into docs/extremes.md, each under its extreme.

    ctest --test-dir build -R 'verify_|parallel_'; python3 docs/measured.py
    ctest --test-dir build -R 'extremes_'; python3 docs/measured.py
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEAD = "| | what came out | Newton | Krylov | most in one solve | cuts |\n| --- | --- | ---: | ---: | ---: | ---: |\n"


def lines(log, kinds):
    test = None
    for line in log.splitlines():
        started = re.match(rf'Command: .*?/((?:{kinds})_\w+)"', line)
        if line.startswith("Command:"):
            test = started.group(1) if started else None
        elif test and line.startswith("[ measured ] "):
            yield test, line.removeprefix("[ measured ] ")


def grouped(pairs):
    groups = {}
    for key, text in pairs:
        groups.setdefault(key, [])
        if text not in groups[key]:
            groups[key].append(text)
    return groups


def fill(page, name, body):
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    text = page.read_text()
    if begin not in text:
        sys.exit(f"{page.name} does not explain '{name}': it has no marker {begin}")
    head, rest = text.split(begin)
    page.write_text(head + begin + "\n\n" + body + "\n" + end + rest.split(end)[1])


def main():
    log = (ROOT / "build/Testing/Temporary/LastTest.log").read_text(errors="replace")
    if tests := grouped(lines(log, "verify|parallel")):
        body = "\n".join(f"### {test}\n\n" + "\n".join(f"- {t}" for t in texts) + "\n" for test, texts in sorted(tests.items()))
        fill(ROOT / "docs/verification.md", "measured", body)
    rows = grouped(text.split(" | ", 1) for _, text in lines(log, "extremes"))
    for extreme, values in rows.items():
        fill(ROOT / "docs/extremes.md", extreme, HEAD + "".join(f"| {v} |\n" for v in values))


main()
