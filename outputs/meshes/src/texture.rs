//! Textures: pictures of colours and of relief that a species states for its parts, checked.
//!
//! A picture is PNG or JPEG, which all formats of meshes with textures take, by its bytes and not by its name. It is
//! kept as it is. Absent: which vertices have which (`slots`), and how formats hold pictures.

use phytomer_sim::plant::Class;
use std::io::Cursor;
use std::sync::Arc;

/// The most pixels of a picture along a side.
pub const MOST_PIXELS: u32 = 8192;
/// The most bytes of a picture.
pub const MOST_PICTURE_BYTES: u64 = 32 << 20;

/// A picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// The name of its file, without folders.
    pub name: String,
    /// The whole file.
    pub bytes: Vec<u8>,
    /// Its width and its height, pixels.
    pub size: [u32; 2],
    /// Whether it is JPEG; else PNG.
    pub is_jpeg: bool,
    /// Whether it may be transparent.
    pub has_alpha: bool,
}

/// What covers a part of a plant.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// The part.
    pub of: Class,
    /// The order of the axes on which it holds; `None`: all that have none of their own.
    pub order: Option<u8>,
    /// Its colours.
    pub colours: Arc<Picture>,
    /// Its relief.
    pub normals: Option<Arc<Picture>>,
    /// How many metres of bark the picture is wide.
    pub width_m: Option<f32>,
}

/// What covers the parts of a species.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Textures {
    /// The name of the species.
    pub species: String,
    /// The textures.
    pub list: Vec<Arc<Texture>>,
}

/// A fault of a picture: the place, the problem, and what was expected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}; expected {expected}")]
pub struct PictureFault {
    /// The part of the file, in words.
    pub place: &'static str,
    /// What was found there, in words.
    pub problem: String,
    /// What was expected, in words.
    pub expected: String,
}

impl Textures {
    /// What covers a part on axes of an order, as its place in the list: that of the order, else that of all orders.
    pub fn find(&self, of: Class, order: u8) -> Option<usize> {
        let stated =
            |wanted: Option<u8>| self.list.iter().position(|texture| (texture.of, texture.order) == (of, wanted));
        stated(Some(order)).or_else(|| stated(None))
    }

    /// How many metres of bark of an order the picture is wide and high.
    pub fn bark(&self, order: u8) -> Option<[f32; 2]> {
        let texture = &self.list[self.find(Class::Internode, order)?];
        let [wide, high] = texture.colours.size.map(|pixels| pixels as f32);
        texture.width_m.map(|metres| [metres, metres * high / wide])
    }
}

impl Picture {
    /// Reads what a file says of its picture, and checks that it is whole.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(name: &str, bytes: Vec<u8>) -> Result<Self, PictureFault> {
        let is_jpeg = bytes.starts_with(&[0xff, 0xd8, 0xff]);
        let (size, has_alpha) = match is_jpeg {
            true => (jpeg(&bytes).map_err(|problem| fault("its bytes", problem, "a whole JPEG picture"))?, false),
            false if bytes.starts_with(b"\x89PNG\r\n\x1a\n") => {
                png(&bytes).map_err(|problem| fault("its bytes", problem, "a whole PNG picture"))?
            }
            false => return Err(fault("its first bytes", "no picture of a known format".to_owned(), "PNG or JPEG")),
        };
        check(size)?;
        let name = name.rsplit(['/', '\\']).next().unwrap_or(name).to_owned();
        Ok(Self { name, bytes, size, is_jpeg, has_alpha })
    }

    /// The ending that its format has.
    pub fn ending(&self) -> &'static str {
        if self.is_jpeg { "jpg" } else { "png" }
    }
}

fn fault(place: &'static str, problem: String, expected: &str) -> PictureFault {
    PictureFault { place, problem, expected: expected.to_owned() }
}

fn check([wide, high]: [u32; 2]) -> Result<(), PictureFault> {
    let sides = 1..=MOST_PIXELS;
    if sides.contains(&wide) && sides.contains(&high) {
        return Ok(());
    }
    let expected = format!("at most {MOST_PIXELS} pixels along each side");
    Err(fault("its size", format!("{wide} by {high} pixels"), &expected))
}

/// The size of a PNG picture, and whether it may be transparent. All of its rows are decoded, one at a time.
fn png(bytes: &[u8]) -> Result<([u32; 2], bool), String> {
    let told = |error: png::DecodingError| error.to_string();
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().map_err(told)?;
    let info = reader.info();
    let size = [info.width, info.height];
    let clear = matches!(info.color_type, png::ColorType::GrayscaleAlpha | png::ColorType::Rgba);
    let has_alpha = clear || info.trns.is_some();
    // One that is too large is told by its size.
    if check(size).is_ok() {
        while reader.next_row().map_err(told)?.is_some() {}
        reader.finish().map_err(told)?;
    }
    Ok((size, has_alpha))
}

/// The size of a JPEG picture (ITU-T T.81, annex B), by its frame header. Its segments follow one another up to the
/// scan, and the end of the picture is there.
fn jpeg(bytes: &[u8]) -> Result<[u32; 2], String> {
    let byte = |at: usize| bytes.get(at).copied().ok_or_else(|| "the file ends within a segment".to_owned());
    let word = |at: usize| Ok::<u32, String>(u32::from(byte(at)?) << 8 | u32::from(byte(at + 1)?));
    let (mut at, mut size) = (2, None);
    loop {
        if byte(at)? != 0xff {
            return Err(format!("no segment begins at byte {at}"));
        }
        let marker = byte(at + 1)?;
        if marker == 0xff {
            // A marker may follow any number of filling bytes.
            at += 1;
            continue;
        }
        let length = word(at + 2)?;
        match marker {
            // Baseline, extended and progressive frames with Huffman codes.
            0xc0..=0xc2 => {
                let (bits, parts) = (byte(at + 4)?, byte(at + 9)?);
                if bits != 8 || ![1, 3].contains(&parts) {
                    return Err(format!("{parts} colours of {bits} bits, where viewers take 1 or 3 of 8"));
                }
                size = Some([word(at + 7)?, word(at + 5)?]);
            }
            0xc3 | 0xc5..=0xc7 | 0xc9..=0xcb | 0xcd..=0xcf => {
                return Err("a lossless, hierarchical or arithmetic frame, which viewers do not take".to_owned());
            }
            0xda => break,
            _ => {}
        }
        if length < 2 {
            return Err(format!("a segment of {length} bytes at byte {at}"));
        }
        at += 2 + length as usize;
    }
    let ends = bytes[at..].windows(2).any(|pair| pair == [0xff, 0xd9]);
    match size {
        Some(size) if ends => Ok(size),
        Some(_) => Err("its end is missing".to_owned()),
        None => Err("no frame before its scan".to_owned()),
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A picture of so many pixels, each of its own colour.
    pub fn picture([wide, high]: [u32; 2], colour: png::ColorType) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, wide, high);
        encoder.set_color(colour);
        encoder.set_depth(png::BitDepth::Eight);
        let count = wide as usize * high as usize * colour.samples();
        let data: Vec<u8> = (0..count).map(|k| (k * 37 % 251) as u8).collect();
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&data).expect("its data");
        writer.finish().expect("its end");
        bytes
    }

    /// The segments of a JPEG picture of a size, with an empty scan.
    fn jpeg_of([wide, high]: [u16; 2], marker: u8, parts: u8) -> Vec<u8> {
        let mut bytes = vec![0xff, 0xd8, 0xff, 0xe0, 0, 4, 1, 2, 0xff, 0xff, marker, 0, 8 + 3 * parts, 8];
        bytes.extend(high.to_be_bytes());
        bytes.extend(wide.to_be_bytes());
        bytes.push(parts);
        bytes.resize(bytes.len() + usize::from(3 * parts), 1);
        bytes.extend([0xff, 0xda, 0, 2, 7, 0xff, 0, 9, 0xff, 0xd9]);
        bytes
    }

    #[test]
    fn a_picture_is_known_by_its_bytes() {
        for (colour, has_alpha) in [(png::ColorType::Rgb, false), (png::ColorType::Rgba, true)] {
            let read = Picture::read("folder/a.jpg", picture([5, 3], colour)).expect("a picture");
            assert_eq!((read.name.as_str(), read.size, read.is_jpeg), ("a.jpg", [5, 3], false));
            assert_eq!((read.has_alpha, read.ending()), (has_alpha, "png"));
        }
        let read = Picture::read("b.jpg", jpeg_of([640, 480], 0xc2, 3)).expect("a picture");
        assert_eq!((read.size, read.is_jpeg, read.has_alpha, read.ending()), ([640, 480], true, false, "jpg"));
    }

    #[test]
    fn what_is_none_is_told() {
        let whole = picture([64, 64], png::ColorType::Rgb);
        let cut = whole[..whole.len() / 2].to_vec();
        let mut bent = whole;
        bent[20] ^= 1;
        let jpeg = jpeg_of([8, 8], 0xc0, 3);
        for (bytes, told) in [
            (b"P6 1 1 255 abc".to_vec(), "its first bytes: no picture of a known format"),
            (Vec::new(), "its first bytes"),
            (cut, "its bytes: "),
            (bent, "its bytes: "),
            (picture([MOST_PIXELS + 1, 1], png::ColorType::Grayscale), "its size: 8193 by 1 pixels"),
            (jpeg_of([9000, 8], 0xc0, 3), "its size: 9000 by 8 pixels"),
            (jpeg_of([0, 8], 0xc0, 3), "its size: 0 by 8 pixels"),
            (jpeg_of([8, 8], 0xc3, 3), "its bytes: a lossless"),
            (jpeg_of([8, 8], 0xc0, 4), "its bytes: 4 colours of 8 bits"),
            (jpeg[..jpeg.len() - 1].to_vec(), "its bytes: its end is missing"),
            (jpeg[..20].to_vec(), "its bytes: the file ends within a segment"),
            (vec![0xff, 0xd8, 0xff, 0xda, 0, 2, 0xff, 0xd9], "its bytes: no frame before its scan"),
        ] {
            let found = Picture::read("a", bytes).expect_err(told).to_string();
            assert!(found.starts_with(told), "{found}");
        }
    }
}
