//! Expressions that are neither arithmetic nor texture reads.

use naga::{Expression, Handle, RelationalFunction, ScalarKind, TypeInner};

use super::{Frame, Lower, Regs, Result, Value, is_signed, scalar_of, span_of};
use crate::ir::{Class, NONE, Op, Reg};
use crate::kernel::{BitsOp, CompareOp, Convert};

impl<'m> Lower<'m> {
    /// The registers of an expression.
    pub(super) fn regs(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Regs> {
        match self.value(frame, handle)? {
            Value::Regs(regs) => Ok(regs),
            Value::Pointer(_) => self.refuse_at("a pointer as a value", span_of(&frame.function.expressions, handle)),
            Value::Handle(_) => {
                self.refuse_at("a texture or sampler as a value", span_of(&frame.function.expressions, handle))
            }
        }
    }

    /// What has been emitted, or an expression that needs no emission.
    pub(super) fn value(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Value> {
        match &frame.values[handle.index()] {
            Some(value) => Ok(value.clone()),
            None => self.expression(frame, handle),
        }
    }

    /// The scalar that an expression's value is made of.
    pub(super) fn scalar(&self, frame: &Frame<'m>, handle: Handle<Expression>) -> Option<naga::Scalar> {
        scalar_of(frame.info[handle].ty.inner_with(&self.module.types))
    }

    pub(super) fn inner<'a>(&'a self, frame: &'a Frame<'m>, handle: Handle<Expression>) -> &'a TypeInner {
        frame.info[handle].ty.inner_with(&self.module.types)
    }

    pub(super) fn expression(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Value> {
        let function = frame.function;
        self.place.span = span_of(&function.expressions, handle).to_range();
        let regs: Regs = match &function.expressions[handle] {
            Expression::Literal(literal) => [self.literal(*literal)?].into(),
            Expression::Constant(constant) => self.global_value(self.module.constants[*constant].init)?,
            Expression::Override(_) => {
                return self.refuse("an override constant whose value is not set");
            }
            Expression::ZeroValue(ty) => self.zero(&self.module.types[*ty].inner)?,
            Expression::Compose { components, .. } => {
                let mut all = Vec::new();
                for component in components {
                    all.extend(self.regs(frame, *component)?.iter());
                }
                all.into()
            }
            Expression::Access { base, index } => return self.access(frame, *base, *index),
            Expression::AccessIndex { base, index } => return self.access_fixed(frame, *base, *index),
            Expression::Splat { size, value } => vec![self.regs(frame, *value)?[0]; *size as usize].into(),
            Expression::Swizzle { size, vector, pattern } => {
                let vector = self.regs(frame, *vector)?;
                pattern[..*size as usize].iter().map(|c| vector[*c as usize]).collect()
            }
            Expression::FunctionArgument(index) => return Ok(frame.arguments[*index as usize].clone()),
            Expression::GlobalVariable(global) => return self.global(*global),
            Expression::LocalVariable(local) => return Ok(self.local(frame, *local)),
            Expression::Load { pointer } => {
                let copies = frame.copies.contains(&handle);
                self.load(frame, *pointer, copies)?
            }
            Expression::ImageSample { .. } | Expression::ImageLoad { .. } | Expression::ImageQuery { .. } => {
                self.texture(frame, handle)?
            }
            Expression::Unary { op, expr } => self.unary(frame, *op, *expr)?,
            Expression::Binary { op, left, right } => self.binary(frame, *op, *left, *right)?,
            Expression::Select { condition, accept, reject } => {
                let condition = self.regs(frame, *condition)?;
                let (accept, reject) = (self.regs(frame, *accept)?, self.regs(frame, *reject)?);
                let mut all = Vec::new();
                for (i, (a, r)) in accept.iter().zip(reject.iter()).enumerate() {
                    let condition = condition[i.min(condition.len() - 1)];
                    all.push(self.emit(Op::Select, self.class(*a), [condition, *a, *r])?);
                }
                all.into()
            }
            // Coarse ones may be of fewer places than fine ones, and need not: llvmpipe, too, takes all of the pixel's own row and column.
            Expression::Derivative { axis, ctrl: _, expr } => {
                let value = self.regs(frame, *expr)?;
                value.iter().map(|r| self.derivative(*axis, *r)).collect::<Result<_>>()?
            }
            Expression::Relational { fun, argument } => self.relational(frame, *fun, *argument)?,
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let mut arguments = vec![self.regs(frame, *arg)?];
                for more in [arg1, arg2, arg3].into_iter().flatten() {
                    arguments.push(self.regs(frame, *more)?);
                }
                let scalar = self.scalar(frame, *arg);
                let inner = self.inner(frame, *arg).clone();
                self.math(*fun, &inner, scalar, &arguments)?
            }
            Expression::As { expr, kind, convert } => self.cast(frame, *expr, *kind, *convert)?,
            Expression::CallResult(_) => return self.refuse("the result of a call before the call"),
            Expression::ArrayLength(array) => self.array_length_of(frame, *array)?,
            Expression::AtomicResult { .. } => return self.refuse("atomic operations"),
            Expression::WorkGroupUniformLoadResult { .. } => return self.refuse("workgroup memory"),
            Expression::RayQueryVertexPositions { .. }
            | Expression::RayQueryProceedResult
            | Expression::RayQueryGetIntersection { .. } => return self.refuse("ray queries"),
            Expression::SubgroupBallotResult | Expression::SubgroupOperationResult { .. } => {
                return self.refuse("subgroup operations");
            }
            Expression::CooperativeLoad { .. } | Expression::CooperativeMultiplyAdd { .. } => {
                return self.refuse("cooperative matrices");
            }
        };
        Ok(Value::Regs(regs))
    }

    fn derivative(&mut self, axis: naga::DerivativeAxis, reg: Reg) -> Result<Reg> {
        let class = self.class(reg);
        let along = |vertical| Op::Derivative { vertical, coarse: false };
        match axis {
            naga::DerivativeAxis::X => self.emit(along(false), class, [reg, NONE, NONE]),
            naga::DerivativeAxis::Y => self.emit(along(true), class, [reg, NONE, NONE]),
            naga::DerivativeAxis::Width => {
                let x = self.emit(along(false), class, [reg, NONE, NONE])?;
                let y = self.emit(along(true), class, [reg, NONE, NONE])?;
                let (x, y) =
                    (self.float1(crate::kernel::FloatOp::Abs, x)?, self.float1(crate::kernel::FloatOp::Abs, y)?);
                self.float2(crate::kernel::FloatOp::Add, x, y)
            }
        }
    }

    fn relational(
        &mut self,
        frame: &mut Frame<'m>,
        fun: RelationalFunction,
        argument: Handle<Expression>,
    ) -> Result<Regs> {
        let regs = self.regs(frame, argument)?;
        let compare = match fun {
            RelationalFunction::All | RelationalFunction::Any => {
                let op = if fun == RelationalFunction::All { BitsOp::And } else { BitsOp::Or };
                let mut all = regs[0];
                for reg in &regs[1..] {
                    all = self.bits2(op, all, *reg)?;
                }
                return Ok([all].into());
            }
            RelationalFunction::IsNan => CompareOp::IsNan,
            RelationalFunction::IsInf => CompareOp::IsInf,
        };
        regs.iter().map(|r| self.emit(Op::Compare(compare), Class::Bits, [*r, NONE, NONE])).collect()
    }

    /// Conversions and bitcasts.
    fn cast(
        &mut self,
        frame: &mut Frame<'m>,
        expr: Handle<Expression>,
        kind: ScalarKind,
        convert: Option<u8>,
    ) -> Result<Regs> {
        let regs = self.regs(frame, expr)?;
        let Some(from) = self.scalar(frame, expr) else {
            return self.refuse("a conversion of a value that is not made of scalars");
        };
        let to = naga::Scalar { kind, width: convert.unwrap_or(from.width) };
        let class = crate::shape::class_of(to).or_else(|what| self.refuse(what))?;
        if convert.is_none() && self.class(regs[0]) == Class::Double {
            return self.refuse("bitcast of an f64");
        }
        regs.iter().map(|r| self.cast_one(from, to, class, *r, convert.is_none())).collect()
    }

    fn cast_one(&mut self, from: naga::Scalar, to: naga::Scalar, class: Class, reg: Reg, bitcast: bool) -> Result<Reg> {
        let convert = |op| Op::Convert(op);
        let float = |kind| kind == ScalarKind::Float;
        match (from.kind, to.kind) {
            (a, b) if float(a) && float(b) => {
                if self.class(reg) == class {
                    return Ok(reg);
                }
                self.emit(convert(Convert::FloatFromFloat), class, [reg, NONE, NONE])
            }
            (a, b) if float(a) && b != ScalarKind::Bool => {
                let op = match (bitcast, is_signed(to)) {
                    (true, _) => Convert::BitsFromFloat,
                    (false, true) => Convert::SignedFromFloat,
                    (false, false) => Convert::UnsignedFromFloat,
                };
                self.emit(convert(op), class, [reg, NONE, NONE])
            }
            (a, ScalarKind::Bool) if float(a) => {
                let zero = self.number(self.class(reg), 0.0);
                self.emit(Op::Compare(CompareOp::NotEqual), Class::Bits, [reg, zero, NONE])
            }
            (ScalarKind::Bool, b) if float(b) => {
                let (one, zero) = (self.number(class, 1.0), self.number(class, 0.0));
                self.emit(Op::Select, class, [reg, one, zero])
            }
            (_, b) if float(b) => {
                let op = match (bitcast, is_signed(from)) {
                    (true, _) => Convert::FloatFromBits,
                    (false, true) => Convert::FloatFromSigned,
                    (false, false) => Convert::FloatFromUnsigned,
                };
                self.emit(convert(op), class, [reg, NONE, NONE])
            }
            (ScalarKind::Bool, ScalarKind::Bool) => Ok(reg),
            (ScalarKind::Bool, _) => {
                let one = self.word(1);
                self.bits2(BitsOp::And, reg, one)
            }
            (_, ScalarKind::Bool) => {
                let zero = self.word(0);
                self.bits2(BitsOp::NotEqual, reg, zero)
            }
            // The same 32 bits.
            _ => Ok(reg),
        }
    }
}
