"""Blender, as a module of Python, imports files of USD: blender.py life|merged FILE ORGANS.json

At each age of the JSON the scene has as many organs as it lists: instances that have a size, or components of the merged
mesh that are more than a point. The numbers of merged components are those of the JSON.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy

how, path, organs = sys.argv[1], sys.argv[2], json.loads(Path(sys.argv[3]).read_text(encoding="utf-8"))

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=path)
scene = bpy.context.scene
assert (scene.frame_start, scene.frame_end) == (int(min(organs, key=int)), int(max(organs, key=int)))


def mesh_of(name, depsgraph):
    return bpy.data.objects[name].evaluated_get(depsgraph).to_mesh()


def read(mesh, name, kind):
    attribute = mesh.attributes[name]
    assert attribute.data_type == "INT", (name, attribute.data_type)
    values = numpy.zeros(len(attribute.data), dtype=kind)
    attribute.data.foreach_get("value", values)
    return values


def points_of(mesh):
    points = numpy.zeros(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("co", points)
    return points.reshape(-1, 3)


for age, numbers in organs.items():
    scene.frame_set(int(age))
    depsgraph = bpy.context.evaluated_depsgraph_get()
    wood = mesh_of("wood", depsgraph)
    assert len(read(wood, "component_id", numpy.int32)) == len(wood.vertices)
    if how == "life":
        sizes = [max(of.matrix_world.to_scale()) for of in depsgraph.object_instances if of.is_instance]
        count = sum(size > 1e-7 for size in sizes)
    else:
        mesh = mesh_of("organs", depsgraph)
        points, of = points_of(mesh), read(mesh, "component_id", numpy.int32)
        found = [number for number in numpy.unique(of) if numpy.ptp(points[of == number], axis=0).max() > 1e-6]
        assert found == numbers, age
        count = len(found)
    assert count == len(numbers), f"{count} organs at {age}, {len(numbers)} in records"
print(bpy.app.version_string, how, {age: len(of) for age, of in organs.items()})
