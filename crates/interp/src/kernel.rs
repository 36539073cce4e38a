//! What one instruction computes on one batch: tight loops over lanes, which the compiler turns into SIMD code for the
//! machine that it runs on. Every operation is written once, as an expression on scalars; the loops and the form for
//! values that are the same in all lanes come from the same text.
//!
//! Nothing here knows of registers, masks or programs.

mod bits;
mod convert;
mod dispatch;
mod float;

use bits::bits_block;
pub(crate) use bits::{BitsOp, bits_one};
pub(crate) use convert::{Convert, float_from_bits, float_from_float, int_from_float, round_to_f32};
pub(crate) use dispatch::{run_bits, run_compare, run_float, run_select};
pub(crate) use float::{CompareOp, FloatOp, compare_one, float_one};
use float::{compare_block, float_block};

/// Invocations that run together.
pub const LANES: usize = 128;

/// One scalar of all lanes of a batch.
pub(crate) type Block<T> = [T; LANES];

/// An operand: a number for each lane, or one for all.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source<'a, T> {
    Each(&'a Block<T>),
    Same(T),
}

impl<T: Copy> Source<'_, T> {
    #[inline(always)]
    pub(crate) fn lane(self, lane: usize) -> T {
        match self {
            Source::Each(block) => block[lane],
            Source::Same(value) => value,
        }
    }

    /// The numbers of all lanes.
    #[inline(always)]
    pub(crate) fn block(self) -> Block<T> {
        match self {
            Source::Each(block) => *block,
            Source::Same(value) => [value; LANES],
        }
    }
}

#[inline(always)]
pub(crate) fn map1<A: Copy, R: Copy>(out: &mut Block<R>, a: Source<'_, A>, f: impl Fn(A) -> R) {
    match a {
        Source::Each(a) => {
            for (out, a) in out.iter_mut().zip(a) {
                *out = f(*a);
            }
        }
        Source::Same(a) => *out = [f(a); LANES],
    }
}

#[inline(always)]
pub(crate) fn map2<A: Copy, B: Copy, R: Copy>(
    out: &mut Block<R>,
    a: Source<'_, A>,
    b: Source<'_, B>,
    f: impl Fn(A, B) -> R,
) {
    match (a, b) {
        (Source::Each(a), Source::Each(b)) => {
            for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
                *out = f(*a, *b);
            }
        }
        (Source::Each(a), Source::Same(b)) => {
            for (out, a) in out.iter_mut().zip(a) {
                *out = f(*a, b);
            }
        }
        (Source::Same(a), Source::Each(b)) => {
            for (out, b) in out.iter_mut().zip(b) {
                *out = f(a, *b);
            }
        }
        (Source::Same(a), Source::Same(b)) => *out = [f(a, b); LANES],
    }
}

#[inline(always)]
pub(crate) fn map3<A: Copy, B: Copy, C: Copy, R: Copy>(
    out: &mut Block<R>,
    a: Source<'_, A>,
    b: Source<'_, B>,
    c: Source<'_, C>,
    f: impl Fn(A, B, C) -> R,
) {
    let (a, b, c) = (a.block(), b.block(), c.block());
    for i in 0..LANES {
        out[i] = f(a[i], b[i], c[i]);
    }
}

/// Picks by mask: `accept` where it is set.
#[inline(always)]
fn select_block<T: Copy>(mask: Source<'_, u32>, accept: Source<'_, T>, reject: Source<'_, T>, out: &mut Block<T>) {
    match (mask, accept, reject) {
        (Source::Each(mask), Source::Each(accept), Source::Each(reject)) => {
            for i in 0..LANES {
                out[i] = if mask[i] != 0 { accept[i] } else { reject[i] };
            }
        }
        _ => map3(out, mask, accept, reject, |m, a, r| if m != 0 { a } else { r }),
    }
}

/// Writes `value` into the lanes of `out` whose mask is set.
#[inline(always)]
pub(crate) fn blend<T: Copy>(out: &mut Block<T>, mask: &Block<u32>, value: Source<'_, T>) {
    match value {
        Source::Each(value) => {
            for i in 0..LANES {
                out[i] = if mask[i] != 0 { value[i] } else { out[i] };
            }
        }
        Source::Same(value) => {
            for i in 0..LANES {
                out[i] = if mask[i] != 0 { value } else { out[i] };
            }
        }
    }
}

/// Names operations by arity and gives each its expression; makes the enum, the form for one value and the loops.
macro_rules! operations {
    (
        $(#[$doc:meta])*
        $name:ident, $one:ident, $block:ident, $t:ident $(: $bound:path)?;
        unary { $($u:ident: |$ua:ident| $ue:expr;)* }
        binary { $($b:ident: |$ba:ident, $bb:ident| $be:expr;)* }
        ternary { $($c:ident: |$ca:ident, $cb:ident, $cc:ident| $ce:expr;)* }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum $name { $($u,)* $($b,)* $($c,)* }

        pub(crate) fn $one$(<$t: $bound>)?(op: $name, a: $t, b: $t, c: $t) -> $t {
            match op {
                $($name::$u => { let $ua = a; $ue })*
                $($name::$b => { let ($ba, $bb) = (a, b); $be })*
                $($name::$c => { let ($ca, $cb, $cc) = (a, b, c); $ce })*
            }
        }

        #[inline(always)]
        pub(crate) fn $block$(<$t: $bound>)?(
            op: $name,
            a: $crate::kernel::Source<'_, $t>,
            b: $crate::kernel::Source<'_, $t>,
            c: $crate::kernel::Source<'_, $t>,
            out: &mut $crate::kernel::Block<$t>,
        ) {
            match op {
                $($name::$u => $crate::kernel::map1(out, a, #[inline(always)] |$ua| $ue),)*
                $($name::$b => $crate::kernel::map2(out, a, b, #[inline(always)] |$ba, $bb| $be),)*
                $($name::$c => $crate::kernel::map3(out, a, b, c, #[inline(always)] |$ca, $cb, $cc| $ce),)*
            }
        }
    };
}
use operations;
