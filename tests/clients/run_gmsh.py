"""Meshes a packing with Gmsh: volumes of the phases, no holes, and equal nodes on opposite faces."""
import collections
import re
import subprocess
import sys

import numpy as np

from packing import export

SHRINK = 0.9


def section(text, name):
    return text.split(f"${name}\n")[1].split(f"$End{name}")[0].splitlines()


class Mesh:
    """A mesh in the format MSH 2.2."""

    def __init__(self, text):
        self.physical = {}
        for line in section(text, "PhysicalNames")[1:]:
            dimension, tag, name = re.match(r'(\d) (\d+) "(.*)"', line).groups()
            self.physical[name] = int(dimension), int(tag)
        self.nodes = {}
        for line in section(text, "Nodes")[1:]:
            tag, *x = line.split()
            self.nodes[int(tag)] = np.array(x, float)
        self.elements = collections.defaultdict(list)  # (type, physical tag) → nodes
        for line in section(text, "Elements")[1:]:
            _, kind, tags, *rest = map(int, line.split())
            self.elements[kind, rest[0]].append(rest[tags:])
        self.periodic = []  # (nodes of the one, of the other), of faces
        lines = iter(section(text, "Periodic"))
        for _ in range(int(next(lines))):
            dimension = int(next(lines).split()[0])
            line = next(lines)
            count = int(next(lines) if line.startswith("Affine") else line)
            pairs = np.array([next(lines).split() for _ in range(count)], int).reshape(-1, 2)
            if dimension == 2:
                self.periodic.append(pairs)

    def points(self, name):
        """The corners of the triangles or tetrahedra of a group, elements × corners × 3."""
        dimension, tag = self.physical[name]
        return np.array([[self.nodes[k] for k in nodes] for nodes in self.elements[2 * dimension - 2, tag]])

    def volume(self, name):
        p = self.points(name)
        return np.abs(np.linalg.det(p[:, 1:] - p[:, :1])).sum() / 6


right, path = export("geo", "--shrink", str(SHRINK))
done = subprocess.run([sys.argv[3], "-3", path, "-setnumber", "h", "0.1", "-format", "msh22", "-o", path + ".msh"],
                      capture_output=True, text=True, check=True)
assert "Error" not in done.stdout + done.stderr, done.stdout + done.stderr
with open(path + ".msh", encoding="ascii") as file:
    mesh = Mesh(file.read())

# Flat elements inside a convex body lose about (h/r)²/8 of its width.
volumes = SHRINK**3 * right.volumes()
for kind in set(right.species):
    found, expected = mesh.volume("inclusions " + kind), volumes[[s == kind for s in right.species]].sum()
    assert 0.95 * expected < found < expected, (kind, found, expected)
total = mesh.volume("matrix") + sum(mesh.volume("inclusions " + kind) for kind in set(right.species))
assert abs(total / right.box.prod() - 1) < 1e-9, total

for k, axis in enumerate("xyz"):
    sides = []
    for end, sign in (("min", -1), ("max", 1)):
        points = mesh.points(axis + end).reshape(-1, 3)
        assert np.allclose(points[:, k], sign * right.box[k] / 2, atol=1e-9)
        sides.append(np.unique(np.round(np.delete(points, k, axis=1), 6), axis=0))
    assert len(sides[0]) > 100
    assert np.array_equal(*sides), axis

paired = np.concatenate(mesh.periodic)
offsets = np.array([(mesh.nodes[a] - mesh.nodes[b]) / right.box for a, b in paired])
assert np.allclose(np.abs(offsets).sum(axis=1), 1, atol=1e-6), "one period along one axis"
assert set(np.abs(offsets).argmax(axis=1)) == {0, 1, 2}
