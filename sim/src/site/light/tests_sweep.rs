//! The light that voxels find by asking the beams that cross them, against the same beams followed one by one.

use super::beam::{self, Shone};
use super::grid::Grid;
use super::shadow::Shadows;
use super::wanted::Wanted;
use super::{Borders, Lighting, Piece, Sky, Source, sweep};

/// Leaves and buds in heaps about some places near and far, on either side of the corner of the plot.
fn grid(lighting: &Lighting) -> Grid {
    let mut grid = Grid::of(lighting);
    for k in 0..3_000_u32 {
        let part = |prime: u32| f64::from(k.wrapping_mul(prime) % 1_009) / 1_009.0;
        let heap = f64::from(k % 5);
        let place = [2.2 * heap - 4.0 + part(7), -1.7 * heap + 1.5 * part(11), 0.3 * heap + 1.3 * part(13) - 0.4];
        let area = 0.002 * (1.0 + f64::from(k % 5 * k % 97));
        if k % 7 == 0 { grid.mark(place) } else { grid.add(&Piece { place, normal: [0.0, 0.0, 1.0], area }) }
    }
    grid.sort();
    grid
}

fn near(one: f64, other: f64, of: f64) -> bool {
    (one - other).abs() <= 1e-11 * of
}

/// Also along the axes and straight down, where beams run between the same faces all the way.
#[test]
fn voxels_find_what_beams_leave_in_them() {
    let lighting = Lighting { voxel_m: 0.13, ..Lighting::default() };
    let grid = grid(&lighting);
    let wanted = Wanted::of(&grid);
    let of_unit = 0.5 / super::grid::UNITS / grid.volume();
    let extinction: Vec<f64> =
        wanted.indices().iter().map(|index| grid.area[*index as usize] as f64 * of_unit).collect();
    let shadows = Shadows::of(&[], Borders::Open, [0.0; 3]);
    let mut sources = Sky { rings: 4, azimuths: 7, ..Sky::default() }.sources();
    for towards in [[0.0, 0.0, 1.0], [0.8, 0.0, 0.6], [0.0, -0.8, 0.6]] {
        sources.push(Source { towards, weight: 1.0 });
    }
    for source in sources {
        let asked = sweep::shine(&grid, &wanted, &extinction, &source, Vec::new());
        let followed = beam::shine(&grid, (&wanted, &extinction), &shadows, &source, Vec::new());
        let (mut met, edge) = (0, lighting.voxel_m);
        for (one, other) in asked.along.iter().zip(&followed.along) {
            assert!(near(one[0], other[0], edge) && near(one[1], other[1], edge), "{source:?}: {one:?} {other:?}");
            met += usize::from(one[1] > 0.0);
        }
        assert!(met * 10 > 9 * wanted.count(), "{source:?}: {met} of {}", wanted.count());
        let kept = |shone: &Shone| shone.balance.kept;
        assert!(near(kept(&asked), kept(&followed), kept(&followed)) && kept(&asked) > 0.5);
        // Whatever registers the machine has, also where leaves are so dense that exponentials are needed.
        for factor in [1.0, 400.0] {
            let dense: Vec<f64> = extinction.iter().map(|k| k * factor).collect();
            // Memory that has held other light does not show.
            let asked = sweep::shine(&grid, &wanted, &dense, &source, vec![[f64::NAN; 2]; 7]);
            let by_pairs = sweep::shine_by_pairs(&grid, &wanted, &dense, &source, vec![[2.0; 2]; 100_000]);
            assert_eq!(asked.along, by_pairs.along, "{source:?}");
            assert_eq!(asked.balance, by_pairs.balance, "{source:?}");
        }
        let balance = asked.balance;
        assert!(near(balance.sent, balance.kept + balance.passed, balance.sent), "{balance:?}");
    }
}
