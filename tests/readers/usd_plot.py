"""OpenUSD reads the life of a plot: usd_plot.py RUN LIFE MERGED TICK...

LIFE has instances, MERGED merged organs. The validators of OpenUSD report nothing; at each tick there are as many organs as
`records` has of all plants, by plant and component number; no ring of the wood was born later than the next tick; the obstacle
stands still. Every organ is where the merged mesh has it.
"""

import sys
from pathlib import Path

import numpy
import pyarrow.compute
import pyarrow.parquet
from pxr import Usd, UsdGeom

# Half of the last place of a rotation in half precision, over the reach of a leaf.
NEAR = 6e-4
run, paths, ticks = Path(sys.argv[1]), sys.argv[2:4], [int(tick) for tick in sys.argv[4:]]


def stage_of(path):
    stage = Usd.Stage.Open(path)
    try:
        from pxr import UsdValidation
    except ImportError:  # before 25
        from pxr import UsdUtils

        checker = UsdUtils.ComplianceChecker()
        checker.CheckCompliance(path)
        told = checker.GetErrors() + checker.GetFailedChecks() + checker.GetWarnings()
    else:
        validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
        told = [error.GetMessage() for error in UsdValidation.ValidationContext(validators).Validate(stage)]
    assert not told, (path, told)
    return stage


def organs_of(tick):
    """Plant and component number of each organ of a tick in `records`."""
    table = pyarrow.parquet.read_table(run / "records", columns=["plant_id", "tick", "component_id", "kind"])
    kind = pyarrow.compute.cast(table["kind"], "string")
    columns = [table["plant_id"], table["tick"], table["component_id"], kind]
    rows = zip(*(column.to_pylist() for column in columns))
    return sorted((plant, number) for plant, at, number, of in rows if at == tick and not of.endswith(("internode", "bud")))


def instances(stage, tick):
    """The vertices of each instance with a size, by plant and component number, in the order of the file."""
    instancer = UsdGeom.PointInstancer(stage.GetPrimAtPath("/plant/organs"))
    models = [UsdGeom.Mesh(stage.GetPrimAtPath(path)) for path in instancer.GetPrototypesRel().GetTargets()]
    points = [numpy.array(model.GetPointsAttr().Get()) for model in models]
    scales = numpy.array(instancer.GetScalesAttr().Get(tick))
    columns = instancer.GetIdsAttr().Get(tick), scales, instancer.GetProtoIndicesAttr().Get(tick)
    matrices = instancer.ComputeInstanceTransformsAtTime(tick, tick)
    found = {}
    for id, scale, model, matrix in zip(*columns, matrices, strict=True):
        if scale.max() > 1e-7:
            matrix = numpy.array(matrix)
            found[int(id) >> 32, int(id) & 0xFFFFFFFF] = points[model] @ matrix[:3, :3] + matrix[3, :3]
    return found


def merged(stage, tick):
    """The vertices of the merged organs that are more than a point."""
    mesh = stage.GetPrimAtPath("/plant/organs")
    points = numpy.array(UsdGeom.Mesh(mesh).GetPointsAttr().Get(tick))
    numbers = numpy.array(mesh.GetAttribute("primvars:component_id").Get(tick))
    # Organs of two plants may have one number, but never stand side by side in the mesh: plants follow one another.
    starts = numpy.flatnonzero(numpy.diff(numbers, prepend=-1))
    parts = numpy.split(points, starts[1:])
    return [part for part in parts if numpy.ptp(part, axis=0).max() > 1e-6]


life, one_mesh = map(stage_of, paths)
stones = [UsdGeom.Mesh(stage.GetPrimAtPath("/plant/obstacles")).GetPointsAttr().Get() for stage in (life, one_mesh)]
assert len(stones[0]) > 3 and stones[0] == stones[1]
for tick in ticks:
    expected, found, meshes = organs_of(tick), instances(life, tick), merged(one_mesh, tick)
    assert sorted(found) == expected, f"{len(found)} organs at {tick}, {len(expected)} in records"
    assert len(meshes) == len(expected), f"{len(meshes)} merged organs at {tick}, {len(expected)} in records"
    off = max(numpy.abs(instance - part).max() for instance, part in zip(found.values(), meshes, strict=True))
    assert off < NEAR, f"an instance at {tick} is {off} m from the merged organ"
    wood = life.GetPrimAtPath("/plant/wood")
    births, deaths = (numpy.array(wood.GetAttribute(f"primvars:{name}_age").Get(tick)) for name in ("birth", "death"))
    # What comes by the next tick waits in the topology of this one.
    assert births.min() >= 0 and (births < deaths).all() and births.max() <= tick + 1
    print(tick, len(expected), "organs of", len({plant for plant, _ in expected}), "plants")
assert len({plant for plant, _ in organs_of(ticks[-1])}) == 3
