//! Meshes on the GPU: one buffer per attribute, made when a shader first asks for it.

use std::collections::HashMap;

use glam::{Mat4, Vec3};
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
    /// Middle of the bounding box, in object space.
    center: Vec3,
}

impl MeshBuffers {
    /// Uploads the indices of mesh number `number` and looks at its extent; `None` when there is nothing to draw.
    pub(crate) fn new(gpu: &Gpu, number: usize, mesh: &Mesh) -> Result<Option<MeshBuffers>, RenderError> {
        let bad = |why: &str| RenderError::BadMesh { mesh: number, why: why.to_owned() };
        let vertices = mesh.positions.len();
        let lengths = [mesh.normals.len(), mesh.tangents.len(), mesh.uv0.len(), mesh.uv1.len()];
        if lengths.iter().any(|&length| length != vertices) {
            return Err(bad("an attribute has not one entry per vertex"));
        }
        if mesh.indices.iter().any(|&index| index as usize >= vertices) {
            return Err(bad("an index has no vertex"));
        }
        let index_count = u32::try_from(mesh.indices.len()).map_err(|_| bad("more than 2^32 indices"))?;
        if index_count == 0 {
            return Ok(None);
        }
        let indices = upload(gpu, number, bytemuck::cast_slice(&mesh.indices), wgpu::BufferUsages::INDEX)?;
        let positions = || mesh.positions.iter().copied().map(Vec3::from);
        let low = positions().fold(Vec3::INFINITY, Vec3::min);
        let high = positions().fold(Vec3::NEG_INFINITY, Vec3::max);
        Ok(Some(MeshBuffers { attributes: HashMap::new(), indices, index_count, center: low.midpoint(high) }))
    }

    /// Uploads an attribute that a shader reads, once.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, number: usize, mesh: &Mesh, name: &str) -> Result<(), RenderError> {
        let (name, bytes): (_, &[u8]) = match name {
            "position" => ("position", bytemuck::cast_slice(&mesh.positions)),
            "normal" => ("normal", bytemuck::cast_slice(&mesh.normals)),
            "tangent" => ("tangent", bytemuck::cast_slice(&mesh.tangents)),
            "uv0" => ("uv0", bytemuck::cast_slice(&mesh.uv0)),
            "uv1" => ("uv1", bytemuck::cast_slice(&mesh.uv1)),
            other => {
                let why = format!("a shader reads the attribute `{other}`, which meshes do not have");
                return Err(RenderError::BadMesh { mesh: number, why });
            }
        };
        if !self.attributes.contains_key(name) {
            self.attributes.insert(name, upload(gpu, number, bytes, wgpu::BufferUsages::VERTEX)?);
        }
        Ok(())
    }

    /// The buffer of an attribute that was prepared.
    pub(crate) fn attribute(&self, name: &str) -> Option<&wgpu::Buffer> {
        self.attributes.get(name)
    }

    /// Where the mesh's middle lies in world space: what blended objects are sorted by.
    pub(crate) fn center_in_world(&self, world_from_object: &Mat4) -> Vec3 {
        world_from_object.transform_point3(self.center)
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
