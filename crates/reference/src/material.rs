//! Materials as the reference evaluates them: the document's own `material(context) -> Surface`, run in f64 for many
//! points at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::{DVec2, DVec3, DVec4};
use halfvector_codegen::input_value;
use halfvector_codegen::reflection::{Resource, SamplerSource, TextureSource, UniformSource, UniformType};
use halfvector_graph::document::SurfaceSettings;
use halfvector_graph::library::{CAPABILITIES, Library};
use halfvector_graph::method::Methods;
use halfvector_interp::{
    Column, Derivatives, Entry, Limits, Machine, OutputColumn, Outputs, Program, Resources, Texture,
};
use halfvector_scene::{Scene, SceneMaterial, View};

use crate::ReferenceError;
use crate::geometry::{Detail, Point};
use crate::texture::{Textures, sampler};

/// The surface at one point, as the surface node gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Surface {
    pub(crate) base_color: [f64; 3],
    pub(crate) metallic: f64,
    pub(crate) perceptual_roughness: f64,
    pub(crate) ior: f64,
    pub(crate) specular: f64,
    pub(crate) normal: [f64; 3],
    pub(crate) occlusion: f64,
    pub(crate) emission: [f64; 3],
    pub(crate) opacity: f64,
    pub(crate) coat_weight: f64,
    pub(crate) coat_color: [f64; 3],
    pub(crate) coat_roughness: f64,
    pub(crate) coat_ior: f64,
    pub(crate) coat_normal: [f64; 3],
    pub(crate) sheen_color: [f64; 3],
    pub(crate) sheen_roughness: f64,
    pub(crate) transmission_weight: f64,
    pub(crate) anisotropy: f64,
    pub(crate) anisotropy_rotation: f64,
    pub(crate) thin_film_weight: f64,
    pub(crate) thin_film_thickness: f64,
    pub(crate) thin_film_ior: f64,
}

/// The members of the shader's struct that are read, each with its number of components, in the order of [`Surface`].
const MEMBERS: [(&str, usize); 22] = [
    ("base_color", 3),
    ("metallic", 1),
    ("perceptual_roughness", 1),
    ("ior", 1),
    ("specular", 1),
    ("normal", 3),
    ("occlusion", 1),
    ("emission", 3),
    ("opacity", 1),
    ("coat_weight", 1),
    ("coat_color", 3),
    ("coat_roughness", 1),
    ("coat_ior", 1),
    ("coat_normal", 3),
    ("sheen_color", 3),
    ("sheen_roughness", 1),
    ("transmission_weight", 1),
    ("anisotropy", 1),
    ("anisotropy_rotation", 1),
    ("thin_film_weight", 1),
    ("thin_film_thickness", 1),
    ("thin_film_ior", 1),
];

/// Numbers of a [`Surface`].
const NUMBERS: usize = 38;

impl Surface {
    fn from_numbers(numbers: &[f64; NUMBERS]) -> Surface {
        let mut rest = numbers.iter().copied();
        let mut one = || rest.next().unwrap_or_default();
        Surface {
            base_color: [one(), one(), one()],
            metallic: one(),
            perceptual_roughness: one(),
            ior: one(),
            specular: one(),
            normal: [one(), one(), one()],
            occlusion: one(),
            emission: [one(), one(), one()],
            opacity: one(),
            coat_weight: one(),
            coat_color: [one(), one(), one()],
            coat_roughness: one(),
            coat_ior: one(),
            coat_normal: [one(), one(), one()],
            sheen_color: [one(), one(), one()],
            sheen_roughness: one(),
            transmission_weight: one(),
            anisotropy: one(),
            anisotropy_rotation: one(),
            thin_film_weight: one(),
            thin_film_thickness: one(),
            thin_film_ior: one(),
        }
    }
}

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
            Context::WorldPosition => point.position[component],
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
struct Frames {
    /// World from object space, of each object of the scene.
    objects: Vec<Frame>,
    /// View from world space.
    view: Frame,
}

impl Frames {
    fn new(scene: &Scene) -> Frames {
        let numbers = |m: glam::Mat4| m.as_dmat4().to_cols_array();
        let of = |object: &halfvector_scene::Object| {
            (numbers(object.world_from_object), numbers(object.object_from_world()))
        };
        let view = View::new(&scene.camera, 1.0, 1.0).view_from_world();
        Frames { objects: scene.objects.iter().map(of).collect(), view: (numbers(view), numbers(view.inverse())) }
    }
}

/// A material ready to be evaluated.
pub(crate) struct Material {
    program: Program,
    frames: Frames,
    /// What each input is.
    inputs: Vec<(Context, usize)>,
    /// Where each output goes in the numbers of a [`Surface`].
    outputs: Vec<Option<usize>>,
    buffers: Vec<((u32, u32), Vec<u8>)>,
    textures: Vec<((u32, u32), Arc<Texture>)>,
    samplers: Vec<((u32, u32), halfvector_interp::Sampler)>,
    /// Whether it takes derivatives of its own, beside those that choose a texture's level.
    pub(crate) derives: bool,
    /// Points at which it was evaluated, and those of them at which it gave no finite surface.
    looked_at: [AtomicU64; 2],
    /// What it asks of points; tangents where it is brushed along them, too.
    pub(crate) detail: Detail,
    /// What opacity does, and whether both sides are seen.
    pub(crate) settings: SurfaceSettings,
}

impl Material {
    /// Compiles a material of a scene. `notes` takes what of it is not modelled.
    pub(crate) fn new(
        scene: &Scene,
        material: &SceneMaterial,
        methods: &Methods,
        textures: &mut Textures,
        notes: &mut Vec<String>,
    ) -> Result<Material, ReferenceError> {
        let document = &material.document;
        let wrong = |why: String| ReferenceError::Material { material: document.name.clone(), why };
        let shader = halfvector_codegen::material(document, Library::standard(), methods)
            .map_err(|error| wrong(error.to_string()))?;
        let module = naga::front::wgsl::parse_str(&shader.wgsl).map_err(|error| wrong(error.to_string()))?;
        let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), CAPABILITIES)
            .validate(&module)
            .map_err(|error| wrong(error.as_inner().to_string()))?;
        let program =
            Program::compile(&module, &info, Entry::Function("material")).map_err(|error| wrong(error.to_string()))?;

        let component = |part: Option<&str>| match part {
            None | Some("x") => Some(0),
            Some("y") => Some(1),
            Some("z") => Some(2),
            Some("w") => Some(3),
            Some(_) => None,
        };
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
        let place = |name: &str| {
            let mut path = name.split('.');
            let (member, component) = (path.next()?, component(path.next())?);
            let before = MEMBERS.iter().position(|(known, _)| *known == member)?;
            Some(MEMBERS[..before].iter().map(|(_, count)| count).sum::<usize>() + component)
        };
        let outputs: Vec<Option<usize>> = program.outputs().iter().map(|slot| place(&slot.name)).collect();

        let mut made = Material {
            frames: Frames::new(scene),
            inputs,
            outputs,
            buffers: Vec::new(),
            textures: Vec::new(),
            samplers: Vec::new(),
            // The text of comments may say so too: that costs time, no more.
            derives: ["dpdx", "dpdy", "fwidth"].iter().any(|name| shader.wgsl.contains(name)),
            looked_at: Default::default(),
            detail: Detail::default(),
            settings: document.surface,
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
        let moved = made.look_at_samples(&document.name)?;
        if moved {
            notes.push(format!("the reference leaves out `height` of the material `{}`", document.name));
        }
        Ok(made)
    }

    /// Evaluates some points: a brushed surface needs tangents. True where the surface is displaced, which the reference
    /// leaves out.
    fn look_at_samples(&mut self, name: &str) -> Result<bool, ReferenceError> {
        let points: Vec<Point> = (0..64)
            .map(|i| {
                let (u, v) = (f64::from(i % 8) / 8.0 + 0.03, f64::from(i / 8) / 8.0 + 0.05);
                let place = DVec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, 0.5);
                Point {
                    body: 0,
                    position: place,
                    object_position: place,
                    uv0: DVec2::new(u, v),
                    uv1: DVec2::new(u, v),
                    normal: DVec3::Z,
                    geometric_normal: DVec3::Z,
                    view_dir: DVec3::Z,
                    tangent: DVec3::X.extend(1.0),
                    color: DVec4::ONE,
                }
            })
            .collect();
        let mut evaluator = self.evaluator(name)?;
        evaluator.run(&points, None)?;
        let is_set = |member: &str| {
            let slot = self.program.outputs().iter().position(|slot| slot.name == member);
            let column = slot.map(|slot| &evaluator.results.columns[slot]);
            matches!(column, Some(OutputColumn::Float(numbers)) if numbers.iter().any(|x| *x != 0.0))
        };
        let (brushed, moved) = (is_set("anisotropy"), is_set("height"));
        self.detail.tangents |= brushed;
        Ok(moved)
    }

    /// The share of the points so far at which it gave no finite surface.
    pub(crate) fn share_not_finite(&self) -> f64 {
        let [all, not_finite] = [0, 1].map(|i| self.looked_at[i].load(Ordering::Relaxed) as f64);
        if not_finite > 0.0 { not_finite / all } else { 0.0 }
    }

    /// The machine that evaluates it: one for each thread.
    pub(crate) fn evaluator(&self, name: &str) -> Result<Evaluator<'_>, ReferenceError> {
        let wrong = |why: String| ReferenceError::Material { material: name.to_owned(), why };
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
        let machine = self.program.machine(Limits::default()).map_err(|error| wrong(error.to_string()))?;
        Ok(Evaluator {
            material: self,
            name: name.to_owned(),
            machine,
            resources,
            columns: Default::default(),
            results: Outputs::default(),
        })
    }
}

/// A material and the memory to run it.
pub(crate) struct Evaluator<'m> {
    material: &'m Material,
    name: String,
    machine: Machine<'m, f64>,
    resources: Resources<'m>,
    /// Inputs, and their changes along x and y.
    columns: [Vec<Vec<f64>>; 3],
    results: Outputs<f64>,
}

/// Points, and the same points one step along x and along y of the picture.
pub(crate) type Steps<'a> = [&'a [Point]; 2];

impl Evaluator<'_> {
    /// The surface at each point. `steps` are needed where the material [derives](Material::derives).
    pub(crate) fn surfaces(
        &mut self,
        points: &[Point],
        steps: Option<Steps<'_>>,
        surfaces: &mut Vec<Surface>,
    ) -> Result<(), ReferenceError> {
        surfaces.clear();
        if points.is_empty() {
            return Ok(());
        }
        self.run(points, steps)?;
        let columns: Vec<(usize, &[f64])> = self
            .results
            .columns
            .iter()
            .zip(&self.material.outputs)
            .filter_map(|(column, place)| match (column, place) {
                (OutputColumn::Float(numbers), Some(place)) => Some((*place, numbers.as_slice())),
                _ => None,
            })
            .collect();
        let mut numbers = [0.0; NUMBERS];
        let mut strange = 0;
        surfaces.extend((0..points.len()).map(|i| {
            for (place, column) in &columns {
                numbers[*place] = column[i];
            }
            strange += u64::from(!numbers.iter().all(|x| x.is_finite()));
            Surface::from_numbers(&numbers)
        }));
        let [all, not_finite] = &self.material.looked_at;
        all.fetch_add(points.len() as u64, Ordering::Relaxed);
        not_finite.fetch_add(strange, Ordering::Relaxed);
        Ok(())
    }

    fn run(&mut self, points: &[Point], steps: Option<Steps<'_>>) -> Result<(), ReferenceError> {
        let (inputs, frames) = (&self.material.inputs, &self.material.frames);
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
        let columns = |set: usize| -> Vec<Column<'_, f64>> {
            self.columns[set].iter().map(|column| Column::Float(column)).collect()
        };
        let (values, ddx, ddy) = (columns(0), columns(1), columns(2));
        let derivatives = if steps.is_some() { Derivatives::Given { ddx: &ddx, ddy: &ddy } } else { Derivatives::Zero };
        self.machine
            .run(&values, points.len(), &mut self.results, &self.resources, derivatives)
            .map_err(|error| ReferenceError::Material { material: self.name.clone(), why: error.to_string() })
    }
}
