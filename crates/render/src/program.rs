//! A shader on the GPU: its module, its layouts by reflection, and its pipelines by what the rasteriser must do.

use std::collections::HashMap;

use halfvector_codegen::reflection::{Binding, Reflection, Resource, TextureSource, VertexInput};
use halfvector_graph::value::Type;
use halfvector_scene::{FacePass, Side};

use crate::device::Gpu;

/// Depth target of every pass; 1 is near and 0 is infinitely far.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// A compiled shader. Materials with the same text share it.
#[derive(Debug)]
pub(crate) struct Program {
    module: wgpu::ShaderModule,
    /// Layouts by group; groups without bindings have none.
    pub(crate) groups: Vec<Option<wgpu::BindGroupLayout>>,
    layout: wgpu::PipelineLayout,
    vertex_inputs: Vec<VertexInput>,
    pipelines: HashMap<FacePass, wgpu::RenderPipeline>,
    target: wgpu::TextureFormat,
}

impl Program {
    /// Compiles a shader for a target format.
    pub(crate) fn new(
        gpu: &Gpu,
        label: &str,
        wgsl: &str,
        reflection: &Reflection,
        target: wgpu::TextureFormat,
    ) -> Program {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let count = reflection.bindings.iter().map(|binding| binding.group + 1).max().unwrap_or(0);
        let groups: Vec<_> = (0..count).map(|group| group_layout(device, &reflection.bindings, group)).collect();
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &groups.iter().map(Option::as_ref).collect::<Vec<_>>(),
            immediate_size: 0,
        });
        let vertex_inputs = reflection.vertex_inputs.clone();
        Program { module, groups, layout, vertex_inputs, pipelines: HashMap::new(), target }
    }

    /// The pipeline for a way of drawing, and whether it was built for this call.
    pub(crate) fn pipeline(&mut self, gpu: &Gpu, pass: FacePass) -> (wgpu::RenderPipeline, bool) {
        if let Some(known) = self.pipelines.get(&pass) {
            return (known.clone(), false);
        }
        let pipeline = self.make(gpu, pass);
        self.pipelines.insert(pass, pipeline.clone());
        (pipeline, true)
    }

    fn make(&self, gpu: &Gpu, pass: FacePass) -> wgpu::RenderPipeline {
        let attributes: Vec<_> = self
            .vertex_inputs
            .iter()
            .map(|input| wgpu::VertexAttribute {
                format: vertex_format(input.ty),
                offset: 0,
                shader_location: input.location,
            })
            .collect();
        let buffers: Vec<_> = attributes
            .iter()
            .map(|attribute| {
                Some(wgpu::VertexBufferLayout {
                    array_stride: attribute.format.size(),
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: std::slice::from_ref(attribute),
                })
            })
            .collect();
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some("vs_main"),
                compilation_options: Default::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                front_face: if pass.mirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw },
                cull_mode: pass.cull.map(|side| match side {
                    Side::Front => wgpu::Face::Front,
                    Side::Back => wgpu::Face::Back,
                }),
                ..Default::default()
            },
            depth_stencil: Some(depth_state(!pass.blend, wgpu::CompareFunction::Greater)),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: Some("fs_main"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: self.target,
                    blend: pass.blend.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// The depth test of every pass: nearer (larger) wins.
pub(crate) fn depth_state(write: bool, compare: wgpu::CompareFunction) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(write),
        depth_compare: Some(compare),
        stencil: Default::default(),
        bias: Default::default(),
    }
}

fn group_layout(device: &wgpu::Device, bindings: &[Binding], group: u32) -> Option<wgpu::BindGroupLayout> {
    let entries: Vec<_> = bindings.iter().filter(|binding| binding.group == group).map(layout_entry).collect();
    (!entries.is_empty())
        .then(|| device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries }))
}

fn layout_entry(binding: &Binding) -> wgpu::BindGroupLayoutEntry {
    let mut visibility = wgpu::ShaderStages::NONE;
    visibility.set(wgpu::ShaderStages::VERTEX, binding.vertex);
    visibility.set(wgpu::ShaderStages::FRAGMENT, binding.fragment);
    let ty = match &binding.resource {
        Resource::Uniform(_) => wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        Resource::Texture(source) => texture_type(match source {
            TextureSource::Image(_) | TextureSource::Dfg => wgpu::TextureViewDimension::D2,
            TextureSource::PrefilteredRadiance | TextureSource::IrradianceOverPi => wgpu::TextureViewDimension::Cube,
        }),
        Resource::Sampler(_) => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
    };
    wgpu::BindGroupLayoutEntry { binding: binding.binding, visibility, ty, count: None }
}

/// A float texture that is read between texels.
pub(crate) fn texture_type(view_dimension: wgpu::TextureViewDimension) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension,
        multisampled: false,
    }
}

fn vertex_format(ty: Type) -> wgpu::VertexFormat {
    match ty {
        Type::Vec2 => wgpu::VertexFormat::Float32x2,
        Type::Vec3 => wgpu::VertexFormat::Float32x3,
        Type::Vec4 => wgpu::VertexFormat::Float32x4,
        Type::F32 | Type::I32 | Type::Bool => wgpu::VertexFormat::Float32,
    }
}
