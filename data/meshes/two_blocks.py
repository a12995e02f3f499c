#!/usr/bin/env python3
"""Writes two_blocks.msh (MSH 2.2, text): a block of 3 x 3 x 2 cells that stands on one of 4 x 4 x 2.

    python3 data/meshes/two_blocks.py > data/meshes/two_blocks.msh

Each block has nodes of its own, also where the two touch. Physical volumes name the regions, physical surfaces the faces.
"""

nodes, volumes, surfaces = [], {}, {}


def block(name, low, high, n):
    first = len(nodes)
    step = [(b - a) / k for a, b, k in zip(low, high, n)]
    nodes.extend([low[0] + i * step[0], low[1] + j * step[1], low[2] + k * step[2]]
                 for k in range(n[2] + 1) for j in range(n[1] + 1) for i in range(n[0] + 1))

    def at(i, j, k):
        return first + i + (n[0] + 1) * (j + (n[1] + 1) * k) + 1

    def quad(i, j, k):
        return [at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)]

    columns = [(i, j) for j in range(n[1]) for i in range(n[0])]
    volumes[name] = [quad(i, j, k) + quad(i, j, k + 1) for k in range(n[2]) for i, j in columns]
    surfaces[name + "_bottom"] = [quad(i, j, 0) for i, j in columns]
    surfaces[name + "_top"] = [quad(i, j, n[2]) for i, j in columns]


def main():
    block("low", (0, 0, 0), (1, 1, .5), (4, 4, 2))
    block("high", (0, 0, .5), (.8, .8, 1), (3, 3, 2))
    groups = [(2, name, quads) for name, quads in surfaces.items()] + [(3, name, hexes) for name, hexes in volumes.items()]
    print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d" % len(groups))
    for tag, (dimension, name, _) in enumerate(groups, 1):
        print('%d %d "%s"' % (dimension, tag, name))
    print("$EndPhysicalNames\n$Nodes\n%d" % len(nodes))
    for number, place in enumerate(nodes, 1):
        print(number, *("%.10g" % x for x in place))
    elements = [(3 if dimension == 2 else 5, tag, e) for tag, (dimension, _, all_of) in enumerate(groups, 1) for e in all_of]
    print("$EndNodes\n$Elements\n%d" % len(elements))
    for number, (kind, tag, e) in enumerate(elements, 1):
        print(number, kind, 2, tag, tag, *e)
    print("$EndElements")


main()
