//! naga's module to [`Ir`]: every call is put in place of itself, every value is taken apart into scalars.

mod access;
mod expression;
mod math;
mod operator;
mod plan;
mod statement;
mod texture;

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{Arena, Expression, Function, Handle, Literal, Module, Scalar, ScalarKind, Span, TypeInner};

use crate::error::{Place, Unsupported};
use crate::ir::{Class, Inst, Ir, NONE, Node, Op, Origin, Reg, Register, Resource};
use crate::shape;

/// Most instructions and registers of a program, all calls put in place.
const MAX_SIZE: usize = 1 << 20;

/// Deepest nesting of blocks and calls: what walks over them recurses.
const MAX_DEPTH: usize = 256;

/// The registers of a value, in the order of its scalars.
pub(crate) type Regs = Rc<[Reg]>;

/// What an expression is while the program is made.
#[derive(Clone, Debug)]
enum Value {
    Regs(Regs),
    Pointer(access::Pointer),
    /// A texture or sampler.
    Handle(Handle<naga::GlobalVariable>),
}

/// A call that is being put in place.
struct Frame<'m> {
    function: &'m Function,
    info: &'m FunctionInfo,
    name: &'m str,
    arguments: Vec<Value>,
    values: Vec<Option<Value>>,
    locals: Vec<Regs>,
    copies: Rc<HashSet<Handle<Expression>>>,
    scope: u32,
    /// Where the result goes when there are several returns.
    result: Option<Regs>,
    /// The result of the only return, at the end.
    returned: Option<Regs>,
}

pub(crate) struct Lower<'m> {
    module: &'m Module,
    info: &'m ModuleInfo,
    pub(crate) ir: Ir,
    /// Open blocks, the innermost last.
    blocks: Vec<Vec<Node>>,
    size: usize,
    constants: HashMap<(Class, u64), Reg>,
    privates: HashMap<Handle<naga::GlobalVariable>, Regs>,
    resources: HashMap<Handle<naga::GlobalVariable>, u32>,
    global_values: HashMap<Handle<Expression>, Regs>,
    pools: HashMap<Regs, u32>,
    plans: HashMap<*const Function, Rc<HashSet<Handle<Expression>>>>,
    scopes: u32,
    /// The scope of the call that is being put in place; 0 is around all.
    scope: u32,
    /// The function that is being put in place, for messages.
    place: Place,
}

type Result<T> = std::result::Result<T, Unsupported>;

impl<'m> Lower<'m> {
    pub(crate) fn new(module: &'m Module, info: &'m ModuleInfo) -> Self {
        Lower {
            module,
            info,
            ir: Ir::default(),
            blocks: vec![Vec::new()],
            size: 0,
            constants: HashMap::new(),
            privates: HashMap::new(),
            resources: HashMap::new(),
            global_values: HashMap::new(),
            pools: HashMap::new(),
            plans: HashMap::new(),
            scopes: 0,
            scope: 0,
            place: Place::default(),
        }
    }

    /// Lowers one function with its arguments as inputs and its result as output.
    pub(crate) fn program(&mut self, function: &'m Function, info: &'m FunctionInfo, name: &'m str) -> Result<()> {
        self.place = Place { function: name.to_string(), span: None };
        let mut arguments = Vec::new();
        for argument in &function.arguments {
            let inner = &self.module.types[argument.ty].inner;
            let classes = self.classes(inner)?;
            let regs: Regs = classes.into_iter().map(|class| self.register(class, Origin::Input)).collect();
            self.ir.inputs.extend(regs.iter());
            arguments.push(Value::Regs(regs));
        }
        let result = self.call(function, info, name, arguments)?;
        self.ir.outputs = result.map(|regs| regs.to_vec()).unwrap_or_default();
        self.ir.nodes = self.blocks.pop().unwrap_or_default();
        // Private variables begin with their initial values in every run.
        let inits = self.private_inits()?;
        self.ir.nodes.splice(0..0, inits);
        Ok(())
    }

    fn refuse<T>(&self, what: impl Into<String>) -> Result<T> {
        Err(Unsupported::feature(what.into(), self.place.clone()))
    }

    fn refuse_at<T>(&self, what: impl Into<String>, span: Span) -> Result<T> {
        let place = Place { function: self.place.function.clone(), span: span.to_range() };
        Err(Unsupported::feature(what.into(), place))
    }

    fn too_large<T>(&self, what: &'static str) -> Result<T> {
        Err(Unsupported::TooLarge { what, limit: MAX_SIZE, place: self.place.clone() })
    }

    fn classes(&self, inner: &TypeInner) -> Result<Vec<Class>> {
        let mut scalars = Vec::new();
        shape::scalars(self.module, inner, &mut scalars).or_else(|what| self.refuse(what))?;
        scalars.into_iter().map(|s| shape::class_of(s).or_else(|what| self.refuse(what))).collect()
    }

    fn register(&mut self, class: Class, origin: Origin) -> Reg {
        self.ir.registers.push(Register { class, origin });
        (self.ir.registers.len() - 1) as Reg
    }

    fn class(&self, reg: Reg) -> Class {
        self.ir.registers[reg as usize].class
    }

    fn constant(&mut self, class: Class, bits: u64) -> Reg {
        if let Some(reg) = self.constants.get(&(class, bits)) {
            return *reg;
        }
        let reg = self.register(class, Origin::Constant(bits));
        self.constants.insert((class, bits), reg);
        reg
    }

    fn word(&mut self, word: u32) -> Reg {
        self.constant(Class::Bits, u64::from(word))
    }

    /// A float of the class of another register.
    fn number(&mut self, class: Class, x: f64) -> Reg {
        self.constant(class, x.to_bits())
    }

    fn literal(&mut self, literal: Literal) -> Result<Reg> {
        Ok(match literal {
            Literal::F32(x) => self.number(Class::Float, f64::from(x)),
            Literal::F64(x) => self.number(Class::Double, x),
            Literal::U32(x) => self.word(x),
            Literal::I32(x) => self.word(x.cast_unsigned()),
            Literal::Bool(x) => self.word(if x { u32::MAX } else { 0 }),
            Literal::I64(_) => return self.refuse("the type i64"),
            Literal::U64(_) => return self.refuse("the type u64"),
            Literal::I16(_) => return self.refuse("the type i16"),
            Literal::U16(_) => return self.refuse("the type u16"),
            Literal::F16(_) => return self.refuse("the type f16"),
            Literal::AbstractInt(_) | Literal::AbstractFloat(_) => {
                return self.refuse("a number whose type is not chosen");
            }
        })
    }

    fn push(&mut self, node: Node) -> Result<()> {
        self.size += 1;
        if self.size > MAX_SIZE || self.ir.registers.len() > 2 * MAX_SIZE {
            return self.too_large("instructions");
        }
        if let Some(block) = self.blocks.last_mut() {
            block.push(node);
        }
        Ok(())
    }

    /// An instruction with a new register for its result.
    fn emit(&mut self, op: Op, class: Class, operands: [Reg; 3]) -> Result<Reg> {
        let dst = self.register(class, Origin::Temporary);
        let [a, b, c] = operands;
        self.push(Node::Inst(Inst { op, dst, a, b, c }))?;
        Ok(dst)
    }

    fn store(&mut self, dst: Reg, a: Reg) -> Result<()> {
        self.push(Node::Inst(Inst { op: Op::Move, dst, a, b: NONE, c: NONE }))
    }

    fn copy(&mut self, regs: &[Reg]) -> Result<Regs> {
        regs.iter().map(|r| self.emit(Op::Move, self.class(*r), [*r, NONE, NONE])).collect()
    }

    fn zero(&mut self, inner: &TypeInner) -> Result<Regs> {
        Ok(self.classes(inner)?.into_iter().map(|class| self.constant(class, 0)).collect())
    }

    fn variables(&mut self, inner: &TypeInner, scope: u32) -> Result<Regs> {
        let regs: Regs =
            self.classes(inner)?.into_iter().map(|class| self.register(class, Origin::Variable(scope))).collect();
        if self.ir.registers.len() > 2 * MAX_SIZE {
            return self.too_large("registers");
        }
        Ok(regs)
    }

    /// The nodes that a step of lowering makes, apart from the block that is open.
    fn nested(&mut self, step: impl FnOnce(&mut Self) -> Result<()>) -> Result<Vec<Node>> {
        if self.blocks.len() > MAX_DEPTH {
            return Err(Unsupported::TooLarge {
                what: "levels of nested blocks and calls",
                limit: MAX_DEPTH,
                place: self.place.clone(),
            });
        }
        self.blocks.push(Vec::new());
        let result = step(self);
        let block = self.blocks.pop().unwrap_or_default();
        result.map(|()| block)
    }

    /// A constant expression of the module.
    fn global_value(&mut self, handle: Handle<Expression>) -> Result<Regs> {
        if let Some(regs) = self.global_values.get(&handle) {
            return Ok(regs.clone());
        }
        let module = self.module;
        let regs: Regs = match &module.global_expressions[handle] {
            Expression::Literal(literal) => [self.literal(*literal)?].into(),
            Expression::Constant(constant) => self.global_value(module.constants[*constant].init)?,
            Expression::ZeroValue(ty) => self.zero(&module.types[*ty].inner)?,
            Expression::Compose { components, .. } => {
                let mut all = Vec::new();
                for component in components {
                    all.extend(self.global_value(*component)?.iter());
                }
                all.into()
            }
            Expression::Splat { size, value } => vec![self.global_value(*value)?[0]; *size as usize].into(),
            Expression::Override(_) => {
                return self.refuse("an override constant whose value is not set");
            }
            _ => return self.refuse("a constant that is no number, vector, matrix, array or struct of them"),
        };
        self.global_values.insert(handle, regs.clone());
        Ok(regs)
    }

    /// Registers of a private variable, which live as long as the program runs.
    fn private(&mut self, handle: Handle<naga::GlobalVariable>) -> Result<Regs> {
        if let Some(regs) = self.privates.get(&handle) {
            return Ok(regs.clone());
        }
        let regs = self.variables(&self.module.types[self.module.global_variables[handle].ty].inner, 0)?;
        self.privates.insert(handle, regs.clone());
        Ok(regs)
    }

    fn private_inits(&mut self) -> Result<Vec<Node>> {
        let mut privates: Vec<_> = self.privates.iter().map(|(h, r)| (*h, r.clone())).collect();
        privates.sort_by_key(|(handle, _)| handle.index());
        self.nested(|lower| {
            for (handle, regs) in privates {
                let variable = &lower.module.global_variables[handle];
                let values = match variable.init {
                    Some(init) => lower.global_value(init)?,
                    None => lower.zero(&lower.module.types[variable.ty].inner)?,
                };
                for (dst, value) in regs.iter().zip(values.iter()) {
                    lower.store(*dst, *value)?;
                }
            }
            Ok(())
        })
    }

    /// The index of a resource in its list.
    fn resource(
        &mut self,
        handle: Handle<naga::GlobalVariable>,
        list: fn(&mut Ir) -> &mut Vec<Resource>,
    ) -> Result<u32> {
        if let Some(index) = self.resources.get(&handle) {
            return Ok(*index);
        }
        let variable = &self.module.global_variables[handle];
        let name = variable.name.clone().unwrap_or_default();
        let Some(binding) = &variable.binding else {
            return self.refuse(format!("the variable `{name}`, which has no binding"));
        };
        let list = list(&mut self.ir);
        list.push(Resource { name, group: binding.group, binding: binding.binding });
        let index = (list.len() - 1) as u32;
        self.resources.insert(handle, index);
        Ok(index)
    }

    /// A list of registers that tables can be windows of.
    fn pool(&mut self, regs: &Regs) -> u32 {
        if let Some(pool) = self.pools.get(regs) {
            return *pool;
        }
        self.ir.pools.push(regs.to_vec());
        let pool = (self.ir.pools.len() - 1) as u32;
        self.pools.insert(regs.clone(), pool);
        pool
    }
}

/// The scalar of a type that is made of one kind of scalar.
fn scalar_of(inner: &TypeInner) -> Option<Scalar> {
    inner.scalar()
}

fn is_signed(scalar: Scalar) -> bool {
    scalar.kind == ScalarKind::Sint
}

/// Where an expression stands in the text.
fn span_of(arena: &Arena<Expression>, handle: Handle<Expression>) -> Span {
    arena.get_span(handle)
}
