//! All nodes of a material at once: `material(context)` with every node's outputs as its result, and with the exposed
//! parameters as an argument, so that each point has its own.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;

use halfvector_codegen::reflection::{Resource, TextureSource};
use halfvector_codegen::uniforms::fill_input;
use halfvector_codegen::{CodegenError, Origin, Shader};
use halfvector_graph::check::node_label;
use halfvector_graph::document::{Document, NodeId};
use halfvector_graph::flatten::flatten;
use halfvector_graph::library::{CAPABILITIES, Library};
use halfvector_interp::{
    Column, Derivatives, Entry, Float, Limits, OutputColumn, Outputs, Program, Resources, Sampler, Slot, Texture, Watch,
};
use halfvector_scene::{Scene, SceneMaterial};
use naga::valid::{ModuleInfo, ValidationFlags, Validator};
use naga::{ScalarKind, TypeInner};

use crate::stability::StabilityError;
use crate::stability::domain::{Input, Number, Points, Source};

/// A material that tells what its nodes compute.
pub(super) struct Trace<'d> {
    name: &'d str,
    /// The document with its groups taken apart: nodes have the ids that the shader names.
    pub(super) flat: Cow<'d, Document>,
    /// The definitions of its nodes.
    pub(super) library: Library,
    program: Program,
    module: naga::Module,
    info: ModuleInfo,
    /// Each scalar that it reads.
    pub(super) inputs: Vec<Input>,
    /// Each scalar of the result.
    pub(super) values: Vec<Value>,
    textures: Vec<((u32, u32), Texture)>,
    samplers: Vec<((u32, u32), Sampler)>,
}

/// A scalar that a node gives.
#[derive(Clone, Debug)]
pub(super) struct Value {
    pub(super) node: NodeId,
    pub(super) label: String,
    /// The socket: `out`, `f1`.
    pub(super) socket: String,
    /// With the component, where it is a vector: `out.x`.
    pub(super) output: String,
    /// The same number for all components of one output.
    pub(super) group: usize,
}

/// A value that `material` names: its node, and the text and type of each output.
struct Named {
    node: NodeId,
    outputs: Vec<(String, String, usize)>,
}

impl<'d> Trace<'d> {
    /// The material as it is exported: what is constant is a number.
    pub(super) fn new(scene: &Scene, material: &'d SceneMaterial) -> Result<Trace<'d>, StabilityError> {
        let shader = halfvector_codegen::material(&material.document, Library::standard(), &scene.methods);
        Trace::of(scene, material, shader)
    }

    /// The material with every node that reaches the surface: all numbers of the document are inputs, fixed unless exposed.
    pub(super) fn live(scene: &Scene, material: &'d SceneMaterial) -> Result<Trace<'d>, StabilityError> {
        let shader = halfvector_codegen::material_live(&material.document, Library::standard(), &scene.methods);
        Trace::of(scene, material, shader)
    }

    fn of(
        scene: &Scene,
        material: &'d SceneMaterial,
        shader: Result<Shader, CodegenError>,
    ) -> Result<Trace<'d>, StabilityError> {
        let document = &material.document;
        let wrong = |why: String| StabilityError::Shader { material: document.name.clone(), why };
        let shader = shader.map_err(|error| wrong(error.to_string()))?;
        let named = named(&shader).map_err(wrong)?;
        let text = with_trace(&shader, &named).map_err(wrong)?;
        let module = naga::front::wgsl::parse_str(&text).map_err(|error| wrong(error.message().to_owned()))?;
        let info = Validator::new(ValidationFlags::all(), CAPABILITIES)
            .validate(&module)
            .map_err(|error| wrong(error.as_inner().to_string()))?;
        let program = Program::compile(&module, &info, Entry::Function("trace"))
            .map_err(|error| StabilityError::Run { material: document.name.clone(), why: error.to_string() })?;
        let flat = flatten(document, Library::standard()).map_err(|error| wrong(error.to_string()))?;
        let mut values = Vec::new();
        let mut group = 0;
        for Named { node, outputs } in &named {
            let label = node_label(&flat.document.graph, &flat.library, node);
            for (socket, _, components) in outputs {
                for component in 0..*components {
                    let output = if *components == 1 {
                        socket.clone()
                    } else {
                        format!("{socket}.{}", ["x", "y", "z", "w"][component])
                    };
                    values.push(Value {
                        node: node.clone(),
                        label: label.clone(),
                        socket: socket.clone(),
                        output,
                        group,
                    });
                }
                group += 1;
            }
        }
        let numbers = Arguments { document, shader: &shader };
        let inputs = program.inputs().iter().map(|slot| numbers.input(slot)).collect();
        let mut trace = Trace {
            name: &document.name,
            flat: flat.document,
            library: flat.library,
            program,
            module,
            info,
            inputs,
            values,
            textures: Vec::new(),
            samplers: Vec::new(),
        };
        trace.bind(scene, material, &shader)?;
        Ok(trace)
    }

    fn bind(&mut self, scene: &Scene, material: &SceneMaterial, shader: &Shader) -> Result<(), StabilityError> {
        for binding in &shader.reflection.bindings {
            let place = (binding.group, binding.binding);
            match &binding.resource {
                Resource::Texture(TextureSource::Image(reference)) => {
                    let image = scene.images.get(&material.directory, reference);
                    let texture = image.and_then(|image| halfvector_raster::texture(image, reference.color_space));
                    let missing = || StabilityError::MissingImage {
                        material: material.document.name.clone(),
                        file: reference.file.clone(),
                    };
                    self.textures.push((place, texture.ok_or_else(missing)?));
                }
                // The parameters are an argument, and a material alone reads no environment.
                Resource::Uniform(_) | Resource::Texture(_) => {}
                Resource::Sampler(source) => self.samplers.push((place, halfvector_raster::sampler(source))),
            }
        }
        Ok(())
    }

    /// Steps of the program.
    pub(super) fn steps(&self) -> usize {
        self.program.steps()
    }

    /// The same program with the numbers that it decides by.
    pub(super) fn watched(&self) -> Result<Watched<'_>, StabilityError> {
        let (program, watches) = Program::compile_watched(&self.module, &self.info, Entry::Function("trace"))
            .map_err(|error| StabilityError::Run { material: self.name.to_owned(), why: error.to_string() })?;
        let first = program.outputs().len() - watches.len();
        let program = Watched { watches, trace: self, program, first };
        Ok(program)
    }

    /// Every value at every point.
    pub(super) fn run<F: Float>(&self, points: &Points) -> Result<Vec<Vec<f64>>, StabilityError> {
        if points.count == 0 {
            return Ok(vec![Vec::new(); self.values.len()]);
        }
        let outputs = self.execute::<F>(&self.program, points)?;
        Ok(outputs.columns.iter().map(|column| column.to_f64()).collect())
    }

    fn execute<F: Float>(&self, program: &Program, points: &Points) -> Result<Outputs<F>, StabilityError> {
        let mut resources = Resources::default();
        for ((group, binding), texture) in &self.textures {
            resources = resources.texture(*group, *binding, texture);
        }
        for ((group, binding), sampler) in &self.samplers {
            resources = resources.sampler(*group, *binding, *sampler);
        }
        let (mut floats, mut words) = (Vec::new(), Vec::new());
        for (input, column) in self.inputs.iter().zip(&points.columns) {
            match input.number {
                Number::Float => floats.push(column.iter().map(|x| F::from_f64(*x)).collect::<Vec<F>>()),
                Number::Signed => words.push(column.iter().map(|x| (*x as i32).cast_unsigned()).collect::<Vec<u32>>()),
                Number::Unsigned => words.push(column.iter().map(|x| *x as u32).collect()),
            }
        }
        let (mut floats_left, mut words_left) = (floats.iter(), words.iter());
        let columns: Vec<Column<'_, F>> = self
            .inputs
            .iter()
            .filter_map(|input| match input.number {
                Number::Float => floats_left.next().map(|column| Column::Float(column)),
                Number::Signed | Number::Unsigned => words_left.next().map(|column| Column::Word(column)),
            })
            .collect();
        let mut outputs = Outputs::default();
        program
            .run(&columns, points.count, &mut outputs, &resources, Derivatives::Zero, Limits::default())
            .map_err(|error| StabilityError::Run { material: self.name.to_owned(), why: error.to_string() })?;
        Ok(outputs)
    }
}

/// A material that tells what its nodes decide by.
pub(super) struct Watched<'t> {
    /// How each number matters.
    pub(super) watches: Vec<Watch>,
    trace: &'t Trace<'t>,
    program: Program,
    /// Outputs of the program before them.
    first: usize,
}

impl Watched<'_> {
    /// The numbers at points, exactly computed.
    pub(super) fn run(&self, points: &Points) -> Result<Numbers, StabilityError> {
        let Outputs { mut columns, .. } = self.trace.execute::<f64>(&self.program, points)?;
        Ok(Numbers(columns.split_off(self.first)))
    }
}

/// What a material decides by, at points.
pub(super) struct Numbers(Vec<OutputColumn<f64>>);

impl Numbers {
    /// One of them, at all points.
    pub(super) fn column(&self, watch: usize) -> &[f64] {
        match &self.0[watch] {
            OutputColumn::Float(column) | OutputColumn::Double(column) => column,
            OutputColumn::Word(_) => &[],
        }
    }
}

/// What a program's arguments stand for.
struct Arguments<'s> {
    document: &'s Document,
    shader: &'s Shader,
}

impl Arguments<'_> {
    /// An argument's scalar: `context.uv0.x`, `parameters.tint.y`.
    fn input(&self, slot: &Slot) -> Input {
        let number = match slot.scalar.kind {
            ScalarKind::Sint => Number::Signed,
            ScalarKind::Uint | ScalarKind::Bool => Number::Unsigned,
            _ => Number::Float,
        };
        let (argument, name) = slot.name.split_once('.').unwrap_or(("", &slot.name));
        let way: Vec<&str> = name.split('.').collect();
        let (first, way) = way.split_first().map_or((name, &way[..]), |(first, way)| (*first, way));
        let source = if argument == PARAMETERS { self.member(first, way) } else { Source::of_context(first, way) };
        Input { name: name.to_owned(), source, number }
    }

    /// A member of the parameters: what is exposed has a range, every other number is the document's.
    fn member(&self, name: &str, way: &[&str]) -> Source {
        let component = way.first().and_then(|part| "xyzw".find(part)).unwrap_or_default();
        let reflection = &self.shader.reflection;
        if let Some(parameter) = reflection.parameters.iter().find(|parameter| parameter.name == name) {
            let default = parameter.default.get(component).copied().unwrap_or_default();
            let is_finite = |range: &[f32; 2]| range.iter().all(|x| x.is_finite());
            let [from, to] = parameter.range.filter(is_finite).unwrap_or([0.0, 1.0]);
            return Source::Parameter { default, from: f64::from(from), to: f64::from(to) };
        }
        let mut numbers = Vec::new();
        for binding in &reflection.bindings {
            if let Resource::Uniform(block) = &binding.resource
                && let Some(member) = block.members.iter().find(|member| member.name == name)
            {
                fill_input(self.document, Library::standard(), block, &member.source, &mut numbers);
            }
        }
        Source::Fixed(numbers.get(component).copied().unwrap_or_default())
    }
}

/// The values that `material` names, in order, with the outputs that are floats.
fn named(shader: &Shader) -> Result<Vec<Named>, String> {
    let module = naga::front::wgsl::parse_str(&shader.wgsl).map_err(|error| error.message().to_owned())?;
    let info = Validator::new(ValidationFlags::all(), CAPABILITIES)
        .validate(&module)
        .map_err(|error| error.as_inner().to_string())?;
    let (handle, function) = module
        .functions
        .iter()
        .find(|(_, function)| function.name.as_deref() == Some("material"))
        .ok_or_else(|| "it has no function `material`".to_owned())?;
    let components = |inner: &TypeInner| match inner {
        TypeInner::Scalar(scalar) if scalar.kind == ScalarKind::Float => Some(1),
        TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Float => Some(*size as usize),
        _ => None,
    };
    let mut all = BTreeMap::new();
    for (expression, name) in &function.named_expressions {
        let line = format!("    let {name} = ");
        let Some(start) = shader.wgsl.find(&line) else { continue };
        let segment = shader.segments.iter().find(|segment| segment.range().contains(&start));
        let Some(Origin::Node(node)) = segment.map(|segment| &segment.origin) else { continue };
        let outputs = match info[handle][*expression].ty.inner_with(&module.types) {
            TypeInner::Struct { members, .. } => members
                .iter()
                .filter_map(|member| {
                    let output = member.name.clone()?;
                    let text = format!("{name}.{output}");
                    Some((output, text, components(&module.types[member.ty].inner)?))
                })
                .collect(),
            inner => components(inner).map(|n| ("out".to_owned(), name.clone(), n)).into_iter().collect(),
        };
        all.insert(start, Named { node: node.clone(), outputs });
    }
    Ok(all.into_values().collect())
}

/// The variable that holds the exposed parameters.
const PARAMETERS: &str = "parameters";

/// The shader with a function `trace` beside `material`: the same lines, and all outputs as result. Its argument `parameters`
/// hides the variable of that name, which only `material` reads.
fn with_trace(shader: &Shader, named: &[Named]) -> Result<String, String> {
    let wgsl = &shader.wgsl;
    let start = wgsl.find("fn material(").ok_or_else(|| "it has no function `material`".to_owned())?;
    let end = start + wgsl[start..].find("    return ").ok_or_else(|| "`material` returns nothing".to_owned())?;
    let (head, body) = wgsl[start..end].split_once('\n').unwrap_or_default();
    let mut arguments = Vec::new();
    if head.contains("context") {
        arguments.push("context: Context".to_owned());
    }
    let variable = format!("var<uniform> {PARAMETERS}: ");
    if let Some((_, rest)) = wgsl.split_once(&variable) {
        let (ty, _) = rest.split_once(';').unwrap_or_default();
        arguments.push(format!("{PARAMETERS}: {ty}"));
    }
    let arguments = arguments.join(", ");
    let (mut members, mut results) = (String::new(), Vec::new());
    for (_, text, components) in named.iter().flat_map(|named| &named.outputs) {
        let ty = ["f32", "vec2f", "vec3f", "vec4f"][components - 1];
        // Writing to a String cannot fail.
        let _ = write!(members, "v{}: {ty}, ", results.len());
        results.push(text.as_str());
    }
    if results.is_empty() {
        return Err("it computes nothing".to_owned());
    }
    let results = results.join(", ");
    Ok(format!(
        "{wgsl}\nstruct Trace {{ {members} }}\nfn trace({arguments}) -> Trace {{\n{body}    return Trace({results});\n}}\n"
    ))
}
