//! Triangle meshes as renderers read them, made sound: every attribute there, every index in range, everything finite.
//!
//! Files are read in `gltf`, the built-in shapes stand in `builtin`. Nothing here knows of materials or transforms.

use glam::{Mat4, Vec3};
use halfvector_maps::split_tangents;

mod builtin;
mod revolve;

pub use builtin::{BuiltinMesh, Part};

/// Largest number of vertices, and of indices, of one mesh: 2^26, so that no byte count leaves 32 bits by far.
pub const MAX_ELEMENTS: usize = 1 << 26;

/// A triangle mesh. All attributes have one entry per vertex, all numbers are finite, counter-clockwise triangles face
/// the viewer, and every three indices are a triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// In object space [m].
    pub positions: Vec<[f32; 3]>,
    /// Unit, in object space.
    pub normals: Vec<[f32; 3]>,
    /// Unit tangent, along which u grows, and the handedness w (1 or -1): bitangent = w cross(normal, tangent).
    pub tangents: Vec<[f32; 4]>,
    /// (0, 0) is the top left of an image.
    pub uv0: Vec<[f32; 2]>,
    /// Second texture coordinates; the first ones again where a file has none.
    pub uv1: Vec<[f32; 2]>,
    /// Linear Rec. 709 colour and alpha; white and 1 where a file has none.
    pub colors: Vec<[f32; 4]>,
    /// Three per triangle.
    pub indices: Vec<u32>,
}

/// What a mesh is made from. Attributes that are left out are made.
#[derive(Clone, Debug, Default)]
pub struct MeshData {
    /// In object space [m].
    pub positions: Vec<[f32; 3]>,
    /// Absent: flat normals, each triangle by itself (as glTF asks).
    pub normals: Option<Vec<[f32; 3]>>,
    /// Absent: MikkTSpace.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// Absent: (0, 0).
    pub uv0: Option<Vec<[f32; 2]>>,
    /// Absent: `uv0`.
    pub uv1: Option<Vec<[f32; 2]>>,
    /// Absent: white, alpha 1.
    pub colors: Option<Vec<[f32; 4]>>,
    /// Tangents that are made follow `uv1` instead of `uv0`: for a normal map that is read there.
    pub tangents_along_uv1: bool,
    /// Three per triangle.
    pub indices: Vec<u32>,
}

/// Why a mesh was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// More than [`MAX_ELEMENTS`].
    #[error("it has {count} {what}, more than {MAX_ELEMENTS}; split the mesh")]
    TooLarge {
        /// Vertices or indices.
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// Attributes of different lengths.
    #[error("it has {positions} positions but {count} {what}; every attribute needs one entry per vertex")]
    Length {
        /// Which attribute.
        what: &'static str,
        /// Its entries.
        count: usize,
        /// Positions.
        positions: usize,
    },
    /// An index without a vertex.
    #[error("index {place} is {index}, but there are only {vertices} vertices")]
    Index {
        /// Where in the list.
        place: usize,
        /// The index.
        index: u32,
        /// Vertices.
        vertices: usize,
    },
    /// The number of indices is no multiple of 3.
    #[error("it has {0} indices, which is no multiple of 3")]
    Triangles(usize),
    /// NaN or infinity.
    #[error("vertex {vertex} has {what} that are not finite")]
    NotFinite {
        /// Which attribute.
        what: &'static str,
        /// Which vertex.
        vertex: usize,
    },
}

impl Mesh {
    /// Makes a mesh: checks everything, adds what is missing. Normals and tangents without a direction get one.
    pub fn build(data: MeshData) -> Result<Mesh, MeshError> {
        check(&data)?;
        let data = if data.normals.is_none() { with_flat_normals(data) } else { data };
        let vertices = data.positions.len();
        let mut normals = data.normals.unwrap_or_default();
        for normal in &mut normals {
            *normal = Vec3::from(*normal).try_normalize().unwrap_or(Vec3::Z).to_array();
        }
        let has_uv = data.uv0.is_some();
        let uv0 = data.uv0.unwrap_or_else(|| vec![[0.0; 2]; vertices]);
        let uv1 = data.uv1.unwrap_or_else(|| uv0.clone());
        let colors = data.colors.unwrap_or_else(|| vec![[1.0; 4]; vertices]);
        let mut mesh = Mesh {
            positions: data.positions,
            normals,
            tangents: data.tangents.unwrap_or_default(),
            uv0,
            uv1,
            colors,
            indices: data.indices,
        };
        if mesh.tangents.is_empty() {
            if has_uv {
                mesh.generate_tangents(data.tangents_along_uv1);
            } else {
                mesh.tangents = vec![[0.0; 4]; vertices];
            }
        }
        for (tangent, normal) in mesh.tangents.iter_mut().zip(&mesh.normals) {
            *tangent = sound_tangent(*tangent, Vec3::from(*normal));
        }
        Ok(mesh)
    }

    /// MikkTSpace: vertices whose triangles do not share a tangent are doubled.
    fn generate_tangents(&mut self, along_uv1: bool) {
        let uvs = if along_uv1 { &self.uv1 } else { &self.uv0 };
        let split = split_tangents(&self.positions, &self.normals, uvs, &self.indices);
        for &vertex in &split.source[self.positions.len()..] {
            let vertex = vertex as usize;
            self.positions.push(self.positions[vertex]);
            self.normals.push(self.normals[vertex]);
            self.uv0.push(self.uv0[vertex]);
            self.uv1.push(self.uv1[vertex]);
            self.colors.push(self.colors[vertex]);
        }
        self.indices = split.indices;
        self.tangents = split.tangents;
    }

    /// The smallest box around all vertices; `None` without vertices.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of(self.positions.iter().map(|&p| Vec3::from(p)))
    }
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates.
    pub min: Vec3,
    /// Largest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// The smallest box around points; `None` without points.
    pub fn of(points: impl IntoIterator<Item = Vec3>) -> Option<Bounds> {
        points.into_iter().map(|p| Bounds { min: p, max: p }).reduce(Bounds::union)
    }

    /// The smallest box around both.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The smallest box around this box under a transform.
    pub fn transformed(&self, world_from_object: &Mat4) -> Bounds {
        let corners = self.corners().map(|p| world_from_object.transform_point3(p));
        corners[1..]
            .iter()
            .fold(Bounds { min: corners[0], max: corners[0] }, |sum, &p| sum.union(Bounds { min: p, max: p }))
    }

    /// The eight corners.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, low: f32, high: f32| if i & bit == 0 { low } else { high };
            Vec3::new(pick(1, self.min.x, self.max.x), pick(2, self.min.y, self.max.y), pick(4, self.min.z, self.max.z))
        })
    }

    /// The middle.
    pub fn center(&self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Half of the diagonal.
    pub fn radius(&self) -> f32 {
        (self.max * 0.5 - self.min * 0.5).length()
    }
}

fn check(data: &MeshData) -> Result<(), MeshError> {
    let vertices = data.positions.len();
    for (what, count) in [("vertices", vertices), ("indices", data.indices.len())] {
        if count > MAX_ELEMENTS {
            return Err(MeshError::TooLarge { what, count });
        }
    }
    let lengths = [
        ("normals", data.normals.as_ref().map(Vec::len)),
        ("tangents", data.tangents.as_ref().map(Vec::len)),
        ("first texture coordinates", data.uv0.as_ref().map(Vec::len)),
        ("second texture coordinates", data.uv1.as_ref().map(Vec::len)),
        ("colours", data.colors.as_ref().map(Vec::len)),
    ];
    for (what, count) in lengths {
        if let Some(count) = count.filter(|&count| count != vertices) {
            return Err(MeshError::Length { what, count, positions: vertices });
        }
    }
    if !data.indices.len().is_multiple_of(3) {
        return Err(MeshError::Triangles(data.indices.len()));
    }
    if let Some(place) = data.indices.iter().position(|&i| i as usize >= vertices) {
        return Err(MeshError::Index { place, index: data.indices[place], vertices });
    }
    let finite = |what, place: Option<usize>| match place {
        Some(vertex) => Err(MeshError::NotFinite { what, vertex }),
        None => Ok(()),
    };
    fn broken<const N: usize>(values: &[[f32; N]]) -> Option<usize> {
        values.iter().position(|v| !v.iter().all(|x| x.is_finite()))
    }
    finite("positions", broken(&data.positions))?;
    for (what, uvs) in [("first texture coordinates", &data.uv0), ("second texture coordinates", &data.uv1)] {
        finite(what, uvs.as_ref().and_then(|uvs| broken(uvs)))?;
    }
    finite("colours", data.colors.as_ref().and_then(|colors| broken(colors)))
}

/// Every triangle gets three vertices of its own and its plane's normal; tangents of the file no longer fit and go.
fn with_flat_normals(data: MeshData) -> MeshData {
    let pick = |i: &u32| *i as usize;
    let positions: Vec<_> = data.indices.iter().map(|i| data.positions[pick(i)]).collect();
    let unroll = |uvs: Option<Vec<[f32; 2]>>| uvs.map(|uvs| data.indices.iter().map(|i| uvs[pick(i)]).collect());
    let colors = data.colors.map(|colors| data.indices.iter().map(|i| colors[pick(i)]).collect());
    let mut normals = Vec::with_capacity(positions.len());
    for triangle in positions.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|i| Vec3::from(triangle[i]));
        normals.extend([unscaled_cross(b - a, c - a).to_array(); 3]);
    }
    MeshData {
        indices: (0..positions.len() as u32).collect(),
        positions,
        normals: Some(normals),
        tangents: None,
        uv0: unroll(data.uv0),
        uv1: unroll(data.uv1),
        colors,
        tangents_along_uv1: data.tangents_along_uv1,
    }
}

/// A vector along the cross product, of a length that neither overflows nor vanishes for tiny or huge triangles.
fn unscaled_cross(a: Vec3, b: Vec3) -> Vec3 {
    let scaled = |v: Vec3| v / v.abs().max_element().max(f32::MIN_POSITIVE);
    scaled(a).cross(scaled(b)).normalize_or_zero()
}

/// The tangent as unit vector perpendicular to nothing in particular but never along the normal, w 1 or -1.
fn sound_tangent(tangent: [f32; 4], normal: Vec3) -> [f32; 4] {
    let handedness = if tangent[3] < 0.0 { -1.0 } else { 1.0 };
    let direction = Vec3::new(tangent[0], tangent[1], tangent[2])
        .try_normalize()
        .filter(|t| t.cross(normal).length_squared() > 1e-6)
        .unwrap_or_else(|| normal.any_orthonormal_vector());
    [direction.x, direction.y, direction.z, handedness]
}

#[cfg(test)]
mod tests;
