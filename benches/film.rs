//! A film of the willow in its twelfth summer: a frame against the picture of its age, and each encoder against
//! drawing.
//!
//! Aims: a frame takes at most 1.1 times as long as drawing the picture, with its share of finding the place of the
//! camera; encoding a picture at most half as long as drawing it. `docs/performance.md` has the table.

use criterion::{Criterion, criterion_group, criterion_main};
use phytomer::config::{Resolved, validate};
use phytomer::outputs::films::{Apng, Encoder, Film, Gif, Palette, WebP, Y4m};
use phytomer::outputs::pictures::{Canvas, Picture, Survey, draw_framed, draw_stands};
use phytomer::run::picturing::pictured_plants;
use phytomer::run::regrowth::Regrowth;
use std::hint::black_box;

const SIZE: [u32; 2] = [1280, 720];
/// Two ages that follow each other, in summer, and the one that is drawn.
const AGES: [u32; 2] = [91, 92];

fn film(criterion: &mut Criterion) {
    let resolved: Resolved = validate("willow").map_err(|report| report.render(false)).expect("the willow ships");
    let regrowth = Regrowth::of(&resolved);
    let pictured = pictured_plants(&regrowth, &resolved.all_species(), &[0], &AGES).expect("it grows");
    let stands = pictured.stands(&[]);
    let style = Picture { size: SIZE, ..Picture::default() };
    let mut survey = Survey::new(&style, None);
    stands.iter().for_each(|stand| survey.add(stand));
    let framing = survey.framing().expect("two stands");
    let mut group = criterion.benchmark_group("film");
    group.sample_size(10);
    let last = std::slice::from_ref(&stands[1]);
    group.bench_function("the picture of an age", |b| b.iter(|| draw_stands(black_box(last), "", &style)));
    group
        .bench_function("a frame of that age", |b| b.iter(|| draw_framed(black_box(&stands[1]), "", &style, &framing)));
    group.bench_function("its share of the place of the camera", |b| {
        b.iter(|| {
            let mut survey = survey.clone();
            survey.add(black_box(&stands[1]));
            survey.framing()
        })
    });
    let canvases = [0, 1].map(|k| draw_framed(&stands[k], "", &style, &framing));
    let about = Film { size: SIZE, fps: 24, frames: 2, pictures: 2, note: String::new() };
    let mut encoder = |name: &str, begin: &dyn Fn() -> Box<dyn Encoder>| {
        group.bench_function(format!("{name}, the second of two pictures"), |b| {
            b.iter_custom(|rounds| (0..rounds).map(|_| second(&mut *begin(), &canvases)).sum());
        });
    };
    let palette = Palette::of(&canvases);
    encoder("WebP", &|| Box::new(WebP::new(&about, 80, Vec::new()).expect("it begins")));
    encoder("GIF", &|| Box::new(Gif::new(&about, palette.clone(), Vec::new()).expect("it begins")));
    encoder("APNG", &|| Box::new(Apng::new(&about, Vec::new())));
    encoder("Y4M", &|| Box::new(Y4m::new(&about, Vec::new()).expect("it begins")));
    group.finish();
}

/// The time that the second picture takes.
fn second(encoder: &mut dyn Encoder, canvases: &[Canvas; 2]) -> std::time::Duration {
    encoder.picture(&canvases[0], 3).expect("memory takes it");
    let begun = std::time::Instant::now();
    encoder.picture(&canvases[1], 3).expect("memory takes it");
    begun.elapsed()
}

criterion_group!(benches, film);
criterion_main!(benches);
