//! Runs the kernels with the widest instructions of this machine. What is dispatched are structs, not closures: only
//! their methods are sure to be compiled into the function that has the instructions.

use pulp::{Arch, Simd, WithSimd};

use super::{BitsOp, Block, CompareOp, FloatOp, Source, bits_block, compare_block, float_block, select_block};
use crate::real::Float;

/// Makes a struct of a kernel's arguments, with the kernel as what is dispatched, and a function that does so.
macro_rules! dispatched {
    ($(#[$doc:meta])* $function:ident, $name:ident <$t:ident $(: $bound:path)?>, $kernel:ident, $r:ty,
        { $($arg:ident: $ty:ty),* $(,)? }) => {
        struct $name<'a, $t> {
            out: &'a mut Block<$r>,
            $($arg: $ty,)*
        }

        impl<$t: Copy $(+ $bound)?> WithSimd for $name<'_, $t> {
            type Output = ();

            #[inline(always)]
            fn with_simd<S: Simd>(self, _: S) {
                $kernel($(self.$arg,)* self.out);
            }
        }

        $(#[$doc])*
        pub(crate) fn $function<'a, $t: Copy $(+ $bound)?>(arch: Arch, out: &'a mut Block<$r>, $($arg: $ty,)*) {
            arch.dispatch($name { out, $($arg,)* });
        }
    };
}

dispatched!(
    /// Floats to floats.
    run_float, RunFloat<T: Float>, float_block, T,
    { op: FloatOp, a: Source<'a, T>, b: Source<'a, T>, c: Source<'a, T> }
);
dispatched!(
    /// Floats to masks.
    run_compare, RunCompare<T: Float>, compare_block, u32,
    { op: CompareOp, a: Source<'a, T>, b: Source<'a, T> }
);
dispatched!(
    /// Of two registers one, by mask.
    run_select, RunSelect<T>, select_block, T,
    { mask: Source<'a, u32>, accept: Source<'a, T>, reject: Source<'a, T> }
);

struct RunBits<'a> {
    op: BitsOp,
    out: &'a mut Block<u32>,
    operands: [Source<'a, u32>; 3],
}

impl WithSimd for RunBits<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let [a, b, c] = self.operands;
        bits_block(self.op, a, b, c, self.out);
    }
}

/// Words to words.
pub(crate) fn run_bits(arch: Arch, out: &mut Block<u32>, op: BitsOp, operands: [Source<'_, u32>; 3]) {
    arch.dispatch(RunBits { op, out, operands });
}
