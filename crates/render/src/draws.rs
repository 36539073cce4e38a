//! A scene made ready for the GPU: shaders, programs, bind groups and the list of draws in order. It draws nothing.

use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap};

use halfvector_codegen::reflection::{Binding, Resource, SamplerSource, TextureSource};
use halfvector_codegen::uniforms::{FrameValues, ObjectValues, fill_input};
use halfvector_codegen::{Fold, Shader};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::Needs;
use halfvector_graph::value::{ColorSpace, ImageRef};
use halfvector_ibl::{BakedEnvironment, DFG_SIZE, Visibility, dfg_table_with};
use halfvector_scene::{FacePass, Object, Scene, SceneMaterial, View, dfg_visibility, passes};

use crate::device::Gpu;
use crate::error::RenderError;
use crate::mesh::{MeshBuffers, filled_buffer};
use crate::program::Program;
use crate::texture;

/// Everything that a frame draws.
pub(crate) struct Draws {
    programs: Vec<Program>,
    meshes: HashMap<usize, MeshBuffers>,
    /// Group 0 of each program, and the uniform blocks in it.
    views: Vec<ViewGroup>,
    /// Groups 1, by material.
    materials: HashMap<usize, Option<wgpu::BindGroup>>,
    /// Opaque and masked, in the scene's order.
    solid: Vec<Draw>,
    /// Blended, from back to front.
    blended: Vec<Draw>,
}

/// Group 0 of a program.
struct ViewGroup {
    group: Option<wgpu::BindGroup>,
    blocks: Vec<(Binding, wgpu::Buffer)>,
}

/// One draw of one mesh.
struct Draw {
    program: usize,
    pass: FacePass,
    mesh: usize,
    material: usize,
    object: Option<wgpu::BindGroup>,
    /// Attribute names by vertex buffer slot.
    attributes: Vec<String>,
}

/// The environment's textures, made as far as they are read.
pub(crate) struct EnvironmentTextures<'e> {
    baked: Option<&'e BakedEnvironment>,
    radiance: Option<wgpu::TextureView>,
    irradiance: Option<wgpu::TextureView>,
    dfg: Option<wgpu::TextureView>,
    visibility: Visibility,
}

impl<'e> EnvironmentTextures<'e> {
    /// Nothing uploaded yet. The table of albedos is made for the visibility that the methods choose.
    pub(crate) fn new(baked: Option<&'e BakedEnvironment>, methods: &Methods) -> Self {
        let visibility = dfg_visibility(methods);
        EnvironmentTextures { baked, radiance: None, irradiance: None, dfg: None, visibility }
    }

    /// The prefiltered radiance; its level 0 is the environment itself.
    pub(crate) fn radiance(&mut self, gpu: &Gpu) -> Result<wgpu::TextureView, RenderError> {
        let baked = self.baked.ok_or(RenderError::NoEnvironment)?;
        Ok(self.radiance.get_or_insert_with(|| texture::cube(gpu, &baked.radiance, &baked.slope)).clone())
    }

    fn irradiance(&mut self, gpu: &Gpu) -> Result<wgpu::TextureView, RenderError> {
        let baked = self.baked.ok_or(RenderError::NoEnvironment)?;
        let levels = std::slice::from_ref(&baked.irradiance_over_pi);
        Ok(self.irradiance.get_or_insert_with(|| texture::cube(gpu, levels, &[])).clone())
    }

    fn dfg(&mut self, gpu: &Gpu) -> wgpu::TextureView {
        let table = || texture::dfg(gpu, &dfg_table_with(DFG_SIZE, self.visibility));
        self.dfg.get_or_insert_with(table).clone()
    }
}

/// Makes a scene ready: shaders of the materials that objects use, textures, buffers, and the order of drawing.
pub(crate) fn prepare(
    gpu: &Gpu,
    scene: &Scene,
    needs: &Needs,
    fold: Fold,
    view: &View,
    target: wgpu::TextureFormat,
    environment: &mut EnvironmentTextures<'_>,
) -> Result<Draws, RenderError> {
    let passes = passes(scene, view)?;
    let mut draws = Draws {
        programs: Vec::new(),
        meshes: HashMap::new(),
        views: Vec::new(),
        materials: HashMap::new(),
        solid: Vec::new(),
        blended: Vec::new(),
    };
    let mut resources = Resources { gpu, scene, images: HashMap::new(), samplers: HashMap::new() };
    let shaders = shaders(gpu, scene, needs, fold)?;
    let mut program_of_text = HashMap::new();
    let mut program_of_material = HashMap::new();
    for (&index, shader) in &shaders {
        let program = match program_of_text.get(shader.wgsl.as_str()) {
            Some(&program) => program,
            None => {
                let name = &scene.materials[index].document.name;
                draws.programs.push(Program::new(gpu, name, &shader.wgsl, &shader.reflection, target));
                let program = draws.programs.len() - 1;
                draws.views.push(view_group(&mut resources, &draws.programs[program], shader, environment)?);
                program_of_text.insert(shader.wgsl.as_str(), program);
                program
            }
        };
        program_of_material.insert(index, program);
        let group = material_group(&mut resources, &draws.programs[program], shader, &scene.materials[index])?;
        draws.materials.insert(index, group);
    }

    for (passes, blended) in [(&passes.solid, false), (&passes.blended, true)] {
        for &(index, pass) in passes {
            let object = &scene.objects[index];
            let Some(shader) = shaders.get(&object.material) else { continue };
            let program = program_of_material[&object.material];
            let mesh = &scene.meshes[object.mesh];
            let buffers = match draws.meshes.entry(object.mesh) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(place) => place.insert(MeshBuffers::new(gpu, object.mesh, mesh)?),
            };
            for input in &shader.reflection.vertex_inputs {
                buffers.prepare(gpu, object.mesh, mesh, &input.name)?;
            }
            draws.programs[program].prepare(gpu, pass);
            let draw = Draw {
                program,
                pass,
                mesh: object.mesh,
                material: object.material,
                object: object_group(gpu, &draws.programs[program], shader, object)?,
                attributes: shader.reflection.vertex_inputs.iter().map(|input| input.name.clone()).collect(),
            };
            let list = if blended { &mut draws.blended } else { &mut draws.solid };
            list.push(draw);
        }
    }
    Ok(draws)
}

impl Draws {
    /// Sets what depends on the frame or tile; before the pass that draws it is submitted.
    pub(crate) fn set_frame(&self, gpu: &Gpu, frame: &FrameValues) -> Result<(), RenderError> {
        for (binding, buffer) in self.views.iter().flat_map(|view| &view.blocks) {
            let Resource::Uniform(block) = &binding.resource else { continue };
            let bytes =
                block.pack(|source, numbers| frame.fill(source, numbers)).map_err(|error| refused(gpu, error))?;
            gpu.queue.write_buffer(buffer, 0, &bytes);
        }
        Ok(())
    }

    /// Draws what hides what lies behind it.
    pub(crate) fn draw_solid(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(&self.solid, pass);
    }

    /// Draws what is blended over the rest.
    pub(crate) fn draw_blended(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw(&self.blended, pass);
    }

    fn draw(&self, draws: &[Draw], pass: &mut wgpu::RenderPass<'_>) {
        for draw in draws {
            let Some(pipeline) = self.programs[draw.program].pipeline(draw.pass) else { continue };
            let Some(mesh) = self.meshes.get(&draw.mesh) else { continue };
            pass.set_pipeline(pipeline);
            let material = self.materials.get(&draw.material).and_then(Option::as_ref);
            let groups = [self.views[draw.program].group.as_ref(), material, draw.object.as_ref()];
            for (index, group) in groups.into_iter().enumerate() {
                if let Some(group) = group {
                    pass.set_bind_group(index as u32, group, &[]);
                }
            }
            for (slot, name) in draw.attributes.iter().enumerate() {
                if let Some(buffer) = mesh.attribute(name) {
                    pass.set_vertex_buffer(slot as u32, buffer.slice(..));
                }
            }
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.index_count, 0, 0..1);
        }
    }
}

/// The shader of each material that an object uses, by the material's index.
fn shaders(gpu: &Gpu, scene: &Scene, needs: &Needs, fold: Fold) -> Result<HashMap<usize, Shader>, RenderError> {
    let used: BTreeSet<usize> = scene.objects.iter().map(|object| object.material).collect();
    let mut shaders = HashMap::new();
    for index in used {
        let document = &scene.materials[index].document;
        let shader = halfvector_codegen::shader(document, Library::standard(), needs, fold)
            .map_err(|error| RenderError::Shader { material: document.name.clone(), why: error.to_string() })?;
        check_limits(gpu, &document.name, &shader)?;
        shaders.insert(index, shader);
    }
    Ok(shaders)
}

/// Refuses a shader that reads more than the device can bind, in words that say what to do.
fn check_limits(gpu: &Gpu, material: &str, shader: &Shader) -> Result<(), RenderError> {
    let limits = gpu.device.limits();
    let (material, adapter) = (material.to_owned(), gpu.name.clone());
    let mut count = 0;
    for binding in &shader.reflection.bindings {
        match &binding.resource {
            Resource::Uniform(block) if u64::from(block.size) > limits.max_uniform_buffer_binding_size => {
                return Err(RenderError::UniformsTooLarge {
                    material,
                    block: block.struct_name.clone(),
                    bytes: block.size,
                    limit: limits.max_uniform_buffer_binding_size,
                    adapter,
                });
            }
            Resource::Texture(_) if binding.fragment => count += 1,
            _ => {}
        }
    }
    let limit = limits.max_sampled_textures_per_shader_stage;
    if count > limit as usize {
        return Err(RenderError::TooManyTextures { material, count, limit, adapter });
    }
    Ok(())
}

/// Textures and samplers by what they are, so that materials share them.
struct Resources<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    /// By number in the scene's store and coding.
    images: HashMap<(usize, ColorSpace), wgpu::TextureView>,
    samplers: HashMap<SamplerSource, wgpu::Sampler>,
}

impl Resources<'_> {
    fn image(&mut self, material: &SceneMaterial, reference: &ImageRef) -> Result<wgpu::TextureView, RenderError> {
        let missing =
            || RenderError::MissingImage { material: material.document.name.clone(), file: reference.file.clone() };
        let index = self.scene.images.index(&material.directory, reference).ok_or_else(missing)?;
        let key = (index, reference.color_space);
        if let Some(view) = self.images.get(&key) {
            return Ok(view.clone());
        }
        let image = self.scene.images.images().get(index).ok_or_else(missing)?;
        let view = texture::image(self.gpu, &reference.file, image, reference.color_space)?;
        self.images.insert(key, view.clone());
        Ok(view)
    }

    fn sampler(&mut self, source: &SamplerSource) -> wgpu::Sampler {
        self.samplers.entry(source.clone()).or_insert_with(|| texture::sampler(self.gpu, source)).clone()
    }
}

/// A bound thing, held until its group is made.
enum Bound {
    Buffer(wgpu::Buffer),
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

fn bind_group(gpu: &Gpu, program: &Program, group: u32, bound: &[(u32, Bound)]) -> Option<wgpu::BindGroup> {
    let layout = program.groups.get(group as usize)?.as_ref()?;
    let entries: Vec<_> = bound
        .iter()
        .map(|(binding, bound)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: match bound {
                Bound::Buffer(buffer) => buffer.as_entire_binding(),
                Bound::View(view) => wgpu::BindingResource::TextureView(view),
                Bound::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
            },
        })
        .collect();
    Some(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries }))
}

fn view_group(
    resources: &mut Resources<'_>,
    program: &Program,
    shader: &Shader,
    environment: &mut EnvironmentTextures<'_>,
) -> Result<ViewGroup, RenderError> {
    let gpu = resources.gpu;
    let mut blocks = Vec::new();
    let mut bound = Vec::new();
    for binding in shader.reflection.bindings.iter().filter(|binding| binding.group == 0) {
        let resource = match &binding.resource {
            Resource::Uniform(block) => {
                let buffer = filled_buffer(gpu, &vec![0; block.size as usize], wgpu::BufferUsages::UNIFORM);
                blocks.push((binding.clone(), buffer.clone()));
                Bound::Buffer(buffer)
            }
            Resource::Texture(TextureSource::PrefilteredRadiance) => Bound::View(environment.radiance(gpu)?),
            Resource::Texture(TextureSource::IrradianceOverPi) => Bound::View(environment.irradiance(gpu)?),
            Resource::Texture(TextureSource::Dfg) => Bound::View(environment.dfg(gpu)),
            Resource::Texture(TextureSource::Image(_)) => continue,
            Resource::Sampler(source) => Bound::Sampler(resources.sampler(source)),
        };
        bound.push((binding.binding, resource));
    }
    Ok(ViewGroup { group: bind_group(gpu, program, 0, &bound), blocks })
}

fn material_group(
    resources: &mut Resources<'_>,
    program: &Program,
    shader: &Shader,
    material: &SceneMaterial,
) -> Result<Option<wgpu::BindGroup>, RenderError> {
    let gpu = resources.gpu;
    let mut bound = Vec::new();
    for binding in shader.reflection.bindings.iter().filter(|binding| binding.group == 1) {
        let resource = match &binding.resource {
            Resource::Uniform(block) => {
                let fill = |source: &_, numbers: &mut _| {
                    fill_input(&material.document, Library::standard(), block, source, numbers);
                };
                let bytes = block.pack(fill).map_err(|error| refused(gpu, error))?;
                Bound::Buffer(filled_buffer(gpu, &bytes, wgpu::BufferUsages::UNIFORM))
            }
            Resource::Texture(TextureSource::Image(reference)) => Bound::View(resources.image(material, reference)?),
            Resource::Texture(_) => continue,
            Resource::Sampler(source) => Bound::Sampler(resources.sampler(source)),
        };
        bound.push((binding.binding, resource));
    }
    Ok(bind_group(gpu, program, 1, &bound))
}

fn object_group(
    gpu: &Gpu,
    program: &Program,
    shader: &Shader,
    object: &Object,
) -> Result<Option<wgpu::BindGroup>, RenderError> {
    let values = ObjectValues {
        world_from_object: object.world_from_object.to_cols_array(),
        normal_from_object: object.normal_from_object().to_cols_array(),
    };
    let mut bound = Vec::new();
    for binding in shader.reflection.bindings.iter().filter(|binding| binding.group == 2) {
        let Resource::Uniform(block) = &binding.resource else { continue };
        let fill = |source: &_, numbers: &mut _| values.fill(source, numbers);
        let bytes = block.pack(fill).map_err(|error| refused(gpu, error))?;
        bound.push((binding.binding, Bound::Buffer(filled_buffer(gpu, &bytes, wgpu::BufferUsages::UNIFORM))));
    }
    Ok(bind_group(gpu, program, 2, &bound))
}

fn refused(gpu: &Gpu, error: halfvector_codegen::PackError) -> RenderError {
    RenderError::Refused { adapter: gpu.name.clone(), doing: "filling uniforms".to_owned(), why: error.to_string() }
}
