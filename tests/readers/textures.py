"""Reads the textures of USD and OBJ files by readers that know nothing of phytomer: textures.py FILE…

USD by OpenUSD, whose validators find nothing: every picture of a material is found from the layer and has its size by Pillow. OBJ by trimesh and by Open3D. Printed is one JSON object: for each file its materials with pictures,
with the size of their colours and of their relief, and how many faces have them.
"""

import io
import json
import sys
from pathlib import Path

from PIL import Image


def of_usd(path):
    from pxr import Ar, Usd, UsdGeom, UsdShade, UsdValidation

    stage = Usd.Stage.Open(path)
    resolver = Ar.GetResolver()
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    errors = UsdValidation.ValidationContext(validators).Validate(stage)
    assert not errors, [(error.GetName(), error.GetMessage()) for error in errors]
    found = {}
    for prim in stage.Traverse():
        if prim.GetTypeName() != "Material":
            continue
        told = {}
        for shader in (UsdShade.Shader(child) for child in prim.GetChildren()):
            if shader.GetIdAttr().Get() != "UsdUVTexture":
                continue
            asset = shader.GetInput("file").Get()
            assert asset.resolvedPath, (path, asset)
            opened = resolver.OpenAsset(Ar.ResolvedPath(asset.resolvedPath))
            image = Image.open(io.BytesIO(bytes(opened.GetBuffer())))
            image.load()
            told[shader.GetPrim().GetName()] = list(image.size)
            told["repeats"] = shader.GetInput("wrapS").Get() == "repeat"
            assert shader.GetInput("st").HasConnectedSource()
        if told:
            surface = UsdShade.Shader(prim.GetChild("surface"))
            assert surface.GetInput("diffuseColor").GetConnectedSources()[0][0].source.GetPrim().GetName() == "texture"
            told["cut"] = surface.GetInput("opacityThreshold").Get() if surface.GetInput("opacity") else None
            found[prim.GetName()] = {**told, "faces": 0}
    for prim in stage.Traverse():
        bound, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        name = bound.GetPrim().GetName() if bound else None
        if name not in found:
            continue
        if prim.IsA(UsdGeom.Subset):
            found[name]["faces"] += len(UsdGeom.Subset(prim).GetIndicesAttr().Get())
        elif prim.IsA(UsdGeom.Mesh) and not [child for child in prim.GetChildren() if child.IsA(UsdGeom.Subset)]:
            mesh, st = UsdGeom.Mesh(prim), UsdGeom.PrimvarsAPI(prim).GetPrimvar("st")
            found[name]["faces"] += len(mesh.GetFaceVertexCountsAttr().Get(stage.GetEndTimeCode()))
            # Each corner of a face, or each vertex, has a place on the picture at all times.
            of = {"faceVarying": mesh.GetFaceVertexIndicesAttr(), "vertex": mesh.GetPointsAttr()}[st.GetInterpolation()]
            for time in st.GetAttr().GetTimeSamples() or [stage.GetEndTimeCode()]:
                assert len(st.Get(time)) == len(of.Get(time)), (path, name, time)
            around = max((place[0] for place in st.Get(stage.GetEndTimeCode())), default=0)
            found[name]["around"] = max(around, found[name].get("around", 0))
    return found


def of_obj(path):
    import numpy
    import open3d
    import trimesh

    scene = trimesh.load(path, split_object=False, group_material=True)
    meshes = scene.geometry.values() if hasattr(scene, "geometry") else [scene]
    found = {}
    for mesh in meshes:
        material = mesh.visual.material
        if getattr(material, "image", None) is not None:
            low, high = mesh.visual.uv.min(axis=0).tolist(), mesh.visual.uv.max(axis=0).tolist()
            found[material.name] = {"texture": list(material.image.size), "faces": len(mesh.faces), "uv": [low, high]}
    other = open3d.io.read_triangle_mesh(path, True)
    used = numpy.bincount(numpy.asarray(other.triangle_material_ids), minlength=len(other.textures))
    sizes = {}
    for picture, faces in zip(other.textures, used):
        if not picture.is_empty():
            high, wide = numpy.asarray(picture).shape[:2]
            sizes[f"{wide} by {high}"] = int(faces)
    for told in found.values():
        told["open3d"] = sizes.get("{} by {}".format(*told["texture"]))
    # What the library names lies beside it.
    for line in Path(path).with_suffix(".mtl").read_text(encoding="utf-8").splitlines():
        word, *rest = line.split()
        if word in ("map_Kd", "map_d", "map_Bump", "norm"):
            assert Path(path).with_name(rest[0]).is_file(), line
    return found


print(json.dumps({Path(path).name: (of_obj if path.endswith(".obj") else of_usd)(path) for path in sys.argv[1:]}))
