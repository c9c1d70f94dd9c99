//! Which column a value of a DSSAT file stands in.
//!
//! DSSAT cuts each line at the ends of the headers, and so takes a value that is shifted for its neighbour's
//! (dssat-csm-os, issue 234). Here a value is its header's where both end within one character of each other, as
//! right-aligned numbers do, whatever columns are blank. Where a row has as many values as there are headers and none
//! of them ends below another's, or all end left of their own, the order tells, however they are shifted. A mark for a
//! missing value may also stand anywhere below its header alone. Values that touch are parted at a minus, or at the end
//! of a header where both parts then have equally many decimals. Of what is left, a value that can only be humidity,
//! wind or another minor quantity is left out and noted; all else is told. Absent: what the values are.

use super::token::{Token, is_mark};
use crate::names::Column;

/// A header.
#[derive(Debug, Clone)]
pub(super) struct Head {
    /// What it names.
    pub column: Column,
    /// Where it begins in its line.
    pub start: u32,
    /// Where it ends.
    pub end: u32,
}

/// The headers of a table, in the order of their line.
#[derive(Debug, Clone, Default)]
pub(super) struct Layout {
    /// The headers.
    pub heads: Vec<Head>,
    /// Whether a tab stands between them, so that nothing is known of their places.
    pub tabs: bool,
}

/// Why the columns of a row are not known, and which of its values is the first without one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Misfit {
    /// There is no value below the header of the date.
    NoDate,
    /// This value ends below no header, or below two.
    Astray(usize),
    /// This value begins below the header before its own: it may be two.
    Wide(usize),
}

/// A value without a header, while its row is read.
const NONE: usize = usize::MAX;

/// A value that may be of several columns, none of which tells a temperature, radiation or rain.
pub(super) const LEFT_OUT: usize = usize::MAX - 1;

impl Layout {
    /// Gives each value its header: `heads` are the numbers of the headers, in the order of the values.
    #[inline]
    pub fn assign(&self, line: &[u8], tokens: &[Token], tabs: bool, heads: &mut Vec<usize>) -> Result<(), Misfit> {
        heads.clear();
        let misfit = self.by_place(tokens, heads);
        if misfit.is_none() && !tabs && !self.tabs {
            return Ok(());
        }
        self.otherwise(line, tokens, tabs, heads, misfit)
    }

    /// By the ends of values and headers; the first misfit, if there is one.
    #[inline]
    fn by_place(&self, tokens: &[Token], heads: &mut Vec<usize>) -> Option<Misfit> {
        let (mut misfit, mut next) = (None, 0);
        for (at, token) in tokens.iter().enumerate() {
            if at == 0 && self.begins_with_date() {
                let dated = self.heads.get(1).is_none_or(|second| token.start < second.start);
                if !dated {
                    return Some(Misfit::NoDate);
                }
                heads.push(0);
                next = 1;
                continue;
            }
            while self.heads.get(next).is_some_and(|head| head.end + 1 < token.end) {
                next += 1;
            }
            match self.heads.get(next) {
                Some(head) if head.end <= token.end + 1 && !self.is_between(next, token) => {
                    let above = next.checked_sub(1).filter(|above| *above > 0).map_or(0, |above| self.heads[above].end);
                    if token.start < above {
                        misfit = misfit.or(Some(Misfit::Wide(at)));
                    }
                    heads.push(next);
                    next += 1;
                }
                _ => {
                    misfit = misfit.or(Some(Misfit::Astray(at)));
                    heads.push(NONE);
                }
            }
        }
        misfit
    }

    fn begins_with_date(&self) -> bool {
        self.heads.first().is_some_and(|head| head.column == Column::Date)
    }

    /// Whether a value ends as near to the end of the next header as to that of this one.
    fn is_between(&self, head: usize, token: &Token) -> bool {
        self.heads[head].end < token.end && self.heads.get(head + 1).is_some_and(|next| next.end <= token.end + 1)
    }

    /// By the order where that tells; else marks of missing values by what they stand below.
    #[cold]
    fn otherwise(
        &self,
        line: &[u8],
        tokens: &[Token],
        tabs: bool,
        heads: &mut [usize],
        misfit: Option<Misfit>,
    ) -> Result<(), Misfit> {
        let tabs = tabs || self.tabs;
        let first = Err(misfit.unwrap_or(Misfit::Astray(0)));
        let none_elsewhere = heads.iter().enumerate().all(|(at, head)| *head == NONE || *head == at);
        let none_beyond = tokens.iter().zip(&self.heads).skip(1).all(|(token, head)| token.end <= head.end + 1);
        let in_order = tabs || none_elsewhere || none_beyond;
        let is_wide = matches!(misfit, Some(Misfit::Wide(_)));
        if heads.len() == tokens.len() && tokens.len() == self.heads.len() && in_order && !is_wide {
            heads.iter_mut().enumerate().for_each(|(at, head)| *head = at);
            return Ok(());
        }
        if tabs || is_wide || misfit == Some(Misfit::NoDate) || tokens.len() > self.heads.len() {
            return first;
        }
        let mut least = 0;
        for at in 0..tokens.len() {
            if heads[at] == NONE {
                let most = heads[at + 1..].iter().copied().find(|head| *head != NONE).unwrap_or(self.heads.len());
                let mut below = (least..most).filter(|head| self.stands_below(&tokens[at], *head));
                match (below.next(), below.next()) {
                    (Some(head), None) if is_mark(tokens[at].of(line)) => heads[at] = head,
                    _ if self.are_minor(least, most) => {
                        heads[at] = LEFT_OUT;
                        continue;
                    }
                    _ => return Err(Misfit::Astray(at)),
                }
            }
            least = heads[at] + 1;
        }
        Ok(())
    }

    /// Whether none of some headers is of a date, a temperature, radiation or rain.
    fn are_minor(&self, from: usize, to: usize) -> bool {
        let is_minor = |head: &Head| match head.column {
            Column::Of(measure) => measure.quantity.is_minor(),
            column => column == Column::Unused,
        };
        self.heads.get(from..to).is_some_and(|heads| !heads.is_empty() && heads.iter().all(is_minor))
    }

    fn stands_below(&self, token: &Token, head: usize) -> bool {
        self.heads.get(head).is_some_and(|head| token.start < head.end && head.start < token.end)
    }

    /// Where a value with two decimal points ends and the next begins: at the end of a header, if both parts then have
    /// equally many decimals and the last ends with its own header.
    pub fn seam(&self, line: &[u8], token: &Token) -> Option<u32> {
        let own = self.heads.iter().position(|head| head.end == token.end)?;
        let seam = self.heads[own.checked_sub(1)?].end;
        let is_inside = token.start < seam && seam < token.end;
        let (left, right) = (Token { end: seam, ..*token }, Token { start: seam, ..*token });
        let decimals = |token: &Token| {
            let text = token.of(line);
            text.iter().rposition(|byte| *byte == b'.').map(|point| text.len() - point)
        };
        let only_one = right.of(line).iter().filter(|byte| **byte == b'.').count() == 1;
        (is_inside && only_one && decimals(&left) == decimals(&right)).then_some(seam)
    }

    /// The value below a header of the station's table: by its end, by the order of a full row, or by standing below
    /// it.
    pub fn below(&self, tokens: &[Token], head: usize) -> Option<usize> {
        let end = self.heads.get(head)?.end;
        let by_end = tokens.iter().position(|token| token.end.abs_diff(end) <= 1);
        by_end.or_else(|| (tokens.len() == self.heads.len()).then_some(head))
    }
}

#[cfg(test)]
mod tests {
    use super::super::token::tokens;
    use super::*;
    use crate::asked::Format;
    use crate::names::column;

    fn layout(line: &str) -> Layout {
        let mut found = Vec::new();
        tokens(line.as_bytes(), &mut found);
        let name = |token: &Token| line.get(token.start as usize..token.end as usize).unwrap_or("").replace('@', "");
        let head =
            |token: &Token| Head { column: column(Format::Dssat, &name(token)), start: token.start, end: token.end };
        Layout { heads: found.iter().map(head).collect(), tabs: line.contains('\t') }
    }

    fn assigned(headers: &str, line: &str) -> Result<Vec<usize>, Misfit> {
        let (mut found, mut heads) = (Vec::new(), Vec::new());
        let tabs = tokens(line.as_bytes(), &mut found);
        layout(headers).assign(line.as_bytes(), &found, tabs, &mut heads).map(|()| heads)
    }

    const HEADERS: &str = "@DATE  SRAD  TMAX  TMIN  RAIN  DEWP";

    #[test]
    fn a_value_is_its_headers_or_is_told() {
        for (line, read) in [
            ("95001   3.4  24.8  14.3   0.0  10.0", Ok(vec![0, 1, 2, 3, 4, 5])),
            ("95001         24.8  14.3              ", Ok(vec![0, 2, 3])),
            ("95001    3.4  24.8  14.3   0.0", Ok(vec![0, 1, 2, 3, 4])),
            ("95001  3.4  24.8  14.3   0.0", Ok(vec![0, 1, 2, 3, 4])),
            ("95001 3.4 24.8 14.3 0.0 10.0", Ok(vec![0, 1, 2, 3, 4, 5])),
            ("95001\t3.4\t24.8\t14.3\t0.0\t10.0", Ok(vec![0, 1, 2, 3, 4, 5])),
            ("95001 -0.20-10.40 14.30  0.00", Ok(vec![0, 1, 2, 3, 4])),
            ("95001   3.4  24.8  14.3   0.0 -99", Ok(vec![0, 1, 2, 3, 4, 5])),
            ("95001         24.8  14.3   0.0 -99", Ok(vec![0, 2, 3, 4, 5])),
            // Only a dew point can stand there, but it may be none: it is left out.
            ("95001         24.8  14.3   0.0 7", Ok(vec![0, 2, 3, 4, LEFT_OUT])),
            // Shifted by three: below no header alone, and one column is blank.
            ("95001      3.4  24.8  14.3   0.0", Err(Misfit::Astray(1))),
            // Shifted by a whole column: the last is below no header, and the others are below their neighbours'.
            ("95001         3.4  24.8  14.3   0.0  10.0", Err(Misfit::Astray(5))),
            ("95001\t3.4\t24.8\t14.3", Err(Misfit::Astray(1))),
            ("         3.4  24.8  14.3   0.0  10.0", Err(Misfit::NoDate)),
            ("95001     1234567  14.3   0.0", Err(Misfit::Wide(1))),
            ("95001   3.4  24.8  14.3   0.0  10.0  7.0", Err(Misfit::Astray(6))),
        ] {
            assert_eq!(assigned(HEADERS, line), read, "{line}");
        }
        assert_eq!(
            assigned("@DATE SRAD  TMAX  TMIN  RAIN  DEWP", "71001   4.5  13.0  10.5   1.9"),
            Ok(vec![0, 1, 2, 3, 4])
        );
    }

    #[test]
    fn values_that_touch_are_parted_where_it_is_certain() {
        let seam = |line: &str| {
            let mut found = Vec::new();
            tokens(line.as_bytes(), &mut found);
            let token = found.into_iter().find(|token| token.points > 1)?;
            layout(HEADERS).seam(line.as_bytes(), &token)
        };
        assert_eq!(seam("84001 15.20 25.20 13.00113.60"), Some(23));
        assert_eq!(seam("84001 15.20 25.20 13.0 113.60"), None);
        assert_eq!(seam("84001 15.20 25.20  13.00113.60"), None, "shifted by one, the seam is not known");
        assert_eq!(seam("84001 15.20 25.20 13.0111.360"), None, "the parts differ in their decimals");
    }
}
