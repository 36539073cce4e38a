//! Meshes on the GPU: one buffer per attribute, made when a shader first asks for it.

use std::collections::HashMap;

use halfvector_scene::Mesh;

use crate::device::Gpu;
use crate::error::RenderError;

/// The buffers of one mesh.
#[derive(Debug)]
pub(crate) struct MeshBuffers {
    /// By attribute name, as in `VertexInput`.
    attributes: HashMap<&'static str, wgpu::Buffer>,
    /// Three per triangle, 32 bits each.
    pub(crate) indices: wgpu::Buffer,
    /// How many.
    pub(crate) index_count: u32,
}

impl MeshBuffers {
    /// Uploads the indices of mesh number `number`.
    pub(crate) fn new(gpu: &Gpu, number: usize, mesh: &Mesh) -> Result<MeshBuffers, RenderError> {
        let indices = upload(gpu, number, bytemuck::cast_slice(&mesh.indices), wgpu::BufferUsages::INDEX)?;
        Ok(MeshBuffers { attributes: HashMap::new(), indices, index_count: mesh.indices.len() as u32 })
    }

    /// The buffer of an attribute that a shader reads, uploaded once.
    pub(crate) fn attribute(
        &mut self,
        gpu: &Gpu,
        number: usize,
        mesh: &Mesh,
        name: &str,
    ) -> Result<wgpu::Buffer, RenderError> {
        let (name, bytes): (_, &[u8]) = match name {
            "position" => ("position", bytemuck::cast_slice(&mesh.positions)),
            "normal" => ("normal", bytemuck::cast_slice(&mesh.normals)),
            "tangent" => ("tangent", bytemuck::cast_slice(&mesh.tangents)),
            "uv0" => ("uv0", bytemuck::cast_slice(&mesh.uv0)),
            "uv1" => ("uv1", bytemuck::cast_slice(&mesh.uv1)),
            "color" => ("color", bytemuck::cast_slice(&mesh.colors)),
            other => {
                return Err(RenderError::Attribute { name: other.to_owned() });
            }
        };
        if let Some(known) = self.attributes.get(name) {
            return Ok(known.clone());
        }
        let buffer = upload(gpu, number, bytes, wgpu::BufferUsages::VERTEX)?;
        self.attributes.insert(name, buffer.clone());
        Ok(buffer)
    }
}

fn upload(gpu: &Gpu, mesh: usize, bytes: &[u8], usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, RenderError> {
    let limit = gpu.device.limits().max_buffer_size;
    let size = bytes.len() as u64;
    if size > limit {
        return Err(RenderError::MeshTooLarge { mesh, bytes: size, limit, adapter: gpu.name.clone() });
    }
    Ok(filled_buffer(gpu, bytes, usage))
}

/// A buffer with this content. Sizes are multiples of 4, as copies want them.
pub(crate) fn filled_buffer(gpu: &Gpu, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes.len() as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue.write_buffer(&buffer, 0, bytes);
    buffer
}
