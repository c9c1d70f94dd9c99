//! Measured plants from a CSV file: a row a plant and date, with columns named as those of `summary`.
//!
//! `age` is in ticks of the run. Columns that a report does not know are passed over and told. Absent: the comparison.

use super::laws::measured::COLUMNS;
use super::plants::MEASURES;
use phytomer_measures::Moments;
use std::collections::BTreeMap;

/// Measured plants.
#[derive(Debug, Clone, Default)]
pub struct Field {
    /// The name of the file.
    pub name: String,
    /// The values of each known column, by age.
    values: BTreeMap<&'static str, BTreeMap<u32, Vec<f64>>>,
    /// The columns that are not known.
    pub passed_over: Vec<String>,
    /// The number of rows.
    pub rows: u64,
}

/// What is wrong with a file of measured plants.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {problem}; {expected}")]
pub struct FieldFault {
    /// The file.
    pub file: String,
    /// The line, from 1.
    pub line: u64,
    /// What is wrong.
    pub problem: String,
    /// What was expected.
    pub expected: String,
}

impl Field {
    /// Reads the text of a file.
    ///
    /// # Errors
    /// The first row that cannot be read, a file without the column `age` or without a known measure.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, FieldFault> {
        let fault = |line: u64, problem: String, expected: &str| FieldFault {
            file: name.to_owned(),
            line,
            problem,
            expected: expected.to_owned(),
        };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(bytes);
        let unreadable = |error: csv::Error| {
            let line = error.position().map_or(1, csv::Position::line);
            fault(
                line,
                format!("the row cannot be read ({error})"),
                "expected as many fields in UTF-8 as there are columns",
            )
        };
        let header = reader.headers().map_err(unreadable)?.clone();
        let known: Vec<(usize, &'static str)> = header
            .iter()
            .enumerate()
            .filter_map(|(place, column)| MEASURES.iter().find(|m| m.column == column).map(|m| (place, m.column)))
            .collect();
        let age = header.iter().position(|column| column == "age");
        let (Some(age), false) = (age, known.is_empty()) else {
            let columns = MEASURES.map(|measure| measure.column).join(", ");
            let has: Vec<&str> = header.iter().collect();
            let expected = format!("expected the column age (ticks) and one or more of {columns}, or {COLUMNS}");
            return Err(fault(1, format!("the columns are {}", has.join(", ")), &expected));
        };
        let mut field = Self { name: name.to_owned(), ..Self::default() };
        let is_known = |column: &&str| *column == "age" || MEASURES.iter().any(|measure| measure.column == *column);
        field.passed_over = header.iter().filter(|column| !is_known(column)).map(str::to_owned).collect();
        for record in reader.records() {
            let record = record.map_err(unreadable)?;
            let line = record.position().map_or(1, csv::Position::line);
            let ticks = record.get(age).unwrap_or_default();
            let ticks: u32 = ticks.parse().map_err(|_| {
                fault(line, format!("the age is `{ticks}`"), "expected a whole number of ticks, 0 or more")
            })?;
            for (place, column) in &known {
                let text = record.get(*place).unwrap_or_default();
                // An empty field was not measured.
                if text.is_empty() {
                    continue;
                }
                let value = text.parse::<f64>().ok().filter(|value| value.is_finite() && *value >= 0.0);
                let value = value.ok_or_else(|| {
                    fault(line, format!("`{column}` is `{text}`"), "expected a number of 0 or more, or an empty field")
                })?;
                field.values.entry(column).or_default().entry(ticks).or_default().push(value);
            }
            field.rows += 1;
        }
        if field.values.is_empty() {
            return Err(fault(1, "no plant was measured".to_owned(), "expected a number in one row or more"));
        }
        Ok(field)
    }

    /// The moments of a column by age.
    pub fn ages(&self, column: &str) -> BTreeMap<u32, Moments> {
        let by_age = self.values.get(column).into_iter().flatten();
        by_age.map(|(age, values)| (*age, Moments::of(values))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measured_plants_are_read_by_age() {
        let text = "# trial 7\nplot,age,height_m,leaf_area_m2\n1, 12,1.5,\n1,12,2.5,0.25\n2,24,3.0,1\n";
        let field = Field::read("field.csv", text.as_bytes()).expect("a sound file");
        assert_eq!((field.rows, field.passed_over.as_slice()), (3, ["plot".to_owned()].as_slice()));
        let heights = field.ages("height_m");
        assert_eq!((heights[&12].n, heights[&12].mean, heights[&24].n), (2, 2.0, 1));
        assert_eq!(field.ages("leaf_area_m2")[&12].n, 1);
        assert!(field.ages("wood_volume_m3").is_empty());
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, words) in [
            ("", "field.csv:1: the columns are ; expected the column age"),
            ("age,hight_m\n1,2\n", "field.csv:1: the columns are age, hight_m; expected the column age"),
            ("height_m\n1\n", "field.csv:1: the columns are height_m; "),
            ("age,height_m\n1,2\n1.5,3\n", "field.csv:3: the age is `1.5`; expected a whole number of ticks"),
            ("age,height_m\n1,2\n2,NaN\n", "field.csv:3: `height_m` is `NaN`; expected a number of 0 or more"),
            ("age,height_m\n1,-2\n", "field.csv:2: `height_m` is `-2`; "),
            ("age,height_m\n1,2,3\n", "field.csv:2: the row cannot be read"),
            ("age,height_m\n1,\n", "field.csv:1: no plant was measured; "),
        ] {
            let told = Field::read("field.csv", text.as_bytes()).expect_err(text).to_string();
            assert!(told.starts_with(words), "{text:?}: {told}");
        }
        assert!(Field::read("field.csv", b"age,height_m\n\xff,1\n").is_err());
    }
}
