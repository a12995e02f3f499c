#!/usr/bin/env python3
"""Fails where a document names a file that does not exist, or a member of a class (`Class::member`) whose words no source has; a
name without an ending may be that of a header or a source."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOP = "app|benchmarks|cmake|contact|core|data|docs|examples|precond|tests"


def words():
    sources = (p for top in TOP.split("|") for ending in ("hpp", "cpp") for p in (ROOT / top).rglob(f"*.{ending}"))
    return {word for p in sources for word in re.findall(r"\w+", p.read_text())}


def missing(page, known):
    for number, line in enumerate(page.read_text().splitlines(), 1):
        for name in re.findall(rf"(?<![\w/.-])((?:{TOP})/[\w./-]*\w)(?![\w*{{])", line):
            found = any((ROOT / (name + ending)).exists() for ending in ("", ".hpp", ".cpp"))
            if not found and not re.search(r"[A-Z]{4,}", name):  # NAME stands for a name
                yield f"{page.relative_to(ROOT)}:{number}: {name}"
        for member in re.findall(r"`([A-Z]\w+::\w+)`", line):
            if not known.issuperset(member.split("::")):
                yield f"{page.relative_to(ROOT)}:{number}: {member}"


def main():
    pages = [p for p in ROOT.rglob("*.md") if not any(part.startswith(("build", "results")) for part in p.relative_to(ROOT).parts)]
    known = words()
    faults = [fault for page in pages for fault in missing(page, known)]
    print("\n".join(faults) or f"all files and members that {len(pages)} pages name exist")
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
