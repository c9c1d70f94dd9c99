//! Letters of round strokes, drawn for this project, for captions, scale bars and legends.
//!
//! A capital is 12 units tall, a small letter 8, and a stem below the line reaches 4 units down. A point is a digit for
//! its place to the right and a letter for its place down from the top of a capital (`m` is the line). A stroke is a
//! chain of points; with `~` it is a smooth curve through them. A letter that is missing here is written as a question
//! mark.

/// The height of a capital, units.
const CAPITAL: f32 = 12.0;
/// The distance between two letters, and the width of a space, units.
const GAP: f32 = 2.6;
const SPACE: f32 = 4.2;
/// The number of points that a curve adds between two of its given points.
const CUTS: u8 = 6;

#[rustfmt::skip]
static LETTERS: &[(char, &str)] = &[
    ('a', "6e6m ~6h5f3e1f0i1l3m5l6j"), ('b', "0a0m ~0h1f3e5f6i5l3m1l0j"), ('c', "~6g5f3e1f0i1l3m5l6k"),
    ('d', "6a6m ~6h5f3e1f0i1l3m5l6j"), ('e', "0i6i ~6i6g5f3e1f0i1l3m5l6k"), ('f', "~4a3a2b2d 2d2m 0e4e"),
    ('g', "6e6m ~6h5f3e1f0i1l3m5l6j ~6m6n5p3q1p"), ('h', "0a0m ~0h1f3e5f6h 6h6m"), ('i', "0e0m 0b"),
    ('j', "2e2n ~2n2p1q0q 2b"), ('k', "0a0m 5e0j 2h5m"), ('l', "0a0m"),
    ('m', "0e0m ~0h0f2e4f4h 4h4m ~4h4f6e8f8h 8h8m"), ('n', "0e0m ~0h1f3e5f6h 6h6m"),
    ('o', "~3e5f6i5l3m1l0i1f3e"), ('p', "0e0q ~0h1f3e5f6i5l3m1l0j"), ('q', "6e6q ~6h5f3e1f0i1l3m5l6j"),
    ('r', "0e0m ~0h1f2e4e"), ('s', "~5g4e2e0f1h4i5k3m1m0k"), ('t', "2b2k ~2k2l3m4m 0e4e"),
    ('u', "0e0j ~0j1l3m5l6j 6e6m"), ('v', "0e3m6e"), ('w', "0e2m4e6m8e"), ('x', "0e5m 5e0m"),
    ('y', "0e3m 6e3m ~3m2p0q"), ('z', "0e5e0m5m"),
    ('A', "0m4a8m 1j7j"), ('B', "0a0m 0a4a ~4a6b6e4f 0f4f ~4f6g7i6l4m 0m4m"), ('C', "~7c5a3a1b0e0h1k3m5m7k"),
    ('D', "0a0m 0a3a ~3a5b7d7i5l3m 0m3m"), ('E', "6a0a0m6m 0f5f"), ('F', "6a0a0m 0f5f"),
    ('G', "~7c5a3a1b0e0h1k3m5m7k 7k7g4g"), ('H', "0a0m 7a7m 0f7f"), ('I', "0a0m"), ('J', "4a4i ~4i4k2m1m0k"),
    ('K', "0a0m 7a0h 3e7m"), ('L', "0a0m6m"), ('M', "0m0a4j8a8m"), ('N', "0m0a7m7a"),
    ('O', "~4a6b8e8h6l4m2l0h0e2b4a"), ('P', "0a0m 0a4a ~4a6b7d6f4g 0g4g"), ('Q', "~4a6b8e8h6l4m2l0h0e2b4a 5j8n"),
    ('R', "0a0m 0a4a ~4a6b7d6f4g 0g4g7m"), ('S', "~7c5a3a1b0d2f5g7i6l4m2m0k"), ('T', "0a8a 4a4m"),
    ('U', "0a0i ~0i1l3m4m6l7i 7a7i"), ('V', "0a4m8a"), ('W', "0a2m4c6m8a"), ('X', "0a7m 7a0m"),
    ('Y', "0a4g8a 4g4m"), ('Z', "0a7a0m7m"),
    ('0', "~3a5b6e6h5l3m1l0h0e1b3a"), ('1', "1c3a3m"), ('2', "~0d1b3a5b6d5f3i0m 0m6m"),
    ('3', "~0b2a4a6b6d4f3f ~3f5f6h6k4m2m0l"), ('4', "5m5a0i7i"), ('5', "6a1a0f ~0f2e4e6g6j5l3m1m0l"),
    ('6', "~5a3b1d0g0j1l3m5l6j5g3f1g0i"), ('7', "0a6a2m"), ('8', "~3a5b5e3f1e1b3a ~3f5g6i6k5m3m1m0k0i1g3f"),
    ('9', "~6e5g3h1g0d1b3a5b6e6h5k3m1m"),
    ('.', "0m"), ('…', "0m 3m 6m"), (',', "1l0o"), (':', "0f 0m"), ('-', "0i4i"), ('–', "0i6i"), ('_', "0o6o"), ('/', "0o5a"),
    ('(', "~2a0d0k2o"), (')', "~0a2d2k0o"), ('×', "0f5l 5f0l"), ('·', "0i"), ('\'', "0a0c"), ('+', "0i6i 3f3l"),
    ('=', "0g6g 0j6j"), ('<', "6e0i6m"), ('>', "0e6i0m"), ('°', "~1a2b1c0b1a"), ('%', "6a0m ~1a2b1d0b1a ~5j6k5m4k5j"),
    ('²', "~0b1a2b2c0e 0e2e"), ('³', "~0a2a2b1c ~1c2d1e0e"), ('?', "~0c1a3a5a6c5f3h 3h3i 3m"),
];

/// The letter without its mark, and the mark.
fn unmarked(letter: char) -> (char, &'static str) {
    match letter {
        'é' | 'É' => ('e', "2c4a"),
        'è' => ('e', "2a4c"),
        'ê' => ('e', "1c3a5c"),
        'ë' => ('e', "1b 5b"),
        'á' => ('a', "2c4a"),
        'ä' => ('a', "1b 5b"),
        'ö' => ('o', "1b 5b"),
        'ü' => ('u', "1b 5b"),
        'ç' => ('c', ""),
        'í' => ('i', ""),
        'ñ' => ('n', "1c3b5c"),
        '’' => ('\'', ""),
        other => (other, ""),
    }
}

/// The strokes of a line of text that starts at a point, with capitals `size` pixels tall, and the x where it ends.
pub fn written(text: &str, size: f32, [left, line]: [f32; 2]) -> (Vec<Vec<[f32; 2]>>, f32) {
    let unit = size / CAPITAL;
    let (mut strokes, mut x) = (Vec::new(), left);
    for letter in text.chars() {
        if letter == ' ' {
            x += SPACE * unit;
            continue;
        }
        let (letter, mark) = unmarked(letter);
        let find = |letter: char| LETTERS.iter().find(|(known, _)| *known == letter).map(|(_, drawn)| *drawn);
        let drawn = find(letter).or_else(|| find('?')).unwrap_or_default();
        let mut width = if letter == '.' || letter == ',' { 1.0 } else { 0.0_f32 };
        for stroke in drawn.split(' ').chain(mark.split(' ').filter(|stroke| !stroke.is_empty())) {
            let points = chain(stroke);
            width = points.iter().map(|point| point[0]).fold(width, f32::max);
            strokes.push(points.iter().map(|[a, b]| [x + a * unit, line + (b - CAPITAL) * unit]).collect());
        }
        x += (width + GAP) * unit;
    }
    (strokes, x - GAP * unit)
}

/// The width of a line of text, pixels.
pub fn width(text: &str, size: f32) -> f32 {
    written(text, size, [0.0; 2]).1.max(0.0)
}

/// The points of a stroke, in units.
fn chain(stroke: &str) -> Vec<[f32; 2]> {
    let curved = stroke.starts_with('~');
    let bytes = stroke.trim_start_matches('~').as_bytes();
    let point = |pair: &[u8]| [f32::from(pair[0].wrapping_sub(b'0')), f32::from(pair[1].wrapping_sub(b'a'))];
    let points: Vec<[f32; 2]> = bytes.chunks_exact(2).map(point).collect();
    if curved { smooth(&points) } else { points }
}

/// A curve through the points (Catmull & Rom 1974); one that ends where it begins is closed.
fn smooth(points: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let n = points.len();
    let closed = first == last && n > 2;
    let before = if closed { points[n - 2] } else { *first };
    let after = if closed { points[1] } else { *last };
    let all: Vec<[f32; 2]> = [before].into_iter().chain(points.iter().copied()).chain([after]).collect();
    let mut curve = vec![*first];
    for four in all.windows(4) {
        for cut in 1..=CUTS {
            let t = f32::from(cut) / f32::from(CUTS);
            curve.push([0, 1].map(|k| {
                let [a, b, c, d] = [four[0][k], four[1][k], four[2][k], four[3][k]];
                b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
            }));
        }
    }
    curve
}
