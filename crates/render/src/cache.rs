//! What a renderer keeps from picture to picture: shaders, programs with their pipelines, textures, meshes, targets.
//!
//! Everything is kept by what it is made of, so that nothing kept is ever stale; what was not used for long goes first.

use std::collections::HashMap;
use std::sync::Arc;

use halfvector_codegen::reflection::SamplerSource;
use halfvector_codegen::{Fold, Shader};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::needs::Needs;
use halfvector_graph::value::ColorSpace;
use halfvector_ibl::{BakedEnvironment, Visibility, dfg_table_of_shaders};
use halfvector_maps::Image;
use halfvector_scene::Mesh;

use crate::background::SkyProgram;
use crate::device::Gpu;
use crate::error::RenderError;
use crate::kept::Kept;
use crate::mesh::MeshBuffers;
use crate::program::Program;
use crate::target::Target;
use crate::texture;

/// Most programs, and most shaders.
const PROGRAMS: u64 = 48;
/// Most environments.
const ENVIRONMENTS: u64 = 4;
/// Most bytes of pictures, of meshes and of targets.
const BYTES: u64 = 512 << 20;

/// What a [`crate::Renderer`] made for earlier pictures and may use again. It belongs to the renderer that filled it.
///
/// The same document with other numbers needs no new program under [`Fold::Live`], the same image or mesh (the same `Arc`)
/// is not uploaded again.
#[derive(Debug)]
pub struct Cache {
    /// Number of the picture that is drawn.
    picture: u64,
    shaders: Vec<KnownShader>,
    programs: Kept<(String, wgpu::TextureFormat), Program>,
    images: Kept<(usize, ColorSpace), Held<Image, wgpu::TextureView>>,
    meshes: Kept<usize, Held<Mesh, MeshBuffers>>,
    environments: Kept<usize, EnvironmentViews>,
    /// For the correlated and for the separable visibility.
    dfg: [Option<wgpu::TextureView>; 2],
    samplers: HashMap<SamplerSource, wgpu::Sampler>,
    skies: HashMap<wgpu::TextureFormat, SkyProgram>,
    targets: Kept<(wgpu::TextureFormat, u32, u32), Target>,
    made: Made,
}

/// How much a cache did not have and was made, since the cache was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Made {
    /// Shaders written by the code generator.
    pub shaders: u64,
    /// Programs compiled.
    pub programs: u64,
    /// Pipelines built.
    pub pipelines: u64,
    /// Textures filled, environments included.
    pub textures: u64,
    /// Meshes uploaded.
    pub meshes: u64,
}

/// Something made of a thing that is held, so that its address stays its own.
#[derive(Debug)]
struct Held<T, V> {
    _of: Arc<T>,
    made: V,
}

#[derive(Debug)]
struct KnownShader {
    document: Document,
    needs: Needs,
    fold: Fold,
    shader: Arc<Shader>,
    used: u64,
}

/// The environment's textures, made as far as they are read.
#[derive(Debug)]
struct EnvironmentViews {
    _of: Option<Arc<BakedEnvironment>>,
    radiance: Option<wgpu::TextureView>,
    irradiance: Option<wgpu::TextureView>,
}

/// An environment, and who keeps it at its address; without a keeper the cache lives no longer than the call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lit<'e> {
    pub(crate) baked: &'e BakedEnvironment,
    pub(crate) keeper: Option<&'e Arc<BakedEnvironment>>,
}

impl Default for Cache {
    fn default() -> Self {
        Cache {
            picture: 0,
            shaders: Vec::new(),
            programs: Kept::new(PROGRAMS),
            images: Kept::new(BYTES),
            meshes: Kept::new(BYTES),
            environments: Kept::new(ENVIRONMENTS),
            dfg: [None, None],
            samplers: HashMap::new(),
            skies: HashMap::new(),
            targets: Kept::new(BYTES),
            made: Made::default(),
        }
    }
}

impl Cache {
    /// What had to be made so far.
    pub fn made(&self) -> Made {
        self.made
    }

    /// A new picture is begun.
    pub(crate) fn begin(&mut self) {
        self.picture += 1;
    }

    /// A picture is done: what is too much is forgotten.
    pub(crate) fn end(&mut self) {
        let picture = self.picture;
        self.programs.trim(picture);
        self.images.trim(picture);
        self.meshes.trim(picture);
        self.environments.trim(picture);
        self.targets.trim(picture);
        while self.shaders.len() as u64 > PROGRAMS {
            let oldest = (0..self.shaders.len()).min_by_key(|&i| self.shaders[i].used);
            oldest.map(|oldest| self.shaders.swap_remove(oldest));
        }
    }

    /// Forgets everything but the counts: what the device refused or lost is not used again.
    pub(crate) fn clear(&mut self) {
        *self = Cache { made: self.made, picture: self.picture, ..Cache::default() };
    }

    /// The shader of a document.
    pub(crate) fn shader(
        &mut self,
        document: &Document,
        needs: &Needs,
        fold: Fold,
    ) -> Result<Arc<Shader>, RenderError> {
        let same =
            |known: &&mut KnownShader| known.fold == fold && known.needs == *needs && known.document == *document;
        if let Some(known) = self.shaders.iter_mut().find(same) {
            known.used = self.picture;
            return Ok(known.shader.clone());
        }
        let shader = halfvector_codegen::shader(document, Library::standard(), needs, fold)
            .map_err(|error| RenderError::Shader { material: document.name.clone(), why: error.to_string() })?;
        self.made.shaders += 1;
        let shader = Arc::new(shader);
        self.shaders.push(KnownShader {
            document: document.clone(),
            needs: needs.clone(),
            fold,
            shader: shader.clone(),
            used: self.picture,
        });
        Ok(shader)
    }

    /// The program of a shader for a target format; `label` names it in the driver's messages.
    pub(crate) fn program(
        &mut self,
        gpu: &Gpu,
        label: &str,
        shader: &Shader,
        format: wgpu::TextureFormat,
    ) -> Result<&mut Program, RenderError> {
        let made = &mut self.made;
        self.programs.get((shader.wgsl.clone(), format), self.picture, || {
            made.programs += 1;
            Ok::<_, RenderError>((Program::new(gpu, label, &shader.wgsl, &shader.reflection, format), 1))
        })
    }

    /// Counts pipelines that were built.
    pub(crate) fn count_pipelines(&mut self, built: u64) {
        self.made.pipelines += built;
    }

    /// The texture of an image; `file` names it in errors.
    pub(crate) fn image(
        &mut self,
        gpu: &Gpu,
        file: &str,
        image: &Arc<Image>,
        space: ColorSpace,
    ) -> Result<wgpu::TextureView, RenderError> {
        let made = &mut self.made;
        let key = (Arc::as_ptr(image) as usize, space);
        let held = self.images.get(key, self.picture, || {
            made.textures += 1;
            let view = texture::image(gpu, file, image, space)?;
            // With its mip levels a third more.
            let bytes = u64::from(image.width()) * u64::from(image.height()) * 16 / 3 * 4;
            Ok::<_, RenderError>((Held { _of: image.clone(), made: view }, bytes))
        })?;
        Ok(held.made.clone())
    }

    /// The buffers of mesh number `number`.
    pub(crate) fn mesh(&mut self, gpu: &Gpu, number: usize, mesh: &Arc<Mesh>) -> Result<&mut MeshBuffers, RenderError> {
        let made = &mut self.made;
        let held = self.meshes.get(Arc::as_ptr(mesh) as usize, self.picture, || {
            made.meshes += 1;
            let bytes = mesh.positions.len() as u64 * 56 + mesh.indices.len() as u64 * 4;
            Ok::<_, RenderError>((Held { _of: mesh.clone(), made: MeshBuffers::new(gpu, number, mesh)? }, bytes))
        })?;
        Ok(&mut held.made)
    }

    fn environment(&mut self, lit: Lit<'_>) -> &mut EnvironmentViews {
        let key = std::ptr::from_ref(lit.baked) as usize;
        let make = || {
            Ok::<_, std::convert::Infallible>((
                EnvironmentViews { _of: lit.keeper.cloned(), radiance: None, irradiance: None },
                1,
            ))
        };
        let Ok(views) = self.environments.get(key, self.picture, make);
        views
    }

    /// The prefiltered radiance; its level 0 is the environment itself.
    pub(crate) fn radiance(&mut self, gpu: &Gpu, lit: Option<Lit<'_>>) -> Result<wgpu::TextureView, RenderError> {
        let lit = lit.ok_or(RenderError::NoEnvironment)?;
        if let Some(known) = &self.environment(lit).radiance {
            return Ok(known.clone());
        }
        let view = texture::cube(gpu, &lit.baked.radiance, &lit.baked.slope);
        self.made.textures += 1;
        Ok(self.environment(lit).radiance.insert(view).clone())
    }

    /// The irradiance over pi.
    pub(crate) fn irradiance(&mut self, gpu: &Gpu, lit: Option<Lit<'_>>) -> Result<wgpu::TextureView, RenderError> {
        let lit = lit.ok_or(RenderError::NoEnvironment)?;
        if let Some(known) = &self.environment(lit).irradiance {
            return Ok(known.clone());
        }
        let view = texture::cube(gpu, std::slice::from_ref(&lit.baked.irradiance_over_pi), &[]);
        self.made.textures += 1;
        Ok(self.environment(lit).irradiance.insert(view).clone())
    }

    /// The table of albedos for a visibility.
    pub(crate) fn dfg(&mut self, gpu: &Gpu, visibility: Visibility) -> wgpu::TextureView {
        let made = &mut self.made;
        let table = || {
            made.textures += 1;
            texture::dfg(gpu, dfg_table_of_shaders(visibility))
        };
        self.dfg[usize::from(visibility == Visibility::Separable)].get_or_insert_with(table).clone()
    }

    /// A sampler.
    pub(crate) fn sampler(&mut self, gpu: &Gpu, source: &SamplerSource) -> wgpu::Sampler {
        self.samplers.entry(source.clone()).or_insert_with(|| texture::sampler(gpu, source)).clone()
    }

    /// The program that draws the environment behind the objects.
    pub(crate) fn sky(&mut self, gpu: &Gpu, format: wgpu::TextureFormat) -> &SkyProgram {
        let made = &mut self.made;
        self.skies.entry(format).or_insert_with(|| {
            made.programs += 1;
            made.pipelines += 1;
            SkyProgram::new(gpu, format)
        })
    }

    /// A target of so many samples.
    pub(crate) fn target(&mut self, gpu: &Gpu, format: wgpu::TextureFormat, width: u32, height: u32) -> &Target {
        // Colour, depth and what they are read back through.
        let bytes = u64::from(width) * u64::from(height) * (16 + 4 + 16);
        let make = || Ok::<_, std::convert::Infallible>((Target::new(gpu, format, width, height), bytes));
        let Ok(target) = self.targets.get((format, width, height), self.picture, make);
        target
    }
}
