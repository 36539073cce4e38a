//! The expressions of a stage as WGSL: calls become `let` lines with their node's label, everything else is written where
//! it is used. Notes what the stage reads.

use std::collections::BTreeSet;

use halfvector_graph::value::{Type, Wrap};

use crate::CodegenError;
use crate::emit::text::{Origin, Part, Text};
use crate::emit::tidy::without_identities;
use crate::emit::value;
use crate::ir::{Entry, Expr, Id, Program, Stage, Ty};
use crate::link::{Index, Instance};
use crate::names::{Namer, comment};
use crate::passes::lower::DISPLACED_POSITION;
use crate::reflection::{LightKind, SamplerSource};

/// Which function is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Entrance {
    /// `vs_main`
    Vertex,
    /// `fs_main`
    Fragment,
    /// `material`
    Material,
}

/// Members of the `View` struct, in its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ViewMember {
    ClipFromWorld,
    CameraPosition,
    Time,
    Exposure,
    EnvironmentRotation,
    EnvironmentLevels,
    IrradianceSh,
    ViewFromWorld,
}

/// Textures of the environment, in the order of their bindings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum EnvironmentTexture {
    PrefilteredRadiance,
    IrradianceOverPi,
    Dfg,
}

/// What one stage reads of the outside.
#[derive(Clone, Debug, Default)]
pub(crate) struct Uses {
    pub(crate) view: BTreeSet<ViewMember>,
    pub(crate) contexts: BTreeSet<&'static str>,
    pub(crate) inputs: BTreeSet<usize>,
    pub(crate) images: BTreeSet<usize>,
    pub(crate) environment: BTreeSet<EnvironmentTexture>,
    pub(crate) lights: bool,
    pub(crate) functions: BTreeSet<Instance>,
    /// Members of the varyings struct, or of the vertex inputs.
    pub(crate) members: BTreeSet<&'static str>,
    /// The normal matrix of the object.
    pub(crate) normal_matrix: bool,
    /// Transforms between spaces that nodes take.
    pub(crate) frames: BTreeSet<&'static str>,
}

/// Names of what both stages share: members of the parameters, textures and samplers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    pub(crate) inputs: Vec<String>,
    pub(crate) textures: Vec<String>,
    /// By picture: index into `samplers`.
    pub(crate) sampler_of: Vec<usize>,
    pub(crate) samplers: Vec<(String, SamplerSource)>,
}

impl Names {
    /// Names everything that a program could bind.
    pub(crate) fn of(program: &Program<'_>, parameters: &[&str], namer: &mut Namer<'_>, index: &Index) -> Names {
        let mut members = Namer::of_members(index);
        let mut names = Names { inputs: vec![String::new(); program.inputs.len()], ..Names::default() };
        // Exposed names first: they are promised to the outside.
        for (number, input) in program.inputs.iter().enumerate() {
            if let Some(name) = input.parameter.and_then(|p| parameters.get(p)) {
                names.inputs[number] = members.exact(name);
            }
        }
        for (number, input) in program.inputs.iter().enumerate() {
            if input.parameter.is_none() {
                let label = program.nodes[input.node].label;
                let wished = format!("{label} {}", input.socket.socket);
                names.inputs[number] = members.name(&wished, &format!("{} {}", input.socket.node, input.socket.socket));
            }
        }
        for image in &program.images {
            let node = &program.nodes[image.node];
            names.textures.push(namer.name(&format!("{} texture", node.label), &format!("{} texture", node.id)));
            let source = SamplerSource::Image {
                wrap_u: image.image.wrap_u,
                wrap_v: image.image.wrap_v,
                filter: image.image.filter,
            };
            let known = names.samplers.iter().position(|(_, s)| *s == source);
            names.sampler_of.push(known.unwrap_or(names.samplers.len()));
            if known.is_none() {
                let name = namer.name(&sampler_name(&source), "image_sampler");
                names.samplers.push((name, source));
            }
        }
        names
    }
}

fn sampler_name(source: &SamplerSource) -> String {
    let wrap = |wrap: &Wrap| match wrap {
        Wrap::Repeat => "repeat",
        Wrap::Clamp => "clamp",
        Wrap::Mirror => "mirror",
    };
    match source {
        SamplerSource::LinearClamp => "linear_clamp".into(),
        SamplerSource::Image { wrap_u, wrap_v, filter } => {
            let filter = match filter {
                halfvector_graph::value::Filter::Linear => "linear",
                halfvector_graph::value::Filter::Nearest => "nearest",
            };
            if wrap_u == wrap_v {
                format!("{filter}_{}", wrap(wrap_u))
            } else {
                format!("{filter}_{}_{}", wrap(wrap_u), wrap(wrap_v))
            }
        }
    }
}

/// Writes the expressions of one stage.
pub(crate) struct Writer<'w, 'a> {
    pub(crate) program: &'w Program<'a>,
    pub(crate) index: &'w Index,
    pub(crate) names: &'w Names,
    pub(crate) entrance: Entrance,
    /// Whether the surface is displaced: the fragment stage then has two positions.
    pub(crate) displaced: bool,
    pub(crate) uses: Uses,
    pub(crate) body: Text,
    atoms: Vec<String>,
    types: Vec<Ty>,
}

impl<'w, 'a> Writer<'w, 'a> {
    pub(crate) fn new(
        program: &'w Program<'a>,
        index: &'w Index,
        names: &'w Names,
        entrance: Entrance,
        displaced: bool,
    ) -> Self {
        // What belongs to no node is made of the surface's sockets.
        let part = match entrance {
            Entrance::Vertex => Part::Vertex,
            Entrance::Fragment => Part::Lobes,
            Entrance::Material => Part::Material,
        };
        let (uses, body, atoms, types) = (Uses::default(), Text::of(part), Vec::new(), Vec::new());
        Writer { program, index, names, entrance, displaced, uses, body, atoms, types }
    }

    /// Writes every expression of a stage; after it, [`Writer::atom`] gives their names.
    pub(crate) fn expressions(&mut self, stage: &Stage<'a>, namer: &mut Namer<'_>) -> Result<(), CodegenError> {
        for entry in &stage.arena.exprs {
            let text = self.text(entry)?;
            let atom = match &entry.expr {
                Expr::Call { .. } => self.line(entry, &text, namer),
                Expr::Builtin { name, .. } if !name.starts_with("dpd") => self.line(entry, &text, namer),
                _ => text,
            };
            self.atoms.push(atom);
            self.types.push(entry.ty);
        }
        Ok(())
    }

    /// What stands for an expression where it is used.
    pub(crate) fn atom(&self, id: Id) -> &str {
        &self.atoms[id.index()]
    }

    fn line(&mut self, entry: &Entry<'a>, text: &str, namer: &mut Namer<'_>) -> String {
        let info = entry.node.map(|node| &self.program.nodes[node]);
        let name = match info {
            Some(info) if entry.hint.is_empty() => namer.name(info.label, info.id),
            Some(info) => namer.name(&format!("{} {}", info.label, entry.hint), &format!("{} {}", info.id, entry.hint)),
            None => namer.name(entry.hint, "value"),
        };
        let (origin, beside) = match info {
            Some(info) => (Origin::Node(info.id.clone()), format!(" // {}", comment(info.label))),
            None => (Origin::Frame(self.body.part), String::new()),
        };
        let line = without_identities(&format!("let {name} = {text};"));
        self.body.push(origin.clone(), &format!("    {line}{}", beside.trim_end()));
        self.body.push(origin, "\n");
        name
    }

    fn text(&mut self, entry: &Entry<'a>) -> Result<String, CodegenError> {
        Ok(match &entry.expr {
            Expr::Literal(literal) => value::literal(literal),
            Expr::Input(input) => {
                self.uses.inputs.insert(*input);
                let name = &self.names.inputs[*input];
                match entry.ty {
                    Ty::Value(Type::Bool) => format!("(parameters.{name} != 0)"),
                    _ => format!("parameters.{name}"),
                }
            }
            Expr::Context(name) => self.context(name),
            Expr::Frame(name) => self.frame(name),
            Expr::Texture(image) => {
                self.uses.images.insert(*image);
                self.names.textures[*image].clone()
            }
            Expr::Sampler(image) => {
                self.uses.images.insert(*image);
                self.names.samplers[self.names.sampler_of[*image]].0.clone()
            }
            Expr::Field { of, name } => format!("{}.{name}", self.atom(*of)),
            Expr::Convert { of } => {
                let (from, atom) = (self.types[of.index()], self.atom(*of));
                match entry.ty {
                    // WGSL spreads only what has the vector's component type.
                    Ty::Value(ty) if ty != Type::F32 && from == Ty::Value(Type::I32) => {
                        format!("{}(f32({atom}))", ty.wgsl())
                    }
                    Ty::Value(ty) => format!("{}({atom})", ty.wgsl()),
                    _ => atom.to_owned(),
                }
            }
            Expr::Builtin { name: name @ ("*" | "/" | "+" | "-"), arguments } => {
                arguments.iter().map(|id| self.atom(*id)).collect::<Vec<_>>().join(&format!(" {name} "))
            }
            Expr::Builtin { name, arguments } => {
                format!("{name}({})", arguments.iter().map(|id| self.atom(*id)).collect::<Vec<_>>().join(", "))
            }
            Expr::Call { function, generic, arguments } => {
                let instance = self.instance(function, *generic)?;
                let arguments: Vec<String> = arguments.iter().map(|id| self.atom(*id).to_owned()).collect();
                match self.index.inlined(instance, &arguments) {
                    Some(inlined) => inlined,
                    None => {
                        self.uses.functions.insert(instance);
                        format!("{}({})", self.index.name(instance), arguments.join(", "))
                    }
                }
            }
        })
    }

    fn instance(&self, function: &str, generic: Option<Type>) -> Result<Instance, CodegenError> {
        self.index
            .instance(function, generic)
            .ok_or_else(|| CodegenError::Library(format!("there is no function `{function}` in the shader library")))
    }

    /// Marks a library function or struct as used and gives its name.
    pub(crate) fn library(&mut self, name: &'static str) -> Result<&'static str, CodegenError> {
        let instance = self.instance(name, None)?;
        self.uses.functions.insert(instance);
        Ok(name)
    }

    /// Marks a member of the view as used and gives its text.
    pub(crate) fn view(&mut self, member: ViewMember) -> &'static str {
        self.uses.view.insert(member);
        match member {
            ViewMember::ClipFromWorld => "view.clip_from_world",
            ViewMember::CameraPosition => "view.camera_position",
            ViewMember::Time => "view.time",
            ViewMember::Exposure => "view.exposure",
            ViewMember::EnvironmentRotation => "view.environment_rotation",
            ViewMember::EnvironmentLevels => "view.environment_levels",
            ViewMember::IrradianceSh => "view.irradiance_sh",
            ViewMember::ViewFromWorld => "view.view_from_world",
        }
    }

    /// Marks a texture of the environment as used and gives it with its sampler.
    pub(crate) fn environment(&mut self, texture: EnvironmentTexture) -> &'static str {
        self.uses.environment.insert(texture);
        match texture {
            EnvironmentTexture::PrefilteredRadiance => "prefiltered_radiance, linear_clamp",
            EnvironmentTexture::IrradianceOverPi => "irradiance_over_pi, linear_clamp",
            EnvironmentTexture::Dfg => "dfg_table, linear_clamp",
        }
    }

    /// Marks a vertex input or varying as used and gives its text.
    pub(crate) fn member(&mut self, name: &'static str) -> String {
        self.uses.members.insert(name);
        format!("in.{name}")
    }

    /// The text of a transform between spaces.
    fn frame(&mut self, name: &'static str) -> String {
        self.uses.frames.insert(name);
        match (self.entrance, name) {
            (Entrance::Material, _) => {
                self.uses.contexts.insert(name);
                format!("context.{name}")
            }
            (_, "view_from_world") => self.view(ViewMember::ViewFromWorld).to_owned(),
            _ => format!("object.{name}"),
        }
    }

    /// The text of a context, and what it needs noted.
    pub(crate) fn context(&mut self, name: &'static str) -> String {
        self.uses.contexts.insert(name);
        match (self.entrance, name) {
            (Entrance::Material, _) => format!("context.{name}"),
            (_, "time") => self.view(ViewMember::Time).to_owned(),
            (Entrance::Vertex, "object_position") => self.member("position"),
            (_, "uv0") => self.member("uv0"),
            (_, "uv1") => self.member("uv1"),
            (Entrance::Vertex, "vertex_color") => self.member("color"),
            (Entrance::Fragment, "vertex_color") => self.member("vertex_color"),
            (Entrance::Fragment, "object_position") => self.member("object_position"),
            // Nodes see the surface where it was before displacement, so that a pattern does not swim on it.
            (Entrance::Fragment, "world_position") if self.displaced => self.member("surface_position"),
            (Entrance::Fragment, "world_position" | DISPLACED_POSITION) => self.member("world_position"),
            (Entrance::Fragment, "world_tangent") => self.member("world_tangent"),
            // Locals that the entry point declares when they are used.
            _ => name.to_owned(),
        }
    }
}

/// The text of a light, or of the array of lights, of a kind.
pub(crate) fn lights_member(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Directional => "directional",
        LightKind::Point => "point",
        LightKind::Spot => "spot",
    }
}
