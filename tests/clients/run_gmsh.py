"""Meshes a packing with Gmsh: volumes of the phases, and equal meshes on opposite sides.

run_gmsh.py <vitrel> <packing> <gmsh> <shrink> <mesh size>"""
import collections
import re
import subprocess
import sys

import numpy as np

from packing import export


def section(text, name):
    return text.split(f"${name}\n")[1].split(f"$End{name}")[0].splitlines()


class Mesh:
    """A mesh in the format MSH 2.2, its nodes counted from 0."""

    def __init__(self, text):
        groups = {}
        for line in section(text, "PhysicalNames")[1:]:
            dimension, tag, name = re.match(r'(\d) (\d+) "(.*)"', line).groups()
            groups[int(dimension), int(tag)] = name
        rows = [line.split() for line in section(text, "Nodes")[1:]]
        self.nodes = np.array([row[1:] for row in rows], float)
        self.number = {int(row[0]): k for k, row in enumerate(rows)}
        elements = collections.defaultdict(list)
        for line in section(text, "Elements")[1:]:
            _, kind, tags, *rest = map(int, line.split())
            elements[groups[kind // 2 + 1, rest[0]]].append([self.number[n] for n in rest[tags:]])
        self.elements = {name: np.array(nodes) for name, nodes in elements.items()}  # triangles, tetrahedra
        self.pairs = list(self.periodic(iter(section(text, "Periodic"))))

    def periodic(self, lines):
        """Nodes of faces, and those that they are copies of."""
        for _ in range(int(next(lines))):
            dimension = int(next(lines).split()[0])
            line = next(lines)
            for _ in range(int(next(lines) if line.startswith("Affine") else line)):
                pair = next(lines).split()
                if dimension == 2:
                    yield [self.number[int(tag)] for tag in pair]

    def volumes(self, name):
        corners = self.nodes[self.elements[name]]
        return np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6


def meshed(path, size):
    done = subprocess.run([sys.argv[3], "-3", path, "-setnumber", "h", str(size), "-format", "msh22",
                           "-o", path + ".msh"], capture_output=True, text=True, check=False)
    log = done.stdout + done.stderr
    assert done.returncode == 0 and "Error" not in log, log
    with open(path + ".msh", encoding="ascii") as file:
        return Mesh(file.read())


def check_sides(mesh, box):
    """Opposite sides have the same nodes and the same triangles, one period apart."""
    for k, axis in enumerate("xyz"):
        low, high = mesh.elements[axis + "min"], mesh.elements[axis + "max"]
        for side, place in (low, -box[k] / 2), (high, box[k] / 2):
            assert np.abs(mesh.nodes[side, k] - place).max() < 1e-9 * box[k]
        image = {b: a for a, b in mesh.pairs if mesh.nodes[a, k] - mesh.nodes[b, k] > box[k] / 2}
        off = mesh.nodes[list(image.values())] - mesh.nodes[list(image)] - box * np.eye(3)[k]
        assert np.abs(off).max() < 1e-9 * box[k], axis
        assert set(image) == set(low.ravel()), axis
        assert {frozenset(image[n] for n in nodes) for nodes in low} == set(map(frozenset, high)), axis


def holders(right, points):
    """The image that holds each point: its particle and its centre."""
    particle, centre = np.full(len(points), -1), np.zeros_like(points)
    for i in range(right.n):
        for shift in np.ndindex(3, 3, 3):
            at = np.array(shift) - 1
            held = right.inside(i, at, points)
            assert (particle[held] == -1).all()
            particle[held], centre[held] = i, right.position[i] + at * right.box
    assert (particle >= 0).all()
    return particle, centre


def surface(tetrahedra):
    """The triangles that belong to one tetrahedron only, and its number."""
    faces = np.sort(np.concatenate([np.delete(tetrahedra, k, axis=1) for k in range(4)]), axis=1)
    _, first, count = np.unique(faces, axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]], first[count == 1] % len(tetrahedra)


def check_volumes(mesh, right):
    """The volume of every particle, all its slices together. Returns what flat elements lose of it on average.

    Over an element the surface xᵀPx = 1 rises, to leading order, like a quadratic form: by the mean Σ κ e²/24 over
    its edges e, where κ e² = eᵀPe/|Px|. So the lost share λ is known but for terms of order λ².
    """
    inclusions = [name for name in mesh.elements if name.startswith("inclusions ")]
    total = sum(mesh.volumes(name).sum() for name in ["matrix", *inclusions])
    assert abs(total / right.box.prod() - 1) < 1e-9, total

    tetrahedra = np.concatenate([mesh.elements[name] for name in inclusions])
    volumes = np.concatenate([mesh.volumes(name) for name in inclusions])
    particle, centre = holders(right, mesh.nodes[tetrahedra].mean(axis=1))
    groups = np.repeat(inclusions, [len(mesh.elements[name]) for name in inclusions])
    assert list(groups) == ["inclusions " + right.species[i] for i in particle]

    triangles, owner = surface(tetrahedra)
    corners = mesh.nodes[triangles]
    on_side = (np.abs(np.abs(corners) - right.box / 2) < 1e-9 * right.box).all(axis=1).any(axis=1)
    lost = []
    for i, whole in enumerate(right.volumes()):
        curved = (particle[owner] == i) & ~on_side
        x = corners[curved] - centre[owner[curved], None]
        form = right.turn[i] / right.axes[i]**2 @ right.turn[i].T
        assert np.allclose(np.einsum("tci,ij,tcj->tc", x, form, x), 1, rtol=0, atol=1e-6), "nodes on the surface"
        e = x - np.roll(x, 1, axis=1)
        area = np.linalg.norm(np.cross(e[:, 0], e[:, 1]), axis=1) / 2
        rise = np.einsum("tei,ij,tej->t", e, form, e) / np.linalg.norm(x.mean(axis=1) @ form, axis=1) / 24
        share = (area * rise).sum() / whole
        assert abs(volumes[particle == i].sum() / whole - (1 - share)) < share**2, (i, share)
        lost.append(share)
    return np.mean(lost)


right, path = export("geo", "--shrink", sys.argv[4])
right.axes = right.axes * float(sys.argv[4])
with open(path, encoding="utf-8") as file:
    right.position -= np.array(re.search(r"less \((.*)\)", file.read()).group(1).split(", "), float)
coarser = 0.2
for size in sys.argv[5:]:
    mesh = meshed(path, size)
    check_sides(mesh, right.box)
    lost = check_volumes(mesh, right)
    assert lost < coarser / 2, (lost, coarser)
    coarser = lost
