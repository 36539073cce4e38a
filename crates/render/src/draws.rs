//! A scene made ready for the GPU: shaders, programs, bind groups and the list of draws in order. It draws nothing.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use halfvector_codegen::reflection::{Binding, Resource, TextureSource};
use halfvector_codegen::uniforms::{FrameValues, ObjectValues, fill_input};
use halfvector_codegen::{Fold, Shader};
use halfvector_graph::library::Library;
use halfvector_graph::needs::Needs;
use halfvector_graph::value::ImageRef;
use halfvector_ibl::Visibility;
use halfvector_scene::{Object, Scene, SceneMaterial, View, dfg_visibility, passes};

use crate::cache::{Cache, Lit};
use crate::device::Gpu;
use crate::error::RenderError;
use crate::mesh::filled_buffer;

/// Everything that a picture draws.
pub(crate) struct Draws {
    /// The uniform blocks of groups 0.
    blocks: Vec<(Binding, wgpu::Buffer)>,
    /// Opaque and masked, in the scene's order.
    solid: Vec<Draw>,
    /// Blended, from back to front.
    blended: Vec<Draw>,
}

/// One draw of one mesh.
struct Draw {
    pipeline: wgpu::RenderPipeline,
    /// View, material, object; none where the shader reads nothing.
    groups: [Option<wgpu::BindGroup>; 3],
    /// By vertex buffer slot.
    attributes: Vec<wgpu::Buffer>,
    indices: wgpu::Buffer,
    index_count: u32,
}

/// A material of the scene, made ready.
struct Ready {
    shader: Arc<Shader>,
    layouts: Vec<Option<wgpu::BindGroupLayout>>,
    view: Option<wgpu::BindGroup>,
    material: Option<wgpu::BindGroup>,
}

/// What is to be drawn.
pub(crate) struct Wanted<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) needs: &'a Needs,
    pub(crate) fold: Fold,
    pub(crate) view: &'a View,
    pub(crate) target: wgpu::TextureFormat,
    pub(crate) environment: Option<Lit<'a>>,
}

/// Makes a scene ready: shaders of the materials that objects use, textures, buffers, and the order of drawing. What the
/// cache has is taken from there.
pub(crate) fn prepare(gpu: &Gpu, cache: &mut Cache, wanted: &Wanted<'_>) -> Result<Draws, RenderError> {
    let Wanted { scene, needs, fold, view, target, environment } = *wanted;
    let passes = passes(scene, view)?;
    let mut draws = Draws { blocks: Vec::new(), solid: Vec::new(), blended: Vec::new() };
    let mut resources = Resources { gpu, cache, scene, environment, visibility: dfg_visibility(&needs.methods) };
    let mut ready: BTreeMap<usize, Ready> = BTreeMap::new();
    for object in &scene.objects {
        if let Entry::Vacant(place) = ready.entry(object.material) {
            let material = &scene.materials[object.material];
            place.insert(make_ready(&mut resources, material, needs, fold, target, &mut draws.blocks)?);
        }
    }
    for (passes, blended) in [(&passes.solid, false), (&passes.blended, true)] {
        for &(index, pass) in passes {
            let object = &scene.objects[index];
            let Some(of) = ready.get(&object.material) else { continue };
            let cache = &mut *resources.cache;
            let name = &scene.materials[object.material].document.name;
            let (pipeline, built) = cache.program(gpu, name, &of.shader, target)?.pipeline(gpu, pass);
            cache.count_pipelines(u64::from(built));
            let mesh = &scene.meshes[object.mesh];
            let buffers = cache.mesh(gpu, object.mesh, mesh)?;
            let inputs = &of.shader.reflection.vertex_inputs;
            let attributes = inputs.iter().map(|input| buffers.attribute(gpu, object.mesh, mesh, &input.name));
            let draw = Draw {
                pipeline,
                attributes: attributes.collect::<Result<_, _>>()?,
                indices: buffers.indices.clone(),
                index_count: buffers.index_count,
                groups: [of.view.clone(), of.material.clone(), object_group(gpu, of, object)?],
            };
            let list = if blended { &mut draws.blended } else { &mut draws.solid };
            list.push(draw);
        }
    }
    Ok(draws)
}

/// The shader of a material with its program and the groups that all its objects share.
fn make_ready(
    resources: &mut Resources<'_>,
    material: &SceneMaterial,
    needs: &Needs,
    fold: Fold,
    target: wgpu::TextureFormat,
    blocks: &mut Vec<(Binding, wgpu::Buffer)>,
) -> Result<Ready, RenderError> {
    let (gpu, name) = (resources.gpu, &material.document.name);
    let shader = resources.cache.shader(&material.document, needs, fold)?;
    check_limits(gpu, name, &shader)?;
    let layouts = resources.cache.program(gpu, name, &shader, target)?.groups.clone();
    let view = view_group(resources, &layouts, &shader, blocks)?;
    let group = material_group(resources, &layouts, &shader, material)?;
    Ok(Ready { shader, layouts, view, material: group })
}

impl Draws {
    /// Sets what depends on the frame or tile; before the pass that draws it is submitted.
    pub(crate) fn set_frame(&self, gpu: &Gpu, frame: &FrameValues) -> Result<(), RenderError> {
        for (binding, buffer) in &self.blocks {
            let Resource::Uniform(block) = &binding.resource else { continue };
            let bytes =
                block.pack(|source, numbers| frame.fill(source, numbers)).map_err(|error| refused(gpu, error))?;
            gpu.queue.write_buffer(buffer, 0, &bytes);
        }
        Ok(())
    }

    /// Draws what hides what lies behind it.
    pub(crate) fn draw_solid(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.solid.iter().for_each(|draw| draw.draw(pass));
    }

    /// Draws what is blended over the rest.
    pub(crate) fn draw_blended(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.blended.iter().for_each(|draw| draw.draw(pass));
    }
}

impl Draw {
    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        for (index, group) in self.groups.iter().enumerate() {
            if let Some(group) = group {
                pass.set_bind_group(index as u32, group, &[]);
            }
        }
        for (slot, buffer) in self.attributes.iter().enumerate() {
            pass.set_vertex_buffer(slot as u32, buffer.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }
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

/// Where a material's textures come from.
struct Resources<'a> {
    gpu: &'a Gpu,
    cache: &'a mut Cache,
    scene: &'a Scene,
    environment: Option<Lit<'a>>,
    visibility: Visibility,
}

impl Resources<'_> {
    fn image(&mut self, material: &SceneMaterial, reference: &ImageRef) -> Result<wgpu::TextureView, RenderError> {
        let missing =
            || RenderError::MissingImage { material: material.document.name.clone(), file: reference.file.clone() };
        let index = self.scene.images.index(&material.directory, reference).ok_or_else(missing)?;
        let image = self.scene.images.images().get(index).ok_or_else(missing)?;
        self.cache.image(self.gpu, &reference.file, image, reference.color_space)
    }
}

/// A bound thing, held until its group is made.
enum Bound {
    Buffer(wgpu::Buffer),
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

fn bind_group(
    gpu: &Gpu,
    layouts: &[Option<wgpu::BindGroupLayout>],
    group: u32,
    bound: &[(u32, Bound)],
) -> Option<wgpu::BindGroup> {
    let layout = layouts.get(group as usize)?.as_ref()?;
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
    layouts: &[Option<wgpu::BindGroupLayout>],
    shader: &Shader,
    blocks: &mut Vec<(Binding, wgpu::Buffer)>,
) -> Result<Option<wgpu::BindGroup>, RenderError> {
    let Resources { gpu, cache, environment, visibility, .. } = resources;
    let mut bound = Vec::new();
    for binding in shader.reflection.bindings.iter().filter(|binding| binding.group == 0) {
        let resource = match &binding.resource {
            Resource::Uniform(block) => {
                let buffer = filled_buffer(gpu, &vec![0; block.size as usize], wgpu::BufferUsages::UNIFORM);
                blocks.push((binding.clone(), buffer.clone()));
                Bound::Buffer(buffer)
            }
            Resource::Texture(TextureSource::PrefilteredRadiance) => Bound::View(cache.radiance(gpu, *environment)?),
            Resource::Texture(TextureSource::IrradianceOverPi) => Bound::View(cache.irradiance(gpu, *environment)?),
            Resource::Texture(TextureSource::Dfg) => Bound::View(cache.dfg(gpu, *visibility)),
            Resource::Texture(TextureSource::Image(_)) => continue,
            Resource::Sampler(source) => Bound::Sampler(cache.sampler(gpu, source)),
        };
        bound.push((binding.binding, resource));
    }
    Ok(bind_group(gpu, layouts, 0, &bound))
}

fn material_group(
    resources: &mut Resources<'_>,
    layouts: &[Option<wgpu::BindGroupLayout>],
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
            Resource::Sampler(source) => Bound::Sampler(resources.cache.sampler(gpu, source)),
        };
        bound.push((binding.binding, resource));
    }
    Ok(bind_group(gpu, layouts, 1, &bound))
}

fn object_group(gpu: &Gpu, of: &Ready, object: &Object) -> Result<Option<wgpu::BindGroup>, RenderError> {
    let values = ObjectValues {
        world_from_object: object.world_from_object.to_cols_array(),
        object_from_world: object.object_from_world().to_cols_array(),
        normal_from_object: object.normal_from_object().to_cols_array(),
    };
    let mut bound = Vec::new();
    for binding in of.shader.reflection.bindings.iter().filter(|binding| binding.group == 2) {
        let Resource::Uniform(block) = &binding.resource else { continue };
        let fill = |source: &_, numbers: &mut _| values.fill(source, numbers);
        let bytes = block.pack(fill).map_err(|error| refused(gpu, error))?;
        bound.push((binding.binding, Bound::Buffer(filled_buffer(gpu, &bytes, wgpu::BufferUsages::UNIFORM))));
    }
    Ok(bind_group(gpu, &of.layouts, 2, &bound))
}

fn refused(gpu: &Gpu, error: halfvector_codegen::PackError) -> RenderError {
    RenderError::Refused { adapter: gpu.name.clone(), doing: "filling uniforms".to_owned(), why: error.to_string() }
}
