//! Which code makes the blocks of a stream: what this machine does fastest, found when the program runs.
//!
//! Every kernel makes the same words, so no result depends on the machine; tests compare each with `rand_chacha`. The
//! standard library asks the processor once and keeps the answer. Here stands the `unsafe` of calls of such code.

use super::Sought;
use super::block::{Block, Name, block};
#[cfg(target_arch = "x86_64")]
use super::x86::{avx2, avx512, sse2};

/// Code that makes blocks, which this machine can run: one is made by [`Kernel::all`] alone, or by [`Kernel::fastest`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kernel(Code);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Code {
    /// One block at a time, on any machine.
    #[cfg_attr(target_arch = "x86_64", allow(dead_code, reason = "other machines and the tests have it"))]
    Scalar,
    /// Four at once.
    #[cfg(target_arch = "x86_64")]
    Sse2,
    /// Eight at once.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Twelve at once.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Kernel {
    /// The fastest that this machine has.
    #[inline]
    pub fn fastest() -> Self {
        #[cfg(target_arch = "x86_64")]
        let code = if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
            Code::Avx512
        } else if is_x86_feature_detected!("avx2") {
            Code::Avx2
        } else {
            Code::Sse2
        };
        #[cfg(not(target_arch = "x86_64"))]
        let code = Code::Scalar;
        Self(code)
    }

    /// All that this machine has.
    #[cfg(test)]
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self(Code::Scalar)];
        #[cfg(target_arch = "x86_64")]
        {
            all.push(Self(Code::Sse2));
            all.extend(is_x86_feature_detected!("avx2").then_some(Self(Code::Avx2)));
            all.extend((!all.contains(&Self::fastest())).then(Self::fastest));
        }
        all
    }

    /// Makes a block each of two streams of one plant, where that takes as long as one.
    #[inline]
    #[allow(unsafe_code, reason = "calls of functions whose instructions not every machine has")]
    pub fn fill_two(self, of: [(&Name, u64); 2], blocks: [&mut Block; 2]) {
        debug_assert!(of[0].0.key == of[1].0.key);
        // SAFETY: as in `fill`.
        #[cfg(target_arch = "x86_64")]
        unsafe {
            match self.0 {
                Code::Avx512 => return avx512::two(of, blocks),
                Code::Avx2 => return avx2::two(of, blocks),
                Code::Scalar | Code::Sse2 => {}
            }
        }
        for ((name, counter), block) in of.into_iter().zip(blocks) {
            self.fill(name, counter, std::slice::from_mut(block));
        }
    }

    /// Makes blocks of many streams of the plant of `name`, whose own stream does not matter.
    #[allow(unsafe_code, reason = "calls of functions whose instructions not every machine has")]
    pub fn fill_apart(self, name: &Name, of: &[Sought], blocks: &mut [Block]) {
        assert_eq!(of.len(), blocks.len());
        // SAFETY: as in `fill`.
        #[cfg(target_arch = "x86_64")]
        unsafe {
            match self.0 {
                Code::Avx512 => return avx512::apart(name, of, blocks),
                Code::Avx2 => return avx2::apart(name, of, blocks),
                Code::Scalar | Code::Sse2 => {}
            }
        }
        for (of, block) in of.iter().zip(blocks) {
            let name = Name { stream: of.stream, ..name.clone() };
            self.fill(&name, of.block, std::slice::from_mut(block));
        }
    }

    /// Makes the blocks of a stream from block `counter` on, as many as `blocks` holds.
    #[inline]
    #[allow(unsafe_code, reason = "calls of functions whose instructions not every machine has")]
    pub fn fill(self, name: &Name, counter: u64, blocks: &mut [Block]) {
        if self.0 == Code::Scalar {
            return blocks.iter_mut().zip(counter..).for_each(|(into, counter)| *into = block(name, counter));
        }
        // SAFETY: all four are safe code without a pointer; a call asks only that the machine has their instructions.
        // SSE2 is part of x86-64 itself. `Code::Avx2` and `Code::Avx512` are made in `fastest` and `all` alone, after
        // the processor has said that it has them and the system that it keeps the registers; the type is private to
        // this file.
        #[cfg(target_arch = "x86_64")]
        unsafe {
            match (self.0, blocks) {
                (Code::Avx512, [one]) => avx512::one(name, counter, one),
                (_, [one]) => sse2::one(name, counter, one),
                (Code::Avx512, blocks) => avx512::fill(name, counter, blocks),
                (Code::Avx2, blocks) => avx2::fill(name, counter, blocks),
                (_, blocks) => sse2::fill(name, counter, blocks),
            }
        }
    }
}
