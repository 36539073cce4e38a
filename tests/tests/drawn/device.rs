//! Draws a golden with wgpu, from WGSL or SPIR-V.

use wgpu::util::DeviceExt;

use super::inputs::{Format, Inputs, SIZE, Sphere, Texture, sampler};
use crate::golden::Golden;
use crate::support::required;

/// An opened GPU.
pub(super) struct Device {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// For people.
    pub(super) name: String,
}

impl Device {
    /// Opens a GPU, a software one included, or none with a printed line.
    pub(super) fn open() -> Option<Device> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle().with_env());
        let adapter = match pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())) {
            Ok(adapter) => adapter,
            Err(error) => {
                assert!(!required("HALFVECTOR_REQUIRE_GPU"), "a GPU is required: {error}");
                println!("skipped: no GPU ({error})");
                return None;
            }
        };
        let info = adapter.get_info();
        let descriptor = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("the GPU opens");
        Some(Device { device, queue, name: format!("{} ({})", info.name, info.backend) })
    }

    pub(super) fn wgsl(&self, text: &str) -> wgpu::ShaderModule {
        self.module(wgpu::ShaderSource::Wgsl(text.into()))
    }

    /// naga reads the words.
    pub(super) fn spirv(&self, bytes: &[u8]) -> wgpu::ShaderModule {
        self.module(wgpu::util::make_spirv(bytes))
    }

    fn module(&self, source: wgpu::ShaderSource<'_>) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
    }

    /// The picture's bytes: RGBA, row 0 on top. Nothing stands behind the sphere.
    pub(super) fn draw(
        &self,
        stages: [&wgpu::ShaderModule; 2],
        golden: &Golden,
        inputs: &Inputs,
        sphere: &Sphere,
    ) -> Vec<u8> {
        let reflection = &golden.shader.reflection;
        let attributes: Vec<([wgpu::VertexAttribute; 1], u64)> = reflection
            .vertex_inputs
            .iter()
            .map(|input| {
                let (format, bytes) = match sphere.attribute(&input.name).1 {
                    2 => (wgpu::VertexFormat::Float32x2, 8),
                    3 => (wgpu::VertexFormat::Float32x3, 12),
                    _ => (wgpu::VertexFormat::Float32x4, 16),
                };
                ([wgpu::VertexAttribute { format, offset: 0, shader_location: input.location }], bytes)
            })
            .collect();
        let buffers: Vec<_> = attributes
            .iter()
            .map(|(attributes, bytes)| {
                Some(wgpu::VertexBufferLayout {
                    array_stride: *bytes,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes,
                })
            })
            .collect();
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let pipeline = self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&golden.name),
            layout: None,
            vertex: wgpu::VertexState {
                module: stages[0],
                entry_point: Some("vs_main"),
                compilation_options: Default::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: (!reflection.double_sided).then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: stages[1],
                entry_point: Some("fs_main"),
                compilation_options: Default::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let groups = self.groups(&pipeline, inputs);
        let buffer = |contents: &[u8], usage| {
            self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let vertices: Vec<_> = reflection
            .vertex_inputs
            .iter()
            .map(|input| buffer(sphere.attribute(&input.name).0, wgpu::BufferUsages::VERTEX))
            .collect();
        let indices = buffer(bytemuck::cast_slice(sphere.indices()), wgpu::BufferUsages::INDEX);
        let target = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &target.create_view(&Default::default()),
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            pass.set_pipeline(&pipeline);
            for (number, group) in &groups {
                pass.set_bind_group(*number, group, &[]);
            }
            for (slot, buffer) in vertices.iter().enumerate() {
                pass.set_vertex_buffer(slot as u32, buffer.slice(..));
            }
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..sphere.indices().len() as u32, 0, 0..1);
        }
        let readable = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(SIZE * SIZE * 4),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        encoder.copy_texture_to_buffer(
            target.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &readable,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIZE * 4), rows_per_image: None },
            },
            target.size(),
        );
        self.queue.submit([encoder.finish()]);
        readable.slice(..).map_async(wgpu::MapMode::Read, |result| result.expect("readable"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the GPU answers");
        readable.slice(..).get_mapped_range().expect("mapped").to_vec()
    }

    fn groups(&self, pipeline: &wgpu::RenderPipeline, inputs: &Inputs) -> Vec<(u32, wgpu::BindGroup)> {
        let buffers: Vec<_> = inputs
            .blocks
            .iter()
            .map(|(_, contents)| {
                let usage = wgpu::BufferUsages::UNIFORM;
                self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
            })
            .collect();
        let views: Vec<_> = inputs.textures.iter().map(|(_, texture)| self.texture(texture)).collect();
        let samplers: Vec<_> = inputs
            .samplers
            .iter()
            .map(|(_, source)| {
                let [u, v, filter] = sampler(source);
                let mode = |wrap| match wrap {
                    "repeat" => wgpu::AddressMode::Repeat,
                    "mirror" => wgpu::AddressMode::MirrorRepeat,
                    _ => wgpu::AddressMode::ClampToEdge,
                };
                let is_linear = filter == "linear";
                let filter = if is_linear { wgpu::FilterMode::Linear } else { wgpu::FilterMode::Nearest };
                self.device.create_sampler(&wgpu::SamplerDescriptor {
                    address_mode_u: mode(u),
                    address_mode_v: mode(v),
                    mag_filter: filter,
                    min_filter: filter,
                    mipmap_filter: if is_linear {
                        wgpu::MipmapFilterMode::Linear
                    } else {
                        wgpu::MipmapFilterMode::Nearest
                    },
                    ..Default::default()
                })
            })
            .collect();
        let mut entries: Vec<(u32, wgpu::BindGroupEntry<'_>)> = Vec::new();
        let mut add = |binding: &halfvector_codegen::reflection::Binding, resource| {
            entries.push((binding.group, wgpu::BindGroupEntry { binding: binding.binding, resource }));
        };
        inputs.blocks.iter().zip(&buffers).for_each(|((b, _), buffer)| add(b, buffer.as_entire_binding()));
        inputs.textures.iter().zip(&views).for_each(|((b, _), v)| add(b, wgpu::BindingResource::TextureView(v)));
        inputs.samplers.iter().zip(&samplers).for_each(|((b, _), s)| add(b, wgpu::BindingResource::Sampler(s)));
        let mut groups = Vec::new();
        for number in 0..3 {
            let of_group: Vec<_> =
                entries.iter().filter(|(group, _)| *group == number).map(|(_, entry)| entry.clone()).collect();
            if !of_group.is_empty() {
                let layout = pipeline.get_bind_group_layout(number);
                let descriptor = wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &of_group };
                groups.push((number, self.device.create_bind_group(&descriptor)));
            }
        }
        groups
    }

    fn texture(&self, texture: &Texture) -> wgpu::TextureView {
        let layers = if texture.is_cube { 6 } else { 1 };
        let extent = |size| wgpu::Extent3d { width: size, height: size, depth_or_array_layers: layers };
        let format = match texture.format {
            Format::Rgba8 => wgpu::TextureFormat::Rgba8Unorm,
            Format::Srgb8 => wgpu::TextureFormat::Rgba8UnormSrgb,
            Format::Rgba16F => wgpu::TextureFormat::Rgba16Float,
            Format::Rg16F => wgpu::TextureFormat::Rg16Float,
        };
        let made = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: extent(texture.levels[0].0),
            mip_level_count: texture.levels.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (level, (size, bytes)) in texture.levels.iter().enumerate() {
            self.queue.write_texture(
                wgpu::TexelCopyTextureInfo { mip_level: level as u32, ..made.as_image_copy() },
                bytes,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(size * texture.format.bytes()),
                    rows_per_image: Some(*size),
                },
                extent(*size),
            );
        }
        let dimension = if texture.is_cube { wgpu::TextureViewDimension::Cube } else { wgpu::TextureViewDimension::D2 };
        made.create_view(&wgpu::TextureViewDescriptor { dimension: Some(dimension), ..Default::default() })
    }
}
