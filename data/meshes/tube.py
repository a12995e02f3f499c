#!/usr/bin/env python3
"""Writes a quarter of a round tube along z with walls across it, as an Abaqus file of hexahedra.

    python3 data/meshes/tube.py tube.inp lumen=10/8 cap=1/2 [--inner 4] [--outer 5] [--n 4] [--layers 2]

Segments follow each other from z = 0, each NAME=LENGTH/LAYERS (mm): `lumen` is hollow, every other one solid. Regions: `wall` outside of
the inner radius, and inside of it the solid segments by their names. The planes x = 0 and y = 0 cut the tube.
"""
import argparse
import math


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("segments", nargs="+")
    parser.add_argument("--inner", type=float, default=4, help="radius, mm")
    parser.add_argument("--outer", type=float, default=5, help="radius, mm")
    parser.add_argument("--n", type=int, default=4, help="cells along half an edge of the core; the quarter's rim has 2 n")
    parser.add_argument("--layers", type=int, default=2, help="cells through the wall")
    return parser.parse_args()


def section(inner, outer, n, layers):
    """Positions of a plane's nodes, and its quads: those of the disc within the inner radius, those of the wall."""
    core, rings = 0.55 * inner, n
    nodes = [(core * i / n, core * j / n) for j in range(n + 1) for i in range(n + 1)]
    disc = [tuple((j + b) * (n + 1) + i + a for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))) for j in range(n) for i in range(n)]
    rim = [j * (n + 1) + n for j in range(n + 1)] + [n * (n + 1) + i for i in reversed(range(n))]
    start, wall = [nodes[k] for k in rim], []
    for ring in range(1, rings + layers + 1):
        first = len(nodes)
        for k, (x, y) in enumerate(start):
            angle = math.pi / 4 * k / n
            part = min(1, ring / rings)
            radius = inner + (outer - inner) * max(0, ring - rings) / layers
            nodes.append(((1 - part) * x + part * radius * math.cos(angle), (1 - part) * y + part * radius * math.sin(angle)))
        new = list(range(first, len(nodes)))
        quads = [(rim[k], new[k], new[k + 1], rim[k + 1]) for k in range(2 * n)]
        (disc if ring <= rings else wall).extend(quads)
        rim = new
    return nodes, disc, wall


def main():
    args = arguments()
    plane, disc, wall = section(args.inner, args.outer, args.n, args.layers)
    heights, cells = [0.0], {"wall": []}
    for segment in args.segments:
        name, _, size = segment.partition("=")
        length, layers = size.split("/")
        for layer in range(int(layers)):
            base = (len(heights) - 1) * len(plane)
            heights.append(heights[-1] + float(length) / int(layers))
            for region, quads in (("wall", wall), (name, [] if name == "lumen" else disc)):
                hexahedra = [[base + k for k in quad] + [base + len(plane) + k for k in quad] for quad in quads]
                cells.setdefault(region, []).extend(hexahedra)
    used = sorted({k for hexahedra in cells.values() for cell in hexahedra for k in cell})
    with open(args.file, "w") as file:
        print("*NODE", file=file)
        for k in used:
            x, y = plane[k % len(plane)]
            print(f"{k + 1}, {x:.9g}, {y:.9g}, {heights[k // len(plane)]:.9g}", file=file)
        number = 0
        for region, hexahedra in cells.items():
            if hexahedra:
                print(f"*ELEMENT, TYPE=C3D8, ELSET={region}", file=file)
            for cell in hexahedra:
                number += 1
                print(", ".join(str(k) for k in [number] + [k + 1 for k in cell]), file=file)


main()
