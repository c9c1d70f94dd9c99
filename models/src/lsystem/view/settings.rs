//! View files (`.v`) of the interpreter cpfg: how the turtle draws, and which files hold surfaces, functions and
//! contours.
//!
//! A line is a label, a colon and values. Labels that speak of the screen (viewpoint, lights, fonts …) and labels that
//! nobody knows have no meaning here: their lines are skipped and listed in [`View::skipped`]. A label that stands
//! twice has its last value, but surfaces, functions, contours and tropisms add up. Labels and values that a file
//! leaves out are those of cpfg. Absent: the files that are named (`surface`, `function`), and the turtle.

use super::text::{Line, TextFault, Words, bounded, lines, without_comments};

/// How many surfaces, functions, contours or tropisms a file may name.
const MOST_OF_A_KIND: usize = 256;
/// The sides of a contour where they are not stated.
const CONTOUR_SIDES: u8 = 24;

/// What a view file states of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The angle of a turn without parameter, degrees (`angle factor: n` is 360/n).
    pub angle_deg: f64,
    /// The width of lines at first.
    pub line_width: f64,
    /// Whether the width is in units of the turtle; else it is in pixels of the screen.
    pub width_in_units: bool,
    /// What `#` adds to the width, and `!` takes off.
    pub line_width_increment: f64,
    /// How lines are drawn.
    pub line_style: LineStyle,
    /// Whether a line becomes as wide as the line that follows it.
    pub tapered_lines: bool,
    /// The colour at first, of the front and of the back, as places in the map of colours.
    pub colour: [i32; 2],
    /// What `;` adds to the colour, and `,` takes off.
    pub colour_increment: [i32; 2],
    /// The vector T of the tropism, as given.
    pub tropism: [f64; 3],
    /// The susceptibility e at first.
    pub elasticity: f64,
    /// What `_` adds to the susceptibility.
    pub elasticity_increment: f64,
    /// The tropisms and torques that modules `@T…` name by number, in the order of their lines.
    pub tropisms: Vec<Tropism>,
    /// The scale of lengths at first.
    pub scale: f64,
    /// What `@Di` multiplies the scale by.
    pub scale_multiplier: f64,
    /// The surfaces that `~` draws.
    pub surfaces: Vec<NamedSurface>,
    /// The files of functions that `func(1, …)`, `func(2, …)` name, in their order.
    pub functions: Vec<String>,
    /// The file with all functions, which then have names.
    pub function_set: Option<String>,
    /// The contours that `@#` names: number and file.
    pub contours: Vec<(i32, String)>,
    /// The sides of a contour.
    pub contour_sides: u8,
    /// Whether contours follow the rolls of the turtle; else they twist no more than the cylinder bends.
    pub cylinders_twist: bool,
    /// The lines that have no meaning here.
    pub skipped: Vec<SkippedLine>,
}

/// How lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineStyle {
    /// Lines on the screen.
    Pixel,
    /// Flat strips.
    Polygon,
    /// Tubes.
    Cylinder,
}

/// A tropism or a torque that modules name by number: towards a vector, at an angle to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tropism {
    /// The vector, of the length of its intensity, at most 1.
    pub direction: [f64; 3],
    /// The angle between the vector and the direction to which a segment turns, degrees.
    pub angle_deg: f64,
    /// The susceptibility at first.
    pub elasticity: f64,
    /// What `@Ti` adds to the susceptibility, and `@Td` takes off.
    pub elasticity_increment: f64,
    /// Whether it rolls the turtle about its heading, so that the upper side of cpfg turns to the vector; else it bends
    /// the heading.
    pub rolls: bool,
}

/// A surface: the symbol behind `~`, its file, and its largest dimension in units of the turtle.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedSurface {
    /// The symbol.
    pub symbol: char,
    /// The file.
    pub file: String,
    /// The largest dimension.
    pub size: f64,
    /// The steps of its parameters s and t in which it is drawn; 0 where they are not stated.
    pub steps: [u8; 2],
}

/// A line that has no meaning here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SkippedLine {
    /// Its number, from 1.
    pub line: u32,
    /// Its text.
    pub text: String,
}

impl Default for View {
    /// The values of cpfg where there is no view file.
    fn default() -> Self {
        Self {
            angle_deg: 45.0,
            line_width: 1.0,
            width_in_units: true,
            line_width_increment: 0.0,
            line_style: LineStyle::Pixel,
            tapered_lines: true,
            colour: [128; 2],
            colour_increment: [1; 2],
            tropism: [0.0, 1.0, 0.0],
            elasticity: 0.0,
            elasticity_increment: 0.0,
            tropisms: Vec::new(),
            scale: 1.0,
            scale_multiplier: 1.0,
            surfaces: Vec::new(),
            functions: Vec::new(),
            function_set: None,
            contours: Vec::new(),
            contour_sides: CONTOUR_SIDES,
            cylinders_twist: false,
            skipped: Vec::new(),
        }
    }
}

impl View {
    /// Reads a view file.
    ///
    /// # Errors
    /// Every line whose values cannot be read, each at the word that is wrong.
    pub fn read(text: &str) -> Result<Self, Vec<TextFault>> {
        bounded(text.len()).map_err(|fault| vec![fault])?;
        let (mut view, mut faults) = (Self::default(), Vec::new());
        let text = without_comments(text);
        for line in lines(&text).filter(|line| !line.text.trim().is_empty()) {
            match view.line(line) {
                Ok(true) => {}
                Ok(false) => {
                    view.skipped.push(SkippedLine { line: line.number, text: line.text.trim().to_owned() });
                }
                Err(fault) => faults.push(fault),
            }
        }
        if faults.is_empty() { Ok(view) } else { Err(faults) }
    }

    /// Reads a line; false where its label has no meaning here.
    fn line(&mut self, line: Line<'_>) -> Result<bool, TextFault> {
        let Some((label, values)) = line.split(':') else { return Ok(false) };
        let mut words = values.words();
        let words = &mut words;
        match label {
            "angle factor" => self.angle_deg = 360.0 / above_zero(words, "the number of turns in a full circle")?,
            "angle increment" => self.angle_deg = words.number("an angle in degrees")?,
            "line width increment" => self.line_width_increment = words.number("a width")?,
            "initial line width" => self.width(words)?,
            "line style" => self.line_style = style(words)?,
            "tapered lines" => self.tapered_lines = on_or_off(words)?,
            "initial color" | "initial colour" => self.colour = colours(words)?,
            "color increment" | "colour increment" => self.colour_increment = colours(words)?,
            "tropism direction" => self.tropism = words.triple("three numbers, such as 0,-1,0")?,
            "initial elasticity" => self.elasticity = words.number("a susceptibility")?,
            "elasticity increment" => self.elasticity_increment = words.number("a susceptibility")?,
            "initial scale" => self.scale = not_zero(words, "a scale other than 0")?,
            "scale multiplier" => self.scale_multiplier = not_zero(words, "a factor other than 0")?,
            "tropism" => add(&mut self.tropisms, tropism(values, false)?, line)?,
            "torque" => add(&mut self.tropisms, tropism(values, true)?, line)?,
            "surface" => add(&mut self.surfaces, surface(words)?, line)?,
            "function" => add(&mut self.functions, words.text("the name of a file")?.text.to_owned(), line)?,
            "function set" => self.function_set = Some(words.text("the name of a file")?.text.to_owned()),
            "contour" => add(&mut self.contours, contour(words)?, line)?,
            "contour sides" => {
                self.contour_sides = words.whole(3, 1024, "a number of sides from 3 to 1024")?.min(64) as u8
            }
            "twist of cylinders" => self.cylinders_twist = on_or_off(words)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// A width, in pixels where a word with `p` follows; a word with `s` asks for tubes.
    fn width(&mut self, words: &mut Words<'_>) -> Result<(), TextFault> {
        let word = words.next();
        self.line_width = word.number("a width, such as 0.1")?;
        if self.line_width < 0.0 {
            return Err(word.fault("a width of at least 0"));
        }
        let unit = words.next().text;
        self.width_in_units = !unit.starts_with('p');
        self.line_style = match unit.chars().next() {
            Some('p') => LineStyle::Pixel,
            Some('s') => LineStyle::Cylinder,
            _ => LineStyle::Polygon,
        };
        Ok(())
    }
}

fn above_zero(words: &mut Words<'_>, expected: &str) -> Result<f64, TextFault> {
    let word = words.next();
    let number = word.number(expected)?;
    if number > 0.0 { Ok(number) } else { Err(word.fault(expected)) }
}

fn not_zero(words: &mut Words<'_>, expected: &str) -> Result<f64, TextFault> {
    let word = words.next();
    let number = word.number(expected)?;
    if number == 0.0 { Err(word.fault(expected)) } else { Ok(number) }
}

fn on_or_off(words: &mut Words<'_>) -> Result<bool, TextFault> {
    let word = words.next();
    match word.text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(word.fault("`on` or `off`")),
    }
}

/// A style by its word, or by its number from 1.
fn style(words: &mut Words<'_>) -> Result<LineStyle, TextFault> {
    let word = words.next();
    match word.text {
        "pixel" | "1" => Ok(LineStyle::Pixel),
        "polygon" | "2" => Ok(LineStyle::Polygon),
        "cylinder" | "3" => Ok(LineStyle::Cylinder),
        _ => Err(word.fault("`pixel`, `polygon` or `cylinder`")),
    }
}

/// A colour of the front, and of the back, which is the same where one alone is given.
fn colours(words: &mut Words<'_>) -> Result<[i32; 2], TextFault> {
    let expected = "a whole number from -255 to 255";
    let front = words.whole(-255, 255, expected)?;
    let back = words.next().text.parse().ok().filter(|back| (-255..=255).contains(back));
    Ok([front, back.unwrap_or(front)])
}

fn surface(words: &mut Words<'_>) -> Result<NamedSurface, TextFault> {
    let word = words.text("the symbol of the surface")?;
    let mut symbols = word.text.chars();
    let (Some(symbol), None) = (symbols.next(), symbols.next()) else {
        return Err(word.fault("the symbol of the surface, one character"));
    };
    let file = words.text("the name of a file")?.text.to_owned();
    let size = words.number("the size of the surface")?;
    let mut steps = || words.next().text.parse().unwrap_or(0);
    let steps = [steps(), steps()];
    Ok(NamedSurface { symbol, file, size: if size > 0.0 { size } else { 1.0 }, steps })
}

fn contour(words: &mut Words<'_>) -> Result<(i32, String), TextFault> {
    let number = words.whole(0, i32::MAX, "the number of the contour")?;
    Ok((number, words.text("the name of a file")?.text.to_owned()))
}

/// `T: x y z`, `I: intensity`, `A: angle`, `E: susceptibility`, `S: increment`, in any order.
fn tropism(line: Line<'_>, rolls: bool) -> Result<Tropism, TextFault> {
    let spaced = |character: char| character.is_whitespace() || character == ',' || character == ':';
    let mut words = line.words_between(spaced).into_iter();
    let end = line.words().end();
    let mut tropism =
        Tropism { direction: [0.0; 3], angle_deg: 0.0, elasticity: 0.0, elasticity_increment: 0.0, rolls };
    let mut intensity = 1.0;
    while let Some(letter) = words.next() {
        let mut number = || words.next().unwrap_or(end).number("a number");
        match letter.text {
            "T" => tropism.direction = [number()?, number()?, number()?],
            "I" => intensity = number()?,
            "A" => tropism.angle_deg = number()?,
            "E" => tropism.elasticity = number()?,
            "S" => tropism.elasticity_increment = number()?,
            _ => return Err(letter.fault("`T:`, `I:`, `A:`, `E:` or `S:` with numbers")),
        }
    }
    let [x, y, z] = tropism.direction;
    let length = (x * x + y * y + z * z).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return Err(end.fault("`T:` with a vector that is not 0"));
    }
    let scale = intensity.clamp(-1.0, 1.0) / length;
    tropism.direction = tropism.direction.map(|along| along * scale);
    Ok(tropism)
}

fn add<T>(list: &mut Vec<T>, item: T, line: Line<'_>) -> Result<(), TextFault> {
    if list.len() == MOST_OF_A_KIND {
        let problem = format!("{MOST_OF_A_KIND} such lines stand before this one");
        let expected = "fewer of them".to_owned();
        return Err(TextFault { line: line.number, column: line.column, problem, expected });
    }
    list.push(item);
    Ok(())
}
