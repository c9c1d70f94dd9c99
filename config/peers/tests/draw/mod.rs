//! Numbers for tests that break files of other programs: the same for one seed on every machine.
//!
//! Splitmix64 (Steele, Lea & Flood 2014) is enough to choose among places and values. Absent: what is drawn, which each
//! test says.

/// A source of numbers; its seed.
pub struct Draw(pub u64);

impl Draw {
    /// A whole number below `n`; 0 where `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    }
}
