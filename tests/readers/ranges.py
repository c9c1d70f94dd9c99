"""OpenUSD, or Blender as a module of Python, reads the ranges of a tree of stems: ranges.py FOLDER

In the folder stand `whole.ply` and, of the same tree, `whole.usda` and `whole.usdc` with instances, and `merged.usdc` with merged
organs. Each vertex, and each instance, has the `until_m` that the PLY file has for its component. The PLY file is read here
by hand, since Blender's environment has no reader of it.
"""

import re
import sys
from pathlib import Path

import numpy

folder = Path(sys.argv[1])
TYPES = {"float": "<f4", "int": "<i4", "uchar": "u1"}


def ranges():
    """The range of each component of the PLY file."""
    data = (folder / "whole.ply").read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode("ascii")
    count = int(re.search(r"element vertex (\d+)", header)[1])
    properties = re.findall(r"^property (float|int|uchar) (\w+)$", header, re.MULTILINE)
    vertex = numpy.dtype([(name, TYPES[of]) for of, name in properties])
    vertices = numpy.frombuffer(data, vertex, count, end)
    found = dict(zip(vertices["component_id"].tolist(), vertices["until_m"].tolist()))
    assert (vertices["until_m"] == [found[number] for number in vertices["component_id"].tolist()]).all()
    return found


def check(what, numbers, until):
    """That each component has its range; returns how many there are."""
    assert len(numbers) == len(until) > 0, (what, len(numbers), len(until))
    expected = numpy.array([wanted[number] for number in numbers], dtype=numpy.float32)
    assert (numpy.asarray(until, dtype=numpy.float32) == expected).all(), what
    return len(set(numbers))


def openusd(path, merged):
    stage = Usd.Stage.Open(str(path))
    count = 0
    for name in ("wood", "organs") if merged else ("wood",):
        prim = stage.GetPrimAtPath(f"/plant/{name}")
        of = UsdGeom.PrimvarsAPI(prim)
        assert of.GetPrimvar("until_m").GetInterpolation() == "vertex"
        count += check(name, list(of.GetPrimvar("component_id").Get()), of.GetPrimvar("until_m").Get())
    if not merged:
        organs = UsdGeom.PointInstancer(stage.GetPrimAtPath("/plant/organs"))
        until = UsdGeom.PrimvarsAPI(organs).GetPrimvar("until_m").Get()
        count += check("instances", list(organs.GetIdsAttr().Get()), until)
    return count


def blender(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=str(path))
    count = 0
    for name in ("wood", "organs"):
        attributes = bpy.data.objects[name].data.attributes
        numbers = numpy.zeros(len(attributes["component_id"].data), dtype=numpy.int32)
        attributes["component_id"].data.foreach_get("value", numbers)
        until = numpy.zeros(len(attributes["until_m"].data), dtype=numpy.float32)
        attributes["until_m"].data.foreach_get("value", until)
        count += check(name, numbers.tolist(), until)
    return count


wanted = ranges()
try:
    import bpy
except ImportError:
    from pxr import Usd, UsdGeom

    counts = [openusd(folder / name, name == "merged.usdc") for name in ("whole.usda", "whole.usdc", "merged.usdc")]
else:
    counts = [blender(folder / "merged.usdc")]
assert counts == [len(wanted)] * len(counts), (counts, len(wanted))
