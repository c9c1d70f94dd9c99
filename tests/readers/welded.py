"""trimesh reads welded wood: welded.py KIND,KIND... WELDED.ply OPEN.ply [WELDED.ply OPEN.ply]...

Of both files of a pair the internodes are read, by the numbers of their kinds. The welded ones are watertight, wound one way, one
body and of Euler number 2. Their volume is within 2 % of the union of the frusta of the open mesh, which is found by
Karp and Luby's method (1985): points are drawn in the frusta by their volumes, and the union is the sum of the volumes
times the mean of 1 / the number of frusta that hold a point. Its standard error is computed, and four of them are
taken off the 2 %. Frusta are round: of each ring of the open mesh the circle of its area.
"""

import sys

import numpy
import plyfile
import trimesh
from scipy.spatial import cKDTree

DRAWS = 60_000
kinds = [int(kind) for kind in sys.argv[1].split(",")]


def wood(path):
    """Points, triangles, and per point the component and s of the internodes of a file."""
    ply = plyfile.PlyData.read(path)
    vertex = ply["vertex"].data
    faces = numpy.vstack(ply["face"].data["vertex_indices"]).astype(int)
    points = numpy.column_stack([vertex["x"], vertex["y"], vertex["z"]]).astype(float)
    is_wood = numpy.isin(vertex["kind"], kinds)
    return points, faces[is_wood[faces].all(axis=1)], vertex["component_id"], vertex["s"], is_wood


def frusta(path):
    """Base, direction, length and radii of every frustum between two rings of an internode."""
    points, _, component, s, is_wood = wood(path)
    starts = numpy.flatnonzero(numpy.r_[True, component[1:] != component[:-1], True])
    rows = []
    for first, end in zip(starts[:-1], starts[1:]):
        if not is_wood[first]:
            continue
        at, rings = first, []
        while at < end and s[at] == 0:
            ends = numpy.flatnonzero(s[at:end] == 1)
            if len(ends) == 0:
                break
            ring = points[at : at + ends[0]]
            middle = ring.mean(axis=0)
            out = ring - middle
            area = numpy.linalg.norm(numpy.cross(out, numpy.roll(out, -1, axis=0)).sum(axis=0)) / 2
            rings.append((middle, numpy.sqrt(area / numpy.pi)))
            at += ends[0] + 1
        for (low, r), (high, q) in zip(rings, rings[1:]):
            length = numpy.linalg.norm(high - low)
            if length > 0 and max(r, q) > 0:
                rows.append([*low, *((high - low) / length), length, r, q])
    return numpy.array(rows)


def union(rows):
    """The volume of the union, and its standard error."""
    base, way, length, low, high = rows[:, :3], rows[:, 3:6], rows[:, 6], rows[:, 7], rows[:, 8]
    volume = numpy.pi * length / 3 * (low * low + low * high + high * high)
    draw = numpy.random.default_rng(1)
    of = draw.choice(len(rows), DRAWS, p=volume / volume.sum())
    share, open_ = numpy.zeros(DRAWS), numpy.arange(DRAWS)
    while len(open_):
        tried = draw.random(len(open_))
        radius = low[of[open_]] + tried * (high[of[open_]] - low[of[open_]])
        taken = draw.random(len(open_)) < (radius / numpy.maximum(low[of[open_]], high[of[open_]])) ** 2
        share[open_[taken]] = tried[taken]
        open_ = open_[~taken]
    radius = (low[of] + share * (high[of] - low[of])) * numpy.sqrt(draw.random(DRAWS))
    turned = 2 * numpy.pi * draw.random(DRAWS)
    least = numpy.eye(3)[numpy.abs(way[of]).argmin(axis=1)]
    side = numpy.cross(way[of], least)
    side /= numpy.linalg.norm(side, axis=1)[:, None]
    other = numpy.cross(way[of], side)
    at = base[of] + (share * length[of])[:, None] * way[of]
    at += (radius * numpy.cos(turned))[:, None] * side + (radius * numpy.sin(turned))[:, None] * other
    middle, reach = base + 0.5 * length[:, None] * way, numpy.hypot(0.5 * length, numpy.maximum(low, high))
    held = numpy.zeros(DRAWS, int)
    size = numpy.floor(numpy.log2(reach)).astype(int)
    for step in numpy.unique(size):
        some = numpy.flatnonzero(size == step)
        near = cKDTree(middle[some]).query_ball_point(at, 2.0 ** (step + 1))
        point = numpy.repeat(numpy.arange(DRAWS), [len(list_) for list_ in near])
        if len(point) == 0:
            continue
        frustum = some[numpy.concatenate([numpy.array(list_, int) for list_ in near])]
        from_base = at[point] - base[frustum]
        along = (from_base * way[frustum]).sum(axis=1)
        aside = numpy.sqrt(numpy.maximum((from_base**2).sum(axis=1) - along**2, 0))
        wide = low[frustum] + along / length[frustum] * (high[frustum] - low[frustum])
        numpy.add.at(held, point, (along >= 0) & (along <= length[frustum]) & (aside <= wide))
    shares = 1 / numpy.maximum(held, 1)
    return volume.sum() * shares.mean(), volume.sum() * shares.std() / numpy.sqrt(DRAWS)


def check(welded, opened):
    points, faces, *_ = wood(welded)
    mesh = trimesh.Trimesh(points, faces, process=False)
    mesh.remove_unreferenced_vertices()
    merged = trimesh.Trimesh(points, faces, process=True)
    for name, read in [("as it is", mesh), ("merged by place", merged)]:
        found = read.is_watertight, read.is_winding_consistent, read.body_count, read.euler_number
        assert found == (True, True, 1, 2), f"{welded} {name}: {found}"
    expected, error = union(frusta(opened))
    off = abs(mesh.volume / expected - 1)
    assert off + 4 * error / expected < 0.02, f"{welded}: volume {mesh.volume}, union {expected} +- {error}"
    print(f"{welded}: {len(faces)} triangles, a sphere, {100 * (mesh.volume / expected - 1):+.2f} % of the union (error {100 * error / expected:.2f} %)")


for welded, opened in zip(sys.argv[2::2], sys.argv[3::2]):
    check(welded, opened)
