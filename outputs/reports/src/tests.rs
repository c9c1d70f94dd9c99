//! What a page holds, that nothing breaks out of it, and that a figure, its table and its specification agree.

use super::table::rounded;
use super::*;

fn series(name: &str, mark: Mark, scale: f64, reach: Option<f64>) -> Series {
    let point = |x: f64| Point { interval: reach.map(|r| [scale * x - r, scale * x + r]), ..Point::at(x, scale * x) };
    Series { name: name.to_owned(), mark, points: (0..6).map(|k| point(f64::from(k))).collect() }
}

fn chart() -> Chart {
    let series = vec![
        series("wet & \"warm\"", Mark::Line, 1.0, Some(0.5)),
        series("dry <b>", Mark::Points, 0.5, Some(0.25)),
        series("law", Mark::Dashed, 0.7, None),
        series("seen", Mark::Steps, 0.9, None),
        series("law of lives", Mark::DashedSteps, 0.8, None),
        series("counts", Mark::Bars, 0.1, None),
    ];
    Chart { x: Axis::of("age", "months"), y: Axis::of("height", "m"), series }
}

fn contrasts() -> Plotted {
    let row = |name: &str, value: f64| Contrast { name: name.to_owned(), value, interval: [value - 1.0, value + 1.0] };
    let rows = vec![row("dry beside wet", -2.0), row("fed beside wet", 0.5)];
    Plotted::Contrasts(Contrasts { x: Axis::of("difference of height", "m"), rows })
}

fn report() -> Report {
    let figure = |id: &str, plotted: Plotted| {
        Part::Figure(Figure {
            id: id.to_owned(),
            title: "Height </figcaption>".to_owned(),
            caption: "Bands are 95 % intervals.".to_owned(),
            words: "Two lines rise.".to_owned(),
            plotted,
        })
    };
    let table = Table {
        columns: vec!["name".to_owned(), "value".to_owned()],
        rows: vec![
            vec![Cell::words("=1+1"), Cell::number(0.123_456)],
            vec![Cell::words("b, \"c\""), Cell::number(f64::NAN)],
        ],
    };
    let picture = Picture { png: vec![1, 2, 3, 4], caption: "a plant".to_owned(), words: "a \"tree\"".to_owned() };
    let parts = vec![
        Part::Text("<script>alert(1)</script>".to_owned()),
        figure("height", Plotted::Chart(chart())),
        figure("contrast", contrasts()),
        Part::Table("numbers".to_owned(), table),
        Part::Picture(picture),
    ];
    let section = Section { heading: "Growth & death".to_owned(), parts };
    Report { title: "A <run>".to_owned(), about: "of two plants".to_owned(), sections: vec![section] }
}

#[test]
fn nothing_breaks_out_of_a_page() {
    let page = page(&report());
    assert!(!page.contains("<script") && !page.contains("<b>") && !page.contains("NaN"), "{page}");
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;"));
    assert!(page.contains("default-src 'none'; style-src 'unsafe-inline'; img-src data:"));
    assert!(!page.contains("src=\"http") && !page.contains("href=\"http") && !page.contains("url(http"));
    assert_eq!(page.matches("<svg").count(), 2);
    assert!(page.contains("alt=\"a &quot;tree&quot;\"") && page.contains("data:image/png;base64,AQIDBA=="));
}

/// Ids are those of their figure, whatever was drawn before, so that a page has the same bytes at any time.
#[test]
fn a_page_has_the_same_bytes_each_time() {
    assert_eq!(page(&report()), page(&report()));
    let svg = svg(&contrasts(), "one", "title", "words").expect("a drawing");
    let ids = svg.match_indices("id=\"").map(|(at, _)| &svg[at + 4..at + 7]);
    assert!(ids.clone().count() >= 2 && ids.into_iter().all(|id| id == "one"), "{svg}");
    assert!(svg.contains("role=\"img\" aria-labelledby=\"one-title one-words\""));
}

#[test]
fn a_table_is_csv_that_a_spreadsheet_takes_for_no_formula() {
    let table = Table {
        columns: vec!["a".to_owned(), "b (m)".to_owned()],
        rows: vec![
            vec![Cell::words("=SUM(A1)"), Cell::number(-0.1)],
            vec![Cell::words("two, \"three\""), Cell::Empty],
            vec![Cell::words("-3"), Cell::number(f64::INFINITY)],
        ],
    };
    assert_eq!(table.csv(), "a,b (m)\r\n'=SUM(A1),-0.1\r\n\"two, \"\"three\"\"\",\r\n-3,\r\n");
}

#[test]
fn numbers_are_told_to_four_digits() {
    let told = [0.0, 1.0, -2.5, 1234.56, 0.012_345_6, 99.996, 1e-9, 123_456_789.0].map(rounded);
    assert_eq!(told, ["0", "1", "-2.5", "1235", "0.01235", "100", "1.000e-9", "1.235e8"]);
}

/// The table and the specification hold each point that is drawn, with its interval.
#[test]
fn a_figure_its_table_and_its_specification_have_the_same_numbers() {
    let plotted = Plotted::Chart(chart());
    let (table, spec) = (plotted.table(), vega_lite(&plotted, "title", "words").expect("a specification"));
    let values = spec["data"]["values"].as_array().expect("values");
    assert_eq!((table.rows.len(), values.len()), (36, 36));
    for (row, value) in table.rows.iter().zip(values) {
        let told = ["series", "x", "y", "low", "high"].map(|key| match &value[key] {
            serde_json::Value::String(words) => Cell::words(words.as_str()),
            number => number.as_f64().map_or(Cell::Empty, Cell::Number),
        });
        assert_eq!(row.as_slice(), told.as_slice());
    }
    // A layer a series, and one more for each with intervals.
    assert_eq!(spec["layer"].as_array().map(Vec::len), Some(8));
    let of_contrasts = vega_lite(&contrasts(), "", "").expect("a specification");
    assert_eq!(of_contrasts["data"]["values"][1]["high"], 1.5);
}

/// One point, equal points, numbers at the ends of what there is: drawn, without a number that is none. Nothing but
/// what is no number: said.
#[test]
fn anything_finite_is_drawn() {
    for mark in [Mark::Line, Mark::Dashed, Mark::Steps, Mark::DashedSteps, Mark::Points, Mark::Bars] {
        for values in
            [vec![[1.0, 1.0]], vec![[2.0, 0.0]; 3], vec![[0.0, -1e-300], [1e9, 1e12]], vec![[-5.0, -3.0], [0.5, 2.0]]]
        {
            let points = values.iter().map(|&[x, y]| Point { interval: Some([y, y]), ..Point::at(x, y) }).collect();
            let series = vec![Series { name: "one".to_owned(), mark, points }];
            let plotted = Plotted::Chart(Chart { x: Axis::of("x", ""), y: Axis::of("y", ""), series });
            let svg = svg(&plotted, "one", "", "").expect("a drawing");
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{mark:?} {values:?}: {svg}");
        }
    }
    let points = vec![Point::at(f64::NAN, 1.0), Point::at(1.0, f64::INFINITY)];
    let none = Chart { series: vec![Series { name: "none".to_owned(), mark: Mark::Line, points }], ..chart() };
    let none = Plotted::Chart(none);
    assert!(svg(&none, "none", "", "").is_none() && png(&none).is_none() && vega_lite(&none, "", "").is_none());
    let plotted = Figure {
        id: "none".to_owned(),
        title: String::new(),
        caption: String::new(),
        words: String::new(),
        plotted: none,
    };
    let section = Section { heading: "none".to_owned(), parts: vec![Part::Figure(plotted)] };
    let page = page(&Report { title: String::new(), about: String::new(), sections: vec![section] });
    assert!(page.contains("Nothing can be drawn"));
}

/// Two pixels for each unit of the drawing.
#[test]
fn a_figure_is_a_png_too() {
    let png = png(&contrasts()).expect("a picture");
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let side = |at: usize| u32::from_be_bytes([png[at], png[at + 1], png[at + 2], png[at + 3]]);
    assert_eq!([side(16), side(20)], [1440, 356]);
}
