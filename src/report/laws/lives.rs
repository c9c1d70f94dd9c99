//! The lives of apical buds as far as their mortality goes: grown buds, the law, and measured axes.
//!
//! A bud that ends by anything else, or lives at the end of the run, is censored. Absent: axes with all that they bear
//! (`axis-life`), whose buds may live on.

use super::{Axes, LEVEL, Told, law, stated};
use phytomer_fits::data::Data;
use phytomer_fits::mortality::Observed;
use phytomer_measures::proportion::wilson;
use phytomer_measures::survival::{Curve, Fate, Lives, kaplan_meier};
use phytomer_reports::{Axis, Mark, Point, Series};

pub fn tell(axes: &Axes, grown: &Lives, told: &mut Told) {
    let measured: Vec<(&str, Vec<Point>)> = axes.measured().filter_map(points_of).collect();
    let Ok(curve) = kaplan_meier(grown, LEVEL) else { return };
    if grown.ended() == 0 && measured.is_empty() {
        told.words.push(format!("No apical bud of {} died of mortality, of {}.", axes.name, grown.len()));
        return;
    }
    let last = curve.steps.last().map_or(0, |step| step.ticks);
    let farthest = measured.iter().flat_map(|(_, points)| points).fold(0.0_f64, |far, point| far.max(point.x));
    let mut series = vec![Series { name: "grown".to_owned(), mark: Mark::Steps, points: of_curve(&curve) }];
    match axes.stated(|number, order, _| stated::survival(number, order, last.max(farthest.min(1e5) as u32))) {
        Ok(alive) => {
            let points = alive.iter().enumerate().map(|(tick, share)| (tick as f64, *share));
            series.push(Series { mark: Mark::DashedSteps, ..law(points) });
        }
        Err(why) => {
            told.words.push(format!("Lives of apical buds of {}: the law is not drawn, for {why}.", axes.name));
        }
    }
    for (file, points) in measured {
        series.push(Series { name: format!("measured, {file}"), mark: Mark::Points, points });
    }
    let title = format!("Lives of apical buds of {}", axes.name);
    let words: Vec<String> = series
        .iter()
        .filter_map(|series| {
            series.points.last().map(|of| format!("{}: {:.3} after {} ticks", series.name, of.y, of.x))
        })
        .collect();
    let text = [
        title.clone(),
        format!(
            "Kaplan–Meier estimate of {} buds, {} of which died of mortality; other ends censor. The numbers have intervals of \
             plants; measured axes have Wilson's or Greenwood's, as if they were independent.",
            grown.len(),
            grown.ended()
        ),
        format!("{title}: the share alive. {}.", words.join("; ")),
    ];
    let across = Axis::of("time since the birth of the axis", "ticks");
    told.figure(format!("lives-{}", axes.id), text, [across, Axis::of("share of apical buds alive", "")], series);
}

fn of_curve(curve: &Curve) -> Vec<Point> {
    let steps = curve.steps.iter().filter(|step| step.ticks > 0).map(|step| Point {
        interval: step.interval.map(|interval| [interval.low, interval.high]),
        ..Point::at(f64::from(step.ticks), step.survival)
    });
    [Point::at(0.0, 1.0)].into_iter().chain(steps).collect()
}

fn points_of(of: &super::Measured) -> Option<(&str, Vec<Point>)> {
    let Data::Mortality(observed) = &of.data else { return None };
    let points = match observed {
        Observed::SeenOnce(ages) => ages
            .iter()
            .map(|seen| {
                let alive = seen.axes - seen.dead;
                let interval = wilson(alive as u64, seen.axes as u64, LEVEL).ok();
                Point { interval: interval.map(|of| [of.low, of.high]), ..Point::at(seen.age, alive / seen.axes) }
            })
            .collect(),
        Observed::Followed(axes) => {
            let mut lives = Lives::default();
            for (number, axis) in (0..).zip(axes) {
                lives.add(number, axis.age as u32, if axis.died { Fate::Ended(0) } else { Fate::Censored });
            }
            let curve = kaplan_meier(&lives, LEVEL).ok()?;
            of_curve(&curve).into_iter().skip(1).collect()
        }
    };
    Some((of.file.as_str(), points))
}
