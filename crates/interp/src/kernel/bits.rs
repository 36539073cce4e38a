//! Operations on integers and bools. All are 32 bits wide: an i32 is its two's complement, a bool is a mask (0 or all
//! bits set), so that comparisons, logic and selection need no conversion.

use super::operations;

#[inline(always)]
fn mask(condition: bool) -> u32 {
    u32::from(condition).wrapping_neg()
}

#[inline(always)]
fn signed(x: u32) -> i32 {
    x.cast_signed()
}

/// Offset and count of a bit field as WGSL limits them.
#[inline(always)]
fn field(offset: u32, count: u32) -> (u32, u32) {
    let offset = offset.min(32);
    (offset, count.min(32 - offset))
}

/// The lowest `count` bits, for count up to 32.
#[inline(always)]
fn low_bits(count: u32) -> u32 {
    ((1_u64 << count) - 1) as u32
}

/// Bytes of a word, signed.
#[inline(always)]
fn dot_signed(a: u32, b: u32) -> u32 {
    let bytes = a.to_le_bytes().into_iter().zip(b.to_le_bytes());
    bytes.map(|(a, b)| i32::from(a.cast_signed()) * i32::from(b.cast_signed())).sum::<i32>().cast_unsigned()
}

#[inline(always)]
fn dot_unsigned(a: u32, b: u32) -> u32 {
    a.to_le_bytes().into_iter().zip(b.to_le_bytes()).map(|(a, b)| u32::from(a) * u32::from(b)).sum()
}

operations! {
    /// Words in, words out; names that end in S or U read them as i32 or as u32.
    BitsOp, bits_one, bits_block, u32;
    unary {
        Not: |a| !a;
        Neg: |a| a.wrapping_neg();
        AbsS: |a| signed(a).wrapping_abs().cast_unsigned();
        SignS: |a| signed(a).signum().cast_unsigned();
        TrailingZeros: |a| a.trailing_zeros();
        LeadingZeros: |a| a.leading_zeros();
        Ones: |a| a.count_ones();
        Reverse: |a| a.reverse_bits();
        // Where there is no such bit: all bits set, which is -1.
        FirstTrailing: |a| if a == 0 { u32::MAX } else { a.trailing_zeros() };
        FirstLeadingU: |a| 31_u32.wrapping_sub(a.leading_zeros());
        // Of a negative number: the highest bit that is 0.
        FirstLeadingS: |a| {
            let a = if signed(a) < 0 { !a } else { a };
            31_u32.wrapping_sub(a.leading_zeros())
        };
    }
    binary {
        Add: |a, b| a.wrapping_add(b);
        Sub: |a, b| a.wrapping_sub(b);
        Mul: |a, b| a.wrapping_mul(b);
        // WGSL 2023, 8.7: what has no quotient is the dividend, and its remainder is 0.
        DivS: |a, b| if b == 0 { a } else { signed(a).wrapping_div(signed(b)).cast_unsigned() };
        DivU: |a, b| a.checked_div(b).unwrap_or(a);
        RemS: |a, b| if b == 0 { 0 } else { signed(a).wrapping_rem(signed(b)).cast_unsigned() };
        RemU: |a, b| a.checked_rem(b).unwrap_or(0);
        And: |a, b| a & b;
        Or: |a, b| a | b;
        Xor: |a, b| a ^ b;
        // The count is taken modulo 32.
        Shl: |a, b| a.wrapping_shl(b);
        ShrS: |a, b| signed(a).wrapping_shr(b).cast_unsigned();
        ShrU: |a, b| a.wrapping_shr(b);
        MinS: |a, b| signed(a).min(signed(b)).cast_unsigned();
        MinU: |a, b| a.min(b);
        MaxS: |a, b| signed(a).max(signed(b)).cast_unsigned();
        MaxU: |a, b| a.max(b);
        Equal: |a, b| mask(a == b);
        NotEqual: |a, b| mask(a != b);
        LessS: |a, b| mask(signed(a) < signed(b));
        LessU: |a, b| mask(a < b);
        LessEqualS: |a, b| mask(signed(a) <= signed(b));
        LessEqualU: |a, b| mask(a <= b);
        DotS: |a, b| dot_signed(a, b);
        DotU: |a, b| dot_unsigned(a, b);
        // The bits of a field: offset, count.
        Field: |a, b| {
            let (offset, count) = field(a, b);
            ((u64::from(low_bits(count)) << offset) & 0xffff_ffff) as u32
        };
    }
    ternary {
        // Value, offset, count.
        ExtractU: |a, b, c| {
            let (offset, count) = field(b, c);
            ((u64::from(a) >> offset) as u32) & low_bits(count)
        };
        ExtractS: |a, b, c| {
            let (offset, count) = field(b, c);
            let shifted = u64::from(a) << (64 - offset - count).min(63);
            if count == 0 { 0 } else { (shifted.cast_signed() >> (64 - count)) as u32 }
        };
    }
}
