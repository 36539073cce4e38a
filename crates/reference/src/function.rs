//! A function of a document that takes a `Context`, run in f64 for many points at once.

use std::sync::Arc;

use glam::DVec3;
use halfvector_codegen::reflection::{Resource, SamplerSource, TextureSource, UniformSource, UniformType};
use halfvector_codegen::{Shader, input_value};
use halfvector_graph::library::{CAPABILITIES, Library};
use halfvector_interp::{
    Column, Derivatives, Entry, Limits, Machine, OutputColumn, Outputs, Program, Resources, Texture,
};
use halfvector_scene::{Scene, SceneMaterial, View};

use crate::ReferenceError;
use crate::geometry::{Detail, Point};
use crate::texture::{Textures, sampler};

/// Something of a point that a material asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Context {
    Uv0,
    Uv1,
    VertexColor,
    WorldPosition,
    ObjectPosition,
    WorldNormal,
    WorldTangent,
    ViewDir,
    Time,
    WorldFromObject,
    ObjectFromWorld,
    ViewFromWorld,
}

impl Context {
    fn from_name(name: &str) -> Option<Context> {
        Some(match name {
            "uv0" => Context::Uv0,
            "uv1" => Context::Uv1,
            "vertex_color" => Context::VertexColor,
            "world_position" => Context::WorldPosition,
            "object_position" => Context::ObjectPosition,
            "world_normal" => Context::WorldNormal,
            "world_tangent" => Context::WorldTangent,
            "view_dir" => Context::ViewDir,
            "time" => Context::Time,
            "world_from_object" => Context::WorldFromObject,
            "object_from_world" => Context::ObjectFromWorld,
            "view_from_world" => Context::ViewFromWorld,
            _ => return None,
        })
    }

    fn of(self, point: &Point, component: usize, frames: &Frames) -> f64 {
        let object = || frames.objects.get(point.body as usize).unwrap_or(&frames.view);
        match self {
            Context::WorldFromObject => object().0[component],
            Context::ObjectFromWorld => object().1[component],
            Context::ViewFromWorld => frames.view.0[component],
            Context::Uv0 => point.uv0[component],
            Context::Uv1 => point.uv1[component],
            Context::VertexColor => point.color[component],
            Context::WorldPosition => point.surface_position[component],
            Context::ObjectPosition => point.object_position[component],
            Context::WorldNormal => point.normal[component],
            Context::WorldTangent => point.tangent[component],
            Context::ViewDir => point.view_dir[component],
            Context::Time => 0.0,
        }
    }
}

/// A transform and the way back, column by column.
type Frame = ([f64; 16], [f64; 16]);

/// The transforms between spaces.
pub(crate) struct Frames {
    /// World from object space, of each object of the scene.
    objects: Vec<Frame>,
    /// View from world space.
    view: Frame,
}

impl Frames {
    pub(crate) fn new(scene: &Scene) -> Frames {
        let numbers = |m: glam::Mat4| m.as_dmat4().to_cols_array();
        let of = |object: &halfvector_scene::Object| {
            (numbers(object.world_from_object), numbers(object.object_from_world()))
        };
        let view = View::new(&scene.camera, 1.0, 1.0).view_from_world();
        Frames { objects: scene.objects.iter().map(of).collect(), view: (numbers(view), numbers(view.inverse())) }
    }
}

/// A function ready to be run.
pub(crate) struct Function {
    /// Name of the material that it is of.
    material: String,
    program: Program,
    frames: Arc<Frames>,
    /// What each input is.
    inputs: Vec<(Context, usize)>,
    buffers: Vec<((u32, u32), Vec<u8>)>,
    textures: Vec<((u32, u32), Arc<Texture>)>,
    samplers: Vec<((u32, u32), halfvector_interp::Sampler)>,
    /// Whether it takes derivatives of its own, beside those that choose a texture's level.
    pub(crate) derives: bool,
    /// What it asks of points.
    pub(crate) detail: Detail,
}

/// Number of the component that the last part of a path names.
pub(crate) fn component(part: Option<&str>) -> Option<usize> {
    match part {
        None | Some("x") => Some(0),
        Some("y") => Some(1),
        Some("z") => Some(2),
        Some("w") => Some(3),
        Some(_) => None,
    }
}

impl Function {
    /// Compiles the function `name` of a shader that was made of a scene's material.
    pub(crate) fn new(
        scene: &Scene,
        material: &SceneMaterial,
        shader: &Shader,
        name: &str,
        frames: &Arc<Frames>,
        textures: &mut Textures,
    ) -> Result<Function, ReferenceError> {
        let document = &material.document;
        let wrong = |why: String| ReferenceError::Material { material: document.name.clone(), why };
        let module = naga::front::wgsl::parse_str(&shader.wgsl).map_err(|error| wrong(error.to_string()))?;
        let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), CAPABILITIES)
            .validate(&module)
            .map_err(|error| wrong(error.as_inner().to_string()))?;
        let program =
            Program::compile(&module, &info, Entry::Function(name)).map_err(|error| wrong(error.to_string()))?;

        let mut inputs = Vec::new();
        for slot in program.inputs() {
            let mut path = slot.name.split('.').skip(1);
            let context = path.next().and_then(Context::from_name);
            // Of a matrix the column comes first.
            let place = match (path.next(), path.next()) {
                (Some(column), Some(row)) => column.parse::<usize>().ok().zip(component(Some(row))),
                (part, None) => component(part).map(|component| (0, component)),
                _ => None,
            };
            match (context, place) {
                (Some(context), Some((column, row))) => inputs.push((context, 4 * column + row)),
                _ => return Err(wrong(format!("it asks for `{}`, which the reference does not know", slot.name))),
            }
        }
        let mut made = Function {
            material: document.name.clone(),
            frames: frames.clone(),
            inputs,
            buffers: Vec::new(),
            textures: Vec::new(),
            samplers: Vec::new(),
            // The text of comments may say so too: that costs time, no more.
            derives: ["dpdx", "dpdy", "fwidth"].iter().any(|name| shader.wgsl.contains(name)),
            detail: Detail::default(),
            program,
        };
        for (context, _) in &made.inputs {
            made.detail.places |= matches!(context, Context::Uv0 | Context::Uv1 | Context::ObjectPosition);
            made.detail.tangents |= *context == Context::WorldTangent;
            made.detail.colors |= *context == Context::VertexColor;
        }
        for binding in &shader.reflection.bindings {
            let at = (binding.group, binding.binding);
            match &binding.resource {
                Resource::Uniform(block) => {
                    let fill = |source: &UniformSource, numbers: &mut Vec<f64>| {
                        let member = block.members.iter().find(|member| member.source == *source);
                        match (source, member.map(|member| member.ty)) {
                            (UniformSource::Input(socket), Some(UniformType::Value(ty))) => {
                                let value = input_value(document, Library::standard(), socket, ty);
                                numbers.extend(value.unwrap_or_default());
                            }
                            (UniformSource::Time, _) => numbers.push(0.0),
                            _ => {}
                        }
                    };
                    made.buffers.push((at, block.pack(fill).map_err(|error| wrong(error.to_string()))?));
                }
                Resource::Texture(TextureSource::Image(image)) => {
                    let texture = textures.get(scene, material, image)?;
                    made.textures.push((at, texture));
                }
                Resource::Texture(_) => {}
                Resource::Sampler(SamplerSource::Image { wrap_u, wrap_v, filter }) => {
                    made.samplers.push((at, sampler(*wrap_u, *wrap_v, *filter)));
                }
                Resource::Sampler(SamplerSource::LinearClamp) => {}
            }
        }
        Ok(made)
    }

    /// The numbers that it returns, by name.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = &str> {
        self.program.outputs().iter().map(|slot| slot.name.as_str())
    }

    /// Whether the mesh's normal changes what it returns.
    pub(crate) fn reads_normal(&self) -> bool {
        self.inputs.iter().any(|(context, _)| *context == Context::WorldNormal)
    }

    /// Whether it returns the same for every point.
    pub(crate) fn is_constant(&self) -> bool {
        self.inputs.is_empty()
    }

    /// The machine that runs it: one for each thread.
    pub(crate) fn runner(&self) -> Result<Runner<'_>, ReferenceError> {
        let mut resources = Resources::default();
        for ((group, binding), bytes) in &self.buffers {
            resources = resources.buffer(*group, *binding, bytes);
        }
        for ((group, binding), texture) in &self.textures {
            resources = resources.texture(*group, *binding, texture);
        }
        for ((group, binding), sampler) in &self.samplers {
            resources = resources.sampler(*group, *binding, *sampler);
        }
        let machine = self.program.machine(Limits::default()).map_err(|error| self.wrong(&error))?;
        let (columns, results) = (Default::default(), Outputs::default());
        Ok(Runner { function: self, machine, resources, columns, has_steps: false, results })
    }

    fn wrong(&self, error: &dyn std::fmt::Display) -> ReferenceError {
        ReferenceError::Material { material: self.material.clone(), why: error.to_string() }
    }
}

/// A function and the memory to run it.
pub(crate) struct Runner<'f> {
    function: &'f Function,
    machine: Machine<'f, f64>,
    resources: Resources<'f>,
    /// Inputs, and their changes along x and y.
    columns: [Vec<Vec<f64>>; 3],
    /// Whether the changes are there.
    has_steps: bool,
    results: Outputs<f64>,
}

/// Points, and the same points one step along x and along y of the picture.
pub(crate) type Steps<'a> = [&'a [Point]; 2];

impl Runner<'_> {
    /// Runs it at each point.
    pub(crate) fn run(&mut self, points: &[Point], steps: Option<Steps<'_>>) -> Result<(), ReferenceError> {
        let (inputs, frames) = (&self.function.inputs, &self.function.frames);
        self.has_steps = steps.is_some();
        let sets = [Some(points), steps.map(|s| s[0]), steps.map(|s| s[1])];
        for (k, (columns, set)) in self.columns.iter_mut().zip(sets).enumerate() {
            columns.resize(inputs.len(), Vec::new());
            for (column, (context, component)) in columns.iter_mut().zip(inputs) {
                column.clear();
                let Some(set) = set else { continue };
                column.extend(set.iter().zip(points).map(|(point, base)| {
                    let x = context.of(point, *component, frames);
                    if k == 0 {
                        return x;
                    }
                    let change = x - context.of(base, *component, frames);
                    // The seam of a texture is no step.
                    if matches!(context, Context::Uv0 | Context::Uv1) { change - change.round() } else { change }
                }));
            }
        }
        self.execute(points.len())
    }

    /// Runs it once more at the same points, but with other normals, and with the tangents that they have now. How these
    /// change from step to step stays as it was.
    pub(crate) fn run_bent(&mut self, normals: &[DVec3], points: &[Point]) -> Result<(), ReferenceError> {
        for (column, (context, component)) in self.columns[0].iter_mut().zip(&self.function.inputs) {
            match context {
                Context::WorldNormal => {
                    column.clear();
                    column.extend(normals.iter().map(|normal| normal[*component]));
                }
                Context::WorldTangent => {
                    column.clear();
                    column.extend(points.iter().map(|point| point.tangent[*component]));
                }
                _ => {}
            }
        }
        self.execute(normals.len())
    }

    fn execute(&mut self, count: usize) -> Result<(), ReferenceError> {
        let columns = |set: usize| -> Vec<Column<'_, f64>> {
            self.columns[set].iter().map(|column| Column::Float(column)).collect()
        };
        let (values, ddx, ddy) = (columns(0), columns(1), columns(2));
        let derivatives = if self.has_steps { Derivatives::Given { ddx: &ddx, ddy: &ddy } } else { Derivatives::Zero };
        self.machine
            .run(&values, count, &mut self.results, &self.resources, derivatives)
            .map_err(|error| self.function.wrong(&error))
    }

    /// Of the last run one number of what it returned, for each point; none where it is no float.
    pub(crate) fn result(&self, output: usize) -> Option<&[f64]> {
        match self.results.columns.get(output) {
            Some(OutputColumn::Float(numbers)) => Some(numbers),
            _ => None,
        }
    }
}
