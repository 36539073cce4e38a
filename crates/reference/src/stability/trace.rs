//! All nodes of a material at once: `material(context)` with every node's outputs as its result.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;

use halfvector_codegen::Origin;
use halfvector_codegen::Shader;
use halfvector_codegen::reflection::{Resource, TextureSource, UniformBlock, UniformSource};
use halfvector_codegen::uniforms::fill_input;
use halfvector_graph::check::node_label;
use halfvector_graph::document::{Document, NodeId};
use halfvector_graph::flatten::flatten;
use halfvector_graph::library::Library;
use halfvector_interp::{Column, Derivatives, Entry, Float, Limits, Outputs, Program, Resources, Sampler, Texture};
use halfvector_scene::{Scene, SceneMaterial};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{ScalarKind, TypeInner};

use crate::stability::StabilityError;

/// A material that tells what its nodes compute.
pub(super) struct Trace<'d> {
    document: &'d Document,
    /// The same with its groups taken apart: nodes have the ids that the shader names.
    pub(super) flat: Cow<'d, Document>,
    program: Program,
    /// Each scalar of the result.
    pub(super) values: Vec<Value>,
    /// The parameters' block: group, binding, layout.
    block: Option<((u32, u32), UniformBlock)>,
    /// Exposed parameters: the uniform's member, the socket, how many numbers, their range.
    pub(super) parameters: Vec<Parameter>,
    textures: Vec<((u32, u32), Texture)>,
    samplers: Vec<((u32, u32), Sampler)>,
}

/// A scalar that a node gives.
#[derive(Clone, Debug)]
pub(super) struct Value {
    pub(super) node: NodeId,
    pub(super) label: String,
    /// `out`, `out.x`, `f1`.
    pub(super) output: String,
    /// The same number for all components of one output.
    pub(super) group: usize,
}

/// A parameter that a material exposes.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub(super) name: String,
    source: UniformSource,
    pub(super) default: Vec<f32>,
    pub(super) range: [f32; 2],
}

/// A value that `material` names: its node, and the text and type of each output.
struct Named {
    node: NodeId,
    outputs: Vec<(String, String, usize)>,
}

impl<'d> Trace<'d> {
    pub(super) fn new(scene: &Scene, material: &'d SceneMaterial) -> Result<Trace<'d>, StabilityError> {
        let document = &material.document;
        let wrong = |why: String| StabilityError::Shader { material: document.name.clone(), why };
        let shader = halfvector_codegen::material(document, Library::standard(), &scene.methods)
            .map_err(|error| wrong(error.to_string()))?;
        let named = named(&shader).map_err(wrong)?;
        let text = with_trace(&shader, &named).map_err(wrong)?;
        let module = naga::front::wgsl::parse_str(&text).map_err(|error| wrong(error.message().to_owned()))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .map_err(|error| wrong(error.as_inner().to_string()))?;
        let program = Program::compile(&module, &info, Entry::Function("trace"))
            .map_err(|error| StabilityError::Run { material: document.name.clone(), why: error.to_string() })?;
        let flat = flatten(document, Library::standard()).map_err(|error| wrong(error.to_string()))?.document;
        let mut values = Vec::new();
        let mut group = 0;
        for Named { node, outputs } in &named {
            let label = node_label(&flat.graph, Library::standard(), node);
            for (output, _, components) in outputs {
                for component in 0..*components {
                    let output = if *components == 1 {
                        output.clone()
                    } else {
                        format!("{output}.{}", ["x", "y", "z", "w"][component])
                    };
                    values.push(Value { node: node.clone(), label: label.clone(), output, group });
                }
                group += 1;
            }
        }
        let mut trace = Trace {
            document,
            flat,
            program,
            values,
            block: None,
            parameters: Vec::new(),
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
                Resource::Uniform(block) => {
                    for parameter in &shader.reflection.parameters {
                        let Some(member) = block.members.iter().find(|member| member.name == parameter.name) else {
                            continue;
                        };
                        self.parameters.push(Parameter {
                            name: parameter.name.clone(),
                            source: member.source.clone(),
                            default: parameter.default.clone(),
                            range: parameter.range.filter(|r| r.iter().all(|x| x.is_finite())).unwrap_or([0.0, 1.0]),
                        });
                    }
                    self.block = Some((place, block.clone()));
                }
                Resource::Texture(TextureSource::Image(reference)) => {
                    let image = scene.images.get(&material.directory, reference);
                    let texture = image.and_then(|image| halfvector_raster::texture(image, reference.color_space));
                    let missing = || StabilityError::MissingImage {
                        material: material.document.name.clone(),
                        file: reference.file.clone(),
                    };
                    self.textures.push((place, texture.ok_or_else(missing)?));
                }
                // A material alone reads no environment.
                Resource::Texture(_) => {}
                Resource::Sampler(source) => self.samplers.push((place, halfvector_raster::sampler(source))),
            }
        }
        Ok(())
    }

    /// The contexts' scalars: `context.uv0.x`.
    pub(super) fn inputs(&self) -> impl Iterator<Item = &str> {
        self.program.inputs().iter().map(|slot| slot.name.as_str())
    }

    /// Every value at every point. `contexts` has a column for each of [`Trace::inputs`], `settings` numbers for each
    /// parameter.
    pub(super) fn run<F: Float>(
        &self,
        contexts: &[Vec<f64>],
        points: usize,
        settings: &[Vec<f32>],
    ) -> Result<Vec<Vec<f64>>, StabilityError> {
        let failed = |why: String| StabilityError::Run { material: self.document.name.clone(), why };
        let bytes = match &self.block {
            Some((_, block)) => block
                .pack(|source, numbers| match self.parameters.iter().position(|p| p.source == *source) {
                    Some(parameter) => numbers.extend(&settings[parameter]),
                    None => fill_input(self.document, Library::standard(), block, source, numbers),
                })
                .map_err(|error| failed(error.to_string()))?,
            None => Vec::new(),
        };
        let mut resources = Resources::default();
        if let Some(((group, binding), _)) = &self.block {
            resources = resources.buffer(*group, *binding, &bytes);
        }
        for ((group, binding), texture) in &self.textures {
            resources = resources.texture(*group, *binding, texture);
        }
        for ((group, binding), sampler) in &self.samplers {
            resources = resources.sampler(*group, *binding, *sampler);
        }
        let columns: Vec<Vec<F>> =
            contexts.iter().map(|column| column.iter().map(|x| F::from_f64(*x)).collect()).collect();
        let columns: Vec<Column<'_, F>> = columns.iter().map(|column| Column::Float(column)).collect();
        let mut outputs = Outputs::default();
        self.program
            .run(&columns, points, &mut outputs, &resources, Derivatives::Zero, Limits::default())
            .map_err(|error| failed(error.to_string()))?;
        Ok(outputs.columns.iter().map(|column| column.to_f64()).collect())
    }
}

/// The values that `material` names, in order, with the outputs that are floats.
fn named(shader: &Shader) -> Result<Vec<Named>, String> {
    let module = naga::front::wgsl::parse_str(&shader.wgsl).map_err(|error| error.message().to_owned())?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
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

/// The shader with a function `trace` beside `material`: the same lines, and all outputs as result.
fn with_trace(shader: &Shader, named: &[Named]) -> Result<String, String> {
    let wgsl = &shader.wgsl;
    let start = wgsl.find("fn material(").ok_or_else(|| "it has no function `material`".to_owned())?;
    let end = start + wgsl[start..].find("    return ").ok_or_else(|| "`material` returns nothing".to_owned())?;
    let (head, body) = wgsl[start..end].split_once('\n').unwrap_or_default();
    let argument = if head.contains("context") { "context: Context" } else { "" };
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
        "{wgsl}\nstruct Trace {{ {members} }}\nfn trace({argument}) -> Trace {{\n{body}    return Trace({results});\n}}\n"
    ))
}
