#!/usr/bin/env python3
"""Pictures of a run, side by side from the same camera, as its report draws them, with labels, scale bar and colour bar.

    docs/picture.py docs/encircling.png results/encircling --colour mises --log --close-up .3 10.9 12 6.6 \\
        --point tear=1.75,10.8 '1=15 mmHg' '5=band and tire pressed in' '9=sewn'

Saved states are named as number=title (none: the last). Places are in mm to the right and upwards of the model's origin as the
picture shows it. Needs Debian's chromium, and the program in build/.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

DOCS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(DOCS.parent / "tests"))
from support import browser


def point(text):
    name, _, place = text.partition("=")
    right, up = map(float, place.split(","))
    return [name, [right, up]]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture")
    parser.add_argument("folder")
    parser.add_argument("panels", nargs="*", metavar="NUMBER=TITLE")
    parser.add_argument("--view", default="section", choices=["open", "section", "detail", "whole", "inside"])
    parser.add_argument("--colour", default="region", help="region, displacement or a field of the report")
    parser.add_argument("--log", action="store_true", help="a logarithmic scale of the field")
    parser.add_argument("--close-up", nargs=4, type=float, metavar=("RIGHT", "UP", "WIDTH", "HEIGHT"),
                        help="a second row: the regions of the section, centre and size in mm")
    parser.add_argument("--point", type=point, action="append", default=[], metavar="NAME=RIGHT,UP",
                        help="a place to label in the last row's first panel, mm")
    parser.add_argument("--width", type=int, default=292, help="of a panel, pixels; three are as wide as a page")
    parser.add_argument("--height", type=int, help="of a panel, pixels; of a section as it needs")
    parser.add_argument("--bulbus", default=DOCS.parent / "build" / "bulbus", help="the program")
    given = parser.parse_intermixed_args()
    if given.close_up and given.view != "section":
        parser.error("--close-up is of the section: --view section")
    if not browser.PROGRAM:
        sys.exit("Chromium is not installed: apt-get install chromium")
    return given


def panels_of(given):
    """Time and title of each saved state that is asked for."""
    series = pathlib.Path(given.folder) / "result.hdf.series"
    if not series.exists():
        sys.exit(f"{series}: cannot be read. Name the folder of the results of a run with output.vtk.")
    times = [file["time"] for file in json.loads(series.read_text())["files"]]
    wanted = [p.partition("=") for p in given.panels or [f"{len(times) - 1}="]]
    for number, _, _ in wanted:
        if not number.isdigit() or int(number) >= len(times):
            sys.exit(f"{series}: there is no state '{number}'. Name one from 0 to {len(times) - 1}, and a title: '0=before'.")
    return [[times[int(number)], title] for number, _, title in wanted]


def main():
    given = arguments()
    panels = panels_of(given)
    wanted = {"panels": panels, "view": given.view, "colour": given.colour, "log": given.log, "closeUp": given.close_up,
              "points": given.point, "width": given.width, "height": given.height}
    script = "".join((DOCS / name).read_text() for name in ("picture_labels.js", "picture.js"))
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "report.html")
        subprocess.run([given.bulbus, "report", given.folder, "-o", page], check=True, stdout=subprocess.DEVNULL)
        with browser.Browser(page, len(panels) * (given.width + 6) + 100, 1600, fineness=2) as shown:
            shown.wait_for("window.report && window.report.ready")
            shown.value(script + ";0")
            size = shown.value(f"compose({json.dumps(wanted)}).catch(fault => fault.message)")
            if isinstance(size, str):
                sys.exit(f"{given.picture}: {size}")
            shown.picture(given.picture, clip=size)
            if shown.faults:
                sys.exit("\n".join(shown.faults))


if __name__ == "__main__":
    main()
