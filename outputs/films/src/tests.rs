//! Films of a disc that moves over a sloping ground, read again by readers that are not ours: png's, gif's and
//! libwebp's, and one of a few lines for bare frames.

use crate::changed::Area;
use crate::time::Units;
use crate::{Apng, Encoder, Film, Gif, Palette, Patched, Timeline, WebP, Y4m};
use phytomer_pictures::Canvas;
use std::io::{self, Cursor, Write};

const SIZE: [u32; 2] = [70, 52];
const FPS: u32 = 24;
/// How long each picture is held, frames.
const HELD: [u32; 5] = [3, 1, 4, 1, 7];

/// A ground of even slopes with a disc at a place.
fn picture(step: u32) -> Canvas {
    let [width, height] = SIZE;
    let mut canvas = Canvas::new(width, height);
    for (index, pixel) in canvas.pixels.iter_mut().enumerate() {
        let (x, y) = (index as u32 % width, index as u32 / width);
        let (dx, dy) = (i64::from(x) - 20 - 4 * i64::from(step), i64::from(y) - 24);
        let disc = dx * dx + dy * dy < 90;
        *pixel = if disc {
            [40, 120 + 9 * step as u8, 30, 255]
        } else {
            [150 + x as u8, 140 + 2 * y as u8, 220 - x as u8, 255]
        };
    }
    canvas
}

fn pictures() -> Vec<Canvas> {
    (0..HELD.len() as u32).map(picture).collect()
}

fn film() -> Film {
    let frames = HELD.iter().sum();
    Film { size: SIZE, fps: FPS, frames, pictures: HELD.len() as u32, note: "a disc".to_owned() }
}

/// The first so many pictures of the film, in a format.
fn written<'a, E: Encoder + 'a>(count: usize, begin: impl FnOnce(&'a mut Vec<u8>) -> E, out: &'a mut Vec<u8>) {
    let mut encoder = begin(out);
    for (canvas, held) in pictures().iter().zip(HELD).take(count) {
        encoder.picture(canvas, held).expect("a picture is written");
    }
    encoder.finish().expect("the film is written");
}

fn apng(count: usize) -> Vec<u8> {
    let mut out = Vec::new();
    written(count, |out| Apng::new(&film(), out), &mut out);
    out
}

fn gif(count: usize) -> Vec<u8> {
    let mut out = Vec::new();
    let palette = Palette::of(&[picture(0), picture(4)]);
    written(count, |out| Gif::new(&film(), palette, out).expect("a GIF begins"), &mut out);
    out
}

fn webp(count: usize) -> Vec<u8> {
    let mut out = Vec::new();
    written(count, |out| WebP::new(&film(), 90, out).expect("a WebP begins"), &mut out);
    out
}

fn y4m(count: usize) -> Vec<u8> {
    let mut out = Vec::new();
    written(count, |out| Y4m::new(&film(), out).expect("a stream begins"), &mut out);
    out
}

#[test]
fn time_goes_evenly_from_the_first_age_to_the_last() {
    let life = Timeline { first: 1.0, last: 96.0, step: 1.0, frames: 288 };
    assert_eq!((life.ages(), life.age_at(0), life.age_at(287)), (96, 1.0, 96.0));
    let held = life.held();
    assert_eq!(held.iter().map(|(_, frames)| frames).sum::<u32>(), 288);
    assert!(held.iter().map(|(age, _)| *age).eq(0..96), "every age is shown, in its order");
    // 287 steps over 95 ages: 3.02 frames an age, half of it at the ends.
    assert!(
        held[1..95].iter().all(|(_, frames)| (3..=4).contains(frames)) && held[0].1 == 2 && held[95].1 == 2,
        "{held:?}"
    );
    let fewer = Timeline { frames: 5, ..life };
    assert_eq!(fewer.held(), [(0, 1), (24, 1), (47, 1), (71, 1), (95, 1)], "of 47.5 the earlier");
    let one = Timeline { first: 60.0, last: 60.0, step: 1.0, frames: 48 };
    assert_eq!((one.held(), one.age_at(17)), (vec![(0, 48)], 60.0));
    let steps = Timeline { first: 1.0, last: 95.0, step: 5.0, frames: 19 };
    assert_eq!((steps.ages(), steps.age(18), steps.held().len()), (19, 91.0, 19), "the last step within the ages");
    assert_eq!(Timeline { frames: 1, ..life }.held(), [(95, 1)], "one frame shows the end");
    let parts = Timeline { first: 0.0, last: 1.0, step: 0.25, frames: 5 };
    assert_eq!((0..5).map(|frame| parts.age_at(frame)).collect::<Vec<_>>(), [0.0, 0.25, 0.5, 0.75, 1.0]);
}

#[test]
fn units_of_time_add_up() {
    for (a_second, fps) in [(100, 24), (1000, 24), (100, 50), (1000, 7), (100, 1)] {
        let mut units = Units::new(a_second, fps);
        let sum: u32 = (0..10 * fps).map(|_| units.next(1)).sum();
        assert_eq!(sum, 10 * a_second, "ten seconds in {a_second} a second at {fps}");
    }
}

#[test]
fn what_differs_is_found() {
    let (a, b) = (picture(0), picture(1));
    let area = Area::between(&a.pixels, &b.pixels, a.width);
    // Discs of radius 9 at 20 and 24, which also differ in colour.
    assert_eq!(area, Area { left: 11, top: 15, width: 23, height: 19 });
    let none = Area { left: 0, top: 0, width: 1, height: 1 };
    assert_eq!(Area::between(&a.pixels, &a.pixels, a.width), none);
}

/// The pictures of an animated PNG as png's own decoder reads it, laid over one another, with their times.
fn read_apng(file: &[u8]) -> Vec<(Canvas, f64)> {
    let mut reader = png::Decoder::new(Cursor::new(file)).read_info().expect("an info");
    let count = reader.info().animation_control.expect("an animation").num_frames;
    let mut stands = Canvas::new(SIZE[0], SIZE[1]);
    let mut read = Vec::new();
    for _ in 0..count {
        let mut data = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut data).expect("a frame");
        let control = *reader.info().frame_control().expect("a control");
        for (row, line) in data[..frame.buffer_size()].chunks(frame.line_size).enumerate() {
            for (column, pixel) in line.chunks(3).enumerate() {
                let (x, y) = (control.x_offset as usize + column, control.y_offset as usize + row);
                stands.pixels[y * SIZE[0] as usize + x] = [pixel[0], pixel[1], pixel[2], 255];
            }
        }
        read.push((stands.clone(), f64::from(control.delay_num) / f64::from(control.delay_den)));
    }
    read
}

#[test]
fn an_apng_loses_no_pixel_and_no_frame() {
    for count in [5, 3, 1] {
        let read = read_apng(&apng(count));
        assert_eq!(read.len(), count, "a film that ends early tells how many pictures it has");
        for (((seen, time), canvas), held) in read.iter().zip(pictures()).zip(HELD) {
            assert!(*seen == canvas && (time * f64::from(FPS) - f64::from(held)).abs() < 1e-9, "held {held}: {time}");
        }
    }
}

/// The pictures of a GIF by gif's own decoder, laid over one another, with their times in hundredths.
fn read_gif(file: &[u8]) -> (Vec<(Canvas, u16)>, Vec<u8>) {
    let mut reader = gif::DecodeOptions::new().read_info(file).expect("a GIF");
    let palette = reader.global_palette().expect("one palette").to_vec();
    let mut stands = Canvas::new(SIZE[0], SIZE[1]);
    let mut read = Vec::new();
    while let Some(frame) = reader.read_next_frame().expect("a frame") {
        assert!(frame.palette.is_none(), "a picture has no palette of its own");
        for (index, place) in frame.buffer.iter().enumerate().filter(|(_, place)| Some(**place) != frame.transparent) {
            let (x, y) = (index % usize::from(frame.width), index / usize::from(frame.width));
            let at = (y + usize::from(frame.top)) * SIZE[0] as usize + x + usize::from(frame.left);
            let colour = &palette[3 * usize::from(*place)..][..3];
            stands.pixels[at] = [colour[0], colour[1], colour[2], 255];
        }
        read.push((stands.clone(), frame.delay));
    }
    (read, palette)
}

/// The root of the mean squared difference of the channels of two pictures.
fn difference(a: &Canvas, b: &Canvas) -> f64 {
    let channels = a.pixels.iter().flatten().zip(b.pixels.iter().flatten());
    let squares: f64 = channels.map(|(a, b)| f64::from(*a) - f64::from(*b)).map(|x| x * x).sum();
    (squares / (3.0 * a.pixels.len() as f64)).sqrt()
}

/// Pixels that are the same in all pictures.
fn still(pictures: &[Canvas]) -> Vec<usize> {
    let same = |at: &usize| pictures.iter().all(|picture| picture.pixels[*at] == pictures[0].pixels[*at]);
    (0..pictures[0].pixels.len()).filter(same).collect()
}

#[test]
fn a_gif_has_one_palette_and_its_ground_stands_still() {
    for count in [5, 2] {
        let (read, palette) = read_gif(&gif(count));
        assert_eq!((read.len(), palette.len()), (count, 3 * 256));
        let hundredths: u32 = read.iter().map(|(_, delay)| u32::from(*delay)).sum();
        let frames: u32 = HELD.iter().take(count).sum();
        assert!((f64::from(hundredths) - 100.0 * f64::from(frames) / f64::from(FPS)).abs() <= 0.5, "{hundredths}");
        let seen: Vec<Canvas> = read.into_iter().map(|(seen, _)| seen).collect();
        for (seen, canvas) in seen.iter().zip(pictures()) {
            // The ground has 3,600 colours, which 255 meet to within half of the pattern and half of their distance.
            assert!(difference(seen, &canvas) < 6.0, "{}", difference(seen, &canvas));
        }
        let constant = still(&pictures()[..count]);
        assert!(
            constant.len() > 2500
                && constant.iter().all(|at| seen.iter().all(|s| s.pixels[*at] == seen[0].pixels[*at]))
        );
    }
}

#[test]
fn a_palette_of_few_colours_has_them_and_of_none_is_grey() {
    let mut two = picture(0);
    two.pixels
        .iter_mut()
        .enumerate()
        .for_each(|(k, pixel)| *pixel = if k % 9 == 0 { [9, 200, 31, 255] } else { [250, 1, 77, 255] });
    let palette = Palette::of(&[two]);
    let mut colours = palette.colours.clone();
    colours.sort_unstable();
    assert_eq!(colours, [[9, 200, 31], [250, 1, 77]]);
    assert_eq!(palette.colours[usize::from(palette.nearest([20, 190, 40]))], [9, 200, 31]);
    assert_eq!(Palette::of(&[]).colours, [[128; 3]]);
    let many = Palette::of(&[picture(0)]);
    assert_eq!(many.colours.len(), 255);
    assert_eq!(many, Palette::of(&[picture(0)]));
}

#[test]
fn a_webp_is_read_by_libwebp_and_its_ground_stands_still() {
    for count in [5, 2] {
        let file = webp(count);
        assert_eq!(
            u32::from_le_bytes(file[4..8].try_into().unwrap()) as usize,
            file.len() - 8,
            "the length is put right"
        );
        let decoder = webp::AnimDecoder::new(&file);
        let read = decoder.decode().expect("an animation");
        assert_eq!((read.len(), read.loop_count), (count, 0));
        let seen: Vec<Canvas> = (0..count)
            .map(|place| {
                let frame = read.get_frame(place).expect("a frame");
                let pixels = frame.get_image().chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect();
                Canvas { width: frame.width(), height: frame.height(), pixels }
            })
            .collect();
        let last = read.get_frame(count - 1).map_or(0, |frame| frame.get_time_ms());
        let frames: u32 = HELD.iter().take(count).sum();
        assert!((f64::from(last) - 1000.0 * f64::from(frames) / f64::from(FPS)).abs() <= 0.5, "{last}");
        for (seen, canvas) in seen.iter().zip(pictures()) {
            // 30 dB, as of a fair photograph: chroma is stored for four pixels, and the disc has an edge of colour.
            assert!(difference(seen, &canvas) < 8.1, "{}", difference(seen, &canvas));
            assert!(seen.pixels.iter().all(|pixel| pixel[3] == 255));
        }
        // Blocks in which nothing moves, 16 by 16, keep every bit: the row below the disc.
        let below = (48 * SIZE[0] as usize)..seen[0].pixels.len();
        assert!(seen.iter().all(|s| s.pixels[below.clone()] == seen[0].pixels[below.clone()]));
    }
}

#[test]
fn bare_frames_are_those_of_bt601_to_the_rounding() {
    let file = y4m(5);
    let end = file.iter().position(|byte| *byte == b'\n').unwrap();
    let head = std::str::from_utf8(&file[..end]).unwrap();
    assert_eq!(head, "YUV4MPEG2 W70 H52 F24:1 Ip A1:1 C444 XCOLORRANGE=LIMITED");
    let plane = (SIZE[0] * SIZE[1]) as usize;
    let frames: Vec<&[u8]> = file[end + 1..].chunks(6 + 3 * plane).collect();
    assert_eq!(frames.len() as u32, HELD.iter().sum::<u32>());
    let shown = pictures().into_iter().zip(HELD).flat_map(|(canvas, held)| (0..held).map(move |_| canvas.clone()));
    for (frame, canvas) in frames.iter().zip(shown) {
        let (word, values) = frame.split_at(6);
        assert_eq!(word, b"FRAME\n");
        for (at, [r, g, b, _]) in canvas.pixels.iter().enumerate() {
            let [r, g, b] = [*r, *g, *b].map(|value| f64::from(value) / 255.0);
            let light = 0.299 * r + 0.587 * g + 0.114 * b;
            let meant =
                [16.0 + 219.0 * light, 128.0 + 112.0 * (b - light) / 0.886, 128.0 + 112.0 * (r - light) / 0.701];
            for (part, meant) in meant.iter().enumerate() {
                let value = f64::from(values[part * plane + at]);
                assert!((value - meant).abs() < 0.51, "{value} for {meant}");
            }
        }
    }
}

/// A sink that is full after so many bytes.
struct Full(Vec<u8>, usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0.len() + bytes.len() > self.1 { Err(io::ErrorKind::StorageFull.into()) } else { self.0.write(bytes) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Patched for Full {
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        self.0.patch(at, bytes)
    }
}

/// The first error of a film whose sink is full after so many bytes.
fn refused<E: Encoder>(mut encoder: E) -> io::Error {
    let told = pictures().iter().zip(HELD).find_map(|(canvas, held)| encoder.picture(canvas, held).err());
    told.or_else(|| encoder.finish().err()).expect("the sink is full")
}

#[test]
fn a_disk_that_fills_up_in_mid_film_is_told_by_every_format() {
    let whole = [apng(5), gif(5), webp(5), y4m(5)].map(|file| file.len());
    let full = |format: usize| Full(Vec::new(), whole[format] * 2 / 3);
    let errors = [
        refused(Apng::new(&film(), full(0))),
        refused(Gif::new(&film(), Palette::of(&pictures()), full(1)).expect("it begins")),
        refused(WebP::new(&film(), 90, full(2)).expect("it begins")),
        refused(Y4m::new(&film(), full(3)).expect("it begins")),
    ];
    for error in errors {
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    }
}
