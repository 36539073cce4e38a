//! A file of registers of one type: blocks of lanes, and numbers that are the same in all lanes.

use crate::allocate::FileSize;
use crate::code::SAME;
use crate::ir::NONE;
use crate::kernel::{Block, LANES, Source, blend};

#[derive(Debug)]
pub(super) struct File<T> {
    pub(super) blocks: Vec<Box<Block<T>>>,
    pub(super) same: Vec<T>,
    /// Where an instruction writes its result, which then changes places with the target's block: so a result may
    /// overwrite its own operand, and nothing is copied.
    pub(super) scratch: Box<Block<T>>,
}

/// What a place says.
pub(super) trait Place {
    fn same_in_all(self) -> bool;
    fn index(self) -> usize;
}

impl Place for u32 {
    fn same_in_all(self) -> bool {
        self & SAME != 0
    }

    fn index(self) -> usize {
        (self & !SAME) as usize
    }
}

/// An operand out of blocks and numbers.
#[inline(always)]
pub(super) fn source<'a, T: Copy + Default>(blocks: &'a [Box<Block<T>>], same: &[T], place: u32) -> Source<'a, T> {
    if place == NONE {
        Source::Same(T::default())
    } else if place.same_in_all() {
        Source::Same(same[place.index()])
    } else {
        Source::Each(&blocks[place.index()])
    }
}

impl<T: Copy + Default> File<T> {
    pub(super) fn new(size: &FileSize, number: impl Fn(u64) -> T) -> Self {
        let block = || Box::new([T::default(); LANES]);
        File {
            blocks: (0..size.blocks).map(|_| block()).collect(),
            same: size.same.iter().map(|bits| number(*bits)).collect(),
            scratch: block(),
        }
    }

    #[inline(always)]
    pub(super) fn source(&self, place: u32) -> Source<'_, T> {
        source(&self.blocks, &self.same, place)
    }

    pub(super) fn block(&self, place: u32) -> &Block<T> {
        &self.blocks[place.index()]
    }

    pub(super) fn block_mut(&mut self, place: u32) -> &mut Block<T> {
        &mut self.blocks[place.index()]
    }

    /// The number of an operand that is the same in all lanes.
    #[inline(always)]
    pub(super) fn one(&self, place: u32) -> T {
        self.source(place).lane(0)
    }

    /// Puts the scratch block in the place of another one.
    #[inline(always)]
    pub(super) fn commit(&mut self, place: u32) {
        std::mem::swap(&mut self.blocks[place.index()], &mut self.scratch);
    }

    /// Writes to a register: in all lanes, or (with a mask) in some.
    pub(super) fn write(&mut self, dst: u32, a: u32, last: bool, mask: Option<&Block<u32>>) {
        if dst == a {
            return;
        }
        if dst.same_in_all() {
            self.same[dst.index()] = self.one(a);
            return;
        }
        match mask {
            None if last => self.blocks.swap(dst.index(), a.index()),
            None => {
                *self.scratch = source(&self.blocks, &self.same, a).block();
                self.commit(dst);
            }
            Some(mask) => {
                // The old numbers go into the scratch block, get the new ones, and come back.
                self.commit(dst);
                blend(&mut self.scratch, mask, source(&self.blocks, &self.same, a));
                self.commit(dst);
            }
        }
    }

    /// For each lane the register of a table that its index names.
    pub(super) fn gather(&mut self, dst: u32, index: Source<'_, u32>, table: &[u32]) {
        let last = table.len() as u32 - 1;
        let pick = |lane: usize| table[index.lane(lane).min(last) as usize];
        if dst.same_in_all() {
            self.same[dst.index()] = self.one(pick(0));
            return;
        }
        if let Source::Same(_) = index {
            *self.scratch = self.source(pick(0)).block();
        } else {
            for lane in 0..LANES {
                let place = pick(lane);
                self.scratch[lane] =
                    if place.same_in_all() { self.same[place.index()] } else { self.blocks[place.index()][lane] };
            }
        }
        self.commit(dst);
    }

    /// Writes each active lane of `value` to the register of a table that its index names.
    pub(super) fn scatter(&mut self, value: u32, index: Source<'_, u32>, table: &[u32], mask: &Block<u32>) {
        let last = table.len() as u32 - 1;
        if let Source::Same(index) = index {
            self.write(table[index.min(last) as usize], value, false, Some(mask));
            return;
        }
        for lane in (0..LANES).filter(|lane| mask[*lane] != 0) {
            let place = table[index.lane(lane).min(last) as usize];
            self.blocks[place.index()][lane] = self.source(value).lane(lane);
        }
    }
}
