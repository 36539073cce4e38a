//! Runs a node's function on numbers, by the interpreter: what the shader would compute.

use std::collections::BTreeSet;

use halfvector_graph::library::Library;
use halfvector_graph::node_def::{Argument, Default, NodeDef};
use halfvector_graph::value::{SocketType, Type};
use halfvector_interp::{
    Address, Column, Derivatives, Float, Level, Limits, Outputs, Program, Resources, Sampler, Shape, Texture,
};
use halfvector_shaders::{FILES, File, Item, ItemKind, emit, generic_types, slice};
use naga::ScalarKind;

use crate::interp::compile;

/// A node's function, compiled for one type of `T`.
pub(super) struct Node {
    pub(super) def: &'static NodeDef,
    pub(super) program: Program,
    /// Scalars of each input that takes numbers, in order; pictures are left out.
    pub(super) widths: Vec<usize>,
}

/// Transforms of an object that is turned by a quarter about z, three times as high, and moved; and back.
const FROM_OBJECT: &str = "mat4x4f(0.0, 1.0, 0.0, 0.0, -3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 2.0, -5.0, 1.0)";
const FROM_WORLD: &str =
    "mat4x4f(0.0, -1.0 / 3.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -2.0, 1.0 / 3.0, 5.0, 1.0)";

/// Everything of the library that can be linked.
fn items() -> Vec<(&'static File, Item)> {
    FILES
        .iter()
        .filter(|f| !f.path.starts_with("entry/"))
        .flat_map(|f| slice(f.source).unwrap_or_else(|e| panic!("{}: {e}", f.path)).into_iter().map(move |i| (f, i)))
        .collect()
}

/// A function with all that it reaches, as text; `T` is `generic`.
fn linked(function: &str, generic: Type) -> String {
    let items = items();
    let mut reached = BTreeSet::new();
    let mut open = vec![function.to_string()];
    while let Some(name) = open.pop() {
        let found = items.iter().find(|(_, i)| i.name == name && i.kind != ItemKind::Alias);
        if let Some((_, item)) = found
            && reached.insert(name)
        {
            open.extend(item.dependencies.iter().cloned());
        }
    }
    let mut text = String::new();
    for (file, item) in items.iter().filter(|(_, i)| reached.contains(&i.name)) {
        let is_generic = generic_types(file.source).is_some();
        let rename = |name: &str| (is_generic && name == "T").then(|| generic.wgsl().to_string());
        text += &emit(file.source, item, rename);
        text.push('\n');
    }
    text
}

/// Components of an input, none for a picture.
fn width(ty: SocketType, generic: Type) -> Option<usize> {
    match ty {
        SocketType::Value(ty) => Some(ty.components()),
        SocketType::Generic => Some(generic.components()),
        SocketType::Texture | SocketType::Surface => None,
    }
}

impl Node {
    /// The node with this id.
    pub(super) fn new(id: &str) -> Node {
        let def = Library::standard().get(id).unwrap_or_else(|| panic!("no node {id}"));
        Node::of(def, def.generic.first().copied().unwrap_or(Type::F32), false)
    }

    /// A node for a type of `T`, in the fragment stage or in the vertex stage.
    pub(super) fn of(def: &'static NodeDef, generic: Type, vertex: bool) -> Node {
        let function = def.vertex_function.as_ref().filter(|_| vertex).unwrap_or(&def.function);
        let mut text = linked(&function.name, generic);
        let mut entry = function.name.clone();
        let has_frame = function.arguments.iter().any(|a| matches!(a, Argument::Frame(_)));
        if has_frame || def.inputs.iter().any(|i| i.ty == SocketType::Texture) {
            // Pictures are global in the interpreter, and a transform is one of an object: a function around the node names them.
            let values = def.inputs.iter().filter(|i| i.ty != SocketType::Texture);
            let list: Vec<String> = values
                .map(|i| match i.ty {
                    SocketType::Value(ty) => format!("{}: {}", i.name, ty.wgsl()),
                    _ => format!("{}: {}", i.name, generic.wgsl()),
                })
                .collect();
            let is_picture = |name: &str| def.inputs.iter().any(|i| i.name == name && i.ty == SocketType::Texture);
            let handed = function.arguments.iter().map(|argument| match argument {
                Argument::Input(name) if is_picture(name) => "probe_image",
                Argument::Input(name) => name.as_str(),
                Argument::Sampler(_) => "probe_sampler",
                Argument::Frame("object_from_world") => FROM_WORLD,
                Argument::Frame(_) => FROM_OBJECT,
            });
            let names: Vec<&str> = handed.collect();
            let result = text.split(&format!("fn {entry}(")).nth(1).and_then(|rest| rest.split("->").nth(1));
            let result = result.and_then(|rest| rest.split('{').next()).expect("a result").trim().to_string();
            text += &format!(
                "@group(0) @binding(0) var probe_image: texture_2d<f32>;
                 @group(0) @binding(1) var probe_sampler: sampler;
                 fn probe({}) -> {result} {{ return {entry}({}); }}",
                list.join(", "),
                names.join(", ")
            );
            entry = "probe".into();
        }
        let program = compile(&text, &entry);
        let widths = def.inputs.iter().filter_map(|i| width(i.ty, generic)).collect();
        Node { def, program, widths }
    }

    /// Where the numbers of an input begin in a row.
    pub(super) fn at(&self, input: &str) -> usize {
        let mut at = 0;
        let values = self.def.inputs.iter().filter(|i| i.ty != SocketType::Texture);
        for (def, width) in values.zip(&self.widths) {
            if def.name == input {
                return at;
            }
            at += width;
        }
        panic!("{} has no input {input}", self.def.id)
    }

    /// A row of arguments with each input's default.
    pub(super) fn defaults(&self) -> Vec<f32> {
        let mut row = Vec::new();
        for (input, width) in self.def.inputs.iter().filter(|i| i.ty != SocketType::Texture).zip(&self.widths) {
            match &input.default {
                Default::Value(value) => {
                    let components = value.components().unwrap_or(&[0.0]);
                    row.extend((0..*width).map(|i| components[i.min(components.len() - 1)]));
                }
                Default::Context(name) => row.extend_from_slice(context(name)),
                Default::Image(_) | Default::Surface => {}
            }
        }
        row
    }

    /// The defaults with some inputs set.
    pub(super) fn row(&self, set: &[(&str, &[f32])]) -> Vec<f32> {
        let mut row = self.defaults();
        for (name, values) in set {
            let at = self.at(name);
            row[at..at + values.len()].copy_from_slice(values);
        }
        row
    }

    /// What the node gives for rows of arguments: rows of results.
    pub(super) fn call<F: Float>(&self, rows: &[Vec<f32>]) -> Vec<Vec<f64>> {
        self.run::<F>(rows, None)
    }

    /// The same, with how much each argument changes to the pixel on the right and to the one below.
    pub(super) fn run<F: Float>(&self, rows: &[Vec<f32>], steps: Option<(&[f32], &[f32])>) -> Vec<Vec<f64>> {
        let texture = texture();
        let sampler = Sampler::linear(Address::Repeat);
        let resources = Resources::default().texture(0, 0, &texture).sampler(0, 1, sampler);
        let table = Table::<F>::new(&self.program, rows);
        let columns = table.columns(&self.program);
        let mut out = Outputs::default();
        let limits = Limits::default();
        let result = match steps {
            None => self.program.run(&columns, rows.len(), &mut out, &resources, Derivatives::Zero, limits),
            Some((x, y)) => {
                let x = Table::<F>::new(&self.program, &[x.to_vec()]);
                let y = Table::<F>::new(&self.program, &[y.to_vec()]);
                let (ddx, ddy) = (x.columns(&self.program), y.columns(&self.program));
                let given = Derivatives::Given { ddx: &ddx, ddy: &ddy };
                self.program.run(&columns, rows.len(), &mut out, &resources, given, limits)
            }
        };
        result.unwrap_or_else(|e| panic!("{}: {e}", self.def.id));
        let columns: Vec<Vec<f64>> = out.columns.iter().map(|c| c.to_f64()).collect();
        (0..rows.len()).map(|row| columns.iter().map(|c| c[if c.len() == 1 { 0 } else { row }]).collect()).collect()
    }
}

/// Arguments as the interpreter takes them.
struct Table<F> {
    floats: Vec<Vec<F>>,
    words: Vec<Vec<u32>>,
}

impl<F: Float> Table<F> {
    fn new(program: &Program, rows: &[Vec<f32>]) -> Table<F> {
        let inputs = program.inputs();
        let floats = |i: usize| rows.iter().map(|row| F::from_f64(f64::from(row[i]))).collect();
        let word = |i: usize, x: f32| match inputs[i].scalar.kind {
            ScalarKind::Bool => u32::from(x != 0.0),
            _ => (x as i32).cast_unsigned(),
        };
        let words = |i: usize| rows.iter().map(|row| word(i, row[i])).collect();
        Table { floats: (0..inputs.len()).map(floats).collect(), words: (0..inputs.len()).map(words).collect() }
    }

    fn columns(&self, program: &Program) -> Vec<Column<'_, F>> {
        let column = |(i, slot): (usize, &halfvector_interp::Slot)| match slot.scalar.kind {
            ScalarKind::Float => Column::Float(&self.floats[i]),
            _ => Column::Word(&self.words[i]),
        };
        program.inputs().iter().enumerate().map(column).collect()
    }
}

/// A point of a mesh that is nowhere special.
fn context(name: &str) -> &'static [f32] {
    match name {
        "uv0" | "uv1" => &[0.37, 0.61],
        "world_position" | "object_position" => &[0.31, -0.42, 0.77],
        "world_normal" => &[0.48, 0.6, 0.64],
        "world_tangent" => &[0.8, 0.0, -0.6, 1.0],
        "view_dir" => &[0.0, 0.6, 0.8],
        "time" => &[1.7],
        "vertex_color" => &[0.2, 0.5, 0.7, 0.9],
        other => panic!("no value for the context {other}"),
    }
}

/// A small picture with something in it.
fn texture() -> Texture {
    let texels = (0..64).map(|i| {
        let x = i as f32 / 63.0;
        [x, (7.0 * x).fract(), (3.0 * x).fract(), 1.0]
    });
    let level = Level { width: 8, height: 8, depth: 1, texels: texels.collect() };
    Texture::new(Shape::D2, 1, vec![level]).expect("a texture")
}
