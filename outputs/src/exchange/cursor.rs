//! Line and column of the bytes of a text that are asked for mostly in rising order.
//!
//! All places together then take the time of one walk through the text, however many there are.

/// A place in a text, from which the next is counted.
#[derive(Debug)]
pub struct Cursor<'a> {
    text: &'a str,
    byte: usize,
    line: usize,
    column: usize,
}

impl<'a> Cursor<'a> {
    /// At the beginning of a text.
    pub fn of(text: &'a str) -> Self {
        Self { text, byte: 0, line: 1, column: 1 }
    }

    /// Line and column of a byte, both from 1; the column in characters. In time of the bytes since the place before,
    /// or from the beginning where it lies farther back.
    pub fn place(&mut self, byte: usize) -> (usize, usize) {
        let byte = self.text.floor_char_boundary(byte);
        if byte < self.byte {
            *self = Self::of(self.text);
        }
        for character in self.text[self.byte..byte].chars() {
            if character == '\n' {
                self.line += 1;
                self.column = 1;
            } else {
                self.column += 1;
            }
        }
        self.byte = byte;
        (self.line, self.column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_those_of_a_walk_from_the_beginning() {
        let text = "a\u{e9}b\ncd\n\ne";
        let mut cursor = Cursor::of(text);
        for byte in [0, 3, 4, 5, 7, 8, 9, 200, 1, 6] {
            let at = text.floor_char_boundary(byte);
            let line = text[..at].matches('\n').count() + 1;
            let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
            assert_eq!(cursor.place(byte), (line, text[start..at].chars().count() + 1), "{byte}");
        }
    }
}
