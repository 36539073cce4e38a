//! Tangents of triangle meshes: MikkTSpace, and a tangent for every vertex that it has none for.
//!
//! Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", as computed by `bevy_mikktspace`. Texture coordinates are
//! glTF's and wgpu's: (0, 0) is the top left of the image, v runs down it. A +Y normal map's bitangent, w cross(N, T),
//! therefore points towards smaller v: up in the image.
//!
//! A tangent is (x, y, z, w): a unit vector and the handedness w, 1 or -1 (-1 where the texture is mirrored).
//! Does not unwrap and does not weld.

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};

use crate::normal::tangent_from_normal;
use crate::real::{add, dot, normalize_or, plus_z};

/// A mesh with its vertices doubled where triangles meet that do not share a tangent.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitTangents {
    /// Three indices a triangle, into `source` and `tangents`. One that was out of range is `u32::MAX`.
    pub indices: Vec<u32>,
    /// For each vertex the one that it was before: `positions[source[i]]` and so on. Old vertices come first, in order.
    pub source: Vec<u32>,
    /// A tangent for each vertex.
    pub tangents: Vec<[f32; 4]>,
}

/// One tangent for each vertex, all finite and of unit length.
///
/// `indices` are three a triangle. Where the triangles at a vertex have different tangents it gets the mean of those of
/// the more common handedness; [`split_tangents`] loses nothing. Vertices with no triangle, or only triangles without
/// area in space or texture, get a tangent of their normal alone. Triangles whose indices are out of range or whose data
/// are not finite are passed over, so any input is served.
pub fn tangents(positions: &[[f32; 3]], normals: &[[f32; 3]], uvs: &[[f32; 2]], indices: &[u32]) -> Vec<[f32; 4]> {
    let corners = corner_tangents(positions, normals, uvs, indices);
    let mut sums = vec![[[0.0_f32; 3]; 2]; positions.len()];
    let mut counts = vec![[0_u32; 2]; positions.len()];
    for (&vertex, corner) in indices.iter().zip(&corners) {
        if let Some([x, y, z, w]) = *corner {
            let mirrored = usize::from(w < 0.0);
            let vertex = vertex as usize;
            sums[vertex][mirrored] = add(sums[vertex][mirrored], [x, y, z]);
            counts[vertex][mirrored] += 1;
        }
    }
    (0..positions.len())
        .map(|vertex| {
            let mirrored = usize::from(counts[vertex][1] > counts[vertex][0]);
            let w = if mirrored == 1 { -1.0 } else { 1.0 };
            let normal = normals.get(vertex).copied().unwrap_or(plus_z());
            completed(normalize_or(sums[vertex][mirrored], [0.0; 3]), w, normal)
        })
        .collect()
}

/// A tangent for each corner of each triangle, and the vertices doubled where their corners differ. See [`tangents`] for
/// the arguments and for what becomes of bad input.
pub fn split_tangents(
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    uvs: &[[f32; 2]],
    indices: &[u32],
) -> SplitTangents {
    const NONE: u32 = u32::MAX;
    let corners = corner_tangents(positions, normals, uvs, indices);
    let mut source: Vec<u32> = (0..positions.len() as u32).collect();
    let mut tangents: Vec<Option<[f32; 4]>> = vec![None; positions.len()];
    // The doubles of a vertex, as a list through `next`.
    let mut next = vec![NONE; positions.len()];
    let split = indices
        .iter()
        .zip(&corners)
        .map(|(&vertex, corner)| {
            let mut at = vertex as usize;
            let Some(corner) = *corner else { return if at < positions.len() { vertex } else { NONE } };
            loop {
                match tangents[at] {
                    None => {
                        tangents[at] = Some(corner);
                        return at as u32;
                    }
                    Some(tangent) if tangent == corner => return at as u32,
                    Some(_) if next[at] != NONE => at = next[at] as usize,
                    Some(_) => {
                        next[at] = source.len() as u32;
                        source.push(vertex);
                        tangents.push(Some(corner));
                        next.push(NONE);
                        return next[at];
                    }
                }
            }
        })
        .collect();
    let tangents = tangents
        .iter()
        .zip(&source)
        .map(|(tangent, &vertex)| {
            let normal = normals.get(vertex as usize).copied().unwrap_or(plus_z());
            let [x, y, z, w] = tangent.unwrap_or([0.0, 0.0, 0.0, 1.0]);
            completed([x, y, z], w, normal)
        })
        .collect();
    SplitTangents { indices: split, source, tangents }
}

/// The tangent as it is if it is one; otherwise one of the normal alone, right-handed.
fn completed(tangent: [f32; 3], w: f32, normal: [f32; 3]) -> [f32; 4] {
    let ([x, y, z], w) = if is_tangent_of(tangent, normal) {
        (tangent, w)
    } else {
        (tangent_from_normal(normalize_or(normal, plus_z())), 1.0)
    };
    [x, y, z, w]
}

/// Unit, finite, and at least some degrees away from the normal.
fn is_tangent_of(tangent: [f32; 3], normal: [f32; 3]) -> bool {
    let normal = normalize_or(normal, plus_z());
    (dot(tangent, tangent) - 1.0).abs() < 1e-3 && dot(tangent, normal).abs() < 0.99
}

/// MikkTSpace's tangent at each corner; none where it has none.
fn corner_tangents(
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    uvs: &[[f32; 2]],
    indices: &[u32],
) -> Vec<Option<[f32; 4]>> {
    let vertex_is_sound = |vertex: u32| {
        let at = vertex as usize;
        let (Some(p), Some(n), Some(uv)) = (positions.get(at), normals.get(at), uvs.get(at)) else { return false };
        p.iter().chain(n).chain(uv).all(|x| x.is_finite())
    };
    let triangles: Vec<[u32; 3]> = indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    let faces: Vec<usize> =
        (0..triangles.len()).filter(|&face| triangles[face].iter().all(|&vertex| vertex_is_sound(vertex))).collect();
    let mut mesh = Mesh { positions, normals, uvs, triangles, faces, corners: vec![None; indices.len()] };
    // The error type has no values: it cannot fail.
    match generate_tangents(&mut mesh) {
        Ok(()) => mesh.corners,
        Err(_) => vec![None; indices.len()],
    }
}

struct Mesh<'a> {
    positions: &'a [[f32; 3]],
    normals: &'a [[f32; 3]],
    uvs: &'a [[f32; 2]],
    triangles: Vec<[u32; 3]>,
    /// The triangles that take part.
    faces: Vec<usize>,
    corners: Vec<Option<[f32; 4]>>,
}

impl Mesh<'_> {
    fn vertex(&self, face: usize, vert: usize) -> usize {
        self.triangles[self.faces[face]][vert] as usize
    }
}

impl Geometry for Mesh<'_> {
    fn num_faces(&self) -> usize {
        self.faces.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.positions[self.vertex(face, vert)]
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        let normal = self.normals[self.vertex(face, vert)];
        // Unit normals go through bit by bit, as other tools pass them.
        if (dot(normal, normal) - 1.0).abs() < 1e-4 { normal } else { normalize_or(normal, plus_z()) }
    }

    /// MikkTSpace takes v to run up the image.
    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        let [u, v] = self.uvs[self.vertex(face, vert)];
        [u, -v]
    }

    fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, face: usize, vert: usize) {
        let normal = self.normal(face, vert);
        let corner = 3 * self.faces[face] + vert;
        self.corners[corner] = tangent_space
            .map(|space| space.tangent_encoded())
            .filter(|&[x, y, z, w]| w.is_finite() && is_tangent_of([x, y, z], normal));
    }
}
