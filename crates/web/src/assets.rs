//! A scene as the data that the page's script draws: bytes for each binding by the shaders' reflection, in the order that
//! other renderers draw in.

use std::collections::BTreeSet;

use halfvector_codegen::reflection::{
    Binding, Resource, ShaderParameter, TextureSource, UniformBlock, UniformSource, UniformType,
};
use halfvector_codegen::uniforms::{FrameValues, ObjectValues, fill_input};
use halfvector_codegen::{Fold, Shader, shader};
use halfvector_graph::library::Library;
use halfvector_graph::needs::ShaderOutput;
use halfvector_graph::value::{ColorSpace, Type};
use halfvector_ibl::BakedEnvironment;
use halfvector_scene::light::lights_by_kind;
use halfvector_scene::{Background, Mesh, Object, Scene, SceneMaterial, Side, View, dfg_visibility, needs, passes};
use serde_json::{Map, Value, json};

use crate::textures::{blob, dfg, image, irradiance, radiance, sampler, vertex_format};
use crate::{MAX_TEXELS, WebError};

/// What is to become data, and the textures found on the way, each once.
struct Gatherer<'a> {
    scene: &'a Scene,
    environment: Option<&'a BakedEnvironment>,
    frame: FrameValues,
    textures: Vec<(Found, Value)>,
}

/// A texture of the page.
#[derive(Clone, PartialEq)]
enum Found {
    /// Of the scene's images, read so.
    Image(usize, ColorSpace),
    /// The environment or a table.
    Shared(TextureSource),
}

/// All data of a scene.
pub(crate) fn scene(scene: &Scene, environment: Option<&BakedEnvironment>) -> Result<Value, WebError> {
    // The page makes a view of its own; the order in which passes stand is another for none.
    let view = View::new(&scene.camera, scene.camera.near(scene.bounds()), 1.0);
    let passes = passes(scene, &view)?;
    let used: BTreeSet<usize> = scene.objects.iter().map(|object| object.material).collect();
    let mut gatherer = Gatherer { scene, environment, frame: frame(scene, environment), textures: Vec::new() };
    let mut shaders = Vec::new();
    for material in &scene.materials {
        let failed = |source| WebError::Shader { material: material.document.name.clone(), source };
        let needs = needs(scene, ShaderOutput::Radiance);
        shaders.push(shader(&material.document, Library::standard(), &needs, Fold::Export).map_err(failed)?);
    }
    let mut materials = Vec::new();
    for (index, (material, shader)) in scene.materials.iter().zip(&shaders).enumerate() {
        materials.push(if used.contains(&index) { gatherer.material(material, shader)? } else { Value::Null });
    }
    let objects =
        scene.objects.iter().map(|it| object(scene, it, &shaders[it.material])).collect::<Result<Vec<_>, _>>()?;
    let meshes = scene.meshes.iter().enumerate().map(|(index, mesh)| {
        let wearers = scene.objects.iter().filter(|object| object.mesh == index);
        let inputs = wearers.flat_map(|object| &shaders[object.material].reflection.vertex_inputs);
        self::mesh(mesh, &inputs.map(|input| input.name.as_str()).collect())
    });
    let meshes: Vec<Value> = meshes.collect();
    let passes = passes.solid.iter().chain(&passes.blended).map(|(object, pass)| {
        let cull = match pass.cull {
            None => "none",
            Some(Side::Front) => "front",
            Some(Side::Back) => "back",
        };
        json!({ "object": object, "mirrored": pass.mirrored, "cull": cull, "blend": pass.blend })
    });
    let passes: Vec<Value> = passes.collect();
    let sky = gatherer.sky()?;
    let coded = u32::from(scene.methods.is("encode", "report"));
    let clear = match scene.background {
        Background::Color([r, g, b]) => [r, g, b, 1.0],
        Background::Environment | Background::None => [0.0; 4],
    };
    let members =
        shaders.iter().flat_map(|shader| &shader.reflection.bindings).filter_map(|binding| match &binding.resource {
            Resource::Uniform(block) => Some(&block.members),
            _ => None,
        });
    let moves = members.flatten().any(|member| member.source == UniformSource::Time);
    let camera = &scene.camera;
    Ok(json!({
        "camera": {
            "position": camera.position.to_array(),
            "target": camera.target.to_array(),
            "up": camera.up.to_array(),
            "fov": camera.vertical_fov,
        },
        "corners": scene.bounds().map_or_else(Vec::new, |bounds| bounds.corners().map(|c| c.to_array()).to_vec()),
        "clear": clear,
        "time": 0,
        "moves": moves,
        "display": {
            "wgsl": halfvector_shaders::display(scene.tone_map.name()),
            "exposure": scene.exposure.factor(),
            "coded": coded,
        },
        "sky": sky,
        "materials": materials,
        "objects": objects,
        "passes": passes,
        "meshes": meshes,
        "textures": gatherer.textures.into_iter().map(|(_, value)| value).collect::<Vec<_>>(),
    }))
}

/// What a frame knows before there is a view.
fn frame(scene: &Scene, environment: Option<&BakedEnvironment>) -> FrameValues {
    let (sin, cos) = scene.environment_rotation.to_radians().sin_cos();
    FrameValues {
        clip_from_world: glam::Mat4::IDENTITY.to_cols_array(),
        view_from_world: glam::Mat4::IDENTITY.to_cols_array(),
        camera_position: scene.camera.position.to_array(),
        time: 0.0,
        exposure: scene.exposure.factor(),
        environment_rotation: [cos, sin],
        environment_levels: environment.map_or(0, |baked| baked.radiance.len() as u32),
        irradiance_sh: environment.map_or([[0.0; 3]; 9], |baked| baked.irradiance_sh),
        lights: lights_by_kind(&scene.lights).numbers(),
    }
}

impl Gatherer<'_> {
    /// The number of a texture, which is made when it is asked for first.
    fn texture(&mut self, found: Found, make: impl FnOnce() -> Value) -> usize {
        if let Some(known) = self.textures.iter().position(|(known, _)| *known == found) {
            return known;
        }
        self.textures.push((found, make()));
        self.textures.len() - 1
    }

    /// What a material's shader reads, and the shader.
    fn material(&mut self, material: &SceneMaterial, shader: &Shader) -> Result<Value, WebError> {
        let reflection = &shader.reflection;
        let mut groups = vec![Vec::new(); 3];
        for binding in &reflection.bindings {
            let value = self.binding(material, binding, &reflection.parameters)?;
            groups[binding.group as usize].push(value);
        }
        let inputs = reflection.vertex_inputs.iter().map(|input| {
            let (format, stride) = vertex_format(input.ty);
            json!({ "name": input.name, "location": input.location, "format": format, "stride": stride })
        });
        let parameters = reflection.parameters.iter().map(|parameter| {
            json!({
                "name": parameter.name,
                "label": parameter.label,
                "value": parameter.default,
                "range": parameter.range,
                "integer": matches!(parameter.ty, Type::Bool | Type::I32),
            })
        });
        Ok(json!({
            "wgsl": shader.wgsl,
            "vertexInputs": inputs.collect::<Vec<_>>(),
            "parameters": parameters.collect::<Vec<_>>(),
            "groups": groups,
        }))
    }

    fn binding(
        &mut self,
        material: &SceneMaterial,
        binding: &Binding,
        parameters: &[ShaderParameter],
    ) -> Result<Value, WebError> {
        let mut value = Map::new();
        value.insert("name".into(), json!(binding.name));
        value.insert("binding".into(), json!(binding.binding));
        value.insert("vertex".into(), json!(binding.vertex));
        value.insert("fragment".into(), json!(binding.fragment));
        match &binding.resource {
            Resource::Uniform(block) => {
                value.insert("kind".into(), json!("uniform"));
                value.insert("members".into(), members(block, parameters));
                if binding.group < 2 {
                    let document = &material.document;
                    let bytes = block.pack(|source, numbers| {
                        self.frame.fill(source, numbers);
                        fill_input(document, Library::standard(), block, source, numbers);
                    })?;
                    value.insert("blob".into(), blob(&bytes));
                }
            }
            Resource::Texture(source) => {
                value.insert("kind".into(), json!("texture"));
                let (view, texture) = self.texture_of(material, source)?;
                value.insert("view".into(), json!(view));
                value.insert("texture".into(), json!(texture));
            }
            Resource::Sampler(source) => {
                value.insert("kind".into(), json!("sampler"));
                value.insert("sampler".into(), sampler(source));
            }
        }
        Ok(Value::Object(value))
    }

    /// How a texture is viewed, and its number.
    fn texture_of(
        &mut self,
        material: &SceneMaterial,
        source: &TextureSource,
    ) -> Result<(&'static str, usize), WebError> {
        let shared = Found::Shared(source.clone());
        let (scene, environment) = (self.scene, self.environment);
        let baked = || environment.ok_or(WebError::NoEnvironment);
        Ok(match source {
            TextureSource::PrefilteredRadiance => {
                let baked = baked()?;
                ("cube", self.texture(shared, || radiance(baked)))
            }
            TextureSource::IrradianceOverPi => {
                let baked = baked()?;
                ("cube", self.texture(shared, || irradiance(baked)))
            }
            TextureSource::Dfg => ("2d", self.texture(shared, || dfg(dfg_visibility(&scene.methods)))),
            TextureSource::Image(reference) => {
                let missing = || WebError::MissingImage {
                    material: material.document.name.clone(),
                    file: reference.file.clone(),
                };
                let index = scene.images.index(&material.directory, reference).ok_or_else(missing)?;
                let picture = scene.images.images().get(index).ok_or_else(missing)?;
                let (width, height) = (picture.width(), picture.height());
                if width > MAX_TEXELS || height > MAX_TEXELS {
                    return Err(WebError::ImageTooLarge { file: reference.file.clone(), width, height });
                }
                let found = Found::Image(index, reference.color_space);
                ("2d", self.texture(found, || image(picture, reference.color_space)))
            }
        })
    }

    /// The environment behind the objects.
    fn sky(&mut self) -> Result<Value, WebError> {
        let (Background::Environment, Some(baked)) = (self.scene.background, self.environment) else {
            return Ok(Value::Null);
        };
        let shown = Found::Shared(TextureSource::PrefilteredRadiance);
        let texture = self.texture(shown, || radiance(baked));
        Ok(json!({
            "wgsl": halfvector_shaders::background(),
            "radiance": texture,
            "sampler": sampler(&halfvector_codegen::reflection::SamplerSource::LinearClamp),
            "rotation": self.frame.environment_rotation,
        }))
    }
}

/// The members that the script fills while it draws.
fn members(block: &UniformBlock, parameters: &[ShaderParameter]) -> Value {
    let filled = block.members.iter().filter_map(|member| {
        let source = match member.source {
            UniformSource::ClipFromWorld => "clip_from_world".to_owned(),
            UniformSource::CameraPosition => "camera_position".to_owned(),
            UniformSource::ViewFromWorld => "view_from_world".to_owned(),
            UniformSource::Time => "time".to_owned(),
            UniformSource::Input(_) if parameters.iter().any(|parameter| parameter.name == member.name) => {
                format!("parameter:{}", member.name)
            }
            _ => return None,
        };
        let integer = matches!(member.ty, UniformType::Value(Type::Bool | Type::I32));
        Some(json!({ "source": source, "offset": member.offset, "integer": integer }))
    });
    filled.collect()
}

/// Where an object stands, and the uniforms that are its own.
fn object(scene: &Scene, object: &Object, shader: &Shader) -> Result<Value, WebError> {
    let values = ObjectValues {
        world_from_object: object.world_from_object.to_cols_array(),
        object_from_world: object.object_from_world().to_cols_array(),
        normal_from_object: object.normal_from_object().to_cols_array(),
    };
    let mut uniforms = Map::new();
    for binding in shader.reflection.bindings.iter().filter(|binding| binding.group == 2) {
        if let Resource::Uniform(block) = &binding.resource {
            let bytes = block.pack(|source, numbers| values.fill(source, numbers))?;
            uniforms.insert(binding.name.clone(), blob(&bytes));
        }
    }
    let middle = scene.meshes[object.mesh].bounds().map_or(glam::Vec3::ZERO, |bounds| bounds.center());
    Ok(json!({
        "mesh": object.mesh,
        "material": object.material,
        "uniforms": uniforms,
        "middle": object.world_from_object.transform_point3(middle).to_array(),
    }))
}

/// A mesh with the attributes that shaders read.
fn mesh(mesh: &Mesh, wanted: &BTreeSet<&str>) -> Value {
    let all: [(&str, &[u8]); 6] = [
        ("position", bytemuck::cast_slice(&mesh.positions)),
        ("normal", bytemuck::cast_slice(&mesh.normals)),
        ("tangent", bytemuck::cast_slice(&mesh.tangents)),
        ("uv0", bytemuck::cast_slice(&mesh.uv0)),
        ("uv1", bytemuck::cast_slice(&mesh.uv1)),
        ("color", bytemuck::cast_slice(&mesh.colors)),
    ];
    let attributes: Map<String, Value> = all
        .iter()
        .filter(|(name, _)| wanted.contains(name))
        .map(|(name, bytes)| ((*name).to_owned(), blob(bytes)))
        .collect();
    let indices = blob(bytemuck::cast_slice(&mesh.indices));
    json!({ "attributes": attributes, "indices": indices, "count": mesh.indices.len() })
}
