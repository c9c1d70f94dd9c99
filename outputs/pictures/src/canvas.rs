//! The finished picture: rows of pixels, and functions that draw flat shapes on it.
//!
//! Pixels are red, green, blue and opacity in sRGB; colours are not multiplied by opacity. Flat shapes are laid over
//! the pixels by the share of each pixel that they cover.

/// A picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Canvas {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The pixels, row by row from the upper left.
    pub pixels: Vec<[u8; 4]>,
}

impl Canvas {
    /// A transparent picture.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0; 4]; width as usize * height as usize] }
    }

    /// The pixel at a place.
    pub fn at(&self, x: u32, y: u32) -> [u8; 4] {
        self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// Lays a colour over a pixel, of which it covers a share; does nothing outside the picture.
    pub fn lay(&mut self, x: i64, y: i64, colour: [u8; 3], share: f32) {
        let inside = x >= 0 && y >= 0 && x < i64::from(self.width) && y < i64::from(self.height);
        if !inside || share <= 0.0 {
            return;
        }
        let pixel = &mut self.pixels[y as usize * self.width as usize + x as usize];
        let under = f32::from(pixel[3]) / 255.0 * (1.0 - share);
        let opacity = share + under;
        for k in 0..3 {
            let mixed = (f32::from(colour[k]) * share + f32::from(pixel[k]) * under) / opacity;
            pixel[k] = (mixed + 0.5) as u8;
        }
        pixel[3] = (opacity * 255.0 + 0.5) as u8;
    }

    /// Draws a rectangle with exact edges, in pixels.
    pub fn rectangle(&mut self, [left, top, right, bottom]: [f32; 4], colour: [u8; 3]) {
        let covered = |from: f32, to: f32, k: i64| (to.min(k as f32 + 1.0) - from.max(k as f32)).clamp(0.0, 1.0);
        for y in top.floor() as i64..bottom.ceil() as i64 {
            for x in left.floor() as i64..right.ceil() as i64 {
                self.lay(x, y, colour, covered(left, right, x) * covered(top, bottom, y));
            }
        }
    }

    /// Draws strokes of a round pen, each a chain of points; where strokes cross the colour is laid once.
    pub fn strokes(&mut self, strokes: &[Vec<[f32; 2]>], radius: f32, colour: [u8; 3]) {
        let all = || strokes.iter().flatten();
        let bound = |k: usize, sign: f32| all().map(|point| sign * point[k]).fold(f32::NEG_INFINITY, f32::max) * sign;
        if all().next().is_none() {
            return;
        }
        let reach = radius + 1.0;
        let (left, right) = ((bound(0, -1.0) - reach) as i64, (bound(0, 1.0) + reach).ceil() as i64);
        let (top, bottom) = ((bound(1, -1.0) - reach) as i64, (bound(1, 1.0) + reach).ceil() as i64);
        for y in top..bottom {
            for x in left..right {
                let at = [x as f32 + 0.5, y as f32 + 0.5];
                let distance = strokes.iter().map(|stroke| distance_to(stroke, at)).fold(f32::MAX, f32::min);
                self.lay(x, y, colour, (radius + 0.5 - distance).clamp(0.0, 1.0));
            }
        }
    }

    /// Copies another picture into this one, with its upper left corner at a place.
    pub fn put(&mut self, other: &Self, left: u32, top: u32) {
        for y in 0..other.height.min(self.height.saturating_sub(top)) {
            let width = other.width.min(self.width.saturating_sub(left)) as usize;
            let from = y as usize * other.width as usize;
            let to = (top + y) as usize * self.width as usize + left as usize;
            self.pixels[to..to + width].copy_from_slice(&other.pixels[from..from + width]);
        }
    }
}

fn distance_to(stroke: &[[f32; 2]], at: [f32; 2]) -> f32 {
    let ends = stroke.windows(2).map(|pair| (pair[0], pair[1]));
    let dot = stroke.first().filter(|_| stroke.len() == 1).map(|point| (*point, *point));
    let square = |([ax, ay], [bx, by]): ([f32; 2], [f32; 2])| {
        let (dx, dy, px, py) = (bx - ax, by - ay, at[0] - ax, at[1] - ay);
        let length = dx * dx + dy * dy;
        let along = if length > 0.0 { ((px * dx + py * dy) / length).clamp(0.0, 1.0) } else { 0.0 };
        let (x, y) = (px - along * dx, py - along * dy);
        x * x + y * y
    };
    ends.chain(dot).map(square).fold(f32::MAX, f32::min).sqrt()
}
