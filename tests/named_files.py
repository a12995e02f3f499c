#!/usr/bin/env python3
"""Fails where a document names a file that does not exist; a name without an ending may be that of a header or a source."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOP = "app|benchmarks|cmake|contact|core|data|docs|examples|precond|tests"


def missing(page):
    for number, line in enumerate(page.read_text().splitlines(), 1):
        for name in re.findall(rf"(?<![\w/.-])((?:{TOP})/[\w./-]*\w)(?![\w*{{])", line):
            found = any((ROOT / (name + ending)).exists() for ending in ("", ".hpp", ".cpp"))
            if not found and not re.search(r"[A-Z]{4,}", name):  # NAME stands for a name
                yield f"{page.relative_to(ROOT)}:{number}: {name}"


def main():
    pages = [p for p in ROOT.rglob("*.md") if not any(part.startswith(("build", "results")) for part in p.relative_to(ROOT).parts)]
    faults = [fault for page in pages for fault in missing(page)]
    print("\n".join(faults) or f"all files that {len(pages)} pages name exist")
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
