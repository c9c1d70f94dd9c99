"""Five readers of PLY read every mesh of a run folder: meshes.py RUN [tubes]

Vertex and face counts are those of the header. Each internode is a closed tube: watertight, of positive volume, within
1 % of the sum of the round frusta of the recorded lengths and diameters, which tubes keep whatever their sides.
"""

import math
import sys
from pathlib import Path

import duckdb
import meshio
import numpy
import open3d
import plyfile
import pyvista
import trimesh

run = Path(sys.argv[1])
PROFILE = [
    "x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "s", "t",
    "birth_age", "death_age", "component_id", "kind",
]  # fmt: skip


def header(path):
    counts = {}
    with open(path, "rb") as file:
        for line in iter(file.readline, b"end_header\n"):
            words = line.decode().split()
            if words[0] == "element":
                counts[words[1]] = int(words[2])
    return counts["vertex"], counts["face"]


def readers(path):
    ply = plyfile.PlyData.read(str(path))
    assert [p.name for p in ply["vertex"].properties] == PROFILE, ply["vertex"].properties
    yield "plyfile", len(ply["vertex"]), len(ply["face"])
    mesh = trimesh.load(str(path), process=False)
    yield "trimesh", len(mesh.vertices), len(mesh.faces)
    mesh = open3d.io.read_triangle_mesh(str(path))
    yield "open3d", len(mesh.vertices), len(mesh.triangles)
    mesh = meshio.read(str(path))
    yield "meshio", len(mesh.points), sum(len(block.data) for block in mesh.cells if block.type == "triangle")
    mesh = pyvista.read(str(path))
    yield "pyvista", mesh.n_points, mesh.n_cells


def frustum(length, base, tip):
    return math.pi * length / 12 * (base * base + base * tip + tip * tip)


def tubes(path, plant, age):
    """Each internode of a mesh by itself."""
    ply = plyfile.PlyData.read(str(path))
    vertex = ply["vertex"].data
    faces = numpy.vstack(ply["face"].data["vertex_indices"])
    points = numpy.column_stack([vertex["x"], vertex["y"], vertex["z"]]).astype(float)
    owner = vertex["component_id"][faces[:, 0]]
    rows = duckdb.sql(f"""
        select component_id, length_m, diameter_m, diameter_tip_m from read_parquet('{run}/records/part-*.parquet')
        where plant_id = {plant} and age = {age} and kind in ('internode', 'short_internode')
        order by component_id""").fetchall()
    total = expected = 0.0
    for component, length, base, tip in rows:
        if length <= 0 or base <= 0:
            continue
        mesh = trimesh.Trimesh(points, faces[owner == component], process=False)
        mesh.remove_unreferenced_vertices()
        mesh.merge_vertices(digits_vertex=9)
        assert mesh.is_watertight, f"{path}: the tube of component {component} is open"
        assert mesh.volume > 0, f"{path}: the tube of component {component} is inside out"
        total += mesh.volume
        expected += frustum(length, base, tip)
    assert rows and abs(total - expected) <= 0.01 * expected, f"{path}: volume {total}, frusta {expected}"
    return len(rows)


meshes = sorted((run / "meshes").glob("*.ply"))
assert meshes, f"no meshes in {run}"
for path in meshes:
    expected = header(path)
    for name, vertices, faces in readers(path):
        assert (vertices, faces) == expected, f"{name} reads {vertices} vertices and {faces} faces of {path}: {expected}"
    print(f"{path.name}: {expected[0]} vertices, {expected[1]} faces, five readers agree")

if len(sys.argv) > 2:
    path = meshes[0]
    plant, age = (int(part.split("-")[1]) for part in path.stem.split("_")[:2])
    print(f"{tubes(path, plant, age)} closed tubes, volumes as the frusta")
print("meshes ok")
