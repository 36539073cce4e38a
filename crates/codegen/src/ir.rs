//! The intermediate form between document and WGSL: a flat list of expressions, each after what it uses.
//!
//! Flat and in order, so that every pass is one loop: no recursion on graphs that may be ten thousand nodes deep.

use std::collections::{BTreeMap, HashMap};

use halfvector_graph::document::{NodeId, SocketRef};
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::{ImageRef, Type, Value};

/// An index into [`Arena::exprs`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Id(u32);

impl Id {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A constant; compared by bits, so that it can be a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Literal {
    pub(crate) ty: Type,
    bits: [u32; 4],
}

impl Literal {
    /// Spreads one number over a vector; missing components are 0, surplus ones are left out.
    pub(crate) fn new(ty: Type, components: &[f64]) -> Literal {
        let mut bits = [0; 4];
        for (index, slot) in bits.iter_mut().take(ty.components()).enumerate() {
            let component =
                if components.len() == 1 { components[0] } else { components.get(index).copied().unwrap_or(0.0) };
            *slot = if ty == Type::I32 { (component as i32).cast_unsigned() } else { (component as f32).to_bits() };
        }
        Literal { ty, bits }
    }

    /// The components, exact.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let number = |bits: u32| match self.ty {
            Type::I32 => f64::from(bits.cast_signed()),
            _ => f64::from(f32::from_bits(bits)),
        };
        self.bits[..self.ty.components()].iter().map(|bits| number(*bits)).collect()
    }

    /// The components as the shader's floats.
    pub(crate) fn components(&self) -> Vec<f32> {
        self.numbers().iter().map(|x| *x as f32).collect()
    }

    /// Whether every component equals `x`.
    pub(crate) fn is_all(&self, x: f32) -> bool {
        self.numbers().iter().all(|number| *number == f64::from(x))
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.numbers().iter().all(|number| number.is_finite())
    }
}

/// What an expression is.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Expr<'a> {
    /// A constant.
    Literal(Literal),
    /// An unconnected input that is a member of the `Parameters` struct: index into [`Program::inputs`].
    Input(usize),
    /// What the shader knows of the point.
    Context(&'static str),
    /// A transform between spaces.
    Frame(&'static str),
    /// A texture: index into [`Program::images`].
    Texture(usize),
    /// The sampler of a texture.
    Sampler(usize),
    /// A call of a library function; with a type when it is generic.
    Call { function: &'a str, generic: Option<Type>, arguments: Vec<Id> },
    /// A member of a struct that a call returned.
    Field { of: Id, name: &'a str },
    /// A scalar spread over a vector, or a whole number as a float.
    Convert { of: Id },
    /// A WGSL built-in function or, with one character, operator.
    Builtin { name: &'static str, arguments: Vec<Id> },
}

/// The type of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Ty {
    Value(Type),
    /// A struct that a call returned.
    Struct,
    /// A texture, a sampler or a transform between spaces.
    Resource,
}

/// An expression with its type and where it comes from.
#[derive(Clone, Debug)]
pub(crate) struct Entry<'a> {
    pub(crate) expr: Expr<'a>,
    pub(crate) ty: Ty,
    /// The document's node: index into [`Program::nodes`].
    pub(crate) node: Option<usize>,
    /// What to name it when no node gives a name.
    pub(crate) hint: &'static str,
}

/// The expressions of one stage.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arena<'a> {
    pub(crate) exprs: Vec<Entry<'a>>,
}

impl<'a> Arena<'a> {
    pub(crate) fn push(&mut self, entry: Entry<'a>) -> Id {
        self.exprs.push(entry);
        Id(self.exprs.len() as u32 - 1)
    }

    pub(crate) fn get(&self, id: Id) -> &Entry<'a> {
        &self.exprs[id.index()]
    }

    pub(crate) fn literal(&mut self, ty: Type, components: &[f64]) -> Id {
        let literal = Literal::new(ty, components);
        self.push(Entry { expr: Expr::Literal(literal), ty: Ty::Value(ty), node: None, hint: "" })
    }

    /// An expression that belongs to no node.
    pub(crate) fn own(&mut self, expr: Expr<'a>, ty: Type, hint: &'static str) -> Id {
        self.push(Entry { expr, ty: Ty::Value(ty), node: None, hint })
    }

    /// `id` as `to`; the identity when it is that already.
    pub(crate) fn convert(&mut self, id: Id, to: Type) -> Id {
        let entry = self.get(id);
        match (&entry.expr, entry.ty) {
            (_, Ty::Value(from)) if from == to => id,
            (Expr::Literal(literal), _) => {
                let numbers = literal.numbers();
                self.literal(to, &numbers)
            }
            _ => self.own(Expr::Convert { of: id }, to, ""),
        }
    }

    /// Whether an expression is nothing but a context.
    pub(crate) fn is_context(&self, id: Id, name: &str) -> bool {
        matches!(self.get(id).expr, Expr::Context(context) if context == name)
    }

    pub(crate) fn as_literal(&self, id: Id) -> Option<Literal> {
        match self.get(id).expr {
            Expr::Literal(literal) => Some(literal),
            _ => None,
        }
    }
}

impl Expr<'_> {
    /// The expressions that this one uses.
    pub(crate) fn uses(&self) -> &[Id] {
        match self {
            Expr::Call { arguments, .. } | Expr::Builtin { arguments, .. } => arguments,
            Expr::Field { of, .. } | Expr::Convert { of } => std::slice::from_ref(of),
            _ => &[],
        }
    }

    /// The expressions that this one uses, to be exchanged.
    pub(crate) fn uses_mut(&mut self) -> &mut [Id] {
        match self {
            Expr::Call { arguments, .. } | Expr::Builtin { arguments, .. } => arguments,
            Expr::Field { of, .. } | Expr::Convert { of } => std::slice::from_mut(of),
            _ => &mut [],
        }
    }
}

/// An unconnected input with a number: a member of the `Parameters` struct, or a literal once it is folded.
#[derive(Clone, Debug)]
pub(crate) struct Input {
    /// Index into [`Program::nodes`].
    pub(crate) node: usize,
    pub(crate) socket: SocketRef,
    pub(crate) ty: Type,
    /// The document's value, as many components as the type has.
    pub(crate) value: Vec<f64>,
    /// Index into the document's parameters when it is exposed.
    pub(crate) parameter: Option<usize>,
}

/// A node of the document that the shader reaches.
#[derive(Clone, Debug)]
pub(crate) struct NodeInfo<'a> {
    pub(crate) id: &'a NodeId,
    pub(crate) label: &'a str,
    pub(crate) def: &'a NodeDef,
    /// What `T` is, when the node is generic.
    pub(crate) generic: Option<Type>,
    /// Values of unconnected inputs.
    pub(crate) values: &'a BTreeMap<String, Value>,
}

/// A material between document and WGSL.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program<'a> {
    pub(crate) nodes: Vec<NodeInfo<'a>>,
    pub(crate) inputs: Vec<Input>,
    pub(crate) images: Vec<Image>,
    pub(crate) fragment: Stage<'a>,
    pub(crate) vertex: Stage<'a>,
    /// Whether the fragment stage's `world_normal` is the displaced surface's where the normal is computed.
    pub(crate) derived_normal: bool,
}

/// A picture that the shader reads, with the node that reads it first: it names the binding.
#[derive(Clone, Debug)]
pub(crate) struct Image {
    pub(crate) image: ImageRef,
    pub(crate) node: usize,
}

/// The expressions of one stage and the ones that are wanted of them, by name: the surface's sockets, and what
/// specialising adds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stage<'a> {
    pub(crate) arena: Arena<'a>,
    pub(crate) roots: BTreeMap<&'static str, Id>,
}

impl<'a> Stage<'a> {
    pub(crate) fn root(&self, name: &str) -> Option<Id> {
        self.roots.get(name).copied()
    }

    /// Rebuilds the arena entry by entry: `step` gets the new arena and the entry with its uses already exchanged, and
    /// says where it went (`None`: nowhere, nothing may use it).
    pub(crate) fn rebuild(&mut self, mut step: impl FnMut(&mut Arena<'a>, Id, Entry<'a>) -> Option<Id>) {
        let old = std::mem::take(&mut self.arena);
        let mut moved: Vec<Option<Id>> = Vec::with_capacity(old.exprs.len());
        for (index, mut entry) in old.exprs.into_iter().enumerate() {
            let mut complete = true;
            for id in entry.expr.uses_mut() {
                match moved[id.index()] {
                    Some(new) => *id = new,
                    None => complete = false,
                }
            }
            moved.push(if complete { step(&mut self.arena, Id(index as u32), entry) } else { None });
        }
        for id in self.roots.values_mut() {
            if let Some(new) = moved[id.index()] {
                *id = new;
            }
        }
    }

    /// Marks what the roots reach, by index.
    pub(crate) fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.arena.exprs.len()];
        for id in self.roots.values() {
            live[id.index()] = true;
        }
        for index in (0..live.len()).rev() {
            if live[index] {
                for id in self.arena.exprs[index].expr.uses() {
                    live[id.index()] = true;
                }
            }
        }
        live
    }
}

/// The inputs and images of a program while it is made: each once.
#[derive(Default)]
pub(crate) struct Table {
    pub(crate) inputs: Vec<Input>,
    pub(crate) images: Vec<Image>,
    input_of: HashMap<(usize, usize), usize>,
    image_of: HashMap<ImageRef, usize>,
}

impl Table {
    /// The index of input number `input` of node number `node`.
    pub(crate) fn input(&mut self, node: usize, input: usize, make: impl FnOnce() -> Input) -> usize {
        *self.input_of.entry((node, input)).or_insert_with(|| {
            self.inputs.push(make());
            self.inputs.len() - 1
        })
    }

    /// The index of a picture. Different wrapping or filtering is another one, so that each texture has one sampler:
    /// GLSL joins the two and could not express it otherwise.
    pub(crate) fn image(&mut self, node: usize, image: &ImageRef) -> usize {
        if let Some(&index) = self.image_of.get(image) {
            return index;
        }
        self.images.push(Image { image: image.clone(), node });
        self.image_of.insert(image.clone(), self.images.len() - 1);
        self.images.len() - 1
    }
}
