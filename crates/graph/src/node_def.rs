//! What a node of the library is: the plain result of reading a WGSL function. The reading itself is in `library`.

use crate::value::{SocketType, Type, Value};

/// A node of the library, read from a WGSL function and its doc comment.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeDef {
    /// `category/name`, such as `math/mix`.
    pub id: String,
    /// For people.
    pub label: String,
    /// What it computes, with equation and source; Markdown.
    pub help: String,
    /// Other words that a search finds it by.
    pub synonyms: Vec<String>,
    /// Inputs in the order of the function's arguments; samplers are left out, they go with their texture.
    pub inputs: Vec<Input>,
    /// Outputs; a function that returns a plain value has one, named `out`.
    pub outputs: Vec<Output>,
    /// The types that `T` may be, narrowest first; empty when the node is not generic.
    pub generic: Vec<Type>,
    /// File of the shader library, such as `nodes/math/mix.wgsl`; empty for a group.
    pub file: String,
    /// The WGSL function that is the node; of a group an empty one.
    pub function: Function,
    /// The function for the vertex stage, when it is another one (explicit level instead of implicit derivatives).
    pub vertex_function: Option<Function>,
    /// Names of the inputs of whose values, or of whose pictures, the node shows the slope: a shader blends the texels behind them by
    /// arithmetic, as it does those behind the surface's height, for the slope of what a sampler has blended is that of its coarse weights.
    pub slopes: Vec<String>,
    /// Functions that take the node's place under a method: (term, method, function).
    pub method_functions: Vec<(String, String, Function)>,
    /// Cheaper functions for a single output: (output name, function).
    pub output_functions: Vec<(String, Function)>,
    /// Whether each output is the input of the same place, so that the node leaves nothing in a shader.
    pub forwards: bool,
}

/// The node that bends a wire: its output is its input.
pub const REROUTE: &str = "utility/reroute";

/// A WGSL function that computes a node or a part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name, before a generic type is appended.
    pub name: String,
    /// Its arguments in order.
    pub arguments: Vec<Argument>,
    /// Whether the result is a struct with one member per output; else it is the value itself.
    pub returns_struct: bool,
    /// Whether implicit derivatives are taken, in itself or in what it calls: fragment stage, uniform control flow only.
    pub implicit_derivatives: bool,
}

/// One argument of a node function.
#[derive(Clone, Debug, PartialEq)]
pub enum Argument {
    /// The value or texture of the input with this name.
    Input(String),
    /// The sampler of the texture input with this name.
    Sampler(String),
    /// A transform between spaces; see [`crate::context::FRAMES`].
    Frame(&'static str),
}

/// An input socket.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Name in the document: the argument's.
    pub name: String,
    /// For people, where it is not the name.
    pub label: Option<String>,
    /// What it takes.
    pub ty: SocketType,
    /// What it reads when nothing is connected or set.
    pub default: Default,
    /// Soft range of each component; values outside are allowed.
    pub range: Option<[f32; 2]>,
    /// Unit or kind: `color`, `deg`, `m`, ...; empty for a plain number.
    pub unit: String,
    /// For people.
    pub help: String,
}

/// What an unconnected input reads.
#[derive(Clone, Debug, PartialEq)]
pub enum Default {
    /// This value; for a generic socket a number that is spread over `T`.
    Value(Value),
    /// A context of the shaded point, by name.
    Context(String),
    /// Nothing: a texture must be chosen. The colour space is the one that a new image gets.
    Image(crate::value::ColorSpace),
    /// Nothing: a surface must be linked.
    Surface,
}

/// An output socket.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name in the document: `out` or the struct member's.
    pub name: String,
    /// For people, where it is not the name.
    pub label: Option<String>,
    /// What it gives.
    pub ty: SocketType,
    /// For people.
    pub help: String,
}
