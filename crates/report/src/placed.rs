//! Columns of numbers at chosen places in memory. A batch of a nanosecond an element takes up to three times as long when its
//! columns lie badly: across the borders of cache lines, or so that what is written has the low bits of the address of
//! what is read next (Intel 2024, "64 and IA-32 Architectures Optimization Reference Manual", 4K aliasing). An allocator
//! gives other places in every run; these are always good ones.

/// Bytes of a page: the processor takes addresses a whole number of pages apart for alike until it knows better.
const PAGE: usize = 4096;
/// Bytes of a cache line.
const LINE: usize = 64;

/// Columns of one length. Each begins at a cache line, one line farther into its page than the one before.
#[derive(Debug)]
pub struct Columns<const N: usize> {
    memory: Vec<f32>,
    first: usize,
    stride: usize,
    length: usize,
}

impl<const N: usize> Columns<N> {
    /// Zeros; the first column begins `line` cache lines into a page.
    pub fn new(length: usize, line: usize) -> Columns<N> {
        const NUMBER: usize = size_of::<f32>();
        let stride = (length * NUMBER + LINE).next_multiple_of(PAGE) + LINE;
        let memory = vec![0.0; (N * stride + 2 * PAGE) / NUMBER];
        let base = memory.as_ptr() as usize;
        let first = base.next_multiple_of(PAGE) + line * LINE % PAGE - base;
        Columns { memory, first: first / NUMBER, stride: stride / NUMBER, length }
    }

    /// What a batch writes in the given sitting. What is written lies before what is read ([`Columns::read`]) within the page, so that
    /// nothing that is read soon is taken for it.
    pub fn written(length: usize, sitting: usize) -> Columns<N> {
        Columns::new(length, sitting * 8)
    }

    /// What a batch reads in the given sitting.
    pub fn read(columns: [&[f32]; N], sitting: usize) -> Columns<N> {
        let mut copy = Columns::new(columns.first().map_or(0, |column| column.len()), sitting * 8 + 4);
        for (copy, column) in copy.slices_mut().into_iter().zip(columns) {
            copy.copy_from_slice(column);
        }
        copy
    }

    /// The columns.
    pub fn slices(&self) -> [&[f32]; N] {
        std::array::from_fn(|column| &self.memory[self.first + column * self.stride..][..self.length])
    }

    /// The columns, to be written.
    pub fn slices_mut(&mut self) -> [&mut [f32]; N] {
        let mut rest = self.memory[self.first..].chunks_mut(self.stride);
        std::array::from_fn(|_| &mut rest.next().unwrap_or_default()[..self.length])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_begin_at_lines_and_do_not_overlap() {
        for length in [1, 2048, 5000] {
            let columns: [Vec<f32>; 3] = std::array::from_fn(|k| vec![k as f32 + 1.0; length]);
            let read = Columns::read(columns.each_ref().map(Vec::as_slice), 2);
            for (k, slice) in read.slices().into_iter().enumerate() {
                assert_eq!(slice, columns[k]);
                assert_eq!(slice.as_ptr() as usize % PAGE, (20 + k) * LINE);
            }
            let mut written = Columns::<2>::written(length, 2);
            let [first, second] = written.slices_mut();
            assert_eq!([first.len(), second.len()], [length; 2]);
            assert_eq!(first.as_ptr() as usize % PAGE, 16 * LINE);
        }
    }
}
