//! Prefiltering of environments on the GPU with `entry/bake.wgsl`: the tree over a map, and cubes filtered through it.
//!
//! It computes convolutions only. Which levels there are, how they are read, harmonics and level 0 are `halfvector-ibl`'s.

use std::f64::consts::PI;

use bytemuck::{Pod, Zeroable};
use halfvector_ibl::{Cube, Equirect, FilterJob, Filtered};
use halfvector_shaders::FILES;

use crate::device::Gpu;
use crate::error::RenderError;
use crate::mesh::filled_buffer;

/// Most rows of a map that the tree is made of: larger maps are averaged down first. Its leaves are then 0.09 degrees,
/// a twelfth of the lobe of perceptual roughness 0.1.
const MAX_ROWS: usize = 1024;

/// Bytes of a node: two vectors of three with a number each.
const NODE_BYTES: u64 = 32;

/// Invocations of one dispatch: short enough that a slow device does not stop the work.
const SLICE: u32 = 1 << 15;

/// Invocations of a workgroup, as the shader has it.
const WORKGROUP: u32 = 64;

/// The uniform struct of the shader.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Uniforms {
    columns: u32,
    rows: u32,
    depth: u32,
    trees: u32,
    face_size: u32,
    first: u32,
    level: u32,
    alpha: f32,
    scale: f32,
}

/// A row of the map, as the shader reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Row {
    sin_theta: f32,
    cos_theta: f32,
    solid_angle: f32,
    variance: f32,
    extent: f32,
}

/// A map on the GPU, ready to be filtered.
#[derive(Debug)]
pub(crate) struct Filter<'a> {
    gpu: &'a Gpu,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    uniforms: wgpu::Buffer,
    inputs: [wgpu::Buffer; 4],
    shape: Uniforms,
}

impl<'a> Filter<'a> {
    /// Uploads a map and makes its tree.
    pub(crate) fn new(gpu: &'a Gpu, map: &Equirect) -> Result<Filter<'a>, RenderError> {
        let smaller =
            (map.height > MAX_ROWS).then(|| map.area_resampled((map.width * MAX_ROWS).div_ceil(map.height), MAX_ROWS));
        let map = smaller.as_ref().unwrap_or(map);
        gpu.guarded("preparing the environment", || Filter::prepared(gpu, map))
    }

    fn prepared(gpu: &'a Gpu, map: &Equirect) -> Result<Filter<'a>, RenderError> {
        let depth = map.height.next_power_of_two().ilog2();
        let trees = map.width.div_ceil(1 << depth) as u32;
        let shape = Uniforms {
            columns: map.width as u32,
            rows: map.height as u32,
            depth,
            trees,
            face_size: 0,
            first: 0,
            level: 0,
            alpha: 1.0,
            scale: 1.0,
        };
        let node_count = u64::from(trees) * ((1 << (2 * (depth + 1))) - 1) / 3;
        let bytes = node_count * NODE_BYTES;
        let limits = gpu.device.limits();
        let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if bytes > limit {
            return Err(RenderError::EnvironmentTooLarge {
                width: map.width,
                height: map.height,
                bytes,
                limit,
                adapter: gpu.name.clone(),
            });
        }
        let storage = wgpu::BufferUsages::STORAGE;
        let nodes = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("bake nodes"),
            size: bytes,
            usage: storage,
            mapped_at_creation: false,
        });
        let inputs = [
            filled_buffer(gpu, bytemuck::cast_slice(&map.pixels), storage),
            filled_buffer(gpu, bytemuck::cast_slice(&rows(map)), storage),
            filled_buffer(gpu, bytemuck::cast_slice(&columns(map)), storage),
            nodes,
        ];
        let layout = layout(&gpu.device);
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("bake"),
            source: wgpu::ShaderSource::Wgsl(shader_text().into()),
        });
        let uniforms = filled_buffer(gpu, bytemuck::bytes_of(&shape), wgpu::BufferUsages::UNIFORM);
        let filter = Filter {
            gpu,
            pipeline: pipeline(&gpu.device, &module, &layout, "bake_texel"),
            layout,
            uniforms,
            inputs,
            shape,
        };
        let level_pipeline = pipeline(&gpu.device, &module, &filter.layout, "bake_level");
        let no_texels = filled_buffer(gpu, &[0; 16], storage);
        for level in 0..=depth {
            let count = trees << (2 * (depth - level));
            filter.dispatch(&level_pipeline, &no_texels, Uniforms { level, ..shape }, count)?;
        }
        Ok(filter)
    }

    /// The map filtered with a lobe.
    pub(crate) fn cube(&self, job: FilterJob) -> Result<Filtered, RenderError> {
        let FilterJob { alpha, size } = job;
        const DOING: &str = "filtering the environment";
        self.gpu.guarded(DOING, || {
            let count = 6 * (size * size) as u32;
            let bytes = u64::from(count) * 16;
            let texels = self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("bake texels"),
                size: bytes,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            });
            let uniforms = Uniforms {
                face_size: size as u32,
                alpha: alpha as f32,
                scale: (1.0 / lobe_integral(alpha * alpha)) as f32,
                ..self.shape
            };
            self.dispatch(&self.pipeline, &texels, uniforms, count)?;
            let numbers = self.gpu.read_buffer(&texels, DOING)?;
            // The shader's light is weighted by a lobe whose integral changes, too.
            let own = lobe_integral_change(alpha * alpha) as f32;
            let change = numbers.chunks_exact(4).map(|t| t[3] - own).collect();
            let texels = numbers.chunks_exact(4).map(|t| [t[0], t[1], t[2]]).collect();
            Ok((Cube { size, texels }, change))
        })
    }

    /// Runs `count` invocations, slice by slice.
    fn dispatch(
        &self,
        pipeline: &wgpu::ComputePipeline,
        texels: &wgpu::Buffer,
        uniforms: Uniforms,
        count: u32,
    ) -> Result<(), RenderError> {
        let device = &self.gpu.device;
        let buffers = [&self.uniforms].into_iter().chain(&self.inputs).chain([texels]);
        let entries: Vec<_> = buffers
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("bake"),
            layout: &self.layout,
            entries: &entries,
        });
        for first in (0..count).step_by(SLICE as usize) {
            let uniforms = Uniforms { first, ..uniforms };
            self.gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms));
            let mut encoder = device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.dispatch_workgroups((count - first).min(SLICE).div_ceil(WORKGROUP), 1, 1);
            }
            self.gpu.queue.submit([encoder.finish()]);
            self.gpu.wait("filtering the environment")?;
        }
        Ok(())
    }
}

fn shader_text() -> &'static str {
    FILES.iter().find(|file| file.path == "entry/bake.wgsl").map_or("", |file| file.source)
}

fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let kinds = [
        wgpu::BufferBindingType::Uniform,
        wgpu::BufferBindingType::Storage { read_only: true },
        wgpu::BufferBindingType::Storage { read_only: true },
        wgpu::BufferBindingType::Storage { read_only: true },
        wgpu::BufferBindingType::Storage { read_only: false },
        wgpu::BufferBindingType::Storage { read_only: false },
    ];
    let entries: Vec<_> = kinds
        .into_iter()
        .zip(0..)
        .map(|(ty, binding)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("bake"), entries: &entries })
}

fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::BindGroupLayout,
    entry_point: &str,
) -> wgpu::ComputePipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("bake"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry_point),
        layout: Some(&layout),
        module,
        entry_point: Some(entry_point),
        compilation_options: Default::default(),
        cache: None,
    })
}

/// What the shader needs to know of each row.
fn rows(map: &Equirect) -> Vec<Row> {
    let (tall, wide) = (PI / map.height as f64, 2.0 * PI / map.width as f64);
    (0..map.height)
        .map(|row| {
            let middle = (row as f64 + 0.5) * tall;
            // The centroid of a band lies towards the equator; at a pole, where it is a triangle, by a third of its half.
            let theta = middle + tall * tall / 12.0 / middle.tan();
            let width = wide * middle.sin();
            Row {
                sin_theta: theta.sin() as f32,
                cos_theta: theta.cos() as f32,
                solid_angle: (wide * 2.0 * middle.sin() * (0.5 * tall).sin()) as f32,
                variance: ((tall * tall + width * width) / 12.0) as f32,
                extent: tall.max(width) as f32,
            }
        })
        .collect()
}

/// Cosine and sine of the azimuth of each column's middle.
fn columns(map: &Equirect) -> Vec<[f32; 2]> {
    (0..map.width)
        .map(|column| {
            let (sin, cos) = (2.0 * PI * ((column as f64 + 0.5) / map.width as f64 - 0.5)).sin_cos();
            [cos as f32, sin as f32]
        })
        .collect()
}

/// The integral over the hemisphere of the shader's lobe x (a / (a + b (1 - x)))^2, b = (1 - a) / 2:
/// 2 pi (a / b)^2 (b / a - ln(1 + b / a)), which is pi at a = 1.
fn lobe_integral(a: f64) -> f64 {
    let ratio = (1.0 - a) / (2.0 * a);
    // Near 1 the difference cancels: its series is ratio^2 (1/2 - ratio/3 + ...).
    let part = if ratio.abs() < 1e-4 { 0.5 - ratio / 3.0 } else { (ratio - ratio.ln_1p()) / (ratio * ratio) };
    2.0 * PI * part
}

/// How the logarithm of that integral changes with the logarithm of a, by a central difference.
fn lobe_integral_change(a: f64) -> f64 {
    // Small for the difference to be the derivative; the shader's step for the light is its own.
    const WIDER: f64 = 1.001;
    (lobe_integral(a * WIDER) / lobe_integral(a / WIDER)).ln() / (2.0 * WIDER.ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lobes_integral_is_its_integral() {
        for alpha in [0.01, 0.04, 0.3, 0.99, 0.99999, 1.0] {
            let (a, n) = (alpha * alpha, 2_000_000);
            let b = (1.0 - a) / 2.0;
            // In u with 1 - x = u^3, which is dense where the lobe is narrow.
            let sum: f64 = (0..n)
                .map(|i| {
                    let u = (f64::from(i) + 0.5) / f64::from(n);
                    let s = u * u * u;
                    (1.0 - s) * (a / (a + b * s)).powi(2) * 3.0 * u * u
                })
                .sum();
            let numeric = 2.0 * PI * sum / f64::from(n);
            assert!((lobe_integral(a) / numeric - 1.0).abs() < 1e-6, "{alpha}: {} {numeric}", lobe_integral(a));
        }
    }

    #[test]
    fn rows_cover_the_sphere() {
        let map = Equirect { width: 7, height: 5, pixels: vec![[0.0; 3]; 35] };
        let whole: f32 = rows(&map).iter().map(|row| row.solid_angle * 7.0).sum();
        assert!((f64::from(whole) - 4.0 * PI).abs() < 1e-5);
    }
}
