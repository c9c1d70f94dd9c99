"""Blender, as a module of Python, imports files with textures: textures_blender.py FILE…

Printed is one JSON object: for each file its materials whose node tree has pictures, with the size of each picture.
"""

import json
import sys
from pathlib import Path

import bpy

told = {}
for path in sys.argv[1:]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    ending = Path(path).suffix
    if ending == ".glb":
        bpy.ops.import_scene.gltf(filepath=path)
    elif ending == ".obj":
        bpy.ops.wm.obj_import(filepath=path)
    else:
        bpy.ops.wm.usd_import(filepath=path, import_textures_mode="IMPORT_PACK")
    used = {slot.material.name for object in bpy.data.objects for slot in object.material_slots if slot.material}
    found = {}
    for material in bpy.data.materials:
        if material.name not in used or not material.node_tree:
            continue
        images = [node.image for node in material.node_tree.nodes if node.type == "TEX_IMAGE" and node.image]
        if images:
            found[material.name] = sorted(list(image.size) for image in images)
    told[Path(path).name] = found
print(json.dumps(told))
