//! Summaries that were observed, for an estimation without a likelihood: a row for each, with its name and its value.
//!
//! Absent: what a name means, which the simulator knows.

use super::table::{Fault, MOST_FAULTS, Table};

/// A table as it is read.
pub const SAMPLE: &str = include_str!("../../samples/abc.csv");

/// A summary that was observed.
#[derive(Debug, Clone, PartialEq)]
pub struct Observed {
    /// The line of its row.
    pub line: u64,
    /// Its name.
    pub summary: String,
    /// Its value.
    pub value: f64,
    /// How many plants it was observed on, where that is known.
    pub plants: Option<u32>,
}

/// Reads the columns `summary` and `value`, and `plants` where there is one.
///
/// # Errors
/// Every fault, at most 20.
pub fn read(table: &Table) -> Result<Vec<Observed>, Vec<Fault>> {
    let places = ["summary", "value"].map(|name| table.column(name));
    let [Ok(name), Ok(value)] = places else {
        return Err(places.into_iter().filter_map(Result::err).collect());
    };
    let plants = table.find("plants");
    let (mut observed, mut faults): (Vec<Observed>, Vec<Fault>) = (Vec::new(), Vec::new());
    for (line, cells) in &table.rows {
        let mut wrong = |problem: String, expected: &str| faults.push(table.fault(Some(*line), problem, expected));
        let (summary, text) = (cells[name].trim().to_owned(), cells[value].trim());
        if summary.is_empty() {
            wrong("`summary` is empty".to_owned(), "the name of a summary, such as height_m@60");
        } else if let Some(before) = observed.iter().find(|own| own.summary == summary) {
            wrong(format!("`{summary}` stands in line {} too", before.line), "each summary once");
        }
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        if number.is_none() {
            wrong(format!("`value` is `{}`", text.chars().take(40).collect::<String>()), "a number");
        }
        let count = plants.map(|place| cells[place].trim());
        let of = count.map(|text| text.parse::<u32>().ok().filter(|plants| *plants > 0));
        if of == Some(None) {
            wrong(format!("`plants` is `{}`", count.unwrap_or_default()), "a whole number of 1 or more");
        }
        observed.push(Observed { line: *line, summary, value: number.unwrap_or(0.0), plants: of.flatten() });
    }
    faults.truncate(MOST_FAULTS);
    if faults.is_empty() { Ok(observed) } else { Err(faults) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summaries_are_read_or_told_with_their_lines() {
        let read_text = |text: &str| read(&Table::from_csv("o.csv", text.as_bytes()).unwrap());
        let good = read_text("summary,value,plants\nheight_m@60,2.5,40\nleaves@60,310,40\n").unwrap();
        assert_eq!((good.len(), good[1].value, good[0].plants), (2, 310.0, Some(40)));
        assert!(read(&Table::from_csv("abc.csv", SAMPLE.as_bytes()).unwrap()).unwrap().len() > 2);
        for (text, words) in [
            ("summary,value\nheight_m@60,\n", "o.csv:2"),
            ("summary,value\nheight_m@60,NaN\n", "`value` is `NaN`"),
            ("summary,value\n,3\n", "`summary` is empty"),
            ("summary,value\na@1,3\na@1,4\n", "stands in line 2 too"),
            ("summary,value,plants\na@1,3,0\n", "`plants` is `0`"),
            ("sumary,value\na@1,3\n", "the nearest is `sumary`"),
        ] {
            let told = read_text(text).unwrap_err().iter().map(ToString::to_string).collect::<String>();
            assert!(told.contains(words) && told.contains("o.csv"), "{told}");
        }
    }
}
