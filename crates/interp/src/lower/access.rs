//! Parts of values, and pointers: to variables, whose registers are known or picked by index, and into buffers, whose
//! bytes are addressed.

use naga::{AddressSpace, Expression, Handle, TypeInner};

use super::{Frame, Lower, Regs, Result, Value};
use crate::ir::{BufferAccess, Class, Inst, NONE, Node, Op, Reg, Table};
use crate::kernel::{BitsOp, Convert};
use crate::shape::{self, Parts};

/// An index that is known at run time only, limited to its range: it counts in scalars (variables) or bytes (buffers).
#[derive(Clone, Debug)]
struct Dynamic {
    index: Reg,
    stride: u32,
    /// Elements that it may name.
    count: u32,
}

/// Part of a variable.
#[derive(Clone, Debug)]
pub(super) struct VariablePlace {
    regs: Regs,
    start: usize,
    inner: TypeInner,
    dynamic: Vec<Dynamic>,
}

/// Part of a uniform or storage buffer.
#[derive(Clone, Debug)]
pub(super) struct BufferPlace {
    buffer: u32,
    offset: u32,
    inner: TypeInner,
    dynamic: Vec<Dynamic>,
}

#[derive(Clone, Debug)]
pub(super) enum Pointer {
    Variable(VariablePlace),
    Buffer(BufferPlace),
}

impl<'m> Lower<'m> {
    /// Where a part begins among the scalars of a composite, and its type.
    fn part(&self, inner: &TypeInner, index: usize) -> Result<(usize, TypeInner)> {
        let module = self.module;
        let size = |ty: &TypeInner| shape::count(module, ty).or_else(|what| self.refuse(what));
        Ok(match shape::parts(inner) {
            Some(Parts::Scalars(_, scalar)) => (index, TypeInner::Scalar(scalar)),
            Some(Parts::Columns(_, column)) => (index * size(&column)?, column),
            Some(Parts::Elements(_, base, _)) => {
                let base = module.types[base].inner.clone();
                (index * size(&base)?, base)
            }
            Some(Parts::Members(members)) => {
                let mut start = 0;
                for member in &members[..index] {
                    start += size(&module.types[member.ty].inner)?;
                }
                (start, module.types[members[index].ty].inner.clone())
            }
            None => return self.refuse("an index into a value that has no parts"),
        })
    }

    /// How many parts a composite has (`None` where the run knows).
    fn part_count(&self, inner: &TypeInner) -> Option<usize> {
        match shape::parts(inner)? {
            Parts::Scalars(n, _) | Parts::Columns(n, _) => Some(n),
            Parts::Elements(n, ..) => n,
            Parts::Members(members) => Some(members.len()),
        }
    }

    /// An index that is a number in the text.
    fn fixed(&self, frame: &Frame<'m>, index: Handle<Expression>) -> Option<u32> {
        let literal = match &frame.function.expressions[index] {
            Expression::Literal(literal) => *literal,
            Expression::Constant(constant) => {
                match self.module.global_expressions[self.module.constants[*constant].init] {
                    Expression::Literal(literal) => literal,
                    _ => return None,
                }
            }
            _ => return None,
        };
        match literal {
            naga::Literal::U32(x) => Some(x),
            naga::Literal::I32(x) => Some(x.cast_unsigned()),
            _ => None,
        }
    }

    pub(super) fn access(
        &mut self,
        frame: &mut Frame<'m>,
        base: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Result<Value> {
        if let Some(fixed) = self.fixed(frame, index) {
            return self.access_fixed(frame, base, fixed);
        }
        let index = self.regs(frame, index)?[0];
        match self.value(frame, base)? {
            Value::Regs(regs) => {
                let inner = frame.info[base].ty.inner_with(&self.module.types).clone();
                let whole = VariablePlace { regs, start: 0, inner, dynamic: Vec::new() };
                let part = self.index_variable(&whole, index)?;
                Ok(Value::Regs(self.load_variable(&part, false)?))
            }
            Value::Pointer(Pointer::Variable(place)) => {
                Ok(Value::Pointer(Pointer::Variable(self.index_variable(&place, index)?)))
            }
            Value::Pointer(Pointer::Buffer(place)) => {
                Ok(Value::Pointer(Pointer::Buffer(self.index_buffer(&place, index)?)))
            }
            Value::Handle(_) => self.refuse("arrays of bindings"),
        }
    }

    pub(super) fn access_fixed(
        &mut self,
        frame: &mut Frame<'m>,
        base: Handle<Expression>,
        index: u32,
    ) -> Result<Value> {
        match self.value(frame, base)? {
            Value::Regs(regs) => {
                let inner = frame.info[base].ty.inner_with(&self.module.types).clone();
                let index = (index as usize).min(self.part_count(&inner).unwrap_or(1) - 1);
                let (start, part) = self.part(&inner, index)?;
                let len = shape::count(self.module, &part).or_else(|what| self.refuse(what))?;
                Ok(Value::Regs(regs[start..start + len].into()))
            }
            Value::Pointer(Pointer::Variable(place)) => {
                let index = (index as usize).min(self.part_count(&place.inner).unwrap_or(1) - 1);
                let (start, inner) = self.part(&place.inner, index)?;
                Ok(Value::Pointer(Pointer::Variable(VariablePlace { start: place.start + start, inner, ..place })))
            }
            Value::Pointer(Pointer::Buffer(place)) => {
                if self.part_count(&place.inner).is_none() {
                    let word = self.word(index);
                    return Ok(Value::Pointer(Pointer::Buffer(self.index_buffer(&place, word)?)));
                }
                let (offset, inner) = self.buffer_part(&place.inner, index)?;
                Ok(Value::Pointer(Pointer::Buffer(BufferPlace { offset: place.offset + offset, inner, ..place })))
            }
            Value::Handle(_) => self.refuse("arrays of bindings"),
        }
    }

    fn index_variable(&mut self, place: &VariablePlace, index: Reg) -> Result<VariablePlace> {
        let count = self.part_count(&place.inner).unwrap_or(1) as u32;
        let (_, inner) = self.part(&place.inner, 0)?;
        let stride = shape::count(self.module, &inner).or_else(|what| self.refuse(what))? as u32;
        let index = self.limited(index, count)?;
        let mut dynamic = place.dynamic.clone();
        dynamic.push(Dynamic { index, stride, count });
        Ok(VariablePlace { regs: place.regs.clone(), start: place.start, inner, dynamic })
    }

    /// WGSL 2023, 6.4: an index out of range names some element; here the last one.
    fn limited(&mut self, index: Reg, count: u32) -> Result<Reg> {
        let last = self.word(count - 1);
        self.emit(Op::Bits(BitsOp::MinU), Class::Bits, [index, last, NONE])
    }

    /// Offset and type of a part in a buffer.
    fn buffer_part(&self, inner: &TypeInner, index: u32) -> Result<(u32, TypeInner)> {
        let types = &self.module.types;
        Ok(match shape::parts(inner) {
            Some(Parts::Scalars(_, scalar)) => (index * u32::from(scalar.width), TypeInner::Scalar(scalar)),
            Some(Parts::Columns(_, column)) => {
                let TypeInner::Vector { size, scalar } = column else {
                    return self.refuse("a matrix without columns");
                };
                (index * shape::column_stride(size as usize, scalar.width), column)
            }
            Some(Parts::Elements(_, base, stride)) => (index * stride, types[base].inner.clone()),
            Some(Parts::Members(members)) => {
                let member = &members[index as usize];
                (member.offset, types[member.ty].inner.clone())
            }
            None => return self.refuse("an index into a value that has no parts"),
        })
    }

    fn index_buffer(&mut self, place: &BufferPlace, index: Reg) -> Result<BufferPlace> {
        let (stride, inner) = match self.part_count(&place.inner) {
            Some(1) => (0, self.buffer_part(&place.inner, 0)?.1),
            _ => self.buffer_part(&place.inner, 1)?,
        };
        let index = match self.part_count(&place.inner) {
            Some(count) => self.limited(index, count as u32)?,
            None => {
                let length = self.array_length(place)?;
                let one = self.word(1);
                let last = self.emit(Op::Bits(BitsOp::Sub), Class::Bits, [length, one, NONE])?;
                self.emit(Op::Bits(BitsOp::MinU), Class::Bits, [index, last, NONE])?
            }
        };
        let mut dynamic = place.dynamic.clone();
        dynamic.push(Dynamic { index, stride, count: 0 });
        Ok(BufferPlace { buffer: place.buffer, offset: place.offset, inner, dynamic })
    }

    fn array_length(&mut self, place: &BufferPlace) -> Result<Reg> {
        let TypeInner::Array { stride, .. } = place.inner else {
            return self.refuse("the length of something that is no array");
        };
        let access = self.access_of(BufferAccess { buffer: place.buffer, offset: place.offset, stride });
        self.emit(Op::Length(access), Class::Bits, [NONE; 3])
    }

    pub(super) fn array_length_of(&mut self, frame: &mut Frame<'m>, array: Handle<Expression>) -> Result<Regs> {
        match self.value(frame, array)? {
            Value::Pointer(Pointer::Buffer(place)) => Ok([self.array_length(&place)?].into()),
            _ => self.refuse("the length of an array that is in no buffer"),
        }
    }

    /// The sum of all indices times their strides.
    fn address(&mut self, dynamic: &[Dynamic]) -> Result<Reg> {
        let mut sum = NONE;
        for Dynamic { index, stride, .. } in dynamic {
            let term = if *stride == 1 {
                *index
            } else {
                let stride = self.word(*stride);
                self.emit(Op::Bits(BitsOp::Mul), Class::Bits, [*index, stride, NONE])?
            };
            sum = if sum == NONE { term } else { self.emit(Op::Bits(BitsOp::Add), Class::Bits, [sum, term, NONE])? };
        }
        Ok(sum)
    }

    /// The table of the registers that scalar `i` of a place may be in.
    fn table(&mut self, place: &VariablePlace, i: usize) -> u32 {
        let pool = self.pool(&place.regs);
        let span: u32 = place.dynamic.iter().map(|d| (d.count - 1) * d.stride).sum();
        self.ir.tables.push(Table { pool, start: (place.start + i) as u32, len: span + 1 });
        (self.ir.tables.len() - 1) as u32
    }

    fn load_variable(&mut self, place: &VariablePlace, copies: bool) -> Result<Regs> {
        let len = shape::count(self.module, &place.inner).or_else(|what| self.refuse(what))?;
        if place.dynamic.is_empty() {
            let regs = &place.regs[place.start..place.start + len];
            return if copies { self.copy(regs) } else { Ok(regs.into()) };
        }
        let address = self.address(&place.dynamic)?;
        let mut regs = Vec::with_capacity(len);
        for i in 0..len {
            let table = self.table(place, i);
            let class = self.class(place.regs[place.start + i]);
            regs.push(self.emit(Op::Gather(table), class, [address, NONE, NONE])?);
        }
        Ok(regs.into())
    }

    pub(super) fn store_variable(&mut self, place: &VariablePlace, value: &[Reg]) -> Result<()> {
        if place.dynamic.is_empty() {
            // A value that is made of the variable itself (`v = v.yx`) is read before any of it is written.
            let target = &place.regs[place.start..place.start + value.len()];
            let crossed = value.iter().enumerate().any(|(i, v)| target[..i].contains(v));
            let value: Regs = if crossed { self.copy(value)? } else { value.into() };
            for (dst, value) in place.regs[place.start..].iter().zip(value.iter()) {
                if dst != value {
                    self.store(*dst, *value)?;
                }
            }
            return Ok(());
        }
        let address = self.address(&place.dynamic)?;
        for (i, value) in value.iter().enumerate() {
            let table = self.table(place, i);
            self.push(Node::Inst(Inst { op: Op::Scatter(table), dst: NONE, a: address, b: *value, c: NONE }))?;
        }
        Ok(())
    }

    pub(super) fn load(&mut self, frame: &mut Frame<'m>, pointer: Handle<Expression>, copies: bool) -> Result<Regs> {
        match self.value(frame, pointer)? {
            Value::Pointer(Pointer::Variable(place)) => self.load_variable(&place, copies),
            Value::Pointer(Pointer::Buffer(place)) => self.load_buffer(&place),
            _ => self.refuse("reading through something that is no pointer"),
        }
    }

    /// Adds to the list of what is read and written of buffers.
    fn access_of(&mut self, access: BufferAccess) -> u32 {
        self.ir.accesses.push(access);
        (self.ir.accesses.len() - 1) as u32
    }

    /// The byte offsets of a place's scalars, before its indices count.
    fn buffer_offsets(&self, place: &BufferPlace) -> Vec<u32> {
        let mut offsets = Vec::new();
        shape::offsets(self.module, &place.inner, place.offset, &mut offsets);
        offsets
    }

    fn load_buffer(&mut self, place: &BufferPlace) -> Result<Regs> {
        let classes = self.classes(&place.inner)?;
        let address = self.address(&place.dynamic)?;
        let mut regs = Vec::with_capacity(classes.len());
        for (class, offset) in classes.into_iter().zip(self.buffer_offsets(place)) {
            let access = self.access_of(BufferAccess { buffer: place.buffer, offset, stride: 0 });
            regs.push(self.emit(Op::Load(access), class, [address, NONE, NONE])?);
        }
        Ok(regs.into())
    }

    pub(super) fn store_buffer(&mut self, place: &BufferPlace, value: &[Reg]) -> Result<()> {
        let address = self.address(&place.dynamic)?;
        for (value, offset) in value.iter().zip(self.buffer_offsets(place)) {
            let access = self.access_of(BufferAccess { buffer: place.buffer, offset, stride: 0 });
            self.push(Node::Inst(Inst { op: Op::Store(access), dst: NONE, a: address, b: *value, c: NONE }))?;
        }
        Ok(())
    }

    /// What a global variable is as an expression.
    pub(super) fn global(&mut self, handle: Handle<naga::GlobalVariable>) -> Result<Value> {
        let variable = &self.module.global_variables[handle];
        let inner = self.module.types[variable.ty].inner.clone();
        match variable.space {
            AddressSpace::Handle => Ok(Value::Handle(handle)),
            AddressSpace::Private => {
                let regs = self.private(handle)?;
                Ok(Value::Pointer(Pointer::Variable(VariablePlace { regs, start: 0, inner, dynamic: Vec::new() })))
            }
            AddressSpace::Uniform | AddressSpace::Storage { .. } => {
                let buffer = self.resource(handle, |ir| &mut ir.buffers)?;
                Ok(Value::Pointer(Pointer::Buffer(BufferPlace { buffer, offset: 0, inner, dynamic: Vec::new() })))
            }
            AddressSpace::WorkGroup => self.refuse("workgroup memory"),
            _ => self.refuse("a variable that no fragment, vertex or compute shader of WGSL has"),
        }
    }

    pub(super) fn local(&mut self, frame: &Frame<'m>, handle: Handle<naga::LocalVariable>) -> Value {
        let regs = frame.locals[handle.index()].clone();
        let inner = self.module.types[frame.function.local_variables[handle].ty].inner.clone();
        Value::Pointer(Pointer::Variable(VariablePlace { regs, start: 0, inner, dynamic: Vec::new() }))
    }

    /// The f32 of a float register, for what WGSL defines on bits.
    pub(super) fn rounded(&mut self, reg: Reg) -> Result<Reg> {
        self.emit(Op::Convert(Convert::RoundToF32), self.class(reg), [reg, NONE, NONE])
    }
}
