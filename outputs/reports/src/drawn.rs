//! Charts as SVG and as PNG, drawn by kuva.
//!
//! Colours are those of Okabe & Ito 2008, which people with any colour vision tell apart, and marks differ besides.
//! Each SVG has its title and its words for those who do not see it, and ids of its own, so that several stand in one
//! page. Absent: the data (`chart`).

use super::chart::{Chart, Contrasts, Mark, Plotted, Point, Series};
use super::escape::text;
use super::table::rounded;
use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::{ForestPlot, Histogram, LegendPosition, LinePlot, ScatterPlot};
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};
use phytomer_png::{Compression, write_deflated};
use std::sync::Arc;

/// Blue, vermilion, bluish green, orange, sky blue, reddish purple, black: Okabe & Ito 2008, without yellow, which is
/// too pale for a line.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#e69f00", "#56b4e9", "#cc79a7", "#000000"];
/// The size of a chart, pixels.
const SIZE: [f64; 2] = [720.0, 400.0];
/// The height of a contrast, and of what is around all of them.
const ROW: f64 = 34.0;
const AROUND: f64 = 110.0;

/// The colour of the series at a place.
pub(super) fn colour(place: usize) -> &'static str {
    COLOURS[place % COLOURS.len()]
}

/// A figure as SVG with a title and a description; `id` begins the ids in it. Points that are no numbers are left out;
/// `None` where nothing is left.
pub fn svg(plotted: &Plotted, id: &str, title: &str, description: &str) -> Option<String> {
    let scene = scene(&plotted.finite()?);
    let drawn = SvgBackend::new().render_scene(&scene);
    let (head, rest) = drawn.split_once('>')?;
    let [width, height] = [scene.width, scene.height];
    let id = text(id);
    let named = format!(
        "{head} viewBox=\"0 0 {width} {height}\" role=\"img\" aria-labelledby=\"{id}-title {id}-words\">\
         <title id=\"{id}-title\">{}</title><desc id=\"{id}-words\">{}</desc>{rest}",
        text(title),
        text(description)
    );
    Some(own_ids(&named, &id))
}

/// A figure as PNG, two pixels for each unit of the SVG; `None` where nothing can be drawn.
pub fn png(plotted: &Plotted) -> Option<Vec<u8>> {
    let drawn = PngBackend::new().with_scale(2.0).render_scene(&scene(&plotted.finite()?)).ok()?;
    let mut png = Vec::with_capacity(drawn.len());
    write_deflated(&drawn, Compression::Balanced, &mut png).ok()?;
    Some(png)
}

/// kuva numbers its ids through a whole process; here they count from 0 in each figure.
fn own_ids(svg: &str, id: &str) -> String {
    const OF_KUVA: &str = "kuva-clip-";
    let mut seen: Vec<&str> = Vec::new();
    let mut out = String::with_capacity(svg.len());
    let mut rest = svg;
    while let Some(at) = rest.find(OF_KUVA) {
        let (before, behind) = (&rest[..at], &rest[at + OF_KUVA.len()..]);
        let digits = behind.bytes().take_while(u8::is_ascii_digit).count();
        let number = &behind[..digits];
        let place = seen.iter().position(|one| *one == number).unwrap_or_else(|| {
            seen.push(number);
            seen.len() - 1
        });
        out += before;
        out += &format!("{id}-clip-{place}");
        rest = &behind[digits..];
    }
    out + rest
}

fn scene(plotted: &Plotted) -> Scene {
    match plotted {
        Plotted::Chart(chart) => of_chart(chart),
        Plotted::Contrasts(contrasts) => of_contrasts(contrasts),
    }
}

fn of_chart(chart: &Chart) -> Scene {
    let plots: Vec<Plot> = chart.series.iter().enumerate().map(|(place, series)| plot(series, colour(place))).collect();
    let layout = Layout::auto_from_plots(&plots)
        .with_x_label(chart.x.label())
        .with_y_label(chart.y.label())
        .with_legend_position(LegendPosition::OutsideRightTop)
        .with_tick_format(ticks())
        .with_width(SIZE[0])
        .with_height(SIZE[1]);
    let starts_at_0 = |value: fn(&Point) -> f64| {
        chart.series.iter().flat_map(|series| &series.points).all(|point| value(point) >= 0.0)
    };
    let low = |point: &Point| point.interval.map_or(point.y, |ends| ends[0].min(point.y));
    let layout = if starts_at_0(low) { layout.with_y_axis_min(0.0) } else { layout };
    render_multiple(plots, whole_numbers(chart, layout))
}

/// Bars stand about whole numbers: the axis begins and ends at one, and its numbers are whole, not the edges of bars.
fn whole_numbers(chart: &Chart, mut layout: Layout) -> Layout {
    let mut bars = chart.series.iter().filter(|series| series.mark == Mark::Bars).flat_map(|series| &series.points);
    if !bars.all(|point| point.x.fract() == 0.0) || chart.series.iter().all(|series| series.mark != Mark::Bars) {
        return layout;
    }
    let all = || chart.series.iter().flat_map(|series| &series.points).map(|point| point.x);
    let [low, high] = [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)];
    layout.x_bin_width = None;
    layout.with_x_axis_min((low - 1.0).floor()).with_x_axis_max((high + 1.0).ceil())
}

fn plot(series: &Series, colour: &str) -> Plot {
    let points: Vec<(f64, f64)> = series.points.iter().map(|point| (point.x, point.y)).collect();
    let ends = |end: usize| series.points.iter().map(move |point| point.interval.map_or(point.y, |ends| ends[end]));
    let has_intervals = series.points.iter().any(|point| point.interval.is_some());
    let line = || {
        LinePlot::new().with_data(points.clone()).with_color(colour).with_stroke_width(2.0).with_legend(&*series.name)
    };
    match series.mark {
        Mark::Line if has_intervals => line().with_band(ends(0), ends(1)).into(),
        Mark::Line => line().into(),
        Mark::Dashed => line().with_dashed().into(),
        Mark::Steps => line().with_step().into(),
        Mark::DashedSteps => line().with_step().with_dashed().into(),
        Mark::Points => {
            let drawn =
                ScatterPlot::new().with_data(points).with_color(colour).with_size(4.0).with_legend(&*series.name);
            let reaches = series.points.iter().map(|point| {
                point.interval.map_or((0.0, 0.0), |[low, high]| ((point.y - low).max(0.0), (high - point.y).max(0.0)))
            });
            if has_intervals { drawn.with_y_err_asymmetric(reaches.collect::<Vec<_>>()).into() } else { drawn.into() }
        }
        Mark::Bars => {
            let (edges, counts) = bars(&series.points);
            Histogram::from_bins(edges, counts).with_color(pale(colour)).with_legend(&*series.name).into()
        }
    }
}

/// Halfway to white: lines and points stand before bars.
fn pale(colour: &str) -> String {
    let part = |at: usize| colour.get(at..at + 2).and_then(|digits| u32::from_str_radix(digits, 16).ok()).unwrap_or(0);
    let [red, green, blue] = [1, 3, 5].map(|at| part(at).midpoint(255));
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// The edges of bars and their heights. Bars are as wide as the least distance between two of them; where the next one
/// is farther, a bar without height stands between.
fn bars(points: &[Point]) -> (Vec<f64>, Vec<f64>) {
    let mut sorted: Vec<Point> = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x));
    let steps = sorted.windows(2).map(|pair| pair[1].x - pair[0].x).filter(|step| *step > 0.0);
    let half = 0.5 * steps.fold(f64::INFINITY, f64::min);
    let half = if half.is_finite() { half } else { 0.5 };
    let (mut edges, mut counts) = (vec![sorted.first().map_or(0.0, |point| point.x - half)], Vec::new());
    for point in &sorted {
        let last = edges.last().copied().unwrap_or(0.0);
        if point.x - half > last + 1e-9 * half {
            edges.push(point.x - half);
            counts.push(0.0);
        }
        edges.push(point.x + half);
        counts.push(point.y);
    }
    (edges, counts)
}

fn of_contrasts(contrasts: &Contrasts) -> Scene {
    let mut forest = ForestPlot::new().with_color(colour(0)).with_null_value(0.0).with_show_null_line(true);
    for row in &contrasts.rows {
        forest = forest.with_row(&*row.name, row.value, row.interval[0], row.interval[1]);
    }
    let plots: Vec<Plot> = vec![forest.into()];
    let layout = Layout::auto_from_plots(&plots)
        .with_x_label(contrasts.x.label())
        .with_x_tick_format(ticks())
        .with_width(SIZE[0])
        .with_height(AROUND + ROW * contrasts.rows.len() as f64);
    render_multiple(plots, layout)
}

/// The numbers along an axis, as tables tell them.
fn ticks() -> TickFormat {
    TickFormat::Custom(Arc::new(rounded))
}
