//! A voxel and the four beams that may cross it, in the registers of machines that hold four numbers in one.
//!
//! Each number is found by the same sums and products, in the same order, as in `sweep` and `loss`: no instruction
//! joins a product and a sum, so no digit differs from those of other machines, and a test compares all of them. No
//! pointer is used: registers become numbers by `bytemuck`. Absent: which beams they are, and other machines (`sweep`).

use super::loss::{MIDDLE, SERIES, lost};
use bytemuck::cast;
use std::arch::x86_64::*;

/// Four numbers.
type Four = [f64; 4];

/// How the beams of a source pass a voxel: by how much a beam comes later to the middle between each pair of faces for
/// each edge that it lies aside, and above; and half the way between each pair of faces; metres.
pub type Faces = [[f64; 3]; 3];

/// The ways in a voxel, metres, of four beams, each by its place: the first two and the others, a row each, lie so far
/// aside from its middle and above it.
#[inline]
#[target_feature(enable = "avx2")]
pub fn ways(faces: &Faces, at: [[f64; 2]; 4], [aside, above]: [[f64; 2]; 2]) -> Four {
    // Two beams of one place each, then their parts apart: the first beams of both rows, and the second ones.
    let two = |at: [f64; 2]| _mm_set_pd(at[1], at[0]);
    let (first, second) = (_mm256_set_m128d(two(at[2]), two(at[0])), _mm256_set_m128d(two(at[3]), two(at[1])));
    let from = _mm256_set_pd(aside[1] + 1.0, aside[1], aside[0] + 1.0, aside[0]);
    let aside = _mm256_add_pd(_mm256_unpacklo_pd(first, second), from);
    let from = _mm256_set_pd(above[1], above[1], above[0], above[0]);
    let above = _mm256_add_pd(_mm256_unpackhi_pd(first, second), from);
    let stretch = |[by_aside, by_above, half]: [f64; 3]| {
        let middle = _mm256_add_pd(
            _mm256_mul_pd(aside, _mm256_set1_pd(by_aside)),
            _mm256_mul_pd(above, _mm256_set1_pd(by_above)),
        );
        let half = _mm256_set1_pd(half);
        (_mm256_sub_pd(middle, half), _mm256_add_pd(middle, half))
    };
    let [(a, d), (b, e), (c, f)] = [stretch(faces[0]), stretch(faces[1]), stretch(faces[2])];
    let enters = _mm256_max_pd(_mm256_max_pd(a, b), c);
    let leaves = _mm256_min_pd(_mm256_min_pd(d, e), f);
    cast(_mm256_max_pd(_mm256_sub_pd(leaves, enters), _mm256_setzero_pd()))
}

/// The shares that are lost of four beams on ways through this extinction.
#[inline]
#[target_feature(enable = "avx2")]
pub fn lost_on(ways: Four, k: f64) -> Four {
    cast(lost_of(_mm256_mul_pd(cast(ways), _mm256_set1_pd(k))))
}

/// What is lost of four beams on ways through x.
#[inline]
#[target_feature(enable = "avx2")]
fn lost_of(x: __m256d) -> __m256d {
    let is_small = _mm256_cmp_pd::<_CMP_LT_OQ>(x, _mm256_set1_pd(MIDDLE));
    if _mm256_movemask_pd(is_small) != 0b1111 {
        return cast(cast::<_, Four>(x).map(lost));
    }
    let x = _mm256_mul_pd(x, _mm256_set1_pd(0.0625));
    let term = |k: usize| _mm256_set1_pd(SERIES[k]);
    let pair = |k: usize| _mm256_add_pd(term(k), _mm256_mul_pd(x, term(k + 1)));
    let square = _mm256_mul_pd(x, x);
    let fourth = _mm256_mul_pd(square, square);
    let low = _mm256_add_pd(pair(0), _mm256_mul_pd(square, pair(2)));
    let high = _mm256_add_pd(pair(4), _mm256_mul_pd(square, pair(6)));
    let mut lost = _mm256_mul_pd(x, _mm256_add_pd(low, _mm256_mul_pd(fourth, high)));
    for _ in 0..4 {
        lost = _mm256_mul_pd(lost, _mm256_sub_pd(_mm256_set1_pd(2.0), lost));
    }
    lost
}

/// Lets a voxel with this extinction keep of four beams, by the light of each, its way and the share that it loses: the
/// sums of `Beams::cross`, and what is left of each.
#[inline]
#[target_feature(enable = "avx2")]
pub fn leave(light: Four, ways: Four, lost: Four, k: f64) -> ([f64; 2], f64, Four) {
    let (light, ways): (__m256d, __m256d) = (cast(light), cast(ways));
    if k <= 0.0 {
        return ([sum(_mm256_mul_pd(ways, light)), sum(ways)], 0.0, [0.0; 4]);
    }
    let lost = _mm256_mul_pd(light, cast(lost));
    let all = sum(lost);
    ([all / k, sum(ways)], all, cast(_mm256_sub_pd(light, lost)))
}

/// The sum of four numbers: of the first and the third, and of the others.
#[inline]
#[target_feature(enable = "avx2")]
fn sum(of: __m256d) -> f64 {
    let pairs = _mm_add_pd(_mm256_castpd256_pd128(of), _mm256_extractf128_pd::<1>(of));
    let [one, other]: [f64; 2] = cast(pairs);
    one + other
}
