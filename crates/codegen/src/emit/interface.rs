//! What a shader reads of the outside, as WGSL declarations and as reflection, from the same lists.

use halfvector_graph::document::Document;
use halfvector_graph::value::Type;

use crate::emit::expression::{EnvironmentTexture, Names, Uses, ViewMember, lights_member};
use crate::emit::text::{Origin, Text};
use crate::emit::vertex::VARYINGS;
use crate::ir::{Input, Program};
use crate::passes::plan::Plan;
use crate::reflection::{
    Binding, Reflection, Resource, SamplerSource, ShaderParameter, TextureSource, UniformBlock, UniformSource,
    UniformType, VertexInput,
};

/// Vertex attributes at their locations, which are the same in every shader.
const ATTRIBUTES: [(&str, Type); 6] = [
    ("position", Type::Vec3),
    ("normal", Type::Vec3),
    ("tangent", Type::Vec4),
    ("uv0", Type::Vec2),
    ("uv1", Type::Vec2),
    ("color", Type::Vec4),
];

/// What both stages read.
pub(crate) struct Interface<'p, 'a> {
    pub(crate) program: &'p Program<'a>,
    pub(crate) document: &'p Document,
    pub(crate) names: &'p Names,
    pub(crate) vertex: &'p Uses,
    pub(crate) fragment: &'p Uses,
}

impl Interface<'_, '_> {
    /// The reflection of a whole shader.
    pub(crate) fn reflection(&self, plan: &Plan) -> Reflection {
        let mut bindings = Vec::new();
        self.view(&mut bindings);
        self.lights(plan, &mut bindings);
        self.environment(&mut bindings);
        self.material(&mut bindings);
        self.object(&mut bindings);
        Reflection {
            vertex_inputs: self.vertex_inputs(),
            bindings,
            parameters: self.parameters(),
            alpha_mode: plan.alpha_mode,
            double_sided: plan.double_sided,
        }
    }

    /// The reflection of the material alone.
    pub(crate) fn material_reflection(&self) -> Reflection {
        let mut bindings = Vec::new();
        self.view(&mut bindings);
        self.material(&mut bindings);
        Reflection { bindings, parameters: self.parameters(), ..Reflection::default() }
    }

    fn vertex_inputs(&self) -> Vec<VertexInput> {
        let located = ATTRIBUTES.iter().enumerate().filter(|(_, (name, _))| self.vertex.members.contains(name));
        located
            .map(|(location, (name, ty))| VertexInput { name: (*name).into(), location: location as u32, ty: *ty })
            .collect()
    }

    fn view(&self, bindings: &mut Vec<Binding>) {
        let used: Vec<ViewMember> = self.vertex.view.union(&self.fragment.view).copied().collect();
        if used.is_empty() {
            return;
        }
        let members = used
            .into_iter()
            .map(|member| {
                let (name, ty, source) = match member {
                    ViewMember::ClipFromWorld => ("clip_from_world", UniformType::Mat4, UniformSource::ClipFromWorld),
                    ViewMember::CameraPosition => {
                        ("camera_position", UniformType::Value(Type::Vec3), UniformSource::CameraPosition)
                    }
                    ViewMember::Time => ("time", UniformType::Value(Type::F32), UniformSource::Time),
                    ViewMember::Exposure => ("exposure", UniformType::Value(Type::F32), UniformSource::Exposure),
                    ViewMember::EnvironmentRotation => {
                        ("environment_rotation", UniformType::Value(Type::Vec2), UniformSource::EnvironmentRotation)
                    }
                    ViewMember::EnvironmentLevels => {
                        ("environment_levels", UniformType::Value(Type::F32), UniformSource::EnvironmentLevels)
                    }
                    ViewMember::IrradianceSh => ("irradiance_sh", UniformType::Sh9, UniformSource::IrradianceSh),
                    ViewMember::ViewFromWorld => ("view_from_world", UniformType::Mat4, UniformSource::ViewFromWorld),
                };
                (name.to_owned(), ty, source)
            })
            .collect();
        bindings.push(Binding {
            group: 0,
            binding: 0,
            name: "view".into(),
            vertex: !self.vertex.view.is_empty(),
            fragment: !self.fragment.view.is_empty(),
            resource: Resource::Uniform(block("View", members)),
        });
    }

    fn lights(&self, plan: &Plan, bindings: &mut Vec<Binding>) {
        if !self.fragment.lights {
            return;
        }
        let members = plan
            .lights
            .iter()
            .map(|&(kind, count)| {
                (lights_member(kind).to_owned(), UniformType::Lights(kind, count), UniformSource::Lights(kind))
            })
            .collect();
        let block = UniformBlock::new("Lights", members);
        bindings.push(fragment_binding(0, 1, "lights", Resource::Uniform(block)));
    }

    fn environment(&self, bindings: &mut Vec<Binding>) {
        for texture in &self.fragment.environment {
            let (binding, name, source) = match texture {
                EnvironmentTexture::PrefilteredRadiance => {
                    (2, "prefiltered_radiance", TextureSource::PrefilteredRadiance)
                }
                EnvironmentTexture::IrradianceOverPi => (3, "irradiance_over_pi", TextureSource::IrradianceOverPi),
                EnvironmentTexture::Dfg => (4, "dfg_table", TextureSource::Dfg),
            };
            bindings.push(fragment_binding(0, binding, name, Resource::Texture(source)));
        }
        if !self.fragment.environment.is_empty() {
            let sampler = Resource::Sampler(SamplerSource::LinearClamp);
            bindings.push(fragment_binding(0, 5, "linear_clamp", sampler));
        }
    }

    fn material(&self, bindings: &mut Vec<Binding>) {
        let mut next = 0;
        let mut push = |name: &str, vertex: bool, fragment: bool, resource: Resource| {
            bindings.push(Binding { group: 1, binding: next, name: name.into(), vertex, fragment, resource });
            next += 1;
        };
        if let Some(block) = self.parameter_block() {
            let (vertex, fragment) = (!self.vertex.inputs.is_empty(), !self.fragment.inputs.is_empty());
            push("parameters", vertex, fragment, Resource::Uniform(block));
        }
        let (in_vertex, in_fragment) = (&self.vertex.images, &self.fragment.images);
        for image in in_vertex.union(in_fragment) {
            let source = TextureSource::Image(self.program.images[*image].image.clone());
            let (vertex, fragment) = (in_vertex.contains(image), in_fragment.contains(image));
            push(&self.names.textures[*image], vertex, fragment, Resource::Texture(source));
        }
        for (number, (name, source)) in self.names.samplers.iter().enumerate() {
            let with = |images: &std::collections::BTreeSet<usize>| {
                images.iter().any(|image| self.names.sampler_of[*image] == number)
            };
            let (vertex, fragment) = (with(in_vertex), with(in_fragment));
            if vertex || fragment {
                push(name, vertex, fragment, Resource::Sampler(source.clone()));
            }
        }
    }

    fn object(&self, bindings: &mut Vec<Binding>) {
        let mut members = vec![("world_from_object".into(), UniformType::Mat4, UniformSource::WorldFromObject)];
        if self.vertex.normal_matrix {
            members.push(("normal_from_object".into(), UniformType::Mat3, UniformSource::NormalFromObject));
        }
        let (vertex, fragment) = (&self.vertex.frames, &self.fragment.frames);
        if vertex.contains("object_from_world") || fragment.contains("object_from_world") {
            members.push(("object_from_world".into(), UniformType::Mat4, UniformSource::ObjectFromWorld));
        }
        bindings.push(Binding {
            group: 2,
            binding: 0,
            name: "object".into(),
            vertex: true,
            fragment: fragment.iter().any(|frame| *frame != "view_from_world"),
            resource: Resource::Uniform(UniformBlock::new("Object", members)),
        });
    }

    fn used_inputs(&self) -> Vec<usize> {
        let mut used: Vec<usize> = self.vertex.inputs.union(&self.fragment.inputs).copied().collect();
        // Exposed ones first, in the document's order; then the others as they were met.
        used.sort_by_key(|input| (self.program.inputs[*input].parameter.unwrap_or(usize::MAX), *input));
        used
    }

    fn parameter_block(&self) -> Option<UniformBlock> {
        let members: Vec<_> = self
            .used_inputs()
            .into_iter()
            .map(|number| {
                let input = &self.program.inputs[number];
                let source = UniformSource::Input(input.socket.clone());
                (self.names.inputs[number].clone(), UniformType::Value(input.ty), source)
            })
            .collect();
        (!members.is_empty()).then(|| block("Parameters", members))
    }

    fn parameters(&self) -> Vec<ShaderParameter> {
        let exposed = self.used_inputs().into_iter().filter_map(|number| {
            let input = &self.program.inputs[number];
            let parameter = self.document.parameters.get(input.parameter?)?;
            Some(ShaderParameter {
                name: self.names.inputs[number].clone(),
                label: parameter.label.clone().unwrap_or_else(|| parameter.name.clone()),
                ty: input.ty,
                default: input.value.clone(),
                range: parameter.range.or_else(|| self.soft_range(input)),
            })
        });
        exposed.collect()
    }

    fn soft_range(&self, input: &Input) -> Option<[f32; 2]> {
        let def = self.program.nodes[input.node].def;
        def.inputs.iter().find(|i| i.name == input.socket.socket)?.range
    }
}

/// A block whose members begin with those of the greatest alignment, else in the order given: then HLSL, which aligns no
/// vector that fits the rest of its 16 bytes, lays them out at the same places, and nothing is padded.
fn block(struct_name: &str, mut members: Vec<(String, UniformType, UniformSource)>) -> UniformBlock {
    members.sort_by_key(|(_, ty, _)| std::cmp::Reverse(ty.align()));
    UniformBlock::new(struct_name, members)
}

fn fragment_binding(group: u32, binding: u32, name: &str, resource: Resource) -> Binding {
    Binding { group, binding, name: name.into(), vertex: false, fragment: true, resource }
}

/// The declarations of bindings: struct and variable of each uniform, textures, samplers.
pub(crate) fn declarations(reflection: &Reflection, text: &mut Text) {
    for binding in &reflection.bindings {
        let place = format!("@group({}) @binding({})", binding.group, binding.binding);
        match &binding.resource {
            Resource::Uniform(block) => {
                text.line(&format!("struct {} {{", block.struct_name));
                for member in &block.members {
                    let line = format!("    {}: {},", member.name, member.ty.wgsl());
                    match &member.source {
                        UniformSource::Input(socket) => {
                            text.push(Origin::Node(socket.node.clone()), &format!("{line}\n"));
                        }
                        _ => text.line(&line),
                    }
                }
                text.line("}");
                text.line(&format!("{place} var<uniform> {}: {};", binding.name, block.struct_name));
            }
            Resource::Texture(source) => {
                let ty = match source {
                    TextureSource::PrefilteredRadiance | TextureSource::IrradianceOverPi => "texture_cube<f32>",
                    TextureSource::Image(_) | TextureSource::Dfg => "texture_2d<f32>",
                };
                text.line(&format!("{place} var {}: {ty};", binding.name));
            }
            Resource::Sampler(_) => text.line(&format!("{place} var {}: sampler;", binding.name)),
        }
    }
}

/// The structs between vertex buffers, vertex stage and fragment stage.
pub(crate) fn stage_structs(reflection: &Reflection, fragment: &Uses, text: &mut Text) {
    text.line("struct VertexInput {");
    for input in &reflection.vertex_inputs {
        text.line(&format!("    @location({}) {}: {},", input.location, input.name, input.ty.wgsl()));
    }
    text.line("}");
    text.line("struct Varyings {");
    text.line("    @builtin(position) clip_position: vec4f,");
    for (location, (name, ty)) in VARYINGS.iter().filter(|(name, _)| fragment.members.contains(name)).enumerate() {
        text.line(&format!("    @location({location}) {name}: {ty},"));
    }
    text.line("}");
}
