//! Charts as specifications of Vega-Lite, which editors and notebooks draw and change.
//!
//! A specification holds its data. Absent: Vega itself, whose script needs `eval`, which a strict policy of content
//! forbids: a page has drawings of its own.

use super::chart::{Axis, Chart, Contrasts, Mark, Plotted, Series};
use super::drawn::colour;
use serde_json::{Value, json};

const SCHEMA: &str = "https://vega.github.io/schema/vega-lite/v6.json";

/// The specification of a figure; `None` where nothing can be drawn.
pub fn vega_lite(plotted: &Plotted, title: &str, description: &str) -> Option<Value> {
    let (values, layer) = match plotted.finite()? {
        Plotted::Chart(chart) => of_chart(&chart),
        Plotted::Contrasts(contrasts) => of_contrasts(&contrasts),
    };
    Some(json!({
        "$schema": SCHEMA,
        "title": title,
        "description": description,
        "width": 560,
        "data": { "values": values },
        "layer": layer,
    }))
}

fn numeric(field: &str, axis: &Axis) -> Value {
    json!({ "field": field, "type": "quantitative", "title": axis.label() })
}

fn of_chart(chart: &Chart) -> (Vec<Value>, Vec<Value>) {
    let mut values = Vec::new();
    for series in &chart.series {
        for point in &series.points {
            let mut value = json!({ "series": series.name, "x": point.x, "y": point.y });
            if let Some([low, high]) = point.interval {
                (value["low"], value["high"]) = (json!(low), json!(high));
            }
            values.push(value);
        }
    }
    let names: Vec<&str> = chart.series.iter().map(|series| series.name.as_str()).collect();
    let colours: Vec<&str> = (0..names.len()).map(colour).collect();
    let colour =
        json!({ "field": "series", "type": "nominal", "title": null, "scale": { "domain": names, "range": colours } });
    let layers = chart.series.iter().flat_map(|series| layers(series, chart, &colour));
    (values, layers.collect())
}

/// The layers of a series: its interval, and its marks.
fn layers(series: &Series, chart: &Chart, colour: &Value) -> Vec<Value> {
    // Bars are drawn without theirs, which the data hold.
    let has_intervals = series.mark != Mark::Bars && series.points.iter().any(|point| point.interval.is_some());
    let only = json!([{ "filter": { "field": "series", "equal": series.name } }]);
    let mark = match series.mark {
        Mark::Line => json!({ "type": "line" }),
        Mark::Dashed => json!({ "type": "line", "strokeDash": [6, 4] }),
        Mark::Steps => json!({ "type": "line", "interpolate": "step-after" }),
        Mark::DashedSteps => json!({ "type": "line", "interpolate": "step-after", "strokeDash": [6, 4] }),
        Mark::Points => json!({ "type": "point", "filled": true }),
        Mark::Bars => json!({ "type": "bar", "opacity": 0.7 }),
    };
    let (x, y) = (numeric("x", &chart.x), numeric("y", &chart.y));
    let mut layers = Vec::new();
    if has_intervals {
        let band = match series.mark {
            Mark::Line => json!({ "type": "area", "opacity": 0.2 }),
            _ => json!({ "type": "rule" }),
        };
        let low = numeric("low", &chart.y);
        let encoding = json!({ "x": x, "y": low, "y2": { "field": "high" }, "color": colour });
        layers.push(json!({ "transform": only, "mark": band, "encoding": encoding }));
    }
    layers.push(json!({ "transform": only, "mark": mark, "encoding": { "x": x, "y": y, "color": colour } }));
    layers
}

fn of_contrasts(Contrasts { x, rows }: &Contrasts) -> (Vec<Value>, Vec<Value>) {
    let value = |row: &super::chart::Contrast| json!({ "contrast": row.name, "value": row.value, "low": row.interval[0], "high": row.interval[1] });
    let y = json!({ "field": "contrast", "type": "nominal", "title": null, "sort": null });
    let layers = vec![
        json!({ "mark": { "type": "rule", "strokeDash": [4, 4] }, "encoding": { "x": { "datum": 0 } } }),
        json!({ "mark": "rule", "encoding": { "x": numeric("low", x), "x2": { "field": "high" }, "y": y } }),
        json!({ "mark": { "type": "point", "filled": true }, "encoding": { "x": numeric("value", x), "y": y } }),
    ];
    (rows.iter().map(value).collect(), layers)
}
