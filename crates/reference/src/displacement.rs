//! Displacement: the vertices of a mesh moved along their normals by the height of its material, as the vertex stage of the
//! shaders does it. What the moved surface's normals are is [`crate::material`]'s matter.

use glam::{DVec2, DVec3, DVec4};
use halfvector_maps::height::displaced;
use halfvector_scene::{Mesh, Object};
use rayon::prelude::*;

use crate::ReferenceError;
use crate::function::Function;
use crate::geometry::Point;

/// Vertices that are moved at once.
const BATCH: usize = 2048;
/// Beyond it nothing is drawn [m]: the hierarchy's boxes are of f32, and so are their areas.
const FARTHEST: f64 = 1e18;

/// The vertices of an object.
pub(crate) struct Moved {
    /// In world space; none where no vertex moves.
    pub(crate) positions: Option<Vec<DVec3>>,
    /// How many stay where they are because their height is NaN, or leads beyond [`FARTHEST`].
    pub(crate) not_finite: u64,
}

/// Moves the vertices of the object with the number `body`, seen from `camera`.
pub(crate) fn moved(
    height: &Function,
    body: u32,
    object: &Object,
    mesh: &Mesh,
    camera: DVec3,
) -> Result<Moved, ReferenceError> {
    let points = vertices(body, object, mesh, camera);
    // A height that is the same everywhere is computed once.
    let looked_at = if height.is_constant() { &points[..points.len().min(1)] } else { &points };
    let heights: Vec<Vec<f64>> = looked_at
        .par_chunks(BATCH)
        .map_init(
            || height.runner(),
            |runner, points| {
                let runner = runner.as_mut().map_err(|error| error.clone())?;
                runner.run(points, None)?;
                Ok(runner.result(0).unwrap_or_default().to_vec())
            },
        )
        .collect::<Result<_, ReferenceError>>()?;
    let heights = heights.iter().flatten().copied().cycle();
    let (mut moves, mut not_finite) = (false, 0);
    let place = |(point, height): (&Point, f64)| {
        let place = DVec3::from(displaced(point.position.to_array(), point.normal.to_array(), height));
        if place.abs().max_element() <= FARTHEST && height.is_finite() {
            moves |= height != 0.0;
            return place;
        }
        not_finite += 1;
        point.position
    };
    let positions = points.iter().zip(heights).map(place).collect();
    Ok(Moved { positions: Some(positions).filter(|_| moves), not_finite })
}

/// What the vertex stage knows of each vertex.
fn vertices(body: u32, object: &Object, mesh: &Mesh, camera: DVec3) -> Vec<Point> {
    let world_from_object = object.world_from_object.as_dmat4();
    let normal_from_object = object.normal_from_object().as_dmat3();
    let handedness = f64::from(object.handedness());
    let vertex = |i: usize| {
        let object_position = DVec3::from(mesh.positions[i].map(f64::from));
        let position = world_from_object.transform_point3(object_position);
        let normal = (normal_from_object * DVec3::from(mesh.normals[i].map(f64::from))).normalize_or_zero();
        let [x, y, z, w] = mesh.tangents[i].map(f64::from);
        let tangent = world_from_object.transform_vector3(DVec3::new(x, y, z)).normalize_or_zero();
        Point {
            body,
            position,
            surface_position: position,
            object_position,
            geometric_normal: normal,
            normal,
            tangent: tangent.extend(w * handedness),
            uv0: DVec2::from(mesh.uv0[i].map(f64::from)),
            uv1: DVec2::from(mesh.uv1[i].map(f64::from)),
            color: DVec4::from(mesh.colors[i].map(f64::from)),
            view_dir: (camera - position).normalize_or_zero(),
        }
    };
    (0..mesh.positions.len()).map(vertex).collect()
}
