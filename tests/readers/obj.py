"""Reads an OBJ file with trimesh and with Open3D, and tells of each its triangles, its area and its box as one JSON object."""

import json
import sys

import open3d
import trimesh


def main(path):
    scene = trimesh.load(path, split_object=True, group_material=False)
    mesh = scene.to_geometry() if hasattr(scene, "to_geometry") else scene
    other = open3d.io.read_triangle_mesh(path)
    told = {
        "trimesh": {
            "triangles": len(mesh.faces),
            "area": float(mesh.area),
            "low": mesh.bounds[0].tolist(),
            "high": mesh.bounds[1].tolist(),
        },
        "open3d": {
            "triangles": len(other.triangles),
            "area": other.get_surface_area(),
            "low": other.get_min_bound().tolist(),
            "high": other.get_max_bound().tolist(),
        },
    }
    print(json.dumps(told))


main(sys.argv[1])
