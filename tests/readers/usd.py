"""OpenUSD reads files of USD: usd.py RUN FOLDER AGE...

In the folder stand `still.usda`, `still.usdc`, `still.usdz` at the last age, `life.usdc` with instances, `merged.usdc` with
merged organs, and `AGE.ply` at each age. The validators of OpenUSD report nothing; text, binary and package are the same
layer; at each age there are as many organs as `records` has, and every vertex of an organ is where the PLY file has it.
The organs of each age, by their component numbers, are told on the last line for other readers.
"""

import json
import sys
from pathlib import Path

import numpy
import plyfile
import pyarrow.compute
import pyarrow.parquet
import trimesh
from pxr import Sdf, Usd, UsdGeom

run, folder, ages = Path(sys.argv[1]), Path(sys.argv[2]), [int(age) for age in sys.argv[3:]]
# Half of the last place of a rotation in half precision, over the reach of a leaf, and the tolerance of a life.
NEAR = 2e-3


def validate(path):
    stage = Usd.Stage.Open(str(path))
    try:
        from pxr import UsdValidation
    except ImportError:  # before 25
        from pxr import UsdUtils

        checker = UsdUtils.ComplianceChecker()
        checker.CheckCompliance(str(path))
        told = checker.GetErrors() + checker.GetFailedChecks() + checker.GetWarnings()
    else:
        validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
        assert len(validators) > 20, validators
        told = [error.GetMessage() for error in UsdValidation.ValidationContext(validators).Validate(stage)]
    assert not told, (path, told)
    assert UsdGeom.GetStageUpAxis(stage) == "Z" and UsdGeom.GetStageMetersPerUnit(stage) == 1
    assert stage.GetDefaultPrim().GetPath() == "/plant"
    return stage


def organs_of(age):
    """The component numbers of the organs of an age in `records`."""
    table = pyarrow.parquet.read_table(run / "records", columns=["plant_id", "age", "component_id", "kind"])
    kind = pyarrow.compute.cast(table["kind"], "string")
    columns = [table["plant_id"], table["age"], kind, table["component_id"]]
    rows = zip(*(column.to_pylist() for column in columns))
    wood_or_bud = ("internode", "bud")
    return sorted(number for plant, at, of, number in rows if (plant, at) == (0, age) and not of.endswith(wood_or_bud))


def ply_of(age):
    """The vertices of each component of the PLY file of an age, and its mesh."""
    ply = plyfile.PlyData.read(str(folder / f"{age}.ply"))
    vertex = ply["vertex"].data
    points = numpy.column_stack([vertex["x"], vertex["y"], vertex["z"]])
    faces = numpy.vstack(ply["face"].data["vertex_indices"])
    return points, faces, vertex["component_id"]


def instances(stage, time):
    """The vertices of each instance with a size, by its id."""
    instancer = UsdGeom.PointInstancer(stage.GetPrimAtPath("/plant/organs"))
    models = [UsdGeom.Mesh(stage.GetPrimAtPath(path)) for path in instancer.GetPrototypesRel().GetTargets()]
    points = [numpy.array(model.GetPointsAttr().Get()) for model in models]
    places = instancer.GetProtoIndicesAttr().Get(time)
    scales = numpy.array(instancer.GetScalesAttr().Get(time))
    ids = instancer.GetIdsAttr().Get(time)
    matrices = instancer.ComputeInstanceTransformsAtTime(time, time)
    assert len(ids) == len(places) == len(scales) == len(matrices)
    found = {}
    for number, place, scale, matrix in zip(ids, places, scales, matrices):
        if scale.max() > 1e-7:
            matrix = numpy.array(matrix)
            found[int(number)] = points[place] @ matrix[:3, :3] + matrix[3, :3]
    return found


def merged(stage, time):
    """The vertices of each component of the mesh of organs that is more than a point."""
    mesh = stage.GetPrimAtPath("/plant/organs")
    points = numpy.array(UsdGeom.Mesh(mesh).GetPointsAttr().Get(time))
    numbers = numpy.array(mesh.GetAttribute("primvars:component_id").Get(time))
    assert len(points) == len(numbers)
    found = {int(number): points[numbers == number] for number in numpy.unique(numbers)}
    return {number: of for number, of in found.items() if numpy.ptp(of, axis=0).max() > 1e-6}


def check_organs(found, age):
    points, _, numbers = ply_of(age)
    assert sorted(found) == organs_of(age), f"{len(found)} organs at {age}, {len(organs_of(age))} in records"
    off = 0.0
    for number, of in found.items():
        expected = points[numbers == number]
        assert len(of) == len(expected), (age, number)
        off = max(off, numpy.abs(of - expected).max())
    assert off < NEAR, f"an organ at {age} is {off} m off"
    return off


def check_wood(stage, age, within):
    """How far the wood of PLY is from that of USD."""
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/plant/wood"))
    points = numpy.array(mesh.GetPointsAttr().Get(age))
    counts = numpy.array(mesh.GetFaceVertexCountsAttr().Get(age))
    corners = numpy.array(mesh.GetFaceVertexIndicesAttr().Get(age))
    assert corners.max() < len(points) and counts.sum() == len(corners)
    for name in ("component_id", "birth_age", "death_age"):
        primvar = mesh.GetPrim().GetAttribute(f"primvars:{name}")
        assert primvar.GetTypeName() == Sdf.ValueTypeNames.IntArray and len(primvar.Get(age)) == len(points)
    colours = UsdGeom.Primvar(mesh.GetPrim().GetAttribute("primvars:displayColor")).ComputeFlattened(age)
    assert len(colours) == len(points)
    firsts = numpy.cumsum(counts) - counts
    fans = [
        [corners[first], corners[first + k], corners[first + k + 1]]
        for first, count in zip(firsts, counts)
        for k in range(1, count - 1)
    ]
    surface = trimesh.Trimesh(points, fans, process=False)
    ply, _, numbers = ply_of(age)
    wood = ply[~numpy.isin(numbers, organs_of(age))]
    _, apart, _ = trimesh.proximity.closest_point(surface, wood[:: max(1, len(wood) // 1500)])
    assert apart.max() < within, f"wood at {age} is {apart.max()} m off"
    return apart.max()


still = validate(folder / "still.usda")
text = still.GetRootLayer().ExportToString()
for ending in ("usdc", "usdz"):
    other = validate(folder / f"still.{ending}")
    layer = other.GetRootLayer()
    if ending == "usdz":
        package = Sdf.Layer.FindOrOpen(f"{folder / 'still.usdz'}[plant.usdc]")
        assert package.ExportToString() == text
    else:
        assert layer.ExportToString() == text, ending
last = ages[-1]
print("still", check_organs(instances(still, Usd.TimeCode.Default()), last))
wood = still.GetPrimAtPath("/plant/wood").GetAttribute("points").Get()
assert len(wood) == (~numpy.isin(ply_of(last)[2], organs_of(last))).sum()

life, one_mesh = validate(folder / "life.usdc"), validate(folder / "merged.usdc")
assert (life.GetStartTimeCode(), life.GetEndTimeCode()) == (ages[0], last)
for age in ages:
    off = check_organs(instances(life, age), age), check_organs(merged(one_mesh, age), age)
    print(age, off, check_wood(life, age, NEAR))
# Between two ages every part is between its two places: nothing jumps.
early, late = instances(life, ages[2]), instances(life, ages[2] + 0.25)
moved = max(numpy.abs(late[number] - of).max() for number, of in early.items() if number in late)
assert moved < 0.5, f"a leaf moves by {moved} m in a quarter of a tick"
print(json.dumps({age: organs_of(age) for age in ages}))
