//! What the names of modules tell a turtle (Prusinkiewicz & Lindenmayer 1990 App. C; cpfg's manual).
//!
//! A name that is not listed here tells it nothing. Absent: what the turtle does (`Turtle`), and the cut `%`, which is
//! made in the string.

/// One of the three axes of a turtle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Its heading, H.
    Heading,
    /// Its left, L.
    Left,
    /// Its upper side, U.
    Up,
}

/// What a query asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Query {
    /// `?P`: the position.
    Position,
    /// `?H`, `?L`, `?U`: an axis.
    Axis(Axis),
    /// `?E`: the environment.
    Environment,
}

/// A counter that a parameter sets, and that goes up or down without one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counter {
    /// The width of lines: `#` up, `!` down.
    Width,
    /// The colour: `;` up, `,` down.
    Colour,
    /// The colour of backs: `@;` up, `@,` down.
    BackColour,
}

/// A round mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// `@o`: a circle that faces the eye.
    Circle,
    /// `@c`: a circle in the plane of H and L.
    Disc,
    /// `@O`: a sphere.
    Sphere,
}

/// A part of a generalised cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spline {
    /// `@Gs`: it begins.
    Start,
    /// `@Gc`: it goes on to here.
    Continue,
    /// `@Ge`: it ends here.
    End,
}

/// What a module tells a turtle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// `F` or, without a corner of a polygon, `G`: a step that draws a line.
    Line {
        /// Whether the end is a corner of the polygon.
        corner: bool,
    },
    /// `f` or, without a corner of a polygon, `g`: a step.
    Step {
        /// Whether the end is a corner of the polygon.
        corner: bool,
    },
    /// A turn about an axis by the rule of the right hand: `+ -` about U, `& ^` about L, `/ \` about H.
    Turn {
        /// About which axis.
        about: Axis,
        /// Whether by the angle itself; else by the opposite angle.
        positive: bool,
    },
    /// `|`: half a turn about U.
    TurnAround,
    /// `$`, `@v`: a roll until L is horizontal.
    RollUpright,
    /// `@R`: a heading, and perhaps an upper side, as given.
    Head,
    /// `@M`: a position as given.
    Place,
    /// `[`.
    Open,
    /// `]`.
    Close,
    /// `! # ; , @; @,`.
    Count {
        /// What is counted.
        what: Counter,
        /// Whether it goes up without a parameter.
        up: bool,
    },
    /// `@D`: the scale of lengths.
    Scale,
    /// `@Di`, `@Dd`: a factor of the scale, or a divisor.
    ScaleBy {
        /// Whether it multiplies.
        multiplies: bool,
    },
    /// `{`.
    PolygonStart,
    /// `}`.
    PolygonEnd,
    /// `.`: a corner of the polygon.
    Corner,
    /// `@Gs`, `@Gc`, `@Ge`.
    Spline(Spline),
    /// `@#`: the contour of generalised cylinders, by its number.
    Contour,
    /// `@o`, `@c`, `@O`.
    Mark(Mark),
    /// `~` and the symbol of a surface.
    Surface(char),
    /// `_`: the susceptibility to the tropism.
    Elasticity,
    /// `@Ti`, `@Td`, `@Ts`: the susceptibility to a tropism by its number.
    ElasticityOf(Change),
    /// `?P ?H ?U ?L ?E`.
    Query(Query),
    /// Anything else.
    Nothing,
}

/// How a susceptibility changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// It goes up.
    Up,
    /// It goes down.
    Down,
    /// It is set.
    Set,
}

impl Command {
    /// What the module of a name tells a turtle.
    pub fn of(name: &str) -> Self {
        let turn = |about, positive| Self::Turn { about, positive };
        let count = |what, up| Self::Count { what, up };
        match name {
            "F" => Self::Line { corner: true },
            "G" => Self::Line { corner: false },
            "f" => Self::Step { corner: true },
            "g" => Self::Step { corner: false },
            "+" => turn(Axis::Up, true),
            "-" => turn(Axis::Up, false),
            "&" => turn(Axis::Left, true),
            "^" => turn(Axis::Left, false),
            "/" => turn(Axis::Heading, true),
            "\\" => turn(Axis::Heading, false),
            "|" => Self::TurnAround,
            "$" | "@v" => Self::RollUpright,
            "@R" => Self::Head,
            "@M" => Self::Place,
            "[" => Self::Open,
            "]" => Self::Close,
            "#" => count(Counter::Width, true),
            "!" => count(Counter::Width, false),
            ";" => count(Counter::Colour, true),
            "," => count(Counter::Colour, false),
            "@;" => count(Counter::BackColour, true),
            "@," => count(Counter::BackColour, false),
            "{" => Self::PolygonStart,
            "}" => Self::PolygonEnd,
            "." => Self::Corner,
            "_" => Self::Elasticity,
            _ => Self::of_long(name),
        }
    }

    /// Names of more than one character.
    fn of_long(name: &str) -> Self {
        match name {
            "@D" => Self::Scale,
            "@Di" => Self::ScaleBy { multiplies: true },
            "@Dd" => Self::ScaleBy { multiplies: false },
            "@Gs" => Self::Spline(Spline::Start),
            "@Gc" => Self::Spline(Spline::Continue),
            "@Ge" => Self::Spline(Spline::End),
            "@#" => Self::Contour,
            "@o" => Self::Mark(Mark::Circle),
            "@c" => Self::Mark(Mark::Disc),
            "@O" => Self::Mark(Mark::Sphere),
            "@Ti" => Self::ElasticityOf(Change::Up),
            "@Td" => Self::ElasticityOf(Change::Down),
            "@Ts" => Self::ElasticityOf(Change::Set),
            "?P" => Self::Query(Query::Position),
            "?H" => Self::Query(Query::Axis(Axis::Heading)),
            "?L" => Self::Query(Query::Axis(Axis::Left)),
            "?U" => Self::Query(Query::Axis(Axis::Up)),
            "?E" => Self::Query(Query::Environment),
            _ => {
                let mut characters = name.chars();
                match (characters.next(), characters.next(), characters.next()) {
                    (Some('~'), Some(surface), None) => Self::Surface(surface),
                    _ => Self::Nothing,
                }
            }
        }
    }
}
