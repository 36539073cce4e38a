//! What a program is run with: columns of numbers, buffers, textures, limits.

use std::sync::atomic::{AtomicU32, Ordering};

use crate::real::Float;
use crate::texture::{Sampler, Texture};

/// Numbers of one scalar, one for each invocation or one for all.
#[derive(Clone, Copy, Debug)]
pub enum Column<'a, F> {
    /// f32 of the shader, in the scalar of the run.
    Float(&'a [F]),
    /// f64 of the shader.
    Double(&'a [f64]),
    /// i32 (two's complement), u32, or bool (0 is false).
    Word(&'a [u32]),
}

/// Numbers of one scalar of the result.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputColumn<F> {
    /// f32 of the shader.
    Float(Vec<F>),
    /// f64 of the shader.
    Double(Vec<f64>),
    /// i32, u32, or bool (0 or 1).
    Word(Vec<u32>),
}

impl<F: Float> OutputColumn<F> {
    /// The numbers as f64; words as unsigned integers.
    pub fn to_f64(&self) -> Vec<f64> {
        match self {
            OutputColumn::Float(all) => all.iter().map(|x| x.to_f64()).collect(),
            OutputColumn::Double(all) => all.clone(),
            OutputColumn::Word(all) => all.iter().map(|x| f64::from(*x)).collect(),
        }
    }
}

/// The results of a run; its memory is kept from run to run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outputs<F> {
    /// One column for each scalar of the result.
    pub columns: Vec<OutputColumn<F>>,
    /// Which invocations were discarded; their results mean nothing.
    pub killed: Vec<bool>,
}

/// How derivatives are taken.
#[derive(Clone, Copy, Debug)]
pub enum Derivatives<'a, F> {
    /// All are 0: textures are read at their finest level.
    Zero,
    /// Invocations come in fours: a pixel, its right neighbour, the one below, the one below that to the right. `dpdx` and
    /// its kin, the coarse ones included, are differences of the pixel's own row or column; the level of `textureSample` is one for
    /// all four, from the first row and the first column, as devices choose it.
    Quads,
    /// How much each input changes from one pixel to the next along x and along y: columns as those of the inputs.
    /// Derivatives are differences over that step. Words do not change. Costs four times as much where the program takes
    /// derivatives, and nothing elsewhere.
    Given {
        /// Change of each input along x.
        ddx: &'a [Column<'a, F>],
        /// Change of each input along y.
        ddy: &'a [Column<'a, F>],
    },
}

/// What a run may cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most steps of one batch.
    pub steps: u64,
    /// Most bytes of registers.
    pub bytes: u64,
}

impl Default for Limits {
    /// 64 million steps (at most some seconds) and 256 MiB.
    fn default() -> Self {
        Limits { steps: 1 << 26, bytes: 1 << 28 }
    }
}

/// A buffer's memory.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Memory<'a> {
    Bytes(&'a [u8]),
    Words(&'a [AtomicU32]),
}

impl Memory<'_> {
    pub(crate) fn len(self) -> usize {
        match self {
            Memory::Bytes(bytes) => bytes.len(),
            Memory::Words(words) => 4 * words.len(),
        }
    }

    /// The word at a byte offset; 0 beyond the end, as devices with robust access return.
    #[inline(always)]
    pub(crate) fn word(self, at: usize) -> u32 {
        match self {
            Memory::Bytes(bytes) => bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes),
            Memory::Words(words) => words.get(at / 4).map_or(0, |word| word.load(Ordering::Relaxed)),
        }
    }

    /// Writes the word at a byte offset; nothing beyond the end.
    pub(crate) fn set_word(self, at: usize, word: u32) {
        if let Memory::Words(words) = self
            && let Some(place) = words.get(at / 4)
        {
            place.store(word, Ordering::Relaxed);
        }
    }
}

/// The buffers, textures and samplers of a module by `@group` and `@binding`. Those that the program does not read may be
/// missing.
#[derive(Clone, Debug, Default)]
pub struct Resources<'a> {
    buffers: Vec<((u32, u32), Memory<'a>)>,
    textures: Vec<((u32, u32), &'a Texture)>,
    samplers: Vec<((u32, u32), Sampler)>,
}

impl<'a> Resources<'a> {
    /// Adds a uniform or storage buffer that is only read: bytes in the layout of WGSL, little-endian.
    #[must_use]
    pub fn buffer(mut self, group: u32, binding: u32, bytes: &'a [u8]) -> Self {
        self.buffers.push(((group, binding), Memory::Bytes(bytes)));
        self
    }

    /// Adds a storage buffer that the program may write: words in the layout of WGSL, f32 as their bits. As on a device,
    /// invocations that meet at one word in one dispatch find there what any of them has written: which one is not said.
    #[must_use]
    pub fn storage(mut self, group: u32, binding: u32, words: &'a [AtomicU32]) -> Self {
        self.buffers.push(((group, binding), Memory::Words(words)));
        self
    }

    /// Adds a texture.
    #[must_use]
    pub fn texture(mut self, group: u32, binding: u32, texture: &'a Texture) -> Self {
        self.textures.push(((group, binding), texture));
        self
    }

    /// Adds a sampler.
    #[must_use]
    pub fn sampler(mut self, group: u32, binding: u32, sampler: Sampler) -> Self {
        self.samplers.push(((group, binding), sampler));
        self
    }

    pub(crate) fn find_buffer(&self, at: (u32, u32)) -> Option<Memory<'a>> {
        self.buffers.iter().find(|(place, _)| *place == at).map(|(_, memory)| *memory)
    }

    pub(crate) fn find_texture(&self, at: (u32, u32)) -> Option<&'a Texture> {
        self.textures.iter().find(|(place, _)| *place == at).map(|(_, texture)| *texture)
    }

    pub(crate) fn find_sampler(&self, at: (u32, u32)) -> Option<Sampler> {
        self.samplers.iter().find(|(place, _)| *place == at).map(|(_, sampler)| *sampler)
    }
}
