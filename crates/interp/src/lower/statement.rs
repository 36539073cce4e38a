//! Statements and calls.

use std::rc::Rc;

use naga::valid::FunctionInfo;
use naga::{Block, Function, Statement, SwitchValue};

use super::access::Pointer;
use super::{Frame, Lower, Regs, Result, Value, plan};
use crate::error::Place;
use crate::ir::{Class, NONE, Node, Op, Origin, Reg};
use crate::kernel::BitsOp;

/// Whether a block holds a return anywhere.
fn returns(statements: &[Statement]) -> bool {
    statements.iter().any(|statement| match statement {
        Statement::Return { .. } => true,
        Statement::Block(block) => returns(block),
        Statement::If { accept, reject, .. } => returns(accept) || returns(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| returns(&case.body)),
        Statement::Loop { body, continuing, .. } => returns(body) || returns(continuing),
        _ => false,
    })
}

impl<'m> Lower<'m> {
    /// Puts a function's body here and returns the registers of its result.
    pub(super) fn call(
        &mut self,
        function: &'m Function,
        info: &'m FunctionInfo,
        name: &'m str,
        arguments: Vec<Value>,
    ) -> Result<Option<Regs>> {
        let outer = std::mem::replace(&mut self.place, Place { function: name.to_string(), span: None });
        self.scopes += 1;
        let scope = self.scopes;
        let outer_scope = std::mem::replace(&mut self.scope, scope);
        let copies = match self.plans.get(&std::ptr::from_ref(function)) {
            Some(plan) => plan.clone(),
            None => {
                let plan = Rc::new(plan::loads_that_copy(function));
                self.plans.insert(std::ptr::from_ref(function), plan.clone());
                plan
            }
        };
        let mut frame = Frame {
            function,
            info,
            name,
            arguments,
            values: vec![None; function.expressions.len()],
            locals: Vec::new(),
            copies,
            scope,
            result: None,
            returned: None,
        };
        // One return at the very end needs no variable for the result.
        let early = match function.body.split_last() {
            Some((Statement::Return { .. }, before)) => returns(before),
            _ => returns(&function.body),
        };
        if early && let Some(result) = &function.result {
            let inner = &self.module.types[result.ty].inner;
            // It belongs to the caller: lanes that have returned still hold it.
            let owner = outer_scope;
            let classes = self.classes(inner)?;
            frame.result =
                Some(classes.into_iter().map(|class| self.register(class, Origin::Variable(owner))).collect());
        }
        let body = self.nested(|lower| {
            for (_, local) in function.local_variables.iter() {
                let regs = lower.variables(&lower.module.types[local.ty].inner, scope)?;
                frame.locals.push(regs);
            }
            for (handle, local) in function.local_variables.iter() {
                let values = match local.init {
                    Some(init) => lower.regs(&mut frame, init)?,
                    None => lower.zero(&lower.module.types[local.ty].inner)?,
                };
                let regs = frame.locals[handle.index()].clone();
                for (dst, value) in regs.iter().zip(values.iter()) {
                    lower.store(*dst, *value)?;
                }
            }
            lower.block(&mut frame, &function.body, !early)
        })?;
        self.push(Node::Scope { id: scope, body, divergent: false })?;
        self.scope = outer_scope;
        self.place = outer;
        Ok(frame.result.or(frame.returned))
    }

    /// `last`: the return at the end of this block is the function's only one.
    fn block(&mut self, frame: &mut Frame<'m>, block: &'m Block, last: bool) -> Result<()> {
        for (statement, span) in block.span_iter() {
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        let value = self.expression(frame, handle)?;
                        frame.values[handle.index()] = Some(value);
                    }
                }
                Statement::Block(block) => self.block(frame, block, false)?,
                Statement::If { condition, accept, reject } => {
                    let condition = self.regs(frame, *condition)?[0];
                    let accept = self.nested(|l| l.block(frame, accept, false))?;
                    let reject = self.nested(|l| l.block(frame, reject, false))?;
                    self.push(Node::If { condition, accept, reject, divergent: false })?;
                }
                Statement::Switch { selector, cases } => {
                    let selector = self.regs(frame, *selector)?[0];
                    let body = self.nested(|l| l.switch(frame, selector, cases))?;
                    self.push(Node::Switch { body, divergent: false })?;
                }
                Statement::Loop { body, continuing, break_if } => {
                    let body = self.nested(|l| l.block(frame, body, false))?;
                    let mut condition = NONE;
                    let continuing = self.nested(|l| {
                        l.block(frame, continuing, false)?;
                        if let Some(handle) = break_if {
                            condition = l.regs(frame, *handle)?[0];
                        }
                        Ok(())
                    })?;
                    let site = self.ir.sites.len() as u32;
                    self.ir.sites.push(Place { function: frame.name.to_string(), span: span.to_range() });
                    self.push(Node::Loop { body, continuing, break_if: condition, site, divergent: false })?;
                }
                Statement::Break => self.push(Node::Break)?,
                Statement::Continue => self.push(Node::Continue)?,
                Statement::Kill => self.push(Node::Kill)?,
                Statement::Return { value } => {
                    let regs = value.map(|value| self.regs(frame, value)).transpose()?;
                    if last {
                        frame.returned = regs.map(|regs| self.own(frame, &regs)).transpose()?;
                    } else {
                        if let (Some(result), Some(regs)) = (frame.result.clone(), regs) {
                            for (dst, value) in result.iter().zip(regs.iter()) {
                                self.store(*dst, *value)?;
                            }
                        }
                        self.push(Node::Return)?;
                    }
                }
                Statement::Store { pointer, value } => {
                    let value = self.regs(frame, *value)?;
                    match self.value(frame, *pointer)? {
                        Value::Pointer(Pointer::Variable(place)) => self.store_variable(&place, &value)?,
                        Value::Pointer(Pointer::Buffer(place)) => self.store_buffer(&place, &value)?,
                        _ => return self.refuse_at("writing through something that is no pointer", *span),
                    }
                }
                Statement::Call { function, arguments, result } => {
                    let mut values = Vec::new();
                    for argument in arguments {
                        values.push(self.value(frame, *argument)?);
                    }
                    let callee = &self.module.functions[*function];
                    let name = callee.name.as_deref().unwrap_or("an unnamed function");
                    let regs = self.call(callee, &self.info[*function], name, values)?;
                    if let (Some(result), Some(regs)) = (result, regs) {
                        frame.values[result.index()] = Some(Value::Regs(regs));
                    }
                }
                Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) => {
                    return self.refuse_at("a barrier between invocations", *span);
                }
                Statement::ImageStore { .. } => return self.refuse_at("writing to a texture", *span),
                Statement::Atomic { .. } | Statement::ImageAtomic { .. } => {
                    return self.refuse_at("atomic operations", *span);
                }
                Statement::WorkGroupUniformLoad { .. } => return self.refuse_at("workgroup memory", *span),
                Statement::RayQuery { .. } | Statement::RayPipelineFunction(_) => {
                    return self.refuse_at("ray queries", *span);
                }
                Statement::SubgroupBallot { .. }
                | Statement::SubgroupGather { .. }
                | Statement::SubgroupCollectiveOperation { .. } => {
                    return self.refuse_at("subgroup operations", *span);
                }
                Statement::CooperativeStore { .. } => return self.refuse_at("cooperative matrices", *span),
            }
        }
        Ok(())
    }

    /// A result that nothing outside of the function can change: variables of the caller are copied.
    fn own(&mut self, frame: &Frame<'m>, regs: &[Reg]) -> Result<Regs> {
        let foreign =
            |r: &Reg| matches!(self.ir.registers[*r as usize].origin, Origin::Variable(owner) if owner < frame.scope);
        if regs.iter().any(foreign) { self.copy(regs) } else { Ok(regs.into()) }
    }

    /// Cases become a chain of conditions; `break` leaves the chain.
    fn switch(&mut self, frame: &mut Frame<'m>, selector: Reg, cases: &'m [naga::SwitchCase]) -> Result<()> {
        // Several values before one body are cases that fall through and hold nothing.
        let mut groups: Vec<(Vec<SwitchValue>, &'m Block)> = Vec::new();
        let mut values = Vec::new();
        for case in cases {
            values.push(case.value);
            if !case.fall_through {
                groups.push((std::mem::take(&mut values), &case.body));
            } else if !case.body.is_empty() {
                return self.refuse("a case of a switch that falls through");
            }
        }
        let by_default = groups.iter().position(|(values, _)| values.contains(&SwitchValue::Default));
        self.cases(frame, selector, &groups, 0, by_default)
    }

    fn cases(
        &mut self,
        frame: &mut Frame<'m>,
        selector: Reg,
        groups: &[(Vec<SwitchValue>, &'m Block)],
        index: usize,
        by_default: Option<usize>,
    ) -> Result<()> {
        // The conditions come first and the chain is flat, so that a thousand cases nest no deeper than one.
        let mut open = self.word(u32::MAX);
        let mut conditions = Vec::new();
        for (i, (values, _)) in groups.iter().enumerate().skip(index) {
            if Some(i) == by_default {
                conditions.push(NONE);
                continue;
            }
            let mut matched = NONE;
            for value in values {
                let word = match value {
                    SwitchValue::I32(v) => v.cast_unsigned(),
                    SwitchValue::U32(v) => *v,
                    SwitchValue::Default => continue,
                };
                let word = self.word(word);
                let equal = self.emit(Op::Bits(BitsOp::Equal), Class::Bits, [selector, word, NONE])?;
                matched = if matched == NONE {
                    equal
                } else {
                    self.emit(Op::Bits(BitsOp::Or), Class::Bits, [matched, equal, NONE])?
                };
            }
            let not = self.emit(Op::Bits(BitsOp::Not), Class::Bits, [matched, NONE, NONE])?;
            open = self.emit(Op::Bits(BitsOp::And), Class::Bits, [open, not, NONE])?;
            conditions.push(matched);
        }
        for ((_, body), condition) in groups.iter().zip(conditions) {
            let condition = if condition == NONE { open } else { condition };
            let accept = self.nested(|l| l.block(frame, body, false))?;
            self.push(Node::If { condition, accept, reject: Vec::new(), divergent: false })?;
        }
        Ok(())
    }
}
