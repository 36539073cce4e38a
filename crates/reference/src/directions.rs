//! Directions side by side, a list for each component, and blocks of a fixed length, over which loops become vectors.

/// Numbers of a block.
pub(crate) const BLOCK: usize = 64;

/// Directions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Directions([Vec<f64>; 3]);

impl Directions {
    pub(crate) fn len(&self) -> usize {
        self.0[0].len()
    }

    pub(crate) fn clear(&mut self) {
        self.0.iter_mut().for_each(Vec::clear);
    }

    pub(crate) fn push(&mut self, dir: [f64; 3]) {
        for (all, x) in self.0.iter_mut().zip(dir) {
            all.push(x);
        }
    }

    /// Appends the first directions of a block.
    pub(crate) fn extend(&mut self, made: &[[f64; BLOCK]; 3], count: usize) {
        for (all, made) in self.0.iter_mut().zip(made) {
            all.extend_from_slice(&made[..count]);
        }
    }

    pub(crate) fn at(&self, index: usize) -> [f64; 3] {
        [self.0[0][index], self.0[1][index], self.0[2][index]]
    }

    /// The block that begins at an index; 0 beyond the end.
    #[inline(always)]
    pub(crate) fn block(&self, first: usize) -> [[f64; BLOCK]; 3] {
        [block(&self.0[0], first), block(&self.0[1], first), block(&self.0[2], first)]
    }
}

/// The numbers from an index on; what is beyond the end is 0.
#[inline(always)]
pub(crate) fn block<T: Copy + Default>(all: &[T], first: usize) -> [T; BLOCK] {
    let mut made = [T::default(); BLOCK];
    let count = BLOCK.min(all.len() - first);
    made[..count].copy_from_slice(&all[first..first + count]);
    made
}
