//! Unary and binary operators, on scalars, vectors and matrices.

use naga::{BinaryOperator, Expression, Handle, ScalarKind, TypeInner, UnaryOperator};

use super::{Frame, Lower, Regs, Result, is_signed};
use crate::ir::{Class, NONE, Op, Reg};
use crate::kernel::{BitsOp, CompareOp, FloatOp};

impl<'m> Lower<'m> {
    pub(super) fn float1(&mut self, op: FloatOp, a: Reg) -> Result<Reg> {
        self.emit(Op::Float(op), self.class(a), [a, NONE, NONE])
    }

    pub(super) fn float2(&mut self, op: FloatOp, a: Reg, b: Reg) -> Result<Reg> {
        self.emit(Op::Float(op), self.class(a), [a, b, NONE])
    }

    pub(super) fn float3(&mut self, op: FloatOp, a: Reg, b: Reg, c: Reg) -> Result<Reg> {
        self.emit(Op::Float(op), self.class(a), [a, b, c])
    }

    pub(super) fn bits1(&mut self, op: BitsOp, a: Reg) -> Result<Reg> {
        self.emit(Op::Bits(op), Class::Bits, [a, NONE, NONE])
    }

    pub(super) fn bits2(&mut self, op: BitsOp, a: Reg, b: Reg) -> Result<Reg> {
        self.emit(Op::Bits(op), Class::Bits, [a, b, NONE])
    }

    pub(super) fn bits3(&mut self, op: BitsOp, a: Reg, b: Reg, c: Reg) -> Result<Reg> {
        self.emit(Op::Bits(op), Class::Bits, [a, b, c])
    }

    pub(super) fn unary(&mut self, frame: &mut Frame<'m>, op: UnaryOperator, expr: Handle<Expression>) -> Result<Regs> {
        let regs = self.regs(frame, expr)?;
        let float = |class| class != Class::Bits;
        regs.iter()
            .map(|r| match op {
                UnaryOperator::Negate if float(self.class(*r)) => self.float1(FloatOp::Neg, *r),
                UnaryOperator::Negate => self.bits1(BitsOp::Neg, *r),
                UnaryOperator::LogicalNot | UnaryOperator::BitwiseNot => self.bits1(BitsOp::Not, *r),
            })
            .collect()
    }

    pub(super) fn binary(
        &mut self,
        frame: &mut Frame<'m>,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<Regs> {
        let (a, b) = (self.regs(frame, left)?, self.regs(frame, right)?);
        if op == BinaryOperator::Multiply {
            let (left, right) = (self.inner(frame, left).clone(), self.inner(frame, right).clone());
            match (left, right) {
                (TypeInner::Matrix { columns, rows, .. }, TypeInner::Vector { .. }) => {
                    return self.matrix_vector(&a, &b, columns as usize, rows as usize);
                }
                (TypeInner::Vector { .. }, TypeInner::Matrix { columns, rows, .. }) => {
                    let rows = rows as usize;
                    return (0..columns as usize).map(|j| self.dot(&a, &b[j * rows..][..rows])).collect();
                }
                (TypeInner::Matrix { columns, rows, .. }, TypeInner::Matrix { columns: width, .. }) => {
                    let (columns, rows) = (columns as usize, rows as usize);
                    let mut all = Vec::new();
                    for j in 0..width as usize {
                        all.extend(self.matrix_vector(&a, &b[j * columns..][..columns], columns, rows)?.iter());
                    }
                    return Ok(all.into());
                }
                _ => {}
            }
        }
        let Some(scalar) = self.scalar(frame, left) else {
            return self.refuse("an operator on values that are not made of scalars");
        };
        let len = a.len().max(b.len());
        (0..len).map(|i| self.binary_one(op, scalar, a[i.min(a.len() - 1)], b[i.min(b.len() - 1)])).collect()
    }

    fn binary_one(&mut self, op: BinaryOperator, scalar: naga::Scalar, a: Reg, b: Reg) -> Result<Reg> {
        use BinaryOperator as B;
        if scalar.kind == ScalarKind::Float {
            let compare = |compare, a, b| (Op::Compare(compare), Class::Bits, [a, b, NONE]);
            let class = self.class(a);
            let float = |op| (Op::Float(op), class, [a, b, NONE]);
            let (op, class, operands) = match op {
                B::Add => float(FloatOp::Add),
                B::Subtract => float(FloatOp::Sub),
                B::Multiply => float(FloatOp::Mul),
                B::Divide => float(FloatOp::Div),
                B::Modulo => float(FloatOp::Rem),
                B::Equal => compare(CompareOp::Equal, a, b),
                B::NotEqual => compare(CompareOp::NotEqual, a, b),
                B::Less => compare(CompareOp::Less, a, b),
                B::LessEqual => compare(CompareOp::LessEqual, a, b),
                B::Greater => compare(CompareOp::Less, b, a),
                B::GreaterEqual => compare(CompareOp::LessEqual, b, a),
                _ => return self.refuse("an operator of whole numbers on floats"),
            };
            return self.emit(op, class, operands);
        }
        let signed = is_signed(scalar);
        let pick = |s, u| if signed { s } else { u };
        let (op, a, b) = match op {
            B::Add => (BitsOp::Add, a, b),
            B::Subtract => (BitsOp::Sub, a, b),
            B::Multiply => (BitsOp::Mul, a, b),
            B::Divide => (pick(BitsOp::DivS, BitsOp::DivU), a, b),
            B::Modulo => (pick(BitsOp::RemS, BitsOp::RemU), a, b),
            B::Equal => (BitsOp::Equal, a, b),
            B::NotEqual => (BitsOp::NotEqual, a, b),
            B::Less => (pick(BitsOp::LessS, BitsOp::LessU), a, b),
            B::LessEqual => (pick(BitsOp::LessEqualS, BitsOp::LessEqualU), a, b),
            B::Greater => (pick(BitsOp::LessS, BitsOp::LessU), b, a),
            B::GreaterEqual => (pick(BitsOp::LessEqualS, BitsOp::LessEqualU), b, a),
            B::And | B::LogicalAnd => (BitsOp::And, a, b),
            B::InclusiveOr | B::LogicalOr => (BitsOp::Or, a, b),
            B::ExclusiveOr => (BitsOp::Xor, a, b),
            B::ShiftLeft => (BitsOp::Shl, a, b),
            B::ShiftRight => (pick(BitsOp::ShrS, BitsOp::ShrU), a, b),
        };
        self.bits2(op, a, b)
    }

    /// The sum of the products, from the first to the last.
    pub(super) fn dot(&mut self, a: &[Reg], b: &[Reg]) -> Result<Reg> {
        let float = self.class(a[0]) != Class::Bits;
        let mut sum = NONE;
        for (a, b) in a.iter().zip(b) {
            let product = if float { self.float2(FloatOp::Mul, *a, *b)? } else { self.bits2(BitsOp::Mul, *a, *b)? };
            sum = match (sum, float) {
                (NONE, _) => product,
                (_, true) => self.float2(FloatOp::Add, sum, product)?,
                (_, false) => self.bits2(BitsOp::Add, sum, product)?,
            };
        }
        Ok(sum)
    }

    fn matrix_vector(&mut self, matrix: &[Reg], vector: &[Reg], columns: usize, rows: usize) -> Result<Regs> {
        (0..rows)
            .map(|i| {
                let row: Vec<Reg> = (0..columns).map(|j| matrix[j * rows + i]).collect();
                self.dot(&row, vector)
            })
            .collect()
    }
}
