//! The environment behind the objects: a pass of its own with the shader `entry/background.wgsl`.

use halfvector_scene::{Tile, View};

use crate::device::Gpu;
use crate::mesh::filled_buffer;
use crate::program::{depth_state, texture_type};

/// Bytes of the uniform struct `Background`.
const UNIFORM_BYTES: usize = 64;

/// The program that draws an environment to targets of a format.
#[derive(Debug)]
pub(crate) struct SkyProgram {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

/// Draws the environment where nothing nearer is.
#[derive(Debug)]
pub(crate) struct Sky {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    uniforms: wgpu::Buffer,
    rotation: [f32; 2],
    gamma_coded: bool,
}

impl SkyProgram {
    /// Compiles it.
    pub(crate) fn new(gpu: &Gpu, target: wgpu::TextureFormat) -> SkyProgram {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("background"),
            source: wgpu::ShaderSource::Wgsl(halfvector_shaders::background().into()),
        });
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("background"),
            entries: &[
                entry(
                    0,
                    wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                ),
                entry(1, texture_type(wgpu::TextureViewDimension::Cube)),
                entry(2, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
            ],
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("background"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("background"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_background"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: Some(depth_state(false, wgpu::CompareFunction::GreaterEqual)),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs_background"),
                compilation_options: Default::default(),
                targets: &[Some(target.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        SkyProgram { pipeline, layout }
    }

    /// Makes the pass for an environment turned by (cos, sin). `gamma_coded`: the picture holds display values by the
    /// report's gamma instead of radiance.
    pub(crate) fn sky(
        &self,
        gpu: &Gpu,
        radiance: &wgpu::TextureView,
        sampler: &wgpu::Sampler,
        rotation: [f32; 2],
        gamma_coded: bool,
    ) -> Sky {
        let uniforms = filled_buffer(gpu, &[0; UNIFORM_BYTES], wgpu::BufferUsages::UNIFORM);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("background"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniforms.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(radiance) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        });
        Sky { pipeline: self.pipeline.clone(), group, uniforms, rotation, gamma_coded }
    }
}

impl Sky {
    /// Sets the directions of a tile; before the pass that draws it is submitted.
    pub(crate) fn set_tile(&self, gpu: &Gpu, view: &View, width: u32, height: u32, tile: Tile) {
        let numbers = view.background_numbers(width, height, tile, self.rotation, self.gamma_coded);
        gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::cast_slice(&numbers));
    }

    /// Draws; after what is opaque and before what is blended.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
