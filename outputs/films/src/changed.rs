//! What differs between two pictures of a film: the smallest rectangle that holds every pixel that differs.
//!
//! A format that stores this rectangle alone leaves the rest of the picture as it stands.

/// A rectangle of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Area {
    /// The left column.
    pub left: u32,
    /// The upper row.
    pub top: u32,
    /// Columns, at least one.
    pub width: u32,
    /// Rows, at least one.
    pub height: u32,
}

impl Area {
    /// A whole picture.
    pub fn whole([width, height]: [u32; 2]) -> Self {
        Self { left: 0, top: 0, width, height }
    }

    /// The pixels of a picture of this width in the rectangle, row by row.
    pub fn rows<'a, T>(&self, pixels: &'a [T], width: u32) -> impl Iterator<Item = &'a [T]> + use<'a, T> {
        let Self { left, top, width: wide, height } = *self;
        (top..top + height).map(move |row| {
            let from = row as usize * width as usize + left as usize;
            &pixels[from..from + wide as usize]
        })
    }

    /// What differs between two pictures of a width; their first pixel where nothing does.
    pub fn between<T: PartialEq>(before: &[T], after: &[T], width: u32) -> Self {
        let wide = width.max(1) as usize;
        let rows = before.chunks(wide).zip(after.chunks(wide)).enumerate();
        let mut bounds: Option<[usize; 4]> = None;
        for (row, (before, after)) in rows.filter(|(_, (before, after))| before != after) {
            let differs = |(a, b): (&T, &T)| a != b;
            let left = before.iter().zip(after).position(differs).unwrap_or(0);
            let right = before.iter().zip(after).rposition(differs).unwrap_or(0);
            let [west, north, east, _] = bounds.unwrap_or([left, row, right, row]);
            bounds = Some([west.min(left), north, east.max(right), row]);
        }
        let [left, top, right, bottom] = bounds.unwrap_or_default().map(|side| side as u32);
        Self { left, top, width: right - left + 1, height: bottom - top + 1 }
    }
}
