//! Pass: the nodes behind chosen sockets of the surface become expressions. Each node is one call; its unconnected
//! inputs become members of the `Parameters` struct or literals; nothing is simplified here.

use std::collections::HashMap;

use halfvector_graph::document::{Document, GROUP_OUTPUT, SocketRef, function_of, group_of};
use halfvector_graph::flatten::find;
use halfvector_graph::library::Library;
use halfvector_graph::library::custom::read_function;
use halfvector_graph::method::Methods;
use halfvector_graph::node_def::{Argument, Default, Function, Input as InputDef};
use halfvector_graph::value::{Filter, SocketType, Type, Value};

use crate::ir::{Arena, Entry, Expr, Id, Input, NodeInfo, Program, Stage, Table, Ty};
use crate::link::Index;
use crate::passes::drop_unused::drop_unread;
use crate::passes::fold;
use crate::passes::idle::drop_idle;
use crate::passes::mixed;
use crate::passes::specialise::{NORMALS, SOCKETS};
use crate::passes::types::{Source, Types};
use crate::{CodegenError, Fold};

/// The two stages of a rasteriser, which may call different functions for a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum StageKind {
    Vertex,
    Fragment,
}

/// Turns nodes into expressions. One per stage, and one more where a context means something else.
pub(crate) struct Lowering<'a, 't> {
    pub(crate) types: &'t Types<'a>,
    pub(crate) index: &'a Index,
    pub(crate) methods: &'t Methods,
    pub(crate) fold: Fold,
    pub(crate) stage: StageKind,
    /// A socket of the surface whose number stays open, whatever is folded or wired to it.
    pub(crate) open: Option<&'static str>,
    /// Where pictures are read by arithmetic.
    pub(crate) blend: Blend,
    /// Expressions of the nodes met so far, and whether of what they compute the slope counts.
    calls: HashMap<(usize, bool), Id>,
    /// Weights of the nodes that mix surfaces, held to 0..1.
    pub(super) weights: HashMap<usize, Id>,
    /// Expressions to take in the place of contexts.
    substitutes: Vec<(&'static str, Id)>,
}

/// Where pictures are read by arithmetic in place of a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Blend {
    /// Nowhere: who runs this samples exactly.
    Never,
    /// Where a node shows the slope of what it is given.
    Slopes,
    /// Everywhere: what is computed is a height.
    All,
}

impl<'a, 't> Lowering<'a, 't> {
    pub(crate) fn new(
        types: &'t Types<'a>,
        index: &'a Index,
        methods: &'t Methods,
        fold: Fold,
        stage: StageKind,
    ) -> Self {
        let (calls, weights, substitutes) = (HashMap::new(), HashMap::new(), Vec::new());
        let blend = Blend::Slopes;
        Lowering { types, index, methods, fold, stage, open: None, blend, calls, weights, substitutes }
    }

    /// From now on these contexts are these expressions; nodes that were met before are computed again.
    pub(crate) fn substitute(&mut self, substitutes: Vec<(&'static str, Id)>) {
        self.substitutes = substitutes;
        self.calls.clear();
        self.weights.clear();
    }

    /// The expression of input `name` of node number `node`; `None` when the node has no such input, or it takes no
    /// value.
    pub(crate) fn input(
        &mut self,
        arena: &mut Arena<'a>,
        table: &mut Table,
        node: usize,
        name: &str,
    ) -> Result<Option<Id>, CodegenError> {
        let Some(index) = self.types.nodes[node].def.inputs.iter().position(|i| i.name == name) else {
            return Ok(None);
        };
        // Depth first with an explicit stack: a node is made when all that it reads is made.
        let is_open = self.types.gives_surface(node) && self.open == Some(name);
        let first = self.types.sources[node][index].and_then(Source::computed).filter(|_| !is_open);
        let slope = self.blend == Blend::All;
        let is_steep = self.is_slope(node, slope, index);
        let mut stack: Vec<(usize, bool, bool)> = first.into_iter().map(|node| (node, is_steep, false)).collect();
        while let Some((at, slope, ready)) = stack.pop() {
            if self.calls.contains_key(&(at, slope)) {
                continue;
            }
            if ready {
                let call = self.call(arena, table, at, slope)?;
                self.calls.insert((at, slope), call);
                continue;
            }
            stack.push((at, slope, true));
            let info = &self.types.nodes[at];
            let function = self.function(at);
            for (index, input) in info.def.inputs.iter().enumerate().rev() {
                let wanted = function.arguments.iter().any(|a| matches!(a, Argument::Input(n) if *n == input.name));
                let source = self.types.sources[at][index].and_then(Source::computed).filter(|_| wanted);
                stack.extend(source.map(|node| (node, self.is_slope(at, slope, index), false)));
            }
        }
        self.value(arena, table, node, slope, index).map(Some)
    }

    /// Whether the slope of what an input is given counts; `slope`: whether that of what the node computes does.
    fn is_slope(&self, node: usize, slope: bool, input: usize) -> bool {
        let def = self.types.nodes[node].def;
        slope || self.blend != Blend::Never && def.slopes.contains(&def.inputs[input].name)
    }

    /// The function that computes a node in this stage under the chosen methods.
    fn function(&self, node: usize) -> &'a Function {
        let def = self.types.nodes[node].def;
        let by_method = def
            .method_functions
            .iter()
            .find(|(term, method, _)| halfvector_graph::method::term(term).is_some() && self.methods.is(term, method));
        match (self.stage, by_method, &def.vertex_function) {
            (_, Some((_, _, function)), _) if self.stage == StageKind::Fragment || !function.implicit_derivatives => {
                function
            }
            (StageKind::Vertex, _, Some(function)) => function,
            _ => &def.function,
        }
    }

    /// Whether a node reads pictures whose slope counts, all of them filtered linearly.
    fn blends(&self, node: usize, slope: bool) -> bool {
        let inputs = self.types.nodes[node].def.inputs.iter().enumerate();
        let mut pictures = inputs.filter(|(_, input)| input.ty == SocketType::Texture).map(|(index, _)| index);
        let is_filtered = |index: usize| {
            let (node, index) = self.picture(node, index);
            let info = &self.types.nodes[node];
            let value = info.values.get(&info.def.inputs[index].name);
            matches!(value, Some(Value::Image(image)) if image.filter == Filter::Linear)
        };
        pictures.clone().any(|index| self.is_slope(node, slope, index)) && pictures.all(is_filtered)
    }

    /// The node and the number of its input that hold the picture of an input: it may be handed on from a group's.
    fn picture(&self, node: usize, index: usize) -> (usize, usize) {
        match self.types.sources[node][index] {
            Some(Source::Input { node, input }) => (node, input),
            _ => (node, index),
        }
    }

    fn call(&self, arena: &mut Arena<'a>, table: &mut Table, node: usize, slope: bool) -> Result<Id, CodegenError> {
        let info: &NodeInfo<'a> = &self.types.nodes[node];
        let function = self.function(node);
        if self.stage == StageKind::Vertex && function.implicit_derivatives {
            return Err(CodegenError::NotInVertexStage { node: info.id.clone(), label: info.label.to_owned() });
        }
        let mut arguments = Vec::with_capacity(function.arguments.len());
        for argument in &function.arguments {
            let name = match argument {
                Argument::Input(name) | Argument::Sampler(name) => name,
                Argument::Frame(frame) => {
                    let expr = Expr::Frame(frame);
                    arguments.push(arena.push(Entry { expr, ty: Ty::Resource, node: None, hint: "" }));
                    continue;
                }
            };
            let Some(index) = info.def.inputs.iter().position(|i| i.name == *name) else {
                return Err(CodegenError::Library(format!(
                    "the function `{}` takes `{name}`, which is no input of `{}`",
                    function.name, info.def.id
                )));
            };
            let value = self.value(arena, table, node, slope, index)?;
            arguments.push(match (argument, &arena.get(value).expr) {
                (Argument::Sampler(_), Expr::Texture(image)) => {
                    let sampler = Expr::Sampler(*image);
                    arena.push(Entry { expr: sampler, ty: Ty::Resource, node: None, hint: "" })
                }
                _ => value,
            });
        }
        let generic = if info.def.generic.is_empty() { None } else { info.generic };
        let twin = if self.blends(node, slope) { self.index.blended(&function.name) } else { None };
        let expr = Expr::Call { function: twin.unwrap_or(&function.name), generic, arguments };
        let ty = if function.returns_struct {
            Ty::Struct
        } else {
            match info.def.outputs.first().map(|o| o.ty) {
                Some(SocketType::Value(ty)) => Ty::Value(ty),
                Some(SocketType::Generic) => Ty::Value(info.generic.unwrap_or(Type::F32)),
                _ => Ty::Struct,
            }
        };
        Ok(arena.push(Entry { expr, ty, node: Some(node), hint: "" }))
    }

    /// The value of an input, once what it is connected to is made; `slope`: whether the slope of what the node computes counts.
    fn value(
        &self,
        arena: &mut Arena<'a>,
        table: &mut Table,
        node: usize,
        slope: bool,
        index: usize,
    ) -> Result<Id, CodegenError> {
        let info = &self.types.nodes[node];
        let def = &info.def.inputs[index];
        let ty = match def.ty {
            SocketType::Value(ty) => ty,
            SocketType::Generic => info.generic.unwrap_or(Type::F32),
            SocketType::Texture => {
                let (node, index) = self.picture(node, index);
                return self.texture(arena, table, node, &self.types.nodes[node].def.inputs[index]);
            }
            SocketType::Surface => {
                let source = self.types.sources[node][index].and_then(Source::computed);
                let call = source.and_then(|source| self.calls.get(&(source, slope)));
                return call.copied().ok_or(CodegenError::NoSurface);
            }
        };
        let is_open = self.types.gives_surface(node) && self.open == Some(def.name.as_str());
        if let (Some(Source::Input { node, input }), false) = (self.types.sources[node][index], is_open) {
            let id = self.value(arena, table, node, slope, input)?;
            return Ok(arena.convert(id, ty));
        }
        if let (Some(Source::Output { node: source, output }), false) = (self.types.sources[node][index], is_open) {
            let from = &self.types.nodes[source];
            let output = &from.def.outputs[output];
            let call = self.calls[&(source, self.is_slope(node, slope, index))];
            let id = if matches!(arena.get(call).ty, Ty::Struct) {
                let from_ty = match output.ty {
                    SocketType::Value(ty) => ty,
                    _ => from.generic.unwrap_or(Type::F32),
                };
                let field = Expr::Field { of: call, name: &output.name };
                arena.push(Entry { expr: field, ty: Ty::Value(from_ty), node: Some(source), hint: "" })
            } else {
                call
            };
            return Ok(arena.convert(id, ty));
        }
        let set = info.values.get(&def.name);
        let components = match (set.and_then(Value::numbers), &def.default) {
            (Some(components), _) => components,
            (None, Default::Value(value)) => value.numbers().unwrap_or_else(|| vec![0.0]),
            (None, Default::Context(name)) => return Ok(self.context(arena, name, ty)),
            (None, Default::Image(_) | Default::Surface) => vec![0.0],
        };
        let parameter = self.types.parameters.get(&(info.id.as_str(), def.name.as_str())).copied();
        if self.fold == Fold::Export && parameter.is_none() && !is_open {
            return Ok(arena.literal(ty, &components));
        }
        let input = table.input(node, index, || Input {
            node,
            socket: SocketRef { node: info.id.clone(), socket: def.name.clone() },
            ty,
            value: crate::ir::Literal::new(ty, &components).numbers(),
            parameter,
        });
        Ok(arena.push(Entry { expr: Expr::Input(input), ty: Ty::Value(ty), node: Some(node), hint: "" }))
    }

    fn context(&self, arena: &mut Arena<'a>, name: &str, ty: Type) -> Id {
        let Some(context) = halfvector_graph::context::context(name) else {
            return arena.literal(ty, &[0.0]);
        };
        if let Some((_, id)) = self.substitutes.iter().find(|(replaced, _)| *replaced == context.name) {
            return *id;
        }
        let expr = Expr::Context(context.name);
        let id = arena.push(Entry { expr, ty: Ty::Value(context.ty), node: None, hint: "" });
        arena.convert(id, ty)
    }

    fn texture(
        &self,
        arena: &mut Arena<'a>,
        table: &mut Table,
        node: usize,
        def: &InputDef,
    ) -> Result<Id, CodegenError> {
        let info = &self.types.nodes[node];
        let Some(Value::Image(image)) = info.values.get(&def.name) else {
            return Err(CodegenError::NoImage {
                node: info.id.clone(),
                label: info.label.to_owned(),
                socket: def.name.clone(),
            });
        };
        let image = table.image(node, image);
        Ok(arena.push(Entry { expr: Expr::Texture(image), ty: Ty::Resource, node: None, hint: "" }))
    }
}

/// The whole program: the surface's sockets for the fragment stage and the height for the vertex stage. The vertex stage
/// is folded at once, since a height that is the same everywhere needs no normals derived from it.
pub(crate) fn lower<'a>(
    types: &Types<'a>,
    index: &'a Index,
    methods: &Methods,
    fold: Fold,
    open: Option<&'static str>,
) -> Result<Program<'a>, CodegenError> {
    let mut table = Table::default();
    let mut vertex = Stage::default();
    let lowered = |stage| Lowering { open, ..Lowering::new(types, index, methods, fold, stage) };
    let mut lowering = Lowering { blend: Blend::All, ..lowered(StageKind::Vertex) };
    if let Some(height) = lowering.surface(&mut vertex.arena, &mut table, "height")? {
        vertex.roots.insert("height", height);
    }
    drop_unread(&mut vertex, index);
    drop_idle(&mut vertex, index);
    // Faults are found again, and told, when the whole program is folded.
    fold::fold_stage(&mut vertex, index, &mut Vec::new());
    let varies = vertex.root("height").is_some_and(|id| {
        let parts = mixed::parts(&vertex.arena, id);
        parts.iter().any(|id| !matches!(vertex.arena.get(*id).expr, Expr::Literal(_) | Expr::Input(_)))
    });

    let mut fragment = Stage::default();
    let derived_normal = varies && !methods.is("height_normals", "report");
    let mut lowering = lowered(StageKind::Fragment);
    for socket in SOCKETS.into_iter().filter(|s| !NORMALS.contains(s)) {
        if let Some(id) = lowering.surface(&mut fragment.arena, &mut table, socket)? {
            fragment.roots.insert(socket, id);
        }
    }
    // Made apart: what feeds other sockets, too, is read as they like it.
    let mut heights = Lowering { blend: Blend::All, ..lowered(StageKind::Fragment) };
    if derived_normal && let Some(height) = heights.surface(&mut fragment.arena, &mut table, "height")? {
        let normal = normal_from_height(&mut fragment.arena, height);
        // Kept for the tangent of a brushed lobe.
        fragment.roots.insert(DISPLACED_NORMAL, normal);
        let tangent = fragment.arena.own(Expr::Context("world_tangent"), Type::Vec4, "");
        let tangent = displaced_tangent(&mut fragment.arena, tangent, normal);
        lowering.substitute(vec![("world_normal", normal), ("world_tangent", tangent)]);
    }
    for socket in NORMALS {
        if let Some(id) = lowering.surface(&mut fragment.arena, &mut table, socket)? {
            fragment.roots.insert(socket, id);
        }
    }
    drop_unread(&mut fragment, index);
    drop_idle(&mut fragment, index);
    let Table { inputs, images, .. } = table;
    Ok(Program { nodes: types.nodes.clone(), inputs, images, fragment, vertex, derived_normal })
}

/// The program of the material alone: the call of the surface node, as the root `surface` of the fragment stage.
pub(crate) fn lower_material<'a>(
    types: &Types<'a>,
    index: &'a Index,
    methods: &Methods,
    fold: Fold,
) -> Result<Program<'a>, CodegenError> {
    let mut table = Table::default();
    let mut stage = Stage::default();
    let exact = Lowering::new(types, index, methods, fold, StageKind::Fragment);
    let mut lowering = Lowering { blend: Blend::Never, ..exact };
    // Making each input makes all nodes that the surface reads.
    for input in &types.nodes[types.surface].def.inputs {
        lowering.input(&mut stage.arena, &mut table, types.surface, &input.name)?;
    }
    let surface = lowering.call(&mut stage.arena, &mut table, types.surface, false)?;
    stage.roots.insert("surface", surface);
    drop_unread(&mut stage, index);
    drop_idle(&mut stage, index);
    let Table { inputs, images, .. } = table;
    let nodes = types.nodes.clone();
    Ok(Program { nodes, inputs, images, fragment: stage, ..Program::default() })
}

/// The program of the height alone, as the root `height` of a stage; `None` where the surface has no such socket.
pub(crate) fn lower_height<'a>(
    types: &Types<'a>,
    index: &'a Index,
    methods: &Methods,
    stage: StageKind,
) -> Result<Option<Program<'a>>, CodegenError> {
    let mut table = Table::default();
    let mut made = Stage::default();
    let exact = Lowering::new(types, index, methods, Fold::Export, stage);
    let mut lowering = Lowering { blend: Blend::Never, ..exact };
    let Some(height) = lowering.surface(&mut made.arena, &mut table, "height")? else { return Ok(None) };
    made.roots.insert("height", height);
    drop_unread(&mut made, index);
    drop_idle(&mut made, index);
    let Table { inputs, images, .. } = table;
    let alone = Program { nodes: types.nodes.clone(), inputs, images, ..Program::default() };
    Ok(Some(match stage {
        StageKind::Vertex => Program { vertex: made, ..alone },
        StageKind::Fragment => Program { fragment: made, ..alone },
    }))
}

/// The displaced surface's normal, from screen-space derivatives of its position and of the height there.
fn normal_from_height<'a>(arena: &mut Arena<'a>, height: Id) -> Id {
    let position = arena.own(Expr::Context(DISPLACED_POSITION), Type::Vec3, "");
    let normal = arena.own(Expr::Context("world_normal"), Type::Vec3, "");
    let mut derivative = |name, of, ty| arena.own(Expr::Builtin { name, arguments: vec![of] }, ty, "");
    let arguments = vec![
        derivative("dpdx", position, Type::Vec3),
        derivative("dpdy", position, Type::Vec3),
        normal,
        derivative("dpdx", height, Type::F32),
        derivative("dpdy", height, Type::F32),
    ];
    arena.own(Expr::Call { function: NORMAL_FROM_HEIGHT, generic: None, arguments }, Type::Vec3, "displaced_normal")
}

/// A tangent of the old surface as one of the displaced surface, whose normal is given.
pub(super) fn displaced_tangent<'a>(arena: &mut Arena<'a>, tangent: Id, displaced_normal: Id) -> Id {
    let normal = arena.own(Expr::Context("world_normal"), Type::Vec3, "");
    let arguments = vec![normal, tangent, displaced_normal];
    arena.own(Expr::Call { function: "displaced_tangent", generic: None, arguments }, Type::Vec4, "displaced_tangent")
}

/// The root that is the displaced surface's normal, where it is derived from the height.
pub(super) const DISPLACED_NORMAL: &str = "displaced_normal";

/// What stands for the position as it is seen; `world_position` is that before displacement. No node reads it.
pub(crate) const DISPLACED_POSITION: &str = "displaced_position";

const NORMAL_FROM_HEIGHT: &str = "normal_from_height";

/// The normal, made unit unless it is known to be: the mesh's, a displaced surface's, and what a normal-mapping node
/// returns are.
pub(super) fn unit_normal<'a>(arena: &mut Arena<'a>, types: &Types<'a>, id: Id) -> Id {
    let entry = arena.get(id);
    let unit = match &entry.expr {
        Expr::Context("world_normal") => true,
        Expr::Call { function: NORMAL_FROM_HEIGHT, .. } => true,
        Expr::Call { .. } => entry
            .node
            .is_some_and(|node| types.nodes[node].def.method_functions.iter().any(|(term, _, _)| term == "normal")),
        _ => false,
    };
    if unit {
        return id;
    }
    let otherwise = arena.own(Expr::Context("world_normal"), Type::Vec3, "");
    let expr = Expr::Call { function: "normalize_or", generic: None, arguments: vec![id, otherwise] };
    arena.own(expr, Type::Vec3, "shading_normal")
}

/// The value that an unconnected input of a document has (`socket.node` may be a path into groups), with as many components as `ty` takes: what
/// `UniformSource::Input` is filled with. `None` for what has no number (a texture, an unset context, an unknown node).
pub fn input_value(document: &Document, library: &Library, socket: &SocketRef, ty: Type) -> Option<Vec<f64>> {
    let (_, _, node) = find(document, &socket.node)?;
    let default = |default: &Default| match default {
        Default::Value(value) => value.numbers(),
        Default::Context(_) | Default::Image(_) | Default::Surface => None,
    };
    let components = match (node.values.get(&socket.socket), group_of(&node.node)) {
        (Some(value), _) => value.numbers()?,
        (None, Some(group)) => {
            let inputs = &document.groups.get(group)?.interface.inputs;
            default(&inputs.iter().find(|i| i.name == socket.socket)?.default)?
        }
        // What a group gives where nothing is wired inside.
        (None, None) if node.node == GROUP_OUTPUT => vec![0.0],
        (None, None) => {
            let own = match function_of(&node.node) {
                Some(id) => Some(read_function(id, document.functions.get(id)?).ok()?),
                None => None,
            };
            let def = match &own {
                Some(function) => &function.def,
                None => library.get(&node.node)?,
            };
            default(&def.inputs.iter().find(|i| i.name == socket.socket)?.default)?
        }
    };
    Some(crate::ir::Literal::new(ty, &components).numbers())
}
