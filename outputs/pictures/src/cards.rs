//! Crossed cards: four upright pictures of a plant in planes 45 degrees apart, so that each of eight sides faces one.
//!
//! Each picture is a parallel projection without light: the colours and the normals of what is seen, for an engine that
//! lights them. From a side one card is seen in full, its two neighbours at 45 degrees, and the fourth from its edge.
//! What the three cover together is to be what the plant covers from there. In an open crown the neighbours fill gaps;
//! so each card shows a little less than it might: its texels are shown from a rank on, which is high within what is
//! covered and low at edges and in loose twigs, and the four ranks are found by turns (Gauss-Seidel), each so that its
//! side has the area that the plant has. Opacity is the rank about that bound, half where it lies. Absent: light,
//! files.

use super::camera::Camera;
use super::film::{Film, Paint};
use super::gaze::Gaze;
use super::raster::{TOGETHER, UPRIGHT, Window};
use super::sides::{Apart, DRAWN, each_ball};
use glam::Vec3;
use phytomer_meshes::{Card, Cards, Mesh, Scene, linear};
use phytomer_sim::math::pow;
use png::ColorType;
use rayon::prelude::*;
use std::collections::VecDeque;
use std::f32::consts::FRAC_PI_4;

/// Texels along the longer side of a card, and free ones around it.
const TEXELS: u32 = 256;
const FREE: u32 = 4;
/// The texels to each side over which a rank looks around.
const AROUND: usize = 4;
/// How often the bounds are found anew.
const ROUNDS: usize = 12;
/// The difference of areas above which the bounds are sought together.
const MOST_APART: f64 = 0.01;
/// How far a bound is moved to see what that changes.
const MOVED: f64 = 8.0;
/// The steps of a bound that are tried at the end.
const STEPS: [f64; 6] = [-5.0, -2.0, -1.0, 1.0, 2.0, 5.0];
/// How often a step that makes nothing better is halved.
const HALVINGS: i32 = 5;
/// How fast opacity rises with the rank.
const STEEP: i32 = 4;
/// The least opacity, of 255, that is more than half.
const SHOWN: i32 = 128;

/// The pictures of a plant in the making.
struct Look {
    gazes: [Gaze; DRAWN],
    /// The line in which all cards cross, and the middle of their height.
    middle: Vec3,
    /// Half of the depth that is seen, metres.
    deep: f32,
    /// The texels of a card, and how many of them a metre has.
    size: [u32; 2],
    scale: f32,
}

/// The picture of a card.
struct Tile {
    /// For each texel the share of its samples that show the plant.
    covered: Vec<f32>,
    /// From which bound on it is not shown; 0 where it has nothing to show.
    rank: Vec<u8>,
    colours: Vec<[u8; 3]>,
    normals: Vec<[u8; 3]>,
}

/// The cards of a plant, and how far their outline is from that of the plant, from the eight sides; `None` where it
/// has no extent.
pub fn cards(scene: &Scene) -> Option<(Cards, Apart)> {
    let look = Look::around(scene)?;
    let tiles: Vec<Tile> = (0..DRAWN).map(|side| look.tile(scene, side)).collect();
    let by_turns = look.bounds(&tiles);
    let (mut bounds, mut apart) = (by_turns, look.apart(&tiles, &by_turns));
    if apart.area > MOST_APART {
        // The search card by card may end with some cards opaque and others empty.
        let together = look.bounds_together(&tiles);
        let found = look.apart(&tiles, &together);
        if found.area < apart.area {
            (bounds, apart) = (together, found);
        }
    }
    let (colours, normals) = look.atlas(&tiles, &bounds);
    let cards = (0..DRAWN).map(|side| look.card(side)).collect();
    Some((Cards { cards, colours, normals }, apart))
}

impl Look {
    fn around(scene: &Scene) -> Option<Self> {
        let gazes: [Gaze; DRAWN] = std::array::from_fn(|side| Gaze::towards(side as f32 * FRAC_PI_4, 0.0));
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        each_ball(scene, &mut |at, radius| (low, high) = (low.min(at - radius), high.max(at + radius)));
        let middle = 0.5 * (low + high);
        let (mut wide, mut deep) = (0.0_f32, 0.0_f32);
        each_ball(scene, &mut |at, radius| {
            let seen = at - middle;
            gazes.iter().for_each(|gaze| wide = wide.max(seen.dot(gaze.right).abs() + radius));
            deep = deep.max(seen.length() + radius);
        });
        let tall = 0.5 * (high.z - low.z);
        let longest = 2.0 * wide.max(tall);
        if !(longest > 0.0 && longest.is_finite()) {
            return None;
        }
        let scale = TEXELS as f32 / longest;
        let size = [wide, tall].map(|half| (2.0 * half * scale).ceil() as u32 + 2 * FREE);
        Some(Self { gazes, middle, deep, size, scale })
    }

    fn tile(&self, scene: &Scene, side: usize) -> Tile {
        let ([width, height], gaze) = (self.size, self.gazes[side]);
        let window = Window { columns: 0..width * TOGETHER, rows: 0..height * TOGETHER, shifts: UPRIGHT };
        let at = [self.middle.dot(gaze.right), self.middle.dot(gaze.up)];
        let along = self.middle.dot(gaze.forward);
        let centre = self.size.map(|side| 0.5 * (side * TOGETHER) as f32);
        let scale = self.scale * TOGETHER as f32;
        let camera = Camera::parallel(gaze, at, [along - self.deep, along + self.deep], scale, centre);
        let mut film = Film::default();
        film.clear(&window);
        for painting in [false, true] {
            (0..scene.blocks()).into_par_iter().for_each_init(Mesh::default, |mesh, block| {
                scene.block(block, mesh);
                expose(mesh, &camera, (&film, &window), painting);
            });
        }
        self.developed(&film, &window, gaze)
    }

    /// The texels of what a film has seen: the mean of the colours and of the normals that are seen in each.
    fn developed(&self, film: &Film, window: &Window, gaze: Gaze) -> Tile {
        let [width, height] = self.size;
        let samples = (TOGETHER * TOGETHER) as f32;
        let mut tile = Tile { covered: Vec::new(), rank: Vec::new(), colours: Vec::new(), normals: Vec::new() };
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let (mut light, mut normal, mut count) = (Vec3::ZERO, Vec3::ZERO, 0.0_f32);
            for (index, ..) in window.together(x * TOGETHER, y * TOGETHER) {
                let Some(seen) = film.seen(index) else { continue };
                light += Vec3::from_array(seen.paint.colour.map(|channel| linear(channel) as f32));
                // Both sides of a leaf are seen; its normal is that of the side that is.
                let out = seen.normal;
                normal += if out.dot(gaze.forward) > 0.0 { -out } else { out };
                count += 1.0;
            }
            let turned = Vec3::new(normal.dot(gaze.right), normal.dot(gaze.up), -normal.dot(gaze.forward));
            let turned = turned.try_normalize().unwrap_or(Vec3::Z);
            tile.covered.push(count / samples);
            tile.colours.push((light / count.max(1.0)).to_array().map(of_linear));
            tile.normals.push(turned.to_array().map(|x| (127.5 * x + 127.5 + 0.5).clamp(0.0, 255.0) as u8));
        }
        tile.rank = ranks(&tile.covered, width as usize);
        tile
    }

    /// Whether a side shows a texel, and whose: of its own card, or of a neighbour that is seen at 45 degrees.
    fn shows(&self, tiles: &[Tile], bounds: &[u8; DRAWN], side: usize, [x, y]: [u32; 2]) -> bool {
        let [width, _] = self.size;
        let own = (y * width + x) as usize;
        if tiles[side].rank[own] > bounds[side] {
            return true;
        }
        let from_middle = x as f32 + 0.5 - 0.5 * width as f32;
        [1, DRAWN - 1].into_iter().any(|turn| {
            let other = (side + turn) % DRAWN;
            let narrowed = self.gazes[other].right.dot(self.gazes[side].right);
            let at = from_middle / narrowed + 0.5 * width as f32;
            let inside = (0.0..width as f32).contains(&at);
            inside && tiles[other].rank[(y * width + at as u32) as usize] > bounds[other]
        })
    }

    /// The texels that a side shows.
    fn area(&self, tiles: &[Tile], bounds: &[u8; DRAWN], side: usize) -> u32 {
        let [width, height] = self.size;
        let of_row = |y: u32| (0..width).filter(|x| self.shows(tiles, bounds, side, [*x, y])).count() as u32;
        (0..height).into_par_iter().map(of_row).sum()
    }

    /// The bounds with which each side shows the area that the plant covers from there.
    fn bounds(&self, tiles: &[Tile]) -> [u8; DRAWN] {
        let mut bounds = [0_u8; DRAWN];
        let wanted: Vec<u32> = tiles.iter().map(|tile| tile.covered.iter().sum::<f32>().round() as u32).collect();
        for _ in 0..ROUNDS {
            for side in 0..DRAWN {
                let mut with = |bound: u8| {
                    bounds[side] = bound;
                    self.area(tiles, &bounds, side)
                };
                // The least bound that shows no more than it should.
                let (mut low, mut high) = (0_u8, u8::MAX);
                while low < high {
                    let bound = low.midpoint(high);
                    if with(bound) <= wanted[side] { high = bound } else { low = bound + 1 }
                }
                let before = high.saturating_sub(1);
                let nearer = with(before).abs_diff(wanted[side]) < with(high).abs_diff(wanted[side]);
                bounds[side] = if nearer { before } else { high };
            }
        }
        bounds
    }

    /// The bounds with which each side shows the area that the plant covers from there, sought together from one common
    /// bound by Newton's method, each step as short as it must be to come nearer.
    fn bounds_together(&self, tiles: &[Tile]) -> [u8; DRAWN] {
        let wanted: [f64; DRAWN] =
            std::array::from_fn(|side| f64::from(tiles[side].covered.iter().sum::<f32>().max(1.0)));
        let whole = |bounds: [f64; DRAWN]| bounds.map(|bound| bound.round().clamp(0.0, 255.0) as u8);
        let off = |bounds: [f64; DRAWN]| -> [f64; DRAWN] {
            std::array::from_fn(|side| f64::from(self.area(tiles, &whole(bounds), side)) / wanted[side] - 1.0)
        };
        let worst = |off: [f64; DRAWN]| off.iter().fold(0.0_f64, |worst, off| worst.max(off.abs()));
        let (mut low, mut high) = (0.0, 255.0);
        while high - low > 1.0 {
            let middle = 0.5 * (low + high);
            if off([middle; DRAWN]).iter().sum::<f64>() > 0.0 { low = middle } else { high = middle }
        }
        let mut bounds = [high; DRAWN];
        for _ in 0..ROUNDS {
            let now = off(bounds);
            let slopes: [[f64; DRAWN]; DRAWN] = std::array::from_fn(|moved| {
                let by = if bounds[moved] > 128.0 { -MOVED } else { MOVED };
                let mut beside = bounds;
                beside[moved] += by;
                let beside = off(beside);
                std::array::from_fn(|side| (beside[side] - now[side]) / by)
            });
            let Some(step) = solved(&slopes, now) else { break };
            let shorter = (0..=HALVINGS).map(|halving| {
                let part = 1.0 / f64::from(1 << halving);
                std::array::from_fn(|side| (bounds[side] - part * step[side]).clamp(0.0, 255.0))
            });
            let Some(nearer) = shorter.into_iter().find(|tried| worst(off(*tried)) < worst(now)) else { break };
            bounds = nearer;
        }
        // Ranks are whole numbers, so that the last steps are tried one by one.
        let mut found = (worst(off(bounds)), whole(bounds).map(f64::from));
        for _ in 0..ROUNDS {
            let steps = (0..DRAWN).flat_map(|side| STEPS.map(|step| (side, step)));
            let tried = steps.map(|(side, step)| {
                let mut bounds = found.1;
                bounds[side] = (bounds[side] + step).clamp(0.0, 255.0);
                (worst(off(bounds)), bounds)
            });
            let best = tried.min_by(|one, other| one.0.total_cmp(&other.0)).filter(|best| best.0 < found.0);
            let Some(best) = best else { break };
            found = best;
        }
        whole(found.1)
    }

    /// How far the outlines are, from the side where they are farthest.
    fn apart(&self, tiles: &[Tile], bounds: &[u8; DRAWN]) -> Apart {
        let [width, height] = self.size;
        let mut apart = Apart::default();
        for (side, tile) in tiles.iter().enumerate() {
            let (mut all, mut own, mut either) = (0.0_f64, 0.0_f64, 0.0_f64);
            for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
                let covered = f64::from(tile.covered[(y * width + x) as usize]);
                let shown = f64::from(u8::from(self.shows(tiles, bounds, side, [x, y])));
                (all, own, either) = (all + covered, own + shown, either + (shown - covered).abs());
            }
            let all = all.max(1.0);
            apart.area = apart.area.max((own - all).abs() / all);
            apart.either = apart.either.max(either / all);
        }
        apart
    }

    fn card(&self, side: usize) -> Card {
        let (gaze, size) = (self.gazes[side], self.size.map(|side| side as f32));
        let half = size.map(|side| 0.5 * side / self.scale);
        let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let corner = |[x, y]: [f32; 2]| self.middle + x * half[0] * gaze.right + y * half[1] * gaze.up;
        let place = [side % 2, side / 2];
        // The first two stand in the upper half of the atlas.
        let texture = |[x, y]: [f32; 2]| {
            [0.5 * (place[0] as f32 + 0.5 * (x + 1.0)), 0.5 * (1.0 - place[1] as f32 + 0.5 * (y + 1.0))]
        };
        Card {
            corners: signs.map(|sign| corner(sign).to_array()),
            normal: (-gaze.forward).to_array(),
            texture: signs.map(texture),
        }
    }

    /// The atlas: colours with opacity, and normals, as PNG files.
    fn atlas(&self, tiles: &[Tile], bounds: &[u8; DRAWN]) -> (Vec<u8>, Vec<u8>) {
        let [width, height] = self.size.map(|side| side as usize);
        let mut colours = vec![[0_u8; 4]; 4 * width * height];
        let mut normals = vec![[0_u8; 3]; 4 * width * height];
        for (side, tile) in tiles.iter().enumerate() {
            let filled = beyond(&tile.covered, width);
            for (texel, from) in filled.into_iter().enumerate() {
                let [x, y] = [side % 2 * width + texel % width, side / 2 * height + texel / width];
                let [red, green, blue] = tile.colours[from];
                let above = i32::from(tile.rank[texel]) - i32::from(bounds[side]);
                let opacity = if tile.rank[texel] > 0 { (SHOWN + STEEP * (above - 1)).clamp(0, 255) } else { 0 };
                colours[y * 2 * width + x] = [red, green, blue, opacity as u8];
                normals[y * 2 * width + x] = tile.normals[from];
            }
        }
        let size = self.size.map(|side| 2 * side);
        (png_of(size, ColorType::Rgba, &colours.concat()), png_of(size, ColorType::Rgb, &normals.concat()))
    }
}

/// The factors of columns whose sum is a vector, by elimination with the largest pivots; `None` where there are none.
fn solved(columns: &[[f64; DRAWN]; DRAWN], sum: [f64; DRAWN]) -> Option<[f64; DRAWN]> {
    // A row for each equation, with its sum at the end.
    let row = |row: usize| std::array::from_fn(|k| if k < DRAWN { columns[k][row] } else { sum[row] });
    let mut rows: [[f64; DRAWN + 1]; DRAWN] = std::array::from_fn(row);
    for pivot in 0..DRAWN {
        let largest = (pivot..DRAWN).max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()))?;
        rows.swap(pivot, largest);
        let of = rows[pivot];
        if of[pivot].abs() < 1e-9 {
            return None;
        }
        for (_, row) in rows.iter_mut().enumerate().filter(|(place, _)| *place != pivot) {
            let times = row[pivot] / of[pivot];
            (0..=DRAWN).for_each(|k| row[k] -= times * of[k]);
        }
    }
    Some(std::array::from_fn(|k| rows[k][DRAWN] / rows[k][k]))
}

/// Draws a mesh on a film: the depths, then what is nearest.
fn expose(mesh: &Mesh, camera: &Camera, (film, window): (&Film, &Window), painting: bool) {
    for face in &mesh.faces {
        let corners = face.indices().map(|corner| &mesh.vertices[corner as usize]);
        let seen = corners.map(|vertex| camera.project(Vec3::from_array(vertex.position())));
        let [Some(a), Some(b), Some(c)] = seen else { continue };
        if !painting {
            film.deepen(&[a, b, c], window);
            continue;
        }
        film.paint(&[a, b, c], window, || {
            let [red, green, blue, _] = corners[0].tag().colour;
            let paint = Paint { colour: [red, green, blue], ..Paint::default() };
            (corners.map(|vertex| Vec3::from_array(vertex.normal())), paint)
        });
    }
}

/// The rank of each texel: high where it and what is around it is covered.
fn ranks(covered: &[f32], width: usize) -> Vec<u8> {
    let height = covered.len() / width;
    let around = |at: usize, most: usize| at.saturating_sub(AROUND)..(at + AROUND + 1).min(most);
    let rows: Vec<f32> = (0..covered.len())
        .map(|texel| around(texel % width, width).map(|x| covered[texel / width * width + x]).sum())
        .collect();
    let whole = ((2 * AROUND + 1) * (2 * AROUND + 1)) as f32;
    let rank = |texel: usize| {
        let near: f32 = around(texel / width, height).map(|y| rows[y * width + texel % width]).sum();
        let rank = 255.0 * (0.5 * covered[texel] + 0.5 * near / whole);
        if covered[texel] > 0.0 { rank.clamp(1.0, 255.0) as u8 } else { 0 }
    };
    (0..covered.len()).map(rank).collect()
}

/// For each texel the nearest that shows something, or nearly: itself where it does.
fn beyond(covered: &[f32], width: usize) -> Vec<usize> {
    const NONE: usize = usize::MAX;
    let mut from: Vec<usize> =
        covered.iter().enumerate().map(|(texel, share)| if *share > 0.0 { texel } else { NONE }).collect();
    let mut waiting: VecDeque<usize> = (0..covered.len()).filter(|texel| from[*texel] != NONE).collect();
    while let Some(texel) = waiting.pop_front() {
        let (x, beside) = (texel % width, [texel.wrapping_sub(width), texel + width]);
        let left = (x > 0).then(|| texel - 1);
        let right = (x + 1 < width).then(|| texel + 1);
        for next in beside.into_iter().chain(left).chain(right).filter(|next| *next < covered.len()) {
            if from[next] == NONE {
                from[next] = from[texel];
                waiting.push_back(next);
            }
        }
    }
    from.into_iter().enumerate().map(|(texel, found)| if found == NONE { texel } else { found }).collect()
}

/// A channel as screens take it (sRGB, IEC 61966-2-1) of one in linear light.
fn of_linear(light: f32) -> u8 {
    let light = f64::from(light);
    let root = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * pow(light, 1.0 / 2.4) - 0.055 };
    (255.0 * root + 0.5).clamp(0.0, 255.0) as u8
}

/// A PNG file in memory.
fn png_of(size: [u32; 2], colour: ColorType, bytes: &[u8]) -> Vec<u8> {
    let written = phytomer_png::file(size, colour, bytes);
    debug_assert!(written.is_ok(), "as many bytes as the size asks for");
    written.unwrap_or_default()
}
