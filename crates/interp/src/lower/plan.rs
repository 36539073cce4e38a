//! Which loads of a variable must copy it. A load whose value is used up before the variable changes can name the
//! variable's own registers, and then costs nothing. One linear walk over a function's statements numbers them and finds
//! for each load its last use and for each variable its stores.

use std::collections::{HashMap, HashSet};

use naga::{Block, Expression, Function, Handle, Statement};

/// What a pointer leads to, as far as one function knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Root {
    Local(Handle<naga::LocalVariable>),
    /// Globals, and whatever the caller's pointers lead to: they are not told apart.
    Outside,
}

struct Walk<'f> {
    function: &'f Function,
    position: u32,
    emitted: HashMap<Handle<Expression>, u32>,
    used: HashMap<Handle<Expression>, u32>,
    stores: HashMap<Root, Vec<u32>>,
    /// First and last position of each loop, outer loops before inner ones.
    loops: Vec<(u32, u32)>,
}

/// The loads of a function that must copy.
pub(crate) fn loads_that_copy(function: &Function) -> HashSet<Handle<Expression>> {
    let mut walk = Walk {
        function,
        position: 0,
        emitted: HashMap::new(),
        used: HashMap::new(),
        stores: HashMap::new(),
        loops: Vec::new(),
    };
    walk.block(&function.body);
    // From the last expression back, so that the uses of what is made of a value count as uses of the value.
    let handles: Vec<_> = function.expressions.iter().map(|(h, _)| h).collect();
    for handle in handles.into_iter().rev() {
        let expression = &function.expressions[handle];
        let at = walk.emitted.get(&handle).copied();
        let passes_on = !matches!(
            expression,
            Expression::Binary { .. }
                | Expression::Unary { .. }
                | Expression::Select { .. }
                | Expression::Derivative { .. }
                | Expression::Load { .. }
                | Expression::ImageSample { .. }
                | Expression::ImageLoad { .. }
        );
        let last = if passes_on { walk.used.get(&handle).copied().max(at) } else { at };
        if let Some(last) = last {
            each_operand(expression, |operand| walk.use_at(operand, last));
        }
    }
    let mut copies = HashSet::new();
    for (handle, expression) in function.expressions.iter() {
        let Expression::Load { pointer } = expression else { continue };
        let (Some(&from), Some(&to)) = (walk.emitted.get(&handle), walk.used.get(&handle)) else { continue };
        let to = walk.end_of_loops(from, to);
        let changed = walk.stores.get(&walk.root(*pointer)).is_some_and(|at| at.iter().any(|s| from < *s && *s <= to));
        if changed {
            copies.insert(handle);
        }
    }
    copies
}

/// Calls `f` with each expression that another one is made of.
fn each_operand(expression: &Expression, mut f: impl FnMut(Handle<Expression>)) {
    match expression {
        Expression::Compose { components, .. } => components.iter().for_each(|c| f(*c)),
        Expression::Access { base, index } => {
            f(*base);
            f(*index);
        }
        Expression::AccessIndex { base, .. } => f(*base),
        Expression::Splat { value, .. } => f(*value),
        Expression::Swizzle { vector, .. } => f(*vector),
        Expression::Load { pointer } => f(*pointer),
        Expression::ImageSample { coordinate, array_index, level, depth_ref, .. } => {
            f(*coordinate);
            array_index.iter().chain(depth_ref).for_each(|e| f(*e));
            match level {
                naga::SampleLevel::Exact(e) | naga::SampleLevel::Bias(e) => f(*e),
                naga::SampleLevel::Gradient { x, y } => {
                    f(*x);
                    f(*y);
                }
                naga::SampleLevel::Auto | naga::SampleLevel::Zero => {}
            }
        }
        Expression::ImageLoad { coordinate, array_index, sample, level, .. } => {
            f(*coordinate);
            array_index.iter().chain(sample).chain(level).for_each(|e| f(*e));
        }
        Expression::ImageQuery { query: naga::ImageQuery::Size { level: Some(level) }, .. } => f(*level),
        Expression::Unary { expr, .. } | Expression::Derivative { expr, .. } | Expression::As { expr, .. } => f(*expr),
        Expression::Binary { left, right, .. } => {
            f(*left);
            f(*right);
        }
        Expression::Select { condition, accept, reject } => {
            f(*condition);
            f(*accept);
            f(*reject);
        }
        Expression::Relational { argument, .. } => f(*argument),
        Expression::Math { arg, arg1, arg2, arg3, .. } => {
            f(*arg);
            arg1.iter().chain(arg2).chain(arg3).for_each(|e| f(*e));
        }
        _ => {}
    }
}

impl Walk<'_> {
    fn root(&self, pointer: Handle<Expression>) -> Root {
        let mut at = pointer;
        loop {
            match &self.function.expressions[at] {
                Expression::LocalVariable(local) => return Root::Local(*local),
                Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => at = *base,
                _ => return Root::Outside,
            }
        }
    }

    fn use_at(&mut self, expression: Handle<Expression>, position: u32) {
        let last = self.used.entry(expression).or_insert(position);
        *last = (*last).max(position);
    }

    /// Where a use really ends: a value from before a loop is used until the loop's end.
    fn end_of_loops(&self, from: u32, to: u32) -> u32 {
        let around = self.loops.iter().filter(|(start, end)| from < *start && *start <= to && to <= *end);
        around.map(|(_, end)| *end).max().unwrap_or(to)
    }

    fn store(&mut self, pointer: Handle<Expression>) {
        let position = self.position;
        self.stores.entry(self.root(pointer)).or_default().push(position);
    }

    fn block(&mut self, block: &Block) {
        for statement in block {
            self.position += 1;
            let here = self.position;
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        self.position += 1;
                        self.emitted.insert(handle, self.position);
                    }
                }
                Statement::Block(block) => self.block(block),
                Statement::If { condition, accept, reject } => {
                    self.use_at(*condition, here);
                    self.block(accept);
                    self.block(reject);
                }
                Statement::Switch { selector, cases } => {
                    self.use_at(*selector, here);
                    for case in cases {
                        self.block(&case.body);
                    }
                }
                Statement::Loop { body, continuing, break_if } => {
                    let index = self.loops.len();
                    self.loops.push((here, here));
                    self.block(body);
                    self.block(continuing);
                    self.position += 1;
                    if let Some(condition) = break_if {
                        self.use_at(*condition, self.position);
                    }
                    self.loops[index].1 = self.position;
                }
                Statement::Return { value } => value.iter().for_each(|v| self.use_at(*v, here)),
                Statement::Store { pointer, value } => {
                    self.use_at(*pointer, here);
                    self.use_at(*value, here);
                    self.store(*pointer);
                }
                Statement::Call { arguments, .. } => {
                    for argument in arguments {
                        self.use_at(*argument, here);
                        // Of a value this says that nothing outside changed, which is so or is said below.
                        self.store(*argument);
                    }
                    self.stores.entry(Root::Outside).or_default().push(here);
                }
                _ => {}
            }
        }
    }
}
