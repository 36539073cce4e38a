//! How often a loop turns, where its text says so: `for (var i = 0; i < 8; i++)` with numbers or constants, whose body leaves `i`
//! alone. A loop that ends sooner by a `break` is counted to its end.

use std::collections::{HashMap, HashSet};

use naga::{BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, Module, Statement};

/// What is known of a function's counters.
pub(super) struct Counters<'f> {
    module: &'f Module,
    function: &'f Function,
    /// By variable: what is stored in it, all over the function.
    stored: HashMap<Handle<LocalVariable>, Vec<Handle<Expression>>>,
    /// Variables whose address a call takes.
    given: HashSet<Handle<LocalVariable>>,
}

impl<'f> Counters<'f> {
    pub(super) fn of(module: &'f Module, function: &'f Function) -> Counters<'f> {
        let mut counters = Counters { module, function, stored: HashMap::new(), given: HashSet::new() };
        let mut open = vec![&function.body];
        while let Some(block) = open.pop() {
            for statement in block.iter() {
                match statement {
                    Statement::Store { pointer, value } => {
                        if let Some(variable) = counters.variable(*pointer) {
                            counters.stored.entry(variable).or_default().push(*value);
                        }
                    }
                    Statement::Call { arguments, .. } => {
                        let given: Vec<_> = arguments.iter().filter_map(|a| counters.variable(*a)).collect();
                        counters.given.extend(given);
                    }
                    Statement::Block(block) => open.push(block),
                    Statement::If { accept, reject, .. } => open.extend([accept, reject]),
                    Statement::Switch { cases, .. } => open.extend(cases.iter().map(|case| &case.body)),
                    Statement::Loop { body, continuing, .. } => open.extend([body, continuing]),
                    _ => {}
                }
            }
        }
        counters
    }

    /// The turns of a loop, if they are known.
    pub(super) fn turns(&self, body: &Block, continuing: &Block) -> Option<u32> {
        let condition = body.iter().find(|statement| !matches!(statement, Statement::Emit(_)))?;
        let Statement::If { condition, accept, reject } = condition else { return None };
        if !accept.is_empty() || !matches!(reject.first(), Some(Statement::Break)) {
            return None;
        }
        let Expression::Binary { op, left, right } = self.function.expressions[*condition] else { return None };
        let counter = self.loaded(left)?;
        let end = self.number(right)?;
        let next = continuing.iter().find_map(|statement| match statement {
            Statement::Store { pointer, value } if self.variable(*pointer) == Some(counter) => Some(*value),
            _ => None,
        })?;
        let Expression::Binary { op: BinaryOperator::Add, left, right } = self.function.expressions[next] else {
            return None;
        };
        let step = self.number(right).filter(|step| *step > 0 && self.loaded(left) == Some(counter))?;
        let start = match (self.stored.get(&counter)?.as_slice(), self.function.local_variables[counter].init) {
            ([_], Some(init)) => self.number(init)?,
            ([_], None) => 0,
            // naga stores where a counter begins if its loop stands in another one.
            ([first, second], None) => self.number(if *first == next { *second } else { *first })?,
            _ => return None,
        };
        let way = match op {
            BinaryOperator::Less => end - start,
            BinaryOperator::LessEqual => end - start + 1,
            _ => return None,
        };
        let turns = (way.max(0) + step - 1) / step;
        (!self.given.contains(&counter)).then(|| u32::try_from(turns).unwrap_or(u32::MAX))
    }

    fn variable(&self, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            _ => None,
        }
    }

    fn loaded(&self, value: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        match self.function.expressions[value] {
            Expression::Load { pointer } => self.variable(pointer),
            _ => None,
        }
    }

    fn number(&self, value: Handle<Expression>) -> Option<i64> {
        let literal = |literal: &Literal| match *literal {
            Literal::I32(x) => Some(i64::from(x)),
            Literal::U32(x) => Some(i64::from(x)),
            _ => None,
        };
        match &self.function.expressions[value] {
            Expression::Literal(known) => literal(known),
            Expression::ZeroValue(_) => Some(0),
            Expression::Constant(constant) => {
                match &self.module.global_expressions[self.module.constants[*constant].init] {
                    Expression::Literal(known) => literal(known),
                    _ => None,
                }
            }
            _ => None,
        }
    }
}
