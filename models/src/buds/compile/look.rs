//! Kinds, forms and stated colours, compiled: what each order's components are and look like (de Reffye 1988 §6). The
//! parts that growth uses go into looks, the parts for drawing alone into paints.
//!
//! A value that may differ by state is spread over the states; names become numbers, colours bytes, and the law of an
//! organ's expansion a table by its own age. Absent: the defaults where nothing is stated for drawing.

use super::order_of;
use crate::buds::params::colour::{self, turning_of};
use crate::buds::params::{
    Buds, ByState, ColourText, FlowerChoice, FormChoice, FruitChoice, KindName, LeafChoice, OwnForm,
};
use crate::fault::{Fault, Path};
use crate::law::{Law, Quantity, ValueRange, Variate};
use phytomer_looks::{Colour, InternodePaint, Near, OrganPaint, Paints, Unsound, own_form};
use phytomer_sim::plant::{Class, Form, InternodeLook, Kind, Looks, OrganLook, OrganLooks, PaintNumber, Shape};

const SIDES: std::ops::RangeInclusive<u32> = 3..=64;
/// The most meshes of its own that a species may name.
const MOST_OWN: usize = 64;
/// The thickness of a blade, mm.
const THICKNESS: ValueRange = ValueRange { min: 0.001, max: 1000.0, what: "a thickness in mm" };
/// A share of an organ's full size.
const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a share of the full size" };

/// The looks of a species, and how they are drawn.
pub fn compile(buds: &Buds, until: u32, path: &Path, faults: &mut Vec<Fault>) -> (Looks, Paints) {
    let mut paints = Paints::default();
    let mut looks = Looks { states: buds.states.len().max(1), ..Looks::default() };
    if buds.meshes_of_its_own().len() > MOST_OWN {
        let found = format!("the species names {} meshes of its own", buds.meshes_of_its_own().len());
        faults.push(Fault::new(&path.key("order"), found, format!("at most {MOST_OWN}")));
    }
    for index in 0..buds.order.len() {
        let path = path.key("order").index(index);
        let mut place = Place { buds, until, index, path, paints: &mut paints, faults };
        let organs = place.organs();
        looks.internodes.extend(place.internodes());
        looks.organs.push(organs);
    }
    (looks, paints)
}

/// The number of a form: its place in the library, or among the species' own meshes.
pub fn form_of(buds: &Buds, choice: &FormChoice) -> Form {
    match choice {
        FormChoice::Named(name) => name.form(),
        FormChoice::Own(own) => {
            let place = buds.meshes_of_its_own().iter().position(|(_, mesh)| *mesh == own.mesh);
            own_form(place.and_then(|place| u8::try_from(place).ok()).unwrap_or(0))
        }
    }
}

impl Buds {
    /// The meshes that the species names as forms, each once, in the order of their numbers, with the path of the first
    /// mention from the top of the species file.
    pub(crate) fn meshes_of_its_own(&self) -> Vec<(Path, &str)> {
        let mut meshes: Vec<(Path, &str)> = Vec::new();
        for (index, order) in self.order.iter().enumerate() {
            let path = Path::root().key("order").index(index);
            let of = |key: &str| path.key(key).key("form");
            let internodes = order.internode.form.iter().flat_map(|forms| forms.places(&of("internode")));
            let organs = [("leaf", &order.leaf.form), ("flower", &order.flower.form), ("fruit", &order.fruit.form)];
            for (path, choice) in internodes.chain(organs.map(|(key, form)| (of(key), form))) {
                if let FormChoice::Own(OwnForm { mesh }) = choice
                    && meshes.iter().all(|known| known.1 != mesh)
                {
                    meshes.push((path.key("mesh"), mesh));
                }
            }
        }
        meshes
    }
}

impl Buds {
    /// Sets the area share of each leaf that is drawn with a user's mesh and states no area share: to the share of the
    /// mesh, rounded to a millionth. `share` takes the number of a mesh. Returns whether any leaf was changed.
    pub(crate) fn state_shares_of_meshes(&mut self, share: &dyn Fn(usize) -> Option<f64>) -> bool {
        let meshes: Vec<String> = self.meshes_of_its_own().into_iter().map(|(_, mesh)| mesh.to_owned()).collect();
        let mut stated = false;
        for leaf in self.order.iter_mut().map(|order| &mut order.leaf).filter(|leaf| leaf.area_share.is_none()) {
            let FormChoice::Own(OwnForm { mesh }) = &leaf.form else { continue };
            let place = meshes.iter().position(|known| known == mesh);
            if let Some(share) = place.and_then(share) {
                leaf.area_share = Some(Variate::from((share * 1e6).round() / 1e6));
                stated = true;
            }
        }
        stated
    }
}

/// Where the looks of one order are stated.
struct Place<'a> {
    buds: &'a Buds,
    until: u32,
    index: usize,
    path: Path,
    paints: &'a mut Paints,
    faults: &'a mut Vec<Fault>,
}

impl Place<'_> {
    /// The look of the internodes in each state.
    fn internodes(&mut self) -> Vec<InternodeLook> {
        let buds = self.buds;
        let internode = &buds.order[self.index].internode;
        let path = self.path.key("internode");
        let mut looks = vec![InternodeLook::of_shape(Shape::Cone); buds.states.len().max(1)];
        for (look, (shape, _)) in looks.iter_mut().zip(self.spread(&internode.shape, &path.key("shape"))) {
            look.shape = Shape::from(*shape);
        }
        for (look, (kind, path)) in looks.iter_mut().zip(self.spread(&internode.kind, &path.key("kind"))) {
            look.kind = self.kind(*kind, Class::Internode, &path);
        }
        let mut paints = self.internode_forms_and_barks(&path);
        if let Some(thickness) = &internode.thickness_mm {
            match thickness.within(&path.key("thickness_mm"), THICKNESS) {
                Ok(thickness) => looks.iter_mut().for_each(|look| look.thickness = (thickness * 0.001) as f32),
                Err(fault) => self.faults.push(fault),
            }
        }
        if let Some(sides) = &internode.sides {
            let sides = self.sides(sides, &path.key("sides"));
            paints.iter_mut().for_each(|paint| paint.sides = Some(sides));
        }
        looks.iter_mut().zip(paints).for_each(|(look, paint)| look.paint = self.paints.add_internode(paint));
        looks
    }

    /// The paint of the internodes in each state, with the forms and the colours that are stated.
    fn internode_forms_and_barks(&mut self, path: &Path) -> Vec<InternodePaint> {
        let buds = self.buds;
        let internode = &buds.order[self.index].internode;
        let mut paints = vec![InternodePaint::default(); buds.states.len().max(1)];
        if let Some(stated) = &internode.form {
            for (paint, (form, _)) in paints.iter_mut().zip(self.spread(stated, &path.key("form"))) {
                paint.form = Some(form_of(buds, form));
            }
        }
        if let Some(stated) = &internode.colour {
            for (paint, (bark, path)) in paints.iter_mut().zip(self.spread(stated, &path.key("colour"))) {
                paint.bark = bark.bark(&path, self.faults);
            }
        }
        if let Some(stated) = &internode.near {
            for (paint, (near, path)) in paints.iter_mut().zip(self.spread(stated, &path.key("near"))) {
                self.unsound(near.unsound(), &path);
                paint.near = self.paints.add_near_stem(near.clone());
            }
        }
        paints
    }

    /// The value for each state, with its path; fewer values, and faults, where the value of a state is missing.
    fn spread<'b, T>(&mut self, stated: &'b ByState<T>, path: &Path) -> Vec<(&'b T, Path)> {
        let states = &self.buds.states;
        let each = match stated {
            ByState::All(one) => return (0..states.len().max(1)).map(|_| (one, path.clone())).collect(),
            ByState::Each(each) => &each.by_state,
        };
        let path = path.key("by_state");
        if states.is_empty() {
            self.faults.push(Fault::new(&path, "the species has no states", "a single value, without by_state"));
            return Vec::new();
        }
        for name in each.keys().filter(|name| !states.contains(name)) {
            let expected = format!("one of {}", states.join(", "));
            self.faults.push(Fault::new(&path.key(name), format!("unknown state `{name}`"), expected));
        }
        let missing = states.iter().filter(|state| !each.contains_key(*state));
        self.faults.extend(missing.map(|state| {
            Fault::new(&path, format!("nothing is stated for the state `{state}`"), "a value for each state")
        }));
        states.iter().filter_map(|state| Some((each.get(state)?, path.key(state)))).collect()
    }

    fn sides(&mut self, sides: &Quantity, path: &Path) -> u8 {
        let value = sides.value();
        if !SIDES.contains(&value) {
            let path = if matches!(sides, Quantity::Form(_)) { path.key("value") } else { path.clone() };
            self.faults.push(Fault::new(&path, format!("a tube of {value} sides"), "from 3 to 64 sides"));
        }
        value.clamp(*SIDES.start(), *SIDES.end()) as u8
    }

    /// The kind of this name; a fault where it is not of the class that can stand at this path.
    fn kind(&mut self, name: KindName, class: Class, path: &Path) -> Kind {
        let kind = Kind::from(name);
        if kind.class() != class {
            let stated = KindName::ALL.iter().map(|name| Kind::from(*name));
            let fitting: Vec<&str> = stated.filter(|kind| kind.class() == class).map(Kind::tag).collect();
            let found = format!("the kind `{}` cannot stand here", kind.tag());
            self.faults.push(Fault::new(path, found, format!("one of {}", fitting.join(", "))));
        }
        kind
    }

    fn organs(&mut self) -> OrganLooks {
        let order = &self.buds.order[self.index];
        for (key, kind, class) in [
            ("leaf", order.leaf.kind, Class::Leaf),
            ("flower", order.flower.kind, Class::Flower),
            ("fruit", order.fruit.kind, Class::Fruit),
        ] {
            self.kind(kind, class, &self.path.key(key).key("kind"));
        }
        OrganLooks {
            leaf: OrganLook {
                expansion: self.expansion(&order.leaf.expansion, "leaf"),
                paint: self.leaf(&order.leaf.colour, &order.leaf.near),
            },
            flower: OrganLook {
                expansion: self.expansion(&order.flower.expansion, "flower"),
                paint: self.flower(&order.flower.colour, &order.flower.near),
            },
            fruit: OrganLook {
                expansion: self.expansion(&order.fruit.expansion, "fruit"),
                paint: self.fruit(&order.fruit.colour, &order.fruit.near),
            },
        }
    }

    /// The share of the full size by the organ's own age; empty where the organ is full-grown at birth.
    fn expansion(&mut self, law: &Option<Law>, key: &str) -> Vec<f32> {
        let Some(law) = law else { return Vec::new() };
        let path = self.path.key(key).key("expansion");
        law.by_own_age(order_of(self.index), self.until, &path, SHARE).unwrap_or_else(|mut found| {
            self.faults.append(&mut found);
            Vec::new()
        })
    }

    fn leaf(&mut self, stated: &Option<LeafChoice>, near: &Option<Near>) -> PaintNumber {
        let turns_in = self.buds.season.as_ref().map_or(0, |season| turning_of(season.ticks_per_year.value()));
        let path = self.path.key("leaf").key("colour");
        let paint = LeafChoice::paint(stated.as_ref(), turns_in, &path, self.faults);
        let near = self.near(near, "leaf");
        self.paints.add_organ(OrganPaint { near, ..paint })
    }

    fn flower(&mut self, stated: &Option<FlowerChoice>, near: &Option<Near>) -> PaintNumber {
        let path = self.path.key("flower").key("colour");
        let paint = match stated {
            None => OrganPaint::default(),
            Some(FlowerChoice::One(colour)) => {
                let colour = self.colour(colour, &path);
                OrganPaint { young: colour, old: colour, ..OrganPaint::default() }
            }
            Some(FlowerChoice::Stages(stages)) => OrganPaint {
                young: self.stage(&stages.young, &path, "young"),
                old: self.stage(&stages.old, &path, "old"),
                stalk: self.stage(&stages.stalk, &path, "stalk"),
                ..OrganPaint::default()
            },
        };
        let near = self.near(near, "flower");
        self.paints.add_organ(OrganPaint { near, ..paint })
    }

    fn fruit(&mut self, stated: &Option<FruitChoice>, near: &Option<Near>) -> PaintNumber {
        let path = self.path.key("fruit").key("colour");
        let paint = match stated {
            None => OrganPaint::default(),
            Some(FruitChoice::One(colour)) => {
                let colour = self.colour(colour, &path);
                OrganPaint { young: colour, turning: colour, old: colour, ..OrganPaint::default() }
            }
            Some(FruitChoice::Stages(stages)) => OrganPaint {
                young: self.stage(&stages.young, &path, "young"),
                turning: self.stage(&stages.turning, &path, "turning"),
                old: self.stage(&stages.ripe, &path, "ripe"),
                stalk: self.stage(&stages.stalk, &path, "stalk"),
                ..OrganPaint::default()
            },
        };
        let near = self.near(near, "fruit");
        self.paints.add_organ(OrganPaint { near, ..paint })
    }

    /// The place of a setting among the paints; faults where it is not sound for an organ half as wide as long.
    fn near(&mut self, stated: &Option<Near>, key: &str) -> Option<u16> {
        let near = stated.as_ref()?;
        let path = self.path.key(key).key("near");
        self.unsound(near.unsound(0.5), &path);
        self.paints.add_near(*near)
    }

    /// Tells what is wrong with a setting below a path.
    fn unsound(&mut self, found: Vec<Unsound>, path: &Path) {
        self.faults.extend(found.into_iter().map(|unsound| {
            let path = unsound.keys.iter().fold(path.clone(), |path, key| path.key(key));
            Fault::new(&path, unsound.found, unsound.expected)
        }));
    }

    fn stage(&mut self, stated: &Option<ColourText>, path: &Path, key: &str) -> Option<Colour> {
        colour::stage(stated, path, key, self.faults)
    }

    fn colour(&mut self, text: &ColourText, path: &Path) -> Option<Colour> {
        text.checked(path, self.faults)
    }
}
