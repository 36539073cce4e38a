//! The built-in functions of WGSL (2023, chapter 17), component by component.

use naga::{MathFunction, Scalar, ScalarKind, TypeInner};

use super::{Lower, Regs, Result, is_signed};
use crate::ir::{Class, NONE, Op, Reg};
use crate::kernel::{BitsOp, CompareOp, Convert, FloatOp};

/// How the instructions of a component-wise function are chosen.
enum Each {
    Float(FloatOp),
    Bits(BitsOp),
}

fn each(fun: MathFunction, scalar: Scalar) -> Option<Each> {
    use MathFunction as M;
    let float = match fun {
        M::Abs => FloatOp::Abs,
        M::Min => FloatOp::Min,
        M::Max => FloatOp::Max,
        M::Clamp => FloatOp::Clamp,
        M::Saturate => FloatOp::Saturate,
        M::Cos => FloatOp::Cos,
        M::Cosh => FloatOp::Cosh,
        M::Sin => FloatOp::Sin,
        M::Sinh => FloatOp::Sinh,
        M::Tan => FloatOp::Tan,
        M::Tanh => FloatOp::Tanh,
        M::Acos => FloatOp::Acos,
        M::Asin => FloatOp::Asin,
        M::Atan => FloatOp::Atan,
        M::Atan2 => FloatOp::Atan2,
        M::Asinh => FloatOp::Asinh,
        M::Acosh => FloatOp::Acosh,
        M::Atanh => FloatOp::Atanh,
        M::Ceil => FloatOp::Ceil,
        M::Floor => FloatOp::Floor,
        M::Round => FloatOp::Round,
        M::Fract => FloatOp::Fract,
        M::Trunc => FloatOp::Trunc,
        M::Exp => FloatOp::Exp,
        M::Exp2 => FloatOp::Exp2,
        M::Log => FloatOp::Log,
        M::Log2 => FloatOp::Log2,
        M::Pow => FloatOp::Pow,
        M::Sign => FloatOp::Sign,
        M::Fma => FloatOp::Fma,
        M::Mix => FloatOp::Mix,
        M::Step => FloatOp::Step,
        M::SmoothStep => FloatOp::Smoothstep,
        M::Sqrt => FloatOp::Sqrt,
        M::InverseSqrt => FloatOp::InverseSqrt,
        _ => return None,
    };
    if scalar.kind == ScalarKind::Float {
        return Some(Each::Float(float));
    }
    let signed = is_signed(scalar);
    Some(Each::Bits(match fun {
        M::Abs if signed => BitsOp::AbsS,
        M::Sign => BitsOp::SignS,
        M::Min if signed => BitsOp::MinS,
        M::Min => BitsOp::MinU,
        M::Max if signed => BitsOp::MaxS,
        M::Max => BitsOp::MaxU,
        _ => return None,
    }))
}

/// A function's name as WGSL has it: naga's begins with a capital.
fn named(fun: MathFunction) -> String {
    let mut name = format!("{fun:?}");
    if let Some(first) = name.get_mut(..1) {
        first.make_ascii_lowercase();
    }
    name
}

impl Lower<'_> {
    pub(super) fn math(
        &mut self,
        fun: MathFunction,
        inner: &TypeInner,
        scalar: Option<Scalar>,
        args: &[Regs],
    ) -> Result<Regs> {
        use MathFunction as M;
        let Some(scalar) = scalar else {
            return self.refuse(format!("`{}` of a value that is not made of scalars", named(fun)));
        };
        let class = self.class(args[0][0]);
        let signed = is_signed(scalar);
        if let Some(op) = each(fun, scalar) {
            let len = args.iter().map(|a| a.len()).max().unwrap_or(0);
            return (0..len)
                .map(|i| {
                    let mut operands = [NONE; 3];
                    for (operand, arg) in operands.iter_mut().zip(args) {
                        *operand = arg[i.min(arg.len() - 1)];
                    }
                    let op = match op {
                        Each::Float(op) => Op::Float(op),
                        Each::Bits(op) => Op::Bits(op),
                    };
                    self.emit(op, class, operands)
                })
                .collect();
        }
        let bits = |signed_op, unsigned_op| if signed { signed_op } else { unsigned_op };
        match fun {
            // Unsigned.
            M::Abs => Ok(args[0].clone()),
            M::Clamp => {
                let (low, high) = (bits(BitsOp::MaxS, BitsOp::MaxU), bits(BitsOp::MinS, BitsOp::MinU));
                self.zip(args, |l, x| {
                    let raised = l.bits2(low, x[0], x[1])?;
                    l.bits2(high, raised, x[2])
                })
            }
            M::Radians => self.scaled(&args[0], std::f64::consts::PI / 180.0),
            M::Degrees => self.scaled(&args[0], 180.0 / std::f64::consts::PI),
            M::Modf => {
                let whole = self.zip(args, |l, x| l.float1(FloatOp::Trunc, x[0]))?;
                let pairs = [args[0].clone(), whole.clone()];
                let fract = self.zip(&pairs, |l, x| l.float2(FloatOp::Sub, x[0], x[1]))?;
                Ok(fract.iter().chain(whole.iter()).copied().collect())
            }
            M::Frexp => {
                let significand = self.zip(args, |l, x| l.float1(FloatOp::Significand, x[0]))?;
                let exponent = self.zip(args, |l, x| l.emit(Op::Exponent, Class::Bits, [x[0], NONE, NONE]))?;
                Ok(significand.iter().chain(exponent.iter()).copied().collect())
            }
            M::Ldexp => self.zip(args, |l, x| l.emit(Op::Scale, l.class(x[0]), [x[0], x[1], NONE])),
            M::Dot => Ok([self.dot(&args[0], &args[1])?].into()),
            M::Dot4I8Packed => self.zip(args, |l, x| l.bits2(BitsOp::DotS, x[0], x[1])),
            M::Dot4U8Packed => self.zip(args, |l, x| l.bits2(BitsOp::DotU, x[0], x[1])),
            M::Outer => {
                let mut all = Vec::new();
                for b in args[1].iter() {
                    for a in args[0].iter() {
                        all.push(self.float2(FloatOp::Mul, *a, *b)?);
                    }
                }
                Ok(all.into())
            }
            M::Cross => {
                let (a, b) = (&args[0], &args[1]);
                [(1, 2), (2, 0), (0, 1)]
                    .into_iter()
                    .map(|(i, j)| {
                        let left = self.float2(FloatOp::Mul, a[i], b[j])?;
                        let right = self.float2(FloatOp::Mul, a[j], b[i])?;
                        self.float2(FloatOp::Sub, left, right)
                    })
                    .collect()
            }
            M::Distance => {
                let difference = self.zip(args, |l, x| l.float2(FloatOp::Sub, x[0], x[1]))?;
                Ok([self.length(&difference)?].into())
            }
            M::Length => Ok([self.length(&args[0])?].into()),
            M::Normalize => {
                let length = self.length(&args[0])?;
                args[0].iter().map(|x| self.float2(FloatOp::Div, *x, length)).collect()
            }
            M::FaceForward => {
                let side = self.dot(&args[1], &args[2])?;
                let zero = self.number(class, 0.0);
                let front = self.emit(Op::Compare(CompareOp::Less), Class::Bits, [side, zero, NONE])?;
                args[0]
                    .iter()
                    .map(|x| {
                        let back = self.float1(FloatOp::Neg, *x)?;
                        self.emit(Op::Select, class, [front, *x, back])
                    })
                    .collect()
            }
            M::Reflect => {
                let along = self.dot(&args[1], &args[0])?;
                let two = self.number(class, 2.0);
                let twice = self.float2(FloatOp::Mul, two, along)?;
                self.minus_scaled(&args[0], twice, &args[1])
            }
            M::Refract => self.refract(class, &args[0], &args[1], args[2][0]),
            M::Transpose => {
                let TypeInner::Matrix { columns, rows, .. } = inner else {
                    return self.refuse("transpose of something that is no matrix");
                };
                let (columns, rows) = (*columns as usize, *rows as usize);
                Ok((0..rows)
                    .flat_map(|i| (0..columns).map(move |j| (i, j)))
                    .map(|(i, j)| args[0][j * rows + i])
                    .collect())
            }
            M::Determinant => {
                let size = args[0].len().isqrt();
                Ok([self.determinant(&args[0], size, &(0..size).collect::<Vec<_>>(), 0)?].into())
            }
            M::QuantizeToF16 => self.zip(args, |l, x| {
                let half = l.emit(Op::Convert(Convert::HalfFromFloat), Class::Bits, [x[0], NONE, NONE])?;
                l.emit(Op::Convert(Convert::FloatFromHalf), class, [half, NONE, NONE])
            }),
            M::CountTrailingZeros => self.zip(args, |l, x| l.bits1(BitsOp::TrailingZeros, x[0])),
            M::CountLeadingZeros => self.zip(args, |l, x| l.bits1(BitsOp::LeadingZeros, x[0])),
            M::CountOneBits => self.zip(args, |l, x| l.bits1(BitsOp::Ones, x[0])),
            M::ReverseBits => self.zip(args, |l, x| l.bits1(BitsOp::Reverse, x[0])),
            M::FirstTrailingBit => self.zip(args, |l, x| l.bits1(BitsOp::FirstTrailing, x[0])),
            M::FirstLeadingBit => {
                self.zip(args, |l, x| l.bits1(bits(BitsOp::FirstLeadingS, BitsOp::FirstLeadingU), x[0]))
            }
            M::ExtractBits => {
                self.zip(args, |l, x| l.bits3(bits(BitsOp::ExtractS, BitsOp::ExtractU), x[0], x[1], x[2]))
            }
            M::InsertBits => self.zip(args, |l, x| {
                let field = l.bits2(BitsOp::Field, x[2], x[3])?;
                // An offset of 32 leaves no field, so that its shift (by 0) does not matter.
                let moved = l.bits2(BitsOp::Shl, x[1], x[2])?;
                let (inside, outside) = (l.bits2(BitsOp::And, moved, field)?, l.bits1(BitsOp::Not, field)?);
                let kept = l.bits2(BitsOp::And, x[0], outside)?;
                l.bits2(BitsOp::Or, kept, inside)
            }),
            M::Pack4x8snorm => self.pack_normalized(&args[0], 8, true),
            M::Pack4x8unorm => self.pack_normalized(&args[0], 8, false),
            M::Pack2x16snorm => self.pack_normalized(&args[0], 16, true),
            M::Pack2x16unorm => self.pack_normalized(&args[0], 16, false),
            M::Pack2x16float => {
                let halves = self
                    .zip(args, |l, x| l.emit(Op::Convert(Convert::HalfFromFloat), Class::Bits, [x[0], NONE, NONE]))?;
                self.pack(&halves, 16)
            }
            M::Pack4xI8 | M::Pack4xU8 => self.pack(&args[0], 8),
            M::Pack4xI8Clamp => self.pack_clamped(&args[0], BitsOp::MaxS, -128, BitsOp::MinS, 127),
            M::Pack4xU8Clamp => self.pack_clamped(&args[0], BitsOp::MaxU, 0, BitsOp::MinU, 255),
            M::Unpack4x8snorm => self.unpack_normalized(args[0][0], 8, true),
            M::Unpack4x8unorm => self.unpack_normalized(args[0][0], 8, false),
            M::Unpack2x16snorm => self.unpack_normalized(args[0][0], 16, true),
            M::Unpack2x16unorm => self.unpack_normalized(args[0][0], 16, false),
            M::Unpack2x16float => {
                let halves = self.unpack(args[0][0], 16, BitsOp::ExtractU)?;
                self.zip(&[halves], |l, x| {
                    l.emit(Op::Convert(Convert::FloatFromHalf), Class::Float, [x[0], NONE, NONE])
                })
            }
            M::Unpack4xI8 => self.unpack(args[0][0], 8, BitsOp::ExtractS),
            M::Unpack4xU8 => self.unpack(args[0][0], 8, BitsOp::ExtractU),
            other => self.refuse(format!("the function `{}`", named(other))),
        }
    }

    /// Applies a step to the components of all arguments in turn; scalars stand for all components.
    fn zip(&mut self, args: &[Regs], mut step: impl FnMut(&mut Self, &[Reg]) -> Result<Reg>) -> Result<Regs> {
        let len = args.iter().map(|a| a.len()).max().unwrap_or(0);
        (0..len)
            .map(|i| {
                let operands: Vec<Reg> = args.iter().map(|a| a[i.min(a.len() - 1)]).collect();
                step(self, &operands)
            })
            .collect()
    }

    fn scaled(&mut self, regs: &[Reg], factor: f64) -> Result<Regs> {
        let factor = self.number(self.class(regs[0]), factor);
        regs.iter().map(|r| self.float2(FloatOp::Mul, *r, factor)).collect()
    }

    /// a - s b.
    fn minus_scaled(&mut self, a: &[Reg], s: Reg, b: &[Reg]) -> Result<Regs> {
        a.iter()
            .zip(b)
            .map(|(a, b)| {
                let scaled = self.float2(FloatOp::Mul, s, *b)?;
                self.float2(FloatOp::Sub, *a, scaled)
            })
            .collect()
    }

    fn length(&mut self, regs: &[Reg]) -> Result<Reg> {
        if let [one] = regs {
            return self.float1(FloatOp::Abs, *one);
        }
        let squared = self.dot(regs, regs)?;
        self.float1(FloatOp::Sqrt, squared)
    }

    /// k = 1 - eta^2 (1 - (n.i)^2); eta i - (eta n.i + sqrt(k)) n, or 0 where k < 0.
    fn refract(&mut self, class: Class, i: &[Reg], n: &[Reg], eta: Reg) -> Result<Regs> {
        let (zero, one) = (self.number(class, 0.0), self.number(class, 1.0));
        let cosine = self.dot(n, i)?;
        let cosine2 = self.float2(FloatOp::Mul, cosine, cosine)?;
        let sine2 = self.float2(FloatOp::Sub, one, cosine2)?;
        let eta2 = self.float2(FloatOp::Mul, eta, eta)?;
        let product = self.float2(FloatOp::Mul, eta2, sine2)?;
        let k = self.float2(FloatOp::Sub, one, product)?;
        let total = self.emit(Op::Compare(CompareOp::Less), Class::Bits, [k, zero, NONE])?;
        let root = self.float1(FloatOp::Sqrt, k)?;
        let along = self.float2(FloatOp::Mul, eta, cosine)?;
        let factor = self.float2(FloatOp::Add, along, root)?;
        let bent: Regs = i.iter().map(|i| self.float2(FloatOp::Mul, eta, *i)).collect::<Result<_>>()?;
        let refracted = self.minus_scaled(&bent, factor, n)?;
        refracted.iter().map(|r| self.emit(Op::Select, class, [total, zero, *r])).collect()
    }

    /// Expands along the column `column`, over the rows that are left.
    fn determinant(&mut self, matrix: &[Reg], size: usize, rows: &[usize], column: usize) -> Result<Reg> {
        if let [row] = rows {
            return Ok(matrix[column * size + row]);
        }
        let mut sum = NONE;
        for (i, row) in rows.iter().enumerate() {
            let rest: Vec<usize> = rows.iter().copied().filter(|r| r != row).collect();
            let minor = self.determinant(matrix, size, &rest, column + 1)?;
            let term = self.float2(FloatOp::Mul, matrix[column * size + row], minor)?;
            sum = match (sum, i % 2) {
                (NONE, _) => term,
                (_, 0) => self.float2(FloatOp::Add, sum, term)?,
                _ => self.float2(FloatOp::Sub, sum, term)?,
            };
        }
        Ok(sum)
    }

    /// Puts the low `width` bits of each word side by side, the first lowest.
    fn pack(&mut self, words: &[Reg], width: u32) -> Result<Regs> {
        let low = self.word((1 << width) - 1);
        let mut packed = NONE;
        for (i, word) in words.iter().enumerate() {
            let part = self.bits2(BitsOp::And, *word, low)?;
            let shift = self.word(width * i as u32);
            let moved = self.bits2(BitsOp::Shl, part, shift)?;
            packed = if packed == NONE { moved } else { self.bits2(BitsOp::Or, packed, moved)? };
        }
        Ok([packed].into())
    }

    fn pack_clamped(&mut self, words: &[Reg], max: BitsOp, low: i32, min: BitsOp, high: i32) -> Result<Regs> {
        let (low, high) = (self.word(low.cast_unsigned()), self.word(high.cast_unsigned()));
        let clamped: Vec<Reg> = words
            .iter()
            .map(|w| {
                let raised = self.bits2(max, *w, low)?;
                self.bits2(min, raised, high)
            })
            .collect::<Result<_>>()?;
        self.pack(&clamped, 8)
    }

    /// floor(1/2 + clamp(x) (2^bits - 1)), for signed numbers with 2^(bits - 1) - 1.
    fn pack_normalized(&mut self, regs: &[Reg], width: u32, signed: bool) -> Result<Regs> {
        let class = self.class(regs[0]);
        let size = if signed { (1_u32 << (width - 1)) - 1 } else { (1_u32 << width) - 1 };
        let (low, high) = (self.number(class, if signed { -1.0 } else { 0.0 }), self.number(class, 1.0));
        let (size, half) = (self.number(class, f64::from(size)), self.number(class, 0.5));
        let words: Vec<Reg> = regs
            .iter()
            .map(|r| {
                let x = self.rounded(*r)?;
                let x = self.float3(FloatOp::Clamp, x, low, high)?;
                let x = self.float2(FloatOp::Mul, x, size)?;
                let x = self.float2(FloatOp::Add, x, half)?;
                let x = self.float1(FloatOp::Floor, x)?;
                self.emit(Op::Convert(Convert::SignedFromFloat), Class::Bits, [x, NONE, NONE])
            })
            .collect::<Result<_>>()?;
        self.pack(&words, width)
    }

    /// The parts of a word, the lowest first.
    fn unpack(&mut self, word: Reg, width: u32, extract: BitsOp) -> Result<Regs> {
        (0..32 / width)
            .map(|i| {
                let (offset, count) = (self.word(width * i), self.word(width));
                self.bits3(extract, word, offset, count)
            })
            .collect()
    }

    /// x / (2^bits - 1), for signed numbers max(x / (2^(bits - 1) - 1), -1).
    fn unpack_normalized(&mut self, word: Reg, width: u32, signed: bool) -> Result<Regs> {
        let (extract, convert, size) = if signed {
            (BitsOp::ExtractS, Convert::FloatFromSigned, (1_u32 << (width - 1)) - 1)
        } else {
            (BitsOp::ExtractU, Convert::FloatFromUnsigned, (1_u32 << width) - 1)
        };
        let parts = self.unpack(word, width, extract)?;
        let (size, low) = (self.number(Class::Float, f64::from(size)), self.number(Class::Float, -1.0));
        parts
            .iter()
            .map(|p| {
                let x = self.emit(Op::Convert(convert), Class::Float, [*p, NONE, NONE])?;
                let x = self.float2(FloatOp::Div, x, size)?;
                if signed { self.float2(FloatOp::Max, x, low) } else { Ok(x) }
            })
            .collect()
    }
}
