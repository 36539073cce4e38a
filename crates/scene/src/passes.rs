//! Which faces of which object are drawn when: what every renderer of triangles does alike. Nothing is drawn here.

use halfvector_graph::document::AlphaMode;

use crate::mesh::Bounds;
use crate::scene::{Object, Scene};
use crate::view::View;

/// A side of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The side that the normal points to.
    Front,
    /// The other one.
    Back,
}

/// How an object's triangles are drawn, apart from the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FacePass {
    /// The object's transform mirrors, so that front faces turn the other way round.
    pub mirrored: bool,
    /// Which faces are left out.
    pub cull: Option<Side>,
    /// Blended over what is there, without writing depth.
    pub blend: bool,
}

/// The order of drawing: objects by their index, with the way they are drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Passes {
    /// Opaque and masked, in the scene's order.
    pub solid: Vec<(usize, FacePass)>,
    /// Blended, from back to front; after the background.
    pub blended: Vec<(usize, FacePass)>,
}

/// Why a scene cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PassesError {
    /// An object names a mesh or material that the scene does not have.
    #[error("object {object} uses {what} {index}, and the scene has {count}; correct the object")]
    Missing {
        /// Index of the object.
        object: usize,
        /// `mesh` or `material`.
        what: &'static str,
        /// The index that it names.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A mesh that cannot be drawn.
    #[error("mesh {mesh}: {why}; export the model again")]
    BadMesh {
        /// Index in the scene.
        mesh: usize,
        /// What is wrong with it.
        why: &'static str,
    },
}

/// Everything that is drawn, in order. Blended objects go by the distance of the middles of their meshes; objects without
/// triangles are passed over.
///
/// # Errors
/// Objects of meshes or materials that are not there, and meshes whose lists do not fit together.
pub fn passes(scene: &Scene, view: &View) -> Result<Passes, PassesError> {
    for (object, it) in scene.objects.iter().enumerate() {
        let ranges = [("mesh", it.mesh, scene.meshes.len()), ("material", it.material, scene.materials.len())];
        for (what, index, count) in ranges {
            if index >= count {
                return Err(PassesError::Missing { object, what, index, count });
            }
        }
    }
    let bounds = (0..scene.meshes.len()).map(|mesh| check_mesh(scene, mesh)).collect::<Result<Vec<_>, _>>()?;
    let mut passes = Passes::default();
    let mut blended = Vec::new();
    for (index, object) in scene.objects.iter().enumerate() {
        let Some(bounds) = bounds[object.mesh] else { continue };
        let middle = object.world_from_object.transform_point3(bounds.min.midpoint(bounds.max));
        let depth = (middle - view.position).dot(view.forward);
        for pass in passes_of(scene, object) {
            if pass.blend {
                blended.push((depth, (index, pass)));
            } else {
                passes.solid.push((index, pass));
            }
        }
    }
    blended.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    passes.blended = blended.into_iter().map(|(_, pass)| pass).collect();
    Ok(passes)
}

/// The extent of a sound mesh; `None` when there is nothing to draw.
fn check_mesh(scene: &Scene, number: usize) -> Result<Option<Bounds>, PassesError> {
    let bad = |why| Err(PassesError::BadMesh { mesh: number, why });
    let mesh = &scene.meshes[number];
    let vertices = mesh.positions.len();
    let lengths = [mesh.normals.len(), mesh.tangents.len(), mesh.uv0.len(), mesh.uv1.len(), mesh.colors.len()];
    if lengths.iter().any(|&length| length != vertices) {
        return bad("an attribute has not one entry per vertex");
    }
    if mesh.indices.iter().any(|&index| index as usize >= vertices) {
        return bad("an index has no vertex");
    }
    if u32::try_from(mesh.indices.len()).is_err() {
        return bad("it has more than 2^32 indices");
    }
    Ok(if mesh.indices.is_empty() { None } else { mesh.bounds() })
}

/// An object is drawn once; a blended object that shows both sides first with its far side, then with its near one.
fn passes_of(scene: &Scene, object: &Object) -> Vec<FacePass> {
    let surface = &scene.materials[object.material].document.surface;
    let mirrored = object.handedness() < 0.0;
    let pass = |cull, blend| FacePass { mirrored, cull, blend };
    match (surface.alpha_mode == AlphaMode::Blend, surface.double_sided) {
        (false, false) => vec![pass(Some(Side::Back), false)],
        (false, true) => vec![pass(None, false)],
        (true, false) => vec![pass(Some(Side::Back), true)],
        (true, true) => vec![pass(Some(Side::Front), true), pass(Some(Side::Back), true)],
    }
}
