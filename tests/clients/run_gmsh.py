"""Meshes a packing with Gmsh and checks volumes of the phases and equal meshes on opposite sides:
run_gmsh.py <vitrel> <packing> <gmsh> <shrink> <mesh size> [<finer mesh size>]"""
import collections
import re
import subprocess
import sys

import numpy as np

from packing import export


def section(text, name):
    return text.split(f"${name}\n")[1].split(f"$End{name}")[0].splitlines()


class Mesh:
    """A mesh in the format MSH 2.2; nodes are counted from 0."""

    def __init__(self, text):
        physical = {}
        for line in section(text, "PhysicalNames")[1:]:
            dimension, tag, name = re.match(r'(\d) (\d+) "(.*)"', line).groups()
            physical[int(dimension), int(tag)] = name
        rows = [line.split() for line in section(text, "Nodes")[1:]]
        self.nodes = np.array([row[1:] for row in rows], float)
        self.number = {int(row[0]): k for k, row in enumerate(rows)}
        elements = collections.defaultdict(list)
        for line in section(text, "Elements")[1:]:
            _, kind, tags, *rest = map(int, line.split())
            elements[physical[kind // 2 + 1, rest[0]]].append([self.number[k] for k in rest[tags:]])
        self.elements = {name: np.array(nodes) for name, nodes in elements.items()}  # triangles or tetrahedra
        self.periodic = list(self.pairs(iter(section(text, "Periodic"))))

    def pairs(self, lines):
        """(a node of a face, the one it is a copy of)."""
        for _ in range(int(next(lines))):
            dimension = int(next(lines).split()[0])
            line = next(lines)
            for _ in range(int(next(lines) if line.startswith("Affine") else line)):
                pair = next(lines).split()
                if dimension == 2:
                    yield tuple(self.number[int(k)] for k in pair)

    def corners(self, name):
        return self.nodes[self.elements[name]]


def volumes(tetrahedra):
    return np.abs(np.linalg.det(tetrahedra[:, 1:] - tetrahedra[:, :1])) / 6


def outer_triangles(tetrahedra):
    """Those of one tetrahedron only, and its number."""
    faces = np.sort(np.concatenate([np.delete(tetrahedra, k, axis=1) for k in range(4)]), axis=1)
    _, first, count = np.unique(faces, axis=0, return_index=True, return_counts=True)
    single = first[count == 1]
    return faces[single], single % len(tetrahedra)


def meshed(path, size):
    done = subprocess.run([sys.argv[3], "-3", path, "-setnumber", "h", str(size), "-format", "msh22", "-o", path + ".msh"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "Error" not in done.stdout + done.stderr, done.stdout + done.stderr
    with open(path + ".msh", encoding="ascii") as file:
        return Mesh(file.read())


def check_sides(mesh, box):
    """Opposite sides have the same nodes and triangles, one period apart."""
    worst = 0
    for k, axis in enumerate("xyz"):
        low, high = mesh.elements[axis + "min"], mesh.elements[axis + "max"]
        period = box[k] * np.eye(3)[k]
        twin = {b: a for a, b in mesh.periodic if (mesh.nodes[a] - mesh.nodes[b])[k] > 0.5 * box[k]}
        twin |= {a: b for a, b in mesh.periodic if False}
        assert len(twin) > 100
        assert set(twin) == set(low.ravel()) and set(twin.values()) == set(high.ravel()), axis
        off = mesh.nodes[list(twin.values())] - mesh.nodes[list(twin)] - period
        worst = max(worst, np.abs(off).max() / box[k])
        assert {frozenset(twin[n] for n in t) for t in low} == {frozenset(t) for t in high}, axis
        assert abs(np.abs(mesh.nodes[low.ravel(), k]) - box[k] / 2).max() < 1e-9 * box[k]
    return worst


right, path = export("geo", "--shrink", sys.argv[4])
shrink = float(sys.argv[4])
with open(path, encoding="utf-8") as file:
    moved = np.array(re.search(r"less \((.*)\)", file.read()).group(1).split(", "), float)
for size in sys.argv[5:]:
    mesh = meshed(path, size)
    inclusions = [name for name in mesh.elements if name.startswith("inclusions")]
    total = sum(volumes(mesh.corners(name)).sum() for name in [*inclusions, "matrix"])
    print("total", total / right.box.prod() - 1, "sides", check_sides(mesh, right.box))
    found = sum(volumes(mesh.corners(name)).sum() for name in inclusions)
    print("inclusions", 1- found / (shrink**3 * right.volumes().sum()), len(mesh.nodes))
