#!/usr/bin/env python3
"""Detaches a part of the retina in a mesh of the eye (MSH 2.2, text), and may tear it.

    python3 data/meshes/detach_retina.py EYE.msh DETACHED.msh --where "y > 5 and abs(z) < 6" [--tear "x < 1 and y > 10"]

Where a face between retina and choroid has its middle (x, y, z in mm) within `--where`, the retina gets nodes of its own, but at
the edge of that part. Hexahedra of the retina whose middle is within `--tear` are taken out. The surfaces retina_back and
retina_bed and the points detached, detached_bed and tear_rim are named, and what the liquid touches now is added to `cavity`.
"""
import argparse
from collections import defaultdict

FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
DIMENSION = {15: 0, 1: 1, 3: 2, 5: 3}


class Eye:
    def __init__(self, path):
        lines = iter(open(path).read().splitlines())
        self.names, self.nodes, self.elements = {}, {}, []  # elements: [dimension, name, nodes]
        for line in lines:
            if line == "$MeshFormat" and not next(lines).startswith("2.2 0"):
                raise SystemExit(path + ": not MSH 2.2 text; save it as such (gmsh -format msh22, or bulbus mesh --text)")
            elif line == "$PhysicalNames":
                for _ in range(int(next(lines))):
                    dimension, tag, name = next(lines).split(maxsplit=2)
                    self.names[int(dimension), int(tag)] = name.strip('"')
            elif line == "$Nodes":
                for _ in range(int(next(lines))):
                    number, *place = next(lines).split()
                    self.nodes[int(number)] = tuple(map(float, place))
            elif line == "$Elements":
                for _ in range(int(next(lines))):
                    _, kind, tags, group, *rest = map(int, next(lines).split())
                    dimension = DIMENSION[kind]
                    self.elements.append([dimension, self.names[dimension, group], rest[tags - 1:]])

    def write(self, path):
        groups = list(dict.fromkeys((d, name) for d, name, _ in self.elements))
        kind = {d: k for k, d in DIMENSION.items()}
        with open(path, "w") as out:
            print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d" % len(groups), file=out)
            for tag, (dimension, name) in enumerate(groups, 1):
                print('%d %d "%s"' % (dimension, tag, name), file=out)
            print("$EndPhysicalNames\n$Nodes\n%d" % len(self.nodes), file=out)
            for number, place in self.nodes.items():
                print(number, *map(repr, place), file=out)
            print("$EndNodes\n$Elements\n%d" % len(self.elements), file=out)
            for number, (dimension, name, nodes) in enumerate(self.elements, 1):
                tag = groups.index((dimension, name)) + 1
                print(number, kind[dimension], 2, tag, tag, *nodes, file=out)
            print("$EndElements", file=out)

    def hexes(self):
        return [e for e in self.elements if e[0] == 3]

    def within(self, condition, nodes):
        x, y, z = (sum(self.nodes[n][c] for n in nodes) / len(nodes) for c in range(3))
        return bool(eval(condition, {"abs": abs}, {"x": x, "y": y, "z": z}))

    def faces(self):
        """Hexahedra on either side of every face."""
        sides = defaultdict(list)
        for e in self.hexes():
            for f in FACES:
                sides[frozenset(e[2][i] for i in f)].append((e, [e[2][i] for i in f]))
        return sides


def tear(eye, condition):
    """Takes the hexahedra out; their nodes, and the faces that others show to the hole."""
    out = [e for e in eye.hexes() if e[1] == "retina" and eye.within(condition, e[2])]
    if not out:
        raise SystemExit("no hexahedron of the retina lies within the tear")
    gone = set(map(id, out))
    eye.elements = [e for e in eye.elements if id(e) not in gone]
    around = {frozenset(o[2][i] for i in f) for o in out for f in FACES}
    left = {key: side for key, side in eye.faces().items() if key in around and len(side) == 1}
    eye.elements = [e for e in eye.elements if e[0] != 2 or frozenset(e[2]) not in around or frozenset(e[2]) in left]
    for [(owner, quad)] in left.values():
        eye.elements.append([2, "cavity", quad])
        if owner[1] == "choroid":
            eye.elements.append([2, "retina_bed", quad])
    return {n for o in out for n in o[2]}


def detach(eye, condition, torn):
    between = {key: side for key, side in eye.faces().items() if sorted(e[1] for e, _ in side) == ["choroid", "retina"]}
    free = {key for key in between if eye.within(condition, list(key))}
    if not free:
        raise SystemExit("no face between retina and choroid lies within the detachment")
    kept = {n for key in set(between) - free for n in key}
    kept |= {n for e in eye.hexes() if e[1] not in ("choroid", "retina") for n in e[2]}
    twin = {}
    for n in sorted({n for key in free for n in key} - kept):
        twin[n] = max(eye.nodes) + 1
        eye.nodes[twin[n]] = eye.nodes[n]
    of_retina = {frozenset(e[2][i] for i in f) for e in eye.hexes() if e[1] == "retina" for f in FACES} - set(between)
    beds = [quad for key in free for e, quad in between[key] if e[1] == "choroid"]
    for e in eye.elements:
        if e[:2] == [3, "retina"] or (e[0] == 2 and frozenset(e[2]) in of_retina):
            e[2] = [twin.get(n, n) for n in e[2]]
    for quad in beds:
        back = [twin.get(n, n) for n in reversed(quad)]
        eye.elements += [[2, "cavity", quad], [2, "retina_bed", quad], [2, "cavity", back], [2, "retina_back", back]]
    eye.elements += [[0, "detached", [t]] for t in twin.values()] + [[0, "detached_bed", [n]] for n in twin]
    eye.elements += [[0, "tear_rim", [t]] for n, t in twin.items() if n in torn]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("eye")
    parser.add_argument("detached")
    parser.add_argument("--where", required=True)
    parser.add_argument("--tear")
    given = parser.parse_args()
    eye = Eye(given.eye)
    torn = tear(eye, given.tear) if given.tear else set()
    detach(eye, given.where, torn)
    eye.write(given.detached)


main()
