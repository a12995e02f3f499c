#!/usr/bin/env python3
"""report.py BULBUS: pages of runs need nothing else, are small, and say what the records say; in Chromium, where that is
installed, the model is drawn, the slider moves it, and the console stays empty.

    tests/report.py build/bulbus [--keep FOLDER]     the pictures that were looked at stay in the folder
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from support import browser

SCENES = pathlib.Path(__file__).resolve().parent.parent / "data" / "scenes"
MOST_BYTES = 15e6
# Draws the view NUMBER: the part of its pixels that is not nearly white, and a sum that tells pictures apart.
INK = """(() => {
  const view = window.report.viewers[NUMBER], gl = view.renderer.getContext();
  view.drawNow();
  const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight, pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let ink = 0, sum = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i] + pixels[i + 1] + pixels[i + 2] < 700) ++ink;
    sum += (i % 977) * pixels[i];
  }
  return [ink / (width * height), sum];
})()"""


def bulbus(program, *arguments, status=0):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == status, f"{arguments}: exit status {done.returncode}\n{done.stdout[-1000:]}{done.stderr[-1000:]}"
    return done.stdout + done.stderr


def run(program, scene, folder, *overrides):
    bulbus(program, "run", SCENES / scene, "-o", folder, "--set", "output.report=true", *overrides)
    return folder / "report.html"


def expect_self_contained(page):
    text = page.read_text()
    assert len(text.encode()) < MOST_BYTES, f"{page} has {len(text)} bytes"
    for pattern in (r"<script[^>]*\ssrc=", r"<link\b", r"<img\b", r"<iframe\b", r"@import", r"url\(", r"href=\"(?!#|run_)"):
        assert not re.search(pattern, text.split("<script", 1)[0] + "".join(re.findall(r"<script[^>]*>", text))), pattern
    assert "default-src 'none'" in text  # browsers then load nothing
    assert "{{" not in text.split("<script")[0], "a place of the page was not filled"
    return text


def expect_figures(page, folder):
    text, summary = expect_self_contained(page), json.loads((folder / "summary.json").read_text())
    assert "The run converged" in text
    for name, value in summary["probes"].items():
        assert f"<td>{name}</td>" in text, name
        assert value is None or f"{value + 0.:.4g}"[:5] in text, (name, value)
    assert str(summary["totals"]["newton_iterations"]) in text
    assert "<svg" in text and 'id="models"' in text


def ink(page, number=0):
    return page.value(INK.replace("NUMBER", str(number)))


def choose(page, element, value, event):
    page.value(f"""(() => {{
      const element = document.getElementById('{element}');
      element.value = '{value}';
      element.dispatchEvent(new Event('{event}'));
    }})()""")


def expect_drawn(page, pictures):
    """Of every view a picture that is not empty, and another one after the slider moved."""
    with browser.Browser(page, 900, 700) as shown:
        shown.wait_for("window.report && window.report.ready")
        views = shown.value("window.report.viewers.length")
        for view in ("open", "section", "detail", "whole", "inside"):
            shown.value(f"window.report.controls.view('{view}')")
            for number in range(views):
                part, _ = ink(shown, number)
                assert part > .02, f"{page}: the view {view} shows nothing: {part}"
            shown.picture(pictures / f"{page.parent.name}_{view}.png")
        shown.value("window.report.controls.view('open')")
        _, last = ink(shown)
        label = shown.value("document.getElementById('state-label').textContent")
        choose(shown, "state", 0, "input")
        _, first = ink(shown)
        assert first != last, f"{page}: the slider moves nothing"
        assert label != shown.value("document.getElementById('state-label').textContent")
        for colour in shown.value("[...document.getElementById('colour').options].map(o => o.value)"):
            choose(shown, "colour", colour, "change")
            assert ink(shown)[0] > .02, colour
        expect_decades(shown)
        assert not shown.faults, shown.faults


def expect_decades(shown):
    """The logarithmic scale goes by powers of ten, and colours of the last state are others."""
    choose(shown, "state", shown.value("document.getElementById('state').max"), "input")
    choose(shown, "colour", "mises", "change")
    linear = ink(shown)
    shown.value("document.getElementById('logarithmic').click()")
    assert ink(shown) != linear, "the logarithmic scale has the colours of the linear one"
    ticks = [float(t) for t in shown.value("[...document.querySelectorAll('#legend .ticks span')].map(s => s.textContent)")]
    assert len(ticks) > 1 and all(abs(b / a - 10) < 1e-9 for a, b in zip(ticks, ticks[1:])), ticks
    shown.value("document.getElementById('logarithmic').click()")
    assert ink(shown) == linear


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        pictures = pathlib.Path(sys.argv[3]) if sys.argv[2:3] == ["--keep"] else folder
        suture, sphere = folder / "suture", folder / "sphere_liquid"
        pages = [run(program, "suture.yaml", suture), run(program, "sphere_liquid.yaml", sphere)]
        for page in pages:
            expect_figures(page, page.parent)
        assert "report.html" in (suture / "manifest.txt").read_text()
        other = folder / "other"
        run(program, "suture.yaml", other, "solver.newton.force=1e-4")
        said = bulbus(program, "report", suture, other)
        assert "comparison.html" in said
        assert "figures differ by more than" in expect_self_contained(suture / "comparison.html")
        said = bulbus(program, "report", folder / "nothing", status=2)
        assert "Name the folder of the results" in said, said
        if not browser.PROGRAM:
            print("pages are right; Chromium is not installed: they were not opened")
            return
        for page in (*pages, suture / "comparison.html"):
            expect_drawn(page, pictures)
    print("pages are right, and drawn")


if __name__ == "__main__":
    main()
