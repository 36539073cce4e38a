//! What is drawn to, one tile at a time, and how its samples come back to the CPU.

use crate::device::Gpu;
use crate::error::RenderError;
use crate::program::DEPTH_FORMAT;

/// Samples on a side of a tile: with depth and read-back some 150 MB, whatever the picture's size.
pub(crate) const TILE_EDGE: u32 = 2048;

/// A colour and a depth texture with the buffer that the colour is read back through.
#[derive(Debug)]
pub(crate) struct Target {
    color: wgpu::Texture,
    color_view: wgpu::TextureView,
    depth_view: wgpu::TextureView,
    buffer: wgpu::Buffer,
    width: u32,
}

impl Target {
    /// A target of so many samples.
    pub(crate) fn new(gpu: &Gpu, format: wgpu::TextureFormat, width: u32, height: u32) -> Target {
        let texture = |label, format, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let color = texture("radiance", format, wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC);
        let depth = texture("depth", DEPTH_FORMAT, wgpu::TextureUsages::RENDER_ATTACHMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: u64::from(row_bytes(format, width)) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Target {
            color_view: color.create_view(&Default::default()),
            depth_view: depth.create_view(&Default::default()),
            color,
            buffer,
            width,
        }
    }

    /// Begins the pass that clears the target and draws everything; it may be timed.
    pub(crate) fn pass<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        clear: [f32; 4],
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'e> {
        let [r, g, b, a] = clear.map(f64::from);
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.color_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }

    /// Submits what was encoded and reads the first `width` x `height` samples, row by row.
    pub(crate) fn read(
        &self,
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        width: u32,
        height: u32,
    ) -> Result<Vec<[f32; 4]>, RenderError> {
        let format = self.color.format();
        let stride = row_bytes(format, self.width);
        encoder.copy_texture_to_buffer(
            self.color.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        gpu.read_mapped(&self.buffer, "drawing", |bytes| {
            let mut samples = Vec::with_capacity(width as usize * height as usize);
            for row in bytes.chunks_exact(stride as usize).take(height as usize) {
                append_samples(format, &row[..(width * sample_bytes(format)) as usize], &mut samples);
            }
            samples
        })
    }
}

fn append_samples(format: wgpu::TextureFormat, row: &[u8], samples: &mut Vec<[f32; 4]>) {
    if format == wgpu::TextureFormat::Rgba16Float {
        samples.extend(
            row.chunks_exact(8).map(|texel| {
                std::array::from_fn(|i| half::f16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]).to_f32())
            }),
        );
    } else {
        samples.extend(
            row.chunks_exact(16).map(|texel| {
                std::array::from_fn(|i| f32::from_le_bytes(std::array::from_fn(|byte| texel[4 * i + byte])))
            }),
        );
    }
}

fn sample_bytes(format: wgpu::TextureFormat) -> u32 {
    if format == wgpu::TextureFormat::Rgba16Float { 8 } else { 16 }
}

/// Bytes from row to row in the read-back buffer.
fn row_bytes(format: wgpu::TextureFormat, width: u32) -> u32 {
    (width * sample_bytes(format)).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_formats_are_read() {
        let wanted = [0.5, -2.0, 1024.0, 1.0];
        let mut samples = Vec::new();
        let full: Vec<u8> = wanted.iter().flat_map(|x: &f32| x.to_le_bytes()).collect();
        append_samples(wgpu::TextureFormat::Rgba32Float, &full, &mut samples);
        let half: Vec<u8> = wanted.iter().flat_map(|&x| half::f16::from_f32(x).to_le_bytes()).collect();
        append_samples(wgpu::TextureFormat::Rgba16Float, &half, &mut samples);
        assert_eq!(samples, [wanted, wanted]);
        assert_eq!(row_bytes(wgpu::TextureFormat::Rgba32Float, 17), 512);
        assert_eq!(row_bytes(wgpu::TextureFormat::Rgba16Float, 17), 256);
    }
}
