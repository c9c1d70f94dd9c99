//! Figs. 8 and 9 of Aono & Kunii 1984: what the leaves of Aucuba cover together, by its branching angles.
//!
//! `cargo run --release --example aucuba_angles [FOLDER]` writes `aucuba_leaves.svg` (Fig. 8: the same discs on a tree
//! of small and of large angles, from above) and `aucuba_angles.svg` (Fig. 9: the area against |h2| for h1 = 10, 20,
//! 25, 30 and 40°), into the folder for temporary files if none is given, and tells where the measured angles, 27° and
//! −37°, lie. The tree is GMT1 without a divergence, ratio .786, level 6 (their fit of Aucuba), first branch 1; its 64
//! tips bear equal discs. The paper gives no size of discs, and the curves depend on it: three are drawn. Absent: the
//! scan lines, which the paper used; areas are exact.

use anyhow::{Context, Result};
use phytomer::models::geometric::child;
use phytomer_measures::cover::{Direction, Disc, area};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Radii of discs, in lengths of the first branch.
const RADII: [f64; 3] = [0.1, 0.2, 0.4];
/// The angles h1 of the curves, degrees, with their colours, which the colour-blind tell apart.
const CURVES: [(f64, &str); 5] =
    [(10.0, "#0072b2"), (20.0, "#d55e00"), (25.0, "#009e73"), (30.0, "#cc79a7"), (40.0, "#000000")];
const MEASURED: [f64; 2] = [27.0, 37.0];
const RATIO: f64 = 0.786;
const LEVEL: u32 = 6;

/// The discs at the tips, from above, for h1 and |h2| in degrees.
fn discs(h1: f64, h2: f64, radius: f64) -> Vec<Disc> {
    let mut branches = vec![([0.0, 0.0, 1.0], [0.0, 0.0, 1.0])];
    for _ in 0..LEVEL {
        let children = |(tip, mother): ([f64; 3], [f64; 3])| {
            [h1, -h2].map(|angle| {
                let own = child(mother, RATIO, angle.to_radians(), 0.0);
                ([0, 1, 2].map(|i| tip[i] + own[i]), own)
            })
        };
        branches = branches.into_iter().flat_map(children).collect();
    }
    branches.into_iter().map(|(tip, _)| Direction::ABOVE.disc(tip, radius)).collect()
}

fn covered(h1: f64, h2: f64, radius: f64) -> f64 {
    area(&discs(h1, h2, radius))
}

/// The areas for |h2| = 0, 1 … 90°.
fn curve(h1: f64, radius: f64) -> Vec<f64> {
    (0..=90).map(|h2| covered(h1, f64::from(h2), radius)).collect()
}

fn main() -> Result<()> {
    let folder = std::env::args_os().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    for (name, text) in [("aucuba_leaves.svg", figure_8()), ("aucuba_angles.svg", figure_9())] {
        let path = folder.join(name);
        std::fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
        println!("{}", path.display());
    }
    println!(
        "\n  radius  all discs  at 27, -37  of the greatest at h1 = 27  which is at |h2|  rise a degree, 27-37 / 37-47"
    );
    for radius in RADII {
        let [h1, h2] = MEASURED;
        let (areas, here) = (curve(h1, radius), covered(h1, h2, radius));
        let (most, greatest) = areas.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        let rise = |from: usize| (areas[from + 10] - areas[from]) / (10.0 * greatest);
        println!(
            "  {radius:6}  {:9.3}  {here:10.3}  {:25.3}  {most:16}  {:.4} / {:.4}",
            64.0 * std::f64::consts::PI * radius * radius,
            here / greatest,
            rise(27),
            rise(37)
        );
    }
    println!(
        "\nThe paper says that the measured angles are near the greatest area. That holds for small discs, which hardly \
         overlap\n(92 % of the greatest at a radius of a tenth of the first branch), and not for larger ones (70 % and 66 % \
         at .2 and .4):\nthere the area still rises as fast beyond 37 degrees, and is greatest near 70."
    );
    Ok(())
}

const HEAD: &str = "font-family=\"sans-serif\" font-size=\"12\" xmlns=\"http://www.w3.org/2000/svg\"";

/// Two trees from above, the first with smaller angles.
fn figure_8() -> String {
    let mut svg = format!("<svg width=\"520\" height=\"620\" viewBox=\"0 0 520 620\" {HEAD}>\n");
    svg += "<rect width=\"520\" height=\"620\" fill=\"#ffffff\"/>\n";
    for (place, [h1, h2]) in [[15.0, 20.0], MEASURED].into_iter().enumerate() {
        let discs = discs(h1, h2, 0.2);
        let [own, all] = [area(&discs), discs.iter().map(|disc| disc.area()).sum()];
        let top = 300.0 * place as f64;
        for disc in &discs {
            let [x, y] = [260.0 + 70.0 * disc.centre[0], top + 150.0 - 70.0 * disc.centre[1]];
            let _ = writeln!(
                svg,
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\" fill=\"#009e73\" fill-opacity=\"0.35\" stroke=\"#004d38\"/>",
                70.0 * disc.radius
            );
        }
        let _ = writeln!(
            svg,
            "<text x=\"16\" y=\"{:.0}\">h1 = {h1}°, h2 = −{h2}°: {own:.3} of {all:.3} covered</text>",
            top + 24.0
        );
    }
    svg + "</svg>\n"
}

/// The curves, a panel a radius, with the measured angles marked.
fn figure_9() -> String {
    const SIDE: [f64; 2] = [300.0, 240.0];
    let mut svg = format!("<svg width=\"1080\" height=\"340\" viewBox=\"0 0 1080 340\" {HEAD}>\n");
    svg += "<rect width=\"1080\" height=\"340\" fill=\"#ffffff\"/>\n";
    for (panel, radius) in RADII.into_iter().enumerate() {
        let curves: Vec<Vec<f64>> = CURVES.iter().map(|(h1, _)| curve(*h1, radius)).collect();
        let top = 1.05 * curves.iter().flatten().copied().fold(0.0, f64::max);
        let left = 50.0 + 350.0 * panel as f64;
        let at = |h2: f64, area: f64| [left + SIDE[0] * h2 / 90.0, 40.0 + SIDE[1] * (1.0 - area / top)];
        let _ = writeln!(
            svg,
            "<text x=\"{left}\" y=\"24\">radius {radius}; of {:.2} in all</text>\n<path d=\"M{left} 40v{}h{}\" fill=\"none\" \
             stroke=\"#000000\"/>",
            64.0 * std::f64::consts::PI * radius * radius,
            SIDE[1],
            SIDE[0]
        );
        for tick in (0..=90).step_by(30) {
            let [x, y] = at(f64::from(tick), 0.0);
            let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{tick}</text>", y + 16.0);
        }
        for share in [0.5, 1.0] {
            let [x, y] = at(0.0, share * top);
            let text = share * top;
            let _ =
                writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text:.1}</text>", x - 4.0, y + 4.0);
        }
        for ((_, colour), areas) in CURVES.iter().zip(&curves) {
            let points = areas.iter().enumerate().map(|(h2, area)| at(h2 as f64, *area));
            let points: Vec<String> = points.map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
            let _ = writeln!(svg, "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\"/>", points.join(" "));
        }
        let [x, y] = at(MEASURED[1], covered(MEASURED[0], MEASURED[1], radius));
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4\" fill=\"none\" stroke=\"#d00000\" stroke-width=\"2\"/>"
        );
    }
    svg += "<text x=\"50\" y=\"318\">|h2|, degrees, against the area that the discs cover; h1 =";
    for (h1, colour) in CURVES {
        let _ = write!(svg, " <tspan fill=\"{colour}\" font-weight=\"bold\">{h1}°</tspan>");
    }
    svg + "; the ring is the measured (27°, −37°)</text>\n</svg>\n"
}
