#!/usr/bin/env python3
"""Fails where a file includes from a floor above its own, from a sibling, from a room that is closed to its own, or a wrapped library
outside its wrappers, or opens a namespace that is not its floor's."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FLOORS = [["core/base"], ["core/mesh"], ["core/io"], ["core/material"], ["core/element"], ["core/problem"], ["core/solve"],
          ["precond", "contact", "app/eye"], ["app"], ["tests", "benchmarks"]]
MESH_FILES = ["core/mesh/gmsh", "core/mesh/abaqus", "core/mesh/vtk"]
# Within a floor: folder -> the folders beside it that it may not include.
ROOMS = {
    "core/mesh/generate": ["core/mesh/distributed", *MESH_FILES],
    "core/mesh/distributed": [*MESH_FILES],
    "core/mesh/gmsh": ["core/mesh/distributed", "core/mesh/abaqus", "core/mesh/vtk"],
    "core/mesh/abaqus": ["core/mesh/distributed", "core/mesh/generate", "core/mesh/gmsh", "core/mesh/vtk"],
    "core/mesh/vtk": ["core/mesh/distributed", "core/mesh/generate", "core/mesh/gmsh", "core/mesh/abaqus"],
    "precond/smoothers": ["precond/amg", "precond/coarse", "precond/schur"],
    "precond/schur": ["precond/amg", "precond/coarse"],
    "precond/amg": ["precond/schur"],
    "precond/coarse": ["precond/schur"],
    "contact/search": ["contact/law", "contact/suture", "contact/rigid"],
    "contact/surfaces": ["contact/law", "contact/suture"],
    "contact/rigid": ["contact/law", "contact/suture", "contact/search"],
    "contact/law": ["contact/suture", "contact/rigid"],
    "contact/suture": ["contact/law", "contact/search"],
    "app/plot": ["app/memory", "app/records", "app/report", "app/scene", "app/study", "app/trade"],
    "app/scene": ["app/records", "app/trade", "app/plot", "app/report"],
    "app/memory": ["app/records", "app/study", "app/trade", "app/plot", "app/report"],
    "app/records": ["app/study", "app/trade", "app/plot", "app/report"],
    "app/study": ["app/records", "app/trade", "app/memory", "app/report"],
    "app/report": ["app/memory", "app/trade"],
}
LEVEL = {folder: level for level, floor in enumerate(FLOORS) for folder in floor}
WRAPPED = {  # header pattern: the sources that may include it
    r"(Tpetra|Belos|Teuchos|Kokkos)\w*\.hpp": r"core/solve/(fgmres\.cpp|krylov_vectors\.hpp)",
    r"_?hypre\w*\.h|HYPRE\w*\.h": r"precond/amg/boomeramg\.cpp",
    r"dmumps_c\.h": r"core/solve/mumps\.cpp",
    r"superlu_\w+\.h": r"core/solve/direct/superlu_dist\.cpp",
    r"umfpack\.h": r"core/solve/direct/umfpack\.cpp",
    r"Eigen/SparseLU": r"core/solve/direct/eigen_lu\.cpp",
    r"hdf5\.h|H5\w*\.h": r"core/io/hdf5_\w+\.(cpp|hpp)|core/solve/dump\.cpp|core/io/vtkhdf\.cpp",
    r"zlib\.h": r"core/mesh/vtk/vtu_bytes\.cpp|core/io/deflate\.cpp",
    r"metis\.h": r"core/mesh/distributed/partition\.cpp|core/solve/direct/nested_dissection\.cpp",
    r"yaml-cpp/.*": r"app/.*",
    r"muParser\.h": r"core/problem/formula\.cpp",
}


def folder_of(path):
    return next((f for f in sorted(LEVEL, key=len, reverse=True) if path.startswith(f + "/")), None)


def namespace_of(folder):
    return "bulbus::inline " + folder.split("/")[-1]


# The namespaces that a file may open, besides those within them: its own floor's, and of those below to declare a class.
def open_to(own):
    if own in (None, "tests", "benchmarks", "core/base"):
        return None
    return [namespace_of(f) for f in LEVEL if f == own or LEVEL[f] < LEVEL[own]]


def faults(path, text):
    own = folder_of(path)
    allowed = open_to(own)
    for number, line in enumerate(text.splitlines(), 1):
        opened = re.match(r"namespace (bulbus\b[^{]*?) \{", line)
        if opened and allowed and not any(re.fullmatch(a + r"(::\w+)?", opened.group(1)) for a in allowed):
            yield f"{path}:{number}: {opened.group(1)} is not the namespace of {own}: {namespace_of(own)}"
    for number, line in enumerate(text.splitlines(), 1):
        found = re.match(r'\s*#include\s+["<]([^">]+)[">]', line)
        if not found:
            continue
        target = found.group(1)
        other = folder_of(target)
        if own and other and other != own and LEVEL[other] >= LEVEL[own]:
            yield f"{path}:{number}: {own} may not include {target}"
        room = str(pathlib.PurePath(path).parent)
        for closed in ROOMS.get(room, []):
            if target.startswith(closed + "/"):
                yield f"{path}:{number}: {room} may not include {target}"
        for pattern, allowed in WRAPPED.items():
            if re.fullmatch(pattern, target) and not re.fullmatch(allowed, path) and not path.startswith("tests/"):
                yield f"{path}:{number}: {target} belongs inside {allowed}"


def main():
    all_faults = []
    files = [p for p in ROOT.rglob("*") if p.suffix in (".cpp", ".hpp") and "build" not in p.relative_to(ROOT).parts[0]]
    for p in files:
        all_faults += faults(str(p.relative_to(ROOT)), p.read_text())
    print("\n".join(all_faults) or f"{len(files)} files keep to their floors")
    return 1 if all_faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
