use phytomer_config::validate_species;
use phytomer_sim::{Plot, RecordError, Recorder, Tick, grow, mechanics::*, plant::Seed, pose::pose};
use std::time::Instant;
struct None_;
impl Recorder for None_ {
    fn wants(&self, _: Tick) -> bool {
        false
    }
    fn record(&mut self, _: Tick, _: &Plot) -> Result<(), RecordError> {
        Ok(())
    }
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let until: u32 = args[2].parse().unwrap();
    let species = match validate_species(&args[1], until) {
        Ok(s) => s,
        Err(r) => {
            println!("{}", r.render(false));
            return;
        }
    };
    let seed = Seed { plant: 0, run_seed: 1988, component_limit: u32::MAX, keep_events: true };
    let mut plot = Plot::of_one(species.model.as_ref(), &seed);
    let t = Instant::now();
    grow(species.model.as_ref(), &mut plot, until, &mut None_).unwrap();
    println!(
        "grow with bending {:?} nodes {} axes {}",
        t.elapsed(),
        plot.plants[0].nodes.len(),
        plot.plants[0].axes.len()
    );
    let n = plot.plants[0].nodes.len() as f64;
    for e in plot.plants[0].events.as_ref().unwrap().iter().filter(|e| e.kind as u8 >= 11) {
        println!("{e:?}");
    }
    let mut rest = plot.plants[0].clone();
    for _ in 0..3 {
        rest.frames.clear();
        let t = Instant::now();
        pose(&mut rest);
        let p = t.elapsed().as_secs_f64();
        let t = Instant::now();
        plot.plants[0].strain.curvature.fill([0.0; 2]);
        plot.plants[0].strain.moment.fill([0.0; 2]);
        let o = bend(&mut plot.plants[0], until, &plot.site, &mut plot.bench);
        let b = t.elapsed().as_secs_f64();
        let t = Instant::now();
        let o2 = bend(&mut plot.plants[0], until, &plot.site, &mut plot.bench);
        let b2 = t.elapsed().as_secs_f64();
        println!(
            "pose {:.1} M/s; bend {:?} {:.1} x pose, {:.2} a step; again {:?} {:.1} x",
            n / p / 1e6,
            o,
            b / p,
            b / p / f64::from(o.steps),
            o2,
            b2 / p
        );
    }
}
