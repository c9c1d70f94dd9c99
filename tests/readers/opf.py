"""Reads an OPF file with nothing but an XML parser, and tells what is in it as one JSON object.

Written from the descriptions of the format alone: a matrix a component, in centimetres; widths at base and tip by which
a reference mesh is tapered along x. Tells the number of entities of each class and of each kind of link, the sums of
the attributes Length and Area, and the box around all that is drawn, in metres.
"""

import collections
import json
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np


def numbers(element):
    return np.array([float(word) for word in element.text.split()])


def main(path):
    root = ElementTree.parse(path).getroot()
    meshes, shapes = {}, {}
    for mesh in root.find("meshBDD"):
        meshes[mesh.get("Id")] = numbers(mesh.find("points")).reshape(-1, 3)
        faces = [[int(word) for word in face.text.split()] for face in mesh.find("faces")]
        assert max(max(face) for face in faces) < len(meshes[mesh.get("Id")])
    for shape in root.find("shapeBDD"):
        shapes[shape.get("Id")] = meshes[shape.find("meshIndex").text.strip()]
    declared = {attribute.get("name") for attribute in root.find("attributeBDD")}
    classes, links, sums = collections.Counter(), collections.Counter(), collections.Counter()
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    ids = set()
    for element in root.find("topology").iter():
        if element.tag not in ("topology", "decomp", "follow", "branch"):
            continue
        assert element.get("id") not in ids, "an id stands twice"
        ids.add(element.get("id"))
        classes[element.get("class")] += 1
        links[element.tag] += 1
        for part in element:
            if part.tag in declared and part.tag in ("Length", "Area"):
                sums[part.tag] += float(part.text)
        geometry = element.find("geometry")
        if geometry is None or geometry.find("shapeIndex") is None:
            continue
        matrix = numbers(geometry.find("mat")).reshape(3, 4)
        points = shapes[geometry.find("shapeIndex").text.strip()].copy()
        down, up = float(geometry.find("dDwn").text), float(geometry.find("dUp").text)
        along = points[:, 0]
        share = (along - along.min()) / (along.max() - along.min())
        points[:, 1:] *= (down + (up - down) * share)[:, None]
        placed = points @ matrix[:, :3].T + matrix[:, 3]
        low, high = np.minimum(low, placed.min(axis=0)), np.maximum(high, placed.max(axis=0))
    told = {"classes": classes, "links": links, "sums": sums, "low": list(low / 100), "high": list(high / 100)}
    print(json.dumps(told))


main(sys.argv[1])
