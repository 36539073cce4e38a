//! What the shaders of a scene read, by reflection alone: bytes of uniform blocks, textures, samplers.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use halfvector_codegen::Shader;
use halfvector_codegen::reflection::{Resource, TextureSource};
use halfvector_codegen::uniforms::{FrameValues, ObjectValues, fill_input};
use halfvector_graph::library::Library;
use halfvector_graph::value::ColorSpace;
use halfvector_ibl::{BakedEnvironment, Visibility, dfg_table_of_shaders};
use halfvector_interp::{Resources, Texture};
use halfvector_scene::{Object, Scene, SceneMaterial};

use crate::error::RasterError;
use crate::texture;

/// The textures of a scene, made as far as they are read.
#[derive(Debug)]
pub(crate) struct Textures<'e> {
    environment: Option<&'e BakedEnvironment>,
    visibility: Visibility,
    /// By number in the scene's store and coding.
    images: HashMap<(usize, ColorSpace), Texture>,
    radiance: Option<Texture>,
    irradiance: Option<Texture>,
    dfg: Option<Texture>,
}

impl<'e> Textures<'e> {
    /// None yet. The table of albedos will be made for `visibility`.
    pub(crate) fn new(environment: Option<&'e BakedEnvironment>, visibility: Visibility) -> Self {
        Textures { environment, visibility, images: HashMap::new(), radiance: None, irradiance: None, dfg: None }
    }

    /// Makes what a material's shader reads.
    pub(crate) fn prepare(
        &mut self,
        scene: &Scene,
        material: &SceneMaterial,
        shader: &Shader,
    ) -> Result<(), RasterError> {
        for binding in &shader.reflection.bindings {
            match &binding.resource {
                Resource::Texture(TextureSource::Image(reference)) => {
                    let missing = || RasterError::MissingImage {
                        material: material.document.name.clone(),
                        file: reference.file.clone(),
                    };
                    let index = scene.images.index(&material.directory, reference).ok_or_else(missing)?;
                    let key = (index, reference.color_space);
                    if let Entry::Vacant(place) = self.images.entry(key) {
                        let image = scene.images.images().get(index).ok_or_else(missing)?;
                        place.insert(texture::image(image, reference.color_space).ok_or_else(missing)?);
                    }
                }
                Resource::Texture(TextureSource::PrefilteredRadiance) => self.prepare_radiance()?,
                Resource::Texture(TextureSource::IrradianceOverPi) if self.irradiance.is_none() => {
                    let baked = self.environment.ok_or(RasterError::NoEnvironment)?;
                    self.irradiance = texture::cube(std::slice::from_ref(&baked.irradiance_over_pi), &[]);
                }
                Resource::Texture(TextureSource::Dfg) if self.dfg.is_none() => {
                    self.dfg = texture::dfg(dfg_table_of_shaders(self.visibility));
                }
                Resource::Texture(_) | Resource::Uniform(_) | Resource::Sampler(_) => {}
            }
        }
        Ok(())
    }

    /// Makes the prefiltered radiance; its level 0 is the environment itself.
    pub(crate) fn prepare_radiance(&mut self) -> Result<(), RasterError> {
        if self.radiance.is_none() {
            let baked = self.environment.ok_or(RasterError::NoEnvironment)?;
            self.radiance = texture::cube(&baked.radiance, &baked.slope);
        }
        Ok(())
    }

    /// The prefiltered radiance, when it was made.
    pub(crate) fn radiance(&self) -> Option<&Texture> {
        self.radiance.as_ref()
    }

    fn texture(&self, scene: &Scene, material: &SceneMaterial, source: &TextureSource) -> Option<&Texture> {
        match source {
            TextureSource::Image(reference) => {
                let index = scene.images.index(&material.directory, reference)?;
                self.images.get(&(index, reference.color_space))
            }
            TextureSource::PrefilteredRadiance => self.radiance.as_ref(),
            TextureSource::IrradianceOverPi => self.irradiance.as_ref(),
            TextureSource::Dfg => self.dfg.as_ref(),
        }
    }
}

/// The bytes of one shader's uniform blocks for one object, by group and binding.
#[derive(Debug)]
pub(crate) struct Blocks(Vec<((u32, u32), Vec<u8>)>);

impl Blocks {
    /// Packs them.
    pub(crate) fn pack(
        shader: &Shader,
        material: &SceneMaterial,
        object: &Object,
        frame: &FrameValues,
    ) -> Result<Blocks, RasterError> {
        let object = ObjectValues {
            world_from_object: object.world_from_object.to_cols_array(),
            object_from_world: object.object_from_world().to_cols_array(),
            normal_from_object: object.normal_from_object().to_cols_array(),
        };
        let document = &material.document;
        let mut blocks = Vec::new();
        for binding in &shader.reflection.bindings {
            let Resource::Uniform(block) = &binding.resource else { continue };
            let bytes = block.pack(|source, numbers| {
                // A source belongs to one of the three; the others leave it alone.
                frame.fill(source, numbers);
                object.fill(source, numbers);
                fill_input(document, Library::standard(), block, source, numbers);
            });
            let bytes = bytes
                .map_err(|error| RasterError::Shader { material: document.name.clone(), why: error.to_string() })?;
            blocks.push(((binding.group, binding.binding), bytes));
        }
        Ok(Blocks(blocks))
    }

    /// All that a shader reads. What was not prepared is left out, and the run will say so.
    pub(crate) fn resources<'a>(
        &'a self,
        scene: &Scene,
        material: &SceneMaterial,
        shader: &Shader,
        textures: &'a Textures<'_>,
    ) -> Resources<'a> {
        let mut resources = Resources::default();
        for ((group, binding), bytes) in &self.0 {
            resources = resources.buffer(*group, *binding, bytes);
        }
        for binding in &shader.reflection.bindings {
            resources = match &binding.resource {
                Resource::Texture(source) => match textures.texture(scene, material, source) {
                    Some(texture) => resources.texture(binding.group, binding.binding, texture),
                    None => resources,
                },
                Resource::Sampler(source) => {
                    resources.sampler(binding.group, binding.binding, texture::sampler(source))
                }
                Resource::Uniform(_) => resources,
            };
        }
        resources
    }
}
