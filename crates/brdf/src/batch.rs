//! Many elements at once: functions of the crate over slices, one slice a component (structure of arrays).
//!
//! [`Simd::best`] asks the CPU once which vectors it has; [`Simd::run`] then computes any [`Kernel`]: a function over
//! [`Real`] from `I` numbers to `O` numbers. [`kernels`] has those of the common lobes, with names for their slices.
//! No allocation. Any length; the last, partial block is computed in a padded copy.
//!
//! ```
//! use halfvector_brdf::batch::{Kernel, Simd};
//! use halfvector_brdf::{Real, ggx::d_ggx};
//!
//! struct D;
//! impl Kernel<3, 1> for D {
//!     #[inline(always)]
//!     fn call<R: Real>(&self, [n_dot_h, sin2_theta_h, alpha]: [R; 3]) -> [R; 1] {
//!         [d_ggx(n_dot_h, sin2_theta_h, alpha)]
//!     }
//! }
//! let (n_dot_h, sin2_theta_h, alpha) = ([1.0, 0.8, 0.6], [0.0, 0.36, 0.64], [0.25; 3]);
//! let mut d = [0.0; 3];
//! Simd::best().run(&D, [&n_dot_h, &sin2_theta_h, &alpha], [&mut d])?;
//! assert!((d[0] - 5.093).abs() < 1e-3);
//! # Ok::<(), halfvector_brdf::batch::LengthMismatch>(())
//! ```

use crate::Real;
use crate::lanes::Lane;

pub mod kernels;

/// Elements of a block, two vectors: longer ones run out of registers, shorter ones cannot hide latency.
const BASELINE_BLOCK: usize = 8;
#[cfg(target_arch = "x86_64")]
const AVX2_BLOCK: usize = 16;
#[cfg(target_arch = "x86_64")]
const AVX512_BLOCK: usize = 32;

/// Whether the instruction sets that every build for this target may use have a fused multiply-add.
const BASELINE_FUSED: bool = cfg!(any(target_arch = "aarch64", target_feature = "fma"));

/// A function that can be computed in lanes.
pub trait Kernel<const I: usize, const O: usize> {
    /// One element. Mark it `#[inline(always)]`: what is not inlined is not widened.
    fn call<R: Real>(&self, input: [R; I]) -> [R; O];
}

/// Slices of one call that are not of one length. Nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{kind} {index} of the batch has {found} elements, but the first output has {expected}: give all slices one length"
)]
pub struct LengthMismatch {
    /// "input" or "output".
    pub kind: &'static str,
    /// Which of them, from 0, in the order of the call's arguments.
    pub index: usize,
    /// Its length.
    pub found: usize,
    /// The length of the first output.
    pub expected: usize,
}

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// What every machine of the target has: SSE2 on x86-64, NEON on aarch64.
    Baseline,
    /// 8 lanes and fused multiply-add: x86-64-v3.
    Avx2,
    /// 16 lanes: x86-64-v4.
    Avx512,
}

/// The vector instructions that batches use.
#[derive(Clone, Copy, Debug)]
pub struct Simd {
    arch: Arch,
}

#[derive(Clone, Copy, Debug)]
enum Arch {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
}

impl Simd {
    /// The widest that this machine has.
    pub fn best() -> Self {
        [Level::Avx512, Level::Avx2].into_iter().find_map(Self::at).unwrap_or(Self { arch: Arch::Baseline })
    }

    /// Those of a level, or `None` where the machine lacks them: for measuring, and for results that do not depend on the
    /// machine (a fused multiply-add rounds once, so levels differ in the last digits).
    pub fn at(level: Level) -> Option<Self> {
        let arch = match level {
            Level::Baseline => Some(Arch::Baseline),
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => pulp::x86::V3::try_new().map(Arch::Avx2),
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => pulp::x86::V4::try_new().map(Arch::Avx512),
            #[cfg(not(target_arch = "x86_64"))]
            _ => None,
        };
        arch.map(|arch| Self { arch })
    }

    /// Which it is.
    pub fn level(self) -> Level {
        match self.arch {
            Arch::Baseline => Level::Baseline,
            #[cfg(target_arch = "x86_64")]
            Arch::Avx2(_) => Level::Avx2,
            #[cfg(target_arch = "x86_64")]
            Arch::Avx512(_) => Level::Avx512,
        }
    }

    /// Computes `kernel` for each element: `outputs[o][i]` from `inputs[..][i]`.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless all slices have the length of the first output. No length is too short, 0 included.
    pub fn run<K: Kernel<I, O>, const I: usize, const O: usize>(
        self,
        kernel: &K,
        inputs: [&[f32]; I],
        outputs: [&mut [f32]; O],
    ) -> Result<(), LengthMismatch> {
        let expected = outputs.first().map_or(0, |o| o.len());
        let lengths = inputs.iter().map(|s| s.len()).enumerate().map(|(i, n)| ("input", i, n));
        let lengths = lengths.chain(outputs.iter().map(|s| s.len()).enumerate().map(|(i, n)| ("output", i, n)));
        for (kind, index, found) in lengths {
            if found != expected {
                return Err(LengthMismatch { kind, index, found, expected });
            }
        }
        match self.arch {
            Arch::Baseline => {
                blocks::<BASELINE_FUSED, false, BASELINE_BLOCK, K, I, O>(kernel, inputs, outputs, expected)
            }
            #[cfg(target_arch = "x86_64")]
            Arch::Avx2(v3) => {
                v3.vectorize(Job::<_, false, AVX2_BLOCK, _, _> { kernel, inputs, outputs, len: expected })
            }
            #[cfg(target_arch = "x86_64")]
            Arch::Avx512(v4) => {
                v4.vectorize(Job::<_, true, AVX512_BLOCK, _, _> { kernel, inputs, outputs, len: expected })
            }
        }
        Ok(())
    }
}

/// What `pulp` compiles once for each instruction set.
#[cfg(target_arch = "x86_64")]
struct Job<'a, K, const WIDE: bool, const BLOCK: usize, const I: usize, const O: usize> {
    kernel: &'a K,
    inputs: [&'a [f32]; I],
    outputs: [&'a mut [f32]; O],
    len: usize,
}

#[cfg(target_arch = "x86_64")]
impl<K: Kernel<I, O>, const WIDE: bool, const BLOCK: usize, const I: usize, const O: usize> pulp::NullaryFnOnce
    for Job<'_, K, WIDE, BLOCK, I, O>
{
    type Output = ();
    #[inline(always)]
    fn call(self) {
        blocks::<true, WIDE, BLOCK, K, I, O>(self.kernel, self.inputs, self.outputs, self.len);
    }
}

#[inline(always)]
fn blocks<const FUSED: bool, const WIDE: bool, const BLOCK: usize, K: Kernel<I, O>, const I: usize, const O: usize>(
    kernel: &K,
    inputs: [&[f32]; I],
    outputs: [&mut [f32]; O],
    len: usize,
) {
    // As arrays of blocks, so that next to nothing is left to check at a block.
    // Loops, not `array::map`, which is not inlined where the caller has more instructions than it.
    let count = len / BLOCK;
    let mut columns = [&[][..]; I];
    for i in 0..I {
        columns[i] = &inputs[i].as_chunks::<BLOCK>().0[..count];
    }
    #[expect(clippy::needless_range_loop, reason = "k is a place in every column, of inputs and outputs")]
    for k in 0..count {
        let mut x = [&[0.0; BLOCK]; I];
        for i in 0..I {
            x[i] = &columns[i][k];
        }
        let y = block::<FUSED, WIDE, BLOCK, K, I, O>(kernel, x);
        for o in 0..O {
            outputs[o].as_chunks_mut::<BLOCK>().0[k] = y[o];
        }
    }
    if count * BLOCK < len {
        let mut x = [[0.0; BLOCK]; I];
        for i in 0..I {
            let rest = inputs[i].as_chunks::<BLOCK>().1;
            x[i][..rest.len()].copy_from_slice(rest);
        }
        let block = block::<FUSED, WIDE, BLOCK, K, I, O>(kernel, x.each_ref());
        for o in 0..O {
            let rest = outputs[o].as_chunks_mut::<BLOCK>().1;
            rest.copy_from_slice(&block[o][..rest.len()]);
        }
    }
}

/// The loop that LLVM widens. Its results lie in an array of its own, which no input can overlap.
#[inline(always)]
fn block<const FUSED: bool, const WIDE: bool, const BLOCK: usize, K: Kernel<I, O>, const I: usize, const O: usize>(
    kernel: &K,
    x: [&[f32; BLOCK]; I],
) -> [[f32; BLOCK]; O] {
    let mut y = [[0.0; BLOCK]; O];
    for k in 0..BLOCK {
        let mut input = [Lane::<FUSED, WIDE>(0.0); I];
        for i in 0..I {
            input[i] = Lane(x[i][k]);
        }
        let output = kernel.call(input);
        for o in 0..O {
            y[o][k] = output[o].0;
        }
    }
    y
}
