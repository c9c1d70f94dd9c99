"""Blender, as a module of Python, imports levels of detail: lods_blender.py FACES… -- FILE…

One GLB file has an object for each level; of OBJ there is a file for each. Each level has as many triangles as is
stated, of which none is lost, and the extent of the first within a tenth.
"""

import sys
from pathlib import Path

import bpy
from mathutils import Vector

break_at = sys.argv.index("--")
stated, paths = [int(count) for count in sys.argv[1:break_at]], sys.argv[break_at + 1 :]


def levels(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if Path(path).suffix == ".glb":
        bpy.ops.import_scene.gltf(filepath=path)
    else:
        bpy.ops.wm.obj_import(filepath=path)
    meshes = [object for object in bpy.data.objects if object.type == "MESH"]
    if Path(path).suffix != ".glb":
        return [meshes]
    names = sorted({object.name.rpartition("_lod")[2].partition(".")[0] for object in meshes}, key=int)
    return [[object for object in meshes if object.name.rpartition("_lod")[2].partition(".")[0] == name] for name in names]


def extent(objects):
    corners = [object.matrix_world @ Vector(corner) for object in objects for corner in object.bound_box]
    return [max(corner[k] for corner in corners) - min(corner[k] for corner in corners) for k in range(3)]


def count(objects):
    total = 0
    for object in objects:
        object.data.calc_loop_triangles()
        total += len(object.data.loop_triangles)
    return total


def read(files):
    found, extents = [], []
    for path in files:
        for objects in levels(path):
            found.append(count(objects))
            extents.append(extent(objects))
    assert found == stated, (files, found, stated)
    for sizes in extents:
        assert all(abs(size / first - 1) < 0.1 for size, first in zip(sizes, extents[0])), extents
    print(bpy.app.version_string, files[0], found)


glb = [path for path in paths if path.endswith(".glb")]
read(glb)
read([path for path in paths if path not in glb])
