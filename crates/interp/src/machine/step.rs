//! One instruction on one batch.

use super::file::{File, Place as _, source};
use super::{Bound, Machine, Writers};
use crate::code::Step;
use crate::ir::{BufferAccess, Class, Op};
use crate::kernel::{
    BitsOp, CompareOp, Convert, FloatOp, LANES, Source, bits_one, compare_one, float_from_bits, float_from_float,
    float_one, int_from_float, map1, map2, round_to_f32, run_bits, run_compare, run_float, run_select,
};
use crate::real::Float;
use crate::real::sealed::Arithmetic as _;
use crate::resource::Memory;

/// Evaluates an expression per class with the file of floats or of doubles.
macro_rules! by_width {
    ($machine:ident, $class:expr, $file:ident => $e:expr) => {
        match $class {
            Class::Float => {
                let $file = &mut $machine.floats;
                $e
            }
            _ => {
                let $file = &mut $machine.doubles;
                $e
            }
        }
    };
}

impl<F: Float> Machine<'_, F> {
    pub(super) fn step(&mut self, step: &Step, bound: &Bound<'_>) {
        let arch = self.arch;
        match step.op {
            Op::Float(op) => by_width!(self, step.class, file => float(arch, file, op, step)),
            Op::Compare(op) => by_width!(self, step.class, file => compare(arch, file, &mut self.words, op, step)),
            Op::Bits(op) => bits(arch, &mut self.words, op, step),
            Op::Select => match step.class {
                Class::Bits => select_words(arch, &mut self.words, step),
                class => by_width!(self, class, file => select(arch, file, &self.words, step)),
            },
            Op::Move => {
                let mask = (step.masked && !self.mask.all).then_some(&*self.mask.lanes);
                match step.class {
                    Class::Bits => self.words.write(step.dst, step.a, step.last, mask),
                    class => by_width!(self, class, file => file.write(step.dst, step.a, step.last, mask)),
                }
            }
            Op::Convert(op) => self.convert(op, step),
            Op::Exponent => by_width!(self, step.class, file => {
                to_words(file, &mut self.words, step, |x| x.exponent().cast_unsigned());
            }),
            Op::Scale => by_width!(self, step.class, file => scale(file, &self.words, step)),
            Op::Gather(table) => {
                let table = &self.program.tables[table as usize];
                match step.class {
                    Class::Bits => {
                        // The index is in the file that is written.
                        let index = self.words.source(step.a).block();
                        let same = step.a.same_in_all();
                        let index = if same { Source::Same(index[0]) } else { Source::Each(&index) };
                        self.words.gather(step.dst, index, table);
                    }
                    class => by_width!(self, class, file => file.gather(step.dst, self.words.source(step.a), table)),
                }
            }
            Op::Scatter(table) => {
                let table = &self.program.tables[table as usize];
                match step.class {
                    Class::Bits => {
                        let index = self.words.source(step.a).block();
                        let same = step.a.same_in_all();
                        let index = if same { Source::Same(index[0]) } else { Source::Each(&index) };
                        self.words.scatter(step.b, index, table, &self.mask.lanes);
                    }
                    class => by_width!(self, class, file => {
                        file.scatter(step.b, self.words.source(step.a), table, &self.mask.lanes);
                    }),
                }
            }
            Op::Load(access) => {
                let access = self.program.accesses[access as usize];
                let memory = bound.buffers[access.buffer as usize];
                let at = |address: u32| access.offset as usize + address as usize;
                let float = |address| F::from_f64(f64::from(f32::from_bits(memory.word(at(address)))));
                let double = |address| f64::from_bits(two_words(memory, at(address)));
                match step.class {
                    Class::Float => from_words(&mut self.floats, &self.words, step, float),
                    Class::Double => from_words(&mut self.doubles, &self.words, step, double),
                    Class::Bits if step.dst.same_in_all() => {
                        self.words.same[step.dst.index()] = memory.word(at(self.words.one(step.a)));
                    }
                    Class::Bits => {
                        let File { blocks, same, scratch } = &mut self.words;
                        map1(scratch, source(blocks, same, step.a), |address| memory.word(at(address)));
                        self.words.commit(step.dst);
                    }
                }
            }
            Op::Store(access) => self.store(self.program.accesses[access as usize], step, bound),
            Op::Length(access) => {
                let BufferAccess { buffer, offset, stride } = self.program.accesses[access as usize];
                let bytes = bound.buffers[buffer as usize].len().saturating_sub(offset as usize);
                let length = (bytes / stride.max(1) as usize).min(u32::MAX as usize) as u32;
                if step.dst.same_in_all() {
                    self.words.same[step.dst.index()] = length;
                } else {
                    self.words.block_mut(step.dst).fill(length);
                }
            }
            Op::Derivative { vertical, coarse } => {
                // The lanes that are compared: those with this bit and those without, of the lane's own row or column or of
                // its block's first.
                let bit = if vertical { 2 } else { 1 };
                let kept = if coarse { !3 } else { !bit };
                let bits = bound.quads.then_some((kept, bit));
                by_width!(self, step.class, file => derivative(file, step, bits));
            }
            Op::Texture(read) => self.texture(read, bound),
        }
    }

    /// Writes each active invocation's scalar to its place in a buffer.
    fn store(&self, access: BufferAccess, step: &Step, bound: &Bound<'_>) {
        let memory = bound.buffers[access.buffer as usize];
        let Writers { count, spread } = bound.writers;
        for lane in (0..count * spread).step_by(spread).filter(|lane| self.mask.lanes[*lane] != 0) {
            let at = access.offset as usize + self.words.source(step.a).lane(lane) as usize;
            match step.class {
                Class::Float => {
                    memory.set_word(at, (self.floats.source(step.b).lane(lane).to_f64() as f32).to_bits());
                }
                Class::Double => {
                    let bits = self.doubles.source(step.b).lane(lane).to_bits();
                    memory.set_word(at, bits as u32);
                    memory.set_word(at + 4, (bits >> 32) as u32);
                }
                Class::Bits => memory.set_word(at, self.words.source(step.b).lane(lane)),
            }
        }
    }

    fn convert(&mut self, op: Convert, step: &Step) {
        let narrow = step.class == Class::Float;
        match op {
            Convert::SignedFromFloat | Convert::UnsignedFromFloat | Convert::BitsFromFloat | Convert::HalfFromFloat => {
                by_width!(self, step.class, file => {
                    to_words(file, &mut self.words, step, |x| int_from_float(op, narrow, x));
                });
            }
            Convert::FloatFromSigned | Convert::FloatFromUnsigned | Convert::FloatFromBits | Convert::FloatFromHalf => {
                by_width!(self, step.class, file => from_words(file, &self.words, step, |x| float_from_bits(op, x)));
            }
            Convert::FloatFromFloat => match step.class {
                Class::Float => from_words(&mut self.floats, &self.doubles, step, float_from_float),
                _ => from_words(&mut self.doubles, &self.floats, step, float_from_float),
            },
            Convert::RoundToF32 => by_width!(self, step.class, file => {
                if step.dst.same_in_all() {
                    file.same[step.dst.index()] = round_to_f32(file.one(step.a));
                } else {
                    let File { blocks, same, scratch } = &mut *file;
                    map1(scratch, source(blocks, same, step.a), round_to_f32);
                    file.commit(step.dst);
                }
            }),
        }
    }
}

fn float<T: Float>(arch: pulp::Arch, file: &mut File<T>, op: FloatOp, step: &Step) {
    if step.dst.same_in_all() {
        file.same[step.dst.index()] = float_one(op, file.one(step.a), file.one(step.b), file.one(step.c));
        return;
    }
    let File { blocks, same, scratch } = file;
    let (a, b, c) = (source(blocks, same, step.a), source(blocks, same, step.b), source(blocks, same, step.c));
    run_float(arch, scratch, op, a, b, c);
    file.commit(step.dst);
}

fn bits(arch: pulp::Arch, file: &mut File<u32>, op: BitsOp, step: &Step) {
    if step.dst.same_in_all() {
        file.same[step.dst.index()] = bits_one(op, file.one(step.a), file.one(step.b), file.one(step.c));
        return;
    }
    let File { blocks, same, scratch } = file;
    let (a, b, c) = (source(blocks, same, step.a), source(blocks, same, step.b), source(blocks, same, step.c));
    run_bits(arch, scratch, op, [a, b, c]);
    file.commit(step.dst);
}

fn compare<T: Float>(arch: pulp::Arch, file: &File<T>, words: &mut File<u32>, op: CompareOp, step: &Step) {
    if step.dst.same_in_all() {
        words.same[step.dst.index()] = compare_one(op, file.one(step.a), file.one(step.b));
        return;
    }
    let (a, b) = (file.source(step.a), file.source(step.b));
    let scratch = &mut words.scratch;
    run_compare(arch, scratch, op, a, b);
    words.commit(step.dst);
}

fn select<T: Float>(arch: pulp::Arch, file: &mut File<T>, words: &File<u32>, step: &Step) {
    let mask = words.source(step.a);
    if step.dst.same_in_all() {
        file.same[step.dst.index()] = file.one(if mask.lane(0) != 0 { step.b } else { step.c });
        return;
    }
    let File { blocks, same, scratch } = file;
    let (accept, reject) = (source(blocks, same, step.b), source(blocks, same, step.c));
    run_select(arch, scratch, mask, accept, reject);
    file.commit(step.dst);
}

fn select_words(arch: pulp::Arch, words: &mut File<u32>, step: &Step) {
    if step.dst.same_in_all() {
        let picked = if words.one(step.a) != 0 { step.b } else { step.c };
        words.same[step.dst.index()] = words.one(picked);
        return;
    }
    let File { blocks, same, scratch } = words;
    let (mask, accept, reject) =
        (source(blocks, same, step.a), source(blocks, same, step.b), source(blocks, same, step.c));
    run_select(arch, scratch, mask, accept, reject);
    words.commit(step.dst);
}

fn to_words<T: Float>(file: &File<T>, words: &mut File<u32>, step: &Step, f: impl Fn(T) -> u32) {
    if step.dst.same_in_all() {
        words.same[step.dst.index()] = f(file.one(step.a));
    } else {
        map1(&mut words.scratch, file.source(step.a), f);
        words.commit(step.dst);
    }
}

/// From another file: of words, or of floats of another width.
fn from_words<T: Float, A: Copy + Default>(file: &mut File<T>, from: &File<A>, step: &Step, f: impl Fn(A) -> T) {
    if step.dst.same_in_all() {
        file.same[step.dst.index()] = f(from.one(step.a));
    } else {
        map1(&mut file.scratch, from.source(step.a), f);
        file.commit(step.dst);
    }
}

fn scale<T: Float>(file: &mut File<T>, words: &File<u32>, step: &Step) {
    let exponent = words.source(step.b);
    if step.dst.same_in_all() {
        file.same[step.dst.index()] = file.one(step.a).scale(exponent.lane(0).cast_signed());
    } else {
        let File { blocks, same, scratch } = file;
        map2(scratch, source(blocks, same, step.a), exponent, |x, e| x.scale(e.cast_signed()));
        file.commit(step.dst);
    }
}

/// Eight bytes of a buffer.
fn two_words(memory: Memory<'_>, at: usize) -> u64 {
    u64::from(memory.word(at)) | u64::from(memory.word(at + 4)) << 32
}

/// Differences within each quad: the lane's number less some bits, with and without a bit.
fn derivative<T: Float>(file: &mut File<T>, step: &Step, bits: Option<(usize, usize)>) {
    if step.dst.same_in_all() {
        file.same[step.dst.index()] = T::ZERO;
        return;
    }
    let File { blocks, same, scratch } = file;
    match (source(blocks, same, step.a), bits) {
        (Source::Each(a), Some((kept, bit))) => {
            for lane in 0..LANES {
                let low = lane & kept;
                scratch[lane] = a[low | bit] - a[low];
            }
        }
        _ => scratch.fill(T::ZERO),
    }
    file.commit(step.dst);
}
