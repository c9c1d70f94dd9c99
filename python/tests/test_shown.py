"""Meshes as arrays, pictures, pages, and the verbs that run as programs."""

import doctest
import importlib
import struct
import tempfile
import unittest
from pathlib import Path

import numpy
import plyfile

import phytomer as ph


class Meshes(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.coffee = ph.grow("coffee", plants=2, seed=7)

    def test_the_arrays_are_those_of_the_file(self) -> None:
        mesh = self.coffee.plant(1).mesh(age=24)
        self.assertEqual((mesh.points.shape[1], mesh.points.dtype), (3, numpy.float32))
        self.assertEqual((mesh.faces.shape[1], mesh.faces.dtype), (3, numpy.int32))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "second.ply")
            scenario = Path(folder, "run")
            ph.grow("coffee", plants=2, seed=7, out=scenario)
            ph.write_mesh(scenario, path, plant=1, age=24)
            file = plyfile.PlyData.read(path)
        vertices = file["vertex"]
        columns = {"points": mesh.points, **mesh.attributes}
        for column, names in {
            "points": "x y z",
            "normal": "nx ny nz",
            "colour": "red green blue alpha",
            "texture": "s t",
            "birth_age": "birth_age",
            "death_age": "death_age",
            "component_id": "component_id",
            "kind": "kind",
        }.items():
            written = numpy.column_stack([vertices[name] for name in names.split()])
            numpy.testing.assert_array_equal(columns[column].reshape(written.shape), written, column)
        numpy.testing.assert_array_equal(mesh.faces, numpy.stack(file["face"]["vertex_indices"]))

    def test_arrays_lie_where_the_mesh_does_and_outlive_it(self) -> None:
        mesh = self.coffee.plant(0).mesh(age=12)
        points, again = mesh.points, mesh.points
        self.assertTrue(numpy.shares_memory(points, again))
        self.assertFalse(points.flags.writeable)
        before = points.sum()
        del mesh, again
        self.assertEqual(points.sum(), before)

    def test_attributes_tell_the_components(self) -> None:
        attributes = self.coffee.plant(0).mesh(age=24).attributes
        self.assertEqual({len(column) for column in attributes.values()}, {len(attributes["kind"])})
        self.assertTrue((attributes["birth_age"] <= 24).all() and (attributes["death_age"] > 24).all())
        numpy.testing.assert_allclose(numpy.linalg.norm(attributes["normal"], axis=1), 1, atol=1e-3)

    def test_a_tolerance_gives_fewer_triangles(self) -> None:
        plant = self.coffee.plant(0)
        self.assertLess(len(plant.mesh(age=48, tolerance_m=0.002).faces), len(plant.mesh(age=48).faces) / 2)

    def test_wrong_arguments_are_told(self) -> None:
        for options in ({"age": 999}, {"sides": 2}, {"tolerance_m": -1.0}, {"age": float("nan")}):
            with self.subTest(options), self.assertRaises(ValueError):
                self.coffee.plant(0).mesh(**options)


class Shown(unittest.TestCase):
    def test_pictures_have_their_size(self) -> None:
        for picture in (
            ph.picture("willow", age=12, size=(160, 120)),
            ph.picture({"name": "x", "species": "coffee", "plants": 2, "ages": {"until": 24}}, plant=[0, 1], size=(160, 120)),
            ph.grow("coffee", plants=1).plant(0).picture(age=[12, 24], size=(160, 120), view="front"),
        ):
            self.assertEqual(struct.unpack(">II", picture.png[16:24]), (160, 120))
            self.assertEqual(picture._repr_png_(), picture.png)
        with self.assertRaisesRegex(ValueError, "oblique"):
            ph.picture("willow", view="below")

    def test_a_species_by_itself_lives_as_long_as_it_is_asked_for(self) -> None:
        self.assertTrue(ph.picture("fir", age=3, size=(64, 64)).png)

    def test_a_page_of_a_life(self) -> None:
        run = ph.grow({"name": "x", "species": "coffee", "plants": 1, "ages": {"until": 12}})
        page = run.show(plant=0)
        self.assertIn("<html", page.html)
        self.assertIn("iframe", page._repr_html_())
        with self.assertRaises(ValueError):
            run.show(plant=1)


class Verbs(unittest.TestCase):
    def test_verbs_tell_what_they_find(self) -> None:
        self.assertEqual(ph.describe("coffee")["scenario"]["species"], "coffee")
        self.assertIn("coffee", [scenario["name"] for scenario in ph.list_shipped()["scenarios"]])
        self.assertIn("phytomer grow", ph.run_verb("help"))

    def test_failures_of_verbs_are_exceptions(self) -> None:
        with self.assertRaises(ph.ScenarioError) as raised:
            ph.describe("cofee")
        self.assertIn("coffee", str(raised.exception) + str(raised.exception.faults))
        with self.assertRaises(ValueError):
            ph.describe("coffee", no_such_option=True)

    def test_docstrings_hold(self) -> None:
        for name in ("phytomer", "phytomer._shown", "phytomer._verbs", "phytomer._errors"):
            failed, _ = doctest.testmod(importlib.import_module(name))
            self.assertEqual(failed, 0, name)


if __name__ == "__main__":
    unittest.main()
