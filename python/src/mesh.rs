//! The mesh of a plant as arrays: vertices with their attributes, and triangles.
//!
//! Arrays are read in place: a `Column` tells numpy the address and the shape of its numbers by
//! `__array_interface__`, and numpy keeps the column alive for as long as an array shows it. Nothing changes a column
//! after it is made, and the arrays cannot be written. Absent: files, which `phytomer.write_mesh` writes.

use phytomer::outputs::meshes::{Chunk, Face, Scene, Vertex};
use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::io;

/// The numbers of a column, row after row.
enum Numbers {
    Real(Vec<f32>),
    Whole(Vec<i32>),
    Bytes(Vec<u8>),
}

/// An array of `width` numbers a row.
#[pyclass(frozen, module = "phytomer")]
pub struct Column {
    numbers: Numbers,
    width: usize,
}

impl Column {
    /// How many numbers there are, the address of the first, and how numpy writes their type.
    fn told(&self) -> (usize, usize, &'static str) {
        match &self.numbers {
            Numbers::Real(numbers) => (numbers.len(), numbers.as_ptr().addr(), "<f4"),
            Numbers::Whole(numbers) => (numbers.len(), numbers.as_ptr().addr(), "<i4"),
            Numbers::Bytes(numbers) => (numbers.len(), numbers.as_ptr().addr(), "|u1"),
        }
    }
}

#[pymethods]
impl Column {
    /// Where the numbers are and how they lie (numpy's array interface, version 3); they cannot be written.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (count, address, numbers) = self.told();
        let told = PyDict::new(py);
        told.set_item("version", 3)?;
        told.set_item("typestr", numbers)?;
        told.set_item("data", (address, true))?;
        let rows = count / self.width;
        let shape = if self.width == 1 { PyTuple::new(py, [rows])? } else { PyTuple::new(py, [rows, self.width])? };
        told.set_item("shape", shape)?;
        Ok(told)
    }
}

/// The mesh of one plant at one age, metres from the foot of the plant, Z up.
#[pyclass(frozen, module = "phytomer")]
pub struct Mesh {
    points: Py<Column>,
    normals: Py<Column>,
    colours: Py<Column>,
    texture: Py<Column>,
    births: Py<Column>,
    deaths: Py<Column>,
    components: Py<Column>,
    kinds: Py<Column>,
    faces: Py<Column>,
}

/// The columns of a mesh while they are filled.
#[derive(Default)]
pub struct Drawn {
    points: Vec<f32>,
    normals: Vec<f32>,
    colours: Vec<u8>,
    texture: Vec<f32>,
    births: Vec<f32>,
    deaths: Vec<f32>,
    components: Vec<i32>,
    kinds: Vec<u8>,
    faces: Vec<i32>,
}

impl Drawn {
    /// All of a scene.
    ///
    /// # Errors
    /// None of its own: the scene writes to memory.
    pub fn of(scene: &Scene) -> io::Result<Self> {
        let (mut drawn, mut chunk) = (Self::default(), Chunk::new());
        let mut take = |chunk: &mut Chunk| {
            chunk.filled_mut::<Vertex>().iter().for_each(|vertex| drawn.add(vertex));
            chunk.clear();
            Ok(())
        };
        scene.vertices(&mut chunk, &mut take)?;
        take(&mut chunk)?;
        let mut take = |chunk: &mut Chunk| {
            let corners = chunk.filled_mut::<Face>().iter().flat_map(|face| face.indices().map(|index| index as i32));
            drawn.faces.extend(corners);
            chunk.clear();
            Ok(())
        };
        scene.faces(&mut chunk, &mut take)?;
        take(&mut chunk)?;
        Ok(drawn)
    }

    fn add(&mut self, vertex: &Vertex) {
        let tag = vertex.tag();
        self.points.extend(vertex.position());
        self.normals.extend(vertex.normal());
        self.colours.extend(tag.colour);
        self.texture.extend(vertex.texture());
        self.births.push(tag.birth);
        self.deaths.push(tag.death);
        self.components.push(tag.component);
        self.kinds.push(tag.kind);
    }

    /// The mesh of Python.
    pub fn mesh(self, py: Python<'_>) -> PyResult<Mesh> {
        let column = |numbers, width| Py::new(py, Column { numbers, width });
        Ok(Mesh {
            points: column(Numbers::Real(self.points), 3)?,
            normals: column(Numbers::Real(self.normals), 3)?,
            colours: column(Numbers::Bytes(self.colours), 4)?,
            texture: column(Numbers::Real(self.texture), 2)?,
            births: column(Numbers::Real(self.births), 1)?,
            deaths: column(Numbers::Real(self.deaths), 1)?,
            components: column(Numbers::Whole(self.components), 1)?,
            kinds: column(Numbers::Bytes(self.kinds), 1)?,
            faces: column(Numbers::Whole(self.faces), 3)?,
        })
    }
}

/// A column as an array of numpy.
fn array<'py>(py: Python<'py>, column: &Py<Column>) -> PyResult<Bound<'py, PyAny>> {
    let numpy = py
        .import("numpy")
        .map_err(|_| PyImportError::new_err("the arrays of a mesh need numpy: `pip install numpy`"))?;
    numpy.call_method1("asarray", (column,))
}

#[pymethods]
impl Mesh {
    /// The vertices: (n, 3) float32, metres.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        array(py, &self.points)
    }

    /// The triangles: (m, 3) int32, counterclockwise from outside.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        array(py, &self.faces)
    }

    /// The attributes of the vertices by their names, each an array with a row a vertex: `normal` (3), `colour` (4,
    /// red, green, blue and opacity, 0 to 255), `texture` (2), `birth_age`, `death_age` (ticks; inf while it lives),
    /// `component_id`, `kind`.
    #[getter]
    fn attributes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        all.set_item("normal", array(py, &self.normals)?)?;
        all.set_item("colour", array(py, &self.colours)?)?;
        all.set_item("texture", array(py, &self.texture)?)?;
        all.set_item("birth_age", array(py, &self.births)?)?;
        all.set_item("death_age", array(py, &self.deaths)?)?;
        all.set_item("component_id", array(py, &self.components)?)?;
        all.set_item("kind", array(py, &self.kinds)?)?;
        Ok(all)
    }

    fn __repr__(&self) -> String {
        let rows = |column: &Py<Column>| column.get().told().0 / column.get().width;
        format!("<phytomer.Mesh: {} vertices, {} triangles>", rows(&self.points), rows(&self.faces))
    }
}
