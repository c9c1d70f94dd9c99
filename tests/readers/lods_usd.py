"""OpenUSD reads levels of detail: lods_usd.py FACES… -- FILE…

Each file has a set of variants `lod` on its default prim, of which `lod0` is chosen; with each variant the triangles of
its meshes and of its instances are those that are stated. All validators find nothing. The text and the binary files
say the same, prim by prim.
"""

import sys

from pxr import Sdf, Usd, UsdGeom, UsdValidation

break_at = sys.argv.index("--")
stated, paths = [int(count) for count in sys.argv[1:break_at]], sys.argv[break_at + 1 :]


def triangles(mesh):
    counts = UsdGeom.Mesh(mesh).GetFaceVertexCountsAttr().Get()
    assert set(counts) <= {3}
    indices = UsdGeom.Mesh(mesh).GetFaceVertexIndicesAttr().Get()
    assert len(indices) == 3 * len(counts) and max(indices) < len(UsdGeom.Mesh(mesh).GetPointsAttr().Get())
    return len(counts)


def faces(stage):
    total, prims = 0, iter(Usd.PrimRange(stage.GetDefaultPrim()))
    for prim in prims:
        if prim.IsA(UsdGeom.PointInstancer):
            instancer = UsdGeom.PointInstancer(prim)
            models = [stage.GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetTargets()]
            of_models = [sum(triangles(mesh) for mesh in Usd.PrimRange(model) if mesh.IsA(UsdGeom.Mesh)) for model in models]
            total += sum(of_models[place] for place in instancer.GetProtoIndicesAttr().Get())
            prims.PruneChildren()
        elif prim.IsA(UsdGeom.Mesh):
            total += triangles(prim)
    return total


def said(path):
    """What a layer says, spec by spec."""
    layer, told = Sdf.Layer.FindOrOpen(path), {}

    def see(at):
        spec = layer.GetObjectAtPath(at)
        keys = [key for key in spec.ListInfoKeys()] if spec else []
        told[str(at)] = {key: str(spec.GetInfo(key)) for key in sorted(keys)}

    layer.Traverse(Sdf.Path.absoluteRootPath, see)
    return told


for path in paths:
    stage = Usd.Stage.Open(path)
    sets = stage.GetDefaultPrim().GetVariantSets()
    assert sets.GetNames() == ["lod"], sets.GetNames()
    levels = sets.GetVariantSet("lod")
    assert levels.GetVariantNames() == [f"lod{number}" for number in range(len(stated))]
    assert levels.GetVariantSelection() == "lod0"
    found = []
    for name in levels.GetVariantNames():
        assert levels.SetVariantSelection(name)
        found.append(faces(stage))
        validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
        errors = UsdValidation.ValidationContext(validators).Validate(stage)
        assert not errors, [(error.GetName(), error.GetMessage()) for error in errors]
    assert found == stated, (path, found, stated)
    print(path, found)
layers = [said(path) for path in paths if not path.endswith(".usdz")]
assert len(layers) < 2 or all(layer == layers[0] for layer in layers), [len(layer) for layer in layers]
