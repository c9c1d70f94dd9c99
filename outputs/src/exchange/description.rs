//! Plants as any format sees them: entities in several scales, with what was observed of each.
//!
//! Lengths are metres, areas square metres, ages ticks; x is east, y north, z up, as everywhere. What a file does not
//! say is `None` and is never made up. An entity stands after the one that it is borne by and after the one that it is
//! a part of: readers hold to it, and writers may rely on it. So nothing recurses. An entity takes about 150 bytes, and
//! 200 more with an observation.

use std::fmt;

/// All that a file says of plants.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Description {
    /// The plants, in the order of the file.
    pub individuals: Vec<Individual>,
    /// The classes of the entities of all plants.
    pub classes: Vec<Class>,
    /// The features by which the file tells more than this description has fields for.
    pub features: Vec<Feature>,
    /// Reference meshes.
    pub meshes: Vec<Mesh>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Meshes with their materials.
    pub shapes: Vec<Shape>,
    /// The ticks of a year, where birth and death are told in ticks of a known length.
    pub ticks_per_year: Option<f64>,
}

/// A plant, with all its entities.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Individual {
    /// What the file calls it.
    pub name: Option<String>,
    /// Its species.
    pub species: Option<String>,
    /// Its age in ticks when it was described.
    pub age: Option<u32>,
    /// How it stands in its plot.
    pub standing: Option<Standing>,
    /// Its entities; bearers and complexes stand before what they bear and what they are made of. Numbers of
    /// entities are places in this list.
    pub entities: Vec<Entity>,
}

/// How a plant stands in a plot. Places of its entities are its own: of them the world's are had by `scale`, then a
/// turn by `twist` about the z axis, then a tilt by `inclination` towards `azimuth`, then `place`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// The place of its origin in the plot, m.
    pub place: [f64; 3],
    /// By how much it is enlarged.
    pub scale: f64,
    /// The azimuth towards which it leans, radians.
    pub azimuth: f64,
    /// By how much it leans, radians.
    pub inclination: f64,
    /// Its turn about its own axis, radians.
    pub twist: f64,
}

/// A class of entities.
#[derive(Debug, Clone, PartialEq)]
pub struct Class {
    /// Its symbol in the file, such as `U` or `Metamer`.
    pub symbol: String,
    /// Its scale: a plant's is 1, that of its parts is larger. Scales may leap.
    pub scale: u32,
    /// What it is in this program's words.
    pub role: Role,
}

/// What entities of a class are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Several plants together; a plant is a part of it.
    Scene,
    /// A plant.
    Plant,
    /// An axis.
    Axis,
    /// A growth unit.
    GrowthUnit,
    /// An internode, a metamer, a segment or a cylinder of wood.
    Internode,
    /// A leaf.
    Leaf,
    /// A flower.
    Flower,
    /// A fruit.
    Fruit,
    /// None of these, or the file does not tell.
    Other,
}

impl Role {
    /// The word for the role in files that spell it out.
    pub fn word(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Plant => "plant",
            Self::Axis => "axis",
            Self::GrowthUnit => "growth_unit",
            Self::Internode => "internode",
            Self::Leaf => "leaf",
            Self::Flower => "flower",
            Self::Fruit => "fruit",
            Self::Other => "other",
        }
    }
}

/// How an entity springs from its bearer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Link {
    /// It goes on where the bearer ends (`<` in MTG).
    Follows,
    /// It branches from the bearer (`+` in MTG).
    Branches,
}

/// A part of a plant, or a whole of parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Entity {
    /// Its class, a place in [`Description::classes`].
    pub class: u32,
    /// The index after its symbol; of what this program writes it is the rank from 1: of an internode along its axis,
    /// of an axis and of organs among their like on the internode, of a growth unit along its axis.
    pub index: Option<f64>,
    /// The entity that it springs from, as finely as the file tells it: an axis mostly springs from an internode.
    /// `None` for what begins a plant, and for the first part of a complex, which springs from where that complex does
    /// ([`Individual::bearer_of`]).
    pub bearer: Option<u32>,
    /// How it springs from its bearer; `None` where it has none.
    pub link: Option<Link>,
    /// The entity of a coarser scale that it is a part of; `None` for the coarsest.
    pub complex: Option<u32>,
    /// The age of the plant at which it appeared, ticks.
    pub birth: Option<u32>,
    /// The age of the plant at which it died, ticks; `None` where it lives or the file does not tell.
    pub death: Option<u32>,
    /// Whether the file says that it is dead; `None` where it does not tell.
    pub dead: Option<bool>,
    /// How it is drawn, where the format gives a reference mesh.
    pub form: Option<Box<Form>>,
    /// What was observed of it, in the order of the dates in the file; mostly one observation, none where nothing is
    /// told.
    pub observations: Vec<Observation>,
}

/// What was observed of an entity on one date.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Observation {
    /// The date; `None` where the file has none.
    pub date: Option<Date>,
    /// Length along its direction, m.
    pub length: Option<f64>,
    /// Diameter at its base, m; of an organ its width.
    pub base_diameter: Option<f64>,
    /// Diameter at its tip, m.
    pub tip_diameter: Option<f64>,
    /// Area of one side, m².
    pub area: Option<f64>,
    /// The place of its base in the plant, m.
    pub place: Option<[f64; 3]>,
    /// The direction in which it points, a unit vector.
    pub direction: Option<[f64; 3]>,
    /// The direction of its upper side, a unit vector across `direction`.
    pub up: Option<[f64; 3]>,
    /// The features that the file tells beyond these: the place of each in [`Description::features`], rising, and its
    /// value in the file's own unit.
    pub values: Vec<(u32, Value)>,
}

/// A feature of entities that this description has no field for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feature {
    /// Its name in the file.
    pub name: String,
    /// The type that the file declares.
    pub kind: FeatureType,
}

/// The type of a feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FeatureType {
    /// Whole numbers.
    Int,
    /// Numbers.
    Real,
    /// Texts.
    Text,
    /// True or false.
    Truth,
    /// Dates.
    Date,
}

/// The value of a feature.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A whole number.
    Int(i64),
    /// A finite number.
    Real(f64),
    /// A text.
    Text(Box<str>),
    /// True or false.
    Truth(bool),
    /// A date.
    Date(Date),
}

/// A date of the Gregorian calendar, with the minute of the day where it is told. Dates are in order of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Date {
    /// The year.
    pub year: i32,
    /// The month, from 1.
    pub month: u8,
    /// The day of the month, from 1.
    pub day: u8,
    /// The minute of the day, from 0.
    pub minute: Option<u16>,
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04}-{:02}-{:02}", self.year, self.month, self.day)?;
        match self.minute {
            Some(minute) => write!(f, "T{:02}:{:02}", minute / 60, minute % 60),
            None => Ok(()),
        }
    }
}

/// How an entity is drawn: a shape, and where it is put.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    /// The shape, a place in [`Description::shapes`].
    pub shape: u32,
    /// From the shape's own coordinates to those of the plant, row by row; the last column is the translation, m.
    pub matrix: [[f64; 4]; 3],
    /// By how much the shape's width is enlarged at its base and at its tip (`dDwn` and `dUp` of OPF); `None` where it
    /// is not tapered.
    pub taper: Option<[f64; 2]>,
}

/// A mesh that entities refer to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Its name; empty where it has none.
    pub name: String,
    /// Points, m.
    pub points: Vec<[f64; 3]>,
    /// A normal a point; empty where the file has none.
    pub normals: Vec<[f64; 3]>,
    /// Texture coordinates a point; empty where the file has none.
    pub texture: Vec<[f64; 2]>,
    /// Triangles, counterclockwise from outside: places in `points`.
    pub triangles: Vec<[u32; 3]>,
}

/// A material.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Material {
    /// Its name; empty where it has none.
    pub name: String,
    /// Red, green, blue and opacity of the light that it gives off, 0 to 1.
    pub emission: [f64; 4],
    /// Of what it reflects of ambient light.
    pub ambient: [f64; 4],
    /// Of what it reflects to all sides.
    pub diffuse: [f64; 4],
    /// Of what it reflects as a mirror.
    pub specular: [f64; 4],
    /// How narrow its highlights are.
    pub shininess: f64,
}

/// A mesh with its material.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shape {
    /// Its name; empty where it has none.
    pub name: String,
    /// A place in [`Description::meshes`].
    pub mesh: u32,
    /// A place in [`Description::materials`].
    pub material: Option<u32>,
}

impl Description {
    /// The class of an entity.
    pub fn class_of(&self, entity: &Entity) -> &Class {
        &self.classes[entity.class as usize]
    }

    /// What an entity is.
    pub fn role_of(&self, entity: &Entity) -> Role {
        self.class_of(entity).role
    }

    /// The number of entities of all plants.
    pub fn entities(&self) -> usize {
        self.individuals.iter().map(|individual| individual.entities.len()).sum()
    }

    /// The place of a class, which is added where it is new. In time of the classes there are.
    pub fn class(&mut self, symbol: &str, scale: u32, role: Role) -> u32 {
        let known = self.classes.iter().position(|class| class.symbol == symbol && class.scale == scale);
        known.unwrap_or_else(|| {
            self.classes.push(Class { symbol: symbol.to_owned(), scale, role });
            self.classes.len() - 1
        }) as u32
    }

    /// The place of a feature, which is added where it is new. In time of the features there are.
    pub fn feature(&mut self, name: &str, kind: FeatureType) -> u32 {
        let known = self.features.iter().position(|feature| feature.name == name);
        known.unwrap_or_else(|| {
            self.features.push(Feature { name: name.to_owned(), kind });
            self.features.len() - 1
        }) as u32
    }
}

impl Individual {
    /// The entity that an entity springs from and how: its own bearer, else that of the complex that it begins. `None`
    /// for what begins the plant. A complex is begun by its first part alone, which has no bearer of its own.
    pub fn bearer_of(&self, entity: u32) -> Option<(u32, Link)> {
        let mut at = Some(entity);
        while let Some(place) = at {
            let known = &self.entities[place as usize];
            if let (Some(bearer), Some(link)) = (known.bearer, known.link) {
                return Some((bearer, link));
            }
            at = known.complex;
        }
        None
    }

    /// The whole of a coarser scale that an entity belongs to and for which `is` holds: itself, its complex, and so on.
    pub fn within(&self, entity: u32, is: impl Fn(&Entity) -> bool) -> Option<u32> {
        let mut at = Some(entity);
        while let Some(place) = at {
            let known = &self.entities[place as usize];
            if is(known) {
                return Some(place);
            }
            at = known.complex;
        }
        None
    }
}

impl Entity {
    /// An entity of a class of which nothing else is known.
    pub fn of(class: u32) -> Self {
        Self {
            class,
            index: None,
            bearer: None,
            link: None,
            complex: None,
            birth: None,
            death: None,
            dead: None,
            form: None,
            observations: Vec::new(),
        }
    }

    /// What was observed last, or what is told without a date; `None` where nothing is.
    pub fn latest(&self) -> Option<&Observation> {
        self.observations.last()
    }

    /// The same to be changed; made where there is none.
    pub fn latest_mut(&mut self) -> &mut Observation {
        if self.observations.is_empty() {
            // One observation is the rule: no room is left for more.
            self.observations.reserve_exact(1);
            self.observations.push(Observation::default());
        }
        let last = self.observations.len() - 1;
        &mut self.observations[last]
    }
}
