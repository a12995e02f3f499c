#!/usr/bin/env python3
"""Pictures of a run, side by side from the same camera, as its report draws them.

    docs/picture.py docs/encircling.png results/encircling --view section --colour mises '0=before' '1=15 mmHg' '9=sewn'

Saved states are named as number=title (none: the last). Needs Debian's chromium, and the program in build/.
"""
import argparse
import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))
from support import browser

# Replaces the page by its panels and the bar of the field; its size in pixels.
COMPOSE = """(panels => {
  const {viewers: [viewer], controls} = window.report, {frames} = controls.models[0];
  viewer.element.style.cssText = `width: ${%(width)d}px; height: ${%(height)d}px; max-height: none`;
  viewer.resize(4);  // finer than the picture: edges come out smooth
  controls.view('%(view)s');
  controls.colour.value = '%(colour)s';
  controls.colour.onchange();
  const figures = panels.map(([number, title]) => {
    controls.slider.value = number < 0 ? frames.length - 1 : number;
    controls.slider.oninput();
    viewer.drawNow();
    const image = elementOf('img', {src: viewer.renderer.domElement.toDataURL()});
    return elementOf('figure', {}, elementOf('figcaption', {textContent: title}), image);
  });
  const row = elementOf('div', {className: 'panels'}, ...figures), legend = document.getElementById('legend');
  const page = elementOf('div', {id: 'picture'}, row, legend);
  const style = 'body { margin: 0 } #picture { display: inline-block; padding: 8px; background: #fbfbf9 } .panels { display: flex }' +
      'figure { margin: 0 } figcaption { text-align: center; font-weight: bold } img { display: block; width: %(width)dpx }' +
      '#legend { margin: 8px auto; padding-bottom: 12px } #legend .note { display: none }';
  document.body.replaceChildren(elementOf('style', {textContent: style}), page);
  return Promise.all([...page.querySelectorAll('img')].map(image => image.decode())).then(() => {
    const {width, height} = page.getBoundingClientRect();
    return [width, height];
  });
})(%(panels)s)"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture")
    parser.add_argument("folder")
    parser.add_argument("panels", nargs="*", metavar="NUMBER=TITLE")
    parser.add_argument("--view", default="section", choices=["open", "section", "detail", "whole", "inside"])
    parser.add_argument("--colour", default="region", help="region, displacement or a field of the report")
    parser.add_argument("--width", type=int, default=480, help="of a panel, pixels")
    parser.add_argument("--height", type=int, default=400)
    return parser.parse_intermixed_args()


def main():
    given = arguments()
    panels = [[int(number), title] for number, _, title in (p.partition("=") for p in given.panels)] or [[-1, ""]]
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "report.html")
        subprocess.run([ROOT / "build" / "bulbus", "report", given.folder, "-o", page], check=True, stdout=subprocess.DEVNULL)
        with browser.Browser(page, len(panels) * given.width + 100, given.height + 600, fineness=2) as shown:
            shown.wait_for("window.report && window.report.ready")
            compose = COMPOSE % {**vars(given), "panels": json.dumps(panels)}
            width, height = shown.value(compose)
            shown.picture(given.picture, clip=(width, height))
            if shown.faults:
                sys.exit("\n".join(shown.faults))


if __name__ == "__main__":
    main()
